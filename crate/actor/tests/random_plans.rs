//! Properties of whole performances over many random plans.

use std::sync::Arc;

use raconteur_actor::TimeSpan;
use raconteur_actor::gesture::{ArmScript, GestureStroke, HandKey, HandState};
use raconteur_actor::kinematics::world_from_bone;
use raconteur_actor::{Actor, ArmRig, Build, FaceRig, Performance, palm};
use raconteur_base::{DVec3, Side, noise};
use raconteur_body::hand_shape::HandShape;
use raconteur_body::{Bone, Pose, Skeleton};
use raconteur_speech::bundle::{Accent, Syllable};
use raconteur_speech::{Phone, TimedUtterance, Utterance};

fn morph_names() -> Vec<String> {
    ["mouthClose", "mouthPucker", "browInnerUp", "mouthSmileLeft"]
        .map(str::to_owned)
        .to_vec()
}

/// Random strokes of one arm within comfortable reach in front of the body.
fn random_arm(seed: u64, side: Side) -> ArmScript {
    let id = 10 * side.index() as u64;
    let mut t = 0.8;
    let strokes = (0..12)
        .map(|i| {
            let u = |k| noise::unit(seed, id + k, i);
            t += 0.3 + 4.0 * u(0) * u(0);
            let start_secs = t;
            let keys = (0..1 + (3.0 * u(1)) as i64)
                .map(|k| {
                    let v = |c| noise::signed(seed, 100 + id + c, 10 * i + k);
                    if k > 0 {
                        t += 0.35 + 0.4 * (v(9) + 1.0);
                    }
                    let wrist = DVec3::new(
                        side.sign() * (0.26 + 0.16 * v(0)),
                        1.35 + 0.25 * v(1),
                        0.36 + 0.10 * v(2),
                    );
                    let normal = DVec3::new(-side.sign(), 0.6 * v(3), 0.6 * v(4));
                    HandKey {
                        time_secs: t,
                        wrist_in_world: Some(wrist),
                        hand_in_world: (v(5) > -0.5)
                            .then(|| {
                                palm::hand_rotation(side, normal, -side.sign() * (1.6 + 0.5 * v(6)))
                            })
                            .flatten(),
                        shape: HandShape::get((30.0 * (v(7) + 1.0)) as u8).map(|s| *s.angles()),
                        ..HandKey::default()
                    }
                })
                .collect();
            t += 0.2 * u(2);
            GestureStroke {
                start_secs,
                end_secs: t,
                keys,
                ..GestureStroke::default()
            }
        })
        .collect();
    ArmScript {
        strokes,
        on: Vec::new(),
    }
}

fn random_speech(seed: u64) -> Vec<TimedUtterance> {
    let symbols = [
        "hh", "ax", "l", "ow", "pau", "b", "iy", "m", "ay", "s", "uw",
    ];
    (0..4)
        .map(|i| {
            let mut t = 0.0;
            let phones: Vec<Phone> = (0..40)
                .map(|k| {
                    let start_secs = t;
                    t += 0.05 + 0.1 * noise::unit(seed, 50 + i, k);
                    let symbol = symbols[(k as usize * 7 + i as usize) % symbols.len()];
                    Phone::new(symbol, start_secs, t, None)
                })
                .collect();
            let utterance = Utterance {
                duration_secs: t,
                phones,
                syllables: (0..6)
                    .map(|k| Syllable {
                        first_phone: 5 * k,
                        phones: 2,
                        stress: 1,
                    })
                    .collect(),
                accents: (0..6)
                    .map(|syllable| Accent {
                        syllable,
                        label: String::new(),
                    })
                    .collect(),
                f0: (0..300).map(|k| (60 + (k * 7) % 40) as u8).collect(),
                ..Utterance::default()
            };
            TimedUtterance {
                start_secs: 1.0 + 8.0 * i as f64,
                utterance: Arc::new(utterance),
            }
        })
        .collect()
}

fn random_performance(seed: u64) -> Performance {
    Performance {
        arms: Side::BOTH.map(|side| random_arm(seed, side)),
        speech: random_speech(seed),
        seed,
        ..Performance::default()
    }
}

struct Stage {
    skeleton: Skeleton,
    face: FaceRig,
    pose: Pose,
    morphs: Vec<f32>,
}

impl Stage {
    fn new() -> Self {
        let skeleton = Skeleton::example();
        let face = FaceRig::from_parts(&skeleton, &morph_names(), [0.7; 2]);
        Self {
            skeleton,
            face,
            pose: Pose::zero(),
            morphs: vec![0.0; 4],
        }
    }

    fn evaluate(&mut self, actor: &Actor, t: f64) {
        actor.evaluate(
            &self.skeleton,
            &self.face,
            t,
            &mut self.pose,
            &mut self.morphs,
        );
    }

    fn wrist(&self, side: Side) -> DVec3 {
        let bone = if side == Side::Left {
            Bone::LWrist
        } else {
            Bone::RWrist
        };
        world_from_bone(&self.skeleton, &self.pose, bone).translation
    }
}

