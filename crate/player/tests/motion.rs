//! Measures of body motion, on scripts with known motion.

mod common;

use common::{figure, perform};
use raconteur_player::motion::{MotionReport, RATE_HZ, measure, measure_between};
use raconteur_player::{Options, Player};

/// A player without idle motion, so that only the script moves the figure.
fn player(body: &str) -> Player {
    let options = Options {
        motion_amount: 0.0,
        ..Options::default()
    };
    let eml = format!("<eml><body>{body}</body></eml>");
    perform(&eml, None, figure(), options).player
}

fn measured(body: &str) -> MotionReport {
    measure(&mut player(body))
}

fn value(report: &MotionReport, name: &str) -> f64 {
    let value = report.value(name);
    value.unwrap_or_else(|| panic!("{name} has a value"))
}

/// A gesture of some hands: two places before the chest.
fn gesture(time: f64, hands: &str) -> String {
    format!(
        "<gesture-key time='{time}' duration='0.5' handedness='{hands}'><motion>\
         <key time='0' x='-8' y='14' z='-10'/><key time='0.5' x='-14' y='18' z='-10'/>\
         </motion></gesture-key>"
    )
}

#[test]
fn a_still_figure_has_no_motion() {
    let report = measured("<null time='4'/>");
    for name in [
        "chest-yaw-sd",
        "pelvis-across-sd",
        "pelvis-speed-mean",
        "steps-per-minute",
        "right-movements-per-minute",
        "hands-in-use",
        "two-hand-strokes",
    ] {
        let x = value(&report, name);
        assert!(x.abs() < 1e-3, "{name}: {x}");
    }
    // Feet that stand, once each, without sliding.
    let slide = value(&report, "foot-slide-max");
    assert!(slide < 1e-3, "{slide} mm");
    for name in ["step-length-median", "right-movement-duration-median"] {
        assert_eq!(report.value(name), None, "{name} has nothing to measure");
    }
}

#[test]
fn a_gesture_of_one_hand_uses_that_hand() {
    let report = measured(&format!("{}<null time='5'/>", gesture(2.0, "right")));
    assert_eq!(value(&report, "hands-right-only"), 100.0);
    let right = value(&report, "right-wrist-speed-max");
    assert!((0.5..4.4).contains(&right), "{right} m/s");
    let left = value(&report, "left-wrist-speed-max");
    assert!(left < 0.1, "{left} m/s");
    // Preparation, stroke and retraction in 5 s.
    let movements = value(&report, "right-movements-per-minute");
    assert!((24.0..=48.0).contains(&movements), "{movements} per minute");
    let shape = value(&report, "right-movement-peak-to-mean");
    assert!((1.2..2.3).contains(&shape), "{shape}");
    assert_eq!(value(&report, "two-hand-strokes"), 0.0);
}

#[test]
fn hands_in_the_same_gesture_are_mirror_images_and_in_different_ones_are_not() {
    let shares = |body: &str| {
        let report = measured(&format!("{body}<null time='5'/>"));
        assert_eq!(value(&report, "two-hand-strokes"), 1.0, "{body}");
        ["chest", "figure"]
            .map(|frame| value(&report, &format!("two-hand-strokes-mirrored-{frame}")))
    };
    assert_eq!(shares(&gesture(2.0, "both")), [100.0; 2]);
    let apart = gesture(2.0, "right") + &gesture(2.0, "left").replace("y='18'", "y='24'");
    assert_eq!(shares(&apart), [0.0; 2]);
}

#[test]
fn moves_of_the_whole_figure_count_for_the_feet_only() {
    let report = measured(
        "<vh-move time='0.5' functionName='segment'><function-args>\
         <arg name='timePeriod' value='1'/><arg name='startX' value='0'/><arg name='endX' value='10'/>\
         </function-args></vh-move><null time='3'/>",
    );
    let pelvis = value(&report, "pelvis-across-sd");
    assert!(pelvis < 1e-3, "{pelvis} cm");
    let moved_mm = 10.0 * 1e3 * figure().skeleton.metres_per_eml_unit();
    let slide = value(&report, "foot-slide-max");
    assert!((slide - moved_mm).abs() < 1.0, "{slide} of {moved_mm} mm");
}

#[test]
fn an_interval_has_its_own_measures() {
    let mut player = player(&format!("{}<null time='6'/>", gesture(4.0, "right")));
    let before = measure_between(&mut player, 0.25..=2.0);
    assert!(
        (before.from_secs - 0.25).abs() < 0.5 / RATE_HZ && (before.to_secs - 2.0).abs() < 1e-9,
        "{} to {} s",
        before.from_secs,
        before.to_secs
    );
    let speed = value(&before, "right-wrist-speed-max");
    assert!(speed < 0.1, "{speed} m/s");
    let whole = measure(&mut player);
    let names = |report: &MotionReport| -> Vec<String> {
        report.measures.iter().map(|m| m.name.clone()).collect()
    };
    assert_eq!(names(&before), names(&whole));
    // No frame of the grid lies within.
    let empty = measure_between(&mut player, 1.001..=1.002);
    assert_eq!(empty.value("right-wrist-speed-max"), None);
    assert_eq!(names(&empty), names(&whole));
}

/// A tale with direct speech, a referent at a side, a secret, and gestures.
const TALE: &str = r"<r:place time='0' name='goat' x='45'/>
    <gesture-key time='1' duration='0.6' handedness='both'><motion>
    <key time='0' x='-6' y='14' z='-10'/><key time='0.5' x='-16' y='22' z='-10'/>
    </motion></gesture-key>
    <gesture-key time='6' duration='0.6' handedness='right'><motion>
    <key time='0' x='-6' y='14' z='-10'/><key time='0.5' x='-20' y='24' z='-8'/>
    </motion></gesture-key>
    <voice-text time='0'><div type='paragraph'>Once there was a goat in a big old house.
    She did not like the cold. Nobody came to see her.</div>
    <div type='paragraph'>Then an ant came by, and he looked for the goat.
    <r:speaker name='ant'>Who is there, and what do you want of me?</r:speaker> he said.
    <volume level='quiet'>She had a secret that no one knew.</volume> The goat laughed!</div>
    <div type='paragraph'>And they lived there together for a hundred years and a day.</div>
    </voice-text>";

/// Returns measures of the tale with an amount of motion.
fn told(motion_amount: f64) -> MotionReport {
    let options = Options {
        motion_amount,
        ..Options::default()
    };
    let eml = format!("<eml xmlns:r='urn:raconteur:eml:1'><body>{TALE}</body></eml>");
    measure(&mut perform(&eml, None, figure(), options).player)
}

#[test]
fn less_motion_calms_the_whole_body() {
    let [still, calm, lively] = [0.0, 0.4, 1.0].map(told);
    for (name, least) in [
        ("chest-yaw-sd", 3.0),
        ("chest-pitch-sd", 1.0),
        ("chest-roll-sd", 1.0),
        ("pelvis-across-sd", 1.5),
        ("head-yaw-sd", 4.0),
        ("head-speed-mean", 8.0),
    ] {
        let [none, little, full] = [&still, &calm, &lively].map(|report| value(report, name));
        assert!(full > least, "{name} of lively telling is {full}");
        assert!(
            little < 0.75 * full,
            "{name} is {little} instead of {full} with less motion"
        );
        assert!(none < 0.1 * full, "{name} without motion is {none}");
    }
    let steps = value(&lively, "steps-per-minute");
    assert!(steps >= 2.0, "a lively figure steps {steps} times a minute");
    assert_eq!(
        value(&still, "steps-per-minute"),
        0.0,
        "a still one does not"
    );
}
