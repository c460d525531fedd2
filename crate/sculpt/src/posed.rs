//! Figure in poses other than its bind pose.

use raconteur_base::{DAffine3, DQuat};
use raconteur_body::figure::Figure;
use raconteur_body::pose::Pose;
use raconteur_body::skeleton::Bone;

/// Returns the rotation of a bone in the bind pose, world from bone.
fn bound(figure: &Figure, bone: Bone) -> DQuat {
    let bind = figure.inverse_bind[bone.index()].inverse();
    bind.to_scale_rotation_translation().1
}

/// Returns the bind pose of a figure as joint rotations.
pub(crate) fn bind_pose(figure: &Figure) -> Pose {
    let mut pose = Pose::zero();
    for bone in Bone::ALL {
        let world = bound(figure, bone);
        let local = bone
            .parent()
            .map_or(world, |p| bound(figure, p).inverse() * world);
        let zero = figure.skeleton.joints()[bone.index()].zero_rotation;
        pose.set(bone, zero.inverse() * local);
    }
    pose
}

/// Adds a rotation given in world axes of the bind pose.
pub(crate) fn turn(pose: &mut Pose, figure: &Figure, bone: Bone, world: DQuat) {
    let b = bound(figure, bone);
    pose.set(bone, pose.rotation(bone) * (b.inverse() * world * b));
}

/// Returns the transform of each joint from the bind pose to a pose, both in the world.
pub(crate) fn moved(figure: &Figure, pose: &Pose) -> Vec<DAffine3> {
    let mut world = Vec::new();
    figure.skeleton.solve(pose, &mut world);
    let pairs = world.iter().zip(&figure.inverse_bind);
    pairs.map(|(w, b)| *w * *b).collect()
}
