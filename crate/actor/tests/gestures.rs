//! Properties of single gestures: courses, phases, the speed of free motion, stillness.

use std::sync::Arc;

use raconteur_actor::gesture::{
    ArmPlan, ArmScript, GesturePhase, GestureStroke, HandKey, HandState, IdleSettings,
    InterpolationSpace, Transition,
};
use raconteur_actor::kinematics::world_from_bone;
use raconteur_actor::{Actor, ArmRig, Build, FaceRig, Performance, palm};
use raconteur_base::profile::Profile;
use raconteur_base::{DVec3, Side};
use raconteur_body::hand_shape::HandShape;
use raconteur_body::{Bone, Pose, Skeleton};
use raconteur_speech::{Phone, TimedUtterance, Utterance};

/// No idle life.
const STILL: IdleSettings = IdleSettings {
    seed: 1,
    amount: 0.0,
    dominant: Side::Right,
};
const FROM: DVec3 = DVec3::new(-0.16, 1.25, 0.33);
const TO: DVec3 = DVec3::new(-0.36, 1.42, 0.26);

fn key(time_secs: f64, wrist: DVec3) -> HandKey {
    HandKey {
        time_secs,
        wrist_in_world: Some(wrist),
        ..HandKey::default()
    }
}

fn by(profile: Profile) -> Transition {
    Transition {
        profile: Some(profile),
        space: None,
    }
}

fn stroke(start_secs: f64, end_secs: f64, keys: &[HandKey]) -> GestureStroke {
    GestureStroke {
        start_secs,
        end_secs,
        keys: keys.to_vec(),
        ..GestureStroke::default()
    }
}

fn phase(phase: GesturePhase, start_secs: f64, end_secs: f64, keys: &[HandKey]) -> GestureStroke {
    GestureStroke {
        phase,
        ..stroke(start_secs, end_secs, keys)
    }
}

/// The right arm's plan of some strokes, without idle life.
fn plan(strokes: &[GestureStroke]) -> ArmPlan {
    let script = ArmScript {
        strokes: strokes.to_vec(),
        on: Vec::new(),
    };
    let skeleton = Skeleton::example();
    let rig = Arc::new(ArmRig::new(&skeleton, Side::Right, &Build::default()));
    ArmPlan::new(&script, &skeleton, rig, &STILL)
}

/// A stroke of one second from [`FROM`] to [`TO`] with a course.
fn course(course: Transition) -> ArmPlan {
    let to = HandKey {
        wrist_course: course,
        ..key(3.0, TO)
    };
    plan(&[stroke(2.0, 3.0, &[key(2.0, FROM), to])])
}

#[test]
fn wrists_follow_the_profile_of_their_key() {
    let profiles = [
        Profile::Linear,
        Profile::Cosine,
        Profile::Bezier([0.2, 0.0, 0.4, 1.3]),
        Profile::Hermite([0.0, -2.0]),
    ];
    for profile in profiles {
        let plan = course(by(profile));
        for i in 0..=50 {
            let s = f64::from(i) / 50.0;
            let expected = FROM + (TO - FROM) * profile.sample(s);
            let found = plan.sample(2.0 + s).wrist;
            assert!(found.distance(expected) < 1e-9, "{profile:?} at {s}");
        }
    }
    // The profile overshoots the key and returns.
    let plan = course(by(Profile::Hermite([0.0, -2.0])));
    let past = |t: f64| (plan.sample(t).wrist - FROM).dot(TO - FROM) / (TO - FROM).length_squared();
    assert!(
        past(2.8) > 1.1 && (past(3.0) - 1.0).abs() < 1e-9,
        "the wrist overshoots and returns to its key"
    );
}

#[test]
fn profiles_of_several_keys_make_a_piecewise_one() {
    let middle = HandKey {
        wrist_course: by(Profile::Linear),
        ..key(2.5, FROM.lerp(TO, 0.8))
    };
    let last = HandKey {
        wrist_course: by(Profile::Hermite([3.0, 0.0])),
        ..key(3.0, TO)
    };
    let plan = plan(&[stroke(2.0, 3.0, &[key(2.0, FROM), middle, last])]);
    let way = |t: f64| plan.sample(t).wrist.distance(FROM) / TO.distance(FROM);
    assert!(
        (way(2.25) - 0.4).abs() < 1e-9,
        "the first part of the piecewise profile"
    );
    let expected = 0.8 + 0.2 * Profile::Hermite([3.0, 0.0]).sample(0.5);
    assert!(
        (way(2.75) - expected).abs() < 1e-9,
        "the second part of the piecewise profile"
    );
}

