//! Sweep of the shipped stories.

mod common;

use std::sync::Arc;

use common::{figure, perform, read, stories, story, turn};
use raconteur_base::{Side, noise};
use raconteur_player::body::{Bone, Figure};
use raconteur_player::sweep::{Check, sweep, sweep_between};
use raconteur_player::{Options, Script};
use raconteur_tier::{FIGURES, is_long, share};

/// The gate sweeps this much of a story, seconds.
const STRETCH_SECS: f64 = 15.0;

fn swept(name: &str, figure: &Arc<Figure>) -> Vec<Check> {
    let mut player = story(name, Arc::clone(figure), Options::default()).player;
    if is_long() {
        return sweep(&mut player);
    }
    // Each story has its own position.
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

/// Returns a script that sets an arm to angles at 1 s, with additional attributes.
fn set_joints(beside: &str) -> String {
    format!(
        "<eml xmlns:r='urn:raconteur:eml:1'><body>
        <body-non-deterministic-fk time='1' manipulator='leftArm' j1='70' j2='20' j3='90'
            j4='30' {beside}/><null time='3'/></body></eml>"
    )
}

#[test]
fn joints_take_the_time_that_the_timeline_tells_or_are_cut_to() {
    for (beside, length_secs) in [("", 0.5), ("j5='0'", 0.5), ("r:smooth='false'", 0.0)] {
        let eml = set_joints(beside);
        let timed = Script::read(&eml, None).timeline.clauses[0];
        let told_secs = timed.end_secs - timed.start_secs;
        assert!((told_secs - length_secs).abs() < 1e-9, "{beside}");
        let mut player = perform(&eml, None, figure(), Options::default()).player;
        let mut elbow = |secs: f64| {
            let joints = &player.frame(secs, 1.6).world_from_joint;
            let [a, b] = ["elbow", "wrist"]
                .map(|part| joints[Bone::on(Side::Left, part).index()].translation);
            b - a
        };
        // Breath and sway go on.
        let there = elbow(timed.end_secs + 1e-6);
        assert!(there.angle_between(elbow(2.5)) < 0.03, "{beside}");
        let before = elbow(timed.start_secs - 1.0 / 120.0);
        assert!(there.angle_between(before) > 0.5, "{beside}");
        if length_secs > 0.0 {
            let under_way = elbow(timed.start_secs + 0.7 * length_secs);
            assert!(there.angle_between(under_way) > 0.1, "{beside}");
        }
    }
}

#[test]
fn a_cut_that_is_asked_for_is_no_jump() {
    for beside in ["", "r:smooth='false'"] {
        for name in ["joint-speed", "joint-jump", "wrist-speed"] {
            let check = measured(&set_joints(beside), name);
            assert!(check.is_ok(), "{beside} {check:?}");
        }
    }
}

fn measured(eml: &str, name: &str) -> Check {
    let mut player = perform(eml, None, figure(), Options::default()).player;
    let checks = sweep(&mut player);
    let found = checks.into_iter().find(|c| c.name == name);
    found.expect("the check")
}

#[test]
fn a_stroke_of_a_figure_that_has_moved_is_looked_for_where_it_is() {
    let eml = "<eml><body>
        <vh-move time='0' functionName='segment'><function-args>
            <arg name='timePeriod' value='1'/><arg name='startX' value='0'/><arg name='endX' value='30'/>
            <arg name='endYaw' value='40'/></function-args></vh-move>
        <gesture-key time='2.5' duration='0.4' handedness='right'><motion>
            <key time='0' x='-8' y='14' z='-10'/><key time='0.4' x='-12' y='14' z='-10'/></motion></gesture-key>
        <null time='4'/></body></eml>";
    let late = measured(eml, "late-stroke");
    assert!(late.is_ok(), "{late:?}");
}

#[test]
fn quick_keys_that_cannot_be_met_snap_no_joint() {
    // Positions far out of reach and palm orientations beyond the forearm's range, from key to key.
    let keys = [
        [
            "<palms><key time='0' a='126' x='0.3' y='0.2' z='-0.9'/></palms>",
            "<motion><key time='0' x='-18' y='20' z='-7'/></motion>",
        ],
        [
            "<palms><key time='0' a='-60' x='-0.7' y='0.6' z='0.8'/></palms>",
            "<motion><key time='0' x='5' y='60' z='-50'/></motion>",
        ],
        [
            "<palms><key time='0' a='170' x='0.2' y='-0.9' z='0.1'/></palms>",
            "<motion><key time='0' x='-15' y='5' z='-16'/></motion>",
        ],
    ];
    for pattern in 0..6 {
        let mut body = String::new();
        for i in 0..3 {
            let [palm, _] = keys[(i + pattern) % 3];
            let [_, place] = keys[(i * (1 + pattern / 3) + pattern) % 3];
            let time = 1.3 + 0.2 * i as f64;
            body += &format!(
                "<gesture-key time='{time}' duration='0.2' handedness='right'>{palm}{place}</gesture-key>"
            );
        }
        let eml = format!("<eml><body>{body}<null time='4'/></body></eml>");
        let speed = measured(&eml, "joint-speed");
        assert!(speed.is_ok(), "{pattern}: {speed:?}");
    }
}

/// Sweeps stories with one figure: its share of them, so each story has one figure and each figure
/// at least one story, or all of them in the long tier.
fn nothing_would_make_a_viewer_wince(figure: &str) {
    let stories = stories();
    assert!(stories.len() >= 8, "{stories:?}");
    assert!(
        stories.contains(&"virtual-poets/jabberwocky".to_owned()),
        "the example stories include jabberwocky"
    );
    let told = share(&stories, turn(figure), FIGURES.len());
    assert!(!told.is_empty(), "the figure has at least one story");
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
