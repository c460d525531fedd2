//! Shipped animations, each swept separately: every file of the library, on one figure or, in the
//! long tier, on every one, with the checks of stories.

mod common;

use std::fs;
use std::sync::Arc;

use common::{assets, equip, perform, turn, without_tissue};
use raconteur_player::Options;
use raconteur_player::base::{DVec3, Side};
use raconteur_player::body::Bone;
use raconteur_player::sweep::sweep;
use raconteur_tier::{FIGURES, share};

/// Maximum distance of wrists that hold each other, for a stature of 1.7 m, metres: slightly more
/// than a hand's breadth.
const JOINED_M: f64 = 0.12;

/// The names of the shipped animations.
fn animations() -> Vec<String> {
    let entries = fs::read_dir(assets().join("animations")).expect("the animations");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut names: Vec<String> = paths
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned()))
        .collect();
    names.sort();
    names
}

/// Returns a story that only plays one animation for a duration: an animation pushed at time 0
/// counts as active before.
fn story(name: &str, secs: f64) -> String {
    format!(
        "<eml><body><body-player-add time='0' name='p' type='multiple' numberOfLayers='1'/>
         <body-deterministic-primitive time='0' primitive='push' player='p' \
         animationSetName='{name}'/><null time='{secs}'/></body></eml>"
    )
}

/// Sweeps animations on one figure, its share of them or in the long tier all, twice through if they repeat.
fn nothing_would_make_a_viewer_wince(who: &str) {
    // No animation of the library moves the face.
    let figure = without_tissue(who);
    let mut wrong = Vec::new();
    let names = animations();
    assert!(names.len() >= 63, "{names:?}");
    for name in &share(&names, turn(who), FIGURES.len()) {
        let text = common::text(&format!("animations/{name}.json"));
        let clip = raconteur_player::actor::animation::read_clip(&text).expect("a clip");
        let passes = if clip.is_closed() { 2.0 } else { 1.0 };
        let secs = (passes * clip.duration_secs()).max(1.5);
        let options = Options::default();
        let mut player = perform(&story(name, secs), None, Arc::clone(&figure), options).player;
        assert_eq!(equip(&mut player), [""; 0], "{name}");
        for check in sweep(&mut player) {
            if !check.is_ok() {
                wrong.push(format!("{name}: {check:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{who}\n{}", wrong.join("\n"));
}

#[test]
fn sofia_plays_animations_well() {
    nothing_would_make_a_viewer_wince("sofia");
}

#[test]
fn papous_plays_animations_well() {
    nothing_would_make_a_viewer_wince("papous");
}

#[test]
fn nuno_plays_animations_well() {
    nothing_would_make_a_viewer_wince("nuno");
}

#[test]
fn amara_plays_animations_well() {
    nothing_would_make_a_viewer_wince("amara");
}

#[test]
fn kenji_plays_animations_well() {
    nothing_would_make_a_viewer_wince("kenji");
}

#[test]
fn lia_plays_animations_well() {
    nothing_would_make_a_viewer_wince("lia");
}

#[test]
fn hands_behind_are_joined_at_the_small_of_the_back() {
    for who in FIGURES {
        let figure = without_tissue(who);
        let scale = figure.skeleton.scale();
        let options = Options::default();
        let mut player = perform(&story("hands-behind", 4.0), None, figure, options).player;
        assert_eq!(equip(&mut player), [""; 0]);
        let world = &player.frame(3.0, 1.6).world_from_joint;
        let at = |bone: Bone| world[bone.index()].translation;
        let wrists = Side::BOTH.map(|side| at(Bone::on(side, "wrist")));
        let apart = wrists[0].distance(wrists[1]);
        assert!(apart < JOINED_M * scale, "{who}: {apart} m apart");
        let waist: DVec3 = at(Bone::Lumbar);
        for wrist in wrists {
            let from = wrist - waist;
            assert!(from.z < -0.1 * scale, "{who}: {from} is not behind");
            assert!(
                from.y.abs() < 0.15 * scale,
                "{who}: {from} is not at the small of the back"
            );
        }
    }
}
