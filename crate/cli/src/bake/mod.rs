//! Bakes speech: turns what a story says into a bundle of sound, words and phones, with
//! the Festival engine, ahead of any performance.
//!
//! `contents → plan (sentences and pauses) → Festival → emphasis → one sound with times →
//! Ogg Opus and MP3 → speech.json`. Every step but Festival and the two encoders is a
//! function over plain data. The same story gives the same bundle, byte for byte, with the
//! same programs installed.

mod assemble;
mod bundle_text;
mod emphasis;
mod encode;
mod festival;
mod plan;
pub(crate) mod program;
mod scheme;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use anyhow::{Context as _, Result, ensure};
use raconteur_player::speech::{AudioFile, Bundle, Content, Utterance, bundle};

/// Goes into [`Bundle::engine`]; raise it when the sound or the times of the same text
/// change, so that every story is baked afresh.
const REVISION: u32 = 1;

/// How to bake.
#[derive(Clone, Debug)]
pub(crate) struct BakeOptions {
    /// The voice, as Festival's `voice_…` functions call it: letters, digits and `_`.
    pub(crate) voice: String,
    /// Speaking rate against the voice's own; 1 leaves it. Only HTS voices listen.
    pub(crate) rate: f64,
}

impl Default for BakeOptions {
    /// The female HTS voice, slowed to a storyteller's 150 to 170 words a minute.
    fn default() -> Self {
        Self {
            voice: "cmu_us_slt_arctic_hts".to_owned(),
            rate: 0.88,
        }
    }
}

/// What [`bake`] did.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct BakeReport {
    /// Utterances in the bundle; two that say the same count once.
    pub(crate) utterances: usize,
    /// How many of them were spoken anew; the others were up to date.
    pub(crate) synthesised: usize,
    /// Sound files of earlier bakes that nothing uses any more and that were removed.
    pub(crate) removed: usize,
    /// All utterances together, seconds.
    pub(crate) duration_secs: f64,
    /// Bytes of Ogg Opus.
    pub(crate) opus_bytes: u64,
    /// Bytes of MP3.
    pub(crate) mp3_bytes: u64,
}

/// Makes or refreshes the bundle in `out_dir` so that it holds all of `contents`.
/// `progress` hears how many utterances are done, of how many, and what is said next.
///
/// # Errors
/// When a program is missing (the message names its Debian package), when it fails, or
/// when the folder cannot be written.
pub(crate) fn bake(
    contents: &[Content],
    out_dir: &Path,
    options: &BakeOptions,
    progress: &dyn Fn(usize, usize, &str),
) -> Result<BakeReport> {
    ensure!(
        scheme::is_symbol(&options.voice),
        "{:?} is not the name of a voice",
        options.voice
    );
    ensure!(
        (0.5..=2.0).contains(&options.rate),
        "a speaking rate of {} is outside 0.5 to 2",
        options.rate
    );
    fs::create_dir_all(out_dir).with_context(|| format!("making {}", out_dir.display()))?;
    let engine = format!(
        "festival {}, rate {}, raconteur bake {REVISION}",
        festival::version()?,
        options.rate
    );
    let mut kept = reusable(out_dir, &options.voice, &engine);

    // Two clauses that say the same share an utterance; the first keeps its place.
    let mut seen = BTreeSet::new();
    let mut wanted: Vec<(String, &Content)> = Vec::new();
    for content in contents {
        let key = content.key();
        if seen.insert(key.clone()) {
            wanted.push((key, content));
        }
    }

    let mut report = BakeReport {
        utterances: wanted.len(),
        ..BakeReport::default()
    };
    let mut utterances = Vec::with_capacity(wanted.len());
    for (done, (key, content)) in wanted.iter().enumerate() {
        let text = content.words().join(" ");
        progress(done, wanted.len(), &text);
        let utterance = match kept.remove(key) {
            Some(utterance) => utterance,
            None => {
                report.synthesised += 1;
                speak(key, &text, content, out_dir, options)
                    .with_context(|| format!("speaking {text:?}"))?
            }
        };
        report.duration_secs += utterance.duration_secs;
        utterances.push(utterance);
    }
    progress(wanted.len(), wanted.len(), "");

    let bundle = Bundle {
        format: "raconteur-speech".to_owned(),
        version: bundle::VERSION,
        language: "en-US".to_owned(),
        phone_set: "radio".to_owned(),
        voice: options.voice.clone(),
        engine,
        utterances,
    };
    let path = out_dir.join("speech.json");
    let text = bundle_text::write(&bundle)?;
    // An up-to-date file is left alone, so that bakes do not disturb build tools.
    if fs::read(&path).ok().as_deref() != Some(text.as_bytes()) {
        fs::write(&path, text).with_context(|| format!("writing {}", path.display()))?;
    }
    report.removed = remove_unused(out_dir, &bundle)?;
    for audio in bundle.utterances.iter().flat_map(|u| &u.audio) {
        let bytes = fs::metadata(out_dir.join(&audio.file))?.len();
        match audio.mime.as_str() {
            "audio/mpeg" => report.mp3_bytes += bytes,
            _ => report.opus_bytes += bytes,
        }
    }
    Ok(report)
}

