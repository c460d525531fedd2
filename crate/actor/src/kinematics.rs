//! Frames of single bones.

use raconteur_base::{DAffine3, DQuat, Length};
use raconteur_body::{Bone, Pose, Skeleton};

/// Returns the transform from one bone to world in a pose, without solving the whole skeleton.
#[must_use]
pub fn world_from_bone(skeleton: &Skeleton, pose: &Pose, bone: Bone) -> DAffine3 {
    let mut world = DAffine3::IDENTITY;
    let mut at = Some(bone.index());
    while let Some(i) = at {
        let joint = &skeleton.joints()[i];
        let local = DAffine3::from_rotation_translation(
            joint.zero_rotation * pose.joint_rotation(joint.drive),
            joint.translation_in_parent + pose.joint_offset(joint.drive),
        );
        world = local * world;
        at = joint.parent;
    }
    DAffine3::from_rotation_translation(pose.root_rotation, pose.root_offset_in_world) * world
}

/// Returns the rotation of a rigid transform as a unit quaternion.
#[must_use]
pub fn rotation_of(affine: &DAffine3) -> DQuat {
    DQuat::from_mat3(&affine.matrix3).normalized()
}
