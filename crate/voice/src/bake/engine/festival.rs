//! Festival 2: diphone, unit-selection and HTS voices of English.

use std::fs;

use crate::content::Gender;
use crate::spoken::{Sentence, Spoken};
use anyhow::{Context as _, Error, Result, bail, ensure};

use super::super::program::{MissingPrograms, Program};
use super::labels::{self, Labels, Phone};
use super::{Engine, VoiceInfo, scheme, wave};
use crate::ipa::Set;

const FESTIVAL: Program = Program {
    name: "festival",
    package: "festival festvox-us-slt-hts",
};

/// Delay of an HTS voice's audio relative to its labels, seconds. *Measured* on 140 s of
/// cmu_us_slt_arctic_hts: against the labels, vowels end 13 ms late before stops (90 of them) and
/// begin 7 ms late after (74), sibilants begin 17 ms late (33) and end on time (44), each at the
/// middle of the change in level or brightness. Half an analysis window of 25 ms would explain it.
const HTS_LAG_SECS: f64 = 0.009;

/// Delay of kal_diphone's audio relative to its labels, seconds. *Measured* on 64 s: vowels end 22
/// ms late before voiceless sounds (68 of them, median), and of 135 bursts of stops 125 lie within
/// 20 ms of their labels, 132 if those are 10 ms later. For ked_diphone no shift is better than
/// none (121 of 137).
const KAL_LAG_SECS: f64 = 0.010;

/// Speech engine based on Festival.
pub(super) struct Festival;

impl Engine for Festival {
    fn version(&self) -> Result<String> {
        let mut command = FESTIVAL.command();
        command.arg("--version");
        let said = FESTIVAL.run(command)?;
        let number = said
            .split(|c: char| c.is_whitespace() || c == ':')
            .find(|w| w.starts_with(|c: char| c.is_ascii_digit()))
            .unwrap_or("unknown");
        Ok(format!("festival {number}"))
    }

    fn voices(&self) -> Result<Vec<VoiceInfo>> {
        let folder = tempfile::tempdir().context("making a folder for the engine")?;
        let voices = voices(&run(scheme::VOICES, &folder)?);
        if voices.is_empty() {
            return Err(MissingPrograms::one("a voice of festival", "festvox-us-slt-hts").into());
        }
        Ok(voices)
    }

    fn speak(&self, voice: &str, sentences: &[Sentence]) -> Result<Vec<Spoken>> {
        ensure!(
            scheme::is_symbol(voice),
            "{voice:?} is not the name of a Festival voice"
        );
        if sentences.is_empty() {
            return Ok(Vec::new());
        }
        let set = if sentences
            .iter()
            .any(|s| s.tokens.iter().any(|t| t.ipa.is_some()))
        {
            ipa_set(voice)?
        } else {
            Set::Radio
        };
        // A sentence of dashes contains no speech; Festival would produce no audio for it.
        let heard: Vec<bool> = sentences
            .iter()
            .map(|s| {
                s.tokens
                    .iter()
                    .any(|t| t.ipa.is_some() || !scheme::plain(&t.text).is_empty())
            })
            .collect();
        let said: Vec<Sentence> = sentences
            .iter()
            .zip(&heard)
            .filter(|(_, heard)| **heard)
            .map(|(s, _)| s.clone())
            .collect();
        let mut spoken = speak(voice, &said, set)?.into_iter();
        let silence = spoken.as_slice().first().map_or_else(
            || (16_000.0, "radio".to_owned()),
            |s| (s.rate_hz, s.phone_set.clone()),
        );
        Ok(heard
            .into_iter()
            .filter_map(|heard| {
                if heard {
                    spoken.next()
                } else {
                    Some(labels::nothing(silence.0, &silence.1))
                }
            })
            .collect())
    }
}

/// Runs a script in a folder and returns what it prints.
fn run(script: &str, folder: &tempfile::TempDir) -> Result<String> {
    fs::write(folder.path().join("say.scm"), script)?;
    let mut command = FESTIVAL.command();
    // A home directory without settings makes a bake independent of the user.
    command
        .args(["-b", "say.scm"])
        .current_dir(folder.path())
        .env("HOME", folder.path());
    FESTIVAL.run(command)
}

/// Explains an error of a script that loads a voice.
fn explained(error: Error, voice: &str) -> Error {
    if format!("{error:#}").contains("unbound variable") {
        error.context(format!(
            "Festival has no voice {voice}; on Debian and Ubuntu the usual one comes with: apt-get install festvox-us-slt-hts"
        ))
    } else {
        error
    }
}

