//! Shipped animations: each is readable, closes, stays within human joint ranges and keeps its
//! planted feet in place.

use std::fs;
use std::path::PathBuf;

use raconteur_actor::animation::{BoneSet, Library, Players};
use raconteur_actor::animation::{Operation, Playback, PlayerCommand, PlayerKind, PlayerScript};
use raconteur_actor::kinematics::{rotation_of, world_from_bone};
use raconteur_actor::limb::{ArmRig, Build, Sex};
use raconteur_base::{DAffine3, DQuat, DVec3, Side, mirror_vector, ops};
use raconteur_body::read::read_figure;
use raconteur_body::skeleton::twist_about_x;
use raconteur_body::{Bone, Pose, Skeleton};

/// The names and texts of all shipped animations.
fn shipped() -> Vec<(String, String)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../assets/animations");
    let mut found: Vec<(String, String)> = fs::read_dir(&folder)
        .expect("the library's folder")
        .filter_map(Result::ok)
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .map(|path| {
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            let text = fs::read_to_string(&path).expect("a readable file");
            (name.into_owned(), text)
        })
        .collect();
    found.sort();
    found
}

/// A player with one animation from time 0.
struct Stage {
    skeleton: Skeleton,
    players: Players,
    seconds: f64,
    closed: bool,
}

impl Stage {
    fn new(name: &str, text: &str, skeleton: &Skeleton) -> Self {
        let mut library = Library::default();
        library
            .add(name, text)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        let clip = library.get(name).expect("it was added");
        let skeleton = skeleton.clone();
        let add = PlayerCommand::Add {
            name: "p".to_owned(),
            kind: PlayerKind::Multiple(1),
            bones: BoneSet::ALL,
            exclusive: false,
        };
        let push = PlayerCommand::Operate {
            player: None,
            tracks: None,
            operation: Operation::Push(name.to_owned(), Playback::Loop),
        };
        let script = PlayerScript {
            commands: vec![(0.0, add), (0.0, push)],
        };
        let (players, problems) = Players::new(
            &script,
            &library,
            &skeleton,
            Sex::Male,
            ArmRig::both(&skeleton, &Build::default()),
        );
        assert_eq!(problems, [], "{name}");
        Self {
            skeleton,
            players,
            seconds: clip.duration_secs(),
            closed: clip.is_closed(),
        }
    }

    /// Returns the pose at a time of the clip; bones that it does not move stand, with arms
    /// hanging.
    fn pose(&self, t: f64) -> Pose {
        let mut pose = Pose::zero();
        let down = DQuat::from_rotation_z(-1.45);
        for side in Side::BOTH {
            let bone = Bone::on(side, "shoulder");
            let zero = rotation_of(&world_from_bone(&self.skeleton, &Pose::zero(), bone));
            let turn = if side == Side::Left {
                down
            } else {
                down.inverse()
            };
            pose.set(bone, zero.inverse() * turn * zero);
        }
        let animated = self.players.apply(&self.skeleton, t, &mut pose);
        for side in Side::BOTH {
            if let Some(animated) = &animated {
                animated.blend_arm(side, 1.0, 1.0, &mut pose);
            }
        }
        pose
    }

    /// Poses at 120 Hz over one pass, with their times.
    fn poses(&self) -> Vec<(f64, Pose)> {
        let n = (self.seconds * 120.0).ceil().max(1.0) as usize;
        let at = |i| self.seconds * i as f64 / n as f64;
        (0..=n).map(|i| (at(i), self.pose(at(i)))).collect()
    }

    fn world(&self, pose: &Pose) -> Vec<DAffine3> {
        let mut world = Vec::new();
        self.skeleton.solve(pose, &mut world);
        world
    }
}

/// Returns a shipped figure as performer.
fn figure(name: &str) -> Skeleton {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../../assets/figures")
        .join(format!("{name}.glb"));
    let bytes = fs::read(path).expect("the figure's file");
    read_figure(name, &bytes).expect("a figure").skeleton
}

/// Every animation, performed by every figure.
fn each(mut check: impl FnMut(&str, &Stage)) {
    let animations = shipped();
    for who in raconteur_tier::FIGURES {
        let skeleton = figure(who);
        for (name, text) in &animations {
            let stage = Stage::new(name, text, &skeleton);
            check(&format!("{who}: {name}"), &stage);
        }
    }
}

/// Fails with everything that was found.
fn none(found: &[String]) {
    assert!(found.is_empty(), "\n{}", found.join("\n"));
}

