//! Building blocks of instruments and the mix.

use std::f64::consts::{PI, TAU};

/// Samples a second; Opus knows no higher rate.
pub(crate) const RATE_HZ: f64 = 48_000.0;

/// Returns the sine of a phase in cycles.
pub(crate) fn sine(cycles: f64) -> f64 {
    libm::sin(TAU * (cycles - cycles.floor()))
}

/// Deterministic white noise generator (SplitMix64, Steele et al. 2014,
/// doi:10.1145/2714064.2660195).
pub(crate) struct Noise(u64);

impl Noise {
    /// Creates the noise generator of one note of one track.
    pub(crate) fn new(seed: u64, track: u64, note: u64) -> Self {
        let mut noise =
            Self(seed ^ track.wrapping_mul(0xd6e8_feb8_6659_fd93) ^ note.rotate_left(32));
        noise.next();
        noise
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Returns the next random number, 0 to 1.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns the next random number, -1 to 1.
    pub(crate) fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }
}

/// Second-order state-variable filter that stays stable while its cutoff frequency changes (Simper
/// 2013, "Solving the continuous SVF equations using trapezoidal integration").
#[derive(Clone, Copy, Default)]
pub(crate) struct Filter {
    s1: f64,
    s2: f64,
}

impl Filter {
    /// Filters one sample and returns its low-pass, band-pass and high-pass outputs.
    fn step(&mut self, x: f64, cutoff_hz: f64, resonance: f64) -> [f64; 3] {
        let g = libm::tan(PI * (cutoff_hz / RATE_HZ).min(0.49));
        let k = 1.0 / resonance;
        let high = (x - (k + g) * self.s1 - self.s2) / (1.0 + g * (g + k));
        let band = g * high + self.s1;
        let low = g * band + self.s2;
        self.s1 = g * high + band;
        self.s2 = g * band + low;
        [low, band, high]
    }

    /// Filters the signal with a low-pass; `resonance` is the filter's Q, 0.707 for none.
    pub(crate) fn low(&mut self, x: f64, cutoff_hz: f64, resonance: f64) -> f64 {
        self.step(x, cutoff_hz, resonance)[0]
    }

    /// Filters the signal with a band-pass.
    pub(crate) fn band(&mut self, x: f64, centre_hz: f64, resonance: f64) -> f64 {
        self.step(x, centre_hz, resonance)[1]
    }

    /// Filters the signal with a high-pass.
    pub(crate) fn high(&mut self, x: f64, cutoff_hz: f64, resonance: f64) -> f64 {
        self.step(x, cutoff_hz, resonance)[2]
    }
}

/// Left and right channel of a sound, one sample every `1 / RATE_HZ` seconds.
pub(crate) type Stereo = [Vec<f64>; 2];

/// Returns the frequency of a MIDI note number, Hz.
pub(crate) fn frequency_hz(pitch: f64) -> f64 {
    440.0 * libm::pow(2.0, (pitch - 69.0) / 12.0)
}

/// Adds a sound to both channels from a given time: `sound` gives the left and right samples for
/// seconds since the start, until `length_secs` or the end of the piece.
pub(crate) fn add(
    out: &mut Stereo,
    start_secs: f64,
    length_secs: f64,
    mut sound: impl FnMut(f64) -> [f64; 2],
) {
    let first = (start_secs * RATE_HZ).round().max(0.0) as usize;
    let count = (length_secs * RATE_HZ).ceil() as usize;
    let [left, right] = out;
    for (i, (l, r)) in left
        .iter_mut()
        .zip(right)
        .skip(first)
        .take(count)
        .enumerate()
    {
        let [a, b] = sound(i as f64 / RATE_HZ);
        *l += a;
        *r += b;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the RMS level of a sine after a filter.
    fn left(hz: f64, mut filter: impl FnMut(f64) -> f64) -> f64 {
        let samples = (0..48_000).map(|i| filter(sine(hz * f64::from(i) / RATE_HZ)));
        let late = samples.skip(24_000).map(|y| y * y).sum::<f64>() / 24_000.0;
        (2.0 * late).sqrt()
    }

    #[test]
    fn filters_pass_what_they_should() {
        let butterworth = std::f64::consts::FRAC_1_SQRT_2;
        for (hz, low, high) in [
            (100.0, 1.0, 0.0),
            (1000.0, butterworth, butterworth),
            (9000.0, 0.0, 1.0),
        ] {
            let mut f = Filter::default();
            assert!(
                (left(hz, |x| f.low(x, 1000.0, butterworth)) - low).abs() < 0.02,
                "{hz}"
            );
            let mut f = Filter::default();
            assert!(
                (left(hz, |x| f.high(x, 1000.0, butterworth)) - high).abs() < 0.02,
                "{hz}"
            );
        }
    }

    #[test]
    fn noise_is_even_and_the_same_again() {
        let mut a = Noise::new(1, 2, 3);
        let values: Vec<f64> = (0..10_000).map(|_| a.signed()).collect();
        let mean = values.iter().sum::<f64>() / 1e4;
        // Three standard errors of an even spread.
        assert!(
            mean.abs() < 3.0 * (1.0_f64 / 3.0 / 1e4).sqrt(),
            "the mean of the noise is near 0"
        );
        let mut b = Noise::new(1, 2, 3);
        assert!(
            values.iter().all(|v| *v == b.signed()),
            "the same seed gives the same noise"
        );
        assert_ne!(values[0], Noise::new(1, 2, 4).signed());
    }
}
