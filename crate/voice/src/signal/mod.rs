//! Speech signal processing: measurements and modifications.
//!
//! Every function takes one channel of samples in −1..1 and the sampling rate in hertz (intended: 8
//! to 48 kHz); time 0 is the first sample. The functions are pure and never panic; an invalid rate
//! (not finite, or below [`MIN_RATE_HZ`]) gives the result of empty audio.
//!
//! Scope: fundamental frequency, intensity, loudness, glottal epochs, bursts, a spectrogram as
//! data; changes of duration, pitch and gain.
//! Out of scope: reading and writing of audio files, rendering, and the character of a voice.

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
