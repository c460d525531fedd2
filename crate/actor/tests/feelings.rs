//! Emotions and control parameters in a whole actor: what a figure's face, head and eyes do.

use raconteur_actor::parameters::{Adsr, Parameter, ParameterCommand};
use raconteur_actor::{Actor, EmotionSpan, FaceRig, ParameterScript, Performance};
use raconteur_base::DVec3;
use raconteur_body::face::{FaceControls, Muscle};
use raconteur_body::{Bone, Pose, Skeleton};
use raconteur_speech::emotion::place;

fn felt(word: &str) -> EmotionSpan {
    EmotionSpan {
        start_secs: 1.0,
        apex_secs: 2.0,
        until_secs: 4.0,
        end_secs: 6.0,
        place: place(word).expect(word),
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

/// How far below the horizon the head and, in it, the left eye look, radians.
fn looks_down(pose: &Pose) -> [f64; 2] {
    let head = pose.rotation(Bone::Cervical) * pose.rotation(Bone::Skull);
    let pitch = |v: DVec3| -v.y.asin_of();
    [
        head.to_scaled_axis().length(),
        pitch(pose.eyes[0] * DVec3::Z),
    ]
}

trait AsinOf {
    fn asin_of(self) -> f64;
}

impl AsinOf for f64 {
    fn asin_of(self) -> f64 {
        raconteur_base::ops::asin_clamped(self)
    }
}

#[test]
fn sadness_shows_in_muscles_eyes_and_head() {
    let sad = actor(vec![felt("distress")], Vec::new());
    let (calm, low) = (sad.controls(0.0), sad.controls(3.0));
    assert!(contraction(&low, Muscle::DepressorAnguliLeft) > 0.5);
    assert!(contraction(&calm, Muscle::ZygomaticusMajorLeft) > 0.1);
    assert!(contraction(&low, Muscle::ZygomaticusMajorLeft) < 0.01, "the smile is gone");
    assert!(low.upper_lid[0] > 0.2);
    let (before, after) = (looks_down(&pose(&sad, 0.0)), looks_down(&pose(&sad, 3.0)));
    assert!(after[0] - before[0] > 0.05, "{before:?} {after:?}");
}
