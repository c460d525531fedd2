//! Intensity of audio over time, in decibels relative to full scale: 0 dB is the power of a
//! constant 1 (a full sine is at −3.01 dB).

use std::f64::consts::PI;

use raconteur_base::ops;

use super::is_rate;

/// Level of silence, in decibels: below the noise of 24 bits.
pub const SILENCE_DB: f64 = -150.0;

/// Returns ten times the decimal logarithm of a power ratio, at least [`SILENCE_DB`].
#[must_use]
pub fn decibels(power: f64) -> f64 {
    if power > 0.0 {
        (10.0 * ops::ln(power) / std::f64::consts::LN_10).max(SILENCE_DB)
    } else {
        SILENCE_DB
    }
}

/// Returns the root mean square; 0 for an empty slice.
#[must_use]
pub fn rms(samples: &[f64]) -> f64 {
    (samples.iter().map(|x| x * x).sum::<f64>() / samples.len().max(1) as f64).sqrt()
}

/// Returns the level of a span of the audio, start and end in seconds; [`SILENCE_DB`] for a span
/// without samples.
#[must_use]
pub fn span_db(samples: &[f64], rate_hz: f64, start_secs: f64, end_secs: f64) -> f64 {
    let level = rms(span(samples, rate_hz, start_secs, end_secs));
    decibels(level * level)
}

/// Returns the samples between two times, limited to the existing ones.
pub(super) fn span(samples: &[f64], rate_hz: f64, start_secs: f64, end_secs: f64) -> &[f64] {
    let at = |secs: f64| ((secs * rate_hz).round().max(0.0) as usize).min(samples.len());
    let (start, end) = (at(start_secs), at(end_secs));
    samples.get(start..end).unwrap_or(&[])
}

/// Level along an audio, decibels. Value `i` is the level around `i * step_secs`.
#[derive(Clone, Debug, PartialEq)]
pub struct Intensity {
    /// Time between values, in seconds.
    pub step_secs: f64,
    /// Decibels relative to full scale.
    pub db: Vec<f64>,
}

impl Intensity {
    /// Returns the level at a time, decibels: linear between values, constant beyond the ends;
    /// [`SILENCE_DB`] for a track without values.
    #[must_use]
    pub fn db_at(&self, secs: f64) -> f64 {
        let Some(last) = self.db.len().checked_sub(1) else {
            return SILENCE_DB;
        };
        let place = (secs / self.step_secs).clamp(0.0, last as f64);
        let low = (place as usize).min(last);
        let part = place - low as f64;
        let high = self.db[(low + 1).min(last)];
        self.db[low] + part * (high - self.db[low])
    }
}

/// Returns the level along a sound, every `step_secs` (clamped to 0.001..1), each the power under a
/// raised cosine `window_secs` long (clamped to 0.001..1). To avoid ripple from the voice's
/// periods, use 3.2 divided by the lowest frequency, like Praat; 0.032 is for 100 Hz. At the
/// sound's ends the window covers only existing samples.
#[must_use]
pub fn intensity(samples: &[f64], rate_hz: f64, step_secs: f64, window_secs: f64) -> Intensity {
    let sane = |secs: f64| {
        if secs.is_nan() {
            1.0
        } else {
            secs.clamp(0.001, 1.0)
        }
    };
    let step_secs = sane(step_secs);
    let mut made = Intensity {
        step_secs,
        db: Vec::new(),
    };
    if samples.is_empty() || !is_rate(rate_hz) {
        return made;
    }
    let half = (0.5 * sane(window_secs) * rate_hz).round().max(1.0) as usize;
    let window: Vec<f64> = (0..=2 * half)
        .map(|i| 0.5 + 0.5 * ops::cos(PI * (i as f64 - half as f64) / (half as f64 + 1.0)))
        .collect();
    let frames = (samples.len() as f64 / (step_secs * rate_hz)) as usize + 1;
    for frame in 0..frames {
        let centre = (frame as f64 * step_secs * rate_hz).round() as usize;
        let (mut sum, mut weights) = (0.0, 0.0);
        for (i, w) in window.iter().enumerate() {
            let at = (centre + i).checked_sub(half);
            if let Some(x) = at.and_then(|at| samples.get(at)) {
                sum += w * x * x;
                weights += w;
            }
        }
        made.db
            .push(decibels(if weights > 0.0 { sum / weights } else { 0.0 }));
    }
    made
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tone_has_the_level_of_its_amplitude() {
        let rate = 16_000.0;
        let tone: Vec<f64> = (0..16_000)
            .map(|i| {
                let amplitude = if i < 8000 { 1.0 } else { 0.1 };
                amplitude * ops::sin(2.0 * PI * 200.0 * f64::from(i) / rate)
            })
            .collect();
        let level = intensity(&tone, rate, 0.01, 0.032);
        assert_eq!(level.db.len(), 101);
        for (i, &db) in level.db.iter().enumerate() {
            let truth = if i < 50 { -3.0103 } else { -23.0103 };
            if i.abs_diff(50) > 1 && (1..100).contains(&i) {
                assert!((db - truth).abs() < 0.05, "{i}: {db}");
            }
        }
        assert!(
            (level.db_at(0.255) + 3.01).abs() < 0.05,
            "the level of a full-scale tone"
        );
        assert!(
            (span_db(&tone, rate, 0.6, 0.9) + 23.01).abs() < 0.01,
            "the level of a quiet tone"
        );
        assert_eq!(span_db(&tone, rate, 5.0, 4.0), SILENCE_DB);
        assert_eq!(span_db(&tone, rate, f64::NAN, 0.0), SILENCE_DB);
        assert!(
            (rms(&tone[..8000]) - 0.5_f64.sqrt()).abs() < 1e-9,
            "the root mean square of a tone"
        );
    }

    #[test]
    fn nothing_is_silence() {
        assert_eq!(rms(&[]), 0.0);
        assert!(
            intensity(&[], 16_000.0, 0.01, 0.03).db.is_empty(),
            "empty audio has no intensity frames"
        );
        assert!(
            intensity(&[1.0], f64::NAN, f64::NAN, 0.03).db.is_empty(),
            "an invalid sample rate has no intensity frames"
        );
        assert_eq!(intensity(&[0.0; 99], 8000.0, 0.01, 0.03).db[0], SILENCE_DB);
        let none = Intensity {
            step_secs: 0.01,
            db: Vec::new(),
        };
        assert_eq!(none.db_at(0.0), SILENCE_DB);
    }
}
