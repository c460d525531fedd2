//! An unknown name is reported exactly once, with its likely meaning; so is a number out of range.

mod common;

use common::{figure, perform};
use raconteur_player::Options;
use raconteur_player::eml::Diagnostic;

/// Returns all problems of a text, including missing animations.
fn problems(head: &str, body: &str) -> Vec<Diagnostic> {
    let eml =
        format!("<eml xmlns:r='urn:raconteur:eml:1'><head>{head}</head><body>{body}</body></eml>");
    let mut loaded = perform(&eml, None, figure(), Options::default());
    let wanted = loaded.player.needed_animations();
    let missing: Vec<(&str, Option<&str>)> = wanted.iter().map(|n| (n.as_str(), None)).collect();
    let told = loaded.player.provide_animations(&missing);
    loaded.diagnostics.into_iter().chain(told).collect()
}

const PLAYER: &str = "<body-player-add time='0' name='dancer' type='bodyGroup'/>";

/// Misspelt names by kind (a set, an animation and so on), with the names meant.
const SLIPS: &[(&str, &str, &str)] = &[
    (
        "eml::unknown-bone",
        "<body-player-add time='0' name='p' type='pose'><bones><bone name='r_wrsit'/></bones></body-player-add>",
        "r_wrist",
    ),
    (
        "eml::unknown-bone",
        "<body-player-set-exclusive time='0' name='p' type='pose'><bones><bone name='bone_l_tumb0'/></bones></body-player-set-exclusive>",
        "l_thumb0",
    ),
    (
        "eml::unknown-body-group",
        "<body-player-add time='0' name='p' type='pose'><bones><bg name='left_amr'/></bones></body-player-add>",
        "left_arm",
    ),
    (
        "eml::unknown-set",
        "<body-player-add time='0' name='p' type='pose'><bones><ref name='amrs'/></bones></body-player-add>",
        "arms",
    ),
    (
        "eml::unknown-player",
        "<body-player-change-priority time='1' name='danver' priority='1'/>",
        "dancer",
    ),
    (
        "eml::unknown-player",
        "<body-player-remove time='1' name='danver'/>",
        "dancer",
    ),
    (
        "eml::unknown-player",
        "<body-configure-deterministic-track-property time='1' player='danver' property='speed' newValue='1'><tracks><bg name='head'/></tracks></body-configure-deterministic-track-property>",
        "dancer",
    ),
    (
        "eml::unknown-player",
        "<body-deterministic-primitive time='1' primitive='pop' player='danver'/>",
        "dancer",
    ),
    (
        "player::no-animation",
        "<body-deterministic-primitive time='1' primitive='push' animationSetName='aplaud'/>",
        "applaud",
    ),
    (
        "eml::bad-choice",
        "<body-non-deterministic-stop time='1' manipulator='leftAmr'/>",
        "leftArm",
    ),
    (
        "player::unknown-function",
        "<body-non-deterministic-function time='1' manipulator='leftArm' functionName='cirlce'><function-args><arg name='timePeriod' value='1'/></function-args></body-non-deterministic-function>",
        "circle",
    ),
    (
        "player::unknown-function",
        "<vh-move time='1' functionName='segmnet'><function-args><arg name='timePeriod' value='1'/></function-args></vh-move>",
        "segment",
    ),
    (
        "player::no-parameter",
        "<body-set-control-parameter time='1' parameterId='Disgsut' value='1'/>",
        "disgust",
    ),
    (
        "player::no-parameter",
        "<body-animate-ADSR-control-parameter time='1' parameterId='JawYwa' attackDurationTime='1' attackValue='1'/>",
        "JawYaw",
    ),
    (
        "eml::bad-choice",
        "<r:emotion time='1' type='disapointment'/>",
        "disappointment",
    ),
    ("eml::unknown-name", "<null time='brgin'/>", "begin"),
];

#[test]
fn an_unknown_name_is_told_once_with_what_is_meant() {
    let head = "<body-expression-configuration><sets-configuration>\
                <set name='arms' type='bodyGroup'><it name='left_arm'/></set>\
                </sets-configuration></body-expression-configuration>";
    let around = format!("{PLAYER}<null time='0' timeId='begin'/>");
    assert_eq!(problems(head, &around), []);
    for (code, clause, meant) in SLIPS {
        let found = problems(head, &format!("{around}{clause}"));
        let codes: Vec<_> = found.iter().map(|d| d.code).collect();
        assert_eq!(codes, [*code], "{clause}: {found:?}");
        let hint = format!("did you mean `{meant}`?");
        assert!(found[0].hints.contains(&hint), "{clause}: {found:?}");
    }
}

/// Runs a story with a player, and a fragment sent in its first second.
fn live(fragment: &str) -> Vec<Diagnostic> {
    let eml = format!("<eml><body>{PLAYER}<null time='30'/></body></eml>");
    let mut player = perform(&eml, None, figure(), Options::default()).player;
    player.set_open_ended(true);
    player.perform(1, fragment, 1.0).diagnostics
}

