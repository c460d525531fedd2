//! From gesture-keys of the timeline to strokes of the two arms.

use std::collections::BTreeMap;

use raconteur_actor::{GestureStroke, HandKey, Span as TimeSpan, palm};
use raconteur_base::decimal::fixed;
use raconteur_base::{DVec3, Side, mirror_vector};
use raconteur_body::HandShape;
use raconteur_eml::{
    ClauseKind, Coords, Diagnostic, Document, GestureKey, Handedness, Key, MotionKey, PalmKey,
    Timeline, Track,
};

use raconteur_stage::Room;

use crate::units::Units;

/// Rounds a time to the microsecond, so that keys of different tracks that mean one moment
/// meet in one key.
fn moment(offset_secs: f64) -> u64 {
    (offset_secs.max(0.0) * 1e6).round() as u64
}

/// The track that moves this hand: its own, else the common one. True when the common
/// one's values are meant for the other hand and must be mirrored (GEVH D.5.4: the
/// dominant hand is the right).
fn track_for<K>(
    tracks: &[Track<K>],
    side: Side,
    handedness: Handedness,
) -> Option<(&Track<K>, bool)> {
    if let Some(own) = tracks.iter().find(|t| t.hand == Some(side)) {
        return Some((own, false));
    }
    let common = tracks.iter().find(|t| t.hand.is_none())?;
    Some((common, handedness == Handedness::Both && side == Side::Left))
}

fn position(key: &Key<MotionKey>, mirrored: bool, units: &Units) -> DVec3 {
    let p = match key.value.coords {
        Coords::Speaker => units.speaker_point(key.value.position),
        Coords::World => units.world_point(key.value.position),
    };
    if mirrored { mirror_vector(p) } else { p }
}

fn hand_rotation(key: &PalmKey, side: Side, mirrored: bool) -> Option<raconteur_base::DQuat> {
    let mut normal = Units::axis(key.axis);
    let mut angle_rad = key.angle_deg.to_radians();
    if mirrored {
        normal = mirror_vector(normal);
        angle_rad = -angle_rad;
    }
    palm::hand_rotation(side, normal, angle_rad)
}

/// One hand's keys of one gesture, merged by time; empty when the gesture says nothing
/// about this hand.
fn keys(gesture: &GestureKey, side: Side, start_secs: f64, units: &Units) -> Vec<HandKey> {
    let mut by_time: BTreeMap<u64, HandKey> = BTreeMap::new();
    let mut at = |offset_secs: f64, set: &mut dyn FnMut(&mut HandKey)| {
        let key = by_time
            .entry(moment(offset_secs))
            .or_insert_with(|| HandKey {
                time_secs: start_secs + offset_secs,
                wrist_in_world: None,
                hand_in_world: None,
                shape: None,
            });
        set(key);
    };
    if let Some((track, _)) = track_for(&gesture.hand_shapes, side, gesture.handedness) {
        for key in &track.keys {
            at(key.offset_secs, &mut |k| {
                k.shape = HandShape::get(key.value.id).map(|s| *s.angles());
            });
        }
    }
    if let Some((track, mirrored)) = track_for(&gesture.palms, side, gesture.handedness) {
        for key in &track.keys {
            at(key.offset_secs, &mut |k| {
                k.hand_in_world = hand_rotation(&key.value, side, mirrored);
            });
        }
    }
    if let Some((track, mirrored)) = track_for(&gesture.motions, side, gesture.handedness) {
        for key in &track.keys {
            let p = position(key, mirrored, units);
            at(key.offset_secs, &mut |k| k.wrist_in_world = Some(p));
        }
    }
    by_time.into_values().collect()
}

/// When a script turns gestures on or off, by time.
#[must_use]
pub(crate) fn switches(document: &Document, timeline: &Timeline) -> Vec<(f64, bool)> {
    let clauses = timeline.clauses.iter();
    clauses
        .filter_map(|timed| match document.clause(timed.clause).kind {
            ClauseKind::GestureIsOn(is_on) => Some((timed.start_secs, is_on)),
            _ => None,
        })
        .collect()
}

/// Stretches of time in which gestures are on, from switches by time. They are on until one
/// turns them off.
#[must_use]
pub(crate) fn on_spans(switches: &[(f64, bool)]) -> Vec<TimeSpan> {
    let mut spans = Vec::new();
    let mut on_since = Some(0.0);
    for &(time_secs, is_on) in switches {
        match (on_since, is_on) {
            (None, true) => on_since = Some(time_secs),
            (Some(start_secs), false) => {
                spans.push(TimeSpan {
                    start_secs,
                    end_secs: time_secs,
                });
                on_since = None;
            }
            _ => {}
        }
    }
    if let Some(start_secs) = on_since {
        spans.push(TimeSpan {
            start_secs,
            end_secs: f64::INFINITY,
        });
    }
    spans
}

