//! Measures of strokes with both hands: the share in which the hands are exact mirror images.

use raconteur_actor::gesture::PlannedKey;
use raconteur_base::{DVec3, Length, Side, mirror_vector, order};

use super::Measure;
use super::recording::{CUTOFF_HZ, Recording};
use crate::Player;

/// Time between the starts of both hands' strokes in one with both hands, seconds.
const TOGETHER_SECS: f64 = 0.2;
/// Time before a stroke that is compared, seconds.
const BEFORE_SECS: f64 = 0.2;
/// Time after the next key of a stroke that is compared, seconds.
const AFTER_SECS: f64 = 0.3;
/// Maximum distance of a wrist from the mirror image of the other one, metres.
const EXACT_M: f64 = 0.008;
/// Speed of both wrists above which they are compared below the waist, too, metres per second.
const MOVING_M_S: f64 = 0.1;

/// A stroke of one or both hands: its start, and the arrival of its next key, seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
struct StrokeSpan {
    start_secs: f64,
    end_secs: f64,
}

/// Returns the number of strokes with both hands in which the hands can be compared, and the shares
/// of exact mirror images among them: in the frame of the chest, and in that of the figure, in
/// which gestures keep their place while the trunk sways. The hands are compared while both move or
/// both are above the waist.
pub(super) fn measures(player: &Player, recording: &Recording) -> [Measure; 3] {
    let strokes = Side::BOTH.map(|side| strokes(player.planned_keys(side)));
    let mirrored = MirroredWrists::new(recording);
    let interval = recording.time_secs(0)..=recording.time_secs(recording.len());
    let exact: Vec<[bool; 2]> = together(&strokes)
        .into_iter()
        .filter(|stroke| interval.contains(&stroke.start_secs))
        .filter_map(|stroke| mirrored.is_exact(recording, stroke))
        .collect();
    let count = exact.len() as f64;
    let share = |frame: usize| {
        let hits = exact.iter().filter(|exact| exact[frame]).count() as f64;
        (count > 0.0).then(|| 1e2 * hits / count)
    };
    [
        Measure::new("two-hand-strokes", "", Some(count)),
        Measure::new("two-hand-strokes-mirrored-chest", "%", share(0)),
        Measure::new("two-hand-strokes-mirrored-figure", "%", share(1)),
    ]
}

/// Returns the strokes of one hand, by time.
fn strokes(keys: &[PlannedKey]) -> Vec<StrokeSpan> {
    let placed = keys.iter().filter(|key| key.wrist_in_world.is_some());
    let mut keys: Vec<&PlannedKey> = placed.collect();
    order::sort_by_number(&mut keys, |key| key.time_secs);
    let starts = keys.iter().enumerate().filter(|(_, key)| key.begins_stroke);
    let spans = starts.map(|(i, key)| {
        let next = keys.get(i + 1).filter(|next| !next.begins_stroke);
        StrokeSpan {
            start_secs: key.time_secs,
            end_secs: next.unwrap_or(key).arrives_secs,
        }
    });
    spans.collect()
}

/// Returns the strokes that both hands begin together.
fn together([left, right]: &[Vec<StrokeSpan>; 2]) -> Vec<StrokeSpan> {
    let mut left = left.iter().peekable();
    let mut found = Vec::new();
    for right in right {
        while left
            .next_if(|l| l.start_secs < right.start_secs - TOGETHER_SECS)
            .is_some()
        {}
        if let Some(left) = left.next_if(|l| l.start_secs <= right.start_secs + TOGETHER_SECS) {
            found.push(StrokeSpan {
                start_secs: left.start_secs.min(right.start_secs),
                end_secs: left.end_secs.max(right.end_secs),
            });
        }
    }
    found
}

/// Comparison of both wrists at all samples.
struct MirroredWrists {
    /// Distance of the right wrist from the mirror image of the left one, in the frames of chest
    /// and figure, metres; `None` while the hands are not compared.
    off_m: Vec<Option<[f64; 2]>>,
}

impl MirroredWrists {
    fn new(recording: &Recording) -> Self {
        let [left, right] = &recording.wrists;
        let speeds = [left, right].map(|places| recording.speeds_m_s(places, CUTOFF_HZ));
        let off_m = (0..recording.len()).map(|i| {
            let waist = recording.waist_m[i];
            let are_moving = speeds.iter().all(|speeds| speeds[i] > MOVING_M_S);
            let are_up = left[i].y > waist && right[i].y > waist;
            (are_moving || are_up).then(|| {
                let chest = recording.chest[i].inverse();
                let in_chest = |p: DVec3| chest * (p - recording.chest_at[i]);
                [
                    mirror_vector(in_chest(left[i])).distance_to(in_chest(right[i])),
                    mirror_vector(left[i]).distance_to(right[i]),
                ]
            })
        });
        Self {
            off_m: off_m.collect(),
        }
    }

    /// Returns true for each frame in which the hands are mirror images throughout a stroke; `None`
    /// if they are never compared in it.
    fn is_exact(&self, recording: &Recording, stroke: StrokeSpan) -> Option<[bool; 2]> {
        let secs = stroke.start_secs - BEFORE_SECS..=stroke.end_secs + AFTER_SECS;
        let compared = self.off_m.get(recording.samples(&secs))?.iter().flatten();
        let worst = compared
            .copied()
            .reduce(|a, b| [a[0].max(b[0]), a[1].max(b[1])])?;
        Some(worst.map(|off_m| off_m <= EXACT_M))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(time_secs: f64, begins_stroke: bool) -> PlannedKey {
        PlannedKey {
            time_secs,
            arrives_secs: time_secs + 0.01,
            wrist_in_world: Some(DVec3::ZERO),
            begins_stroke,
        }
    }

    #[test]
    fn strokes_end_with_their_next_key_and_pair_once() {
        let left = strokes(&[key(1.1, true), key(1.5, false), key(3.0, true)]);
        let right = strokes(&[key(1.0, true), key(1.2, true), key(2.7, true)]);
        let ends: Vec<f64> = left.iter().map(|s| s.end_secs).collect();
        assert_eq!(ends, [1.51, 3.01]);
        let both = together(&[left, right]);
        let span = StrokeSpan {
            start_secs: 1.0,
            end_secs: 1.51,
        };
        assert_eq!(both, [span]);
    }
}