#[test]
fn wrists_are_at_their_keys_at_the_time_of_the_key() {
    let mut stage = Stage::new();
    let (mut worst, mut count) = (0.0_f64, 0);
    let rigs = ArmRig::both(&stage.skeleton, &Build::default());
    let reach = rigs[0].reach_m();
    for seed in 0..40 {
        let performance = random_performance(seed);
        let actor = Actor::new(&performance, &stage.skeleton);
        for side in Side::BOTH {
            for key in performance.arms[side.index()]
                .strokes
                .iter()
                .flat_map(|s| &s.keys)
            {
                stage.evaluate(&actor, key.time_secs);
                let wanted = key.wrist_in_world.unwrap_or_default();
                let wanted = actor
                    .world_from_gestures(key.time_secs)
                    .transform_point3(wanted);
                let shoulder = if side == Side::Left {
                    Bone::LShoulder
                } else {
                    Bone::RShoulder
                };
                let shoulder = world_from_bone(&stage.skeleton, &stage.pose, shoulder).translation;
                // A place out of reach without the trunk is planned nearer.
                let place = key.wrist_in_world.unwrap_or_default();
                let is_far = rigs[side.index()].within_reach(place) != place;
                if is_far || wanted.distance(shoulder) > 0.985 * reach {
                    continue;
                }
                worst = worst.max(stage.wrist(side).distance(wanted));
                count += 1;
            }
        }
    }
    assert!(count > 500, "{count} keys are checked");
    assert!(worst < 1e-3, "{worst} m");
}

#[test]
fn poses_are_rotations_and_weights_are_shares_at_every_time() {
    let mut stage = Stage::new();
    for seed in 0..20 {
        let actor = Actor::new(&random_performance(seed), &stage.skeleton);
        for i in -20..400 {
            stage.evaluate(&actor, f64::from(i) * 0.1013);
            for (q, bone) in stage.pose.rotations.iter().zip(Bone::ALL) {
                assert!(
                    q.is_finite() && (q.length() - 1.0).abs() < 1e-6,
                    "{}",
                    bone.name()
                );
            }
            assert!(
                stage
                    .pose
                    .eyes
                    .iter()
                    .all(|q| q.is_finite() && q.is_normalized()),
                "all eye rotations are finite and normalised"
            );
            assert!(
                stage.morphs.iter().all(|w| (0.0..=1.0).contains(w)),
                "all morph weights are between 0 and 1"
            );
        }
    }
}

#[test]
fn nothing_jumps_at_120_hz() {
    let mut stage = Stage::new();
    let (mut wrist_speed, mut bone_speed) = ((0.0_f64, 0.0), (0.0_f64, 0.0, ""));
    let dt = 1.0 / 120.0;
    for seed in 0..12 {
        let actor = Actor::new(&random_performance(seed), &stage.skeleton);
        let mut last: Option<([DVec3; 2], Pose)> = None;
        for i in 0..4_800 {
            let t = f64::from(i) * dt;
            stage.evaluate(&actor, t);
            let now = Side::BOTH.map(|side| stage.wrist(side));
            if let Some((wrists, pose)) = &last {
                for k in 0..2 {
                    let v = now[k].distance(wrists[k]) / dt;
                    if v > wrist_speed.0 {
                        wrist_speed = (v, t);
                    }
                }
                for bone in Bone::ALL {
                    let w = pose.rotation(bone).angle_between(stage.pose.rotation(bone)) / dt;
                    if w > bone_speed.0 {
                        bone_speed = (w, t, bone.name());
                    }
                }
            }
            last = Some((now, stage.pose.clone()));
        }
    }
    // Fast strokes of the random plans cover 0.7 m in 0.35 s at a peak of 1.9 times the mean.
    assert!(wrist_speed.0 < 4.0, "{wrist_speed:?} m/s");
    assert!(bone_speed.0 < 40.0, "{bone_speed:?} rad/s");
}

#[test]
fn seeking_in_any_order_equals_playing() {
    let mut stage = Stage::new();
    let performance = random_performance(5);
    let actor = Actor::new(&performance, &stage.skeleton);
    let times: Vec<f64> = (0..300).map(|i| f64::from(i) * 0.117).collect();
    let played: Vec<(Pose, Vec<f32>)> = times
        .iter()
        .map(|t| {
            stage.evaluate(&actor, *t);
            (stage.pose.clone(), stage.morphs.clone())
        })
        .collect();
    let again = Actor::new(&performance, &stage.skeleton);
    for i in 0..600_i64 {
        let k = (noise::unit(1, 1, i) * times.len() as f64) as usize;
        stage.evaluate(&again, times[k]);
        assert!(
            played[k] == (stage.pose.clone(), stage.morphs.clone()),
            "at {}",
            times[k]
        );
    }
}