#[test]
fn there_are_forty_and_the_lesson_has_its_steps() {
    let names: Vec<String> = shipped().into_iter().map(|(n, _)| n).collect();
    assert!(names.len() >= 40, "{}", names.len());
    let lesson = names
        .iter()
        .filter(|n| n.starts_with("step-") || n.starts_with("arms-"));
    assert!(lesson.count() >= 28, "the lesson has at least 28 steps");
}

#[test]
fn loops_close_in_place_and_in_speed() {
    let mut found = Vec::new();
    each(|name, stage| {
        if !stage.closed || stage.seconds == 0.0 {
            return;
        }
        let h = 1e-4;
        // The second pass has both sides of the seam in the loop.
        let at = |t: f64| stage.world(&stage.pose(stage.seconds + t));
        let (before, now, after) = (at(-h), at(0.0), at(h));
        for bone in Bone::ALL {
            let place = |w: &[DAffine3]| w[bone.index()].translation;
            let turn = |w: &[DAffine3]| rotation_of(&w[bone.index()]);
            let (into, out) = (
                (place(&now) - place(&before)) / h,
                (place(&after) - place(&now)) / h,
            );
            let turned = [&before, &after].map(|w| turn(w).angle_between(turn(&now)) / h);
            let kink = into.distance(out);
            // A kink of 0.15 m/s is the change in an arm's speed within one film frame.
            if kink > 0.15 || (turned[0] - turned[1]).abs() > 1.0 {
                found.push(format!("{name}: {} {kink:.2} m/s {turned:?}", bone.name()));
            }
        }
    });
    none(&found);
}

#[test]
fn a_foot_on_the_floor_stays_where_it_is() {
    let mut found = Vec::new();
    each(|name, stage| {
        let zero = stage.world(&Pose::zero());
        for side in Side::BOTH {
            let ball = Bone::on(side, "metatarsal").index();
            let floor = zero[ball].translation.y;
            // The landing position of the ball of the foot, while it is down.
            let mut down: Option<DVec3> = None;
            let mut worst = (0.0_f64, 0.0);
            for (t, pose) in stage.poses() {
                let at = stage.world(&pose)[ball].translation;
                if at.y > floor + 0.002 {
                    down = None;
                    continue;
                }
                let from = *down.get_or_insert(at);
                let slid = DVec3::new(at.x - from.x, 0.0, at.z - from.z).length();
                if slid > worst.0 {
                    worst = (slid, t);
                }
                if at.y < floor - 0.004 {
                    found.push(format!("{name}: {side:?} foot under the floor at {t:.2}"));
                    break;
                }
            }
            if worst.0 > 0.01 {
                let (slid, t) = worst;
                found.push(format!(
                    "{name}: {side:?} foot slides {:.1} cm at {t:.2}",
                    slid * 100.0
                ));
            }
        }
    });
    none(&found);
}

/// GEVH table B.1, male and female together the narrower, degrees. Elevation of the shoulder
/// counts from hanging.
#[test]
fn no_joint_goes_beyond_its_limits() {
    let mut found = Vec::new();
    each(|name, stage| {
        let zero = stage.world(&Pose::zero());
        let mut worst: Vec<(String, f64, f64, f64)> = Vec::new();
        for (t, pose) in stage.poses() {
            let mut check = |what: String, value_rad: f64, low: f64, high: f64| {
                let value = value_rad.to_degrees();
                let beyond = (low - value).max(value - high);
                if beyond > 0.05 {
                    match worst.iter_mut().find(|w| w.0 == what) {
                        Some(w) if w.1 < beyond => *w = (what, beyond, value, t),
                        Some(_) => {}
                        None => worst.push((what, beyond, value, t)),
                    }
                }
            };
            // A bone's turn from the zero pose, in world axes as its parent carries them, of
            // the right side mirrored.
            let turn = |bone: Bone| {
                let frame = rotation_of(&zero[bone.index()]);
                let q = frame * pose.rotation(bone) * frame.inverse();
                if bone.side() == Some(Side::Right) {
                    raconteur_base::mirror_rotation(q)
                } else {
                    q
                }
            };
            let vector = |q: DQuat| (if q.w < 0.0 { -q } else { q }).to_scaled_axis();
            for side in Side::BOTH {
                let on = |part: &str| Bone::on(side, part);
                let label = |what: &str| format!("{side:?} {what}");
                check(label("elbow"), -vector(turn(on("elbow"))).y, -0.1, 159.0);
                check(label("knee"), vector(turn(on("knee"))).x, -0.1, 145.2);
                let arm = turn(on("shoulder")) * DVec3::X;
                let back = ops::asin_clamped(-arm.z);
                check(label("arm back"), back, -180.0, 83.3);
                check(label("arm across"), ops::asin_clamped(-arm.x), -180.0, 63.0);
                let thigh = turn(on("hip")) * DVec3::NEG_Y;
                check(
                    label("thigh aside"),
                    ops::asin_clamped(thigh.x),
                    -53.0,
                    40.15,
                );
                check(label("thigh"), ops::atan2(thigh.z, -thigh.y), -148.0, 148.0);
                let ankle = vector(turn(on("subtalar")));
                check(label("ankle"), ankle.x, -19.9, 79.6);
                check(label("ankle roll"), ankle.z, -39.0, 35.0);
                check(label("ankle turn"), ankle.y, -55.0, 55.0);
                let wrist = pose.rotation(on("wrist"));
                let twist = twist_about_x(wrist);
                let bend = vector(twist.inverse() * wrist);
                check(label("wrist flexion"), -bend.z, -74.7, 94.8);
                check(label("wrist deviation"), side.sign() * bend.y, -47.9, 47.9);
                let turned = side.sign() * vector(twist).x;
                check(label("forearm"), turned, -90.0, 80.0);
            }
            for (bone, most) in [
                (Bone::Cervical, [25.0, 40.0, 45.0, 10.0]),
                (Bone::Skull, [71.0, 70.0, 63.5, 99.1]),
                (Bone::Lumbar, [30.0, 50.0, 30.0, 30.0]),
                (Bone::Thoracic, [30.0, 50.0, 30.0, 30.0]),
            ] {
                let v = vector(turn(bone));
                let [back, forth, aside, about] = most;
                check(format!("{bone:?} flexion"), v.x, -back, forth);
                check(format!("{bone:?} side"), v.z, -aside, aside);
                check(format!("{bone:?} turn"), v.y, -about, about);
            }
        }
        for (what, beyond, value, t) in worst {
            found.push(format!(
                "{name}: {what} {value:.1} is {beyond:.1} too far at {t:.2}"
            ));
        }
    });
    none(&found);
}

