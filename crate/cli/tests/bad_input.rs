//! Messages for user errors: every kind of bad input gives a diagnostic with line and column, the
//! rest still plays, and nothing hangs.

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

/// Checks that a text gives a diagnostic with this code in this line, and returns its column.
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
    let inside = far.replace("y='90'", "y='12'");
    expect("body", wrapped(&inside), "player::in-body", 3);
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
    assert!(large.len() > 9_900_000, "the story has more than 9.9 MB");
    let (list, code) = diagnostics(&scratch.story(large));
    assert_eq!((list.len(), code), (0, 0), "{:#?}", list.first());
}

#[test]
fn a_missing_file_is_named() {
    let out = raconteur(&["check"], Path::new("no/such/story.eml"));
    assert_eq!(out.status.code(), Some(1));
    assert!(
        String::from_utf8_lossy(&out.stderr).contains("no/such/story.eml"),
        "stderr names the missing file"
    );
}

#[test]
fn wrong_usage_has_its_own_exit_status() {
    let out = raconteur(&["check", "--no-such-option"], Path::new("x"));
    assert_eq!(out.status.code(), Some(2));
}

#[test]
fn text_that_is_not_utf8_is_named_and_does_not_stop_the_rest() {
    let line = "<voice-text time='0'>caf?</voice-text>";
    let mut text = wrapped(line).into_bytes();
    let at = text.iter().position(|b| *b == b'?').expect("the mark");
    text[at] = 0xE9;
    let column = expect("latin1", &text, "eml::not-utf8", 3);
    assert_eq!(column, 1 + line.find('?').expect("the mark") as u64);
    let scratch = Scratch::new("latin1-timeline");
    let file = scratch.story(&text);
    let (list, code) = diagnostics(&file);
    let found = list
        .iter()
        .find(|d| d["code"] == "eml::not-utf8")
        .expect("one");
    assert_eq!((&found["start"]["offset"], code), (&Value::from(at), 1));
    assert!(found["hints"].to_string().contains("UTF-8"), "{found}");
    let out = raconteur(&["timeline", "--format", "json"], &file);
    assert!(
        String::from_utf8_lossy(&out.stdout).contains("voice-text"),
        "the timeline of the valid parts is printed"
    );
}

#[test]
fn a_replacement_character_that_somebody_wrote_is_text() {
    let scratch = Scratch::new("replacement");
    let line = "<voice-text time='0'>a \u{fffd} quay</voice-text>";
    let told = |text: &[u8]| {
        let (mut list, code) = diagnostics(&scratch.story(text));
        list.retain(|d| d["code"] != "player::no-bundle");
        (list, code)
    };
    assert_eq!(told(wrapped(line).as_bytes()), (Vec::new(), 0));
    let mut text = wrapped(line).into_bytes();
    let at = text.iter().position(|b| *b == b'q').expect("a q");
    text.splice(at..at, [0xe9]);
    let (list, code) = told(&text);
    assert_eq!((list.len(), code), (1, 1), "{list:#?}");
    assert_eq!(list[0]["start"]["offset"], at, "{list:#?}");
}

/// Sequences that control a terminal: ANSI sequences, their one-byte forms, carriage returns, and
/// bidirectional control characters.
const ACTING: &str = "\u{1b}]0;owned\u{7}\u{1b}[2J\u{9b}31m\r\u{8}\u{7f}\u{202e}evil\u{2066}";

