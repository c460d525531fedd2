//! The shipped stories, swept.

mod common;

use std::sync::Arc;

use common::{figure, perform, read, stories, story, turn};
use raconteur_base::noise;
use raconteur_player::Options;
use raconteur_player::body::Figure;
use raconteur_player::sweep::{Check, sweep, sweep_between};
use raconteur_tier::{FIGURES, is_long, share};

/// The gate sweeps this much of a story, seconds.
const STRETCH_SECS: f64 = 15.0;

fn swept(name: &str, figure: &Arc<Figure>) -> Vec<Check> {
    let mut player = story(name, Arc::clone(figure), Options::default()).player;
    if is_long() {
        return sweep(&mut player);
    }
    // Each story at a place of its own.
    let place = stories().iter().position(|s| s == name).unwrap_or(0);
    let end = player.end_secs();
    let from = (end - STRETCH_SECS).max(0.0) * noise::unit(1, place as u64, 0);
    sweep_between(&mut player, from..=end.min(from + STRETCH_SECS))
}

#[test]
fn a_stretch_shows_what_the_whole_shows_there() {
    let figure = figure();
    let player = |eml| perform(eml, None, Arc::clone(&figure), Options::default()).player;
    let eml = "<eml><body>
        <body-configure-manipulator time='0' manipulator='rightArm' isOn='true'
            jointLimitsActive='false'/>
        <body-non-deterministic-fk time='1.5' manipulator='rightArm' j1='60' j2='0' j3='40'
            j4='0' j5='80' j6='0'/>
        <null time='4'/></body></eml>";
    let beyond = |checks: Vec<Check>| {
        let limits = checks.into_iter().find(|c| c.name == "beyond-limits");
        limits.map_or(0.0, |c| c.worst)
    };
    let whole = beyond(sweep(&mut player(eml)));
    let within = beyond(sweep_between(&mut player(eml), 1.0..=4.0));
    let before = beyond(sweep_between(&mut player(eml), 0.0..=1.0));
    assert!(
        whole > 25.0 && (whole - within).abs() < 1e-6,
        "{whole} {within}"
    );
    assert!(before < 1e-6, "{before}");
}

/// Sweeps stories with one figure: its share of them, so that each story has one figure and each
/// figure at least one, or all of them in the long tier.
fn nothing_would_make_a_viewer_wince(figure: &str) {
    let stories = stories();
    assert!(stories.len() >= 8, "{stories:?}");
    assert!(stories.contains(&"virtual-poets/jabberwocky".to_owned()));
    let told = share(&stories, turn(figure), FIGURES.len());
    assert!(!told.is_empty());
    let figure = read(figure);
    let mut wrong = Vec::new();
    for story in &told {
        for check in swept(story, &figure) {
            if !check.is_ok() {
                wrong.push(format!("{story}: {check:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn sofia_tells_the_shipped_stories_well() {
    nothing_would_make_a_viewer_wince("sofia");
}

#[test]
fn papous_tells_the_shipped_stories_well() {
    nothing_would_make_a_viewer_wince("papous");
}

#[test]
fn nuno_tells_the_shipped_stories_well() {
    nothing_would_make_a_viewer_wince("nuno");
}

#[test]
fn amara_tells_the_shipped_stories_well() {
    nothing_would_make_a_viewer_wince("amara");
}

#[test]
fn kenji_tells_the_shipped_stories_well() {
    nothing_would_make_a_viewer_wince("kenji");
}

#[test]
fn lia_tells_the_shipped_stories_well() {
    nothing_would_make_a_viewer_wince("lia");
}

#[test]
fn a_wrist_bent_aside_too_far_is_found() {
    let eml = "<eml><body>
        <body-configure-manipulator time='0' manipulator='rightArm' isOn='true'
            jointLimitsActive='false'/>
        <body-non-deterministic-fk time='0.5' manipulator='rightArm' j1='60' j2='0' j3='40'
            j4='0' j5='80' j6='0'/>
        <null time='2'/></body></eml>";
    let mut player = perform(eml, None, figure(), Options::default()).player;
    let checks = sweep(&mut player);
    let limits = checks.iter().find(|c| c.name == "beyond-limits");
    let found = limits.map(|c| (c.location, c.worst));
    // A woman's wrist deviates by 36.1 degrees to the thumb and 43 to the other side; the man's
    // by some more.
    assert!(
        found.is_some_and(|(part, worst)| part == "bone_r_wrist" && worst > 25.0),
        "{found:?}"
    );
}

#[test]
fn an_elbow_bent_backwards_is_found() {
    let eml = "<eml><body>
        <body-configure-manipulator time='0' manipulator='rightArm' isOn='true'
            jointLimitsActive='false'/>
        <body-non-deterministic-fk time='0.5' manipulator='rightArm' j1='90' j2='0' j3='-40'
            j4='0' j5='0' j6='0'/>
        <null time='2'/></body></eml>";
    let mut player = perform(eml, None, figure(), Options::default()).player;
    let checks = sweep(&mut player);
    let wrong: Vec<_> = checks.iter().filter(|c| !c.is_ok()).collect();
    assert_eq!(wrong.len(), 1, "{wrong:?}");
    assert_eq!(
        (wrong[0].name, wrong[0].location),
        ("beyond-limits", "bone_r_elbow")
    );
    assert!((wrong[0].worst - 40.0).abs() < 1.0, "{wrong:?}");
}