#[test]
fn a_fragment_knows_the_players_of_the_story_and_no_others() {
    let slips = SLIPS.iter().filter(|s| s.0 == "eml::unknown-player");
    assert!(
        slips.clone().count() >= 4,
        "at least 4 cases have an unknown player"
    );
    for (code, clause, meant) in slips {
        let found = live(clause);
        let codes: Vec<_> = found.iter().map(|d| d.code).collect();
        assert_eq!(codes, [*code], "{clause}: {found:?}");
        let hint = format!("did you mean `{meant}`?");
        assert!(found[0].hints.contains(&hint), "{clause}: {found:?}");
        let right = clause.replace("danver", meant);
        let codes: Vec<_> = live(&right).iter().map(|d| d.code).collect();
        assert!(!codes.contains(code), "{right}: {codes:?}");
    }
    // One that the fragment itself adds is there too.
    let own = format!(
        "{}<body-player-remove time='1' name='own'/>",
        PLAYER.replace("dancer", "own")
    );
    assert_eq!(live(&own), []);
}

/// Returns the problems of a manipulator function with an argument in addition to its period.
fn with_argument(function: &str, argument: &str, value: &str) -> Vec<Diagnostic> {
    let clause = format!(
        "<vh-move time='1' functionName='{function}'><function-args>\
         <arg name='timePeriod' value='1'/><arg name='{argument}' value='{value}'/>\
         </function-args></vh-move>"
    );
    problems("", &clause)
}

#[test]
fn arguments_of_functions_are_names_and_have_ranges() {
    for (function, slip, meant) in [
        ("segment", "endZz", "endZ"),
        ("sinusoid", "amplitde", "amplitude"),
        ("bezier", "contol1X", "control1X"),
        ("hermite", "startVelocityXX", "startVelocityX"),
        ("circle", "radus", "radius"),
        ("ellipse", "radiusW", "radiusX"),
        ("helix", "ryse", "rise"),
        ("lemniscate", "centerQ", "centerX"),
    ] {
        let found = with_argument(function, slip, "1");
        assert_eq!(found.len(), 1, "{function}: {found:?}");
        assert_eq!(found[0].code, "player::bad-argument");
        let hint = format!("did you mean `{meant}`?");
        assert!(found[0].hints.contains(&hint), "{function}: {found:?}");
        let codes = |value: &str| -> Vec<_> {
            let found = with_argument(function, meant, value);
            found.iter().map(|d| d.code).collect()
        };
        assert_eq!(codes("1"), [""; 0], "{function}");
        assert_eq!(codes("-200000"), ["player::out-of-range"], "{function}");
        assert_eq!(codes("north"), ["player::bad-argument"], "{function}");
    }
    let period = "<vh-move time='1' functionName='segment'><function-args>\
                  <arg name='timePeriod' value='-1'/></function-args></vh-move>";
    let codes: Vec<_> = problems("", period).iter().map(|d| d.code).collect();
    assert_eq!(codes, ["player::out-of-range"]);
    // If no name is near, all are listed.
    let far = with_argument("segment", "colour", "1");
    assert!(
        far[0].hints[0].starts_with("its arguments are timePeriod, startYaw"),
        "{far:?}"
    );
}

#[test]
fn members_of_sets_are_names_like_others() {
    for (kind, item, code) in [
        ("bodyGroup", "left_amr", "eml::unknown-body-group"),
        ("multiple", "upper", "eml::unknown-layer"),
    ] {
        let head = format!(
            "<body-expression-configuration><sets-configuration><set name='s' type='{kind}'>\
             <it name='{item}'/></set></sets-configuration></body-expression-configuration>"
        );
        let codes: Vec<_> = problems(&head, "<null time='1'/>")
            .iter()
            .map(|d| d.code)
            .collect();
        assert_eq!(codes, [code]);
    }
    let layer = "<body-deterministic-primitive time='1' primitive='pop'><tracks>\
                 <ly name='upper'/></tracks></body-deterministic-primitive>";
    let codes: Vec<_> = problems("", &format!("{PLAYER}{layer}"))
        .iter()
        .map(|d| d.code)
        .collect();
    assert_eq!(codes, ["eml::unknown-layer"]);
}

#[test]
fn a_value_beyond_the_range_of_its_parameter_is_told_once() {
    for (parameter, fine, beyond) in [
        ("Disgust", "1", "1.5"),
        ("Disgust", "0", "-0.5"),
        ("JawYaw", "-1", "-1.5"),
        ("ZygomaticusMajor", "0.5", "7"),
        ("PP", "1", "2"),
    ] {
        let set = |value: &str| {
            let clause = format!(
                "<body-set-control-parameter time='1' parameterId='{parameter}' value='{value}'/>"
            );
            let found = problems("", &clause);
            found.iter().map(|d| d.code).collect::<Vec<_>>()
        };
        assert_eq!(set(fine), [""; 0], "{parameter}");
        assert_eq!(set(beyond), ["player::out-of-range"], "{parameter}");
        let led = format!(
            "<body-animate-ADSR-control-parameter time='1' parameterId='{parameter}' \
             attackDurationTime='1' attackValue='{beyond}' decayDurationTime='1' \
             decayValue='{fine}'/>"
        );
        let codes: Vec<_> = problems("", &led).iter().map(|d| d.code).collect();
        assert_eq!(codes, ["player::out-of-range"], "{parameter}");
    }
}
