//! Intensity of modified audio: preserved where only pitch changed, and the requested gain.

use super::super::intensity::{Intensity, SILENCE_DB, intensity};
use super::super::rigid::CELL_SECS;
use super::{Changed, GAIN_RAMP_SECS};
use raconteur_base::ops;

/// Interval of level comparisons, and the window of each: several periods of the lowest voice, so
/// that single pulses are not flattened.
const STEP_SECS: f64 = 0.01;
const WINDOW_SECS: f64 = 0.06;

/// Maximum level correction, in decibels: harmonics that move over a formant change the level by a
/// few.
const MAX_DB: f64 = 6.0;

/// Gives the changed sound, within its spans (start and end in seconds of the new sound), the level
/// of the original at the same positions.
pub(super) fn keep_level(
    changed: &mut Changed,
    samples: &[f64],
    rate_hz: f64,
    spans: &[(f64, f64)],
) {
    let old = intensity(samples, rate_hz, STEP_SECS, WINDOW_SECS);
    let new = intensity(&changed.samples, rate_hz, STEP_SECS, WINDOW_SECS);
    for &(start, end) in spans {
        let first = (start * rate_hz).max(0.0) as usize;
        let past = ((end * rate_hz).max(0.0) as usize).min(changed.samples.len());
        for i in first..past {
            let secs = i as f64 / rate_hz;
            // Faded in and out, because a span borders on correct audio at its edges.
            let edge = ((secs - start).min(end - secs) / STEP_SECS).clamp(0.0, 1.0);
            let db = correction(&old, &new, changed.times.before(secs), secs) * edge;
            changed.samples[i] *= ops::pow(10.0, db / 20.0);
        }
    }
}

/// Decibels by which the new level falls short of the old.
fn correction(old: &Intensity, new: &Intensity, old_secs: f64, new_secs: f64) -> f64 {
    let (old, new) = (old.db_at(old_secs), new.db_at(new_secs));
    if old <= SILENCE_DB || new <= SILENCE_DB {
        return 0.0;
    }
    (old - new).clamp(-MAX_DB, MAX_DB)
}

/// Multiplies by the gain at the time that a sample had, its jumps made ramps.
pub(super) fn apply_gain(
    changed: &mut Changed,
    rate_hz: f64,
    length_secs: f64,
    gain: &dyn Fn(f64) -> f64,
) {
    let count = (length_secs / CELL_SECS).ceil() as usize + 1;
    let asked: Vec<f64> = (0..count)
        .map(|i| {
            let factor = gain((i as f64 * CELL_SECS).min(length_secs));
            if factor.is_nan() {
                1.0
            } else {
                factor.clamp(0.0, 100.0)
            }
        })
        .collect();
    if asked.iter().all(|g| *g == 1.0) {
        return;
    }
    let reach = (0.5 * GAIN_RAMP_SECS / CELL_SECS) as usize;
    let ramped: Vec<f64> = (0..count)
        .map(|i| {
            let near = &asked[i.saturating_sub(reach)..(i + reach + 1).min(count)];
            near.iter().sum::<f64>() / near.len() as f64
        })
        .collect();
    for (i, x) in changed.samples.iter_mut().enumerate() {
        let cell = changed.times.before(i as f64 / rate_hz) / CELL_SECS;
        let low = (cell.max(0.0) as usize).min(count - 1);
        let high = (low + 1).min(count - 1);
        let part = (cell - low as f64).clamp(0.0, 1.0);
        *x *= ramped[low] + part * (ramped[high] - ramped[low]);
    }
}
