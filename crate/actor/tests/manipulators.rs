//! Manipulators: exactness of the inverse kinematics, and what scripts of commands do.

use core::f64::consts::{FRAC_PI_2, PI};

use raconteur_actor::limb::chain::{Base, LimbRig};
use raconteur_actor::limb::limits::{Sex, limits};
use raconteur_actor::limb::solve::{AT_EASE, Choice};
use raconteur_actor::limb::swivel::Comfort;
use raconteur_actor::limb::{Frame, Joints, Limb};
use raconteur_actor::manipulator::{
    Command, ManipulatorScript, Motion, Move, Pace, Path, Placement, Shape,
};
use raconteur_actor::{Actor, FaceRig, Performance};
use raconteur_base::{DQuat, DVec3, Side, noise};
use raconteur_body::{Bone, Pose, Skeleton};

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

/// A base at a skewed place, so that nothing lies on an axis by chance.
fn base(rig: &LimbRig) -> Base {
    let skeleton = Skeleton::example();
    let mut pose = Pose::zero();
    pose.root_rotation = DQuat::from_scaled_axis(DVec3::new(0.2, -0.7, 0.4));
    pose.root_offset_in_world = DVec3::new(0.3, 0.2, -0.4);
    rig.base(&rig.trunk(&skeleton, &pose), None)
}

/// Where the elbow goes when nothing is in the way.
fn elbow(rig: &LimbRig, target: &Frame, base: &Base) -> DVec3 {
    rig.elbow_at(
        target,
        base,
        rig.swivel_for(target, base, &Comfort::default()),
    )
}

/// A random target in reach of a limb without limits.
fn target(rig: &LimbRig, base: &Base, i: i64) -> Frame {
    let r = |k| noise::signed(31, k, i);
    let [shortest, longest] = rig.distances_m(false);
    let direction = DVec3::new(r(0), r(1), r(2))
        .try_normalize()
        .unwrap_or(DVec3::Z);
    let share = noise::unit(31, 3, i);
    Frame {
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
            let choice = Choice {
                limited: 1.0,
                current: None,
                preferred: &AT_EASE,
            };
            let joints = rig.choose(&found, &target, &base, &choice).expect("one");
            for (angle, limit) in joints.iter().zip(rig.limits()) {
                assert!(limit.holds(*angle), "{side:?} {is_arm} {i}: {joints:?}");
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
                    assert!(moved && (near.length() - bound).abs() < 1e-12);
                    let frame = Frame {
                        position: base.origin + near,
                        ..target
                    };
                    let aside = elbow(&rig, &frame, &base);
                    let found = rig.solutions(&frame, aside, &base, true);
                    let met = rig.posed(&found.as_slice()[0], &base).frame.position;
                    let on = (met - base.origin).length();
                    assert!((on - bound).abs() < 1e-7, "{side:?} {is_arm}: {on} {bound}");
                    assert!((met - frame.position).length() < 1e-5);
                }
            }
        }
    }
}

/// Solutions of the table's six joints by brute force: Newton's method from a grid of
/// starting points, equal ones counted once.
fn by_brute_force(rig: &LimbRig, base: &Base, target: &Frame) -> Vec<Joints> {
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

/// Solves six equations; none when they are singular.
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
                assert!(met.position.distance(target.position) < 1e-7);
                assert!(met.rotation.angle_between(target.rotation) < 1e-6);
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
    assert!(hanging.y < -0.55 && hanging.x.abs() < 0.02);
    // Hanging: x down, y left, z front.
    assert!((turn * DVec3::X).y < -0.99 && (turn * DVec3::Y).x > 0.99);
    assert!(degrees(Limb::LeftArm, 0, 90.0).0.x > 0.55);
    assert!(degrees(Limb::RightArm, 0, 90.0).0.x < -0.55);
    for limb in [Limb::LeftArm, Limb::RightArm] {
        assert!(degrees(limb, 1, 90.0).0.z > 0.55);
        assert!(degrees(limb, 2, 90.0).0.z > 0.2);
    }
    assert!(degrees(Limb::LeftLeg, 0, 45.0).0.x > 0.5);
    assert!(degrees(Limb::RightLeg, 1, 90.0).0.z > 0.8);
    assert!(degrees(Limb::RightLeg, 2, 90.0).0.z < -0.3);
    // Pronation turns the thumb (front) inwards, a bent wrist the hand; the toes go down.
    assert!((degrees(Limb::LeftArm, 3, 60.0).1 * DVec3::Z).x < -0.5);
    assert!((degrees(Limb::RightArm, 3, 60.0).1 * DVec3::Z).x > 0.5);
    assert!((degrees(Limb::LeftArm, 5, 60.0).1 * DVec3::X).x < -0.5);
    assert!((degrees(Limb::LeftArm, 4, 30.0).1 * DVec3::X).z > 0.4);
    assert!((degrees(Limb::LeftLeg, 4, 40.0).1 * DVec3::Z).y < -0.5);
}

