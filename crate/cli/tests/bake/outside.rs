//! Containment: nothing outside a story's folder and the library is opened, regardless of the names
//! in its folder and texts; the file layer's own log is the evidence.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Output;

use crate::workshop::{BakeFixture, stderr_of, wave};

/// Each attribute and text that names a file, with `FILE` for its path without the ending.
const NAMES: [(&str, &str); 9] = [
    (
        "txt",
        "<voice-say time='0' voiceOperation='file' isResourcesRelativeFilePath='false'>FILE.txt</voice-say>",
    ),
    (
        "txt",
        "<voice-say time='0' voiceOperation='file' isResourcesRelativeFilePath='true'>FILE.txt</voice-say>",
    ),
    (
        "txt",
        "<voice-say time='0' voiceOperation='file'>FILE.txt</voice-say>",
    ),
    (
        "wav",
        "<voice-text time='0'>Me too <audio src='FILE.wav'/></voice-text>",
    ),
    (
        "json",
        "<body-deterministic-primitive time='0' primitive='push' animationSetName='FILE.json'/>",
    ),
    (
        "glb",
        "<body-deterministic-primitive time='0' primitive='push' animationSetName='FILE.glb#a'/>",
    ),
    (
        "json",
        "<body-load-control-parameter-animation time='0' file='FILE.json' name='a'/>",
    ),
    (
        "json",
        "<body-load-control-parameter-animation time='0' file='FILE.json' isResourcesRelative='true' name='a'/>",
    ),
    ("opus", "<r:music time='0' file='FILE.opus'/>"),
];

/// Creates files outside the story, of every type that a story may request.
fn secrets(workshop: &BakeFixture) {
    let outside = workshop.path("outside");
    for inner in ["", "figures", "animations", "music", "voice"] {
        let folder = outside.join(inner);
        fs::create_dir_all(&folder).unwrap();
        for name in [
            "a.txt",
            "a.json",
            "a.glb",
            "a.opus",
            "sofia.glb",
            "stand.json",
        ] {
            fs::write(folder.join(name), "secret words").unwrap();
        }
        wave(&folder.join("a.wav"), 300);
    }
    fs::write(outside.join("lexicon.txt"), "me = secret\n").unwrap();
    fs::write(outside.join("speech.json"), "{\"secret\": 1}").unwrap();
}

/// Returns the files that a command in a folder reports as opened, with links resolved. Scratch
/// files are gone.
fn opened(folder: &Path, out: &Output) -> Vec<PathBuf> {
    let told = stderr_of(out);
    let lines = told.lines().filter_map(|line| line.strip_prefix("opened "));
    let paths = lines.map(|path| folder.join(path));
    paths
        .map(|path| fs::canonicalize(&path).unwrap_or(path))
        .collect()
}

/// Runs every command that reads a story; fails if one opens a forbidden file.
fn assert_contained(workshop: &BakeFixture, what: &str) {
    let root = fs::canonicalize(workshop.path("")).unwrap();
    let allowed = |path: &Path| {
        ["story", "takes", "tmp"]
            .iter()
            .any(|inner| path.starts_with(root.join(inner)))
            || !path.starts_with(&root)
                && path.components().any(|part| part.as_os_str() == "assets")
    };
    let bake = workshop.bake("1.0", &["--log-files"]);
    let check = workshop.bake("1.0", &["--check", "--log-files"]);
    let commands = [
        bake,
        check,
        workshop.command(&["check", "story", "--log-files"]),
        workshop.command(&["timeline", "story", "--log-files"]),
        workshop.command(&["pose", "story", "--at", "0.5", "--digest", "--log-files"]),
    ];
    for mut command in commands {
        let out = command
            .current_dir(workshop.path("story/.."))
            .output()
            .unwrap();
        let files = opened(&root, &out);
        let script = root.join("story/story.eml");
        assert!(files.contains(&script), "{what}: {}", stderr_of(&out));
        for path in &files {
            assert!(allowed(path), "{what}: opened {}", path.display());
        }
        let printed = format!(
            "{}{}",
            String::from_utf8_lossy(&out.stdout),
            stderr_of(&out)
        );
        assert!(!printed.contains("secret"), "{what}: {printed}");
    }
}

fn write_story(workshop: &BakeFixture, head: &str, clause: &str) {
    let text = format!(
        "<eml xmlns:r='urn:raconteur:eml:1'><head>{head}</head><body>{clause}\
         <voice-text time='1'>Me too</voice-text></body></eml>"
    );
    fs::write(workshop.path("story/story.eml"), text).unwrap();
}

