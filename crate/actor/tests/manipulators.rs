//! Effects of command scripts on manipulators.

use core::f64::consts::{FRAC_PI_2, PI};

use raconteur_actor::limb::chain::LimbRig;
use raconteur_actor::limb::limits::Sex;
use raconteur_actor::limb::{Joints, Limb, RigidFrame};
use raconteur_actor::manipulator::{
    Command, JointSpeed, ManipulatorScript, Motion, Path, PathShape, Placement, RootMotion,
};
use raconteur_actor::{Actor, FaceRig, Performance};
use raconteur_base::{DQuat, DVec3, Side, noise};
use raconteur_body::{Bone, Pose, Skeleton};

/// Target frames of a hand that points to the front palm down, of a standing foot and of an upright
/// head, in the order of the limbs.
const EASY: [fn() -> DQuat; 5] = [
    || DQuat::from_rotation_y(-FRAC_PI_2),
    || DQuat::from_rotation_y(FRAC_PI_2) * DQuat::from_rotation_z(PI),
    || DQuat::from_rotation_z(-FRAC_PI_2),
    || DQuat::from_rotation_z(-FRAC_PI_2),
    || DQuat::IDENTITY,
];

/// Returns a random path to a place at a given distance to the left.
fn random_path(seed: u64, i: i64, wild: f64, to_x: f64) -> Path {
    let r = |k: u64, i: i64| noise::signed(seed, k, i);
    let unit = |k: u64, i: i64| noise::unit(seed, k, i);
    Path {
        shape: match i % 3 {
            0 => PathShape::Segment,
            1 => PathShape::Round {
                centre: Placement::default(),
                normal: DVec3::new(r(8, i), r(9, i), r(10, i)),
                radii: [0.1 * wild, 0.15],
                from_rad: r(11, i),
                turns: 2.0 * r(12, i),
                rise: 0.1 * r(13, i),
            },
            _ => PathShape::Lemniscate {
                centre: Placement::default(),
                normal: DVec3::Z,
                half_width: 0.15,
                tilt_rad: r(14, i),
                turns: 1.0,
            },
        },
        from: Placement::default(),
        to: Placement {
            position: [Some(to_x), None, None],
            angles: [None; 3],
        },
        period_secs: 1.0 + unit(17, i),
        looping: i % 2 == 0,
    }
}

/// A random script for all limbs and the root, with switches, over some seconds.
fn random_script(seed: u64, wild: f64) -> ManipulatorScript {
    let r = |k: u64, i: i64| noise::signed(seed, k, i);
    let unit = |k: u64, i: i64| noise::unit(seed, k, i);
    let mut script = ManipulatorScript::default();
    for i in 0..40 {
        let limb = Limb::ALL[(5.0 * unit(0, i)) as usize % 5];
        let arm = limb.index() < 2;
        let place = RigidFrame {
            position: if limb == Limb::Head {
                DVec3::new(0.06 * r(1, i), 1.75, 0.06 * r(3, i)) * wild
            } else {
                let y = if arm { 1.3 } else { 0.3 } + 0.4 * r(2, i);
                DVec3::new(0.5 * r(1, i), y, 0.3 + 0.2 * r(3, i)) * wild
            },
            rotation: if wild == 1.0 {
                // Poses some distance from the comfortable ones: a hand in front, a foot down, an
                // upright head.
                let off = DQuat::from_scaled_axis(DVec3::new(r(4, i), r(5, i), r(6, i)) * 0.8);
                off * EASY[limb.index()]()
            } else {
                DQuat::from_xyzw(r(4, i), r(5, i), r(6, i), r(7, i)).normalize()
            },
        };
        let path = random_path(seed, i, wild, place.position.x);
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
                pace: JointSpeed::Secs(1.0),
            },
            4 => Motion::JointInterpolation {
                to: place,
                pace: JointSpeed::RadPerSec(1.5),
            },
            5 | 6 => Motion::FrameInterpolation {
                to: place,
                secs: 1.0 + unit(30, i),
            },
            7 | 8 => Motion::Function(Box::new(path.clone())),
            9 => Motion::JacobianTarget(place),
            10 => Motion::JacobianVelocity {
                // Targets behind the back are excluded, because the elbow has no continuous path
                // there.
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
            script.moves.push(RootMotion { time_secs, path });
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
        // When the figure walks away, a hand held in the world ends behind its back, where the
        // elbow has no continuous path.
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
            assert!(
                pose.root_offset_in_world.is_finite(),
                "the root offset is finite"
            );
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
    // Everything is under control beforehand: a hold, then a second for the limits to apply.
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
    let limbs = Side::BOTH.map(|side| [(side, true), (side, false)]);
    let rigs: Vec<(Side, bool, LimbRig)> = (limbs.into_iter().flatten())
        .map(|(side, is_arm)| {
            (
                side,
                is_arm,
                LimbRig::new(&skeleton, side, is_arm, Sex::Male),
            )
        })
        .collect();
    for i in 0..2400 {
        let pose = pose_at(&actor, &skeleton, &face, f64::from(i) / 120.0);
        for (side, is_arm, rig) in &rigs {
            let (side, is_arm) = (*side, *is_arm);
            let trunk = rig.trunk(&skeleton, &pose);
            // Joint angles need the girdle's rotation, not its position.
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
                    angle > l.min_rad - 1e-7 && angle < l.max_rad + 1e-7
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
        shape: PathShape::Round {
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
    // The motion is so slow that it takes minutes, and the forearm turns continuously.
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
