//! Effects of `r:lead` when a gesture starts before the hand can arrive: a delayed script, a late
//! stroke or a hand in place.

mod common;

use common::{figure, perform};
use raconteur_base::Side;
use raconteur_player::{Options, Script};

/// A story whose first gesture begins at 0, with an event.
fn story(lead: &str) -> String {
    format!(
        "<eml xmlns:r='urn:raconteur:eml:1'{lead}><body><event time='0'>go</event>
        <gesture-key time='0' duration='0.4' handedness='right'><motion>
        <key time='0' x='-8' y='12' z='-10'/></motion></gesture-key><null time='3'/></body></eml>"
    )
}

/// Returns the times of the event and of the stroke, seconds, and the diagnostics.
fn times(lead: &str) -> (f64, f64, Vec<&'static str>) {
    let eml = story(lead);
    let event = Script::read(&eml, None).timeline.clauses[0].start_secs;
    let loaded = perform(&eml, None, figure(), Options::default());
    let (stroke, _) = loaded.player.strokes(Side::Right)[0];
    let codes = loaded.diagnostics.iter().map(|d| d.code).collect();
    (event, stroke, codes)
}

#[test]
fn the_script_waits_or_the_stroke_comes_late_or_the_hand_is_there() {
    assert_eq!(times(""), (0.9, 0.9, vec!["player::delayed"]));
    assert_eq!(times(" r:lead='delay'"), (0.9, 0.9, vec![]));
    assert_eq!(times(" r:lead='late'"), (0.0, 0.9, vec!["player::late"]));
    assert_eq!(times(" r:lead='snap'"), (0.0, 0.0, vec![]));
}