#[test]
fn switched_off_arms_ignore_their_keys_and_switching_off_releases_them() {
    let mut stage = Stage::new();
    let mut performance = random_performance(7);
    for arm in &mut performance.arms {
        arm.on = vec![TimeSpan {
            start_secs: -1.0,
            end_secs: 6.0,
        }];
    }
    let actor = Actor::new(&performance, &stage.skeleton);
    for t in [8.0, 15.0, 30.0] {
        for side in Side::BOTH {
            let plan = actor.plan(side);
            assert_eq!(plan.state_at(t), HandState::Rest, "at {t}");
            assert_eq!(plan.sample(t).rest_share, 1.0, "at {t}");
        }
        stage.evaluate(&actor, t);
    }
}

#[test]
fn impossible_scripts_neither_panic_nor_spread() {
    let mut stage = Stage::new();
    let mut performance = random_performance(9);
    let bad = |time_secs: f64, p: f64| HandKey {
        time_secs,
        wrist_in_world: Some(DVec3::splat(p)),
        ..HandKey::default()
    };
    performance.arms[0].strokes.push(GestureStroke {
        start_secs: f64::NAN,
        end_secs: f64::INFINITY,
        keys: vec![
            bad(f64::NAN, 1.0),
            bad(2.0, f64::INFINITY),
            bad(2.1, 50.0),
            bad(2.1, 1.0),
            bad(-9.0, 0.0),
        ],
        ..GestureStroke::default()
    });
    performance.speech.push(TimedUtterance {
        start_secs: f64::NAN,
        ..TimedUtterance::default()
    });
    performance.listener_in_world = DVec3::new(0.0, 1.75, 0.05);
    let actor = Actor::new(&performance, &stage.skeleton);
    for i in 0..400 {
        stage.evaluate(&actor, f64::from(i) * 0.1);
        assert!(
            stage.pose.rotations.iter().all(|q| q.is_finite()),
            "all rotations are finite"
        );
    }
    stage.evaluate(&actor, f64::NAN);
    stage.evaluate(&actor, 1e12);
    assert!(
        stage.pose.rotations.iter().all(|q| q.is_finite()),
        "all rotations are finite after the script"
    );
}

#[test]
fn fingers_that_move_do_not_stop_the_arm() {
    let mut stage = Stage::new();
    let key = |time_secs: f64, wrist_in_world, shape| HandKey {
        time_secs,
        wrist_in_world,
        shape: HandShape::get(shape).map(|s| *s.angles()),
        ..HandKey::default()
    };
    let from = DVec3::new(-0.22, 1.05, 0.30);
    let to = DVec3::new(-0.16, 1.40, 0.32);
    let ends = [key(2.0, Some(from), 44), key(3.0, Some(to), 44)];
    let mut drumming = ends.to_vec();
    drumming.extend([2.25, 2.5, 2.75].map(|t| key(t, None, 45)));
    let actor_of = |keys: Vec<HandKey>| {
        let stroke = GestureStroke {
            start_secs: 2.0,
            end_secs: 3.0,
            keys,
            ..GestureStroke::default()
        };
        let performance = Performance {
            arms: [
                ArmScript::default(),
                ArmScript {
                    strokes: vec![stroke],
                    on: Vec::new(),
                },
            ],
            ..Performance::default()
        };
        Actor::new(&performance, &Skeleton::example())
    };
    let (plain, drumming) = (actor_of(ends.to_vec()), actor_of(drumming));
    for i in 0..300 {
        let t = 0.02 * f64::from(i);
        stage.evaluate(&plain, t);
        let expected = stage.wrist(Side::Right);
        stage.evaluate(&drumming, t);
        assert!(stage.wrist(Side::Right).distance(expected) < 1e-9, "{t} s");
    }
}

#[test]
fn a_wrist_passes_keys_that_only_turn_the_hand() {
    let mut stage = Stage::new();
    let (from, to) = (DVec3::new(-0.10, 1.15, 0.35), DVec3::new(-0.34, 1.15, 0.30));
    let key = |time_secs, wrist_in_world, turn: f64| HandKey {
        time_secs,
        wrist_in_world,
        hand_in_world: palm::hand_rotation(Side::Right, DVec3::NEG_Y, turn),
        ..HandKey::default()
    };
    let stroke = GestureStroke {
        start_secs: 2.0,
        end_secs: 2.8,
        keys: vec![
            key(2.0, Some(from), 1.6),
            key(2.3, None, 1.2),
            key(2.8, Some(to), 0.9),
        ],
        ..GestureStroke::default()
    };
    let performance = Performance {
        arms: [
            ArmScript::default(),
            ArmScript {
                strokes: vec![stroke],
                on: Vec::new(),
            },
        ],
        ..Performance::default()
    };
    let actor = Actor::new(&performance, &Skeleton::example());
    stage.evaluate(&actor, 2.3);
    let way = stage.wrist(Side::Right).distance(from) / to.distance(from);
    // The palm's key does not affect the wrist's path: the profile at 0.3 of 0.8 s.
    let expected = raconteur_base::curve::minimum_jerk(0.3 / 0.8);
    assert!((way - expected).abs() < 0.02, "{way}, not {expected}");
}
