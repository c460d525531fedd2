//! Head and brow motion that follows the pitch: raised at its maxima, back at its minima (F&H
//! sections 4.2.1 and 4.3.5).

use raconteur_base::curve::lerp;
use raconteur_base::noise;

use super::Manner;
use super::extreme::Extreme;
use super::speech_features::{BoundaryKind, SpeechFeatures};
use super::track::Track;
use crate::idle::stream;

/// Head raise at the highest pitch, radians: 3° (F&H section 4.2.1).
pub const HEAD_RAISE_RAD: f64 = 3.0 * core::f64::consts::PI / 180.0;
/// The largest tilt to a side with a raise, radians. Designed: "slightly".
const TILT_RAD: f64 = 0.04;
/// Time after which it may be to the other side, seconds. Designed.
const SIDE_SECS: f64 = 3.0;
/// Contraction of the frontalis on the left at the highest pitch. Designed.
const LEFT_BROW: f64 = 0.6;
/// Contraction of the right frontalis at every raise: only the left brow follows the pitch (Cavé et
/// al. 1996 in F&H section 4.2.1).
const RIGHT_BROW: f64 = 0.4;
/// Height of a raise that marks a question. Designed.
const QUESTION: f64 = 0.85;
/// Time between two keys at least, seconds: 3° in it are a quick nod. Designed.
const MIN_SECS: f64 = 0.16;
/// Maximum duration of a movement, seconds, whatever the distance of the extrema. Designed.
const MAX_SECS: f64 = 0.8;
/// Time in which head and brows are lowered when speech ends, seconds. Designed.
const DOWN_SECS: f64 = 0.35;

/// Raises of head and brows with the pitch over the story, before scaling by the amounts in force
/// at the time.
#[derive(Clone, Debug, Default)]
pub(super) struct Raises {
    /// Raise of the head, radians.
    pub(super) head: Track,
    /// Tilt of the head to the left, radians.
    pub(super) tilt: Track,
    /// Contraction of the left and right frontalis.
    pub(super) brows: [Track; 2],
}

impl Raises {
    /// Plans raises of head and brows from the pitch contour of speech.
    pub(super) fn new(
        heard: &SpeechFeatures,
        loudness: &Track,
        manner: &Manner,
        seed: u64,
    ) -> Self {
        let mut raises = Self::default();
        for (i, extreme) in keys(heard).iter().enumerate() {
            let Extreme {
                at_secs,
                height,
                is_question,
            } = *extreme;
            let r = |k: u64| noise::unit(seed, stream::RAISE + k, i as i64);
            let is_up = height > 0.0;
            let loud = loudness.sample(at_secs);
            let head = manner.head * lerp(1.0, loud, manner.head_by_loudness);
            push(&mut raises.head, at_secs, HEAD_RAISE_RAD * height * head);
            // The same side for a while, or the head would bob.
            let stretch = (at_secs / SIDE_SECS).floor() as i64;
            let is_left = noise::unit(seed, stream::RAISE + 1, stretch) < 0.5;
            let side = if is_left { 1.0 } else { -1.0 };
            let tilts = is_up && r(0) < manner.tilt_share;
            let tilt = if tilts {
                side * (0.4 + 0.6 * r(2))
            } else {
                0.0
            };
            push(&mut raises.tilt, at_secs, TILT_RAD * tilt * head);
            let is_raised = is_up && (is_question || r(3) < manner.brow_share);
            let brows = manner.brows * lerp(1.0, loud, manner.brows_by_loudness);
            let brows = if is_raised { brows } else { 0.0 };
            for (brow, size) in raises
                .brows
                .iter_mut()
                .zip([LEFT_BROW * height, RIGHT_BROW])
            {
                push(brow, at_secs, size * brows);
            }
        }
        raises
    }
}

/// Adds a key; a movement from a key long before begins later.
fn push(track: &mut Track, at_secs: f64, value: f64) {
    let last = track.last();
    if track.end_secs() < at_secs - MAX_SECS {
        track.push(at_secs - MAX_SECS, last);
    }
    track.push(at_secs, value);
}

