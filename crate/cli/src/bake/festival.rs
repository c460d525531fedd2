//! Asks Festival to speak.

use std::fs;
use std::path::Path;

use anyhow::{Context as _, Result, bail, ensure};

use super::plan::Plan;
use super::program::Program;
use super::scheme;

const FESTIVAL: Program = Program {
    name: "festival",
    package: "festival festvox-us-slt-hts",
};

/// How much later than its labels an HTS voice sounds, seconds. *Measured* on 140 s of
/// cmu_us_slt_arctic_hts: against the labels, vowels end 13 ms late before stops (90 of
/// them) and begin 7 ms late after (74), sibilants begin 17 ms late (33) and end on time
/// (44), each at the middle of the change in level or brightness. Half an analysis window
/// of 25 ms would explain it.
const HTS_LAG_SECS: f64 = 0.009;

/// One phone as the engine timed it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Segment {
    /// Phone symbol; `pau` is silence.
    pub(crate) symbol: String,
    /// Seconds from the start of the sentence.
    pub(crate) end_secs: f64,
    /// Index of its word.
    pub(crate) word: Option<usize>,
}

/// One sentence as the engine spoke it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Spoken {
    /// Mono, -1 to 1.
    pub(crate) samples: Vec<f64>,
    /// Samples a second.
    pub(crate) rate_hz: u32,
    /// In order; the first begins at 0.
    pub(crate) segments: Vec<Segment>,
}

/// Festival's version, for example `2.5.0`.
///
/// # Errors
/// When Festival is not installed.
pub(crate) fn version() -> Result<String> {
    let mut command = FESTIVAL.command();
    command.arg("--version");
    let said = FESTIVAL.run(command)?;
    Ok(said
        .split(|c: char| c.is_whitespace() || c == ':')
        .find(|w| w.starts_with(|c: char| c.is_ascii_digit()))
        .unwrap_or("unknown")
        .to_owned())
}

/// Speaks the sentences of a plan.
///
/// # Errors
/// When Festival or the voice is not installed, or when what comes back makes no sense.
pub(crate) fn speak(plan: &Plan, voice: &str, rate: f64) -> Result<Vec<Spoken>> {
    if plan.sentences.is_empty() {
        return Ok(Vec::new());
    }
    let folder = tempfile::tempdir().context("making a folder for the engine")?;
    fs::write(
        folder.path().join("say.scm"),
        scheme::script(&plan.sentences, voice, rate),
    )?;
    let mut command = FESTIVAL.command();
    // A home without settings: a bake does not depend on who runs it.
    command
        .args(["-b", "say.scm"])
        .current_dir(folder.path())
        .env("HOME", folder.path());
    let said = FESTIVAL.run(command).map_err(|error| {
        if format!("{error:#}").contains("unbound variable") {
            error.context(format!(
                "Festival has no voice {voice}; on Debian and Ubuntu the usual one comes with: apt-get install festvox-us-slt-hts"
            ))
        } else {
            error
        }
    })?;
    let sentences = segments(&said, plan.words.len())?;
    ensure!(
        sentences.len() == plan.sentences.len(),
        "Festival spoke {} of {} sentences",
        sentences.len(),
        plan.sentences.len()
    );
    sentences
        .into_iter()
        .enumerate()
        .map(|(i, segments)| {
            let (samples, rate_hz) = samples(&folder.path().join(scheme::wave_name(i)))?;
            let lag_secs = if voice.ends_with("_hts") {
                HTS_LAG_SECS
            } else {
                0.0
            };
            Ok(Spoken {
                samples,
                rate_hz,
                segments: delayed(segments, lag_secs),
            })
        })
        .collect()
}

/// Moves the ends of phones to where they are heard; the end of the sentence stays.
fn delayed(mut segments: Vec<Segment>, lag_secs: f64) -> Vec<Segment> {
    let end_secs = segments.last().map_or(0.0, |s| s.end_secs);
    for segment in &mut segments {
        segment.end_secs = (segment.end_secs + lag_secs).min(end_secs);
    }
    segments
}

