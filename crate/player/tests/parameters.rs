//! Control parameters and emotions of stories: their animations, and their playback.

mod common;

use common::{figure, perform};
use raconteur_player::{Options, Player};

const BLINK: &str = r#"{"seconds": 0.3, "parameters": {"UpperLid": {"times": [0, 0.1, 0.3], "values": [0, 1, 0]}}}"#;

fn player(body: &str) -> (Player, Vec<&'static str>) {
    let eml = format!("<eml xmlns:r='urn:raconteur:eml:1'><body>{body}</body></eml>");
    let loaded = perform(&eml, None, figure(), Options::default());
    let codes = loaded.diagnostics.iter().map(|d| d.code).collect();
    (loaded.player, codes)
}

const BODY: &str = "<body-load-control-parameter-animation time='0' file='faces/blink.json'
      isResourcesRelative='false'/>
    <seq time='1'><body-animate-control-parameter time='0' animationId='blink'/>
      <null time='0' timeId='after'/></seq>
    <body-set-control-parameter time='1' parameterId='Joy' value='1'/>
    <null time='6'/>";

#[test]
fn animations_of_parameters_come_as_others_do() {
    let (mut with, told) = player(BODY);
    assert_eq!(told, [""; 0]);
    assert_eq!(with.needed_animations(), ["faces/blink.json"]);
    assert_eq!(with.timeline().marks.get("after"), Some(&1.0));
    let told = with.provide_animations(&[("faces/blink.json", Some(BLINK))]);
    assert_eq!(told, []);
    assert_eq!(with.needed_animations(), [""; 0]);
    let after = with.timeline().marks.get("after").copied();
    assert!((after.unwrap_or(0.0) - 1.3).abs() < 1e-9, "{after:?}");
}

#[test]
fn one_that_is_there_as_xml_is_told() {
    for (name, file) in [
        ("faces/blink.json", "`faces/blink.xml`"),
        ("blink", "`blink.xml`"),
        ("faces/blink.xml", "`faces/blink.xml`"),
    ] {
        let xml = "<?xml version='1.0'?><animation/>";
        let (mut other, _) = player(&BODY.replace("faces/blink.json", name));
        let told = other.provide_animations(&[(name, Some(xml))]);
        assert_eq!(told[0].code, "player::bad-animation");
        let message = &told[0].message;
        assert!(
            message.contains(file) && message.contains("JSON"),
            "{message}"
        );
    }
}

#[test]
fn missing_and_broken_ones_are_told() {
    let (mut player, _) = player(BODY);
    let told = player.provide_animations(&[("faces/blink.json", None)]);
    assert_eq!(told[0].code, "player::no-animation");
    assert!(
        told[0].message.contains("found as `faces/blink.json`;"),
        "{}",
        told[0].message
    );
    assert_eq!(player.needed_animations(), [""; 0]);
    let broken = BLINK.replace("UpperLid", "Eyelash");
    let told = player.provide_animations(&[("faces/blink.json", Some(&broken))]);
    assert_eq!(told[0].code, "player::bad-animation");
    assert!(told[0].message.contains("Eyelash"), "{}", told[0].message);
    assert!(
        told[0].span.end > told[0].span.start,
        "the diagnostic has a non-empty span"
    );
}

#[test]
fn seeking_shows_what_playing_shows_and_live_fragments_join() {
    let (mut player, told) = player(
        "<r:emotion time='0' type='anger' duration='2'/>
         <r:emotion time='3' type='shame'/>
         <body-animate-ADSR-control-parameter time='1' parameterId='Jaw'
            attackDurationTime='0.5' sustainDurationTime='1' decayValue='0.5'/>
         <null time='8'/>",
    );
    assert_eq!(told, [""; 0]);
    let fragment = "<body-set-control-parameter time='0' parameterId='TongueOut' value='1'/>";
    let performed = player.perform(1, fragment, 2.0);
    assert_eq!(performed.diagnostics, []);
    let played: Vec<u64> = (0..40).map(|i| player.digest(0.2 * f64::from(i))).collect();
    for i in (0..40).rev() {
        assert_eq!(player.digest(0.2 * f64::from(i)), played[i as usize]);
    }
    let unknown = "<body-set-control-parameter time='0' parameterId='Tung' value='1'/>";
    let performed = player.perform(1, unknown, 3.0);
    assert_eq!(performed.diagnostics[0].code, "player::no-parameter");
}
