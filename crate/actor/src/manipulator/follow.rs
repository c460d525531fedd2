//! Inverse velocity: joints follow a velocity of the end effector, in fixed steps (GEVH D.3.24).

use raconteur_base::curve::{minimum_jerk, smooth};
use raconteur_base::{DVec3, Length};

use super::compile::LimbState;
use super::jacobian::{Twist, joint_speeds};
use super::motion::{HeldLimb, MotionKind, SETTLE_SECS};
use super::perform::Manipulators;
use super::track::BRAKE_SECS;
use crate::limb::chain::LimbBase;
use crate::limb::limits;
use crate::limb::{Limb, RigidFrame};

/// Inverse-velocity steps per second, and their number per sample.
const STEPS_HZ: f64 = 120.0;
const STEPS_A_SAMPLE: usize = 2;
/// Acceleration time to full speed, seconds.
const START_SECS: f64 = 0.25;
/// Joint turn per step, radians, and displacement of the girdle's cue, metres, below which a limb
/// is at rest: at its limits, or at the end of its reach. Invisible over ten minutes.
const RESTING: f64 = 1e-9;

impl Manipulators {
    /// Follows velocities by inverse velocity, in fixed steps.
    pub(super) fn follow(
        &self,
        limb: Limb,
        now: &LimbState,
        most_secs: f64,
        to: Option<&RigidFrame>,
        wanted: &dyn Fn(&RigidFrame) -> Twist,
    ) -> MotionKind {
        let limited = self.tracks[limb.index()].has_limits();
        let mut state = now.held();
        let aim = |frame: &RigidFrame, state: &HeldLimb, base: &LimbBase| {
            self.aim(limb, frame, &state.joints, base, &now.trunk)
        };
        let mut steps = vec![(state, aim(&now.frame, &state, &now.base))];
        let mut base = now.base;
        let mut frame = now.frame;
        let mut carried = DVec3::ZERO;
        // The integration continues past the end command, because a stop brakes.
        let most = ((most_secs + BRAKE_SECS) * STEPS_HZ).ceil() as usize;
        for step in 1..=most {
            let gathered = smooth(step as f64 / (START_SECS * STEPS_HZ));
            let twist = wanted(&frame);
            if twist.linear.magnitude() < 3e-5 && twist.angular.magnitude() < 3e-4 {
                break;
            }
            let axes = match self.limbs.get(limb.index()) {
                Some(rig) => rig.axes(&state.joints, &base),
                None => self.head.axes(&state.joints, &base),
            };
            // The joints exclude the motion that the girdle provides.
            let twist = Twist {
                linear: twist.linear * gathered - carried,
                angular: twist.angular * gathered,
            };
            let speeds = joint_speeds(&axes, frame.position, &twist);
            let last = state;
            for (joint, speed) in state.joints.iter_mut().zip(speeds) {
                *joint += speed / STEPS_HZ;
            }
            if limited {
                state.joints = limits::clamp_joints(self.limits(limb), 1.0, &state.joints);
            }
            // The girdle follows, and moves the base under the arm.
            let left = 1.0 - minimum_jerk(step as f64 / (SETTLE_SECS * STEPS_HZ));
            let place = now.trunk.inverse().transform_point3(frame.position);
            state.cue = place + now.cue_lag * left;
            let cue = now.trunk.transform_point3(state.cue);
            let arm = self.arms.get(limb.index());
            let scapula = arm.map(|arm| arm.girdle().scapula_for(&now.trunk, cue, 0.0));
            let before = base.origin;
            base = self.base(limb, &now.trunk, scapula);
            carried = (base.origin - before) * STEPS_HZ;
            frame = self.posed(limb, &state.joints, &base).frame;
            let rests = left <= 0.0 && carried.magnitude() <= RESTING && rests(&last, &state);
            if rests {
                steps.push((state, aim(&frame, &state, &base)));
                break;
            }
            if step % STEPS_A_SAMPLE == 0 {
                steps.push((state, aim(&frame, &state, &base)));
            }
        }
        MotionKind::Samples {
            steps,
            step_secs: STEPS_A_SAMPLE as f64 / STEPS_HZ,
            to: to.map(|to| Box::new(*to)),
        }
    }
}

/// Returns true if a step changes nothing visible.
fn rests(from: &HeldLimb, to: &HeldLimb) -> bool {
    let turns = from
        .joints
        .iter()
        .zip(&to.joints)
        .map(|(a, b)| (a - b).abs());
    turns.fold((from.cue - to.cue).magnitude(), f64::max) <= RESTING
}
