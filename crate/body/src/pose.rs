//! Joint rotations at one time, and the resulting joint positions.

use raconteur_base::{DAffine3, DQuat, DVec3};

use crate::skeleton::{Bone, Drive, Skeleton};

/// Pose of a figure: local rotations of the 54 bones relative to the zero pose (arms stretched out
/// sideways, palms down), the root's placement, and the face's rigid parts.
///
/// The world-from-joint transform is parent · translation · `zero_rotation` · rotation. The slide
/// of the lower jaw is added to its translation.
///
/// # Examples
///
/// ```
/// use raconteur_base::DQuat;
/// use raconteur_body::Pose;
/// use raconteur_body::skeleton::Bone;
///
/// let mut pose = Pose::zero();
/// pose.set(Bone::LElbow, DQuat::from_rotation_y(-0.5));
/// assert!(pose.rotation(Bone::LElbow).angle_between(DQuat::IDENTITY) > 0.49);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    /// Displacement of the whole figure, world, metres.
    pub root_offset_in_world: DVec3,
    /// Rotation of the whole figure about the world's origin.
    pub root_rotation: DQuat,
    /// Local rotations of the bones relative to the zero pose, one per bone, in the order of
    /// [`Bone::ALL`].
    pub rotations: [DQuat; Bone::COUNT],
    /// Translation of the lower jaw from its joint, in the skull bone's frame (x up, y front, z
    /// left), metres.
    pub jaw_offset_in_skull: DVec3,
    /// Gaze of the left and right eye in the skull's zero axes (x left, y up, z front); identity
    /// looks straight ahead.
    pub eyes: [DQuat; 2],
    /// Rotation of the upper lids about the globe's x axis, radians, left and right.
    /// Zero is the rest position; positive closes.
    pub upper_lid_rad: [f64; 2],
    /// Rotation of the lower lids about the globe's x axis, radians. Positive raises.
    pub lower_lid_rad: [f64; 2],
}

impl Pose {
    /// Returns the zero pose: arms stretched out sideways, palms down, eyes ahead.
    #[must_use]
    pub fn zero() -> Self {
        Self {
            root_offset_in_world: DVec3::ZERO,
            root_rotation: DQuat::IDENTITY,
            rotations: [DQuat::IDENTITY; Bone::COUNT],
            jaw_offset_in_skull: DVec3::ZERO,
            eyes: [DQuat::IDENTITY; 2],
            upper_lid_rad: [0.0; 2],
            lower_lid_rad: [0.0; 2],
        }
    }

    /// Returns the local rotation of a bone, relative to the zero pose.
    #[must_use]
    pub fn rotation(&self, bone: Bone) -> DQuat {
        self.rotations[bone.index()]
    }

    /// Sets the local rotation of a bone, relative to the zero pose.
    pub fn set(&mut self, bone: Bone, rotation: DQuat) {
        self.rotations[bone.index()] = rotation;
    }

    /// Returns the translation of a joint with this drive from its place, in its parent's frame,
    /// metres.
    #[must_use]
    pub fn joint_offset(&self, drive: Drive) -> DVec3 {
        if drive == Drive::Bone(Bone::Chin) {
            self.jaw_offset_in_skull
        } else {
            DVec3::ZERO
        }
    }

    /// Returns the local rotation that the pose gives a joint with this drive.
    #[must_use]
    pub fn joint_rotation(&self, drive: Drive) -> DQuat {
        match drive {
            Drive::Eye(side) => self.eyes[side.index()],
            // Closing turns the upper lid down: y towards z is a positive turn about x (left); from
            // the front, the front of the globe moves down.
            Drive::UpperLid(side) => DQuat::from_rotation_x(self.upper_lid_rad[side.index()]),
            Drive::LowerLid(side) => DQuat::from_rotation_x(-self.lower_lid_rad[side.index()]),
            _ => drive
                .bone()
                .map_or(DQuat::IDENTITY, |b| drive.of_turn(self.rotation(b))),
        }
    }
}

impl Skeleton {
    /// Computes forward kinematics: world from joint for every joint, into `out` (cleared first; a
    /// reused buffer avoids allocation).
    pub fn solve(&self, pose: &Pose, out: &mut Vec<DAffine3>) {
        out.clear();
        for joint in self.joints() {
            let turn = joint
                .drive
                .bone()
                .map_or(DQuat::IDENTITY, |b| pose.rotation(b));
            let mut local = self.local(joint, pose.joint_rotation(joint.drive), turn);
            local.translation += pose.joint_offset(joint.drive);
            let world = match joint.parent {
                None => {
                    DAffine3::from_rotation_translation(
                        pose.root_rotation,
                        pose.root_offset_in_world,
                    ) * local
                }
                Some(p) => out[p] * local,
            };
            out.push(world);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::skeleton::twist_about_x;

    #[test]
    fn twist_and_swing_recompose() {
        let q = DQuat::from_rotation_z(0.7) * DQuat::from_rotation_x(1.1);
        let twist = twist_about_x(q);
        assert!(
            twist.angle_between(DQuat::from_rotation_x(1.1)) < 1e-9,
            "the twist is the rotation about x"
        );
        let swing = q * twist.inverse();
        assert!(swing.x.abs() < 1e-12, "the swing has no twist");
    }

    #[test]
    fn closing_an_upper_lid_moves_its_front_down() {
        let mut pose = Pose::zero();
        pose.upper_lid_rad = [0.5; 2];
        let q = pose.joint_rotation(Drive::UpperLid(raconteur_base::Side::Left));
        assert!(
            (q * DVec3::Z).y < 0.0,
            "closing the upper lid moves its front down"
        );
    }
}
