//! The stories that ship: no diagnostics, and times that follow their speech.

use std::path::PathBuf;
use std::process::Command;

use serde_json::Value;

fn story(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../../assets/stories")
        .join(name)
        .join("story.eml")
}

fn timeline(name: &str) -> Value {
    let out = Command::new(env!("CARGO_BIN_EXE_raconteur"))
        .args(["timeline", "--format", "json"])
        .arg(story(name))
        .output()
        .expect("the program runs");
    assert!(
        out.stderr.is_empty(),
        "{}",
        String::from_utf8_lossy(&out.stderr)
    );
    serde_json::from_slice(&out.stdout).expect("JSON")
}

fn starts(timeline: &Value, element: &str) -> Vec<f64> {
    timeline["clauses"]
        .as_array()
        .into_iter()
        .flatten()
        .filter(|c| c["element"] == element)
        .filter_map(|c| c["start"].as_f64())
        .collect()
}

#[test]
fn hello_world_greets_when_its_words_are_spoken() {
    let t = timeline("hello-world");
    let voice = starts(&t, "voice-text")[0];
    let keys = starts(&t, "gesture-key");
    let world = t["marks"]["t2"].as_f64().expect("the mark t2");
    // GEVH 3.6.1: the hand rises 0.1 s before the clause that says "Hello"; the beat falls
    // on the start of "world".
    assert!((keys[0] - (voice - 0.1)).abs() < 1e-9, "{keys:?} {voice}");
    assert!((keys[1] - world).abs() < 1e-9, "{keys:?} {world}");
    assert!(world > voice + 0.2);
}

#[test]
fn the_folk_tale_is_long_and_full_of_gestures() {
    let t = timeline("white-rabbit");
    assert!(t["duration"].as_f64().expect("a duration") >= 75.0);
    assert!(starts(&t, "gesture-key").len() >= 25);
}

#[test]
fn shipped_stories_are_silent_under_check() {
    for name in ["hello-world", "white-rabbit"] {
        let out = Command::new(env!("CARGO_BIN_EXE_raconteur"))
            .arg("check")
            .arg(story(name))
            .output()
            .expect("the program runs");
        assert!(
            out.status.success() && out.stderr.is_empty(),
            "{}",
            String::from_utf8_lossy(&out.stderr)
        );
    }
}