#[test]
fn limits_are_those_of_the_sex() {
    let [male, female] = [Sex::Male, Sex::Female].map(|s| limits(Limb::LeftArm, s)[2].most_rad);
    assert!(female > male);
}

/// Target frames of a hand that points to the front palm down, of a standing foot and of a
/// head that is upright, in the order of the limbs.
const EASY: [fn() -> DQuat; 5] = [
    || DQuat::from_rotation_y(-FRAC_PI_2),
    || DQuat::from_rotation_y(FRAC_PI_2) * DQuat::from_rotation_z(PI),
    || DQuat::from_rotation_z(-FRAC_PI_2),
    || DQuat::from_rotation_z(-FRAC_PI_2),
    || DQuat::IDENTITY,
];

/// A random script for all limbs and the root, with switches, over some seconds.
fn random_script(seed: u64, wild: f64) -> ManipulatorScript {
    let r = |k: u64, i: i64| noise::signed(seed, k, i);
    let unit = |k: u64, i: i64| noise::unit(seed, k, i);
    let mut script = ManipulatorScript::default();
    for i in 0..40 {
        let limb = Limb::ALL[(5.0 * unit(0, i)) as usize % 5];
        let arm = limb.index() < 2;
        let place = Frame {
            position: if limb == Limb::Head {
                DVec3::new(0.06 * r(1, i), 1.75, 0.06 * r(3, i)) * wild
            } else {
                let y = if arm { 1.3 } else { 0.3 } + 0.4 * r(2, i);
                DVec3::new(0.5 * r(1, i), y, 0.3 + 0.2 * r(3, i)) * wild
            },
            rotation: if wild == 1.0 {
                // Some way off the easy poses: a hand to the front, a foot down, a head upright.
                let off = DQuat::from_scaled_axis(DVec3::new(r(4, i), r(5, i), r(6, i)) * 0.8);
                off * EASY[limb.index()]()
            } else {
                DQuat::from_xyzw(r(4, i), r(5, i), r(6, i), r(7, i)).normalize()
            },
        };
        let path = Path {
            shape: match i % 3 {
                0 => Shape::Segment,
                1 => Shape::Round {
                    centre: Placement::default(),
                    normal: DVec3::new(r(8, i), r(9, i), r(10, i)),
                    radii: [0.1 * wild, 0.15],
                    from_rad: r(11, i),
                    turns: 2.0 * r(12, i),
                    rise: 0.1 * r(13, i),
                },
                _ => Shape::Lemniscate {
                    centre: Placement::default(),
                    normal: DVec3::Z,
                    half_width: 0.15,
                    tilt_rad: r(14, i),
                    turns: 1.0,
                },
            },
            from: Placement::default(),
            to: Placement {
                position: [Some(place.position.x), None, None],
                angles: [None; 3],
            },
            period_secs: 1.0 + unit(17, i),
            looping: i % 2 == 0,
        };
        let motion = match (12.0 * unit(18, i)) as usize {
            0 => Motion::Configure {
                preferred: (unit(23, i) < 0.5).then(|| vec![r(24, i), r(25, i)]),
                is_on: Some(unit(19, i) < 0.5),
                limits: None,
            },
            1 => Motion::Configure {
                preferred: None,
                is_on: Some(true),
                limits: Some(unit(19, i) < 0.6),
            },
            2 => Motion::Joints {
                angles: [0, 1, 2, 3, 4, 5].map(|k| (k % 2 == 0).then(|| r(20 + k, i))),
                secs: 0.5,
            },
            3 => Motion::JointInterpolation {
                to: place,
                pace: Pace::Secs(1.0),
            },
            4 => Motion::JointInterpolation {
                to: place,
                pace: Pace::RadPerSec(1.5),
            },
            5 | 6 => Motion::FrameInterpolation {
                to: place,
                secs: 1.0 + unit(30, i),
            },
            7 | 8 => Motion::Function(Box::new(path.clone())),
            9 => Motion::JacobianTarget(place),
            10 => Motion::JacobianVelocity {
                // Never behind the back, where the elbow has no steady way.
                linear: DVec3::new(r(31, i), r(32, i), r(33, i).abs()) * 0.3,
                angular: DVec3::new(r(34, i), r(35, i), r(36, i)),
            },
            _ if i % 2 == 0 => Motion::Stop,
            _ => Motion::Lock(unit(37, i) < 0.7),
        };
        let time_secs = 20.0 * unit(38, i);
        script.commands.push(Command {
            time_secs,
            limb,
            motion,
        });
        if i % 10 == 0 {
            script.moves.push(Move { time_secs, path });
        }
    }
    script
}

