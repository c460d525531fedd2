//! Second-order filters.

use std::f64::consts::{PI, SQRT_2};

use raconteur_base::ops;

/// Second-order digital filter: `y = b0 x + b1 x₋₁ + b2 x₋₂ − a1 y₋₁ − a2 y₋₂`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Biquad {
    pub(crate) b: [f64; 3],
    pub(crate) a: [f64; 2],
}

impl Biquad {
    /// Creates a second-order Butterworth high-pass by the bilinear transform.
    pub(crate) fn high_pass(rate_hz: f64, corner_hz: f64) -> Self {
        let k = ops::tan(PI * (corner_hz / rate_hz).clamp(1e-6, 0.49));
        let norm = 1.0 + SQRT_2 * k + k * k;
        Self {
            b: [1.0 / norm, -2.0 / norm, 1.0 / norm],
            a: [
                2.0 * (k * k - 1.0) / norm,
                (1.0 - SQRT_2 * k + k * k) / norm,
            ],
        }
    }

    /// Returns the power of a steady tone after the filter relative to that before it.
    pub(crate) fn power_gain(&self, hz: f64, rate_hz: f64) -> f64 {
        let angle = 2.0 * PI * hz / rate_hz;
        let power = |c: [f64; 3]| {
            let (s1, c1) = ops::sincos(angle);
            let (s2, c2) = ops::sincos(2.0 * angle);
            let (re, im) = (c[0] + c[1] * c1 + c[2] * c2, c[1] * s1 + c[2] * s2);
            re * re + im * im
        };
        power(self.b) / power([1.0, self.a[0], self.a[1]])
    }

    /// Returns the filtered audio; the filter begins at rest.
    pub(crate) fn run(&self, samples: &[f64]) -> Vec<f64> {
        let (mut s1, mut s2) = (0.0, 0.0);
        samples
            .iter()
            .map(|&x| {
                // The transposed second direct form: its two states round least.
                let y = self.b[0] * x + s1;
                s1 = self.b[1] * x - self.a[0] * y + s2;
                s2 = self.b[2] * x - self.a[1] * y;
                y
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_corner_is_at_half_power() {
        let filter = Biquad::high_pass(16_000.0, 2000.0);
        for (hz, expected) in [(2000.0, 0.5_f64.sqrt()), (7900.0, 1.0), (20.0, 1e-4)] {
            let tone: Vec<f64> = (0..16_000)
                .map(|i| ops::sin(2.0 * PI * hz * f64::from(i) / 16_000.0))
                .collect();
            let out = filter.run(&tone);
            let gain = (out[8000..].iter().map(|x| x * x).sum::<f64>() / 4000.0).sqrt();
            assert!((gain - expected).abs() < 2e-3, "{hz}: {gain}");
            let told = filter.power_gain(hz, 16_000.0).sqrt();
            assert!((told - gain).abs() < 2e-3, "{hz}: {told}");
        }
    }
}