/// Returns the extrema as shown: at phone boundaries, those of questions replacing the pitch there,
/// with a descent after each utterance.
fn keys(heard: &SpeechFeatures) -> Vec<Extreme> {
    let extremes = &heard.extremes;
    let mut all: Vec<Extreme> = Vec::with_capacity(extremes.len() + 4 * heard.questions.len());
    let in_question = |at_secs: f64| {
        let after = heard
            .questions
            .partition_point(|q| q.last_word_secs[0] - MIN_SECS <= at_secs);
        let before = after.checked_sub(1).map(|i| &heard.questions[i]);
        before.is_some_and(|q| at_secs < q.end_secs + DOWN_SECS + MIN_SECS)
    };
    // Head and brows are lowered at the end of a sentence.
    let pauses = heard
        .pauses
        .iter()
        .filter(|p| p.parts >= BoundaryKind::Sentences);
    let ends = pauses.map(|p| p.end_secs.min(p.start_secs + DOWN_SECS));
    let ends = ends.chain(heard.turns.iter().map(|turn| turn[2] + DOWN_SECS));
    let ends = ends.map(|at_secs| Extreme {
        at_secs,
        height: 0.0,
        is_question: false,
    });
    let pitch = extremes.iter().copied().chain(ends);
    all.extend(pitch.filter(|e| !in_question(e.at_secs)));
    for q in &heard.questions {
        let [start, end] = q.last_word_secs;
        let up_secs = (start + 0.35).min(end).max(start + MIN_SECS);
        let key = |at_secs: f64, height: f64| Extreme {
            at_secs,
            height,
            is_question: true,
        };
        let held_secs = q.end_secs.max(up_secs + MIN_SECS);
        all.extend([
            key(start, 0.0),
            key(up_secs, QUESTION),
            key(held_secs, QUESTION),
            key(held_secs + DOWN_SECS, 0.0),
        ]);
    }
    raconteur_base::order::sort_by_number(&mut all, |e| e.at_secs);
    let mut shown: Vec<Extreme> = Vec::with_capacity(all.len());
    for mut extreme in all {
        extreme.at_secs = heard.snapped(extreme.at_secs);
        // Of two that are too near to each other the higher one stays.
        match shown.last_mut() {
            Some(last) if extreme.at_secs < last.at_secs + MIN_SECS => {
                if extreme.height > last.height && !last.is_question {
                    let at_secs = last.at_secs;
                    *last = Extreme { at_secs, ..extreme };
                }
            }
            _ => shown.push(extreme),
        }
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::super::PlanBasis;
    use super::super::tests::speech::{hour, shipped};
    use super::*;

    #[test]
    fn head_and_brows_turn_on_phone_boundaries() {
        for (speech, way) in [
            (hour(8), PlanBasis::Audio),
            (hour(8), PlanBasis::Text),
            (shipped(), PlanBasis::Audio),
        ] {
            let manner = Manner {
                basis: way,
                ..Manner::default()
            };
            let heard = SpeechFeatures::new(&speech.iter().collect::<Vec<_>>(), &manner, 1);
            let keys = keys(&heard);
            assert!(
                keys.len() > speech.len(),
                "there are more keys than speech segments"
            );
            for pair in keys.windows(2) {
                assert!(
                    pair[1].at_secs - pair[0].at_secs >= MIN_SECS - 1e-9,
                    "keys are at least the minimum time apart"
                );
            }
            let on = |key: &&Extreme| {
                let boundaries = &heard.boundaries;
                boundaries
                    .binary_search_by(|b| b.total_cmp(&key.at_secs))
                    .is_ok()
            };
            // Only keys after the speech are off the boundaries.
            let in_pause = |key: &&Extreme| {
                heard
                    .boundary_within(key.at_secs, key.at_secs - 0.2, key.at_secs + 0.2)
                    .is_none()
            };
            let off = keys.iter().filter(|key| !on(key) && !in_pause(key)).count();
            assert_eq!(off, 0);
            let share = keys.iter().filter(on).count() as f64 / keys.len() as f64;
            assert!(share > 0.9, "{share}");
        }
    }

    #[test]
    fn the_head_comes_back_and_stays_within_its_bounds() {
        let key = |at_secs: f64, height: f64| Extreme {
            at_secs,
            height,
            is_question: false,
        };
        let heard = SpeechFeatures {
            boundaries: vec![1.0, 1.5, 2.04, 2.6, 9.0],
            extremes: vec![
                key(1.05, 0.0),
                key(1.46, 1.0),
                key(2.0, 0.0),
                key(2.07, 0.4),
                key(9.0, 0.5),
            ],
            ..SpeechFeatures::default()
        };
        let manner = Manner {
            head_by_loudness: 0.0,
            ..Manner::default()
        };
        let raises = Raises::new(&heard, &Track::default(), &manner, 4);
        let head = |t: f64| raises.head.sample(t) / HEAD_RAISE_RAD;
        assert_eq!(head(1.0), 0.0);
        assert!(
            (head(1.5) - 1.0).abs() < 1e-12,
            "the head is at its apex at 1.5 s"
        );
        // Two at one boundary: the higher one counts. A far target is approached late.
        assert!(
            (head(2.04) - 0.4).abs() < 1e-12 && head(8.19) == head(2.04),
            "of two keys at one boundary, the higher one counts"
        );
        assert!(
            (head(9.0) - 0.5).abs() < 1e-12,
            "the head is at half height at 9 s"
        );
    }
}
