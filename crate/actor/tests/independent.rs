//! Independence of manipulators (GEVH 3.3.2): the effect of one limb on the body moves no other
//! limb off its target.

use core::f64::consts::{FRAC_PI_2, PI};

use raconteur_actor::limb::{Limb, RigidFrame};
use raconteur_actor::manipulator::{Command, JointSpeed, ManipulatorScript, Motion};
use raconteur_actor::{Actor, FaceRig, Performance};
use raconteur_base::{DQuat, DVec3, Side};
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

fn actor(script: ManipulatorScript, seed: u64) -> Actor {
    let performance = Performance {
        manipulators: script,
        seed,
        ..Performance::default()
    };
    Actor::new(&performance, &Skeleton::example())
}

/// Returns the frame of a hand at a position, pointing to the front with its palm down.
fn forward(side: Side, position: DVec3) -> RigidFrame {
    let limb = [Limb::LeftArm, Limb::RightArm][side.index()];
    RigidFrame {
        position,
        rotation: EASY[limb.index()](),
    }
}

/// Returns the distance of each wrist of a pose from a place, and the actor's reported error from
/// its target, metres.
fn wrists(
    script: &[(f64, Limb, Motion)],
    at_secs: f64,
    places: [DVec3; 2],
) -> ([f64; 2], [f64; 2]) {
    let skeleton = Skeleton::example();
    let face = FaceRig::from_parts(&skeleton, &[], [0.8; 2]);
    let commands = script.iter().map(|(time_secs, limb, motion)| Command {
        time_secs: *time_secs,
        limb: *limb,
        motion: motion.clone(),
    });
    let actor = actor(
        ManipulatorScript {
            commands: commands.collect(),
            moves: Vec::new(),
        },
        7,
    );
    let mut pose = Pose::zero();
    let report = actor.evaluate(&skeleton, &face, at_secs, &mut pose, &mut []);
    let mut world = Vec::new();
    skeleton.solve(&pose, &mut world);
    let off = Side::BOTH.map(|side| {
        let wrist = world[Bone::on(side, "wrist").index()].translation;
        wrist.distance(places[side.index()])
    });
    (off, report.wrist_errors_m)
}

#[test]
fn an_arm_that_leans_the_trunk_leaves_the_other_on_its_target() {
    let near = DVec3::new(0.2, 1.25, 0.35);
    for metres in [0.06, 0.12, 0.18] {
        let far = DVec3::new(-0.15, 1.2, 0.55 + metres);
        let (to, lean) = (forward(Side::Left, near), forward(Side::Right, far));
        let ways = [
            Motion::FrameInterpolation { to, secs: 1.0 },
            Motion::JointInterpolation {
                to,
                pace: JointSpeed::Secs(1.0),
            },
            Motion::JacobianTarget(to),
        ];
        for way in ways {
            let told = format!("{metres} m: {way:?}");
            let lean = Motion::FrameInterpolation {
                to: lean,
                secs: 1.0,
            };
            let script = [(0.2, Limb::LeftArm, way), (4.0, Limb::RightArm, lean)];
            for at_secs in [3.9, 4.5, 6.0, 9.0] {
                let (off, errors) = wrists(&script, at_secs, [near, far]);
                assert!(off[0] < 1e-3, "{told} at {at_secs}: {off:?}");
                assert!((errors[0] - off[0]).abs() < 1e-9, "{told}: {errors:?}");
                if at_secs > 5.0 {
                    assert!((errors[1] - off[1]).abs() < 1e-9, "{told}: {errors:?}");
                }
            }
        }
    }
}

#[test]
fn an_arm_that_is_leant_away_from_asks_for_what_that_costs_it() {
    let places = [DVec3::new(0.43, 1.19, 0.52), DVec3::new(-0.73, 1.08, 0.35)];
    let line = |side: Side| Motion::FrameInterpolation {
        to: forward(side, places[side.index()]),
        secs: 1.0,
    };
    let left = (0.2, Limb::LeftArm, line(Side::Left));
    let right = (0.2, Limb::RightArm, line(Side::Right));
    let alone = [
        wrists(core::slice::from_ref(&left), 4.0, places).0[0],
        wrists(core::slice::from_ref(&right), 4.0, places).0[1],
    ];
    let (both, told) = wrists(&[left, right], 4.0, places);
    assert_eq!(
        both.map(|off| (off * 1e6).round()),
        told.map(|off| (off * 1e6).round())
    );
    for (both, alone) in both.into_iter().zip(alone) {
        assert!(both < alone + 0.02, "{both} m, alone {alone} m");
    }
}
