//! Performer selection: a story sets its figure, voice and language; options and attributes may
//! override them, and the default figure replaces an unavailable one.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// Creates a story in a separate folder below this folder, from which the library is found.
fn story(name: &str, performer: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("performer-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join("story.eml");
    let text = format!(
        "<eml xmlns:r='urn:raconteur:eml:1'>\n<head><r:performer {performer}/></head>\n\
         <body><voice-text time='0'>One two three.</voice-text></body></eml>"
    );
    fs::write(&path, text).expect("a story");
    path
}

fn raconteur(arguments: &[&str], story: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_raconteur"))
        .args(arguments)
        .arg(story)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("the program runs")
}

/// Returns the digest of the first frame, and the messages except the one about the missing voice.
fn performed(story: &Path, figure: &[&str]) -> (String, Vec<String>) {
    let arguments = [
        &["pose", "--at", "0", "--digest", "--format", "json"],
        figure,
    ]
    .concat();
    let out = raconteur(&arguments, story);
    let told = String::from_utf8_lossy(&out.stderr).into_owned();
    assert!(out.status.success(), "{told}");
    let json: Value = serde_json::from_slice(&out.stdout).expect("JSON");
    let digest = json.to_string();
    let told = told
        .lines()
        .filter(|l| l.contains("player::no-figure") || l.contains("did you"));
    (digest, told.map(str::to_owned).collect())
}

#[test]
fn the_figure_is_the_one_asked_for_else_the_storys_else_the_usual_one() {
    let sofia = performed(&story("sofia", "figure='sofia'"), &[]).0;
    let nuno = performed(&story("nuno", "figure='nuno'"), &[]).0;
    assert_ne!(sofia, nuno);
    let nobody = story("nobody", "gaze='1'");
    assert_eq!(performed(&nobody, &[]), (sofia.clone(), vec![]));
    let chosen = story("chosen", "figure='nuno'");
    let asked = performed(&chosen, &["--figure", "sofia"]);
    assert_eq!(asked, (sofia.clone(), vec![]));
    let own = story("own", "figure='me.glb'");
    let library = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/figures");
    fs::copy(library.join("nuno.glb"), own.with_file_name("me.glb")).expect("a copy");
    assert_eq!(performed(&own, &[]), (nuno, vec![]));

    let (digest, told) = performed(&story("unknown", "figure='nunno'"), &[]);
    assert_eq!(digest, sofia);
    assert_eq!(told.len(), 2, "{told:?}");
    assert!(
        told[0].contains("story.eml:2:7: warning[player::no-figure]"),
        "{told:?}"
    );
    assert!(told[1].contains("did you mean `nuno`?"), "{told:?}");
    let (digest, told) = performed(&story("absent", "figure='absent.glb'"), &[]);
    assert_eq!((digest, told.len()), (sofia, 1), "{told:?}");
}

/// Returns the engine, voice and language of the baked utterances.
fn baked(story: &Path, arguments: &[&str]) -> [String; 3] {
    let out = raconteur(&[&["bake"], arguments].concat(), story);
    assert!(
        out.status.success(),
        "{}",
        String::from_utf8_lossy(&out.stderr)
    );
    let text = fs::read_to_string(story.with_file_name("voice").join("speech.json"));
    let json: Value = serde_json::from_str(&text.expect("a bundle")).expect("JSON");
    let voice = &json["voices"][0];
    ["engine", "voice", "language"].map(|k| voice[k].as_str().unwrap_or_default().to_owned())
}

#[test]
fn the_voice_is_the_one_asked_for_else_the_storys() {
    let rms = story("rms", "voice='flite:rms'");
    let [engine, voice, _] = baked(&rms, &[]);
    assert!(
        engine.starts_with("flite") && voice == "rms",
        "{engine} {voice}"
    );
    let [engine, voice, _] = baked(&rms, &["--engine", "flite", "--voice", "slt"]);
    assert!(
        engine.starts_with("flite") && voice == "slt",
        "{engine} {voice}"
    );
    let [engine, voice, _] = baked(&rms, &["--engine", "espeak-ng"]);
    assert!(
        engine.contains("eSpeak") || engine.starts_with("espeak-ng"),
        "{engine} {voice}"
    );
    // Without a voice, the text is spoken in the story's language by a matching voice.
    let [_, _, language] = baked(&story("de", "language='de'"), &[]);
    assert_eq!(language.split('-').next(), Some("de"));
}

#[test]
fn a_voice_or_language_that_there_is_not_is_told_with_what_is_meant() {
    for (name, performer, meant) in [
        ("slip", "voice='flite:rsm'", "did you mean rms?"),
        ("engine", "voice='flyte:rms'", "did you mean flite?"),
        ("language", "language='Klingonisch'", "not a BCP 47 tag"),
    ] {
        let out = raconteur(&["bake"], &story(name, performer));
        let told = String::from_utf8_lossy(&out.stderr);
        assert!(
            !out.status.success() && told.contains(meant),
            "{name}: {told}"
        );
    }
}
