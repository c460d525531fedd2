//! Kokoro: a neural network that speaks phones (82 million parameters, of the family of StyleTTS 2,
//! doi:10.48550/arXiv.2306.07691).
//!
//! Its input is letters of its own alphabet, which is the IPA with one letter for each diphthong
//! and affricate; its output includes the number of decoder frames of each letter. The words'
//! letters are from its authors' training dictionaries; missing words are guessed.

mod letters;
mod words;

use std::ops::Range;

use anyhow::{Context as _, Result, ensure};

use super::labels::{self, Labels, Phone};
use super::wave::Wave;
use super::{Engine, VoiceInfo, punctuation};
use crate::borders;
use crate::content::Gender;
use crate::ipa::Set;
use crate::spoken::{Segment, Sentence, Spoken, SpokenSyllable};

/// Samples a second.
const RATE_HZ: f64 = 24_000.0;
/// Lead of the audio over the frames, seconds. *Measured* on its audio: see `docs/voices.md`.
const LEAD_SECS: f64 = 0.085;
/// Speech rate factor: its voices are faster than others at a rate of 1. *Measured* on stories: 230
/// words a minute instead of about 200 between pauses.
const OWN_PACE: f64 = 0.95;
/// Strength of emotions in the voice. A recorded voice is already lively, and sounds less natural
/// the more it is changed. *Measured* by DNSMOS P.808 on three sentences: 4.15 plain, 3.9, 3.8 and
/// 3.4 in joy, anger and surprise as in F&H.
const FEELING: f64 = 0.4;
/// Duration above which a punctuation mark counts as a pause, seconds. *Designed*.
const PAUSE_SECS: f64 = 0.04;
/// Maximum number of letters per inference; the network accepts 510.
const MAX_LETTERS: usize = 400;

/// Environment that runs Kokoro: provides its voices, dictionaries and neural network.
pub trait Host: Send + Sync {
    /// Returns the names of the available voices: `af_heart` is an American woman, `bm_george` a
    /// British man.
    ///
    /// # Errors
    /// Returns an error if Kokoro is not available.
    fn voices(&self) -> Result<Vec<String>>;

    /// Returns the phone letters of a word in the dictionaries, and those at the end of a phrase if
    /// they differ; `None` for an unknown word.
    ///
    /// # Errors
    /// Returns [`super::Pending`] while the dictionaries are being fetched.
    fn word(&self, word: &str) -> Result<Option<(String, Option<String>)>>;

    /// Returns the IPA transcription of the words of a text by espeak-ng, in one of its languages.
    ///
    /// # Errors
    /// Returns an error if espeak-ng is not available.
    fn ipa(&self, language: &str, text: &str) -> Result<String>;

    /// Phones of the set `radio` for a word that no dictionary has, with spaces between.
    ///
    /// # Errors
    /// Returns [`super::Pending`] while the guesser is being fetched.
    fn guess(&self, word: &str) -> Result<String>;

    /// Speaks letters at a speech rate, 1 for the voice's own.
    ///
    /// # Errors
    /// Returns [`super::Pending`] while the network is running.
    fn infer(&self, voice: &str, letters: &str, pace: f64) -> Result<Output>;
}

/// Output of the Kokoro network for one text: speech and the durations of its letters.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Output {
    /// Mono, −1 to 1, 24 kHz.
    pub samples: Vec<f32>,
    /// Duration of each letter, and of the padding before and after them, in any unit.
    pub frames: Vec<f32>,
}

/// Speech engine based on the Kokoro neural network, run by a host.
pub struct Kokoro<H>(pub H);

impl<H: Host> Engine for Kokoro<H> {
    fn version(&self) -> Result<String> {
        Ok("kokoro 82M".to_owned())
    }

    fn voices(&self) -> Result<Vec<VoiceInfo>> {
        Ok(self.0.voices()?.iter().filter_map(|v| info(v)).collect())
    }

    fn keeps_pace(&self) -> bool {
        true
    }

    fn feeling(&self) -> f64 {
        FEELING
    }

    fn speak(&self, voice: &str, sentences: &[Sentence]) -> Result<Vec<Spoken>> {
        sentences
            .iter()
            .map(|s| self.speak_sentence(voice, s))
            .collect()
    }
}

