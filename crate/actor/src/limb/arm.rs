//! Arm solver: converts wrist position and hand rotation to joint rotations in closed form (GEVH
//! section 3.3.2.1: two links and a spherical wrist; targets outside the workspace are projected
//! onto it). Gestures and animations drive an arm by its wrist; manipulators drive it by its joints
//! ([`crate::manipulator`]), through the same girdle, chain, swivel and limits.
//!
//! Every solution is a function of the goal alone and smooth where possible:
//! - the girdle rises and reaches with the arm ([`Girdle`]);
//! - the elbow goes where hand, body and comfort want it ([`super::swivel`]);
//! - the elbow eases out towards the end of the reach;
//! - a hand rotation that the wrist cannot reach is brought back to its limits, softly.

use std::sync::Arc;

use raconteur_base::{DAffine3, DQuat, DVec3, Length, Side};
use raconteur_body::{Bone, Pose, Skeleton};

use super::body_space::BodySpace;
use super::chain::{LimbBase, LimbRig};
use super::girdle::Girdle;
use super::obstacles::Obstacles;
use super::swivel::SwivelCriteria;
use super::wrist::{WristAngles, WristLimits};
use super::{ARM_BONES, Build, RigidFrame};
use crate::kinematics::world_from_bone;

/// The last share of the reach, in which the elbow eases out instead of snapping: a wrist
/// there stays short of its goal by up to 0.4 of this share (2 mm). Designed.
const SOFT_SHARE: f64 = 0.01;
/// Farthest position that a plan requests, as a share of the reach: more than the trunk's sway.
const PLANNED_SHARE: f64 = 1.03;

/// Target of an arm: wrist position, optional hand rotation, and shoulder elevation.
#[derive(Clone, Copy, Debug)]
pub struct ArmGoal {
    /// Position of the wrist, world, metres.
    pub wrist_in_world: DVec3,
    /// Hand rotation ([`crate::palm`]); `None` leaves the wrist relaxed.
    pub hand_in_world: Option<DQuat>,
    /// Extra rise of the shoulder, radians: breath and shrugs.
    pub shrug_rad: f64,
}

/// Solved local rotations of one arm's bones, with the remaining errors of wrist and hand.
#[derive(Clone, Copy, Debug)]
pub struct ArmSolution {
    /// Rotation of the scapula bone.
    pub scapula: DQuat,
    /// Rotation of the shoulder.
    pub shoulder: DQuat,
    /// Rotation of the elbow: flexion only.
    pub elbow: DQuat,
    /// Rotation of the wrist; its twist about x is the forearm's pronation.
    pub wrist: DQuat,
    /// Position of the elbow, world, metres.
    pub elbow_in_world: DVec3,
    /// Distance between the wrist and its goal, metres.
    pub error_m: f64,
    /// Angle between the hand and its goal, radians; 0 without a requested rotation.
    pub hand_error_rad: f64,
    /// True if the wrist position lies in the workspace: the error is then below 1e-9 m, or up to 2
    /// mm in the last hundredth of the reach, where the elbow is eased.
    pub reached: bool,
}

impl ArmSolution {
    /// Writes the local rotations of scapula, shoulder, elbow and wrist into a pose, for the arm of
    /// the given side.
    pub fn apply(&self, side: Side, pose: &mut Pose) {
        let [scapula, shoulder, elbow, wrist] = ARM_BONES[side.index()];
        pose.set(scapula, self.scapula);
        pose.set(shoulder, self.shoulder);
        pose.set(elbow, self.elbow);
        pose.set(wrist, self.wrist);
    }
}

/// Measures of one arm of a figure that do not depend on the pose; solves its joints for a wrist
/// and a hand rotation.
#[derive(Clone, Debug)]
pub struct ArmRig {
    side: Side,
    girdle: Girdle,
    limb: LimbRig,
    wrist: WristLimits,
    space: BodySpace,
    thorax_zero_in_world: DAffine3,
    /// Shoulder in the zero pose, world, metres.
    shoulder_in_world: DVec3,
}

/// An arm that is solved.
struct SolvedArm {
    solution: ArmSolution,
    /// World from the lower bone.
    lower: DQuat,
}

impl ArmRig {
    /// Measures both arms of a skeleton, left and right; shared by all that move them.
    #[must_use]
    pub fn both(skeleton: &Skeleton, build: &Build) -> [Arc<Self>; 2] {
        Side::BOTH.map(|side| Arc::new(Self::new(skeleton, side, build)))
    }

    /// Measures the arm on one side of a skeleton.
    #[must_use]
    pub fn new(skeleton: &Skeleton, side: Side, build: &Build) -> Self {
        let zero = Pose::zero();
        let limb = LimbRig::new(skeleton, side, true, build.sex);
        let [_, shoulder, ..] = ARM_BONES[side.index()];
        Self {
            side,
            girdle: Girdle::new(skeleton, side, limb.chain.reach_m()),
            wrist: WristLimits::new(side, limb.limits()),
            limb,
            space: BodySpace::new(skeleton, build.trunk),
            thorax_zero_in_world: world_from_bone(skeleton, &zero, Bone::Thoracic),
            shoulder_in_world: world_from_bone(skeleton, &zero, shoulder).translation,
        }
    }

