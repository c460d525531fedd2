//! Reach, angles and continuity of arms over many targets.

use super::*;
use crate::kinematics::rotation_of;
use crate::palm;
use raconteur_base::{mirror_rotation, mirror_vector, noise};

/// A random reachable wrist position around a shoulder.
fn random_target(rig: &ArmRig, i: i64) -> DVec3 {
    let r = |k| noise::signed(11, k, i);
    let d = DVec3::new(r(0), r(1), r(2))
        .try_normalize()
        .unwrap_or(DVec3::Z);
    rig.shoulder_in_world() + d * rig.reach_m() * (0.3 + 0.55 * noise::unit(11, 3, i))
}

fn random_rotation(seed: u64, i: i64) -> DQuat {
    let r = |k| noise::signed(seed, k, i);
    DQuat::from_xyzw(r(0), r(1), r(2), r(3)).normalize()
}

fn posed(s: &ArmSolution, side: Side) -> (DVec3, DQuat) {
    let mut pose = Pose::zero();
    s.apply(side, &mut pose);
    let w = world_from_bone(&Skeleton::example(), &pose, ARM_BONES[side.index()][3]);
    (w.translation, rotation_of(&w))
}

#[test]
fn ten_thousand_reachable_targets_are_met() {
    let skeleton = Skeleton::example();
    let mut worst: f64 = 0.0;
    for side in Side::BOTH {
        let rig = ArmRig::new(&skeleton, side, &Build::default());
        for i in 0..5_000 {
            let wrist_in_world = random_target(&rig, i);
            let goal = ArmGoal {
                wrist_in_world,
                hand_in_world: (i % 2 == 0).then(|| random_rotation(3, i)),
                shrug_rad: 0.02,
            };
            let s = rig.solve(&rig.world_from_thorax_zero(), &goal);
            let (at, _) = posed(&s, side);
            worst = worst.max(at.distance(wrist_in_world));
            assert!(s.reached, "{i} {}", s.error_m);
            for q in [s.scapula, s.shoulder, s.elbow, s.wrist] {
                assert!(
                    q.is_finite() && q.is_normalized(),
                    "the elbow rotation is finite and normalised"
                );
            }
        }
    }
    assert!(worst < 1e-5, "{worst} m");
}

#[test]
fn targets_out_of_reach_are_projected_and_reported() {
    let skeleton = Skeleton::example();
    let rig = ArmRig::new(&skeleton, Side::Left, &Build::default());
    for far in [1.3, 5.0] {
        let d = DVec3::new(0.5, 0.3, 0.8).normalize();
        let goal = ArmGoal {
            wrist_in_world: rig.shoulder_in_world() + d * rig.reach_m() * far,
            hand_in_world: None,
            shrug_rad: 0.0,
        };
        let s = rig.solve(&rig.world_from_thorax_zero(), &goal);
        let (at, _) = posed(&s, Side::Left);
        assert!(!s.reached, "a target out of reach is not reached");
        assert!(
            (at.distance(goal.wrist_in_world) - s.error_m).abs() < 1e-9,
            "the reported error is the distance from the target"
        );
    }
    let goal = ArmGoal {
        wrist_in_world: rig.shoulder_in_world(),
        hand_in_world: None,
        shrug_rad: 0.0,
    };
    let s = rig.solve(&rig.world_from_thorax_zero(), &goal);
    assert!(
        s.elbow.is_finite() && s.shoulder.is_finite(),
        "both rotations are finite"
    );
}