#[test]
fn the_pace_of_a_stroke_is_over_the_profiles_of_its_keys() {
    let to = HandKey {
        wrist_course: by(Profile::Cosine),
        ..key(3.0, TO)
    };
    let outer = Profile::Bezier([0.6, 0.0, 0.9, 0.6]);
    let mut paced = stroke(2.0, 3.0, &[key(2.0, FROM), to]);
    paced.pace = Some(outer);
    let plan = plan(&[paced]);
    for i in 0..=20 {
        let s = f64::from(i) / 20.0;
        let expected = FROM + (TO - FROM) * Profile::Cosine.sample(outer.sample(s));
        assert!(plan.sample(2.0 + s).wrist.distance(expected) < 1e-9, "{s}");
    }
}

#[test]
fn by_joint_the_elbow_turns_steadily_and_the_wrist_swings() {
    let joint = |profile| Transition {
        profile: Some(profile),
        space: Some(InterpolationSpace::Joint),
    };
    let plan = course(joint(Profile::Linear));
    let straight = course(by(Profile::Linear));
    assert!(
        plan.sample(2.0).wrist.distance(FROM) < 1e-9,
        "the wrist starts at its first key"
    );
    assert!(
        plan.sample(3.0).wrist.distance(TO) < 1e-9,
        "the wrist ends at its last key"
    );
    let bent = plan.sample(2.5).wrist.distance(straight.sample(2.5).wrist);
    assert!(bent > 0.01, "{bent} m");
    // The posture determines the shoulder, so the distance to it determines the elbow.
    let skeleton = Skeleton::example();
    let rig = ArmRig::new(&skeleton, Side::Right, &Build::default());
    let [a, b] = [FROM, TO].map(|p| rig.posture(p));
    let expected = rig.wrist_of(&a.lerp(&b, 0.25));
    assert!(
        plan.sample(2.25).wrist.distance(expected) < 3e-3,
        "the wrist follows the interpolated joints"
    );
}

#[test]
fn hands_and_fingers_follow_the_profile_of_their_key() {
    let normal = DVec3::X;
    let turned = |angle| palm::hand_rotation(Side::Right, normal, angle);
    let (fist, flat) = (HandShape::get(1), HandShape::get(4));
    let first = HandKey {
        hand_in_world: turned(1.2),
        shape: fist.map(|s| *s.angles()),
        ..key(2.0, FROM)
    };
    let second = HandKey {
        time_secs: 3.0,
        hand_in_world: turned(1.7),
        hand_course: by(Profile::Linear),
        shape: flat.map(|s| *s.angles()),
        shape_course: by(Profile::Linear),
        ..HandKey::default()
    };
    let plan = plan(&[stroke(2.0, 3.0, &[first, second])]);
    for s in [0.1, 0.25, 0.5, 0.9] {
        let found = plan.sample(2.0 + s);
        let expected = turned(1.2 + 0.5 * s).expect("a rotation");
        assert!(found.hand.angle_between(expected) < 1e-3, "{s}");
        let [from, to] = [first.shape, second.shape].map(|s| s.expect("a shape"));
        let expected = from.lerp(&to, s);
        assert!(found.shape.greatest_difference(&expected) < 1e-9, "{s}");
        // A feature without keys does not move.
        assert!(found.wrist.distance(FROM) < 1e-9, "{s}");
    }
}

#[test]
fn phases_take_the_times_that_the_script_gives_them() {
    let plan = plan(&[
        phase(GesturePhase::Preparation, 1.0, 2.2, &[key(2.2, FROM)]),
        phase(GesturePhase::Hold, 2.2, 2.9, &[]),
        stroke(2.9, 3.4, &[key(2.9, FROM), key(3.4, TO)]),
        phase(GesturePhase::Hold, 3.4, 5.4, &[]),
        phase(GesturePhase::PartialRetraction, 5.4, 6.0, &[]),
        phase(GesturePhase::Retraction, 6.0, 7.5, &[]),
    ]);
    let at = |t: f64| plan.sample(t).wrist;
    let rest = at(0.0);
    // The preparation begins at its scripted time, not at the planner's.
    assert!(
        at(1.0).distance(rest) < 1e-9 && at(1.15).distance(rest) > 1e-4,
        "the preparation starts at its scripted time"
    );
    assert!(
        at(2.2).distance(FROM) < 1e-9,
        "the stroke starts at its first position"
    );
    for t in [2.3, 2.6, 2.9] {
        assert!(at(t).distance(FROM) < 1e-9, "{t}");
    }
    // The hold is longer than the planner's own holds.
    for t in [3.4, 4.0, 5.0, 5.4] {
        assert!(at(t).distance(TO) < 1e-9, "{t}");
    }
    let partial = at(6.0);
    assert!(
        partial.distance(TO) > 0.05 && partial.distance(rest) > 0.05,
        "the partial retraction ends between stroke and rest"
    );
    assert_eq!(plan.state_at(6.5), HandState::Busy);
    assert!(
        at(7.4).distance(rest) > 1e-5 && at(7.5).distance(rest) < 1e-9,
        "the retraction ends at its scripted time"
    );
    assert_eq!(plan.state_at(7.6), HandState::Rest);
}