#[test]
fn nothing_of_a_story_acts_on_the_terminal() {
    let acts = |c: char| {
        c != '\n' && c != '\t' && c.is_control()
            || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    let scratch = Scratch::new("acting");
    let folder = scratch.0.join(format!("a{ACTING}"));
    fs::create_dir_all(&folder).expect("a folder");
    let named = format!("<voice-text time='0' timeId='{ACTING}'>a</voice-text>");
    for text in [
        wrapped(&format!("<null time='0' colour{ACTING}='x'/>")),
        wrapped(&format!("<{ACTING} time='0'/>")),
        wrapped(&format!("<null time='{ACTING}'/>")),
        wrapped(&format!(
            "<body-deterministic-primitive time='0' primitive='push' animationSetName='{ACTING}'/>"
        )),
        wrapped(&format!(
            "<voice-text time='0'><audio src='{ACTING}.wav'/></voice-text>"
        )),
        wrapped(&named),
        format!(
            "<eml><head><r:performer xmlns:r='urn:raconteur:eml:1' figure='{ACTING}' voice='{ACTING}'/></head><body/></eml>"
        ),
        format!("no story {ACTING}"),
    ] {
        let file = folder.join("story.eml");
        fs::write(&file, &text).expect("a story");
        for arguments in [
            &["check"][..],
            &["check", "--format", "json"],
            &["timeline"],
            &["timeline", "--format", "json"],
            &["pose", "--at", "0", "--digest"],
            &["bake", "--check"],
            &["bake", "--check", "--format", "json"],
            &["fmt", "--check"],
            &["sweep", "--format", "json", "--figure", ACTING],
            &["check", "--assets", ACTING],
        ] {
            let out = raconteur(arguments, &file);
            let printed = [out.stdout, out.stderr].concat();
            let printed = String::from_utf8(printed).expect("UTF-8");
            let found = printed.find(acts);
            assert!(found.is_none(), "{arguments:?} of {text:?}: {printed:?}");
            assert!(
                !printed.is_empty() || arguments[0] == "fmt" || arguments[0] == "check",
                "{arguments:?}"
            );
        }
    }
}

#[test]
fn utf16_is_one_error_with_a_hint() {
    let text = wrapped("<voice-text time='0'>Olá</voice-text>");
    for (mark, big) in [(true, false), (true, true), (false, false), (false, true)] {
        let marked = format!("{}{text}", if mark { "\u{feff}" } else { "" });
        let unit = |u: u16| {
            if big {
                u.to_be_bytes()
            } else {
                u.to_le_bytes()
            }
        };
        let bytes: Vec<u8> = marked.encode_utf16().flat_map(unit).collect();
        let scratch = Scratch::new("utf16");
        let (list, code) = diagnostics(&scratch.story(bytes));
        assert_eq!((list.len(), code), (1, 1), "{list:#?}");
        assert_eq!(list[0]["code"], "eml::not-utf8");
        assert!(
            list[0]["hints"].to_string().contains("UTF-8"),
            "the hint names UTF-8"
        );
    }
}

#[test]
fn devices_and_pipes_are_not_read() {
    let scratch = Scratch::new("devices");
    let pipe = scratch.0.join("pipe.eml");
    let made = Command::new("mkfifo").arg(&pipe).status();
    let pipe = made
        .is_ok_and(|status| status.success())
        .then_some((pipe, "a pipe"));
    let device = Path::new("/dev/zero").to_owned();
    let device = device.exists().then_some((device, "a device"));
    for (path, kind) in [pipe, device].into_iter().flatten() {
        for arguments in [
            &["check"][..],
            &["timeline"],
            &["fmt"],
            &["compose", "-o", "x.wav"],
            &["figure", "build", "-o", "x.glb", "--params"],
        ] {
            let out = raconteur(arguments, &path);
            assert!(!out.status.success(), "{arguments:?}");
            let told = String::from_utf8_lossy(&out.stderr).into_owned();
            assert!(told.contains(kind), "{arguments:?}: {told}");
        }
    }
}

/// The output is bounded for any length of lines and number of mistakes.
#[test]
fn what_is_told_of_a_hostile_story_is_short() {
    let n = 100_000;
    let distinct: String = (0..n).map(|i| format!(" a{i}='1'")).collect();
    let far = "<key x='0' y='900' z='0'/>".repeat(21);
    let gestures =
        format!("<gesture-key time='1' duration='9'><motion>{far}</motion></gesture-key>");
    let shapes = [
        format!("<null time='1'{distinct}/>"),
        format!("<null time='1'{}/>", " a='1'".repeat(n)),
        format!("<null time='1'{}/>", " a".repeat(n)),
        "<oops/>".repeat(n),
        format!("<null time='{}'/>", "x".repeat(n)),
        format!(
            "<voice-text time='0'>{}</voice-text>",
            "<zz>é </zz>".repeat(n / 100)
        ),
        "&".repeat(n),
        gestures.repeat(100),
    ];
    for (i, shape) in shapes.iter().enumerate() {
        let scratch = Scratch::new("hostile");
        let file = scratch.story(format!("<eml><body>{shape}</body></eml>"));
        let out = raconteur(&["check"], &file);
        let told = String::from_utf8_lossy(&out.stderr).into_owned();
        let longest = told.lines().map(|line| line.chars().count()).max();
        assert!(longest.unwrap_or(0) <= 700, "{i}: {longest:?}");
        assert!(told.len() < 200_000, "{i}: {} bytes", told.len());
        let (list, _) = diagnostics(&file);
        for diagnostic in &list {
            assert!(diagnostic.to_string().len() < 4000, "{i}");
            let code = &diagnostic["code"];
            let alike = list.iter().filter(|d| d["code"] == *code).count();
            assert!(alike <= 20 || code == "eml::more", "{i}: {alike} {code}");
        }
        if i == 0 {
            assert!(
                list.iter().any(|d| d["code"] == "eml::too-many-attributes"),
                "the diagnostics include too many attributes"
            );
        }
    }
}

/// A phone that lasts 50 days: the bundle is rejected, with its position.
#[test]
fn impossible_lengths_in_a_bundle_are_named() {
    let scratch = Scratch::new("msecs");
    let file = scratch.story(wrapped("<voice-text time='0'>Hi</voice-text>"));
    let voice = scratch.0.join("voice");
    fs::create_dir_all(&voice).expect("a folder");
    let bundle = r#"{"format": "raconteur-speech", "version": 2,
        "voices": [{"engine": "e", "voice": "v", "language": "en", "phone_set": "radio"}],
        "utterances": [{"key": "00000000000000ff", "content": "00000000000000ff", "voice": 0,
        "text": "Hi", "audio": [], "words": [[0, 2, 0, 1]], "phones": "ay", "msecs": [4294967295]}]}"#;
    fs::write(voice.join("speech.json"), bundle).expect("a bundle");
    let (list, _) = diagnostics(&file);
    let found = list.iter().find(|d| d["code"] == "player::bad-bundle");
    let message = found.map(|d| d["message"].to_string()).unwrap_or_default();
    assert!(message.contains("4294967295 ms"), "{list:#?}");
}