fn actor(script: ManipulatorScript, seed: u64) -> Actor {
    let performance = Performance {
        manipulators: script,
        seed,
        ..Performance::default()
    };
    Actor::new(&performance, &Skeleton::example())
}

fn pose_at(actor: &Actor, skeleton: &Skeleton, face: &FaceRig, t: f64) -> Pose {
    let mut pose = Pose::zero();
    actor.evaluate(skeleton, face, t, &mut pose, &mut []);
    pose
}

#[test]
fn random_scripts_move_without_jumps() {
    let skeleton = Skeleton::example();
    let face = FaceRig::from_parts(&skeleton, &[], [0.8; 2]);
    let (mut worst, mut place) = (0.0, String::new());
    for seed in 0..8 {
        let mut script = random_script(seed, 1.0);
        // A hand that is held in the world while the figure walks away ends behind its back,
        // where the elbow has no steady way.
        script.moves.clear();
        let actor = actor(script, seed);
        let mut last = pose_at(&actor, &skeleton, &face, 0.0);
        for i in 1..=2600 {
            let t = f64::from(i) / 120.0;
            let pose = pose_at(&actor, &skeleton, &face, t);
            for bone in Bone::ALL {
                let (a, b) = (last.rotation(bone), pose.rotation(bone));
                assert!(b.is_finite() && b.is_normalized(), "{seed} {t} {bone:?}");
                let speed = a.angle_between(b) * 120.0;
                if speed > worst {
                    (worst, place) = (speed, format!("{seed} at {t}: {bone:?}"));
                }
            }
            last = pose;
        }
    }
    // The fastest that hands may be opened is 41 rad/s: see the sweep of stories.
    assert!(worst < 41.0, "{place}: {worst} rad/s");
}

#[test]
fn wild_numbers_give_poses_all_the_same() {
    let skeleton = Skeleton::example();
    let face = FaceRig::from_parts(&skeleton, &[], [0.8; 2]);
    for (seed, wild) in [(100, 1e-9), (101, 40.0), (102, 1e4), (103, 0.0)] {
        let actor = actor(random_script(seed, wild), seed);
        for i in 0..200 {
            let pose = pose_at(&actor, &skeleton, &face, f64::from(i) * 0.13);
            assert!(pose.root_offset_in_world.is_finite());
            for rotation in pose.rotations {
                assert!(rotation.is_finite() && rotation.is_normalized(), "{wild}");
            }
        }
    }
}