#[test]
fn arms_keep_out_of_the_body() {
    let mut found = Vec::new();
    each(|name, stage| {
        let zero = stage.world(&Pose::zero());
        let scale = stage.skeleton.scale();
        let mut worst: Option<(f64, String)> = None;
        for (t, pose) in stage.poses() {
            let world = stage.world(&pose);
            for side in Side::BOTH {
                let at = |part: &str| world[Bone::on(side, part).index()].translation;
                let (elbow, wrist) = (at("elbow"), at("wrist"));
                let tips = at("middle2");
                let line = |a: DVec3, b: DVec3| (1..=6).map(move |i| a.lerp(b, f64::from(i) / 6.0));
                for p in line(elbow, wrist).chain(line(wrist, tips)) {
                    for (bone, half, below, above) in [
                        (Bone::Thoracic, [0.15, 0.105], 0.0, 0.20),
                        (Bone::Lumbar, [0.135, 0.095], 0.0, 0.20),
                        (Bone::Sacroiliac, [0.155, 0.105], -0.05, 0.20),
                        (Bone::Skull, [0.07, 0.085], -0.03, 0.17),
                    ] {
                        let moved = world[bone.index()] * zero[bone.index()].inverse();
                        let q = moved.inverse().transform_point3(p);
                        let o = zero[bone.index()].translation;
                        let (x, y, z) = (q.x - o.x, q.y - o.y, q.z - o.z);
                        if y < below * scale || y > above * scale {
                            continue;
                        }
                        let z = if bone == Bone::Skull {
                            z - 0.03 * scale
                        } else {
                            z
                        };
                        let r = ops::hypot(x / (half[0] * scale), z / (half[1] * scale));
                        if worst.as_ref().is_none_or(|w| r < w.0) {
                            worst = Some((r, format!("{side:?} arm in {bone:?} at {t:.2}")));
                        }
                    }
                }
            }
        }
        if let Some((r, what)) = worst.filter(|w| w.0 < 1.0) {
            found.push(format!("{name}: {what}, {r:.2} of the way out"));
        }
    });
    none(&found);
}

#[test]
fn mirrored_halves_mirror_each_other() {
    let text = shipped()
        .into_iter()
        .find(|(n, _)| n == "step-march")
        .expect("it is shipped")
        .1;
    let stage = Stage::new("step-march", &text, &Skeleton::example());
    for i in 0..20 {
        let t = stage.seconds * f64::from(i) / 20.0;
        let (a, b) = (stage.pose(t), stage.pose(t + 0.5 * stage.seconds));
        let (a, b) = (stage.world(&a), stage.world(&b));
        for bone in Bone::ALL {
            let other = b[bone.mirrored().index()].translation;
            let d = mirror_vector(a[bone.index()].translation).distance(other);
            assert!(d < 1e-9, "{} at {t}", bone.name());
        }
    }
}
