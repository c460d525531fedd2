//! Releases of plosives: sudden rises of the energy above 2 kHz.

use super::filter::Biquad;
use super::intensity::{decibels, span};
use super::is_rate;

/// Sharp rise of high-frequency energy, as at the release of a plosive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Burst {
    /// Start time, in seconds.
    pub secs: f64,
    /// Level above 2 kHz in the 4 ms after over that in the 12 ms before, in decibels.
    pub rise_db: f64,
}

/// Minimum rise of a clear burst, in decibels (chosen: vowels after a glide or a nasal rise by less
/// within 4 ms).
pub const CLEAR_RISE_DB: f64 = 9.0;

/// Level above 2 kHz is that above this frequency, or above a quarter of a low rate.
const CORNER_HZ: f64 = 2000.0;
const AFTER_SECS: f64 = 0.004;
const BEFORE_SECS: f64 = 0.012;
const STEP_SECS: f64 = 0.0005;

/// Minimum distance between two bursts, seconds.
const APART_SECS: f64 = 0.03;

/// Level relative to the loudest parts that counts as silence, in decibels: a rise from digital
/// silence to last-bit noise is not a burst.
const FLOOR_DB: f64 = -50.0;

/// Time around a burst in which durations are preserved, in seconds before and after its start: the
/// burst's own 10 to 15 ms and some of the following sound.
const KEPT_SECS: (f64, f64) = (0.004, 0.02);

/// Returns all clear bursts of an audio in order. They include abrupt fricatives and vowels after
/// silence.
#[must_use]
pub fn all(samples: &[f64], rate_hz: f64) -> Vec<Burst> {
    find_all(samples, rate_hz, CLEAR_RISE_DB)
}

/// Returns the clearest burst between two times, in seconds; `None` if none is clear. To check a
/// plosive's label, pass its start and end extended by the tolerance.
#[must_use]
pub fn find(samples: &[f64], rate_hz: f64, start_secs: f64, end_secs: f64) -> Option<Burst> {
    if !is_rate(rate_hz) || start_secs.is_nan() || end_secs.is_nan() {
        return None;
    }
    // The threshold that judges the window, and its neighbourhood as the measure of loud.
    let from = (start_secs - 0.3).max(0.0);
    let from = (from * rate_hz).floor() / rate_hz;
    let part = span(samples, rate_hz, from, end_secs + 0.3);
    find_all(part, rate_hz, CLEAR_RISE_DB)
        .into_iter()
        .map(|b| Burst {
            secs: b.secs + from,
            ..b
        })
        .filter(|b| (start_secs..=end_secs).contains(&b.secs))
        .max_by(|a, b| a.rise_db.total_cmp(&b.rise_db))
}

/// Returns the spans (start, end) in seconds in which a change of duration must not double or smear
/// bursts: [`super::Change::rigid`].
#[must_use]
pub fn rigid_spans(bursts: &[Burst]) -> Vec<(f64, f64)> {
    let (before, after) = KEPT_SECS;
    bursts
        .iter()
        .map(|b| ((b.secs - before).max(0.0), b.secs + after))
        .collect()
}