#[test]
fn a_first_key_with_a_course_is_reached_by_it_from_the_beginning_of_its_stroke() {
    let to = HandKey {
        wrist_course: by(Profile::Linear),
        ..key(4.0, TO)
    };
    let plan = plan(&[stroke(2.0, 2.5, &[key(2.0, FROM)]), stroke(3.0, 4.0, &[to])]);
    let way = |t: f64| plan.sample(t).wrist.distance(FROM) / TO.distance(FROM);
    assert!(
        way(3.0) < 1e-9,
        "the wrist stays at the last key until the stroke"
    );
    assert!((way(3.25) - 0.25).abs() < 1e-9, "{}", way(3.25));
}

#[test]
fn gestures_at_one_time_join_by_feature() {
    let shape = HandShape::get(24).map(|s| *s.angles());
    let other = HandKey {
        time_secs: 2.5,
        shape,
        ..HandKey::default()
    };
    let alone = plan(&[stroke(2.0, 3.0, &[key(2.0, FROM), key(3.0, TO)])]);
    let both = plan(&[
        stroke(2.0, 3.0, &[key(2.0, FROM), key(3.0, TO)]),
        stroke(2.5, 2.8, &[other]),
    ]);
    for i in 0..=20 {
        let t = 1.0 + 0.1 * f64::from(i);
        assert!(
            both.sample(t).wrist.distance(alone.sample(t).wrist) < 1e-9,
            "{t}"
        );
    }
    let wanted = shape.expect("a shape");
    assert!(
        both.sample(2.5).shape.greatest_difference(&wanted) < 1e-9,
        "the joined gesture has the wanted hand shape"
    );
}

#[test]
fn fingers_may_gesture_while_the_arm_rests() {
    let shape = HandShape::get(24).map(|s| *s.angles());
    let key = HandKey {
        time_secs: 2.0,
        shape,
        ..HandKey::default()
    };
    let plan = plan(&[stroke(2.0, 2.5, &[key])]);
    let target = plan.sample(2.2);
    assert_eq!((target.rest_share, target.hand_rest_share), (1.0, 1.0));
    assert_eq!(target.finger_rest_share, 0.0);
    let later = plan.sample(6.0);
    assert_eq!((later.rest_share, later.finger_rest_share), (1.0, 1.0));
}

/// Peaks of a speed profile, and its peak over its mean, over the time between two times that
/// the hand moves at more than a hundredth of its peak.
fn speed_profile(plan: &ArmPlan, from: f64, to: f64) -> (usize, f64) {
    let n = 400;
    let h = (to - from) / f64::from(n);
    let at = |i: u32| plan.sample(from + h * f64::from(i)).wrist;
    let speeds: Vec<f64> = (0..n).map(|i| at(i).distance(at(i + 1)) / h).collect();
    let peak = speeds.iter().copied().fold(0.0, f64::max);
    // A peak is where rising turns to falling by more than rounding.
    let (mut peaks, mut rising, mut turn) = (0, true, 0.0_f64);
    for v in &speeds {
        if rising && *v < turn - 1e-3 * peak {
            (peaks, rising, turn) = (peaks + 1, false, *v);
        } else if !rising && *v > turn + 1e-3 * peak {
            (rising, turn) = (true, *v);
        }
        turn = if rising { turn.max(*v) } else { turn.min(*v) };
    }
    let mean = speeds.iter().sum::<f64>() / f64::from(n);
    (peaks, peak / mean)
}

#[test]
fn free_movements_have_one_peak_of_speed_that_people_have() {
    let place = |i: i64, k: u64| {
        let v = |c| raconteur_base::noise::signed(k, c, i);
        DVec3::new(-0.28 + 0.2 * v(0), 1.3 + 0.3 * v(1), 0.33 + 0.14 * v(2))
    };
    let mut movements = 0;
    for i in 0..70 {
        let (a, b) = (place(i, 1), place(i, 2));
        if a.distance(b) < 0.08 {
            continue;
        }
        // Preparation, a movement between two strokes, retraction.
        let plan = plan(&[
            stroke(3.0, 3.4, &[key(3.0, a)]),
            stroke(4.2, 4.4, &[key(4.2, b)]),
        ]);
        let moves = |t: f64| plan.sample(t).wrist.distance(plan.sample(t + 1e-3).wrist) > 1e-9;
        let times: Vec<f64> = (1_500..7_000).map(|t| f64::from(t) * 1e-3).collect();
        let moving: Vec<f64> = times.into_iter().filter(|t| moves(*t)).collect();
        let mut from = moving[0];
        for pair in moving.windows(2) {
            if pair[1] - pair[0] > 0.0015 {
                check_movement(&plan, from, pair[0], i);
                movements += 1;
                from = pair[1];
            }
        }
        check_movement(&plan, from, moving[moving.len() - 1], i);
        movements += 1;
    }
    assert!(movements > 150, "{movements}");
}