/// The utterances of an earlier bake that still hold: same voice, same engine, and their
/// sound is there.
fn reusable(out_dir: &Path, voice: &str, engine: &str) -> BTreeMap<String, Utterance> {
    let Ok(json) = fs::read(out_dir.join("speech.json")) else {
        return BTreeMap::new();
    };
    match Bundle::from_json(&json) {
        Ok(old) if old.voice == voice && old.engine == engine => old
            .utterances
            .into_iter()
            .filter(|u| {
                !u.audio.is_empty() && u.audio.iter().all(|a| out_dir.join(&a.file).is_file())
            })
            .map(|u| (u.key.clone(), u))
            .collect(),
        // Unreadable or made differently: everything is baked again.
        _ => BTreeMap::new(),
    }
}

/// Speaks one utterance and writes its sound.
fn speak(
    key: &str,
    text: &str,
    content: &Content,
    out_dir: &Path,
    options: &BakeOptions,
) -> Result<Utterance> {
    let plan = plan::plan(content)?;
    let spoken = festival::speak(&plan, &options.voice, options.rate)?;
    let track = assemble::assemble(&plan, spoken)?;
    let audio = encode::encode(&track.samples, track.rate_hz, key, out_dir)?
        .into_iter()
        .map(|(file, mime)| AudioFile {
            file,
            mime: mime.to_owned(),
        })
        .collect();
    Ok(Utterance {
        key: key.to_owned(),
        text: text.to_owned(),
        duration_secs: track.duration_secs,
        audio,
        words: track.words,
        phones: track.phones,
    })
}

/// Removes sound files that a bake made and that the bundle no longer names. Only names
/// that a bake gives (a key and a known ending) are touched.
fn remove_unused(out_dir: &Path, bundle: &Bundle) -> Result<usize> {
    let mut removed = 0;
    for entry in fs::read_dir(out_dir)? {
        let entry = entry?;
        let name = entry.file_name();
        let Some(name) = name.to_str() else { continue };
        let ours = name.split_once('.').is_some_and(|(stem, ending)| {
            stem.len() == 16
                && stem.bytes().all(|b| b.is_ascii_hexdigit())
                && encode::ENDINGS.contains(&ending)
        });
        let used = bundle
            .utterances
            .iter()
            .flat_map(|u| &u.audio)
            .any(|a| a.file == name);
        if ours && !used {
            fs::remove_file(entry.path())
                .with_context(|| format!("removing {}", entry.path().display()))?;
            removed += 1;
        }
    }
    Ok(removed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options() -> BakeOptions {
        BakeOptions::default()
    }

    #[test]
    fn a_voice_or_rate_that_cannot_be_is_refused_before_anything_runs() {
        let dir = tempfile::tempdir().unwrap();
        let quiet = |_: usize, _: usize, _: &str| {};
        let voice = BakeOptions {
            voice: "x) (quit".to_owned(),
            ..options()
        };
        assert!(bake(&[], dir.path(), &voice, &quiet).is_err());
        let rate = BakeOptions {
            rate: f64::NAN,
            ..options()
        };
        assert!(bake(&[], dir.path(), &rate, &quiet).is_err());
    }

    #[test]
    fn only_unused_files_that_a_bake_made_are_removed() {
        let dir = tempfile::tempdir().unwrap();
        for name in [
            "0123456789abcdef.opus",
            "00000000000000aa.mp3",
            "drum.mp3",
            "notes.txt",
        ] {
            fs::write(dir.path().join(name), "x").unwrap();
        }
        let mut bundle = Bundle {
            format: String::new(),
            version: 1,
            language: String::new(),
            phone_set: String::new(),
            voice: String::new(),
            engine: String::new(),
            utterances: vec![Utterance {
                key: "00000000000000aa".to_owned(),
                text: String::new(),
                duration_secs: 0.0,
                audio: Vec::new(),
                words: Vec::new(),
                phones: Vec::new(),
            }],
        };
        bundle.utterances[0].audio.push(AudioFile {
            file: "00000000000000aa.mp3".to_owned(),
            mime: String::new(),
        });
        assert_eq!(remove_unused(dir.path(), &bundle).unwrap(), 1);
        assert!(!dir.path().join("0123456789abcdef.opus").exists());
        assert!(dir.path().join("00000000000000aa.mp3").exists());
        assert!(dir.path().join("drum.mp3").exists());
    }

    #[test]
    fn utterances_are_reused_only_from_the_same_voice_and_engine_with_their_sound() {
        let dir = tempfile::tempdir().unwrap();
        let bundle = Bundle {
            format: "raconteur-speech".to_owned(),
            version: 1,
            language: "en-US".to_owned(),
            phone_set: "radio".to_owned(),
            voice: "v".to_owned(),
            engine: "e".to_owned(),
            utterances: vec![Utterance {
                key: "k".to_owned(),
                text: String::new(),
                duration_secs: 0.0,
                audio: vec![AudioFile {
                    file: "k.opus".to_owned(),
                    mime: "a".to_owned(),
                }],
                words: Vec::new(),
                phones: Vec::new(),
            }],
        };
        fs::write(
            dir.path().join("speech.json"),
            bundle_text::write(&bundle).unwrap(),
        )
        .unwrap();
        assert!(
            reusable(dir.path(), "v", "e").is_empty(),
            "its sound is missing"
        );
        fs::write(dir.path().join("k.opus"), "x").unwrap();
        assert_eq!(reusable(dir.path(), "v", "e").len(), 1);
        assert!(reusable(dir.path(), "v", "other").is_empty());
        assert!(reusable(dir.path(), "other", "e").is_empty());
    }
}