fn find_all(samples: &[f64], rate_hz: f64, least_db: f64) -> Vec<Burst> {
    if samples.is_empty() || !is_rate(rate_hz) {
        return Vec::new();
    }
    let filter = Biquad::high_pass(rate_hz, CORNER_HZ.min(0.25 * rate_hz));
    let high = filter.run(samples);
    let mut sums = vec![0.0; high.len() + 1];
    for (i, y) in high.iter().enumerate() {
        sums[i + 1] = sums[i] + y * y;
    }
    let mean = |from: f64, to: f64| {
        let at = |secs: f64| ((secs * rate_hz).max(0.0) as usize).min(high.len());
        let (from, to) = (at(from), at(to));
        if to > from {
            (sums[to] - sums[from]) / (to - from) as f64
        } else {
            0.0
        }
    };
    let steps = (samples.len() as f64 / rate_hz / STEP_SECS) as usize;
    let after: Vec<f64> = (0..steps)
        .map(|k| mean(k as f64 * STEP_SECS, k as f64 * STEP_SECS + AFTER_SECS))
        .collect();
    let loudest = after.iter().copied().fold(0.0, f64::max);
    let floor = loudest * raconteur_base::ops::pow(10.0, FLOOR_DB / 10.0);
    if floor <= 0.0 || !floor.is_finite() {
        return Vec::new();
    }
    let rises: Vec<f64> = (0..steps)
        .map(|k| {
            let t = k as f64 * STEP_SECS;
            decibels((after[k] + floor) / (mean(t - BEFORE_SECS, t) + floor))
        })
        .collect();
    let apart = (APART_SECS / STEP_SECS) as usize;
    let mut found: Vec<Burst> = Vec::new();
    for (k, &rise_db) in rises.iter().enumerate() {
        let near = &rises[k.saturating_sub(apart)..(k + apart).min(steps)];
        if rise_db < least_db || near.iter().any(|r| *r > rise_db) {
            continue;
        }
        let secs = onset(&high, rate_hz, k as f64 * STEP_SECS);
        // Of equal neighbours the first is meant.
        if found
            .last()
            .is_none_or(|b| secs - b.secs > 0.5 * APART_SECS)
        {
            found.push(Burst { secs, rise_db });
        }
    }
    found
}

/// Returns the time of the first sample of a rise that reaches a quarter of its peak, seconds.
fn onset(high: &[f64], rate_hz: f64, near_secs: f64) -> f64 {
    let from = near_secs - 0.001;
    let part = span(high, rate_hz, from, near_secs + AFTER_SECS);
    let peak = part.iter().fold(0.0, |p: f64, y| p.max(y.abs()));
    let first = part
        .iter()
        .position(|y| y.abs() >= 0.25 * peak)
        .unwrap_or(0);
    ((from * rate_hz).round().max(0.0) + first as f64) / rate_hz
}

#[cfg(test)]
mod tests {
    use super::super::testing::{self, Segment};
    use super::*;

    #[test]
    fn a_burst_is_found_within_a_millisecond_and_nothing_else_is() {
        for rate in [8000.0, 16_000.0, 22_050.0, 48_000.0] {
            let parts = [
                Segment::silence(0.1),
                Segment::vowel(0.3, 120.0, 130.0),
                Segment::silence(0.05),
                Segment::burst(),
                Segment::vowel(0.3, 130.0, 100.0),
                Segment::silence(0.1),
            ];
            let (mut sound, _) = testing::utterance(rate, &parts);
            for (i, x) in sound.iter_mut().enumerate() {
                *x += 0.0005 * super::super::scatter(i as u64);
            }
            let burst = find(&sound, rate, 0.4, 0.5);
            assert!(
                burst.is_some_and(|b| (b.secs - 0.45).abs() < 0.001),
                "{rate} {burst:?}"
            );
            assert_eq!(find(&sound, rate, 0.5, 0.7), None, "{rate}");
            assert_eq!(find(&sound, rate, 0.2, 0.38), None, "{rate}");
            assert!(
                all(&sound, rate)
                    .iter()
                    .any(|b| (b.secs - 0.45).abs() < 0.001),
                "the burst is found within a millisecond"
            );
        }
    }

    #[test]
    fn no_sound_has_no_bursts() {
        assert!(all(&[], 16_000.0).is_empty(), "empty audio has no bursts");
        assert!(
            all(&[0.0; 3000], 16_000.0).is_empty(),
            "silence has no bursts"
        );
        assert!(
            all(&[f64::NAN; 3000], 16_000.0).is_empty(),
            "audio of NaN has no bursts"
        );
        assert_eq!(find(&[0.1; 3000], 16_000.0, f64::NAN, 1.0), None);
        assert_eq!(find(&[0.1; 3000], 16_000.0, 9.0, f64::INFINITY), None);
        let spans = rigid_spans(&[Burst {
            secs: 0.5,
            rise_db: 20.0,
        }]);
        assert_eq!(spans, vec![(0.496, 0.52)]);
    }
}