/// Returns the phone set of a voice.
fn ipa_set(voice: &str) -> Result<Set> {
    let folder = tempfile::tempdir().context("making a folder for the engine")?;
    let script = format!("(voice_{voice})\n(format t \"phones %l\\n\" (Param.get 'PhoneSet))\n");
    let said = run(&script, &folder).map_err(|e| explained(e, voice))?;
    let name = said
        .lines()
        .find_map(|l| l.strip_prefix("phones "))
        .context("Festival does not report the voice's phones")?;
    match phone_set(name)? {
        "mrpa" => Ok(Set::Mrpa),
        _ => Ok(Set::Radio),
    }
}

/// Returns the bundle's name of a Festival phone set.
fn phone_set(name: &str) -> Result<&'static str> {
    match name.trim_matches('"') {
        "radio" => Ok("radio"),
        "mrpa" => Ok("mrpa"),
        other => bail!("its phones are of the set {other:?}; known are radio and mrpa"),
    }
}

fn speak(voice: &str, sentences: &[Sentence], set: Set) -> Result<Vec<Spoken>> {
    if sentences.is_empty() {
        return Ok(Vec::new());
    }
    let folder = tempfile::tempdir().context("making a folder for the engine")?;
    let script = scheme::script(sentences, voice, set)?;
    let said = run(&script, &folder).map_err(|e| explained(e, voice))?;
    let told = read(&said)?;
    ensure!(
        told.len() == sentences.len(),
        "Festival spoke {} of {} sentences",
        told.len(),
        sentences.len()
    );
    let lag_secs = match voice {
        "kal_diphone" => KAL_LAG_SECS,
        hts if hts.ends_with("_hts") => HTS_LAG_SECS,
        _ => 0.0,
    };
    told.iter()
        .enumerate()
        .map(|(i, (phone_set, labels))| {
            let last = sentences[i].tokens.len();
            ensure!(
                labels
                    .phones
                    .iter()
                    .all(|p| p.token.is_none_or(|t| t < last))
                    && labels.breaks.iter().all(|b| b.0 < last),
                "Festival reports more than {last} tokens"
            );
            let wave = wave::read(&folder.path().join(scheme::wave_name(i)))?;
            labels::finish(labels, wave, phone_set, lag_secs)
        })
        .collect()
}

