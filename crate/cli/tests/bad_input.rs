//! What a user who makes a mistake is told: every kind of bad input gives a diagnostic with
//! line and column, the rest still plays, and nothing hangs.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// A scratch folder of one test, removed when the test passes.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("a scratch folder");
        Self(folder)
    }

    fn story(&self, text: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join("story.eml");
        fs::write(&path, text).expect("a scratch story");
        path
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            let _ = fs::remove_dir_all(&self.0);
        }
    }
}

fn raconteur(arguments: &[&str], file: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_raconteur"))
        .args(arguments)
        .arg(file)
        .output()
        .expect("the program runs")
}

fn diagnostics(file: &Path) -> (Vec<Value>, i32) {
    let out = raconteur(&["check", "--format", "json"], file);
    let json: Value = serde_json::from_slice(&out.stdout)
        .unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&out.stderr)));
    let list = json.as_array().cloned().unwrap_or_default();
    (list, out.status.code().unwrap_or(-1))
}

/// Checks that a text gives a diagnostic of this code in this line, and returns its column.
fn expect(name: &str, text: impl AsRef<[u8]>, code: &str, line: u64) -> u64 {
    let scratch = Scratch::new(name);
    let (list, _) = diagnostics(&scratch.story(text));
    let found = list.iter().find(|d| d["code"] == code);
    let found = found.unwrap_or_else(|| panic!("{name}: no {code} in {list:#?}"));
    assert_eq!(found["start"]["line"], line, "{name}: {found:#}");
    found["start"]["column"].as_u64().unwrap_or(0)
}

const HEAD: &str = "<eml>\n<body>\n";
const TAIL: &str = "\n<null time='1'/>\n</body>\n</eml>\n";

fn wrapped(line: &str) -> String {
    format!("{HEAD}{line}{TAIL}")
}

#[test]
fn each_kind_of_bad_input_is_reported_where_it_stands() {
    assert_eq!(
        expect(
            "not-xml",
            "Once upon a time there was a rabbit.",
            "eml::not-xml",
            1
        ),
        1
    );
    let shape = "<gesture-key time='0' duration='1'><hand-shapes><key id='99'/></hand-shapes></gesture-key>";
    expect("hand-shape", wrapped(shape), "eml::unknown-hand-shape", 3);
    let nan = "<gesture-key time='0' duration='1'><motion><key x='NaN' y='0' z='0'/></motion></gesture-key>";
    expect("nan", wrapped(nan), "eml::bad-number", 3);
    expect("empty", "<eml>\n<body/>\n</eml>", "eml::empty-body", 2);
    let entity = "<!DOCTYPE eml [<!ENTITY xxe SYSTEM 'file:///etc/passwd'>]>\n<eml><body>\n\
                  <voice-text time='0'>&xxe;</voice-text></body></eml>";
    expect("doctype", entity, "eml::doctype", 1);
    expect("entity", entity, "eml::unknown-entity", 3);
    let far = "<gesture-key time='0' duration='1'><motion><key x='0' y='90' z='0'/></motion></gesture-key>";
    expect("reach", wrapped(far), "player::out-of-reach", 3);
    let speech = "<voice-text time='0'>Hello</voice-text>";
    expect("no-bundle", wrapped(speech), "player::no-bundle", 3);
}

#[test]
fn the_rest_of_a_broken_story_still_plays() {
    let scratch = Scratch::new("rest");
    let text = wrapped(
        "<gesture-key time='oops' duration='1'/>\n<voice-text time='0.5'>Still here</voice-text>",
    );
    let file = scratch.story(text);
    let out = raconteur(&["timeline", "--format", "json"], &file);
    assert_eq!(out.status.code(), Some(1));
    let json: Value = serde_json::from_slice(&out.stdout).expect("JSON in spite of errors");
    let voice = json["clauses"]
        .as_array()
        .and_then(|c| c.iter().find(|c| c["element"] == "voice-text"))
        .expect("the voice clause");
    assert_eq!(voice["start"], 0.5);
    let errors = String::from_utf8_lossy(&out.stderr).into_owned();
    assert!(errors.contains("story.eml:3:"), "{errors}");
}

#[test]
fn ten_megabytes_and_ten_thousand_levels_come_to_an_end() {
    let scratch = Scratch::new("deep");
    let deep = format!(
        "<eml><body>{}{}</body></eml>",
        "<seq time='0'>".repeat(10_000),
        "</seq>".repeat(10_000)
    );
    let (list, code) = diagnostics(&scratch.story(deep));
    assert!(
        list.iter().any(|d| d["code"] == "eml::too-deep"),
        "{list:#?}"
    );
    assert_eq!(code, 1);

    let scratch = Scratch::new("large");
    let clause = "<event time='0' type='tick'>payload of some length</event>\n";
    let large = wrapped(&clause.repeat(10_000_000 / clause.len()));
    assert!(large.len() > 9_900_000);
    let (list, code) = diagnostics(&scratch.story(large));
    assert_eq!((list.len(), code), (0, 0), "{:#?}", list.first());
}

#[test]
fn a_missing_file_is_named() {
    let out = raconteur(&["check"], Path::new("no/such/story.eml"));
    assert_eq!(out.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&out.stderr).contains("no/such/story.eml"));
}

#[test]
fn wrong_usage_has_its_own_exit_status() {
    let out = raconteur(&["check", "--no-such-option"], Path::new("x"));
    assert_eq!(out.status.code(), Some(2));
}

#[test]
fn text_that_is_not_utf8_is_reported_and_does_not_stop_the_rest() {
    let scratch = Scratch::new("latin1");
    let mut text = wrapped("<voice-text time='0'>caf?</voice-text>").into_bytes();
    let at = text.iter().position(|b| *b == b'?').expect("the mark");
    text[at] = 0xE9;
    let out = raconteur(&["timeline", "--format", "json"], &scratch.story(text));
    assert!(String::from_utf8_lossy(&out.stdout).contains("voice-text"));
}
