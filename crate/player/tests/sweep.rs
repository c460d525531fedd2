//! The shipped stories, swept.

mod common;

use std::sync::Arc;

use common::{figure, perform, read, stories, story, turn};
use raconteur_player::Options;
use raconteur_player::body::Figure;
use raconteur_player::sweep::{Check, sweep};
use raconteur_tier::{FIGURES, share};

fn swept(name: &str, figure: &Arc<Figure>) -> Vec<Check> {
    let mut player = story(name, Arc::clone(figure), Options::default()).player;
    sweep(&mut player)
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