/// What a script asks of one arm.
#[must_use]
pub(crate) fn strokes(
    document: &Document,
    timeline: &Timeline,
    side: Side,
    units: &Units,
) -> Vec<GestureStroke> {
    timeline
        .clauses
        .iter()
        .filter_map(|timed| {
            let ClauseKind::GestureKey(gesture) = &document.clause(timed.clause).kind else {
                return None;
            };
            if !gesture.handedness.includes(side) {
                return None;
            }
            let keys = keys(gesture, side, timed.start_secs, units);
            (!keys.is_empty()).then_some(GestureStroke {
                start_secs: timed.start_secs,
                end_secs: timed.end_secs,
                keys,
            })
        })
        .collect()
}

/// The room that the strokes of both arms need in the picture.
pub(crate) fn room(strokes: &[Vec<GestureStroke>; 2], hand_length_m: f64) -> Room {
    let keys = strokes.iter().flatten().flat_map(|s| &s.keys);
    keys.filter_map(|k| k.wrist_in_world)
        .fold(Room::default(), |room, wrist| Room {
            top_m: room.top_m.max(wrist.y + hand_length_m),
            half_width_m: room.half_width_m.max(wrist.x.abs() + hand_length_m),
        })
}

/// What the arms of a figure can reach.
pub(crate) struct Reach {
    /// Left and right, world, metres.
    pub(crate) shoulders_in_world: [DVec3; 2],
    /// Length of an arm to the wrist, metres.
    pub(crate) arm_m: f64,
}

/// A warning for every position that the arm cannot reach; the hand goes as far towards it
/// as it can (GEVH fig. 3.6).
#[must_use]
pub(crate) fn out_of_reach(document: &Document, units: &Units, reach: &Reach) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for (_, clause) in document.iter() {
        let ClauseKind::GestureKey(gesture) = &clause.kind else {
            continue;
        };
        for side in Side::BOTH
            .into_iter()
            .filter(|s| gesture.handedness.includes(*s))
        {
            let Some((track, mirrored)) = track_for(&gesture.motions, side, gesture.handedness)
            else {
                continue;
            };
            // The mirrored hand is exactly as far away as the one that was written.
            if mirrored && gesture.handedness == Handedness::Both {
                continue;
            }
            for key in &track.keys {
                let beyond = (position(key, mirrored, units)
                    - reach.shoulders_in_world[side.index()])
                .length()
                    - reach.arm_m;
                // A tenth of a millimetre is below what rounding in a script can mean.
                if beyond > 1e-4 {
                    found.push(
                        Diagnostic::warning(
                            "player::out-of-reach",
                            key.span,
                            format!(
                                "this place is {} cm beyond the reach of the {} arm",
                                fixed(beyond * 100.0, 0),
                                if side == Side::Left { "left" } else { "right" },
                            ),
                        )
                        .hint("the hand goes as far towards it as it can"),
                    );
                }
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_eml::{EstimatedDurations, parse};

    fn resolved(body: &str) -> (Document, Timeline) {
        let source = format!("<eml><body>{body}</body></eml>");
        let parsed = parse(&source);
        assert!(parsed.diagnostics.is_empty(), "{:?}", parsed.diagnostics);
        let resolved = Timeline::resolve(&parsed.document, &EstimatedDurations);
        (parsed.document, resolved.timeline)
    }

    fn strokes_of(body: &str, side: Side) -> Vec<GestureStroke> {
        let (document, timeline) = resolved(body);
        let units = Units::of(&raconteur_body::Skeleton::example());
        strokes(&document, &timeline, side, &units)
    }

    #[test]
    fn both_hands_mirror_the_common_track() {
        let body = "<gesture-key time='1' duration='0.5' handedness='both'>
            <palms><key time='0' a='90' x='1' y='0' z='0'/></palms>
            <motion><key time='0' x='-8' y='12' z='-10'/><key time='0.5' x='-12' y='14' z='-10'/></motion>
            </gesture-key>";
        let (l, r) = (strokes_of(body, Side::Left), strokes_of(body, Side::Right));
        assert_eq!(l.len(), 1);
        for (a, b) in l[0].keys.iter().zip(&r[0].keys) {
            let (p, q) = (a.wrist_in_world, b.wrist_in_world);
            assert_eq!(p.map(mirror_vector), q);
            assert!(p.is_some_and(|p| p.x > 0.0));
            if let (Some(p), Some(q)) = (a.hand_in_world, b.hand_in_world) {
                assert!(raconteur_base::mirror_rotation(p).angle_between(q) < 1e-9);
            }
        }
    }

    #[test]
    fn one_hand_leaves_the_other_alone() {
        let body = "<gesture-key time='0' duration='0.2' handedness='right'>
            <hand-shapes><key time='0' id='7'/></hand-shapes></gesture-key>";
        assert!(strokes_of(body, Side::Left).is_empty());
        let keys = &strokes_of(body, Side::Right)[0].keys;
        assert_eq!(keys[0].shape, HandShape::get(7).map(|s| *s.angles()));
    }

    #[test]
    fn gestures_are_on_until_they_are_turned_off() {
        let (document, timeline) =
            resolved("<gesture-is-on time='2' isOn='false'/><gesture-is-on time='5' isOn='true'/>");
        let on = on_spans(&switches(&document, &timeline));
        assert_eq!(on.len(), 2);
        assert_eq!(
            (on[0].start_secs, on[0].end_secs, on[1].start_secs),
            (0.0, 2.0, 5.0)
        );
    }
}