#[test]
fn no_attribute_reaches_out_of_the_folder_at_any_level() {
    let workshop = BakeFixture::new();
    secrets(&workshop);
    // A file that is a link, a folder that is one, and one below a folder of the story.
    fs::create_dir_all(workshop.path("story/deep/deeper")).unwrap();
    symlink("../outside", workshop.path("story/away")).unwrap();
    symlink("../../../outside", workshop.path("story/deep/deeper/away")).unwrap();
    symlink("away", workshop.path("story/again")).unwrap();
    for (ending, clause) in NAMES {
        let link = format!("link.{ending}");
        let target = format!("outside/a.{ending}");
        let place = workshop.path("story").join(&link);
        let _ = fs::remove_file(&place);
        symlink(workshop.path(&target), place).unwrap();
        for path in [
            "link",
            "away/a",
            "deep/deeper/away/a",
            "again/a",
            "../outside/a",
        ] {
            write_story(&workshop, "", &clause.replace("FILE", path));
            assert_contained(&workshop, &format!("{clause} with {path}"));
        }
        let path = workshop.path("outside/a");
        write_story(
            &workshop,
            "",
            &clause.replace("FILE", &path.to_string_lossy()),
        );
        assert_contained(&workshop, &format!("{clause} with {}", path.display()));
    }
}

#[test]
fn no_figure_reaches_out_of_the_folder() {
    let workshop = BakeFixture::new();
    secrets(&workshop);
    symlink("../outside", workshop.path("story/away")).unwrap();
    symlink("../outside/a.glb", workshop.path("story/link.glb")).unwrap();
    for figure in [
        "link.glb",
        "away/a.glb",
        "../outside/a.glb",
        "../../outside/a",
        "away/a",
    ] {
        write_story(&workshop, &format!("<r:performer figure='{figure}'/>"), "");
        assert_contained(&workshop, figure);
    }
}

#[test]
fn no_folder_of_a_story_is_taken_for_the_library() {
    for (link, clause) in [
        ("assets", NAMES[1].1.replace("FILE", "a")),
        ("assets", NAMES[2].1.replace("FILE", "a")),
        (
            "assets",
            "<r:music time='0' valence='positive'/>".to_owned(),
        ),
        (
            "assets",
            "<body-deterministic-primitive time='0' primitive='push' animationSetName='stand'/>"
                .to_owned(),
        ),
        ("animations", NAMES[4].1.replace("FILE", "animations/a")),
        ("voice", String::new()),
        ("lexicon.txt", String::new()),
    ] {
        let workshop = BakeFixture::new();
        secrets(&workshop);
        let target = if link.contains('.') {
            "outside/lexicon.txt"
        } else {
            "outside"
        };
        symlink(workshop.path(target), workshop.path("story").join(link)).unwrap();
        // The same holds for an adjacent folder.
        symlink("outside", workshop.path("assets")).unwrap();
        write_story(&workshop, "", &clause);
        assert_contained(&workshop, &format!("{link}: {clause}"));
        // Nor where the story is the working folder.
        let mut inside = workshop.command(&[
            "bake",
            ".",
            "--log-files",
            "--engine",
            "recordings",
            "--recordings",
            "../takes",
        ]);
        let out = inside.current_dir(workshop.path("story")).output().unwrap();
        let outside = fs::canonicalize(workshop.path("outside")).unwrap();
        assert!(
            opened(&workshop.path("story"), &out)
                .iter()
                .all(|path| !path.starts_with(&outside)),
            "{link}: {}",
            stderr_of(&out)
        );
        assert!(
            !workshop.path("outside/voice/speech.json").exists(),
            "nothing is written outside the story"
        );
        assert_eq!(
            fs::read(workshop.path("outside/speech.json")).unwrap(),
            b"{\"secret\": 1}"
        );
    }
}

#[test]
fn sounds_of_a_bundle_stay_in_it() {
    let workshop = BakeFixture::new();
    secrets(&workshop);
    assert!(
        workshop.bake("1.0", &[]).status().unwrap().success(),
        "the bake of the linked bundle succeeds"
    );
    let speech = workshop.path("story/voice/speech.json");
    let text = fs::read_to_string(&speech).unwrap();
    let sound = workshop
        .names()
        .into_iter()
        .find(|name| name.ends_with(".opus"))
        .unwrap();
    for path in ["../../outside/a.wav", "link.wav"] {
        let _ = fs::remove_file(workshop.path("story/voice/link.wav"));
        symlink("../../outside/a.wav", workshop.path("story/voice/link.wav")).unwrap();
        fs::write(&speech, text.replace(&sound, path)).unwrap();
        let out = workshop
            .command(&["check", "story", "--log-files"])
            .output()
            .unwrap();
        let outside = fs::canonicalize(workshop.path("outside")).unwrap();
        assert!(
            opened(&workshop.path(""), &out)
                .iter()
                .all(|p| !p.starts_with(&outside)),
            "{}",
            stderr_of(&out)
        );
    }
}
