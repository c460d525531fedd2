//! Spine support for long reaches: the spine bends and turns to bring the shoulder nearer.

use raconteur_base::{DQuat, DVec3, Length, ops};
use raconteur_body::{Bone, Pose, Skeleton};

use super::motion::MotionGoal;
use super::perform::Manipulators;
use crate::kinematics::{rotation_of, world_from_bone};
use crate::limb::Limb;

/// Share of the arm's length from which the spine helps, and the width of its setting in.
/// Designed: as people begin to lean before their arm is stretched.
const BEGINS: f64 = 0.985;
const SOFT: f64 = 0.02;
/// Factor by which the spine turns more than the shoulder would need if all of the spine turned at
/// its foot.
const GAIN: f64 = 1.3;
/// Lean that is approached by the farthest targets, radians.
const MAX_RAD: f64 = 0.8;
/// Number of iterations for the additional lean that one arm needs because of the other.
const ROUNDS: usize = 3;

/// Returns the lean that an arm requires: a rotation vector in figure axes. `shoulder` is the
/// joint's position without lean, `lumbar` the foot of the spine.
pub(super) fn required_lean(shoulder: DVec3, lumbar: DVec3, target: DVec3, reach_m: f64) -> DVec3 {
    let to = target - shoulder;
    let distance = to.magnitude();
    let soft = SOFT * reach_m;
    let over = (distance - BEGINS * reach_m) / soft;
    // The softened positive part, without overflow.
    let missing = soft * (over.max(0.0) + ops::ln(1.0 + ops::exp(-over.abs())));
    let arm = shoulder - lumbar;
    let turn = arm.cross(to) * (GAIN * missing / (distance.max(1e-9) * arm.length_squared()));
    turn / (1.0 + turn.magnitude() / MAX_RAD)
}

/// Leans the spine by a rotation vector, half of it at its foot and half in the chest.
pub(super) fn apply(skeleton: &Skeleton, lean: DVec3, pose: &mut Pose) {
    if lean == DVec3::ZERO {
        return;
    }
    let half = DQuat::from_scaled_axis(0.5 * lean);
    for bone in [Bone::Lumbar, Bone::Thoracic] {
        let own = rotation_of(&world_from_bone(skeleton, pose, bone));
        let local = own.inverse() * half * own;
        pose.set(bone, (pose.rotation(bone) * local).normalized());
    }
}

impl Manipulators {
    /// Leans the spine for arms that reach far; before gestures and [`Manipulators::limbs`].
    pub fn lean(&self, skeleton: &Skeleton, time_secs: f64, pose: &mut Pose) {
        let leans = self.leans(skeleton, time_secs, pose);
        apply(skeleton, leans.into_iter().flatten().sum(), pose);
    }

    /// Returns the lean that each arm requires in a pose without lean, rotation vectors: for
    /// itself, and in addition because of the other arm.
    pub(super) fn leans(
        &self,
        skeleton: &Skeleton,
        time_secs: f64,
        upright: &Pose,
    ) -> [[DVec3; 2]; 2] {
        let arms = [Limb::LeftArm, Limb::RightArm];
        let goals = arms.map(|limb| self.goal(limb, time_secs));
        let own = [0, 1].map(|i| {
            goals[i].map_or(DVec3::ZERO, |(goal, weight)| {
                self.lean_for(arms[i], &goal, skeleton, upright) * weight
            })
        });
        [0, 1].map(|i| {
            let more = goals[i].map_or(DVec3::ZERO, |(goal, weight)| {
                let both = [own[i], own[1 - i]];
                self.help_for(arms[i], &goal, both, skeleton, upright) * weight
            });
            [own[i], more]
        })
    }

    /// Returns the lean that a goal of an arm requires in a pose without it.
    pub(super) fn lean_for(
        &self,
        limb: Limb,
        goal: &MotionGoal,
        skeleton: &Skeleton,
        pose: &Pose,
    ) -> DVec3 {
        match goal {
            MotionGoal::Joints(held, _) => held.lean,
            MotionGoal::Frame {
                frame, lean_lag, ..
            } => self.lean_to(limb, frame.position, skeleton, pose) + lean_lag[0],
        }
    }

    /// Returns the additional lean that a goal of an arm requires in a pose without lean, when arms
    /// lean it by `own` and `other`.
    pub(super) fn help_for(
        &self,
        limb: Limb,
        goal: &MotionGoal,
        [own, other]: [DVec3; 2],
        skeleton: &Skeleton,
        upright: &Pose,
    ) -> DVec3 {
        let help = |to: DVec3| {
            let mut sum = DVec3::ZERO;
            if other == DVec3::ZERO {
                return sum;
            }
            let missing = |lean: DVec3| {
                let mut pose = upright.clone();
                apply(skeleton, lean, &mut pose);
                self.lean_to(limb, to, skeleton, &pose)
            };
            // The deficit of one arm alone does not affect the other arm.
            let alone = missing(own).magnitude();
            for _ in 0..ROUNDS {
                let lacks = missing(own + other + sum);
                let share = 1.0 - alone / lacks.magnitude().max(1e-12);
                sum += lacks * share.max(0.0);
            }
            sum
        };
        match goal {
            MotionGoal::Joints(held, None) => held.help,
            MotionGoal::Joints(held, Some(aim)) => held.help + aim.share * help(aim.frame.position),
            MotionGoal::Frame {
                frame, lean_lag, ..
            } => help(frame.position) + lean_lag[1],
        }
    }

    /// Returns the lean that brings an arm to a position from a pose; zero for other limbs.
    fn lean_to(&self, limb: Limb, to: DVec3, skeleton: &Skeleton, pose: &Pose) -> DVec3 {
        let Some(arm) = self.arms.get(limb.index()) else {
            return DVec3::ZERO;
        };
        let thorax = world_from_bone(skeleton, pose, Bone::Thoracic);
        let lumbar = world_from_bone(skeleton, pose, Bone::Lumbar).translation;
        let scapula = arm.girdle().scapula_for(&thorax, to, 0.0);
        required_lean(
            arm.girdle().shoulder_at(&thorax, scapula),
            lumbar,
            to,
            arm.reach_m(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shoulder_comes_nearer_to_far_targets_only() {
        let skeleton = Skeleton::example();
        let at = |pose: &Pose, bone| world_from_bone(&skeleton, pose, bone).translation;
        let zero = Pose::zero();
        let (shoulder, lumbar) = (at(&zero, Bone::LShoulder), at(&zero, Bone::Lumbar));
        for direction in [DVec3::Z, DVec3::X, DVec3::new(-0.6, 0.3, 1.0), DVec3::Y] {
            let direction = direction.normalize();
            let near = required_lean(shoulder, lumbar, shoulder + direction * 0.4, 0.58);
            assert!(near.length() < 1e-3, "{near}");
            let target = shoulder + direction * 0.75;
            let lean = required_lean(shoulder, lumbar, target, 0.58);
            let mut pose = Pose::zero();
            apply(&skeleton, lean, &mut pose);
            let nearer = 0.75 - at(&pose, Bone::LShoulder).distance(target);
            // Upwards a spine can help only a little, by bending to the other side.
            let least = if direction.y > 0.9 { 0.01 } else { 0.08 };
            assert!(nearer > least, "{direction}: {nearer}");
        }
    }
}