#[test]
fn comfortable_hand_rotations_are_met() {
    let skeleton = Skeleton::example();
    let rig = ArmRig::new(&skeleton, Side::Right, &Build::default());
    let s = skeleton.metres_per_eml_unit();
    // Handshake, palm up, palm to the chest, greeting.
    let front = DVec3::Z;
    for (at, fingers, normal) in [
        (DVec3::new(-8.0, 48.0, 13.0), front, DVec3::X),
        (DVec3::new(-8.0, 48.0, 13.0), front, DVec3::Y),
        (DVec3::new(-8.0, 48.0, 13.0), front, DVec3::NEG_Y),
        (
            DVec3::new(-5.0, 52.0, 12.0),
            DVec3::new(1.0, 0.2, 0.3),
            DVec3::NEG_Z,
        ),
        (DVec3::new(-13.0, 68.0, 8.0), DVec3::Y, front),
    ] {
        let goal = ArmGoal {
            wrist_in_world: at * s,
            hand_in_world: palm::from_directions(Side::Right, fingers, normal),
            shrug_rad: 0.0,
        };
        let solution = rig.solve(&rig.world_from_thorax_zero(), &goal);
        assert!(
            solution.hand_error_rad < 0.15,
            "{at} {normal}: {}",
            solution.hand_error_rad
        );
        assert!(solution.reached, "a comfortable hand rotation is reached");
    }
}

#[test]
fn wrist_angles_and_hand_rotations_convert_both_ways() {
    for side in Side::BOTH {
        let rig = ArmRig::new(&Skeleton::example(), side, &Build::default());
        for i in 0..500 {
            let (at, hand) = (random_target(&rig, i), random_rotation(21, i));
            let back = rig.hand_from_angles(at, &rig.angles_of_hand(at, hand));
            assert!(back.angle_between(hand) < 1e-6, "{i}");
        }
    }
}

#[test]
fn the_arms_mirror_each_other() {
    let skeleton = Skeleton::example();
    let rigs = Side::BOTH.map(|side| ArmRig::new(&skeleton, side, &Build::default()));
    for i in 0..500 {
        let wrist_in_world = random_target(&rigs[0], i);
        let hand = random_rotation(9, i);
        let left = rigs[0].solve(
            &rigs[0].world_from_thorax_zero(),
            &ArmGoal {
                wrist_in_world,
                hand_in_world: Some(hand),
                shrug_rad: 0.0,
            },
        );
        let right = rigs[1].solve(
            &rigs[1].world_from_thorax_zero(),
            &ArmGoal {
                wrist_in_world: mirror_vector(wrist_in_world),
                hand_in_world: Some(mirror_rotation(hand)),
                shrug_rad: 0.0,
            },
        );
        let d = mirror_vector(left.elbow_in_world) - right.elbow_in_world;
        assert!(d.length() < 1e-7, "{i} {d}");
        let (l, r) = (posed(&left, Side::Left).1, posed(&right, Side::Right).1);
        let zero = Side::BOTH.map(|side| {
            let wrist = ARM_BONES[side.index()][3];
            rotation_of(&world_from_bone(&skeleton, &Pose::zero(), wrist))
        });
        let (l, r) = (l * zero[0].inverse(), r * zero[1].inverse());
        assert!(mirror_rotation(l).angle_between(r) < 1e-6, "{i}");
    }
}

#[test]
fn the_elbow_moves_steadily_with_the_hand() {
    let skeleton = Skeleton::example();
    let rig = ArmRig::new(&skeleton, Side::Left, &Build::default());
    // In front of the frontal plane and out of the body, where hands live. The elbow outruns the
    // wrist most where the hand is near the shoulder (0.3 of the reach: three times the angle).
    let mut worst: f64 = 0.0;
    for i in 0..4_000 {
        let mut a = random_target(&rig, i);
        a.z = rig.shoulder_in_world().z + (a.z - rig.shoulder_in_world().z).abs();
        if rig.space.wrist_exit_displacement(a) != DVec3::ZERO {
            continue;
        }
        let b = a + DVec3::new(1e-4, -0.5e-4, 0.8e-4);
        let at = |wrist_in_world| {
            let goal = ArmGoal {
                wrist_in_world,
                hand_in_world: None,
                shrug_rad: 0.0,
            };
            rig.solve(&rig.world_from_thorax_zero(), &goal)
                .elbow_in_world
        };
        worst = worst.max(at(a).distance(at(b)) / a.distance(b));
    }
    assert!(worst < 5.0, "{worst}");
}
