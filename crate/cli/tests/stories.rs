//! Shipped stories: no diagnostics, and times that follow their speech.

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
    let (timeline, told) = timeline_and_told(name);
    assert!(told.is_empty(), "{told}");
    timeline
}

/// Returns the timeline, and the diagnostics of the story.
fn timeline_and_told(name: &str) -> (Value, String) {
    let out = Command::new(env!("CARGO_BIN_EXE_raconteur"))
        .args(["timeline", "--format", "json"])
        .arg(story(name))
        .output()
        .expect("the program runs");
    let told = String::from_utf8_lossy(&out.stderr).into_owned();
    (serde_json::from_slice(&out.stdout).expect("JSON"), told)
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
    // GEVH 3.6.1: the hand rises 0.1 s before the clause with "Hello"; the beat coincides with the
    // start of "world".
    assert!((keys[0] - (voice - 0.1)).abs() < 1e-9, "{keys:?} {voice}");
    assert!((keys[1] - world).abs() < 1e-9, "{keys:?} {world}");
    assert!(
        world > voice + 0.2,
        "the mark is at least 0.2 s after the speech starts"
    );
}

#[test]
fn the_folk_tale_is_long_and_full_of_gestures() {
    let t = timeline("white-rabbit");
    assert!(
        t["duration"].as_f64().expect("a duration") >= 75.0,
        "the folk tale lasts at least 75 s"
    );
    assert!(
        starts(&t, "gesture-key").len() >= 25,
        "the folk tale has at least 25 gesture keys"
    );
}

/// Returns true if a time lies on a beat of the given duration.
fn on_beat(secs: f64, beat_secs: f64) -> bool {
    let beats = secs / beat_secs;
    (beats - beats.round()).abs() < 1e-6
}

#[test]
fn every_step_of_the_lesson_begins_on_a_beat() {
    let t = timeline("step-lesson");
    assert!(
        t["duration"].as_f64().expect("a duration") >= 240.0,
        "the lesson lasts at least 240 s"
    );
    assert_eq!(t["lead_in"].as_f64(), Some(0.0));
    let text = std::fs::read_to_string(story("step-lesson")).expect("the script");
    let mut steps: Vec<&str> = text
        .split("animationSetName='")
        .skip(1)
        .filter_map(|rest| rest.split('\'').next())
        .filter(|name| name.starts_with("step-") || name.starts_with("stretch-"))
        .collect();
    steps.sort_unstable();
    steps.dedup();
    assert!(steps.len() >= 26, "{steps:?}");
    // Greeting arms may move between beats; from the march on, everything is in time.
    let late: Vec<f64> = starts(&t, "body-deterministic-primitive")
        .into_iter()
        .filter(|s| (16.0..236.0).contains(s) && !on_beat(*s, 0.5))
        .collect();
    assert!(late.is_empty(), "{late:?}");
    // Each change is announced: at least once in each eight counts.
    assert!(
        starts(&t, "voice-text").len() >= 60,
        "the lesson has at least 60 utterances"
    );
}

#[test]
fn counts_fall_on_the_beat() {
    let t = timeline("step-lesson");
    let folder = story("step-lesson").with_file_name("voice/speech.json");
    let bundle: Value =
        serde_json::from_str(&std::fs::read_to_string(folder).expect("the bundle")).expect("JSON");
    let text = std::fs::read_to_string(story("step-lesson")).expect("the script");
    let mut counted = 0;
    for clause in t["clauses"].as_array().into_iter().flatten() {
        let line = clause["line"].as_u64().unwrap_or(0) as usize;
        let source = text.lines().nth(line.saturating_sub(1)).unwrap_or("");
        let Some(word) = ["Four!", "Three!", "Two!", "One!"]
            .into_iter()
            .find(|w| source.contains(&format!(">{w}<")))
        else {
            continue;
        };
        let spoken = bundle["utterances"]
            .as_array()
            .into_iter()
            .flatten()
            .find(|u| u["text"] == word)
            .expect("it was baked");
        // Its first phone, and the duration of the preceding ones.
        let first = spoken["words"][0][2].as_u64().expect("a phone") as usize;
        let lengths = spoken["msecs"].as_array().expect("lengths").iter();
        let before: u64 = lengths.take(first).filter_map(Value::as_u64).sum();
        let onset = before as f64 / 1000.0;
        let heard = clause["start"].as_f64().expect("a time") + onset;
        let off = heard / 0.5 - (heard / 0.5).round();
        // Times in the script are rounded to the millisecond.
        assert!(off.abs() * 0.5 < 0.002, "{word} at {heard}");
        counted += 1;
    }
    assert_eq!(counted, 8);
}

#[test]
fn the_dance_knows_every_function() {
    let t = timeline("mathematical-dance");
    assert!(
        t["duration"].as_f64().expect("a duration") >= 240.0,
        "the dance lasts at least 240 s"
    );
    let text = std::fs::read_to_string(story("mathematical-dance")).expect("the script");
    for function in [
        "segment",
        "circle",
        "ellipse",
        "sinusoid",
        "helix",
        "lemniscate",
        "bezier",
        "hermite",
    ] {
        assert!(
            text.contains(&format!("functionName='{function}'")),
            "{function}"
        );
    }
    for limb in ["leftArm", "rightArm", "leftLeg", "rightLeg", "head"] {
        assert!(text.contains(&format!("manipulator='{limb}'")), "{limb}");
    }
    assert!(
        starts(&t, "vh-move").len() > 60,
        "the dance has more than 60 movements"
    );
    // Only an animation that holds the fingers has an effect.
    assert_eq!(text.matches("animationSetName").count(), 1);
    assert!(
        text.contains("animationSetName='hand-shape-1'><tracks><ref name='hands'/>"),
        "the only animation holds the fingers"
    );
}

