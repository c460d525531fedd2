//! Reads what a bundle tells of syllables, phrases, sentences, emotions and the sound itself.

use raconteur_base::json::{Fault, Json};

use super::frames::from_base64;
use super::read::secs;
use super::{Accent, Emotion, Phrase, Sentence, SentenceKind, Syllable, Utterance};

/// What is wrong with a row, if anything.
type Fits = Result<(), &'static str>;

/// Shows the rows of a table that may be absent: lists that begin with a text, which may be
/// empty, and go on with as many numbers as there are columns, at most six. One function for all
/// tables keeps the page small.
fn table(
    object: &Json<'_>,
    name: &str,
    columns: usize,
    take: &mut dyn FnMut(&str, &[f64; 6]) -> Fits,
) -> Result<(), Fault> {
    for row in object.get(name).items() {
        let mut numbers = [0.0; 6];
        let Some(label) = cells(row, columns, &mut numbers) else {
            return Err(row.fault(["a row of `", name, "` is none"].concat()));
        };
        take(label, &numbers).map_err(|what| row.fault(what.to_owned()))?;
    }
    Ok(())
}

/// The text that begins a row; the numbers behind it are filled in.
fn cells<'v>(row: &'v Json<'_>, columns: usize, numbers: &mut [f64; 6]) -> Option<&'v str> {
    let (label, items) = row.items().split_first()?;
    if items.len() != columns {
        return None;
    }
    for (number, item) in numbers.iter_mut().zip(items) {
        *number = item.number()?;
    }
    label.text()
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

/// The first of so many items behind those before them, if there are as many in all.
fn part(taken: &mut usize, items: usize, all: usize) -> Option<usize> {
    let first = *taken;
    *taken = first.saturating_add(items);
    (*taken <= all).then_some(first)
}

/// Reads what may be absent, after phones and words. A browser fetches the code for it in a file of
/// its own: `web/tools/split.mjs` cuts here, and so it is never inlined.
#[inline(never)]
pub(super) fn read(utterances: &mut [Utterance], from: &[Json<'_>]) -> Result<(), Fault> {
    let mut both = utterances.iter_mut().zip(from);
    both.try_for_each(|(utterance, json)| utterance.read_melody(json))
}

impl Utterance {
    fn read_melody(&mut self, json: &Json<'_>) -> Result<(), Fault> {
        self.f0 = frames(json, "f0")?;
        self.intensity = frames(json, "intensity")?;
        let (phones, words) = (self.phones.len(), self.words.len());
        table(json, "syllables", 3, &mut |label, row| {
            let syllable = Syllable {
                first_phone: count(row[0]),
                phones: count(row[1]),
                stress: count(row[2]).min(3) as u8,
            };
            let end = syllable.first_phone.saturating_add(syllable.phones);
            if syllable.phones == 0 || end > phones {
                return Err("a syllable has phones that are not there");
            }
            if !label.is_empty() {
                self.accents.push(Accent {
                    syllable: self.syllables.len(),
                    label: label.to_owned(),
                });
            }
            self.syllables.push(syllable);
            Ok(())
        })?;
        let mut taken = 0;
        table(json, "phrases", 1, &mut |label, row| {
            let count = count(row[0]);
            self.phrases.push(Phrase {
                first_word: part(&mut taken, count, words)
                    .ok_or("a phrase has words that are not there")?,
                words: count,
                tone: label.to_owned(),
            });
            Ok(())
        })?;
        let mut taken = 0;
        table(json, "sentences", 1, &mut |label, row| {
            let count = count(row[0]);
            let known = SentenceKind::MARKS.iter().find(|(_, mark)| *mark == label);
            self.sentences.push(Sentence {
                first_word: part(&mut taken, count, words)
                    .ok_or("a sentence has words that are not there")?,
                words: count,
                kind: known.map_or(SentenceKind::Statement, |(kind, _)| *kind),
            });
            Ok(())
        })?;
        table(json, "emotions", 6, &mut |label, row| {
            let [start_secs, apex_secs, end_secs] = [secs(row[0]), secs(row[1]), secs(row[2])];
            // 1 ms forgives rounding; the numbers of a file are finite.
            let fine = 0.0 <= start_secs
                && start_secs <= apex_secs
                && apex_secs <= end_secs
                && end_secs <= self.duration_secs + 1e-3;
            if !fine {
                return Err("an emotion is out of the utterance");
            }
            self.emotions.push(Emotion {
                name: label.to_owned(),
                start_secs,
                apex_secs,
                end_secs,
                activation: row[3],
                evaluation: row[4],
                power: row[5],
            });
            Ok(())
        })
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
