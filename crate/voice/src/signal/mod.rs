//! The signal of speech: measures and changes of it.
//!
//! Every function takes one channel of samples in −1..1 and the sampling rate in hertz
//! (8 to 48 kHz are meant); time 0 is the first sample. The functions are pure and never
//! panic; a rate that is no rate (not finite, or below [`MIN_RATE_HZ`]) gives what
//! silence of no length gives.
//!
//! Does: fundamental frequency, level, loudness, glottal epochs, bursts, a
//! spectrogram as data; changes of duration, pitch and gain.
//! Does not: read or write sound files, draw, or decide what a voice should sound like.

pub mod bursts;
#[cfg(test)]
mod click;
pub mod epochs;
pub mod f0;
pub(crate) mod filter;
pub mod intensity;
pub mod loudness;
pub mod psola;
mod resample;
mod rigid;
pub mod spectrogram;
#[cfg(test)]
pub(crate) mod testing;
mod time_map;

pub use f0::{PitchOptions, PitchTrack};
pub use intensity::rms;
pub use psola::{Change, Changed, change};
pub use resample::resample;
pub use time_map::TimeMap;

/// The lowest sampling rate that is worked on, in hertz.
pub const MIN_RATE_HZ: f64 = 4000.0;

/// The highest sampling rate that is worked on, in hertz.
pub const MAX_RATE_HZ: f64 = 192_000.0;

/// Returns true if the sample rate is supported.
fn is_rate(rate_hz: f64) -> bool {
    (MIN_RATE_HZ..=MAX_RATE_HZ).contains(&rate_hz)
}

/// Returns a number in −1..1 that depends only on the counter: reproducible variation. Uses the
/// mixing function of splitmix64 (Steele, Lea and Flood 2014, doi:10.1145/2660193.2660195).
fn scatter(counter: u64) -> f64 {
    let mut z = counter.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^= z >> 31;
    (z >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}