/// Reads the segments that the script prints, sentence by sentence.
fn segments(said: &str, words: usize) -> Result<Vec<Vec<Segment>>> {
    let mut sentences: Vec<Vec<Segment>> = Vec::new();
    for line in said.lines() {
        let fields: Vec<&str> = line.split_whitespace().collect();
        match fields.as_slice() {
            ["sentence", ..] => sentences.push(Vec::new()),
            ["segment", symbol, end, word] => {
                let sentence = sentences
                    .last_mut()
                    .context("a segment outside a sentence")?;
                let end_secs: f64 = end.parse().with_context(|| format!("the time {end:?}"))?;
                let begin_secs = sentence.last().map_or(0.0, |s| s.end_secs);
                ensure!(
                    end_secs.is_finite() && end_secs >= begin_secs,
                    "the phone {symbol} ends at {end} s, before it begins"
                );
                let word: usize = word
                    .parse()
                    .with_context(|| format!("the word number {word:?}"))?;
                ensure!(
                    word <= words,
                    "the phone {symbol} belongs to word {word} of {words}"
                );
                sentence.push(Segment {
                    symbol: (*symbol).to_owned(),
                    end_secs,
                    word: word.checked_sub(1),
                });
            }
            // Voices may chat while they load.
            _ => {}
        }
    }
    if let Some(i) = sentences.iter().position(Vec::is_empty) {
        bail!("Festival found nothing to say in sentence {i}");
    }
    Ok(sentences)
}

fn samples(path: &Path) -> Result<(Vec<f64>, u32)> {
    let mut reader = hound::WavReader::open(path)
        .with_context(|| format!("reading the sound {}", path.display()))?;
    let spec = reader.spec();
    ensure!(
        spec.channels == 1 && spec.bits_per_sample == 16,
        "Festival wrote sound with {} channels of {} bits",
        spec.channels,
        spec.bits_per_sample
    );
    let samples = reader
        .samples::<i16>()
        .map(|s| s.map(|s| f64::from(s) / 32768.0))
        .collect::<Result<_, _>>()
        .context("reading the engine's sound")?;
    Ok((samples, spec.sample_rate))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What Festival 2.5.0 printed for "Hello" and "It's 25." with the voice
    /// cmu_us_slt_arctic_hts.
    const SAID: &str = include_str!("festival_sample.txt");

    #[test]
    fn phones_find_their_words_even_when_one_token_is_several_words() {
        let sentences = segments(SAID, 3).unwrap();
        assert_eq!(sentences.len(), 2);
        let spelled = |i: usize, word| -> Vec<&str> {
            sentences[i]
                .iter()
                .filter(|s| s.word == word)
                .map(|s| s.symbol.as_str())
                .collect()
        };
        assert_eq!(spelled(0, Some(0)), ["hh", "ax", "l", "ow"]);
        assert_eq!(spelled(0, None), ["pau", "pau"]);
        assert_eq!(spelled(1, Some(1)), ["ih", "t", "s"]);
        assert_eq!(
            spelled(1, Some(2)),
            ["t", "w", "eh", "n", "t", "iy", "f", "ay", "v"]
        );
        assert!((sentences[0].last().unwrap().end_secs - 0.7).abs() < 1e-9);
    }

    #[test]
    fn a_lag_moves_all_ends_but_the_last() {
        let ends = |lag_secs| -> Vec<f64> {
            let sentence = segments(SAID, 3).unwrap().swap_remove(0);
            delayed(sentence, lag_secs)
                .iter()
                .map(|s| (s.end_secs * 1e3).round())
                .collect()
        };
        assert_eq!(ends(0.0), [165.0, 255.0, 285.0, 340.0, 515.0, 700.0]);
        assert_eq!(ends(0.009), [174.0, 264.0, 294.0, 349.0, 524.0, 700.0]);
    }

    #[test]
    fn nonsense_from_the_engine_is_an_error() {
        for bad in [
            "segment pau 0.1 0",
            "sentence 0.wav\nsegment pau nan 0",
            "sentence 0.wav\nsegment pau 0.2 0\nsegment ax 0.1 0",
            "sentence 0.wav\nsegment pau 0.2 9",
            "sentence 0.wav\nsegment pau 0.2 x",
            "sentence 0.wav\nsentence 1.wav\nsegment pau 0.2 0",
        ] {
            assert!(segments(bad, 3).is_err(), "{bad}");
        }
        assert!(segments("loading voice\n", 3).unwrap().is_empty());
    }
}