impl<H: Host> Kokoro<H> {
    fn speak_sentence(&self, voice: &str, sentence: &Sentence) -> Result<Spoken> {
        let tongue = SpokenLanguage::from_voice(voice)?;
        let text = Text::from_sentence(sentence, tongue, &self.0)?;
        if text.marks.iter().all(|m| m.token.is_none()) {
            return Ok(labels::nothing(RATE_HZ, tongue.phone_set));
        }
        let mut whole: Option<Spoken> = None;
        for part in text.parts() {
            let marks = &text.marks[part];
            let letters: String = marks.iter().map(|m| m.letter).collect();
            let mut spoken = to_spoken(
                marks,
                tongue,
                &self.0.infer(voice, &letters, sentence.pace * OWN_PACE)?,
            )?;
            borders::refine(&mut spoken);
            match &mut whole {
                Some(all) => append(all, spoken),
                None => whole = Some(spoken),
            }
        }
        Ok(whole.unwrap_or_else(|| labels::nothing(RATE_HZ, tongue.phone_set)))
    }
}

/// Language of a voice.
#[derive(Clone, Copy, Debug)]
struct SpokenLanguage {
    /// The first letter of the names of its voices.
    letter: char,
    /// A tag of BCP 47.
    tag: &'static str,
    phone_set: &'static str,
    set: Set,
    /// espeak-ng language that transcribes its words; `None`: the dictionaries are used.
    espeak: Option<&'static str>,
}

const TONGUES: [SpokenLanguage; 3] = [
    SpokenLanguage {
        letter: 'a',
        tag: "en-US",
        phone_set: "radio",
        set: Set::Radio,
        espeak: None,
    },
    SpokenLanguage {
        letter: 'b',
        tag: "en-GB",
        phone_set: "radio",
        set: Set::Radio,
        espeak: None,
    },
    SpokenLanguage {
        letter: 'p',
        tag: "pt-BR",
        phone_set: "espeak-pt",
        set: Set::EspeakPt,
        espeak: Some("pt-br"),
    },
];

impl SpokenLanguage {
    fn from_voice(voice: &str) -> Result<Self> {
        let found = TONGUES.iter().find(|t| voice.starts_with(t.letter));
        found
            .copied()
            .with_context(|| format!("the voice {voice} speaks no language that is known here"))
    }
}

/// Returns true if the name has the format of a Kokoro voice.
pub(in crate::bake) fn is_name(name: &str) -> bool {
    let is_sign = |at: usize, sign: char| name.chars().nth(at) == Some(sign);
    is_sign(2, '_') && info(name).is_some()
}

/// Parses a voice's name: language, sex, speaker.
fn info(name: &str) -> Option<VoiceInfo> {
    let tongue = SpokenLanguage::from_voice(name).ok()?;
    let gender = match name.chars().nth(1)? {
        'f' => Gender::Female,
        'm' => Gender::Male,
        _ => return None,
    };
    Some(VoiceInfo {
        name: name.to_owned(),
        language: tongue.tag.to_owned(),
        gender: Some(gender),
        phone_set: tongue.phone_set.to_owned(),
        rate_hz: RATE_HZ,
        what: "neural".to_owned(),
    })
}

/// Letter of the spoken text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Mark {
    letter: char,
    /// Index of its token; `None` between words.
    token: Option<usize>,
}

/// A sentence as the network reads it.
#[derive(Debug, Default)]
struct Text {
    marks: Vec<Mark>,
}

impl Text {
    fn from_sentence(sentence: &Sentence, tongue: SpokenLanguage, host: &dyn Host) -> Result<Self> {
        let mut marks: Vec<Mark> = Vec::new();
        let between = |letter| Mark {
            letter,
            token: None,
        };
        let last = sentence.tokens.len().saturating_sub(1);
        let written = match tongue.espeak {
            None => words::written(sentence, host)?,
            Some(language) => words::of_espeak(sentence, language, host)?,
        };
        for (t, (token, letters)) in sentence.tokens.iter().zip(written).enumerate() {
            if letters.is_empty() {
                continue;
            }
            if !marks.is_empty() {
                marks.push(between(' '));
            }
            marks.extend(letters.chars().map(|letter| Mark {
                letter,
                token: Some(t),
            }));
            let end = punctuation(token, (t == last).then_some(sentence.kind));
            // A sentence without an end sounds cut off.
            let end = if t == last && end.is_empty() {
                "."
            } else {
                &end
            };
            marks.extend(end.chars().take(1).map(between));
        }
        Ok(Self { marks })
    }

