//! The speech bundle, version 2: `voice/speech.json` next to its audio files.
//! `docs/speech-bundle.md` describes its format.

mod check;
mod frames;
mod melody;
mod read;
#[cfg(test)]
mod tests;

pub use frames::{
    FRAME_SECS, code_of_db, code_of_hz, db_of_code, from_base64, hz_of_code, semitones_of_code,
    to_base64,
};
pub use read::BundleError;

use std::sync::Arc;

use crate::phones::PhoneRow;

/// Version of the bundle format that this code reads and writes.
pub const VERSION: u32 = 2;

/// Phone symbol of silence in every phone set.
pub const SILENCE: &str = "pau";

/// The symbol of a recording between the words: the mouth is still.
pub const SOUND: &str = "snd";

/// Speech bundle: the speech of a story, synthesised ahead of time, with the timing of its phones
/// and words.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bundle {
    /// Voices that speak in it.
    pub voices: Vec<Voice>,
    /// Utterances in the order of the story.
    pub utterances: Vec<Arc<Utterance>>,
}

/// Synthetic voice of an engine that speaks in a bundle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Voice {
    /// Engine and version, for example `festival 2.5.0`.
    pub engine: String,
    /// The voice, as its engine calls it.
    pub voice: String,
    /// BCP 47 language tag, for example `en-US`.
    pub language: String,
    /// The phone set, for example `radio` or `espeak-de`.
    pub phone_set: String,
    /// Symbols of rows of [`crate::phones`] that have another name: symbol and name.
    pub mouth: Vec<(String, String)>,
}

impl Voice {
    /// Returns the row of the phone table that drives the lips for a symbol; `None` for an unknown
    /// one.
    #[must_use]
    pub fn phone_row(&self, symbol: &str) -> Option<PhoneRow> {
        if symbol == SOUND {
            return Some(PhoneRow::SILENCE);
        }
        let other = self.mouth.iter().find(|(own, _)| own == symbol);
        PhoneRow::named(other.map_or(symbol, |(_, name)| name))
    }
}

/// One utterance of a bundle: text, audio files, and the timing and prosody that drive mouth and
/// gestures.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Utterance {
    /// The key by which a story finds it: a digest of the text, the voice and the emotion.
    pub key: u64,
    /// Digest of all inputs of its audio, which tells a baker if the audio is up to date.
    pub content: u64,
    /// The story's part of [`Utterance::content`], by which a baker without the engines detects
    /// changes of the text. `None` in older bundles.
    pub source: Option<u64>,
    /// Index of its voice in [`Bundle::voices`].
    pub voice: usize,
    /// Plain text of the utterance.
    pub text: String,
    /// Length of the sound, seconds.
    pub duration_secs: f64,
    /// The sound, in order of preference; relative to the bundle's folder.
    pub audio: Vec<AudioFile>,
    /// Words in order, each made of phones that follow each other.
    pub words: Vec<Word>,
    /// The first byte of each word in the text.
    pub text_starts: Vec<usize>,
    /// Phones in order; they tile [0, duration] without gaps.
    pub phones: Vec<Phone>,
    /// Syllables in the order of speech.
    pub syllables: Vec<Syllable>,
    /// Pitch accents, by syllable.
    pub accents: Vec<Accent>,
    /// Intonational phrases, in order; each word belongs to one.
    pub phrases: Vec<Phrase>,
    /// Sentences, in order; each word belongs to one.
    pub sentences: Vec<Sentence>,
    /// Emotions in force, by time.
    pub emotions: Vec<Emotion>,
    /// Fundamental frequency of the final sound, one code for each [`FRAME_SECS`]; see
    /// [`hz_of_code`].
    pub f0: Vec<u8>,
    /// Intensity of the utterance, one code for each [`FRAME_SECS`]; [`db_of_code`] converts a code
    /// to decibels.
    pub intensity: Vec<u8>,
}

/// Audio file of an utterance in one encoding.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AudioFile {
    /// File name in the bundle's folder: letters, digits, `.`, `_`, `-` only.
    pub file: String,
    /// MIME type with codecs.
    pub mime: String,
    /// Length and digest of the file, where the bundle has them.
    pub digest: Option<FileDigest>,
}

/// Length and digest of an audio file, by which a baker (program that synthesises speech ahead of
/// time) detects the audio of an utterance.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileDigest {
    /// Length of the file, bytes.
    pub bytes: u64,
    /// SHA-256 of its bytes (FIPS 180-4), 64 hexadecimal digits in small letters.
    pub sha256: String,
}

/// Spoken word with its time span.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Word {
    /// Word as written, with attached punctuation.
    pub text: String,
    /// Seconds from the start of the utterance.
    pub start_secs: f64,
    /// Seconds from the start of the utterance.
    pub end_secs: f64,
    /// True if the script emphasises it; false in a bundle.
    pub emphasized: bool,
}

