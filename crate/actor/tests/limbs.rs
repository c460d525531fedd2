//! Exactness of the limbs' inverse kinematics: every solution, limits and reach.

use raconteur_actor::limb::chain::{LimbBase, LimbRig};
use raconteur_actor::limb::limits::{Sex, limits};
use raconteur_actor::limb::solve::{AT_EASE, SolutionCriteria};
use raconteur_actor::limb::swivel::SwivelCriteria;
use raconteur_actor::limb::{Joints, Limb, RigidFrame};
use raconteur_base::{DQuat, DVec3, Side, noise};
use raconteur_body::{Pose, Skeleton};

/// Random targets for each limb; 100,000 in all.
const TARGETS: i64 = 25_000;
const LIMBS: [(Side, bool); 4] = [
    (Side::Left, true),
    (Side::Right, true),
    (Side::Left, false),
    (Side::Right, false),
];

fn rig(side: Side, is_arm: bool) -> LimbRig {
    LimbRig::new(&Skeleton::example(), side, is_arm, Sex::Male)
}

/// Returns a base at a skewed position, so nothing lies on an axis by chance.
fn base(rig: &LimbRig) -> LimbBase {
    let skeleton = Skeleton::example();
    let mut pose = Pose::zero();
    pose.root_rotation = DQuat::from_scaled_axis(DVec3::new(0.2, -0.7, 0.4));
    pose.root_offset_in_world = DVec3::new(0.3, 0.2, -0.4);
    rig.base(&rig.trunk(&skeleton, &pose), None)
}

/// Returns the position of the elbow without obstacles.
fn elbow(rig: &LimbRig, target: &RigidFrame, base: &LimbBase) -> DVec3 {
    rig.elbow_at(
        target,
        base,
        rig.swivel_for(target, base, &SwivelCriteria::default()),
    )
}

/// A random target in reach of a limb without limits.
fn target(rig: &LimbRig, base: &LimbBase, i: i64) -> RigidFrame {
    let r = |k| noise::signed(31, k, i);
    let [shortest, longest] = rig.distances_m(false);
    let direction = DVec3::new(r(0), r(1), r(2))
        .try_normalize()
        .unwrap_or(DVec3::Z);
    let share = noise::unit(31, 3, i);
    RigidFrame {
        position: base.origin + direction * (shortest + (longest - shortest) * share),
        rotation: DQuat::from_xyzw(r(4), r(5), r(6), r(7)).normalize(),
    }
}

#[test]
fn a_hundred_thousand_targets_are_met_by_every_solution() {
    for (side, is_arm) in LIMBS {
        let rig = rig(side, is_arm);
        let base = base(&rig);
        let (mut off, mut turned): (f64, f64) = (0.0, 0.0);
        for i in 0..TARGETS {
            let target = target(&rig, &base, i);
            let aside = elbow(&rig, &target, &base);
            let found = rig.solutions(&target, aside, &base, false);
            assert_eq!(found.as_slice().len(), 8);
            let one = &found.as_slice()[i as usize % 8];
            let met = rig.posed(one, &base).frame;
            off = off.max(met.position.distance(target.position));
            turned = turned.max(met.rotation.angle_between(target.rotation));
        }
        assert!(off < 1e-5, "{side:?} {is_arm}: {off} m");
        assert!(turned.to_degrees() < 1e-3, "{side:?} {is_arm}: {turned}");
    }
}

#[test]
fn limits_hold_for_every_target() {
    for (side, is_arm) in LIMBS {
        let rig = rig(side, is_arm);
        let base = base(&rig);
        for i in 0..TARGETS / 5 {
            let target = target(&rig, &base, i);
            let aside = elbow(&rig, &target, &base);
            let found = rig.solutions(&target, aside, &base, false);
            let choice = SolutionCriteria {
                limited: 1.0,
                current: None,
                preferred: &AT_EASE,
            };
            let joints = rig.choose(&found, &target, &base, &choice).expect("one");
            for (angle, limit) in joints.iter().zip(rig.limits()) {
                assert!(limit.contains(*angle), "{side:?} {is_arm} {i}: {joints:?}");
            }
        }
    }
}