    /// Returns the side of the body that the arm is on.
    #[must_use]
    pub fn side(&self) -> Side {
        self.side
    }

    /// Returns the shoulder girdle that carries the arm.
    #[must_use]
    pub fn girdle(&self) -> &Girdle {
        &self.girdle
    }

    /// Returns the bones and joints of the arm.
    #[must_use]
    pub fn limb(&self) -> &LimbRig {
        &self.limb
    }

    /// Returns the body space that the arm must not enter.
    #[must_use]
    pub fn space(&self) -> &BodySpace {
        &self.space
    }

    /// Returns the length of the stretched arm from shoulder to wrist, metres.
    #[must_use]
    pub fn reach_m(&self) -> f64 {
        self.limb.chain.reach_m()
    }

    /// Returns the shoulder joint in the zero pose, world, metres.
    #[must_use]
    pub fn shoulder_in_world(&self) -> DVec3 {
        self.shoulder_in_world
    }

    /// Returns the transform from thorax to world in the zero pose.
    #[must_use]
    pub fn world_from_thorax_zero(&self) -> DAffine3 {
        self.thorax_zero_in_world
    }

    /// Solves for a goal with the thorax where it is.
    #[must_use]
    pub fn solve(&self, world_from_thorax: &DAffine3, goal: &ArmGoal) -> ArmSolution {
        self.solved(world_from_thorax, goal).solution
    }

    fn solved(&self, world_from_thorax: &DAffine3, goal: &ArmGoal) -> SolvedArm {
        let (wrist_in_world, shrug_rad) = (goal.wrist_in_world, goal.shrug_rad);
        let girdle = &self.girdle;
        let scapula = girdle.scapula_for(world_from_thorax, wrist_in_world, shrug_rad);
        let base = self.base(world_from_thorax, scapula);
        let chain = &self.limb.chain;
        let wanted = wrist_in_world - base.origin;
        let distance = wanted.magnitude();
        let spare_m = SOFT_SHARE * self.reach_m();
        let flexion = chain.flexion_for(chain.eased_m(distance, spare_m));
        let met_m = chain.distance_m(flexion);
        let error_m = (met_m - distance).abs();
        // A wrist in the shoulder hangs.
        let direction = wanted.try_normalized().unwrap_or(base.rotation * DVec3::X);
        let turn = goal.hand_in_world.unwrap_or(DQuat::IDENTITY);
        let target = RigidFrame {
            position: base.origin + direction * met_m,
            rotation: self.limb.target_rotation(turn),
        };
        let swivel = self.swivel(world_from_thorax, &base, &target, goal);
        let elbow_to = self.limb.elbow_at(&target, &base, swivel);
        let upper = chain.aim(flexion, direction, elbow_to);
        let elbow = chain.flexed(flexion);
        let lower = upper * chain.zero() * elbow;
        let (wrist, hand_error_rad) = if goal.hand_in_world.is_some() {
            let local = self.limb.end_for(lower, target.rotation);
            let limited = self.wrist.limited(local);
            (limited, limited.angle_between(local))
        } else {
            (DQuat::IDENTITY, 0.0)
        };
        let solution = ArmSolution {
            scapula,
            shoulder: ((base.parent * self.limb.upper_zero).inverse() * upper).normalized(),
            elbow,
            wrist,
            elbow_in_world: base.origin + upper * chain.hinge(),
            error_m,
            hand_error_rad,
            reached: distance <= self.reach_m() && error_m < spare_m,
        };
        SolvedArm { solution, lower }
    }

    /// Returns the base of the arm on a thorax, for a scapula rotation.
    fn base(&self, world_from_thorax: &DAffine3, scapula: DQuat) -> LimbBase {
        let girdle = self.girdle.placed(world_from_thorax, scapula);
        self.limb.base(world_from_thorax, Some(girdle))
    }

    /// Returns the swivel angle of the elbow. Both arms are solved independently, and gestures
    /// separate the hands: the other arm is not considered here.
    fn swivel(
        &self,
        world_from_thorax: &DAffine3,
        base: &LimbBase,
        target: &RigidFrame,
        goal: &ArmGoal,
    ) -> f64 {
        let body_from_figure = self.thorax_zero_in_world * world_from_thorax.inverse();
        let obstacles = Obstacles {
            body: &self.space,
            body_from_figure,
            head: body_from_figure
                .inverse()
                .transform_point3(self.space.head()),
            other_forearm: None,
        };
        let comfort = SwivelCriteria {
            obstacles: Some(&obstacles),
            is_relaxed: goal.hand_in_world.is_none(),
            ..SwivelCriteria::default()
        };
        self.limb.swivel_for(target, base, &comfort)
    }

