//! Palm orientations out of the arm's range at the scripted position.

use raconteur_actor::gesture::ArmPlan;
use raconteur_actor::{ArmGoal, ArmRig, palm};
use raconteur_base::{DQuat, DVec3, Side, mirror_vector};
use raconteur_eml::{ClauseKind, Diagnostic, Document, GestureKey, Handedness, Span, Timeline};

use crate::lower::gestures::{Hands, hand_rotation, offset_secs, track_for};
use crate::lower::units::Units;

/// Error below which a missed palm is not reported, degrees. Designed: the palm still faces the
/// same side, and authors' gestures are off by up to 50 before the difference is visible.
const SAME_DEG: f64 = 60.0;

/// A palm that is not met.
struct MissedPalm {
    span: Span,
    side: Side,
    off_deg: f64,
    /// Nearest palm, in the notation of the script.
    axis: [f64; 3],
    angle_deg: f64,
}

/// Returns a warning for every gesture whose palm the arm cannot turn as scripted at the hand's
/// position: its error, and the nearest palm there (GEVH 3.3.2.1: limits of the joints have
/// priority over the target's orientation).
#[must_use]
pub(crate) fn missed(
    document: &Document,
    timeline: &Timeline,
    plans: [&ArmPlan; 2],
    hands: Hands,
) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for timed in &timeline.clauses {
        let ClauseKind::GestureKey(gesture) = &document.clause(timed.clause).kind else {
            continue;
        };
        let mut missed = Vec::new();
        for side in Side::BOTH {
            let plan = plans[side.index()];
            let arm = Arm {
                side,
                rig: plan.rig(),
                plan,
            };
            arm.missed(gesture, timed.start_secs, hands, &mut missed);
        }
        found.extend(worst(&missed));
    }
    found
}

/// Arm of a performance with its gesture plan, for checking palm orientations.
struct Arm<'a> {
    side: Side,
    rig: &'a ArmRig,
    plan: &'a ArmPlan,
}

impl Arm<'_> {
    fn missed(
        &self,
        gesture: &GestureKey,
        start_secs: f64,
        hands: Hands,
        into: &mut Vec<MissedPalm>,
    ) {
        let (side, handedness) = (self.side, gesture.handedness);
        if !handedness.includes(side, hands.dominant) {
            return;
        }
        let Some((track, mirrored)) = track_for(&gesture.palms, side, handedness, hands) else {
            return;
        };
        // The mirrored hand is as far off as the one that was written.
        if mirrored && handedness == Handedness::Both {
            return;
        }
        for key in &track.keys {
            let Some(wanted) = hand_rotation(&key.value, side, mirrored) else {
                continue;
            };
            let at_secs = start_secs + offset_secs(gesture, track, key);
            let (nearest, off_rad) = self.nearest(wanted, at_secs);
            let off_deg = off_rad.to_degrees();
            if off_deg > SAME_DEG {
                let (mut normal, mut angle_rad) = palm::normal_and_angle(side, nearest);
                if mirrored {
                    (normal, angle_rad) = (mirror_vector(normal), -angle_rad);
                }
                into.push(MissedPalm {
                    span: key.span,
                    side,
                    off_deg,
                    axis: Units::axis(normal.to_array()).to_array(),
                    angle_deg: angle_rad.to_degrees(),
                });
            }
        }
    }

    /// Returns the nearest hand rotation at the wrist's position at a time, and its error, radians.
    fn nearest(&self, wanted: DQuat, at_secs: f64) -> (DQuat, f64) {
        let thorax = self.rig.world_from_thorax_zero();
        let wrist_in_world: DVec3 = self.plan.sample(at_secs).wrist;
        let goal = ArmGoal {
            wrist_in_world,
            hand_in_world: Some(wanted),
            shrug_rad: 0.0,
        };
        let solved = self.rig.solve(&thorax, &goal);
        (self.rig.hand_of(&thorax, &solved), solved.hand_error_rad)
    }
}

/// Returns a warning for the palm of a gesture that deviates most from its requested orientation;
/// `None` without any.
fn worst(missed: &[MissedPalm]) -> Option<Diagnostic> {
    let palm = missed
        .iter()
        .max_by(|a, b| a.off_deg.total_cmp(&b.off_deg))?;
    let hand = ["left", "right"][palm.side.index()];
    let [x, y, z] = palm.axis;
    let message = format!(
        "the {hand} hand cannot turn its palm so at its place: it is {:.0}° off",
        palm.off_deg
    );
    let others = match missed.len() {
        1 => String::new(),
        n => format!("; {} more of this gesture cannot be met either", n - 1),
    };
    // Adding 0.0 removes the sign of a value that rounds to zero.
    let [x, y, z] = [x, y, z].map(|part| (part * 100.0).round() / 100.0 + 0.0);
    Some(
        Diagnostic::warning("player::palm", palm.span, message).hint(format!(
            "the nearest that it can is a='{:.0}' x='{x}' y='{y}' z='{z}'{others}; or lead the hand elsewhere",
            palm.angle_deg.round() + 0.0
        )),
    )
}