#[test]
fn limits_hold_throughout_while_they_are_on() {
    let skeleton = Skeleton::example();
    let face = FaceRig::from_parts(&skeleton, &[], [0.8; 2]);
    let mut script = random_script(55, 1.0);
    script.moves.clear();
    script
        .commands
        .retain(|c| !matches!(c.motion, Motion::Configure { .. }) && c.limb != Limb::Head);
    // Everything under control from before: a hold, then a second for limits to set in.
    for limb in Limb::ALL {
        script.commands.push(Command {
            time_secs: -1.0,
            limb,
            motion: Motion::Joints {
                angles: [Some(0.1); 6],
                secs: 0.5,
            },
        });
    }
    let actor = actor(script, 9);
    for i in 0..2400 {
        let pose = pose_at(&actor, &skeleton, &face, f64::from(i) / 120.0);
        for (side, is_arm) in LIMBS {
            let rig = rig(side, is_arm);
            let trunk = rig.trunk(&skeleton, &pose);
            // Joint angles need the girdle's rotation, not its place.
            let girdle = if is_arm {
                let bone = [Bone::LScapula, Bone::RScapula][side.index()];
                let at = raconteur_actor::kinematics::world_from_bone(&skeleton, &pose, bone);
                let rotation = raconteur_actor::kinematics::rotation_of(&at);
                Some((rotation, DVec3::ZERO))
            } else {
                None
            };
            let base = rig.base(&trunk, girdle);
            let found = rig.joints_of(rig.bones.map(|b| pose.rotation(b)), &base);
            let holds = |joints: &Joints| {
                let mut all = joints.iter().zip(rig.limits());
                all.all(|(a, l)| {
                    let angle = l.wrapped(*a);
                    angle > l.least_rad - 1e-7 && angle < l.most_rad + 1e-7
                })
            };
            assert!(
                found.as_slice().iter().any(holds),
                "{side:?} {is_arm} {i}: {found:?}"
            );
        }
    }
}

#[test]
fn what_has_no_end_goes_on_until_it_is_stopped() {
    let skeleton = Skeleton::example();
    let face = FaceRig::from_parts(&skeleton, &[], [0.8; 2]);
    let circle = Path {
        shape: Shape::Round {
            centre: Placement::default(),
            normal: DVec3::ZERO,
            radii: [0.05; 2],
            from_rad: 0.0,
            turns: 1.0,
            rise: 0.0,
        },
        from: Placement::default(),
        to: Placement::default(),
        period_secs: 2.0,
        looping: true,
    };
    // So slow that it takes minutes, and a forearm that turns on and on.
    let slow = Motion::JacobianVelocity {
        linear: DVec3::new(0.0, 0.002, 0.0),
        angular: DVec3::ZERO,
    };
    let moved = |motion: &Motion, stop_secs: f64, from_secs: f64, to_secs: f64| {
        let command = |time_secs, motion| Command {
            time_secs,
            limb: Limb::LeftArm,
            motion,
        };
        let script = ManipulatorScript {
            commands: vec![
                command(1.0, motion.clone()),
                command(stop_secs, Motion::Stop),
            ],
            moves: Vec::new(),
        };
        let actor = actor(script, 3);
        let [a, b] = [from_secs, to_secs].map(|t| pose_at(&actor, &skeleton, &face, t));
        let bones = [Bone::LShoulder, Bone::LElbow];
        let turns = bones.map(|bone| a.rotation(bone).angle_between(b.rotation(bone)));
        turns[0].max(turns[1])
    };
    for (motion, from_secs, to_secs) in [
        (Motion::Function(Box::new(circle)), 100.0, 101.0),
        (slow, 60.0, 90.0),
    ] {
        let on = moved(&motion, 200.0, from_secs, to_secs);
        let stopped = moved(&motion, 50.0, from_secs, to_secs);
        assert!(
            on > 0.05 && stopped < 0.5 * on,
            "{motion:?}: {on} {stopped}"
        );
    }
}
