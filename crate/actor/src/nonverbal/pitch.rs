//! Extrema of the fundamental frequency (F&H section 4.2.1, "Facial Expressions from Pitch").

use raconteur_base::curve::lerp;
use raconteur_speech::TimedUtterance;
use raconteur_speech::bundle::{FRAME_SECS, semitones_of_code};

use super::accent::Accent;
use super::contour::{Extremum, approximate, between_turning_points, extrema};
use super::extreme::Extreme;

/// Fewer voiced frames than this are no melody.
const MIN_FRAMES: usize = 10;
/// Minimum pitch range assumed for a voice, semitones, so a monotonous speaker nods little.
/// Designed.
const MIN_RANGE: f64 = 6.0;
/// Length of a syllable that is only known by its pitch, seconds. Designed.
const SYLLABLE_SECS: f64 = 0.2;
/// The least height of a maximum, as a share of the range: it has stood out already.
const MIN_HEIGHT: f64 = 0.15;

/// Adds the pitch extrema of an utterance that exceed a threshold of prominence (semitones): maxima
/// with their height in the speaker's range, minima without. Returns false if too little of the
/// audio is known.
///
/// Heights are on a scale of semitones, not of hertz as in the thesis, so one threshold fits low
/// and high voices.
pub(super) fn extremes(timed: &TimedUtterance, threshold: f64, out: &mut Vec<Extreme>) -> bool {
    let f0 = &timed.utterance.f0;
    let Some(frames) = bridged(f0) else {
        return false;
    };
    let curve = approximate(&frames);
    let [low, high] = range(f0);
    // An extremum that differs from the last prominent one by less than the threshold is skipped,
    // so that a ripple in a valley does not keep the head raised.
    let mut prominent: Vec<(Extremum, f64)> = Vec::new();
    for extremum in extrema(&curve) {
        let (extremum, pitch) = measured(extremum, &curve, f0);
        let sign = if extremum.is_max { 1.0 } else { -1.0 };
        match prominent.last_mut() {
            Some((last, before)) if last.is_max == extremum.is_max => {
                if sign * pitch > sign * *before {
                    (*last, *before) = (extremum, pitch);
                }
            }
            Some((_, before)) if sign * (pitch - *before) <= threshold => {}
            _ => prominent.push((extremum, pitch)),
        }
    }
    // A single extremum means a voice without pitch motion.
    if prominent.len() > 1 {
        out.extend(prominent.iter().map(|(extremum, pitch)| {
            let height = ((pitch - low) / (high - low)).clamp(MIN_HEIGHT, 1.0);
            Extreme {
                at_secs: timed.story_secs(extremum.frame as f64 * FRAME_SECS),
                height: if extremum.is_max { height } else { 0.0 },
                is_question: false,
            }
        }));
    }
    true
}

/// Returns the accents of an utterance without known accents: around the maxima of its pitch.
pub(super) fn accents(timed: &TimedUtterance, extremes: &[Extreme]) -> Vec<Accent> {
    let maxima = extremes.iter().filter(|e| e.height > 0.0);
    maxima
        .map(|e| Accent {
            start_secs: timed.offset_secs(e.at_secs) - SYLLABLE_SECS / 2.0,
            end_secs: timed.offset_secs(e.at_secs) + SYLLABLE_SECS / 2.0,
            strength: 1.0,
            label: String::new(),
        })
        .collect()
}

/// Returns the measured frame that an extremum of the curve represents, and its pitch: the highest
/// or lowest frame between the curve's inflection points.
fn measured(extremum: Extremum, curve: &[f64], f0: &[u8]) -> (Extremum, f64) {
    let (first, last) = between_turning_points(curve, extremum);
    let sign = if extremum.is_max { 1.0 } else { -1.0 };
    let mut best = (extremum.frame, None);
    for (frame, code) in f0.iter().enumerate().take(last + 1).skip(first) {
        if let Some(pitch) = semitones_of_code(*code)
            && best.1.is_none_or(|most| sign * pitch > sign * most)
        {
            best = (frame, Some(pitch));
        }
    }
    let (frame, pitch) = best;
    (
        Extremum { frame, ..extremum },
        pitch.unwrap_or(curve[frame]),
    )
}

