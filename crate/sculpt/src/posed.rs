//! A figure in other poses than the one in which it was made.

use raconteur_base::{DAffine3, DQuat, DVec3};
use raconteur_body::figure::{Figure, Mesh};
use raconteur_body::pose::Pose;
use raconteur_body::skeleton::Bone;

/// The rotation of a bone in the bind pose, world.
fn bound(figure: &Figure, bone: Bone) -> DQuat {
    let bind = figure.inverse_bind[bone.index()].inverse();
    bind.to_scale_rotation_translation().1
}

/// The pose in which the figure was made.
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

/// World from world of the bind pose, for each joint.
pub(crate) fn moved(figure: &Figure, pose: &Pose) -> Vec<DAffine3> {
    let mut world = Vec::new();
    figure.skeleton.solve(pose, &mut world);
    let pairs = world.iter().zip(&figure.inverse_bind);
    pairs.map(|(w, b)| *w * *b).collect()
}

/// What the joints of a vertex make of its place and its normal.
pub(crate) fn skinned(moved: &[DAffine3], mesh: &Mesh, v: usize) -> [DVec3; 2] {
    let [at, normal] =
        [mesh.positions[v], mesh.normals[v]].map(|p| DVec3::from_array(p.map(f64::from)));
    let carried = |k: usize| {
        let m = &moved[usize::from(mesh.joints[v][k])];
        let weight = f64::from(mesh.weights[v][k]);
        [
            m.transform_point3(at) * weight,
            m.transform_vector3(normal) * weight,
        ]
    };
    let [at, normal] = (0..4)
        .map(carried)
        .fold([DVec3::ZERO; 2], |[a, b], [p, n]| [a + p, b + n]);
    [at, normal.normalize_or_zero()]
}
