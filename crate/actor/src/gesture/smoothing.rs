//! Arm smoothing: the planner records a path in joint space where the solution of an arm for its
//! gesture jumps.
//!
//! A palm beyond the range of the forearm or a position out of reach is met as closely as possible.
//! While the hand moves quickly, the nearest solution may change abruptly. In an interval around
//! that change, the joints move smoothly from their values before to those after it. Evaluation
//! stays a function of time.

use raconteur_base::curve::minimum_jerk;
use raconteur_base::{DQuat, DVec3, Length, Side};

use crate::limb::ArmSolution;
use crate::limb::wrist::{WristAngles, rotation_vector};

/// Maximum joint turn rate of gestures that is left unchanged, radians per second: the planner lets
/// a hand turn with up to 28.
const MAX_SPEED_RAD_PER_S: f64 = 32.0;
/// Maximum change of the turn rate between two samples, radians per second.
const KICK_RAD_PER_S: f64 = 8.0;
/// Maximum turn rate of the smoothed path through the joints, radians per second.
const CALM_RAD_PER_S: f64 = 14.0;
/// Minimum smoothing time on each side of the jump, seconds.
const MIN_SECS: f64 = 0.1;
/// Sampling rate of the coarse jump search over all hand motion, hertz.
const COARSE_HZ: f64 = 30.0;
const FINE_HZ: f64 = 240.0;
/// Turn between two coarse samples that triggers finer sampling, radians: for an arm that reaches
/// its target, and for one that cannot.
const LARGE_RAD: [f64; 2] = [0.6, 0.08];
/// A hand this far off its rotation is not met, radians.
const MISSED_RAD: f64 = 0.02;
/// Maximum number of coarse samples, 20 minutes of gestures of an arm: it bounds the time spent on
/// any script.
const MAX_LOOKS: usize = 36_000;

/// Local rotations of scapula, shoulder, elbow and wrist.
type Joints = [DQuat; 4];

fn joints(arm: &ArmSolution) -> Joints {
    [arm.scapula, arm.shoulder, arm.elbow, arm.wrist]
}

/// Returns the greatest rotation between corresponding joints of two arms, radians.
fn turned(a: &Joints, b: &Joints) -> f64 {
    let turns = a.iter().zip(b).map(|(a, b)| a.angle_between(*b));
    turns.fold(0.0, f64::max)
}

/// An interval in which joints are guided past a jump.
#[derive(Clone, Debug)]
struct SmoothedSpan {
    /// Start and end of the jump of the joints, story time, seconds.
    jump: [f64; 2],
    /// The joints then.
    joints: [Joints; 2],
    /// Duration of the guidance before and after, seconds.
    margin_secs: f64,
}

impl SmoothedSpan {
    fn new(jump: [f64; 2], joints: [Joints; 2]) -> Self {
        let turn = turned(&joints[0], &joints[1]);
        // Minimum jerk is 1.875 times as fast in its middle as in the mean.
        let whole = 1.875 * turn / CALM_RAD_PER_S - (jump[1] - jump[0]);
        Self {
            jump,
            joints,
            margin_secs: MIN_SECS.max(0.5 * whole),
        }
    }

    fn span(&self) -> [f64; 2] {
        [
            self.jump[0] - self.margin_secs,
            self.jump[1] + self.margin_secs,
        ]
    }

    fn corrected_joints(&self, side: Side, time_secs: f64, arm: &mut ArmSolution) {
        let [start, end] = self.span();
        if !(start..end).contains(&time_secs) {
            return;
        }
        let now = joints(arm);
        let before = if time_secs < self.jump[0] {
            &now
        } else {
            &self.joints[0]
        };
        let after = if time_secs > self.jump[1] {
            &now
        } else {
            &self.joints[1]
        };
        let share = minimum_jerk((time_secs - start) / (end - start));
        let turn = |i: usize| before[i].slerp(after[i], share).normalized();
        (arm.scapula, arm.shoulder, arm.elbow) = (turn(0), turn(1), turn(2));
        // A forearm moves between the ends of its range through the middle.
        let [a, b] = [before[3], after[3]].map(|wrist| WristAngles::from_local(side, wrist));
        arm.wrist = a.lerp(&b, share).rotation(side);
    }
}

/// Intervals in which the joints of one arm follow a smooth path because the solution for its
/// gesture jumps; sorted by time.
#[derive(Clone, Debug, Default)]
pub(crate) struct JumpSmoothing {
    stretches: Vec<SmoothedSpan>,
}

