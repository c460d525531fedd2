//! Single motion of a limb from its initial state, as a function of its own time.

use raconteur_base::curve::minimum_jerk;
use raconteur_base::{DAffine3, DQuat, DVec3};

use super::aim::ReachTarget;
use super::between;
use super::path::TimedPath;
use crate::limb::{Joints, RigidFrame};

/// Time in which elbow and girdle return to their own path after a change of motion, seconds.
pub(super) const SETTLE_SECS: f64 = 0.6;
/// Acceleration and deceleration time at a given joint speed, seconds.
const RAMP_SECS: f64 = 0.2;

/// Limb posture given by joint angles, with the wrist position that drives the shoulder girdle and
/// the leans of the spine that the limb requires.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct HeldLimb {
    pub(super) joints: Joints,
    /// Wrist position that drives the girdle, trunk axes, metres.
    pub(super) cue: DVec3,
    /// Lean of the spine required by the limb, rotation vector.
    pub(super) lean: DVec3,
    /// Additional lean required because the other arm leans the spine away from it.
    pub(super) help: DVec3,
}

impl HeldLimb {
    /// Returns the wrist position that drives the girdle on a trunk for a reach target, trunk axes,
    /// metres.
    pub(super) fn cued(&self, aim: Option<&ReachTarget>, trunk: &DAffine3) -> DVec3 {
        self.cue + aim.map_or(DVec3::ZERO, |aim| aim.moved_on(trunk))
    }

    fn lerp(&self, to: &Self, share: f64) -> Self {
        Self {
            joints: between(&self.joints, &to.joints, share),
            cue: self.cue.lerp(to.cue, share),
            lean: self.lean.lerp(to.lean, share),
            help: self.help.lerp(to.help, share),
        }
    }
}

/// Goal of a limb at one instant.
#[derive(Clone, Copy, Debug)]
#[expect(
    clippy::large_enum_variant,
    reason = "goals are made at every evaluation, which allocates nothing"
)]
pub(super) enum MotionGoal {
    /// Given joints, and the position to which they should bring the end, if any.
    Joints(HeldLimb, Option<ReachTarget>),
    /// The end at a frame.
    Frame {
        frame: RigidFrame,
        /// Turn of elbow or knee from the natural direction, radians.
        swivel_rad: f64,
        /// Offset of the girdle's cue from the target, trunk axes, metres.
        cue_lag: DVec3,
        /// Difference of the spine's lean from that required by the target, rotation vector: its
        /// own, and the additional one because of the other arm.
        lean_lag: [DVec3; 2],
    },
}

/// Kind of motion that a limb performs in one segment of its track.
#[derive(Clone, Debug)]
pub(super) enum MotionKind {
    /// Joint angles, with minimum jerk or at an even speed.
    Joints {
        from: HeldLimb,
        to: HeldLimb,
        /// Position to which `to` should bring the end; `None` if the angles themselves are the
        /// goal.
        aim: Option<Box<ReachTarget>>,
        secs: f64,
        even: bool,
    },
    /// Joint angles from its beginning on.
    Cut(HeldLimb),
    /// A straight line with the shortest turn.
    Line {
        from: RigidFrame,
        to: RigidFrame,
        secs: f64,
    },
    /// A function of time.
    Curve(TimedPath),
    /// Joint angles at even steps, and the resulting frames of the end.
    Samples {
        steps: Vec<(HeldLimb, ReachTarget)>,
        step_secs: f64,
        /// Target that they approach, if there is one.
        to: Option<Box<RigidFrame>>,
    },
    /// A frame in the world.
    Lock(RigidFrame),
}

impl MotionKind {
    /// Returns the duration of the motion, seconds; infinite for a loop.
    pub(super) fn secs(&self) -> f64 {
        match self {
            Self::Joints { secs, .. } | Self::Line { secs, .. } => *secs,
            Self::Curve(curve) => curve.secs(),
            Self::Samples {
                steps, step_secs, ..
            } => steps.len() as f64 * step_secs,
            Self::Cut(_) | Self::Lock(_) => 0.0,
        }
    }
}

/// Motion of a limb, with the offsets of its initial posture that decay after the start.
#[derive(Clone, Debug)]
pub(super) struct LimbMotion {
    pub(super) kind: MotionKind,
    /// Turn of elbow or knee at the start, radians from the natural direction.
    pub(super) swivel_rad: f64,
    /// Offset of the girdle's cue from the position, trunk axes, metres.
    pub(super) cue_lag: DVec3,
    /// The spine's lean minus the target's, rotation vector: its own, and the additional one
    /// because of the other arm.
    pub(super) lean_lag: [DVec3; 2],
    /// Offset of its joints, radians, and of its upper bone, base axes.
    pub(super) mend: JointCorrection,
}

/// Offset of a limb's joints from their goal at the start of a motion; it decays.
#[derive(Clone, Copy, Debug)]
pub(super) struct JointCorrection {
    /// Offset of each joint, radians; 0 for shoulder or hip joints of a limb.
    pub(super) joints: Joints,
    /// The turn of the upper bone of a limb, which has two sets of angles.
    pub(super) upper: DQuat,
}