#[test]
fn what_is_out_of_reach_is_projected_onto_the_boundary() {
    for (side, is_arm) in LIMBS {
        let rig = rig(side, is_arm);
        let base = base(&rig);
        for limited in [0.0, 1.0] {
            let [shortest, longest] = rig.distances_m(limited > 0.5);
            for i in 0..2_000 {
                let target = target(&rig, &base, i);
                let direction = (target.position - base.origin).normalize();
                for (distance, bound) in [
                    (longest * (1.01 + noise::unit(9, 1, i)), longest),
                    (shortest * 0.99 * noise::unit(9, 2, i), shortest),
                ] {
                    let (near, moved) = rig.projected(direction * distance, limited);
                    assert!(
                        moved && (near.length() - bound).abs() < 1e-12,
                        "the target is moved onto the boundary"
                    );
                    let frame = RigidFrame {
                        position: base.origin + near,
                        ..target
                    };
                    let aside = elbow(&rig, &frame, &base);
                    let found = rig.solutions(&frame, aside, &base, true);
                    let met = rig.posed(&found.as_slice()[0], &base).frame.position;
                    let on = (met - base.origin).length();
                    assert!((on - bound).abs() < 1e-7, "{side:?} {is_arm}: {on} {bound}");
                    assert!(
                        (met - frame.position).length() < 1e-5,
                        "the limb reaches the projected target"
                    );
                }
            }
        }
    }
}

/// Solutions of the table's six joints by brute force: Newton's method from a grid of
/// starting points, equal ones counted once.
fn by_brute_force(rig: &LimbRig, base: &LimbBase, target: &RigidFrame) -> Vec<Joints> {
    let error = |joints: &Joints| -> [f64; 6] {
        let frame = rig.posed(joints, base).frame;
        let p = frame.position - target.position;
        let turn = target.rotation.inverse() * frame.rotation;
        let turn = if turn.w < 0.0 { -turn } else { turn };
        [p.x, p.y, p.z, turn.x, turn.y, turn.z]
    };
    let norm = |e: &[f64; 6]| e.iter().map(|x| x * x).sum::<f64>();
    let mut found: Vec<Joints> = Vec::new();
    for start in 0..600 {
        let mut joints: Joints = [0.0; 7];
        for (k, joint) in joints.iter_mut().take(6).enumerate() {
            *joint = 3.2 * noise::signed(77, k as u64, start);
        }
        for _ in 0..40 {
            let now = error(&joints);
            if norm(&now) < 1e-22 {
                break;
            }
            let mut rows = [[0.0; 7]; 6];
            for k in 0..6 {
                let mut moved = joints;
                moved[k] += 1e-6;
                let then = error(&moved);
                for (row, (a, b)) in rows.iter_mut().zip(now.iter().zip(then)) {
                    row[k] = (b - a) / 1e-6;
                }
            }
            for (row, e) in rows.iter_mut().zip(now) {
                row[6] = -e;
            }
            let Some(step) = gauss(rows) else { break };
            for (joint, by) in joints.iter_mut().zip(step) {
                *joint += by.clamp(-0.5, 0.5);
            }
        }
        let wrap = raconteur_base::ops::wrap_angle;
        let same = |other: &Joints| {
            let all = other.iter().zip(&joints);
            all.map(|(a, b)| wrap(a - b).abs()).fold(0.0, f64::max) < 1e-4
        };
        if norm(&error(&joints)) < 1e-18 && !found.iter().any(same) {
            found.push(joints.map(wrap));
        }
    }
    found
}

/// Solves six linear equations; `None` when they are singular.
fn gauss(mut rows: [[f64; 7]; 6]) -> Option<[f64; 6]> {
    for i in 0..6 {
        let pivot = (i..6).max_by(|a, b| rows[*a][i].abs().total_cmp(&rows[*b][i].abs()))?;
        rows.swap(i, pivot);
        if rows[i][i].abs() < 1e-9 {
            return None;
        }
        for k in 0..6 {
            if k != i {
                let by = rows[k][i] / rows[i][i];
                let from = rows[i];
                for (cell, of) in rows[k].iter_mut().zip(from) {
                    *cell -= by * of;
                }
            }
        }
    }
    Some([0, 1, 2, 3, 4, 5].map(|i| rows[i][6] / rows[i][i]))
}

#[test]
fn every_branch_is_found() {
    for (side, is_arm) in LIMBS {
        let rig = rig(side, is_arm);
        let base = base(&rig);
        for i in 0..4 {
            let target = target(&rig, &base, 1000 + i);
            let found = rig.table_solutions(&target, &base);
            for joints in found.as_slice() {
                let met = rig.posed(joints, &base).frame;
                assert!(
                    met.position.distance(target.position) < 1e-7,
                    "the branch reaches the target position"
                );
                assert!(
                    met.rotation.angle_between(target.rotation) < 1e-6,
                    "the branch reaches the target rotation"
                );
            }
            let brute = by_brute_force(&rig, &base, &target);
            assert_eq!(found.as_slice().len(), brute.len(), "{side:?} {is_arm} {i}");
            let wrap = raconteur_base::ops::wrap_angle;
            for joints in &brute {
                let near = |other: &Joints| {
                    let all = other.iter().zip(joints);
                    all.map(|(a, b)| wrap(a - b).abs()).fold(0.0, f64::max) < 1e-4
                };
                assert!(found.as_slice().iter().any(near), "{joints:?} is missing");
            }
        }
    }
}