/// Phone (speech sound) with its time span, which drives the mouth.
#[derive(Clone, Debug, PartialEq)]
pub struct Phone {
    /// Symbol in the voice's phone set; [`SILENCE`] is a pause.
    pub symbol: String,
    /// The row of the phone table that moves the lips; [`PhoneRow::NEUTRAL`] for an unknown
    /// symbol.
    pub row: PhoneRow,
    /// Seconds from the start of the utterance.
    pub start_secs: f64,
    /// Seconds from the start of the utterance.
    pub end_secs: f64,
    /// Index of its word; `None` for silence and for recordings between the words.
    pub word: Option<usize>,
}

/// Syllable as a run of phones, with its stress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Syllable {
    /// Index of its first phone.
    pub first_phone: usize,
    /// Number of phones, at least one.
    pub phones: usize,
    /// Stress: 0 none, 1 primary, 2 secondary.
    pub stress: u8,
}

/// Pitch accent on a syllable, with its ToBI label.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Accent {
    /// Index of its syllable.
    pub syllable: usize,
    /// ToBI label, for example `H*`; `*` if the engine gives none.
    pub label: String,
}

/// Intonational phrase as a run of words, with its boundary tone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Phrase {
    /// Index of its first word.
    pub first_word: usize,
    /// Number of words in the phrase.
    pub words: usize,
    /// The boundary tone at its end in ToBI, for example `L-L%`.
    pub tone: String,
}

/// Type of a sentence by its final punctuation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SentenceKind {
    /// Declarative.
    #[default]
    Statement,
    /// Interrogative.
    Question,
    /// Exclamative.
    Exclamation,
    /// Incomplete: more follows.
    Continuation,
}

/// Sentence as a run of words, with its type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sentence {
    /// Index of its first word.
    pub first_word: usize,
    /// Number of words in the sentence.
    pub words: usize,
    /// Type of the sentence.
    pub kind: SentenceKind,
}

/// Emotion in force during part of an utterance (F&H 4.3.5, 4.4), with its coordinates on the
/// scales of activation, evaluation and power.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Emotion {
    /// Emotion word (F&H tables 4.1 and 4.4).
    pub name: String,
    /// Time at which the emotion begins, seconds from the start of the utterance.
    pub start_secs: f64,
    /// Time of its apex, seconds.
    pub apex_secs: f64,
    /// Time at which the emotion ends, seconds from the start of the utterance.
    pub end_secs: f64,
    /// Activation, −100 passive to 100 active.
    pub activation: f64,
    /// Evaluation, −100 negative to 100 positive.
    pub evaluation: f64,
    /// Power, −100 submissive to 100 dominant.
    pub power: f64,
}

impl Phone {
    /// Creates a phone whose symbol is the name of its row in the phone table.
    /// [`Bundle::from_json`] resolves the symbols of other phone sets by the voice.
    #[must_use]
    pub fn new(symbol: &str, start_secs: f64, end_secs: f64, word: Option<usize>) -> Self {
        Self {
            symbol: symbol.to_owned(),
            row: PhoneRow::named(symbol).unwrap_or_default(),
            start_secs,
            end_secs,
            word,
        }
    }
}

impl Bundle {
    /// Returns the index of the utterance with this key; `None` if there is none.
    #[must_use]
    pub fn find(&self, key: u64) -> Option<usize> {
        self.utterances.iter().position(|u| u.key == key)
    }
}

impl SentenceKind {
    /// Punctuation marks of the kinds of sentences.
    pub const MARKS: [(Self, &'static str); 4] = [
        (Self::Statement, "."),
        (Self::Question, "?"),
        (Self::Exclamation, "!"),
        (Self::Continuation, ","),
    ];
}

impl Utterance {
    /// Returns the index of the word spoken at `offset_secs` into the utterance: the last one that
    /// has begun, until it ends. O(log n).
    #[must_use]
    pub fn word_at(&self, offset_secs: f64) -> Option<usize> {
        let i = self
            .words
            .partition_point(|w| w.start_secs <= offset_secs)
            .checked_sub(1)?;
        (offset_secs < self.words[i].end_secs).then_some(i)
    }

    /// Returns start and end of the accented syllable, seconds from the start of the utterance, and
    /// the index of its word; `None` if the syllable does not exist.
    #[must_use]
    pub fn accented(&self, accent: &Accent) -> Option<([f64; 2], Option<usize>)> {
        let syllable = self.syllables.get(accent.syllable)?;
        let phones = self.phones.get(syllable.first_phone..)?;
        let phones = phones.get(..syllable.phones)?;
        let (first, last) = phones.first().zip(phones.last())?;
        Some(([first.start_secs, last.end_secs], first.word))
    }

    /// Returns the index of the phone at `offset_secs` into the utterance. O(log n).
    #[must_use]
    pub fn phone_at(&self, offset_secs: f64) -> Option<usize> {
        let i = self
            .phones
            .partition_point(|p| p.start_secs <= offset_secs)
            .checked_sub(1)?;
        (offset_secs < self.phones[i].end_secs).then_some(i)
    }
}
