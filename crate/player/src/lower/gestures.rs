//! Conversion of the timeline's gesture-keys to strokes of the two arms.

use std::collections::BTreeMap;

use raconteur_actor::gesture::{
    GesturePhase as ArmPhase, InterpolationSpace as CourseSpace, Transition,
};
use raconteur_actor::{GestureStroke, HandKey, TimeSpan, palm};
use raconteur_base::profile::Profile as Pace;
use raconteur_base::{DVec3, Side, mirror_vector};
use raconteur_body::HandShape;
use raconteur_body::hand_shape::HandAngles;
use raconteur_eml::{
    ClauseKind, Coords, Document, GestureKey, Handedness, Interpolator, Key, MotionKey, PalmKey,
    Phase, PreferredHand, Profile, ShapeKey, Space, Timeline, Track,
};

use raconteur_stage::{Gesture, TakenSpace};

use crate::lower::units::Units;

/// Rounds a time to the microsecond, so simultaneous keys of different tracks merge into one key.
fn moment(offset_secs: f64) -> u64 {
    (offset_secs.max(0.0) * 1e6).round() as u64
}

/// Dominant hands for which a script is written and which the performer has; if they differ,
/// gestures are mirrored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Hands {
    /// The hand that common values are written for (GEVH 3.5.1, D.5.4).
    pub(crate) written_for: Side,
    /// The performer's.
    pub(crate) dominant: Side,
}

impl Hands {
    /// Returns the dominant hand chosen by the page, else the story's, else the figure's.
    pub(crate) fn from_document(document: &Document, shown: Option<Side>, figure: Side) -> Self {
        let performer = document.performer.as_ref();
        let story = performer
            .and_then(|p| p.handedness)
            .map(PreferredHand::side);
        Self {
            written_for: story.unwrap_or(Side::Right),
            dominant: shown.or(story).unwrap_or(figure),
        }
    }

    /// Returns true if values of a common track must be mirrored for a participating hand.
    fn mirrors(self, side: Side, handedness: Handedness) -> bool {
        match handedness {
            Handedness::Both => side != self.written_for,
            Handedness::Left | Handedness::Right => false,
            Handedness::Dominant | Handedness::NonDominant => self.dominant != self.written_for,
        }
    }
}

/// Returns the track that moves the hand on a side: its own, or else the common one. The flag is
/// true if the common values are for the other hand and must be mirrored.
pub(super) fn track_for<K>(
    tracks: &[Track<K>],
    side: Side,
    handedness: Handedness,
    hands: Hands,
) -> Option<(&Track<K>, bool)> {
    if let Some(own) = tracks.iter().find(|t| t.hand == Some(side)) {
        return Some((own, false));
    }
    let common = tracks.iter().find(|t| t.hand.is_none())?;
    Some((common, hands.mirrors(side, handedness)))
}

pub(crate) fn position(key: &Key<MotionKey>, mirrored: bool, units: &Units) -> DVec3 {
    let p = match key.value.coords {
        Coords::Speaker => units.speaker_point(key.value.position),
        Coords::World => units.world_point(key.value.position),
    };
    if mirrored { mirror_vector(p) } else { p }
}

pub(super) fn hand_rotation(
    key: &PalmKey,
    side: Side,
    mirrored: bool,
) -> Option<raconteur_base::DQuat> {
    let mut normal = Units::axis(key.axis);
    let mut angle_rad = key.angle_deg.to_radians();
    if mirrored {
        normal = mirror_vector(normal);
        angle_rad = -angle_rad;
    }
    palm::hand_rotation(side, normal, angle_rad)
}

fn hand_shape(key: &ShapeKey) -> Option<HandAngles> {
    let angles = *HandShape::get(key.id)?.angles();
    let Some((id, share)) = key.blend else {
        return Some(angles);
    };
    let other = HandShape::get(id)?;
    Some(angles.lerp(other.angles(), share))
}

/// Returns the motion profile with its control values; `None` if the profile names none.
fn pace(profile: &Profile) -> Option<Pace> {
    let controls = profile.controls.as_deref().unwrap_or_default();
    Some(match (profile.interpolator?, controls) {
        (Interpolator::Bezier, &[x1, y1, x2, y2]) => Pace::Bezier([x1, y1, x2, y2]),
        (Interpolator::Hermite, &[from, to]) => Pace::Hermite([from, to]),
        (Interpolator::Cosine, _) => Pace::Cosine,
        _ => Pace::Linear,
    })
}