#[test]
fn shipped_stories_are_silent_under_check() {
    for name in [
        "hello-world",
        "white-rabbit",
        "step-lesson",
        "mathematical-dance",
        "virtual-poets/jabberwocky",
        "virtual-poets/os-lusiadas",
        "virtual-poets/zwei-parallelen",
    ] {
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

/// Returns the spoken texts of a script's voice-texts, without markup, by their timeId.
fn spoken(name: &str) -> Vec<(String, String)> {
    let text = std::fs::read_to_string(story(name)).expect("the script");
    let one = |clause: &str| {
        let (id, rest) = clause.split_once("timeId='")?.1.split_once('\'')?;
        let inside = rest.split_once('>')?.1.split_once("</voice-text>")?.0;
        let mut words = String::new();
        for (i, part) in inside.split('<').enumerate() {
            let bare = if i == 0 {
                part
            } else {
                part.split_once('>')?.1
            };
            words.push_str(bare);
        }
        let words: Vec<&str> = words.split_whitespace().collect();
        Some((id.to_owned(), words.join(" ")))
    };
    text.split("<voice-text").skip(1).filter_map(one).collect()
}

#[test]
fn jabberwocky_is_said_twice_in_the_same_words() {
    let all = spoken("virtual-poets/jabberwocky");
    let poem = |first: char| -> Vec<String> {
        all.iter()
            .filter(|(id, _)| id.len() == 2 && id.starts_with(first))
            .map(|(_, words)| words.to_lowercase())
            .collect()
    };
    let (book, told) = (poem('b'), poem('s'));
    assert_eq!(book.len(), 7);
    assert_eq!(book, told);
    assert_eq!(book[0], book[6]);
    // The plain one has no more markup than whose voice it is and where its lines end.
    let text = std::fs::read_to_string(story("virtual-poets/jabberwocky")).expect("the script");
    let (plain, told) = text.split_once("And as he tells it").expect("two parts");
    for element in ["<pitch", "<rate", "<volume", "<emph"] {
        assert!(!plain.contains(element), "{element}");
        assert!(told.matches(element).count() > 3, "{element}");
    }
}

#[test]
fn the_emoticons_stand_where_the_thesis_has_them() {
    // F&H table 4.2.
    let all = spoken("virtual-poets/zwei-parallelen");
    let words: Vec<&str> = all.iter().flat_map(|(_, w)| w.split(' ')).collect();
    let sign = |word: &str| word.starts_with([':', ';']) && word.len() == 3;
    let near: Vec<String> = (1..words.len())
        .filter(|i| sign(words[*i]))
        .map(|i| {
            let next = words.get(i + 1).copied().unwrap_or_default();
            format!("{} {} {next}", words[i - 1], words[i])
        })
        .collect();
    assert_eq!(
        near,
        [
            "ins ;-) Endlose",
            "nicht :-( schneiden",
            "Grab: :-( Das",
            "nicht :-o irdisch",
            "sie :-o eins",
            "Seraphim. :-) "
        ]
    );
}

#[test]
fn a_poem_whose_text_is_not_there_is_told_of_and_framed() {
    let name = "virtual-poets/the-road-not-taken";
    let out = Command::new(env!("CARGO_BIN_EXE_raconteur"))
        .arg("check")
        .arg(story(name))
        .output()
        .expect("the program runs");
    let told = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.success(), "{told}");
    assert_eq!(told.matches("warning[").count(), 1, "{told}");
    assert!(told.contains("the-road-not-taken.txt"), "{told}");
    let (all, _) = timeline_and_told(name);
    let voice = starts(&all, "voice-text");
    let poem = starts(&all, "voice-say")[0];
    assert!(voice[0] < poem && poem < voice[1], "{voice:?} {poem}");
}

#[test]
fn a_file_that_is_not_there_keeps_nothing_else_from_being_baked() {
    let folder = tempfile::tempdir().expect("a folder");
    let script = folder.path().join("story.eml");
    let eml = "<eml><body><voice-say time='0' voiceOperation='file' \
               isResourcesRelativeFilePath='false'>poem.txt</voice-say></body></eml>";
    std::fs::write(&script, eml).expect("the script");
    let out = Command::new(env!("CARGO_BIN_EXE_raconteur"))
        .args([
            "bake",
            "--engine",
            "recordings",
            "--voice",
            "me",
            "--recordings",
        ])
        .arg(folder.path())
        .arg(&script)
        .output()
        .expect("the program runs");
    let told = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.success(), "{told}");
    assert!(
        told.contains("poem.txt; nothing is said in its place"),
        "{told}"
    );
    assert!(
        !folder.path().join("voice").exists(),
        "no voice folder is created"
    );
}
