//! A story with recordings, and programs that replace the encoders.

use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

use serde_json::Value;
use sha2::{Digest as _, Sha256};

/// Number of utterances in the story.
pub(crate) const UTTERANCES: usize = 4;

/// Fake encoder: logs its start, waits for `WAIT` and until there is no file `GATE`, and copies its
/// input with a tag.
const OPUSENC: &str = r#"#!/bin/sh
echo "opusenc $*" >> "$LOG"
sleep "$WAIT"
while [ -e "$GATE" ]; do sleep 0.01; done
while [ $# -gt 2 ]; do shift; done
cat "$1" > "$2"
printf %s "$TAG" >> "$2"
"#;

const FFMPEG: &str = r#"#!/bin/sh
echo "ffmpeg $*" >> "$LOG"
sleep "$WAIT"
while [ $# -gt 1 ]; do [ "$1" = -i ] && in="${2#file:}"; shift; done
cat "$in" > "$1"
case "$1" in *.mp3) printf %s "$TAG" >> "$1";; esac
"#;

const GRID: &str = "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n0\n0.5\n<exists>\n2\n\
    \"IntervalTier\"\n\"words\"\n0\n0.5\n3\n0\n0.1\n\"\"\n0.1\n0.3\n\"me\"\n0.3\n0.5\n\"too\"\n\
    \"IntervalTier\"\n\"phones\"\n0\n0.5\n5\n0\n0.1\n\"sil\"\n0.1\n0.2\n\"M\"\n0.2\n0.3\n\"IY1\"\n0.3\n0.4\n\"T\"\n0.4\n0.5\n\"UW1\"\n";

/// A folder with everything in it.
pub(crate) struct BakeFixture {
    folder: tempfile::TempDir,
}

/// Half a second of sound.
pub(crate) fn wave(path: &Path, level: i16) {
    let spec = hound::WavSpec {
        channels: 1,
        sample_rate: 8_000,
        bits_per_sample: 16,
        sample_format: hound::SampleFormat::Int,
    };
    let mut writer = hound::WavWriter::create(path, spec).unwrap();
    // Each recording has its own pitch, because loudness is normalised.
    let period = level % 97 + 20;
    (0..4_000).for_each(|i| writer.write_sample(level * (i % period)).unwrap());
    writer.finalize().unwrap();
}

impl BakeFixture {
    pub(crate) fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        for inner in ["story", "takes", "bin", "tmp", "library"] {
            fs::create_dir(path.join(inner)).unwrap();
        }
        for (name, script) in [("opusenc", OPUSENC), ("ffmpeg", FFMPEG)] {
            let program = path.join("bin").join(name);
            fs::write(&program, script).unwrap();
            fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
        }
        let mut clauses = String::new();
        for i in 1..=UTTERANCES {
            wave(&path.join(format!("takes/{i:02}.wav")), 20 * i as i16);
            fs::write(path.join(format!("takes/{i:02}.TextGrid")), GRID).unwrap();
            clauses += &format!(
                "<voice-text time='{i}'>Me too {}</voice-text>",
                "x".repeat(i)
            );
        }
        let workshop = Self { folder };
        workshop.write_story(&clauses);
        workshop
    }

    pub(crate) fn path(&self, inner: &str) -> PathBuf {
        self.folder.path().join(inner)
    }

    /// Writes the story.
    pub(crate) fn write_story(&self, clauses: &str) {
        let text = format!("<eml><body>{clauses}</body></eml>");
        fs::write(self.path("story/story.eml"), text).unwrap();
    }

    /// Returns a command of the program with only the encoders and the scripts' tools on its path.
    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_raconteur"));
        let path = format!("{}:/usr/bin:/bin", self.path("bin").display());
        // The test does not depend on an installed natural voice.
        command
            .args(["--assets", "library"])
            .args(arguments)
            .env("PATH", path)
            .env("TMPDIR", self.path("tmp"))
            .env("LOG", self.path("log"))
            .env("WAIT", "0")
            .env("GATE", self.path("gate"))
            .env("TAG", "")
            .current_dir(self.folder.path())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        command
    }

    /// `bake` of the story with its recordings at a pace, which its encoders write down.
    pub(crate) fn bake(&self, pace: &str, more: &[&str]) -> Command {
        let usual = [
            "bake",
            "story",
            "--engine",
            "recordings",
            "--recordings",
            "takes",
        ];
        let mut command =
            self.command(&[&usual[..], &["--pace", pace, "--jobs", "1"][..], more].concat());
        command.env("TAG", pace);
        command
    }

    /// Returns the number of encoder starts.
    pub(crate) fn encoder_starts(&self) -> usize {
        let log = fs::read_to_string(self.path("log")).unwrap_or_default();
        log.lines().count()
    }

    /// Waits until an encoder has begun so often, or the program has ended.
    pub(crate) fn until_begun(&self, count: usize, child: &mut Child) {
        while self.encoder_starts() < count && child.try_wait().unwrap().is_none() {
            std::thread::sleep(std::time::Duration::from_millis(2));
        }
    }

    /// The pace that all of the bundle was baked at; fails when it is not whole.
    pub(crate) fn pace_of_bundle(&self) -> String {
        let voice = self.path("story/voice");
        let text = fs::read(voice.join("speech.json")).unwrap();
        let bundle: Value = serde_json::from_slice(&text).unwrap();
        let utterances = bundle["utterances"].as_array().unwrap();
        assert_eq!(utterances.len(), UTTERANCES);
        let mut paces = Vec::new();
        for audio in utterances
            .iter()
            .flat_map(|u| u["audio"].as_array().unwrap())
        {
            let file = audio["file"].as_str().unwrap();
            let bytes = fs::read(voice.join(file)).unwrap();
            assert_eq!(audio["bytes"], bytes.len());
            let digits: String = Sha256::digest(&bytes)
                .iter()
                .map(|b| format!("{b:02x}"))
                .collect();
            assert_eq!(audio["sha256"], digits.as_str());
            assert!(file.starts_with(&digits[..32]), "{file}");
            let tag = String::from_utf8_lossy(&bytes[bytes.len() - 3..]).into_owned();
            paces.push(tag);
        }
        paces.dedup();
        assert_eq!(paces.len(), 1, "{paces:?}");
        paces.remove(0)
    }

    /// Returns true if `bake --check` accepts the bundle as that of a pace.
    pub(crate) fn is_up_to_date(&self, pace: &str) -> bool {
        let out = self.bake(pace, &["--check"]).output().unwrap();
        let told = String::from_utf8_lossy(&out.stdout).into_owned();
        assert_eq!(
            out.status.success(),
            told.contains(": up to date"),
            "{told}"
        );
        out.status.success()
    }

    /// The names in the bundle's folder.
    pub(crate) fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(self.path("story/voice"))
            .unwrap()
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }
}

/// Returns the standard error of a command.
pub(crate) fn stderr_of(out: &Output) -> String {
    String::from_utf8_lossy(&out.stderr).into_owned()
}