fn check_movement(plan: &ArmPlan, from: f64, to: f64, i: i64) {
    let (peaks, ratio) = speed_profile(plan, from, to + 1e-3);
    assert_eq!(peaks, 1, "plan {i}, {from} to {to}");
    assert!(
        (1.6..=2.1).contains(&ratio),
        "plan {i}, {from} to {to}: {ratio}"
    );
}

#[test]
fn hands_that_have_too_far_to_go_come_late_and_say_so() {
    let plan = plan(&[stroke(2.0, 2.2, &[key(2.0, FROM), key(2.02, TO)])]);
    let late = plan.keys().iter().find(|k| k.time_secs == 2.02);
    let late = late.expect("the key");
    assert!(
        late.arrives_secs > 2.1 && late.arrives_secs < 2.3,
        "the late arrival is between 2.1 and 2.3 s"
    );
    assert!(
        plan.sample(late.arrives_secs).wrist.distance(TO) < 1e-9,
        "the late wrist arrives at its key"
    );
    for i in 0..400 {
        let t = 1.0 + 0.005 * f64::from(i);
        let speed = plan.sample(t).wrist.distance(plan.sample(t + 1e-4).wrist) / 1e-4;
        assert!(speed < 4.2, "{speed} m/s at {t}");
    }
}

fn speech() -> TimedUtterance {
    let phone = |i: u32| {
        let symbol = ["m", "aa", "pau"][i as usize % 3];
        Phone::new(symbol, 0.2 * f64::from(i), 0.2 * f64::from(i + 1), None)
    };
    let utterance = Utterance {
        duration_secs: 6.0,
        phones: (0..30).map(phone).collect(),
        ..Utterance::default()
    };
    TimedUtterance {
        start_secs: 30.0,
        utterance: Arc::new(utterance),
    }
}

#[test]
fn without_motion_a_figure_moves_only_as_the_script_says() {
    let skeleton = Skeleton::example();
    let names = ["mouthSmileLeft", "browInnerUp"].map(str::to_owned);
    let face = FaceRig::from_parts(&skeleton, &names, [0.7; 2]);
    let script = ArmScript {
        strokes: vec![stroke(10.0, 14.0, &[key(10.0, FROM)])],
        on: Vec::new(),
    };
    let performance = |motion_amount| Performance {
        arms: [ArmScript::default(), script.clone()],
        speech: vec![speech()],
        seed: 3,
        motion_amount,
        ..Performance::default()
    };
    let shown = |actor: &Actor, t: f64| {
        let (mut pose, mut weights) = (Pose::zero(), vec![0.0_f32; 2]);
        actor.evaluate(&skeleton, &face, t, &mut pose, &mut weights);
        (pose, weights)
    };
    let still = Actor::new(&performance(0.0), &skeleton);
    let before = shown(&still, 0.0);
    for i in 0..90 {
        // Times before the stroke, in its hold, after it, and after the speech.
        let t = 0.1 * f64::from(i);
        assert!(shown(&still, t) == before, "at {t}");
        let later = 40.0 + 3.0 * t;
        assert!(shown(&still, later) == before, "at {later}");
        let held = 10.0 + 0.04 * f64::from(i);
        assert!(shown(&still, held) == shown(&still, 10.0), "at {held}");
    }
    // In speech only the mouth moves.
    let speaking = shown(&still, 31.3);
    let chin = Bone::Chin.index();
    for bone in Bone::ALL.into_iter().filter(|b| b.index() != chin) {
        assert_eq!(speaking.0.rotation(bone), before.0.rotation(bone));
    }
    assert_eq!(speaking.0.upper_lid_rad, before.0.upper_lid_rad);
    // With half of it there is half of the sway and there are fewer blinks.
    let sway = |amount: f64| {
        let actor = Actor::new(&performance(amount), &skeleton);
        let places = (0..600).map(|i| {
            let (pose, _) = shown(&actor, 50.0 + 0.1 * f64::from(i));
            world_from_bone(&skeleton, &pose, Bone::Thoracic)
                .translation
                .x
        });
        let (low, high) = places.fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
        high - low
    };
    let (half, whole) = (sway(0.5), sway(1.0));
    assert!(half > 0.3 * whole && half < 0.7 * whole, "{half} {whole}");
}
