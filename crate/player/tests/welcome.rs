//! Before a story plays, the figure is idle on its own clock; the story contains nothing of it.

mod common;

use std::sync::Arc;

use common::{figure, read, story};
use raconteur_player::base::{DQuat, DVec3};
use raconteur_player::body::{Bone, Drive, Figure};
use raconteur_player::stage::Frame;
use raconteur_player::{Options, Player};

const ASPECT: f64 = 16.0 / 9.0;
const STEP_SECS: f64 = 1.0 / 60.0;

fn player(name: &str) -> Player {
    story(name, figure(), Options::default()).player
}

/// Returns all visible data of the figure in a frame.
fn seen(frame: &Frame) -> Vec<f64> {
    let joints = frame
        .world_from_joint
        .iter()
        .flat_map(raconteur_player::base::DAffine3::to_cols_array);
    let nodes = frame.tissue.iter().flat_map(|n| n.displacement);
    joints.chain(nodes.map(f64::from)).collect()
}

fn joint(frame: &Frame, bone: Bone) -> DVec3 {
    frame.world_from_joint[bone.index()].translation
}

/// Returns the largest displacement of a joint of the body, and of a swinging part, metres.
fn moved(figure: &Figure, a: &Frame, b: &Frame) -> [f64; 2] {
    let pairs = a.world_from_joint.iter().zip(&b.world_from_joint);
    let mut most = [0.0_f64; 2];
    for ((a, b), joint) in pairs.zip(figure.skeleton.joints()) {
        let most = &mut most[usize::from(matches!(joint.drive, Drive::Spring(..)))];
        *most = most.max(a.translation.distance(b.translation));
    }
    most
}

#[test]
fn waiting_changes_nothing_of_the_story() {
    for name in ["white-rabbit", "mathematical-dance"] {
        let (mut fresh, mut waited) = (player(name), player(name));
        for i in 0..40 {
            waited.evaluate_idle(f64::from(i) * 0.37, ASPECT);
        }
        // Played: half a second later the frames are the same to the last bit.
        for i in 0..90 {
            let t = f64::from(i) * STEP_SECS;
            let (a, b) = (seen(fresh.frame(t, ASPECT)), seen(waited.frame(t, ASPECT)));
            assert_eq!(a == b, t >= 0.5, "{name} at {t}");
        }
        // Seeking has an immediate effect.
        for t in [0.0, 0.1, 7.3, 0.2] {
            waited.evaluate_idle(5.0, ASPECT);
            waited.seek(t);
            let a = seen(fresh.frame(t, ASPECT));
            assert!(a == seen(waited.frame(t, ASPECT)), "{name} at {t}");
        }
        waited.evaluate_idle(5.0, ASPECT);
        assert_eq!(fresh.digest(0.1), waited.digest(0.1));
    }
}

#[test]
fn the_figure_goes_into_the_story_without_a_jump() {
    for name in raconteur_tier::FIGURES {
        for waited_secs in [0.0, 3.7, 41.0] {
            let mut player = story("white-rabbit", read(name), Options::default()).player;
            let mut last = player.evaluate_idle(waited_secs, ASPECT).clone();
            let mut story = story("white-rabbit", read(name), Options::default()).player;
            let figure = Arc::clone(story.figure());
            let [way, _] = moved(&figure, &last, story.frame(0.15, ASPECT));
            assert!(way < 0.4, "{name}: the welcome is {way} m from the story");
            for i in 0..36 {
                let frame = player.frame(f64::from(i) * STEP_SECS, ASPECT).clone();
                let limit = if i == 0 {
                    // The transition starts from the exact idle frame.
                    1e-9
                } else {
                    // Nothing exceeds 1.9 times the mean speed (minimum jerk), on an arc up to a
                    // tenth longer than the path, in addition to the story's own 0.2 m/s.
                    (1.1 * 1.9 * way / 0.3 + 0.2) * STEP_SECS
                };
                let [far, hair] = moved(&figure, &last, &frame);
                assert!(far <= limit, "{name} {waited_secs} step {i}: {far} m");
                // Hair settles to a hundredth of a millimetre, and swings farther than its base.
                let limit = if i == 0 { 1e-5 } else { 1.5 * limit };
                assert!(
                    hair <= limit,
                    "{name} {waited_secs} step {i}: {hair} m of the hair"
                );
                let nodes = last.tissue.iter().zip(&frame.tissue);
                let far = nodes.map(|(a, b)| {
                    let [x, y, z] = [0, 1, 2].map(|k| a.displacement[k] - b.displacement[k]);
                    (x * x + y * y + z * z).sqrt()
                });
                // A blink moves a lid 11 mm in 85 ms; the tissue starts again with the story, to a
                // hundredth of a millimetre.
                let (far, limit) = (far.fold(0.0, f32::max), if i == 0 { 1e-4 } else { 4e-3 });
                assert!(
                    far <= limit,
                    "{name} {waited_secs} step {i}: {far} m of the face"
                );
                last = frame;
            }
        }
    }
}