/// Returns the transition of the hand to a key: the key's own, else the track's.
fn course<K>(track: &Track<K>, key: &Key<K>) -> Transition {
    let both = || [&key.profile, &track.profile].into_iter().flatten();
    let space = both().find_map(|p| p.space).map(|space| match space {
        Space::Cartesian => CourseSpace::Cartesian,
        Space::Joint => CourseSpace::Joint,
    });
    Transition {
        profile: both().find_map(|p| pace(p)),
        space,
    }
}

/// Returns true if a phase ends at its last key: a single key is then at its end, otherwise at its
/// beginning.
fn leads_to_last_key(gesture: &GestureKey) -> bool {
    matches!(
        gesture.phase,
        Some(Phase::Preparation | Phase::Retraction | Phase::PartialRetraction)
    )
}

/// Returns the time at which a key of a gesture is reached, seconds after its beginning.
pub(super) fn offset_secs<K>(gesture: &GestureKey, track: &Track<K>, key: &Key<K>) -> f64 {
    if key.offset_secs <= 0.0 && track.keys.len() == 1 && leads_to_last_key(gesture) {
        gesture.duration_secs
    } else {
        key.offset_secs
    }
}

/// Returns one hand's keys of one gesture, merged by time; empty if the gesture does not use this
/// hand.
fn keys(
    gesture: &GestureKey,
    side: Side,
    start_secs: f64,
    units: &Units,
    hands: Hands,
) -> Vec<HandKey> {
    let mut by_time: BTreeMap<u64, HandKey> = BTreeMap::new();
    let mut at = |offset_secs: f64, set: &mut dyn FnMut(&mut HandKey)| {
        let key = by_time
            .entry(moment(offset_secs))
            .or_insert_with(|| HandKey {
                time_secs: start_secs + offset_secs,
                ..HandKey::default()
            });
        set(key);
    };
    if let Some((track, _)) = track_for(&gesture.hand_shapes, side, gesture.handedness, hands) {
        for key in &track.keys {
            at(offset_secs(gesture, track, key), &mut |k| {
                k.shape = hand_shape(&key.value);
                k.shape_course = course(track, key);
            });
        }
    }
    if let Some((track, mirrored)) = track_for(&gesture.palms, side, gesture.handedness, hands) {
        for key in &track.keys {
            at(offset_secs(gesture, track, key), &mut |k| {
                k.hand_in_world = hand_rotation(&key.value, side, mirrored);
                k.hand_course = course(track, key);
            });
        }
    }
    if let Some((track, mirrored)) = track_for(&gesture.motions, side, gesture.handedness, hands) {
        for key in &track.keys {
            let p = position(key, mirrored, units);
            at(offset_secs(gesture, track, key), &mut |k| {
                k.wrist_in_world = Some(p);
                k.stays_in_world = key.value.coords == Coords::World;
                k.wrist_course = course(track, key);
            });
        }
    }
    by_time.into_values().collect()
}

/// Returns the times at which a script turns gestures on or off.
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

/// Returns the intervals in which gestures are on, from switches by time. They are on until they
/// are turned off.
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

/// Returns the gesture strokes of one arm in a script.
#[must_use]
pub(crate) fn strokes(
    document: &Document,
    timeline: &Timeline,
    side: Side,
    units: &Units,
    hands: Hands,
) -> Vec<GestureStroke> {
    timeline
        .clauses
        .iter()
        .filter_map(|timed| {
            let ClauseKind::GestureKey(gesture) = &document.clause(timed.clause).kind else {
                return None;
            };
            if !gesture.handedness.includes(side, hands.dominant) {
                return None;
            }
            let phase = match gesture.phase {
                None | Some(Phase::Stroke) => ArmPhase::Stroke,
                Some(Phase::Preparation) => ArmPhase::Preparation,
                Some(Phase::PreStroke | Phase::PostStroke) => ArmPhase::Hold,
                Some(Phase::Retraction) => ArmPhase::Retraction,
                Some(Phase::PartialRetraction) => ArmPhase::PartialRetraction,
            };
            let keys = keys(gesture, side, timed.start_secs, units, hands);
            // A phase may have no keys: a hold or a retraction.
            (gesture.phase.is_some() || !keys.is_empty()).then_some(GestureStroke {
                phase,
                // Whoever names the phase of a movement has seen it, or builds it step by step.
                is_transcribed: gesture.phase.is_some(),
                start_secs: timed.start_secs,
                end_secs: timed.end_secs,
                keys,
                pace: gesture.pace.as_deref().and_then(pace),
            })
        })
        .collect()
}

