//! Palm orientations out of the arm's range are reported.

mod common;

use common::{figure, perform};
use raconteur_eml::Diagnostic;
use raconteur_player::Options;

fn palms(hand: &str, palm: &str) -> Vec<Diagnostic> {
    let eml = format!(
        "<eml><body><gesture-key time='1.5' duration='0.4' handedness='{hand}'>
        <palms><key time='0' {palm}/></palms>
        <motion><key time='0' x='-8' y='12' z='-10'/></motion></gesture-key></body></eml>"
    );
    let loaded = perform(&eml, None, figure(), Options::default());
    let found = loaded.diagnostics.into_iter();
    found.filter(|d| d.code == "player::palm").collect()
}

#[test]
fn a_palm_that_no_forearm_can_turn_is_told_with_the_nearest() {
    for hand in ["right", "both"] {
        let found = palms(hand, "a='-135' x='-1' y='0' z='0'");
        assert_eq!(found.len(), 1, "{found:?}");
        let off: f64 = (found[0].message)
            .split_once("it is ")
            .and_then(|(_, rest)| rest.strip_suffix("° off"))
            .and_then(|off| off.parse().ok())
            .expect("degrees");
        assert!((60.0..180.0).contains(&off), "{off}");
        // The reported nearest orientation is reachable.
        let hint = found[0].hints.first().expect("a hint");
        let nearest = hint.split_once("it can is ").expect("a palm").1;
        let nearest = nearest.split(';').next().expect("a palm");
        assert_eq!(palms(hand, nearest), Vec::new(), "{nearest}");
    }
}

#[test]
fn a_palm_that_can_be_met_is_no_matter() {
    assert_eq!(palms("right", "a='0' x='1' y='0' z='0'"), Vec::new());
}