    /// Splits the text for inference: each part is as long as the network allows, up to its last
    /// punctuation mark, or otherwise its last space.
    fn parts(&self) -> Vec<Range<usize>> {
        let mut out = Vec::new();
        let mut from = 0;
        while self.marks.len() - from > MAX_LETTERS {
            let most = &self.marks[from..from + MAX_LETTERS];
            let after = |found: fn(char) -> bool| {
                let at = most.iter().rposition(|m| found(m.letter));
                at.map(|at| at + 1).filter(|length| *length > 1)
            };
            let length = after(|c| ",.;:!?".contains(c))
                .or_else(|| after(|c| c == ' '))
                .unwrap_or(MAX_LETTERS);
            out.push(from..from + length);
            from += length;
        }
        out.push(from..self.marks.len());
        out
    }
}

/// Letters with their sound.
fn to_spoken(marks: &[Mark], tongue: SpokenLanguage, out: &Output) -> Result<Spoken> {
    ensure!(
        out.frames.len() == marks.len() + 2,
        "the network returned {} letters for {}",
        out.frames.len(),
        marks.len()
    );
    let total: f64 = out.frames.iter().map(|f| f64::from(*f)).sum();
    ensure!(total > 0.0, "the network made no sound");
    let secs = out.samples.len() as f64 / RATE_HZ / total;
    let mut at = f64::from(out.frames[0]) * secs - LEAD_SECS;
    let mut ends = Vec::with_capacity(marks.len());
    for frames in &out.frames[1..=marks.len()] {
        at += f64::from(*frames) * secs;
        ends.push(at.max(0.0));
    }
    let start = (f64::from(out.frames[0]) * secs - LEAD_SECS).max(0.0);
    let labels = labels_of(marks, tongue, start, &ends);
    let wave = Wave {
        samples: out.samples.iter().map(|s| f64::from(*s)).collect(),
        rate_hz: RATE_HZ,
    };
    labels::finish(&labels, wave, tongue.phone_set, 0.0)
}

/// Returns the phones of letters whose end times are known.
fn labels_of(marks: &[Mark], tongue: SpokenLanguage, start: f64, ends: &[f64]) -> Labels {
    let mut labels = Labels::default();
    if start > 0.0 {
        labels.phones.push(Phone {
            end_secs: start,
            ..Phone::default()
        });
    }
    let mut at = 0;
    let mut begins = start;
    while at < marks.len() {
        let token = marks[at].token;
        let count = marks[at..].iter().take_while(|m| m.token == token).count();
        let span = at..at + count;
        match token {
            Some(token) => {
                let (marks, ends) = (&marks[span.clone()], &ends[span.clone()]);
                match tongue.espeak {
                    None => letters::word(&mut labels, marks, ends, token),
                    Some(_) => letters::word_of(&mut labels, marks, ends, token, tongue.set),
                }
            }
            None => between(
                &mut labels,
                &marks[span.clone()],
                begins,
                ends[span.end - 1],
            ),
        }
        begins = ends[span.end - 1];
        at = span.end;
    }
    labels
}

/// Handles the time between words: a pause if it is long enough, otherwise an extension of the
/// preceding phone.
fn between(labels: &mut Labels, marks: &[Mark], begins: f64, end_secs: f64) {
    let parts = marks.iter().any(|m| m.letter != ' ');
    if parts && let Some(last) = labels.phones.iter().rev().find_map(|p| p.token) {
        labels.breaks.push((last, String::new()));
    }
    match labels.phones.last_mut() {
        Some(last) if !parts || end_secs - begins < PAUSE_SECS => last.end_secs = end_secs,
        _ => labels.phones.push(Phone {
            end_secs,
            ..Phone::default()
        }),
    }
}

/// Puts a part of a sentence behind the parts before it.
fn append(all: &mut Spoken, part: Spoken) {
    let secs = all.samples.len() as f64 / all.rate_hz;
    let first = all.segments.len();
    all.samples.extend(part.samples);
    all.segments
        .extend(part.segments.into_iter().map(|s| Segment {
            end_secs: s.end_secs + secs,
            ..s
        }));
    all.syllables
        .extend(part.syllables.into_iter().map(|s| SpokenSyllable {
            first: s.first + first,
            ..s
        }));
    all.breaks.extend(part.breaks);
}

#[cfg(test)]
mod tests;
