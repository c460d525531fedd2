//! Resampling of audio.
//!
//! This implementation is its own, because no maintained crate gives the same samples (rubato has
//! other kernels and delays): all voices would need another bake, and bundles are identified by
//! their bytes.

use core::f64::consts::PI;

use raconteur_base::ops;

/// Zero crossings of the kernel on each side: the longer, the steeper its edge.
const CROSSINGS: f64 = 24.0;
/// Cut-off frequency, as a share of the lower of the two Nyquist frequencies.
const CUT: f64 = 0.94;
/// The shape of the Kaiser window: 80 dB of attenuation beyond the edge.
const KAISER_BETA: f64 = 7.86;

/// Returns the modified Bessel function of order 0, computed by its series (Abramowitz and Stegun
/// 9.6.12).
fn bessel(x: f64) -> f64 {
    let (mut sum, mut term, mut k) = (1.0, 1.0, 1.0);
    while term > sum * 1e-12 {
        term *= (x / (2.0 * k)) * (x / (2.0 * k));
        sum += term;
        k += 1.0;
    }
    sum
}

/// Resamples the sound, by a windowed sinc (Smith and Gossett 1984,
/// doi:10.1109/ICASSP.1984.1172555). Invalid rates give an empty result.
#[must_use]
pub fn resample(samples: &[f64], from_hz: f64, to_hz: f64) -> Vec<f64> {
    // The resolution of the kernel between its samples; intermediate values are linear.
    const FINE: f64 = 512.0;
    if from_hz == to_hz {
        return samples.to_vec();
    }
    if !super::is_rate(from_hz) || !super::is_rate(to_hz) {
        return Vec::new();
    }
    let length = (samples.len() as f64 * to_hz / from_hz).round() as usize;
    // Retained cycles per input sample.
    let cut = 0.5 * CUT * (to_hz / from_hz).min(1.0);
    let reach = CROSSINGS / (2.0 * cut);
    let kernel: Vec<f64> = (0..=(reach * FINE) as usize + 2)
        .map(|i| {
            let x = i as f64 / FINE;
            let share = x / reach;
            if share >= 1.0 {
                return 0.0;
            }
            let window = bessel(KAISER_BETA * (1.0 - share * share).sqrt()) / bessel(KAISER_BETA);
            let angle = 2.0 * PI * cut * x;
            let sinc = if angle < 1e-9 {
                1.0
            } else {
                ops::sin(angle) / angle
            };
            2.0 * cut * sinc * window
        })
        .collect();
    let step = from_hz / to_hz;
    (0..length)
        .map(|i| {
            let at = i as f64 * step;
            let first = (at - reach).ceil().max(0.0) as usize;
            let past = ((at + reach).floor() as usize + 1).min(samples.len());
            let mut sum = 0.0;
            for (k, sample) in samples.iter().enumerate().take(past).skip(first) {
                let place = (at - k as f64).abs() * FINE;
                let low = place as usize;
                let share = place - low as f64;
                sum += sample * (kernel[low] + (kernel[low + 1] - kernel[low]) * share);
            }
            sum
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tone(hz: f64, rate_hz: f64, secs: f64) -> Vec<f64> {
        (0..(rate_hz * secs) as usize)
            .map(|i| 0.5 * ops::sin(2.0 * PI * hz * i as f64 / rate_hz))
            .collect()
    }

    fn difference_db(a: &[f64], b: &[f64]) -> f64 {
        let middle = 2_000..a.len().min(b.len()) - 2_000;
        let power: f64 = middle.clone().map(|i| b[i] * b[i]).sum();
        let error: f64 = middle.map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum();
        10.0 * ops::ln(error / power) / core::f64::consts::LN_10
    }

    #[test]
    fn tones_stay_what_they_are() {
        for (from, to) in [
            (16_000.0, 32_000.0),
            (22_050.0, 32_000.0),
            (32_000.0, 16_000.0),
            (48_000.0, 22_050.0),
        ] {
            for hz in [100.0, 997.0, 5_000.0] {
                let changed = resample(&tone(hz, from, 1.0), from, to);
                assert!(
                    (changed.len() as f64 - to).abs() <= 1.0,
                    "the resampled length is exact to one sample"
                );
                let error = difference_db(&changed, &tone(hz, to, 1.0));
                assert!(error < -65.0, "{from} {to} {hz}: {error} dB");
            }
        }
    }

    #[test]
    fn what_the_new_rate_cannot_hold_is_gone() {
        let changed = resample(&tone(11_000.0, 32_000.0, 1.0), 32_000.0, 16_000.0);
        let most = changed[1_000..15_000]
            .iter()
            .fold(0.0, |m: f64, s| m.max(s.abs()));
        assert!(most < 5e-4, "{most}");
        assert_eq!(resample(&[0.5; 100], f64::NAN, 16_000.0), Vec::<f64>::new());
    }
}
