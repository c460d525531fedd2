//! Interrupted bakes: the bundle is the complete old one or the complete new one, and the check
//! distinguishes them.

use std::fs;
use std::process::{Command, Stdio};

use crate::workshop::{BakeFixture, UTTERANCES, stderr_of, wave};

/// Encoders that run in a bake.
const STEPS: usize = 2 * UTTERANCES;

fn whole(workshop: &BakeFixture) -> String {
    let pace = workshop.pace_of_bundle();
    for other in ["1.0", "1.5"] {
        assert_eq!(workshop.is_up_to_date(other), other == pace, "{other}");
    }
    pace
}

#[test]
fn a_bake_that_is_stopped_leaves_a_whole_bundle() {
    for step in 0..=STEPS + 1 {
        let signal = ["-INT", "-KILL"][step % 2];
        let workshop = BakeFixture::new();
        assert!(
            workshop.bake("1.0", &[]).status().unwrap().success(),
            "the first bake succeeds"
        );
        assert_eq!(whole(&workshop), "1.0");
        fs::remove_file(workshop.path("log")).unwrap();
        let mut bake = workshop.bake("1.5", &[]);
        bake.env("WAIT", "0.02")
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        let mut child = bake.spawn().unwrap();
        workshop.until_begun(step, &mut child);
        let number = child.id().to_string();
        // The process may have ended after the last step.
        let _ = Command::new("kill")
            .args([signal, &number])
            .stderr(Stdio::null())
            .status();
        let ended = child.wait().unwrap();
        let pace = whole(&workshop);
        assert!(!ended.success() || pace == "1.5", "step {step}");
        // The next bake succeeds without special treatment and cleans up.
        assert!(
            workshop.bake("1.5", &[]).status().unwrap().success(),
            "the bake after the interruption succeeds"
        );
        assert_eq!(whole(&workshop), "1.5");
        assert_eq!(workshop.names().len(), STEPS + 1, "{:?}", workshop.names());
    }
}

#[test]
fn a_second_bake_is_told_to_wait() {
    let workshop = BakeFixture::new();
    // The first cannot end while the gate is closed.
    fs::write(workshop.path("gate"), "").unwrap();
    let mut child = workshop.bake("1.0", &[]).spawn().unwrap();
    workshop.until_begun(1, &mut child);
    let second = workshop.bake("1.5", &[]).output().unwrap();
    assert!(!second.status.success(), "the second bake fails");
    let told = format!("process {} is baking this story", child.id());
    assert!(stderr_of(&second).contains(&told), "{}", stderr_of(&second));
    fs::remove_file(workshop.path("gate")).unwrap();
    assert!(child.wait().unwrap().success(), "the first bake succeeds");
    whole(&workshop);
}

#[test]
fn several_bakes_at_once_leave_a_whole_bundle() {
    let workshop = BakeFixture::new();
    for _ in 0..3 {
        let bakes: Vec<_> = ["1.0", "1.5", "1.0", "1.5"]
            .into_iter()
            .map(|pace| workshop.bake(pace, &[]).spawn().unwrap())
            .collect();
        let ended: Vec<_> = bakes
            .into_iter()
            .map(|b| b.wait_with_output().unwrap())
            .collect();
        assert!(
            ended.iter().any(|out| out.status.success()),
            "at least one of the parallel bakes succeeds"
        );
        for out in ended.iter().filter(|out| !out.status.success()) {
            assert!(
                stderr_of(out).contains("is baking this story"),
                "{}",
                stderr_of(out)
            );
        }
        whole(&workshop);
        assert_eq!(workshop.names().len(), STEPS + 1, "{:?}", workshop.names());
    }
}

#[test]
fn a_changed_sound_is_found_and_made_anew() {
    let workshop = BakeFixture::new();
    assert!(
        workshop.bake("1.0", &[]).status().unwrap().success(),
        "the first bake succeeds"
    );
    let sounds = workshop.names();
    // The result of the earlier fault: the audio of another bake under the same name.
    let sound = workshop.path("story/voice").join(&sounds[0]);
    let mut bytes = fs::read(&sound).unwrap();
    let last = bytes.len() - 1;
    bytes[last] ^= 1;
    for other in [&bytes[..], &bytes[..last], b""] {
        fs::write(&sound, other).unwrap();
        assert!(
            !workshop.is_up_to_date("1.0"),
            "the bundle with changed audio is out of date"
        );
        let out = workshop.command(&["check", "story"]).output().unwrap();
        assert!(
            !out.status.success() && stderr_of(&out).contains("wrong-sound"),
            "{}",
            stderr_of(&out)
        );
        let before = workshop.encoder_starts();
        assert!(
            workshop.bake("1.0", &[]).status().unwrap().success(),
            "the bake of the changed audio succeeds"
        );
        assert_eq!(workshop.encoder_starts(), before + 2, "one utterance alone");
        assert_eq!(whole(&workshop), "1.0");
        assert_eq!(workshop.names(), sounds);
    }
}

#[test]
fn an_up_to_date_story_is_not_touched() {
    let workshop = BakeFixture::new();
    assert!(
        workshop.bake("1.0", &[]).status().unwrap().success(),
        "the first bake succeeds"
    );
    let voice = workshop.path("story/voice");
    let times = || {
        let mut times: Vec<_> = fs::read_dir(&voice)
            .unwrap()
            .map(|e| e.unwrap())
            .map(|e| (e.file_name(), e.metadata().unwrap().modified().unwrap()))
            .collect();
        times.push((
            ".".into(),
            fs::metadata(&voice).unwrap().modified().unwrap(),
        ));
        times
    };
    let before = times();
    assert!(
        workshop.bake("1.0", &[]).status().unwrap().success(),
        "the bake of an up-to-date story succeeds"
    );
    assert_eq!(times(), before);
    // A story that falls silent loses its bundle.
    workshop.write_story("<null time='1'/>");
    assert!(
        workshop.bake("1.0", &[]).status().unwrap().success(),
        "the bake without utterances succeeds"
    );
    assert!(!voice.exists(), "the unused voice folder is removed");
}

#[test]
fn many_wrong_sounds_are_thinned_as_other_problems_are() {
    let workshop = BakeFixture::new();
    let mut clauses = String::new();
    for i in 1..=30 {
        wave(&workshop.path(&format!("takes/{i:02}.wav")), 20 + i);
        if i > UTTERANCES as i16 {
            let grid = workshop.path("takes/01.TextGrid");
            fs::copy(grid, workshop.path(&format!("takes/{i:02}.TextGrid"))).unwrap();
        }
        let text = format!("Me too {}", "x".repeat(i as usize));
        clauses += &format!("<voice-text time='{i}'>{text}</voice-text>");
    }
    workshop.write_story(&clauses);
    let out = workshop.bake("1.0", &[]).output().unwrap();
    assert!(out.status.success(), "{}", stderr_of(&out));
    for name in workshop.names() {
        if name.ends_with(".opus") {
            fs::remove_file(workshop.path("story/voice").join(name)).unwrap();
        }
    }
    let out = workshop.command(&["check", "story"]).output().unwrap();
    let told = stderr_of(&out);
    assert_eq!(
        told.matches("error[voice::wrong-sound]").count(),
        20,
        "{told}"
    );
    assert!(
        told.contains("eml::more") && !out.status.success(),
        "{told}"
    );
}
