//! `raconteur motion`: its reports and its exit status.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn assets() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets")
}

fn motion(arguments: &[&str]) -> Output {
    let story = assets().join("stories/hello-world");
    Command::new(env!("CARGO_BIN_EXE_raconteur"))
        .arg("motion")
        .args(arguments)
        .arg(story)
        .output()
        .expect("the program runs")
}

fn json(arguments: &[&str]) -> Value {
    let out = motion(&[&["--format", "json"], arguments].concat());
    assert!(out.status.success(), "{arguments:?} succeeds");
    serde_json::from_slice(&out.stdout).expect("JSON")
}

fn measure<'a>(report: &'a Value, name: &str) -> &'a Value {
    let measures = report["measures"].as_array().expect("measures");
    let found = measures.iter().find(|m| m["name"] == name);
    found.unwrap_or_else(|| panic!("{name} is reported"))
}

#[test]
fn the_json_has_every_measure_with_the_values_of_people() {
    let report = json(&["--figure", "nuno"]);
    assert_eq!(report["figure"], "nuno");
    assert_eq!(report["from"], 0.0);
    let measures = report["measures"].as_array().expect("measures");
    assert!(measures.len() > 60, "{}", measures.len());
    for measure in measures {
        assert!(
            measure["name"].is_string() && measure["unit"].is_string(),
            "{measure}"
        );
        for number in ["value", "lively", "calm"] {
            assert!(
                measure[number].is_f64() || measure[number].is_null(),
                "{measure}"
            );
        }
    }
    let speed = measure(&report, "right-wrist-speed-max");
    assert!(
        speed["value"].as_f64().is_some_and(|v| v > 0.5),
        "the greeting moves the right hand: {speed}"
    );
    assert_eq!(
        (&speed["lively"], &speed["calm"]),
        (&3.4.into(), &1.7.into())
    );
    let place = measure(&report, "right-movement-peak-place");
    assert_eq!(
        (&place["lively"], &place["calm"]),
        (&0.5.into(), &Value::Null)
    );
}

#[test]
fn the_text_is_a_table_of_the_same_measures() {
    let out = motion(&["--figure", "nuno"]);
    assert!(out.status.success(), "the command succeeds");
    let text = String::from_utf8(out.stdout).expect("UTF-8");
    let report = json(&["--figure", "nuno"]);
    let measures = report["measures"].as_array().expect("measures");
    assert_eq!(text.lines().count(), 2 + measures.len());
    for (line, measure) in text.lines().skip(2).zip(measures) {
        let name = measure["name"].as_str().expect("a name");
        assert!(line.trim_start().starts_with(name), "{line}");
    }
}

#[test]
fn an_interval_is_measured_and_must_be_within_the_story() {
    let report = json(&["--from", "1", "--to", "2.5"]);
    assert_eq!((&report["from"], &report["to"]), (&1.0.into(), &2.5.into()));
    for wrong in [
        &["--from", "1000"][..],
        &["--from=-1"],
        &["--from", "NaN"],
        &["--from", "2", "--to", "1"],
        &["--to", "NaN"],
    ] {
        let out = motion(wrong);
        assert_eq!(out.status.code(), Some(1), "{wrong:?}");
        let told = String::from_utf8_lossy(&out.stderr);
        assert!(told.contains("takes a time"), "{wrong:?}: {told}");
    }
}