/// Far from any library: the figure is in the program.
#[test]
fn a_new_story_plays_wherever_it_is() {
    let far = tempfile::tempdir().expect("a folder");
    let run = |arguments: &[&str]| {
        Command::new(env!("CARGO_BIN_EXE_raconteur"))
            .args(arguments)
            .current_dir(far.path())
            .env_remove("XDG_RUNTIME_DIR")
            .output()
            .expect("the program runs")
    };
    let made = run(&["new", "first"]);
    assert!(
        made.status.success(),
        "{}",
        String::from_utf8_lossy(&made.stderr)
    );
    let checked = run(&["check", "first"]);
    let told = String::from_utf8_lossy(&checked.stderr).into_owned();
    assert!(checked.status.success() && told.is_empty(), "{told}");
    let posed = run(&["pose", "first", "--at", "1", "--digest"]);
    assert!(posed.status.success(), "the pose of the new story succeeds");
    // Library messages must not reach the output, for example about a missing session or an invalid
    // session folder.
    for session in [None, Some("/no/such/folder"), Some("first/story.eml")] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_raconteur"));
        match session {
            Some(folder) => command.env("XDG_RUNTIME_DIR", folder),
            None => command.env_remove("XDG_RUNTIME_DIR"),
        };
        let picture = ["render", "first", "--at", "1", "--size", "32x32", "-o"];
        command.args(picture).arg("x.png").current_dir(far.path());
        let drawn = command.output().expect("the program runs");
        let told = String::from_utf8_lossy(&drawn.stderr).into_owned();
        assert!(
            drawn.status.success() && told.is_empty(),
            "{session:?}: {told}"
        );
    }
    // An existing file is not overwritten.
    assert!(
        !run(&["new", "first"]).status.success(),
        "an existing story is not overwritten"
    );
    assert!(
        !run(&["--assets", "nowhere", "check", "first"])
            .status
            .success(),
        "a missing assets folder is rejected"
    );
}