#[test]
fn it_breathes_shifts_its_weight_blinks_and_looks() {
    let mut player = player("white-rabbit");
    let first = player.evaluate_idle(0.0, ASPECT).clone();
    let (mut chest, mut hips, mut head) = (0.0_f64, 0.0_f64, 0.0_f64);
    let mut closed = 0.0_f64;
    let skeleton = figure();
    let joints = skeleton.skeleton.joints();
    let upper = joints.iter().position(|j| j.name == "helper_l_upper_lid");
    let upper = upper.expect("a lid");
    // The lid's closure in radians.
    let lid = |frame: &Frame| {
        let lid = frame.world_from_joint[upper].matrix3;
        let skull = frame.world_from_joint[Bone::Skull.index()].matrix3;
        DQuat::from_mat3(&(skull.transpose() * lid)).angle_between(DQuat::IDENTITY)
    };
    for i in 1..600 {
        let frame = player.evaluate_idle(f64::from(i) * 0.067, ASPECT);
        let far = |bone| joint(frame, bone).distance(joint(&first, bone));
        chest = chest.max(far(Bone::RScapula));
        hips = hips.max(far(Bone::Sacroiliac));
        head = head.max(far(Bone::Skull));
        closed = closed.max((lid(frame) - lid(&first)).abs());
        assert_eq!((frame.time_secs, frame.speech), (0.0, None));
    }
    // It is alive, and stays where it is.
    assert!((0.002..0.1).contains(&chest), "{chest} m");
    assert!((0.005..0.08).contains(&hips), "{hips} m");
    assert!((0.005..0.15).contains(&head), "{head} m");
    assert!(closed > 0.3, "lids: {closed} rad");
    // The same idle time gives the same frame, regardless of the events in between.
    assert!(
        seen(&first) == seen(player.evaluate_idle(0.0, ASPECT)),
        "the first frame equals the idle frame at 0 s"
    );
}

#[test]
fn any_wait_is_a_picture() {
    let mut player = player("hello-world");
    for waited in [f64::NAN, f64::INFINITY, -1.0, 1e300, 86_399.9] {
        let frame = player.evaluate_idle(waited, ASPECT);
        assert!(seen(frame).iter().all(|n| n.is_finite()), "{waited}");
    }
}

/// Returns the largest displacement of body joints per step in a turn of `secs`, metres: as above,
/// but on an arc up to three tenths longer than the straight path.
fn most_in_a_step(way: f64, secs: f64) -> f64 {
    (1.3 * 1.9 * way / secs + 0.2) * STEP_SECS
}

#[test]
fn it_comes_to_wait_for_an_answer_and_goes_on_without_a_jump() {
    for (name, at, on) in [("white-rabbit", 9.0, 21.0), ("hello-world", 2.0, 1.0)] {
        let (mut player, mut fresh) = (player(name), player(name));
        let figure = Arc::clone(player.figure());
        let mut last = player.frame(at, ASPECT).clone();
        let rests = fresh.evaluate_waiting(at, 2.0, None, ASPECT).clone();
        let [way, _] = moved(&figure, &last, &rests);
        for i in 0..60 {
            let frame = player
                .evaluate_waiting(at, f64::from(i) * STEP_SECS, None, ASPECT)
                .clone();
            assert_eq!(frame.time_secs, at);
            let limit = if i == 0 {
                1e-9
            } else {
                most_in_a_step(way, 0.6)
            };
            let [far, _] = moved(&figure, &last, &frame);
            assert!(far <= limit, "{name} step {i}: {far} m of {limit}");
            last = frame;
        }
        // The figure looks at its hand: something moves, and nothing jumps.
        let before = last.clone();
        for i in 60..120 {
            let waited_secs = f64::from(i) * STEP_SECS;
            let frame = player
                .evaluate_waiting(at, waited_secs, Some(Bone::LWrist), ASPECT)
                .clone();
            let [far, _] = moved(&figure, &last, &frame);
            assert!(far <= 0.02, "{name} step {i}: {far} m");
            last = frame;
        }
        let turned =
            |frame: &Frame| DQuat::from_mat3(&frame.world_from_joint[Bone::Skull.index()].matrix3);
        assert!(
            turned(&before).angle_between(turned(&last)).to_degrees() > 3.0,
            "{name}"
        );
        // An answer continues the story; half a second later, only the story is left.
        player.seek_with_fade(on);
        let [far, _] = moved(&figure, &last, player.frame(on, ASPECT));
        assert!(far <= 1e-9, "{name}: {far} m");
        fresh.seek(on);
        for i in 0..60 {
            let t = on + f64::from(i) * STEP_SECS;
            let (a, b) = (seen(fresh.frame(t, ASPECT)), seen(player.frame(t, ASPECT)));
            assert_eq!(a == b, t >= on + 0.5, "{name} at {t}");
        }
    }
}

#[test]
fn waiting_for_an_answer_passes_no_cues() {
    let mut player = player("hello-world");
    player.advance(1.0);
    let _ = player.drain_events();
    for i in 0..30 {
        player.evaluate_waiting(1.0, f64::from(i), None, ASPECT);
    }
    player.evaluate_waiting(f64::NAN, f64::NAN, Some(Bone::Skull), ASPECT);
    assert_eq!(player.drain_events(), []);
    player.seek_with_fade(1.5);
    player.advance(1.5);
    assert!(
        player
            .drain_events()
            .iter()
            .all(|e| format!("{e:?}").contains("1.5")),
        "only cues of the resumed time are reported"
    );
}
