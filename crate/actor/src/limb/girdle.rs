//! Shoulder girdle: the scapula rises and reaches with its arm.

use raconteur_base::curve::smooth;
use raconteur_base::{DAffine3, DQuat, DVec3, Length, Side};
use raconteur_body::{Bone, Pose, Skeleton};

use super::ARM_BONES;
use crate::kinematics::{rotation_of, world_from_bone};

/// Greatest rise of the clavicle with the arm, radians: 20° of the arm's 180°. Designed, within
/// the 30° at its sternal end that Inman et al. 1944 measured.
const SCAPULA_RISE_RAD: f64 = 0.34;
/// Angle below the horizontal (sine) from which an arm raises the scapula, and the range in which
/// the rise becomes complete. Designed: a hanging arm leaves it down.
const SCAPULA_RISE_FROM: f64 = 0.3;
const SCAPULA_RISE_RANGE: f64 = 1.25;
/// Distance of the wrist, as a share of the reach, from which the scapula rises, and the range
/// in which the rise becomes complete. Designed.
const SCAPULA_RISE_REACH: [f64; 2] = [0.35, 0.6];
/// Greatest protraction of the scapula for a direction of unit weight, radians. Designed.
const SCAPULA_PROTRACTION_RAD: f64 = 0.2;
/// Weights in the protraction of a wrist in front and of one across the chest. Designed.
const PROTRACTION_AHEAD: f64 = 0.7;
const PROTRACTION_ACROSS: f64 = 0.5;
/// Distance of the wrist, as a share of the reach, from which the scapula protracts, and the
/// range in which the protraction becomes complete. Designed.
const SCAPULA_PROTRACTION_REACH: [f64; 2] = [0.5, 0.5];

/// Measures of one scapula on the thorax that do not depend on the pose; computes the motion of the
/// shoulder girdle with the arm.
#[derive(Clone, Debug)]
pub struct Girdle {
    /// +1 on the left, −1 on the right.
    sign: f64,
    scapula_in_thorax: DVec3,
    shoulder_in_scapula: DVec3,
    thorax_zero: DQuat,
    scapula_zero: DQuat,
    /// Upper arm and forearm stretched, metres.
    reach_m: f64,
}

impl Girdle {
    /// Measures one side of a skeleton with an arm of a given reach, metres.
    #[must_use]
    pub fn new(skeleton: &Skeleton, side: Side, reach_m: f64) -> Self {
        let [scapula, shoulder, ..] = ARM_BONES[side.index()].map(Bone::index);
        let joints = skeleton.joints();
        Self {
            sign: side.sign(),
            scapula_in_thorax: joints[scapula].translation_in_parent,
            shoulder_in_scapula: joints[shoulder].translation_in_parent,
            thorax_zero: rotation_of(&world_from_bone(skeleton, &Pose::zero(), Bone::Thoracic)),
            scapula_zero: joints[scapula].zero_rotation,
            reach_m,
        }
    }

    /// Returns the shoulder joint for a transform of the thorax and a local rotation of the
    /// scapula, world, metres.
    #[must_use]
    pub fn shoulder_at(&self, world_from_thorax: &DAffine3, scapula: DQuat) -> DVec3 {
        world_from_thorax.transform_point3(
            self.scapula_in_thorax + self.scapula_zero * (scapula * self.shoulder_in_scapula),
        )
    }

    /// Returns the base of an arm ([`super::LimbRig::base`]) for a thorax and a scapula rotation:
    /// world from the scapula, its rotation, and the shoulder joint, world, metres.
    #[must_use]
    pub fn placed(&self, world_from_thorax: &DAffine3, scapula: DQuat) -> (DQuat, DVec3) {
        let turned = rotation_of(world_from_thorax) * self.scapula_zero * scapula;
        (turned, self.shoulder_at(world_from_thorax, scapula))
    }

    /// Returns the rotation of the scapula bone for a wrist: it rises by up to 0.34 rad as the
    /// wrist rises and moves away from the body, and by a shrug, radians; it protracts as far as
    /// the wrist is ahead and not across the chest.
    #[must_use]
    pub fn scapula_for(
        &self,
        world_from_thorax: &DAffine3,
        wrist_in_world: DVec3,
        shrug_rad: f64,
    ) -> DQuat {
        let base = self.shoulder_at(world_from_thorax, DQuat::IDENTITY);
        let world_from_body = rotation_of(world_from_thorax) * self.thorax_zero.inverse();
        let to = world_from_body.inverse() * (wrist_in_world - base) / self.reach_m;
        let length = to.magnitude();
        let direction = to / length.max(1e-9);
        let sign = self.sign;
        let stretched = share_of_range(length, SCAPULA_RISE_REACH);
        let rise = SCAPULA_RISE_RAD
            * smooth((direction.y + SCAPULA_RISE_FROM) / SCAPULA_RISE_RANGE)
            * stretched;
        let ahead = PROTRACTION_AHEAD * direction.z - PROTRACTION_ACROSS * sign * direction.x;
        let protract =
            SCAPULA_PROTRACTION_RAD * ahead * share_of_range(length, SCAPULA_PROTRACTION_REACH);
        // Local y points to the front and z down (left) or up (right); see the frames of
        // `raconteur_body::skeleton`.
        DQuat::from_rotation_z(protract) * DQuat::from_rotation_y(sign * (rise + shrug_rad))
    }
}

/// Returns 0 below the start of a range and 1 beyond its end, smooth in between; the range is start
/// and length.
fn share_of_range(value: f64, [start, length]: [f64; 2]) -> f64 {
    smooth((value - start) / length)
}
