//! Relative loudness over the story (F&H section 4.2.1, "Volume-controlled Intensity").

use raconteur_base::curve::ramp;
use raconteur_speech::TimedUtterance;
use raconteur_speech::bundle::{FRAME_SECS, db_of_code};

use super::contour::{approximate, extrema};
use super::track::Track;
use crate::articulation::ORDINARY_LOUDNESS;

/// Minimum range from the quietest to the loudest, decibels, so even speech is not exaggerated to
/// whispers and shouts. Designed.
const MIN_RANGE_DB: f64 = 12.0;
/// Peaks this far below the loudest are noise and breath, decibels. Designed.
const SPEECH_DB: f64 = 35.0;

/// Returns the loudness at the maxima of the intensity curve: 0 at the quietest, 1 at the loudest
/// of all utterances, and [`ORDINARY_LOUDNESS`] at their mean and where it is unknown; between
/// maxima the cubic steps of a track, which do not overshoot.
pub(super) fn track(utterances: &[&TimedUtterance]) -> Track {
    let mut peaks: Vec<(f64, f64)> = Vec::new();
    for u in utterances {
        let intensity = u.utterance.intensity.iter();
        let frames: Vec<f64> = intensity.map(|code| db_of_code(*code)).collect();
        let curve = approximate(&frames);
        let maxima = extrema(&curve).into_iter().filter(|e| e.is_max);
        peaks.extend(maxima.map(|e| (u.story_secs(e.frame as f64 * FRAME_SECS), curve[e.frame])));
    }
    let most = peaks
        .iter()
        .fold(f64::NEG_INFINITY, |most, p| most.max(p.1));
    peaks.retain(|p| p.1 > most - SPEECH_DB);
    let mean = peaks.iter().map(|p| p.1).sum::<f64>() / peaks.len().max(1) as f64;
    let least = peaks
        .iter()
        .fold(mean - MIN_RANGE_DB / 2.0, |least, p| least.min(p.1));
    let most = most.max(mean + MIN_RANGE_DB / 2.0);
    let mut track = Track::default();
    for (at_secs, db) in peaks {
        let quiet = ORDINARY_LOUDNESS * ramp(least, mean, db);
        let loud = (1.0 - ORDINARY_LOUDNESS) * ramp(mean, most, db);
        track.push(at_secs, quiet + loud);
    }
    if track == Track::default() {
        track.push(0.0, ORDINARY_LOUDNESS);
    }
    track
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_speech::Utterance;
    use raconteur_speech::bundle::code_of_db;
    use std::sync::Arc;

    #[test]
    fn louder_syllables_are_louder_and_pauses_do_not_count() {
        // A syllable every 0.3 s, the third 9 dB louder, then half a second of silence.
        let db = |i: usize| match i {
            120.. => -90.0,
            _ => {
                f64::from(u8::try_from(i % 30).unwrap().abs_diff(15)) * -1.5 - 20.0
                    + if i / 30 == 2 { 9.0 } else { 0.0 }
            }
        };
        let u = TimedUtterance {
            start_secs: 2.0,
            utterance: Arc::new(Utterance {
                intensity: (0..170).map(|i| code_of_db(db(i))).collect(),
                ..Utterance::default()
            }),
        };
        let track = track(&[&u]);
        assert!(
            (track.sample(2.75) - 1.0).abs() < 0.02,
            "{}",
            track.sample(2.75)
        );
        assert!(
            (track.sample(2.15) - 0.25).abs() < 0.1,
            "{}",
            track.sample(2.15)
        );
        assert!(
            (0..400).all(|i| (0.0..=1.0).contains(&track.sample(f64::from(i) * 0.01))),
            "the intensity stays between 0 and 1"
        );
        assert_eq!(super::track(&[]).sample(3.0), ORDINARY_LOUDNESS);
    }
}
