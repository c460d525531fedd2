//! Reader of syllables, phrases, sentences, emotions, pitch and intensity of an utterance.

use super::frames::{from_base64, secs};
use super::{Accent, Emotion, Phrase, Sentence, SentenceKind, Syllable, Utterance};

/// Syllable in the bundle's JSON: label, first phone, number of phones, stress.
pub(super) type SyllableRow = (String, usize, usize, u32);
/// Phrase or sentence in the bundle's JSON: boundary tone or punctuation mark, and number of words.
pub(super) type WordsRow = (String, usize);
/// Emotion in the bundle's JSON: name; start, apex and end in milliseconds; activation, evaluation,
/// power.
pub(super) type EmotionRow = (String, f64, f64, f64, f64, f64, f64);

/// Optional prosodic members of an utterance in the bundle's JSON: syllables, phrases, sentences,
/// emotions, F0 and intensity.
pub(super) struct Melody {
    pub(super) syllables: Vec<SyllableRow>,
    pub(super) phrases: Vec<WordsRow>,
    pub(super) sentences: Vec<WordsRow>,
    pub(super) emotions: Vec<EmotionRow>,
    pub(super) f0: Option<String>,
    pub(super) intensity: Option<String>,
}

/// Takes the next `items` of `all`; returns the index of the first, if there are enough.
fn take_items(taken: &mut usize, items: usize, all: usize) -> Option<usize> {
    let first = *taken;
    *taken = first.saturating_add(items);
    (*taken <= all).then_some(first)
}

impl Utterance {
    /// Reads the optional members, after phones and words.
    pub(super) fn read_melody(&mut self, melody: Melody) -> Result<(), String> {
        self.f0 = frames(melody.f0, "f0")?;
        self.intensity = frames(melody.intensity, "intensity")?;
        for (label, first_phone, phones, stress) in melody.syllables {
            let end = first_phone.saturating_add(phones);
            if phones == 0 || end > self.phones.len() {
                return Err("a syllable has phones that are not there".to_owned());
            }
            if !label.is_empty() {
                self.accents.push(Accent {
                    syllable: self.syllables.len(),
                    label,
                });
            }
            self.syllables.push(Syllable {
                first_phone,
                phones,
                stress: stress.min(3) as u8,
            });
        }
        let all = self.words.len();
        let mut taken = 0;
        for (tone, words) in melody.phrases {
            self.phrases.push(Phrase {
                first_word: take_items(&mut taken, words, all)
                    .ok_or("a phrase has words that are not there")?,
                words,
                tone,
            });
        }
        let mut taken = 0;
        for (label, words) in melody.sentences {
            let known = SentenceKind::MARKS.iter().find(|(_, mark)| *mark == label);
            self.sentences.push(Sentence {
                first_word: take_items(&mut taken, words, all)
                    .ok_or("a sentence has words that are not there")?,
                words,
                kind: known.map_or(SentenceKind::Statement, |(kind, _)| *kind),
            });
        }
        for (name, start, apex, end, activation, evaluation, power) in melody.emotions {
            let [start_secs, apex_secs, end_secs] = [start, apex, end].map(secs);
            // 1 ms forgives rounding; the numbers of a file are finite.
            let fine = 0.0 <= start_secs
                && start_secs <= apex_secs
                && apex_secs <= end_secs
                && end_secs <= self.duration_secs + 1e-3;
            if !fine {
                return Err("an emotion is out of the utterance".to_owned());
            }
            self.emotions.push(Emotion {
                name,
                start_secs,
                apex_secs,
                end_secs,
                activation,
                evaluation,
                power,
            });
        }
        Ok(())
    }
}

fn frames(text: Option<String>, name: &str) -> Result<Vec<u8>, String> {
    match text {
        None => Ok(Vec::new()),
        Some(text) => from_base64(&text).ok_or_else(|| format!("`{name}` is not base64")),
    }
}