impl JumpSmoothing {
    /// Searches an arm for jumps over time intervals, story seconds, in their order.
    pub(crate) fn find(
        spans: impl Iterator<Item = (f64, f64)>,
        arm_at: &dyn Fn(f64) -> ArmSolution,
    ) -> Self {
        let mut jumps: Vec<[f64; 2]> = Vec::new();
        let mut looks = 0;
        for (from, to) in spans {
            let steps = ((to - from) * COARSE_HZ).ceil().max(1.0);
            let room = MAX_LOOKS.saturating_sub(looks) as f64;
            let step_secs = (to - from) / steps;
            let mut last = arm_at(from);
            let count = steps.min(room) as usize;
            looks += count + 1;
            for i in 1..=count {
                let secs = from + i as f64 * step_secs;
                let arm = arm_at(secs);
                let missed = [&last, &arm]
                    .iter()
                    .any(|arm| !arm.reached || arm.hand_error_rad > MISSED_RAD);
                if turned(&joints(&last), &joints(&arm)) > LARGE_RAD[usize::from(missed)] {
                    refine(secs - step_secs, secs, arm_at, &mut jumps);
                }
                last = arm;
            }
        }
        Self {
            stretches: together(&jumps, arm_at),
        }
    }

    /// Corrects an arm at a time: within an interval found to jump, its four joints turn smoothly
    /// from those before to those after it; elsewhere the arm is unchanged.
    pub(crate) fn correct(&self, side: Side, time_secs: f64, arm: &mut ArmSolution) {
        let begun = self.stretches.partition_point(|c| c.span()[0] <= time_secs);
        if let Some(calm) = begun.checked_sub(1).and_then(|i| self.stretches.get(i)) {
            calm.corrected_joints(side, time_secs, arm);
        }
    }
}

/// Finds when an arm jumps between two times.
fn refine(from: f64, to: f64, arm_at: &dyn Fn(f64) -> ArmSolution, jumps: &mut Vec<[f64; 2]>) {
    let steps = ((to - from) * FINE_HZ).ceil().max(1.0);
    let step_secs = (to - from) / steps;
    let at = |i: i32| from + f64::from(i) * step_secs;
    let mut last = joints(&arm_at(at(-2)));
    let mut speeds = [DVec3::ZERO; 4];
    for i in -1..=steps as i32 + 1 {
        let now = joints(&arm_at(at(i)));
        let mut jumped = false;
        for (k, speed) in speeds.iter_mut().enumerate() {
            let turn = (now[k] * last[k].inverse()).normalized();
            let turn = if turn.w < 0.0 { -turn } else { turn };
            let before = core::mem::replace(speed, rotation_vector(turn) / step_secs);
            jumped |= speed.magnitude() > MAX_SPEED_RAD_PER_S;
            jumped |= i > -1 && (*speed - before).magnitude() > KICK_RAD_PER_S;
        }
        if jumped {
            jumps.push([at(i - 1), at(i)]);
        }
        last = now;
    }
}

/// Merges jumps whose intervals would overlap.
fn together(jumps: &[[f64; 2]], arm_at: &dyn Fn(f64) -> ArmSolution) -> Vec<SmoothedSpan> {
    let calm = |jump: [f64; 2]| SmoothedSpan::new(jump, jump.map(|secs| joints(&arm_at(secs))));
    let mut order = jumps.to_vec();
    raconteur_base::order::sort_by_number(&mut order, |jump| jump[0]);
    let mut stretches: Vec<SmoothedSpan> = Vec::new();
    for jump in order {
        let mut next = calm(jump);
        while let Some(last) = stretches.pop_if(|last| last.span()[1] > next.span()[0]) {
            let end = last.jump[1].max(next.jump[1]);
            next = calm([last.jump[0].min(next.jump[0]), end]);
        }
        stretches.push(next);
    }
    stretches
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns an arm whose forearm flips from one end of its range to the other instantly, at 1 s.
    fn flips(secs: f64) -> ArmSolution {
        let pronation_rad = if secs < 1.0 { 1.3 } else { -1.4 } + 0.2 * secs;
        let angles = WristAngles {
            pronation_rad,
            ..WristAngles::relaxed(Side::Left)
        };
        ArmSolution {
            scapula: DQuat::IDENTITY,
            shoulder: DQuat::IDENTITY,
            elbow: DQuat::IDENTITY,
            wrist: angles.rotation(Side::Left),
            elbow_in_world: DVec3::ZERO,
            error_m: 0.0,
            hand_error_rad: 0.5,
            reached: true,
        }
    }

    #[test]
    fn a_jump_becomes_a_way() {
        let calming = JumpSmoothing::find([(0.0, 2.0)].into_iter(), &flips);
        assert_eq!(calming.stretches.len(), 1);
        let at = |secs: f64| {
            let mut arm = flips(secs);
            calming.correct(Side::Left, secs, &mut arm);
            arm.wrist
        };
        let speed = |secs: f64| at(secs).angle_between(at(secs + 1e-3)) * 1e3;
        let fastest = (0..1999).map(|i| speed(f64::from(i) * 1e-3));
        let fastest = fastest.fold(0.0, f64::max);
        assert!(fastest < CALM_RAD_PER_S + 1.0, "{fastest} rad/s");
        assert_eq!(at(0.5), flips(0.5).wrist);
        assert_eq!(at(1.5), flips(1.5).wrist);
    }

    #[test]
    fn what_does_not_jump_is_left_alone() {
        let still = |secs: f64| flips(0.5 * secs);
        let calming = JumpSmoothing::find([(0.0, 1.9)].into_iter(), &still);
        assert!(
            calming.stretches.is_empty(),
            "a motion without jumps needs no smoothing"
        );
    }
}
