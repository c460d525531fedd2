//! Tests of frames, forward kinematics and the sliding jaw.

use raconteur_base::mirror_vector;

use super::*;
use crate::Pose;

#[test]
fn local_x_runs_along_the_bone() {
    let frames = zero_frames();
    // The thesis's foot, scapula and thumb rows are not along the line to the next joint.
    for (bone, child) in [
        (Bone::LShoulder, Bone::LElbow),
        (Bone::LElbow, Bone::LWrist),
        (Bone::RShoulder, Bone::RElbow),
        (Bone::RElbow, Bone::RWrist),
        (Bone::LIndex0, Bone::LIndex1),
        (Bone::RIndex0, Bone::RIndex1),
        (Bone::RMiddle1, Bone::RMiddle2),
        (Bone::LHip, Bone::LKnee),
        (Bone::RHip, Bone::RKnee),
        (Bone::Lumbar, Bone::Thoracic),
    ] {
        let d = (child.example_position_m() - bone.example_position_m()).normalize();
        let along = (frames[bone.index()] * DVec3::X).dot(d);
        assert!(along > 0.995, "{}: {along}", bone.name());
    }
}

#[test]
fn frames_are_proper_and_mirror_each_other() {
    let frames = zero_frames();
    for bone in Bone::ALL {
        let (f, m) = (frames[bone.index()], frames[bone.mirrored().index()]);
        assert!(f.is_normalized(), "the joint frame is normalised");
        if bone.side().is_some() {
            for (axis, sign) in [(DVec3::X, 1.0), (DVec3::Y, 1.0), (DVec3::Z, -1.0)] {
                let d = mirror_vector(f * axis) - m * axis * sign;
                assert!(d.length() < 1e-9, "{} {axis}", bone.name());
            }
        }
    }
}

#[test]
fn the_zero_pose_of_the_example_reproduces_its_positions() {
    let skeleton = Skeleton::example();
    let mut world = Vec::new();
    skeleton.solve(&Pose::zero(), &mut world);
    for bone in Bone::ALL {
        let d = world[bone.index()].translation - bone.example_position_m();
        assert!(d.length() < 1e-9, "{}", bone.name());
    }
}

#[test]
fn flexing_both_elbows_alike_brings_both_hands_forward() {
    let skeleton = Skeleton::example();
    let mut pose = Pose::zero();
    pose.rotations[Bone::LElbow.index()] = DQuat::from_rotation_z(1.0);
    pose.rotations[Bone::RElbow.index()] = DQuat::from_rotation_z(1.0);
    let mut world = Vec::new();
    skeleton.solve(&pose, &mut world);
    let l = world[Bone::LWrist.index()].translation;
    let r = world[Bone::RWrist.index()].translation;
    assert!(
        l.z > 0.15 && (mirror_vector(l) - r).length() < 1e-9,
        "{l} {r}"
    );
}

#[test]
fn the_jaw_slides_forwards_and_down_and_takes_nothing_along() {
    let skeleton = Skeleton::example();
    let mut pose = Pose::zero();
    pose.root_rotation = DQuat::from_rotation_y(0.3);
    pose.rotations[Bone::Skull.index()] = DQuat::from_rotation_z(0.2);
    let solve = |pose: &Pose| {
        let mut world = Vec::new();
        skeleton.solve(pose, &mut world);
        world
    };
    let before = solve(&pose);
    pose.jaw_offset_in_skull = DVec3::new(-0.004, 0.008, 0.001);
    let after = solve(&pose);
    let chin = Bone::Chin.index();
    for (i, (a, b)) in before.iter().zip(&after).enumerate() {
        assert!(i == chin || a == b, "{}", skeleton.joints()[i].name);
    }
    let slid = after[chin].translation - before[chin].translation;
    // The axes relative to the head in the zero pose: left, up, front.
    let skull = Bone::Skull.index();
    let slid = zero_frames()[skull] * (before[skull].matrix3.transpose() * slid);
    assert!(
        (slid - DVec3::new(0.001, -0.004, 0.008)).length() < 1e-12,
        "{slid}"
    );
    assert_eq!(before[chin].matrix3, after[chin].matrix3);
    let skull_to_chin = after[chin].translation.distance(after[skull].translation);
    assert_eq!(skeleton.stretched_m(Bone::Chin, skull_to_chin), 0.0);
    assert!(
        (skeleton.stretched_m(Bone::Chin, 0.02) - 0.011).abs() < 1e-12,
        "the chin stretches beyond the free distance"
    );
    assert!(
        skeleton.stretched_m(Bone::Chin, f64::NAN).is_nan(),
        "a distance that is NaN stays NaN"
    );
    let elbow_m = skeleton.offset_length_m(Bone::LElbow);
    assert!(
        (skeleton.stretched_m(Bone::LElbow, elbow_m - 0.001) - 0.001).abs() < 1e-12,
        "a shorter bone counts as stretched"
    );
}

#[test]
fn fingers_bend_towards_the_palm_about_minus_z() {
    let frames = zero_frames();
    for bone in [Bone::LIndex1, Bone::RIndex1, Bone::LPinky0, Bone::RRing2] {
        let tip = frames[bone.index()] * (DQuat::from_rotation_z(-0.5) * DVec3::X);
        assert!(tip.y < -0.3, "{} {tip}", bone.name());
    }
}