impl Default for JointCorrection {
    fn default() -> Self {
        Self {
            joints: Joints::default(),
            upper: DQuat::IDENTITY,
        }
    }
}

impl LimbMotion {
    /// Returns the goal of the limb some seconds after the start.
    pub(super) fn goal(&self, secs: f64, figure_from_world: &DAffine3) -> MotionGoal {
        let frame = match &self.kind {
            MotionKind::Joints {
                from,
                to,
                aim,
                secs: whole,
                even,
            } => {
                let share = if *even {
                    evenly(secs, *whole)
                } else {
                    minimum_jerk(secs / whole.max(1e-9))
                };
                let aim = aim.as_ref().map(|aim| aim.counting(share, aim.frame));
                return MotionGoal::Joints(from.lerp(to, share), aim);
            }
            MotionKind::Cut(held) => return MotionGoal::Joints(*held, None),
            MotionKind::Samples {
                steps,
                step_secs,
                to,
            } => {
                let last = steps.len().saturating_sub(1);
                let at = (secs / step_secs).clamp(0.0, last as f64);
                let index = at.floor() as usize;
                let ((a, aim), (b, next)) = (&steps[index], &steps[(index + 1).min(last)]);
                let share = at - index as f64;
                // Velocities drive the joints without a target position.
                let aim = to.as_ref().map(|to| {
                    let aim = aim.lerp(next, share);
                    // The motion begins at the limb's current state, regardless of its previous
                    // driver.
                    let counts = minimum_jerk(secs / SETTLE_SECS);
                    let is_over = at >= last as f64;
                    let target = if is_over { **to } else { aim.frame };
                    aim.counting(counts, target)
                });
                return MotionGoal::Joints(a.lerp(b, share), aim);
            }
            MotionKind::Line {
                from,
                to,
                secs: whole,
            } => from.lerp(to, minimum_jerk(secs / whole.max(1e-9))),
            MotionKind::Curve(curve) => curve.sample(secs),
            MotionKind::Lock(frame) => frame.moved(figure_from_world),
        };
        let left = 1.0 - minimum_jerk(secs / SETTLE_SECS);
        MotionGoal::Frame {
            frame,
            swivel_rad: self.swivel_rad * left,
            cue_lag: self.cue_lag * left,
            lean_lag: self.lean_lag.map(|lag| lag * left),
        }
    }
}

/// Returns the share of a path covered at even speed, with time added at both ends for acceleration
/// and deceleration; [`even_secs`] is the total time.
fn evenly(secs: f64, whole: f64) -> f64 {
    let ramp = RAMP_SECS.min(0.5 * whole);
    if ramp <= 0.0 {
        return f64::from(u8::from(secs > 0.0));
    }
    // The integral of a smooth ramp of speed from 0 to 1.
    let gathered = |s: f64| {
        let s = s.clamp(0.0, 1.0);
        s * s * s * (1.0 - 0.5 * s)
    };
    let secs = secs.clamp(0.0, whole);
    let first = ramp * gathered(secs / ramp);
    let last = ramp * gathered((whole - secs) / ramp);
    let cruise = (secs.min(whole - ramp) - ramp).max(0.0);
    let way = if secs < whole - ramp {
        first + cruise
    } else {
        whole - ramp - last
    };
    way / (whole - ramp)
}

/// Returns the time for a turn of `rad` at an even speed of `rad_per_sec`, seconds.
pub(super) fn even_secs(rad: f64, rad_per_sec: f64) -> f64 {
    let cruise = rad / rad_per_sec;
    // A short path never reaches its full speed.
    cruise + RAMP_SECS.min(cruise)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_way_is_even_and_smooth_at_its_ends() {
        let whole = even_secs(3.0, 1.5);
        assert!(
            (whole - 2.2).abs() < 1e-12,
            "the whole duration of an even path"
        );
        let h = 1e-4;
        let speed = |t: f64| 3.0 * (evenly(t + h, whole) - evenly(t - h, whole)) / (2.0 * h);
        for i in 0..100 {
            let t = 0.25 + 1.7 * f64::from(i) / 100.0;
            assert!((speed(t) - 1.5).abs() < 1e-6, "{t}: {}", speed(t));
        }
        assert!(
            speed(0.01) < 0.1 && speed(whole - 0.01) < 0.1,
            "the path starts and ends slowly"
        );
        assert_eq!(evenly(0.0, whole), 0.0);
        assert!(
            (evenly(whole, whole) - 1.0).abs() < 1e-12,
            "an even path ends at its end"
        );
        // Paths shorter than the ramps stay below the speed.
        let short = even_secs(0.1, 1.5);
        assert!(
            (evenly(short, short) - 1.0).abs() < 1e-12,
            "a short even path ends at its end"
        );
        let step = (evenly(0.51 * short, short) - evenly(0.49 * short, short)) * 0.1;
        assert!(
            step / (0.02 * short) < 1.6,
            "a short even path has a bounded speed"
        );
    }
}