/// Parses the script's output: the phone set and the labels of each sentence.
fn read(said: &str) -> Result<Vec<(&'static str, Labels)>> {
    let mut sentences: Vec<(&'static str, Labels)> = Vec::new();
    for line in said.lines() {
        let fields: Vec<&str> = line.split_whitespace().collect();
        match fields.as_slice() {
            ["sentence", _, phones] => sentences.push((phone_set(phones)?, Labels::default())),
            ["segment", symbol, end, token, before, stress, accent] => {
                let (_, labels) = sentences
                    .last_mut()
                    .context("a segment outside a sentence")?;
                let end_secs: f64 = end.parse().with_context(|| format!("the time {end:?}"))?;
                let token = number(token)?.checked_sub(1);
                if token.is_some() && *before == "0" {
                    let stress = u8::from(*stress == "1");
                    let accent = match *accent {
                        "NONE" | "0" => "",
                        tobi if tobi.contains('*') => tobi,
                        _ => "*",
                    };
                    labels.syllables.push((stress, accent.to_owned()));
                }
                labels.phones.push(Phone {
                    symbol: (*symbol).to_owned(),
                    end_secs,
                    token,
                    syllable: token.and(labels.syllables.len().checked_sub(1)),
                });
            }
            ["break", token, tone] => {
                let (_, labels) = sentences.last_mut().context("a break outside a sentence")?;
                let token = number(token)?
                    .checked_sub(1)
                    .context("a break before words")?;
                let tone = if *tone == "NONE" { "" } else { tone };
                labels.breaks.push((token, tone.to_owned()));
            }
            // Voices may chat while they load.
            _ => {}
        }
    }
    if let Some(i) = sentences.iter().position(|(_, l)| l.phones.is_empty()) {
        bail!("Festival found no speech in sentence {i}");
    }
    Ok(sentences)
}

fn number(field: &str) -> Result<usize> {
    field
        .parse()
        .with_context(|| format!("the number of a token, {field:?}"))
}

fn voices(said: &str) -> Vec<VoiceInfo> {
    let mut out: Vec<VoiceInfo> = said
        .lines()
        .filter_map(|line| {
            let fields: Vec<&str> = line.split_whitespace().collect();
            let ["voice", name, about @ ..] = fields.as_slice() else {
                return None;
            };
            let about: Vec<&str> = about.iter().map(|a| a.trim_matches('"')).collect();
            let has = |word: &str| about.contains(&word);
            let (language, phone_set) = match (has("english"), has("british"), has("scottish")) {
                (true, true, _) | (true, _, true) => ("en-GB", "mrpa"),
                (true, ..) => ("en-US", "radio"),
                // Voices of other languages have phones that no set here knows.
                _ => return None,
            };
            let (rate_hz, what) = if name.ends_with("_hts") {
                (0.0, "hidden Markov models")
            } else if name.ends_with("_diphone") || name.ends_with("_mbrola") {
                (0.0, "diphones")
            } else if name.ends_with("_cg") {
                (0.0, "statistical, from clusters")
            } else {
                (0.0, "units of recorded speech")
            };
            Some(VoiceInfo {
                name: (*name).to_owned(),
                language: language.to_owned(),
                gender: match (has("female"), has("male")) {
                    (true, _) => Some(Gender::Female),
                    (_, true) => Some(Gender::Male),
                    _ => None,
                },
                phone_set: phone_set.to_owned(),
                rate_hz,
                what: what.to_owned(),
            })
        })
        .collect();
    out.sort_by(|a, b| a.name.cmp(&b.name));
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Output of Festival 2.5.0 for "Hello" and "It's 25." with the voice cmu_us_slt_arctic_hts.
    const SAID: &str = include_str!("festival_sample.txt");

    #[test]
    fn phones_find_their_tokens_even_when_one_token_is_several_words() {
        let sentences = read(SAID).unwrap();
        assert_eq!(sentences.len(), 2);
        let spelled = |i: usize, token| -> Vec<&str> {
            let (set, labels) = &sentences[i];
            assert_eq!(*set, "radio");
            let of = labels.phones.iter().filter(|p| p.token == token);
            of.map(|p| p.symbol.as_str()).collect()
        };
        assert_eq!(spelled(0, Some(0)), ["hh", "ax", "l", "ow"]);
        assert_eq!(spelled(0, None), ["pau", "pau"]);
        assert_eq!(spelled(1, Some(0)), ["ih", "t", "s"]);
        assert_eq!(
            spelled(1, Some(1)),
            ["t", "w", "eh", "n", "t", "iy", "f", "ay", "v"]
        );
    }

    #[test]
    fn syllables_accents_and_phrases_are_read() {
        let (_, labels) = read(SAID).unwrap().swap_remove(1);
        let syllables: Vec<(u8, &str)> = labels
            .syllables
            .iter()
            .map(|(s, a)| (*s, a.as_str()))
            .collect();
        assert_eq!(syllables, [(1, "H*"), (1, "H*"), (0, ""), (1, "")]);
        let of: Vec<Option<usize>> = labels.phones.iter().map(|p| p.syllable).collect();
        let expected = [0, 0, 0, 1, 1, 1, 1, 2, 2, 3, 3, 3].map(Some);
        assert_eq!(of[1..13], expected);
        assert_eq!((of[0], of[13]), (None, None));
        assert_eq!(labels.breaks, [(1, "L-L%".to_owned())]);
    }

    #[test]
    fn nonsense_from_the_engine_is_an_error() {
        for bad in [
            "segment pau 0.1 0 0 0 NONE",
            "sentence 0.wav \"radio\"\nsegment pau x 0 0 0 NONE",
            "sentence 0.wav \"radio\"\nsegment pau 0.2 x 0 0 NONE",
            "sentence 0.wav \"radio\"\nsegment pau 0.2 -1 0 0 NONE",
            "sentence 0.wav \"radio\"\nsentence 1.wav \"radio\"\nsegment pau 0.2 0 0 0 NONE",
            "sentence 0.wav \"holmes\"\nsegment pau 0.2 0 0 0 NONE",
            "break 1 NONE",
            "sentence 0.wav \"radio\"\nsegment pau 0.2 0 0 0 NONE\nbreak 0 NONE",
        ] {
            assert!(read(bad).is_err(), "{bad}");
        }
        assert!(
            read("loading voice\n").unwrap().is_empty(),
            "a log without phones has no segments"
        );
    }

    #[test]
    fn voices_tell_where_they_come_from() {
        let said = "voice kal_diphone \"english\" \"american\" \"male\"\n\
            Please wait\n\
            voice el_diphone \"spanish\" \"castilian\" \"male\"\n\
            voice a_hts \"english\" \"british\" \"female\"\n";
        let told: Vec<_> = voices(said)
            .into_iter()
            .map(|v| (v.name, v.language, v.gender, v.phone_set))
            .collect();
        let expected = [
            ("a_hts", "en-GB", Some(Gender::Female), "mrpa"),
            ("kal_diphone", "en-US", Some(Gender::Male), "radio"),
        ]
        .map(|(n, l, g, p)| (n.to_owned(), l.to_owned(), g, p.to_owned()));
        assert_eq!(told, expected);
    }

    #[test]
    fn a_name_that_is_no_symbol_never_reaches_a_script() {
        for name in ["x) (quit", "", "a b", "\""] {
            assert!(Festival.speak(name, &[]).is_err(), "{name}");
        }
    }
}