#[test]
fn bones_and_angles_convert_both_ways() {
    for (side, is_arm) in LIMBS {
        let rig = rig(side, is_arm);
        let base = base(&rig);
        for i in 0..2_000 {
            let mut joints: Joints = [0.0; 7];
            for (k, joint) in joints.iter_mut().enumerate() {
                *joint = 1.5 * noise::signed(3, k as u64, i);
            }
            let posed = rig.posed(&joints, &base);
            let back = rig.joints_of(posed.rotations, &base);
            let wrap = raconteur_base::ops::wrap_angle;
            let near = |other: &Joints| {
                let all = other.iter().zip(joints);
                all.map(|(a, b)| wrap(a - b).abs()).fold(0.0, f64::max) < 1e-6
            };
            assert!(back.as_slice().iter().any(near), "{joints:?}");
        }
    }
}

#[test]
fn equal_angles_mirror_each_other() {
    let skeleton = Skeleton::example();
    for is_arm in [true, false] {
        let rigs = Side::BOTH.map(|side| rig(side, is_arm));
        let bases = rigs
            .each_ref()
            .map(|r| r.base(&r.trunk(&skeleton, &Pose::zero()), None));
        for i in 0..200 {
            let mut joints: Joints = [0.0; 7];
            for (k, joint) in joints.iter_mut().enumerate() {
                *joint = 1.5 * noise::signed(4, k as u64, i);
            }
            let [left, right] = [0, 1].map(|s| rigs[s].posed(&joints, &bases[s]).frame.position);
            let off = raconteur_base::mirror_vector(left).distance(right);
            assert!(off < 1e-9, "{is_arm} {joints:?}: {off}");
        }
    }
}

#[test]
fn joints_turn_the_way_they_say() {
    let skeleton = Skeleton::example();
    let degrees = |limb: Limb, joint: usize, by: f64| {
        let (side, is_arm) = limb.side().expect("a limb");
        let rig = rig(side, is_arm);
        let base = rig.base(&rig.trunk(&skeleton, &Pose::zero()), None);
        let mut joints: Joints = [0.0; 7];
        joints[joint] = by.to_radians();
        let frame = rig.posed(&joints, &base).frame;
        (frame.position - base.origin, frame.rotation)
    };
    let (hanging, turn) = degrees(Limb::LeftArm, 0, 0.0);
    assert!(
        hanging.y < -0.55 && hanging.x.abs() < 0.02,
        "the hanging arm points down"
    );
    // Hanging: x down, y left, z front.
    assert!(
        (turn * DVec3::X).y < -0.99 && (turn * DVec3::Y).x > 0.99,
        "the axes of the hanging arm point down and to the left"
    );
    assert!(
        degrees(Limb::LeftArm, 0, 90.0).0.x > 0.55,
        "the left arm rises outwards"
    );
    assert!(
        degrees(Limb::RightArm, 0, 90.0).0.x < -0.55,
        "the right arm rises outwards"
    );
    for limb in [Limb::LeftArm, Limb::RightArm] {
        assert!(
            degrees(limb, 1, 90.0).0.z > 0.55,
            "the second angle swings the arm forwards"
        );
        assert!(
            degrees(limb, 2, 90.0).0.z > 0.2,
            "the third angle bends the forearm forwards"
        );
    }
    assert!(
        degrees(Limb::LeftLeg, 0, 45.0).0.x > 0.5,
        "the left leg spreads outwards"
    );
    assert!(
        degrees(Limb::RightLeg, 1, 90.0).0.z > 0.8,
        "the right leg swings forwards"
    );
    assert!(
        degrees(Limb::RightLeg, 2, 90.0).0.z < -0.3,
        "the bent right knee moves the shank backwards"
    );
    // Pronation turns the thumb (front) inwards, a bent wrist the hand; the toes go down.
    assert!(
        (degrees(Limb::LeftArm, 3, 60.0).1 * DVec3::Z).x < -0.5,
        "pronation turns the left thumb inwards"
    );
    assert!(
        (degrees(Limb::RightArm, 3, 60.0).1 * DVec3::Z).x > 0.5,
        "pronation turns the right thumb inwards"
    );
    assert!(
        (degrees(Limb::LeftArm, 5, 60.0).1 * DVec3::X).x < -0.5,
        "the bent left wrist turns the hand inwards"
    );
    assert!(
        (degrees(Limb::LeftArm, 4, 30.0).1 * DVec3::X).z > 0.4,
        "the left wrist deviates forwards"
    );
    assert!(
        (degrees(Limb::LeftLeg, 4, 40.0).1 * DVec3::Z).y < -0.5,
        "the left toes point down"
    );
}

#[test]
fn limits_are_those_of_the_sex() {
    let [male, female] = [Sex::Male, Sex::Female].map(|s| limits(Limb::LeftArm, s)[2].max_rad);
    assert!(female > male, "the female limit exceeds the male one");
}
