//! Interpolation between audio samples.

use std::f64::consts::PI;

use raconteur_base::ops;

/// Interpolation filter that reads audio between its samples.
pub(super) struct Taps {
    /// Weights of the samples from `-REACH + 1` to `REACH` around; `None` if the position is on a
    /// sample.
    weights: Option<[f64; 2 * Taps::REACH]>,
}

impl Taps {
    /// Samples on either side. With 16 the error stays below −60 dB up to 0.9 of the
    /// highest frequency.
    const REACH: usize = 16;

    /// Creates the filter for values `delay` samples (−0.5..0.5) before the requested sample.
    pub(super) fn new(delay: f64) -> Self {
        if delay.abs() < 1e-6 {
            return Self { weights: None };
        }
        let mut weights = [0.0; 2 * Self::REACH];
        let mut sum = 0.0;
        for (k, weight) in weights.iter_mut().enumerate() {
            let distance = k as f64 - (Self::REACH - 1) as f64 + delay;
            let sinc = ops::sin(PI * distance) / (PI * distance);
            let hann = 0.5 + 0.5 * ops::cos(PI * distance / (Self::REACH as f64 + 0.5));
            *weight = sinc * hann;
            sum += *weight;
        }
        for weight in &mut weights {
            *weight /= sum;
        }
        Self {
            weights: Some(weights),
        }
    }

    pub(super) fn apply(&self, at: isize, sample: impl Fn(isize) -> f64) -> f64 {
        match &self.weights {
            None => sample(at),
            Some(weights) => weights
                .iter()
                .enumerate()
                .map(|(k, w)| w * sample(at + k as isize - (Self::REACH as isize - 1)))
                .sum(),
        }
    }
}
