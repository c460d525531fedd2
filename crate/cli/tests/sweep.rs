//! `raconteur sweep`: its report and its exit status.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn assets() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets")
}

fn sweep(arguments: &[&str], story: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_raconteur"))
        .arg("sweep")
        .args(arguments)
        .arg(story)
        .output()
        .expect("the program runs")
}

#[test]
fn a_shipped_story_passes_and_the_report_is_complete() {
    let out = sweep(&["--format", "json"], &assets().join("stories/hello-world"));
    assert!(
        out.status.success(),
        "the sweep of a shipped story succeeds"
    );
    let report: Value = serde_json::from_slice(&out.stdout).expect("JSON");
    let checks = report["checks"].as_array().expect("checks");
    assert!(checks.len() >= 10, "the report has at least 10 checks");
    for check in checks {
        for number in ["worst", "limit", "at_secs"] {
            assert!(check[number].is_f64(), "{check}");
        }
        assert!(
            check["name"].is_string() && check["unit"].is_string(),
            "the check has a name and a unit"
        );
        assert_eq!(check["ok"], true);
    }
}

#[test]
fn what_is_beyond_its_limit_is_told_and_the_exit_status_is_1() {
    // An elbow turned backwards, its limits off.
    let story = tempfile::tempdir().expect("a folder");
    let eml = "<eml><body>\
        <body-configure-manipulator time='0' manipulator='rightArm' isOn='true' \
        jointLimitsActive='false'/>\
        <body-non-deterministic-fk time='0.5' manipulator='rightArm' j1='90' j2='0' j3='-40' \
        j4='0' j5='0' j6='0'/><null time='2'/></body></eml>";
    let script = story.path().join("story.eml");
    std::fs::write(&script, eml).expect("a story");
    let figure = assets().join("figures/sofia.glb");
    let figure = figure.to_str().expect("a path");
    let out = sweep(&["--figure", figure], &script);
    assert_eq!(out.status.code(), Some(1));
    let text = String::from_utf8_lossy(&out.stdout);
    let line = text.lines().find(|l| l.contains("beyond-limits"));
    let line = line.expect("the check");
    assert!(
        line.contains("!!") && line.contains("bone_r_elbow"),
        "{line}"
    );
}
