//! Unreachable hand goals of a figure: positions out of reach or inside the body, and strokes that
//! come too late.

use std::collections::BTreeMap;

use raconteur_actor::gesture::ArmPlan;
use raconteur_actor::limb::{BodySpace, Build};
use raconteur_base::order::sort_by_number;
use raconteur_base::{DVec3, Length, Side};
use raconteur_body::{Bone, Pose, Skeleton};
use raconteur_eml::{
    ClauseKind, Coords, Diagnostic, Document, Handedness, Key, MotionKey, Span, Timeline,
};

use crate::lower::gestures::{Hands, offset_secs, position, track_for};
use crate::lower::units::Units;

/// Reach of a figure's arms and legs; used to warn of unreachable positions.
pub(crate) struct Reach {
    /// Shoulder joints, left and right, world, metres.
    pub(crate) shoulders_in_world: [DVec3; 2],
    /// Length of an arm to the wrist, metres.
    pub(crate) arm_m: f64,
    /// Hip joints, left and right, world, metres.
    pub(crate) hips_in_world: [DVec3; 2],
    /// Length of a leg to the ankle, metres.
    pub(crate) leg_m: f64,
    /// Trunk and head, which the wrists stay out of.
    space: BodySpace,
}

impl Reach {
    /// Measures a skeleton and its build in the zero pose.
    pub(crate) fn new(skeleton: &Skeleton, build: &Build) -> Self {
        let mut world = Vec::new();
        skeleton.solve(&Pose::zero(), &mut world);
        let at = |bone: Bone| world[bone.index()].translation;
        let length = |bone| skeleton.offset_length_m(bone);
        Self {
            shoulders_in_world: [at(Bone::LShoulder), at(Bone::RShoulder)],
            arm_m: length(Bone::LElbow) + length(Bone::LWrist),
            hips_in_world: [at(Bone::LHip), at(Bone::RHip)],
            leg_m: length(Bone::LKnee) + length(Bone::LSubtalar),
            space: BodySpace::new(skeleton, build.trunk),
        }
    }
}

/// Displacement out of the body that is told, skeleton units.
const MIN_DISPLACEMENT: f64 = 1.0;

/// Returns a warning for every gesture with positions that the wrist cannot take: it moves as far
/// towards those beyond the arm's reach as possible (GEVH fig. 3.6), and stays in front of those
/// inside the body.
#[must_use]
pub(crate) fn unreachable(
    document: &Document,
    units: &Units,
    reach: &Reach,
    hands: Hands,
) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    // Positions in the world are not checked where the figure may move to them.
    let goes = document
        .iter()
        .any(|(_, c)| matches!(c.kind, ClauseKind::VhMove(_)));
    for (_, clause) in document.iter() {
        let ClauseKind::GestureKey(gesture) = &clause.kind else {
            continue;
        };
        let (mut far, mut inside) = (Vec::new(), Vec::new());
        for side in Side::BOTH
            .into_iter()
            .filter(|s| gesture.handedness.includes(*s, hands.dominant))
        {
            let Some((track, mirrored)) =
                track_for(&gesture.motions, side, gesture.handedness, hands)
            else {
                continue;
            };
            // The mirrored hand is exactly as far away as the one that was written.
            if mirrored && gesture.handedness == Handedness::Both {
                continue;
            }
            let told = |key: &&Key<MotionKey>| !goes || key.value.coords == Coords::Speaker;
            for key in track.keys.iter().filter(told) {
                let goal = position(key, mirrored, units);
                let from_shoulder = goal - reach.shoulders_in_world[side.index()];
                let beyond = from_shoulder.magnitude() - reach.arm_m;
                // A tenth of a millimetre is below the rounding of a script.
                if beyond > 1e-4 {
                    far.push((beyond, key.span, side));
                }
                let deep = reach.space.wrist_exit_displacement(goal).magnitude();
                if deep > MIN_DISPLACEMENT * units.metres() {
                    inside.push((deep, key.span, side));
                }
            }
        }
        found.extend(farthest(&far));
        found.extend(deepest(&inside));
    }
    found
}

/// Returns one warning per clause: at the position farthest beyond reach, metres.
fn farthest(far: &[(f64, Span, Side)]) -> Option<Diagnostic> {
    let (beyond, span, side) = far.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
    let message = format!(
        "this place is {:.0} cm beyond the reach of the {} arm{}",
        beyond * 100.0,
        side_name(*side),
        others(far.len()),
    );
    Some(
        Diagnostic::warning("player::out-of-reach", *span, message)
            .hint("the hand goes as far towards it as it can"),
    )
}

/// Returns one warning per clause: at the position deepest in the body, metres.
fn deepest(inside: &[(f64, Span, Side)]) -> Option<Diagnostic> {
    let (deep, span, side) = inside.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
    let message = format!(
        "this place is inside the body: the {} wrist stays {:.0} cm away, outside{}",
        side_name(*side),
        deep * 100.0,
        others(inside.len()),
    );
    Some(
        Diagnostic::warning("player::in-body", *span, message)
            .hint("choose a place farther from the trunk or the head"),
    )
}

fn side_name(side: Side) -> &'static str {
    if side == Side::Left { "left" } else { "right" }
}

fn others(count: usize) -> String {
    match count {
        1 => String::new(),
        2 => "; another one of this gesture is, too".to_owned(),
        n => format!("; {} others of this gesture are, too", n - 1),
    }
}

/// Lateness that is not visible, seconds (half of the tolerance for strokes).
const UNSEEN_SECS: f64 = 0.01;

/// Returns a warning for every key that is late because the path is too long for the time.
#[must_use]
pub(crate) fn late(
    document: &Document,
    timeline: &Timeline,
    plans: [&ArmPlan; 2],
) -> Vec<Diagnostic> {
    let mut found: BTreeMap<Span, f64> = BTreeMap::new();
    for side in Side::BOTH {
        let planned = plans[side.index()].keys().iter();
        let mut late: Vec<_> = planned
            .filter(|k| k.arrives_secs - k.time_secs > UNSEEN_SECS)
            .collect();
        sort_by_number(&mut late, |k| k.time_secs);
        if late.is_empty() {
            continue;
        }
        let mut check = |secs: f64, span: Span| {
            let first = late.partition_point(|k| k.time_secs <= secs - 1e-6);
            let near = late[first..]
                .iter()
                .take_while(|k| k.time_secs < secs + 1e-6);
            for key in near {
                let worst = found.entry(span).or_default();
                *worst = worst.max(key.arrives_secs - key.time_secs);
            }
        };
        for timed in &timeline.clauses {
            let ClauseKind::GestureKey(gesture) = &document.clause(timed.clause).kind else {
                continue;
            };
            let start = timed.start_secs;
            for track in &gesture.hand_shapes {
                for key in &track.keys {
                    check(start + offset_secs(gesture, track, key), key.span);
                }
            }
            for track in &gesture.palms {
                for key in &track.keys {
                    check(start + offset_secs(gesture, track, key), key.span);
                }
            }
            for track in &gesture.motions {
                for key in &track.keys {
                    check(start + offset_secs(gesture, track, key), key.span);
                }
            }
        }
    }
    let warning = |(span, delay): (Span, f64)| {
        let message = format!(
            "the hand arrives {} ms late here",
            (delay * 1e3).round() as u64
        );
        Diagnostic::warning("player::late", span, message)
            .hint("it has too far to go in the time; give it more, or a place nearer by")
    };
    found.into_iter().map(warning).collect()
}