    /// Returns `wrist_in_world`, or, if it is far out of reach, the nearest position that is only
    /// slightly out of reach (3 %) with the thorax of the zero pose: hands then slow down instead
    /// of hitting the limit of the arm.
    #[must_use]
    pub fn within_reach(&self, wrist_in_world: DVec3) -> DVec3 {
        let thorax = self.thorax_zero_in_world;
        let scapula = self.girdle.scapula_for(&thorax, wrist_in_world, 0.0);
        let shoulder_at = self.girdle.shoulder_at(&thorax, scapula);
        let to = wrist_in_world - shoulder_at;
        let most = PLANNED_SHARE * self.reach_m();
        if to.magnitude() <= most {
            wrist_in_world
        } else {
            shoulder_at + to.clamp_length_max(most)
        }
    }

    /// Returns the hand rotation of a relaxed wrist at a position, with the thorax of the zero
    /// pose: the default for keyframes without a palm.
    #[must_use]
    pub fn relaxed_hand(&self, wrist_in_world: DVec3) -> DQuat {
        self.hand_from_angles(wrist_in_world, &WristAngles::relaxed(self.side))
    }

    /// Returns a hand rotation at a position as wrist angles of a natural arm, thorax in the zero
    /// pose.
    #[must_use]
    pub fn angles_of_hand(&self, wrist_in_world: DVec3, hand_in_world: DQuat) -> WristAngles {
        let target = self.limb.target_rotation(hand_in_world);
        let lower = self.natural(wrist_in_world).lower;
        WristAngles::from_local(self.side, self.limb.end_for(lower, target))
    }

    /// Returns the hand rotation, world, of wrist angles at a wrist position, for a natural arm;
    /// the inverse of [`ArmRig::angles_of_hand`].
    #[must_use]
    pub fn hand_from_angles(&self, wrist_in_world: DVec3, angles: &WristAngles) -> DQuat {
        let lower = self.natural(wrist_in_world).lower;
        let turned = self.limb.turn_on(lower, angles.rotation(self.side));
        turned.normalized()
    }

    /// Solves the arm for a wrist position with a relaxed hand, the thorax in the zero pose.
    fn natural(&self, wrist_in_world: DVec3) -> SolvedArm {
        let goal = ArmGoal {
            wrist_in_world,
            hand_in_world: None,
            shrug_rad: 0.0,
        };
        self.solved(&self.thorax_zero_in_world, &goal)
    }

    /// Returns the natural posture of scapula, shoulder and elbow for a wrist position, world,
    /// metres, with the thorax in the zero pose.
    #[must_use]
    pub fn posture(&self, wrist_in_world: DVec3) -> ArmPosture {
        let solution = self.natural(wrist_in_world).solution;
        ArmPosture {
            scapula: solution.scapula,
            shoulder: solution.shoulder,
            flexion_rad: self.limb.chain.flexion_of(solution.elbow),
        }
    }

    /// Returns the hand rotation of a solution: the requested rotation within the wrist's limits.
    #[must_use]
    pub fn hand_of(&self, world_from_thorax: &DAffine3, s: &ArmSolution) -> DQuat {
        let (parent, _) = self.girdle.placed(world_from_thorax, s.scapula);
        let turned = self.limb.end_turn(parent, [s.shoulder, s.elbow, s.wrist]);
        turned.normalized()
    }

    /// Returns the wrist position of a posture, with the thorax of the zero pose, world, metres.
    #[must_use]
    pub fn wrist_of(&self, posture: &ArmPosture) -> DVec3 {
        let thorax = &self.thorax_zero_in_world;
        let (parent, shoulder_at) = self.girdle.placed(thorax, posture.scapula);
        let upper = parent * self.limb.upper_zero * posture.shoulder;
        shoulder_at + upper * self.limb.chain.end_in_upper(posture.flexion_rad)
    }
}

/// Joints of an arm that place its wrist; used to interpolate between wrist positions by joint
/// angles.
#[derive(Clone, Copy, Debug)]
pub struct ArmPosture {
    /// Rotation of the scapula bone.
    scapula: DQuat,
    /// Rotation of the shoulder.
    shoulder: DQuat,
    /// Flexion of the elbow, radians.
    flexion_rad: f64,
}

impl ArmPosture {
    /// Interpolates towards another posture by a share; shares outside 0..1 extrapolate.
    #[must_use]
    pub fn lerp(&self, to: &Self, s: f64) -> Self {
        Self {
            scapula: self.scapula.slerp(to.scapula, s).normalized(),
            shoulder: self.shoulder.slerp(to.shoulder, s).normalized(),
            flexion_rad: self.flexion_rad + (to.flexion_rad - self.flexion_rad) * s,
        }
    }
}

#[cfg(test)]
mod tests;
