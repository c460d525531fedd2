//! Reads what a bundle tells of syllables, phrases, sentences, emotions and the sound itself.

use raconteur_base::json::{Fault, Json};

use super::read::secs;
use super::{Accent, Emotion, Phrase, Sentence, SentenceKind, Syllable, Utterance, from_base64};

/// The rows of a table that may be absent: lists that begin with a text, which may be empty,
/// and go on with numbers.
fn table<'v>(
    object: &'v Json<'_>,
    name: &str,
    columns: usize,
) -> Result<Vec<(&'v str, Vec<f64>)>, Fault> {
    let row = |row: &'v Json<'_>| {
        let (label, numbers) = row.items().split_first()?;
        let numbers: Option<Vec<f64>> = numbers.iter().map(Json::number).collect();
        Some((label.text()?, numbers.filter(|n| n.len() == columns)?))
    };
    let rows = object.get(name).items().iter();
    rows.map(|one| row(one).ok_or_else(|| one.fault(["a row of `", name, "` is none"].concat())))
        .collect()
}

/// A number that counts; anything else becomes more than there can be.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "whole numbers of 32 bits stay what they are, and others become the last index"
)]
fn count(number: f64) -> usize {
    let whole = number as u32;
    if f64::from(whole) == number {
        whole as usize
    } else {
        usize::MAX
    }
}

impl Utterance {
    /// Reads what may be absent.
    pub(super) fn read_melody(&mut self, json: &Json<'_>) -> Result<(), Fault> {
        self.f0 = frames(json, "f0")?;
        self.intensity = frames(json, "intensity")?;
        for (label, row) in table(json, "syllables", 3)? {
            if !label.is_empty() {
                self.accents.push(Accent {
                    syllable: self.syllables.len(),
                    label: label.to_owned(),
                });
            }
            self.syllables.push(Syllable {
                first_phone: count(row[0]),
                phones: count(row[1]),
                stress: count(row[2]).min(3) as u8,
            });
        }
        let mut first_word = 0_usize;
        for (label, row) in table(json, "phrases", 1)? {
            let words = count(row[0]);
            let tone = label.to_owned();
            self.phrases.push(Phrase {
                first_word,
                words,
                tone,
            });
            first_word = first_word.saturating_add(words);
        }
        let mut first_word = 0_usize;
        for (label, row) in table(json, "sentences", 1)? {
            let words = count(row[0]);
            let known = SentenceKind::MARKS.iter().find(|(_, mark)| *mark == label);
            self.sentences.push(Sentence {
                first_word,
                words,
                kind: known.map_or(SentenceKind::Statement, |(kind, _)| *kind),
            });
            first_word = first_word.saturating_add(words);
        }
        for (label, row) in table(json, "emotions", 6)? {
            self.emotions.push(Emotion {
                name: label.to_owned(),
                start_secs: secs(row[0]),
                apex_secs: secs(row[1]),
                end_secs: secs(row[2]),
                activation: row[3],
                evaluation: row[4],
                power: row[5],
            });
        }
        Ok(())
    }
}

fn frames(json: &Json<'_>, name: &str) -> Result<Vec<u8>, Fault> {
    let member = json.get(name);
    if member.is_null() {
        return Ok(Vec::new());
    }
    let bytes = member.text().and_then(from_base64);
    bytes.ok_or_else(|| member.fault(["`", name, "` is not base64"].concat()))
}
