//! Emotions and control parameters in a whole actor: effects on face, head and eyes.

use raconteur_actor::parameters::{Adsr, Parameter, ParameterCommand};
use raconteur_actor::{Actor, Affect, EmotionSpan, FaceRig, ParameterScript, Performance};
use raconteur_base::{DQuat, DVec3, ops};
use raconteur_body::face::{FaceControls, Muscle};
use raconteur_body::{Bone, Pose, Skeleton};

fn felt(word: &str) -> EmotionSpan {
    EmotionSpan {
        start_secs: 1.0,
        apex_secs: 2.0,
        until_secs: 4.0,
        end_secs: 6.0,
        affect: Affect::named(word).expect(word),
        intensity: 1.0,
    }
}

fn actor(emotions: Vec<EmotionSpan>, commands: Vec<(f64, ParameterCommand)>) -> Actor {
    let performance = Performance {
        emotions,
        parameters: ParameterScript { commands },
        motion_amount: 0.0,
        ..Performance::default()
    };
    Actor::new(&performance, &Skeleton::example())
}

fn pose(actor: &Actor, t: f64) -> Pose {
    let skeleton = Skeleton::example();
    let rig = FaceRig::from_parts(&skeleton, &[], [0.8; 2]);
    let mut pose = Pose::zero();
    actor.evaluate(&skeleton, &rig, t, &mut pose, &mut []);
    pose
}

fn one(name: &str) -> Parameter {
    Parameter::named(name).next().expect("a parameter")
}

fn contraction(controls: &FaceControls, muscle: Muscle) -> f64 {
    controls.contraction[muscle.index()]
}

/// Pitch of the line of sight, of the head and of the left eye in it, radians downwards.
fn looks_down(pose: &Pose) -> [f64; 2] {
    let down = |v: DVec3| -ops::asin_clamped(v.y);
    let neck = pose.rotation(Bone::Cervical) * pose.rotation(Bone::Skull);
    let zero = DQuat::IDENTITY;
    let head = neck.angle_between(zero);
    [head, down(pose.eyes[0] * DVec3::Z)]
}

#[test]
fn sadness_shows_in_muscles_lids_eyes_and_head() {
    let sad = actor(vec![felt("distress")], Vec::new());
    let (calm, low) = (sad.controls(0.0), sad.controls(3.0));
    assert!(
        contraction(&low, Muscle::DepressorAnguliLeft) > 0.5,
        "sadness lowers the corners of the mouth"
    );
    assert!(
        contraction(&calm, Muscle::ZygomaticusMajorLeft) > 0.1,
        "the calm face keeps a slight smile"
    );
    let smile = contraction(&low, Muscle::ZygomaticusMajorLeft);
    assert!(smile < 0.01, "the smile is gone: {smile}");
    let (before, after) = (looks_down(&pose(&sad, 0.0)), looks_down(&pose(&sad, 3.0)));
    assert!(
        (after[0] - before[0] - 0.1).abs() < 0.02,
        "{before:?} {after:?}"
    );
    // The eyes compensate the lowered head, and look down by their own angle.
    assert!(after[1] - before[1] > 0.03, "{before:?} {after:?}");
}

#[test]
fn a_face_that_feels_and_speaks_by_parameters_stays_in_its_ranges_and_never_jumps() {
    let set = |t: f64, name: &str, value: f64| (t, ParameterCommand::Set(one(name), value));
    let phases = Adsr {
        secs: [0.3, 0.2, 0.5, 0.3],
        values: [1.0, 0.6, 0.6, 0.0],
    };
    let commands = vec![
        set(0.5, "Joy", 1.0),
        set(1.5, "ZygomaticusMajorLeft", 1.0),
        set(1.8, "aa", 1.0),
        set(2.2, "PP", 1.0),
        set(2.4, "aa", 0.0),
        set(2.6, "PP", 0.0),
        set(3.0, "Joy", 0.0),
        set(3.0, "Blush", -1.0),
        (3.5, ParameterCommand::Lead(one("UpperLidLeft"), phases)),
        (3.5, ParameterCommand::Lead(one("Jaw"), phases)),
    ];
    let all = actor(vec![felt("anger"), felt("fear")], commands);
    let mut last = all.controls(0.0);
    for i in 1..6500 {
        let now = all.controls(1e-3 * f64::from(i));
        let mut limited = now;
        limited.limit();
        assert_eq!(limited, now);
        for (a, b) in now.contraction.iter().zip(last.contraction) {
            // Parameters reach their values within 0.15 s, at 1.5 times the mean speed; two of
            // them, an emotion and a closure may coincide.
            assert!((a - b).abs() < 4.0 * 1.5 / 150.0, "{i}: {a} {b}");
        }
        assert!(
            (now.blush - last.blush).abs() < 2.0 * 1.5 / 150.0,
            "the blush does not jump"
        );
        last = now;
    }
    let pressed = all.controls(2.39);
    assert!(
        pressed.seal > 0.49,
        "half of aa and half of PP: {}",
        pressed.seal
    );
    assert_eq!(all.controls(2.58).seal, 1.0);
}

#[test]
fn the_script_turns_the_eyes() {
    let set = |name: &str, value: f64| (0.0, ParameterCommand::Set(one(name), value));
    let aside = actor(Vec::new(), vec![set("GazeX", 0.4), set("GazeY", 0.2)]);
    let ahead = actor(Vec::new(), Vec::new());
    let eye = |actor: &Actor| pose(actor, 1.0).eyes[0] * DVec3::Z;
    let (to, from) = (eye(&aside), eye(&ahead));
    let yaw = |v: DVec3| ops::atan2(v.x, v.z);
    assert!((yaw(to) - yaw(from) - 0.2).abs() < 0.01, "{to} {from}");
    assert!(
        (ops::asin_clamped(to.y) - ops::asin_clamped(from.y) - 0.1).abs() < 0.01,
        "the script turns the eyes by its angle"
    );
}