/// Returns the pitch at every frame in semitones, interpolated linearly over unvoiced intervals.
fn bridged(f0: &[u8]) -> Option<Vec<f64>> {
    let mut frames: Vec<f64> = Vec::with_capacity(f0.len());
    let (mut voiced, mut last) = (0, None);
    for (i, code) in f0.iter().enumerate() {
        let Some(pitch) = semitones_of_code(*code) else {
            continue;
        };
        voiced += 1;
        let from = frames.len();
        let before = last.unwrap_or(pitch);
        let steps = (i + 1 - from) as f64;
        frames.extend((from..=i).map(|k| lerp(before, pitch, (k + 1 - from) as f64 / steps)));
        last = Some(pitch);
    }
    frames.resize(f0.len(), last.unwrap_or_default());
    (voiced >= MIN_FRAMES).then_some(frames)
}

/// Returns the pitches below which a tenth and above which a twentieth of the voiced frames lie: a
/// voice's range without pitch errors.
fn range(f0: &[u8]) -> [f64; 2] {
    let mut counts = [0_usize; 256];
    for code in f0.iter().filter(|code| **code > 0) {
        counts[usize::from(*code)] += 1;
    }
    let all: usize = counts.iter().sum();
    let quantile = |tenths: f64| {
        let mut left = (all as f64 * tenths) as usize;
        let code = counts.iter().position(|count| {
            let is_here = left < *count;
            left = left.saturating_sub(*count);
            is_here
        });
        semitones_of_code(code.unwrap_or_default() as u8).unwrap_or_default()
    };
    let low = quantile(0.1);
    [low, quantile(0.95).max(low + MIN_RANGE)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::ops;
    use raconteur_speech::Utterance;
    use raconteur_speech::bundle::code_of_hz;
    use std::sync::Arc;

    /// Creates a test utterance with this pitch contour that starts at 10 s.
    fn sung(f0: Vec<u8>) -> TimedUtterance {
        TimedUtterance {
            start_secs: 10.0,
            utterance: Arc::new(Utterance {
                f0,
                ..Utterance::default()
            }),
        }
    }

    #[test]
    fn hills_of_the_voice_are_found_where_they_are_measured() {
        // Three hills of 6 semitones, the second too low; unvoiced every fifth of a second.
        let hill = |t: f64, at: f64| ops::exp(-(t - at) * (t - at) / 0.02);
        let code = |i: u32| {
            let t = f64::from(i) * 0.01;
            let semitones = 6.0 * hill(t, 0.5) + 0.8 * hill(t, 1.2) + 6.0 * hill(t, 1.9);
            if i % 20 < 4 {
                0
            } else {
                code_of_hz(120.0 * ops::exp(semitones / 12.0 * 0.693))
            }
        };
        let u = sung((0..240).map(code).collect());
        let mut out = Vec::new();
        assert!(extremes(&u, 2.0, &mut out), "the measured pitch is used");
        let maxima: Vec<f64> = out
            .iter()
            .filter(|e| e.height > 0.0)
            .map(|e| e.at_secs)
            .collect();
        assert_eq!(maxima.len(), 2, "{out:?}");
        assert!(
            (maxima[0] - 10.5).abs() < 0.03 && (maxima[1] - 11.9).abs() < 0.05,
            "{maxima:?}"
        );
        assert!(
            out.iter()
                .any(|e| e.height == 0.0 && e.at_secs > 10.6 && e.at_secs < 11.8),
            "a pitch minimum lies between the two maxima"
        );
    }

    #[test]
    fn a_sound_without_voice_has_no_melody() {
        for f0 in [vec![], vec![0; 500], vec![9; 3]] {
            let mut out = Vec::new();
            assert!(
                !extremes(&sung(f0), 2.0, &mut out) && out.is_empty(),
                "audio without voice has no pitch extrema"
            );
        }
        let flat = sung(vec![90; 300]);
        let mut out = Vec::new();
        assert!(
            extremes(&flat, 2.0, &mut out) && out.is_empty(),
            "a flat pitch has no extrema"
        );
    }
}