/// Delays strokes that begin before a time, seconds, together with their keys.
#[must_use]
pub(crate) fn not_before(mut strokes: Vec<GestureStroke>, from_secs: f64) -> Vec<GestureStroke> {
    for stroke in &mut strokes {
        let late_secs = (from_secs - stroke.start_secs).max(0.0);
        if late_secs > 0.0 {
            stroke.start_secs += late_secs;
            stroke.end_secs += late_secs;
            stroke
                .keys
                .iter_mut()
                .for_each(|key| key.time_secs += late_secs);
        }
    }
    strokes
}

/// Share of the hand below its wrist in a gesture with scripted palm, fingers forward or up, and in
/// one without.
const HANGING: [f64; 2] = [0.4, 0.6];
/// Position of the lens in a storyteller's shot: height, and distance in front of the figure,
/// shares of stature.
const LENS_HEIGHT: f64 = 0.8;
const LENS_DISTANCE: f64 = 1.85;

/// Returns the space of a stroke's hand, if it moves anywhere. A hand held towards the lens appears
/// lower, so the space reaches down to its apparent position at the figure itself.
pub(crate) fn space(stroke: &GestureStroke, hand_length_m: f64, stature_m: f64) -> Option<Gesture> {
    let led = stroke.keys.iter().any(|k| k.hand_in_world.is_some());
    let hanging = HANGING[usize::from(!led)] * hand_length_m;
    let lens = [LENS_HEIGHT, LENS_DISTANCE].map(|share| share * stature_m);
    let seen_from_lens = |y: f64, z: f64| {
        let nearness = lens[1] / (lens[1] - z.clamp(0.0, 0.5 * lens[1]));
        y.min(lens[0] + (y - lens[0]) * nearness)
    };
    let wrists = stroke.keys.iter().filter_map(|k| k.wrist_in_world);
    let space = wrists
        .map(|wrist| TakenSpace {
            top_m: wrist.y + hand_length_m,
            bottom_m: seen_from_lens(wrist.y - hanging, wrist.z + 0.5 * hand_length_m),
            half_width_m: wrist.x.abs() + hand_length_m,
        })
        .reduce(|a, b| TakenSpace {
            top_m: a.top_m.max(b.top_m),
            bottom_m: a.bottom_m.min(b.bottom_m),
            half_width_m: a.half_width_m.max(b.half_width_m),
        })?;
    Some(Gesture {
        from_secs: stroke.start_secs,
        to_secs: stroke.end_secs,
        space,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_eml::{EstimatedDurations, parse};

    const RIGHT: Hands = Hands {
        written_for: Side::Right,
        dominant: Side::Right,
    };

    fn resolved(body: &str) -> (Document, Timeline) {
        let source = format!("<eml><body>{body}</body></eml>");
        let parsed = parse(&source);
        assert!(parsed.diagnostics.is_empty(), "{:?}", parsed.diagnostics);
        let resolved = Timeline::resolve(&parsed.document, &EstimatedDurations);
        (parsed.document, resolved.timeline)
    }

    fn strokes_of(body: &str, side: Side) -> Vec<GestureStroke> {
        let (document, timeline) = resolved(body);
        let units = Units::from_skeleton(&raconteur_body::Skeleton::example());
        strokes(&document, &timeline, side, &units, RIGHT)
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
            assert!(
                p.is_some_and(|p| p.x > 0.0),
                "the left hand is on the left side"
            );
            if let (Some(p), Some(q)) = (a.hand_in_world, b.hand_in_world) {
                assert!(
                    raconteur_base::mirror_rotation(p).angle_between(q) < 1e-9,
                    "both hands mirror each other"
                );
            }
        }
    }

    #[test]
    fn one_hand_leaves_the_other_alone() {
        let body = "<gesture-key time='0' duration='0.2' handedness='right'>
            <hand-shapes><key time='0' id='7'/></hand-shapes></gesture-key>";
        assert!(
            strokes_of(body, Side::Left).is_empty(),
            "the other hand has no strokes"
        );
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
