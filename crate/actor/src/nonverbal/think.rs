//! Speaker behaviour in silence: planning the next words, searching for words and moistening the
//! lips (F&H section 4.2.1).

use raconteur_base::noise;

use super::Manner;
use super::speech_features::{BoundaryKind, SpeechFeatures};
use super::track::Track;
use crate::idle::stream;

/// Time in which brows show a thought, seconds. Designed.
const BROW_SECS: f64 = 0.4;
/// A pause must be this long for the lips to be moistened, seconds. Designed.
const LICK_PAUSE_SECS: f64 = 0.35;
/// Duration of moistening the lips, seconds. Designed.
const LICK_SECS: f64 = 0.5;
/// Factor by which a thinking speaker moves more slowly. Designed; F&H state only the slowing.
const SLOWER: f64 = 1.8;

/// Pause in which the speaker thinks or searches for a word, with the direction of the eyes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ThinkingPause {
    pub(super) start_secs: f64,
    pub(super) end_secs: f64,
    /// Direction of the eyes: yaw (left) and pitch (down), radians.
    pub(super) place: [f64; 2],
}

/// Returns the thinking pauses of a story, sorted by time.
pub(super) fn thoughts(heard: &SpeechFeatures, manner: &Manner, seed: u64) -> Vec<ThinkingPause> {
    let mut thoughts = Vec::new();
    for (i, pause) in heard.pauses.iter().enumerate() {
        let r = |k: u64| noise::unit(seed, stream::THINK + k, i as i64);
        let length_secs = pause.end_secs - pause.start_secs;
        let is_inside =
            pause.parts < BoundaryKind::Sentences && length_secs >= manner.thinking_secs;
        let is_asked = heard.question_at(pause.start_secs).is_some();
        if !(is_inside || pause.is_filled) || is_asked || r(0) >= manner.thinking_share {
            continue;
        }
        // The gaze goes to the floor or into the air, and slightly to the speaker's right, as in
        // word search (Andersen 1999 in F&H section 4.3.5).
        let pitch = if r(1) < manner.frown_share {
            0.24
        } else {
            -0.21
        };
        thoughts.push(ThinkingPause {
            start_secs: pause.start_secs,
            end_secs: pause.end_secs,
            place: [-0.07 - 0.07 * r(2), pitch * (0.85 + 0.3 * r(3))],
        });
    }
    thoughts
}

/// Returns the brow track of the thoughts: 1 raised, −1 drawn together.
pub(super) fn brows(thoughts: &[ThinkingPause]) -> Track {
    let mut brows = Track::default();
    for thought in thoughts {
        let length_secs = BROW_SECS.min(0.5 * (thought.end_secs - thought.start_secs));
        let to = if thought.place[1] < 0.0 { 1.0 } else { -1.0 };
        brows.move_to(thought.start_secs, length_secs, to);
        brows.move_to(thought.end_secs - length_secs, length_secs, 0.0);
    }
    brows
}

/// Returns the track of moistening the lips, 0 to 1: in the first long pause after each interval.
pub(super) fn licks(
    heard: &SpeechFeatures,
    thoughts: &[ThinkingPause],
    manner: &Manner,
    seed: u64,
) -> Track {
    let mut licks = Track::default();
    let mut next_secs = f64::NEG_INFINITY;
    for (i, pause) in heard.pauses.iter().enumerate() {
        let room_secs = pause.end_secs - pause.start_secs;
        if room_secs < LICK_PAUSE_SECS || pause.is_filled || pause.start_secs < next_secs {
            continue;
        }
        let u = noise::unit(seed, stream::LICK, i as i64);
        let is_first = next_secs == f64::NEG_INFINITY;
        next_secs = pause.start_secs + manner.lick_secs * (0.6 + 0.6 * u);
        // The mouth has just started to speak.
        if is_first && u > 0.3 {
            continue;
        }
        let after = thoughts.partition_point(|t| t.start_secs < pause.start_secs);
        let thinks = thoughts
            .get(after)
            .is_some_and(|t| t.start_secs == pause.start_secs);
        let length_secs = if thinks {
            SLOWER * LICK_SECS
        } else {
            LICK_SECS
        };
        let length_secs = length_secs.min(0.9 * room_secs);
        let start_secs = pause.start_secs + 0.5 * (room_secs - length_secs).min(0.2);
        for (share, value) in [(0.0, 0.0), (0.4, 1.0), (0.6, 1.0), (1.0, 0.0)] {
            licks.push(start_secs + share * length_secs, value);
        }
    }
    licks
}

#[cfg(test)]
mod tests {
    use super::super::speech_features::Pause;
    use super::*;

    #[test]
    fn who_looks_for_a_word_shows_it_and_moistens_the_lips_slowly() {
        let pause = |start_secs: f64, secs: f64, parts: BoundaryKind, is_filled: bool| Pause {
            start_secs,
            end_secs: start_secs + secs,
            parts,
            is_filled,
        };
        let heard = SpeechFeatures {
            pauses: vec![
                pause(1.0, 0.3, BoundaryKind::Words, false),
                pause(2.0, 1.0, BoundaryKind::Words, false),
                pause(5.0, 1.0, BoundaryKind::Sentences, false),
                pause(9.0, 0.4, BoundaryKind::Phrases, true),
            ],
            ..SpeechFeatures::default()
        };
        let manner = Manner {
            frown_share: 1.0,
            ..Manner::default()
        };
        let thoughts = thoughts(&heard, &manner, 1);
        let starts: Vec<f64> = thoughts.iter().map(|t| t.start_secs).collect();
        assert_eq!(starts, [2.0, 9.0]);
        let brows = brows(&thoughts);
        assert_eq!(
            [1.9, 2.5, 3.1, 9.2].map(|t| brows.sample(t)),
            [0.0, -1.0, 0.0, -1.0]
        );
        let manner = Manner {
            lick_secs: 1.0,
            ..manner
        };
        let lengths = |from: f64| {
            let all = (0..20).map(|seed| {
                let licks = licks(&heard, &thoughts, &manner, seed);
                let out = |i: &i32| licks.sample(from + f64::from(*i) * 0.001) > 0.0;
                (0..1000).filter(out).count()
            });
            all.collect::<Vec<_>>()
        };
        let plain = lengths(5.0);
        assert!(plain.iter().all(|ms| (450..510).contains(ms)), "{plain:?}");
        // The first pause of all counts at times.
        let slow = lengths(2.0);
        assert!(
            slow.iter().any(|ms| *ms > 850) && slow.contains(&0),
            "{slow:?}"
        );
        assert!(slow.iter().all(|ms| *ms == 0 || *ms > 850), "{slow:?}");
        assert!(
            lengths(9.0).iter().all(|ms| *ms == 0),
            "the lips are not moistened in any pause"
        );
    }
}
