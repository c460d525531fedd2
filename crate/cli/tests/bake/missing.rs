//! Missing programs on a machine.

use std::os::unix::fs::symlink;
use std::path::PathBuf;
use std::{env, fs};

use crate::workshop::{BakeFixture, UTTERANCES, stderr_of};

#[test]
fn all_missing_programs_are_named_in_one_line() {
    let workshop = BakeFixture::new();
    let nothing = workshop.path("nothing");
    for (engine, named, packages) in [
        ("recordings", vec!["ffmpeg", "opusenc"], "ffmpeg opus-tools"),
        (
            "flite",
            vec!["ffmpeg", "flite", "opusenc"],
            "ffmpeg flite opus-tools",
        ),
        (
            "festival",
            vec!["festival", "ffmpeg", "opusenc"],
            "festival festvox-us-slt-hts ffmpeg opus-tools",
        ),
    ] {
        let arguments = ["bake", "story", "--recordings", "takes", "--engine", engine];
        let mut bake = workshop.command(&arguments);
        let out = bake.env("PATH", &nothing).output().unwrap();
        let told = stderr_of(&out);
        assert!(!out.status.success(), "the bake without programs fails");
        let list = format!("this needs {}, which", named.join(", "));
        assert!(told.contains(&list), "{told}");
        assert!(
            told.trim_end()
                .ends_with(&format!("apt-get install {packages}")),
            "{told}"
        );
        assert!(!workshop.path("story/voice").exists(), "nothing was begun");
    }
}

#[test]
fn voices_of_the_script_are_named_with_the_others() {
    let workshop = BakeFixture::new();
    workshop.write_story(
        "<voice-change time='0' voice='flite:rms'/><voice-text time='1'>One.</voice-text>\
         <voice-change time='2' voice='marytts:x'/><voice-text time='3'>Two.</voice-text>",
    );
    let arguments = [
        "bake",
        "story",
        "--engine",
        "festival",
        "--server",
        "localhost:1",
    ];
    let mut bake = workshop.command(&arguments);
    let out = bake.env("PATH", workshop.path("nothing")).output().unwrap();
    let told = stderr_of(&out);
    assert!(
        told.contains("this needs festival, ffmpeg, flite, opusenc, which"),
        "{told}"
    );
    assert!(told.contains("localhost:1"), "{told}");
}

/// Returns the path of an installed program.
fn installed(name: &str) -> PathBuf {
    let path = env::var_os("PATH").unwrap_or_default();
    env::split_paths(&path)
        .map(|folder| folder.join(name))
        .find(|place| place.is_file())
        .unwrap_or_else(|| panic!("{name} is not installed"))
}

#[test]
fn without_festival_another_installed_engine_speaks() {
    let workshop = BakeFixture::new();
    // An engine and the encoders' programs, without festival.
    let programs = workshop.path("bin");
    for name in ["flite", "cat", "sleep"] {
        symlink(installed(name), programs.join(name)).unwrap();
    }
    let bake = |more: &[&str]| {
        let arguments = [&["bake", "story"][..], more].concat();
        let mut command = workshop.command(&arguments);
        command.env("PATH", &programs).output().unwrap()
    };
    let out = bake(&[]);
    let told = stderr_of(&out);
    assert!(out.status.success(), "{told}");
    assert!(
        told.contains("spoken by ") && told.contains("as kokoro and festival are not here: "),
        "{told}"
    );
    let text = fs::read(workshop.path("story/voice/speech.json")).unwrap();
    let bundle: serde_json::Value = serde_json::from_slice(&text).unwrap();
    let engine = bundle["voices"][0]["engine"].as_str().unwrap();
    assert!(!engine.starts_with("festival"), "{engine}");
    assert!(told.contains(engine.split(' ').next().unwrap()), "{told}");
    assert_eq!(bundle["utterances"].as_array().unwrap().len(), UTTERANCES);
    // An explicitly selected engine is not replaced.
    let out = bake(&["--engine", "festival", "--pace", "1.5"]);
    assert!(!out.status.success(), "the bake without an engine fails");
    assert!(
        stderr_of(&out).contains("this needs festival"),
        "{}",
        stderr_of(&out)
    );
}

#[test]
fn voices_can_be_listed_without_any_engine() {
    let workshop = BakeFixture::new();
    for more in [&[][..], &["--engine", "flite"], &["--engine", "festival"]] {
        let arguments = [&["bake", "--list-voices", "--format", "json"][..], more].concat();
        let mut list = workshop.command(&arguments);
        let out = list.env("PATH", workshop.path("nothing")).output().unwrap();
        assert!(out.status.success(), "{}", stderr_of(&out));
        assert!(out.stdout.starts_with(b"["), "stdout is a JSON array");
        if !more.is_empty() {
            assert_eq!(out.stdout, b"[]\n");
            assert!(
                stderr_of(&out).contains("apt-get install"),
                "{}",
                stderr_of(&out)
            );
        }
    }
}

/// Stories of a folder.
fn stories(folder: &std::path::Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.join("story.eml").is_file() {
            found.push(path);
        } else if path.is_dir() {
            stories(&path, found);
        }
    }
}

#[test]
fn shipped_stories_are_up_to_date_without_engines() {
    let workshop = BakeFixture::new();
    let mut found = Vec::new();
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/stories");
    stories(&folder, &mut found);
    assert!(found.len() >= 6, "at least 6 shipped stories are checked");
    for story in found {
        for check in [&["--check"][..], &[]] {
            let mut bake = workshop.command(&[&["bake"][..], check].concat());
            let out = bake
                .env("PATH", workshop.path("nothing"))
                .arg(&story)
                .output()
                .unwrap();
            assert!(
                out.status.success(),
                "{}: {}",
                story.display(),
                stderr_of(&out)
            );
        }
    }
}
