//! Animations in stories: the required ones, their arrival, and their playback by live fragments.

mod common;

use common::{equip, figure, perform, text};
use raconteur_player::body::Bone;
use raconteur_player::live::limits;
use raconteur_player::{Options, Player};

fn player(body: &str) -> Player {
    let eml = format!("<eml><body>{body}</body></eml>");
    let options = Options {
        motion_amount: 0.0,
        ..Options::default()
    };
    perform(&eml, None, figure(), options).player
}

const ADD: &str = "<body-player-add time='0' name='p' type='multiple' numberOfLayers='1'/>";

fn push(time: &str, name: &str) -> String {
    format!(
        "<body-deterministic-primitive time='{time}' primitive='push' player='p' \
         animationSetName='{name}'/>"
    )
}

fn height(player: &mut Player, t: f64, bone: Bone) -> f64 {
    player.frame(t, 1.0).world_from_joint[bone.index()]
        .translation
        .y
}

#[test]
fn a_story_tells_which_animations_it_wants_until_they_have_come() {
    let body = format!(
        "{ADD}{}{}{}<null time='6'/>",
        push("0", "sit"),
        push("1", "nod"),
        push("2", "sit")
    );
    let mut player = player(&body);
    assert_eq!(player.needed_animations(), ["sit", "nod"]);
    let standing = height(&mut player, 5.0, Bone::Sacroiliac);
    assert_eq!(equip(&mut player), [""; 0]);
    assert_eq!(player.needed_animations(), [""; 0]);
    let sitting = height(&mut player, 5.0, Bone::Sacroiliac);
    assert!(sitting < standing - 0.3, "{standing} {sitting}");
}

#[test]
fn missing_and_broken_ones_are_told_once_and_the_rest_plays() {
    let body = format!(
        "{ADD}{}{}<null time='6'/>",
        push("0", "sit"),
        push("1", "dance")
    );
    let mut player = player(&body);
    assert_eq!(equip(&mut player), ["player::no-animation"]);
    assert_eq!(player.needed_animations(), [""; 0]);
    let told = player.provide_animations(&[("nod", Some("{\"tracks\": {\"tail\": {}}}"))]);
    assert_eq!(told[0].code, "player::bad-animation");
    assert!(told[0].message.contains("tail"), "{}", told[0].message);
    assert!(
        height(&mut player, 5.0, Bone::Sacroiliac) < 0.7,
        "the valid animation still plays"
    );
}

#[test]
fn the_order_in_which_animations_come_does_not_matter() {
    let body = format!(
        "{ADD}{}{}<null time='6'/>",
        push("0", "step-march"),
        push("2", "wave")
    );
    let mut at_once = player(&body);
    equip(&mut at_once);
    let mut one_by_one = player(&body);
    for name in ["wave", "step-march"] {
        let text = text(&format!("animations/{name}.json"));
        one_by_one.provide_animations(&[(name, Some(&text))]);
    }
    for i in 0..40 {
        let t = f64::from(i) * 0.1;
        assert_eq!(at_once.digest(t), one_by_one.digest(t), "at {t}");
    }
}

#[test]
fn live_fragments_play_what_the_story_has_and_what_comes() {
    let mut player = player(ADD);
    player.set_open_ended(true);
    player.advance(1.0);
    let standing = height(&mut player, 1.0, Bone::Sacroiliac);
    let performed = player.perform(1, &push("0", "sit"), 1.0);
    assert_eq!(performed.diagnostics, []);
    assert_eq!(player.needed_animations(), ["sit"]);
    assert_eq!(equip(&mut player), [""; 0]);
    player.advance(3.0);
    let sitting = height(&mut player, 3.0, Bone::Sacroiliac);
    assert!(sitting < standing - 0.3, "{standing} {sitting}");
    player.perform(1, "<body-player-clear time='0'/>", 3.0);
    let up = height(&mut player, 6.0, Bone::Sacroiliac);
    assert!((up - standing).abs() < 0.01, "{standing} {up}");
}

#[test]
fn players_outlive_the_fragments_that_made_them() {
    let mut player = player("<null time='1'/>");
    player.set_open_ended(true);
    let standing = height(&mut player, 0.0, Bone::Sacroiliac);
    player.perform(1, &format!("{ADD}{}", push("0", "sit")), 1.0);
    equip(&mut player);
    // So much later the fragment is forgotten.
    let later = 2.0 * limits::REMEMBERED_SECS;
    player.advance(later);
    player.perform(1, "<event time='0' type='tick'/>", later);
    let sitting = height(&mut player, later + 5.0, Bone::Sacroiliac);
    assert!(sitting < standing - 0.3, "{standing} {sitting}");
}
