//! Stories that try to read files outside their folder.

use std::fs;
use std::os::unix::fs::symlink;

use crate::workshop::{BakeFixture, stderr_of, wave};

/// Bakes a story that plays a recording; fails if that succeeds, and returns the message.
fn refused(workshop: &BakeFixture, clause: &str) -> String {
    workshop.write_story(clause);
    // Both spoken texts and compared ones.
    for more in [&["--check"][..], &[]] {
        let out = workshop.bake("1.0", more).output().unwrap();
        assert!(!out.status.success(), "{clause}");
    }
    let out = workshop.bake("1.0", &[]).output().unwrap();
    assert!(!out.status.success(), "{clause}");
    assert!(
        !workshop.path("story/voice/speech.json").exists(),
        "nothing is written for a rejected story"
    );
    let log = fs::read_to_string(workshop.path("log")).unwrap_or_default();
    assert!(!log.contains("secret"), "{log}");
    stderr_of(&out)
}

const PLAYS: &str = "<voice-text time='1'><audio src='a.wav'/></voice-text>";

#[test]
fn a_recording_is_read_as_what_it_is_and_nothing_else() {
    let workshop = BakeFixture::new();
    wave(&workshop.path("story/a.wav"), 300);
    workshop.write_story(PLAYS);
    fs::remove_file(workshop.path("takes/01.wav")).unwrap();
    let out = workshop.bake("1.0", &[]).output().unwrap();
    assert!(out.status.success(), "{}", stderr_of(&out));
    let log = fs::read_to_string(workshop.path("log")).unwrap();
    let first = log.lines().next().unwrap();
    assert!(
        first.contains("-protocol_whitelist file,pipe -f wav -i file:/"),
        "{first}"
    );
}

#[test]
fn playlists_are_refused_before_any_program_sees_them() {
    let workshop = BakeFixture::new();
    wave(&workshop.path("secret.wav"), 300);
    for list in [
        "#EXTM3U\n#EXTINF:1,\n../secret.wav\n",
        "#EXTM3U\n#EXTINF:1,\nhttp://127.0.0.1:1/secret.wav\n",
        "ffconcat version 1.0\nfile ../secret.wav\n",
        "v=0\no=- 0 0 IN IP4 127.0.0.1\ns=secret\n",
        "<?xml version='1.0'?><MPD><BaseURL>../secret.wav</BaseURL></MPD>",
    ] {
        fs::write(workshop.path("story/a.wav"), list).unwrap();
        let told = refused(&workshop, PLAYS);
        assert!(told.contains("is a playlist"), "{told}");
    }
    assert_eq!(workshop.encoder_starts(), 0, "no program was asked");
}

#[test]
fn links_that_lead_out_of_the_story_are_refused() {
    let said_by_file = "<voice-say time='1' voiceOperation='file' isResourcesRelativeFilePath='false'>a.txt</voice-say>";
    for (link, target, clause) in [
        ("story/a.wav", "../secret.wav", PLAYS),
        ("story/a.txt", "../secret.txt", said_by_file),
        ("story/a.txt", "/etc/passwd", said_by_file),
        (
            "story/lexicon.txt",
            "../secret.txt",
            "<voice-text time='1'>Me too</voice-text>",
        ),
        (
            "story/voice",
            "../elsewhere",
            "<voice-text time='1'>Me too</voice-text>",
        ),
        (
            "takes/02.wav",
            "../secret.wav",
            "<null time='1'/><voice-text time='2'>Me</voice-text><voice-text time='3'>Me too</voice-text>",
        ),
        (
            "takes/01.TextGrid",
            "../secret.txt",
            "<voice-text time='1'>Me too</voice-text>",
        ),
    ] {
        let workshop = BakeFixture::new();
        wave(&workshop.path("secret.wav"), 300);
        fs::write(workshop.path("secret.txt"), "secret words").unwrap();
        fs::create_dir(workshop.path("elsewhere")).unwrap();
        let _ = fs::remove_file(workshop.path(link));
        symlink(target, workshop.path(link)).unwrap();
        let told = refused(&workshop, clause);
        assert!(
            told.contains("a link to a target outside"),
            "{link}: {told}"
        );
        assert!(!told.contains("words"), "{told}");
        assert_eq!(fs::read_dir(workshop.path("elsewhere")).unwrap().count(), 0);
    }
}

#[test]
fn devices_are_refused() {
    let workshop = BakeFixture::new();
    symlink("/dev/zero", workshop.path("story/a.wav")).unwrap();
    let told = refused(&workshop, PLAYS);
    assert!(told.contains("target outside"), "{told}");
}
