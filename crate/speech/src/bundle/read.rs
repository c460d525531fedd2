//! Reader of a bundle. The file stores times as durations of phones, and words as ranges of phones,
//! so that they tile the utterance for any file content.

use std::sync::Arc;

use raconteur_base::encoding::is_utf16;
use serde::Deserialize;

use super::melody::{EmotionRow, Melody, SyllableRow, WordsRow};
use super::{AudioFile, Bundle, Phone, SILENCE, Utterance, VERSION, Voice, Word};

/// Error returned when a speech bundle (speech synthesised ahead of time) is rejected.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BundleError {
    /// The file is not JSON of the right shape.
    #[error("the speech bundle cannot be read: {0}")]
    Json(#[from] serde_json::Error),
    /// The text is UTF-16, as some editors save it.
    #[error(
        "the speech bundle cannot be read: this is UTF-16 text, not UTF-8; save the file as UTF-8"
    )]
    Utf16,
    /// Another format or another version.
    #[error(
        "the speech bundle is {format} version {version}; this program reads raconteur-speech version 2"
    )]
    Version {
        /// Format and version of a file.
        format: String,
        /// Version of the file.
        version: u32,
    },
    /// Times or names that cannot be.
    #[error("utterance {utterance} of the speech bundle: {what}")]
    Invalid {
        /// Index of the utterance.
        utterance: usize,
        /// Description of the fault.
        what: String,
    },
}

impl Bundle {
    /// Reads and checks a bundle. Unknown members are ignored.
    ///
    /// # Errors
    /// Returns an error if the text is not a bundle, has another version, or contains impossible
    /// times or file names that leave the folder.
    pub fn from_json(json: &[u8]) -> Result<Self, BundleError> {
        if is_utf16(json) {
            return Err(BundleError::Utf16);
        }
        let Head { format, version } = serde_json::from_slice(json)?;
        if format != "raconteur-speech" || version != VERSION {
            return Err(BundleError::Version { format, version });
        }
        let body: Body = serde_json::from_slice(json)?;
        let utterances = body
            .utterances
            .into_iter()
            .enumerate()
            .map(|(utterance, row)| {
                Utterance::from_row(row).map_err(|what| BundleError::Invalid { utterance, what })
            });
        let voices: Vec<Voice> = body.voices.into_iter().map(Voice::from_row).collect();
        let mut utterances = utterances.collect::<Result<Vec<Utterance>, _>>()?;
        for (utterance, u) in utterances.iter_mut().enumerate() {
            u.check(voices.len())
                .map_err(|what| BundleError::Invalid { utterance, what })?;
            for phone in &mut u.phones {
                phone.row = voices[u.voice].phone_row(&phone.symbol).unwrap_or_default();
            }
        }
        Ok(Self {
            voices,
            utterances: utterances.into_iter().map(Arc::new).collect(),
        })
    }
}

/// Format and version of a file.
#[derive(Deserialize)]
struct Head {
    format: String,
    version: u32,
}

/// The rest of the file.
#[derive(Deserialize)]
struct Body {
    voices: Vec<VoiceRow>,
    utterances: Vec<UtteranceRow>,
}

#[derive(Deserialize)]
struct VoiceRow {
    engine: String,
    voice: String,
    language: String,
    phone_set: String,
    #[serde(default)]
    mouth: String,
}

#[derive(Deserialize)]
struct AudioRow {
    file: String,
    mime: String,
    bytes: Option<u64>,
    sha256: Option<String>,
}

/// An utterance as it is written.
#[derive(Deserialize)]
struct UtteranceRow {
    key: Digest,
    content: Digest,
    source: Option<Digest>,
    voice: usize,
    text: String,
    audio: Vec<AudioRow>,
    phones: String,
    msecs: Vec<u32>,
    words: Vec<[usize; 4]>,
    #[serde(default)]
    syllables: Vec<SyllableRow>,
    #[serde(default)]
    phrases: Vec<WordsRow>,
    #[serde(default)]
    sentences: Vec<WordsRow>,
    #[serde(default)]
    emotions: Vec<EmotionRow>,
    f0: Option<String>,
    intensity: Option<String>,
}

/// A digest of 16 hexadecimal digits.
#[derive(Deserialize)]
#[serde(try_from = "String")]
struct Digest(u64);

impl TryFrom<String> for Digest {
    type Error = &'static str;

    fn try_from(digits: String) -> Result<Self, Self::Error> {
        if digits.len() != 16 {
            return Err("a digest has 16 hexadecimal digits");
        }
        let value = u64::from_str_radix(&digits, 16);
        value
            .map(Self)
            .map_err(|_| "a digest has 16 hexadecimal digits")
    }
}

/// Words by two.
fn pairs(text: &str) -> Vec<(String, String)> {
    let mut words = text.split_ascii_whitespace().map(str::to_owned);
    let mut pairs = Vec::new();
    while let (Some(one), Some(other)) = (words.next(), words.next()) {
        pairs.push((one, other));
    }
    pairs
}

impl Voice {
    fn from_row(row: VoiceRow) -> Self {
        Self {
            engine: row.engine,
            voice: row.voice,
            language: row.language,
            phone_set: row.phone_set,
            mouth: pairs(&row.mouth),
        }
    }
}

impl AudioFile {
    fn from_row(row: AudioRow) -> Result<Self, String> {
        Ok(Self {
            digest: super::FileDigest::from_parts(row.bytes, row.sha256)?,
            file: row.file,
            mime: row.mime,
        })
    }
}

impl super::FileDigest {
    /// Creates the digest from its two JSON members, which must be both present or both absent.
    fn from_parts(bytes: Option<u64>, sha256: Option<String>) -> Result<Option<Self>, String> {
        let (bytes, sha256) = match (bytes, sha256) {
            (None, None) => return Ok(None),
            (Some(bytes), Some(sha256)) => (bytes, sha256),
            _ => return Err("a sound has only one of `bytes` and `sha256`".to_owned()),
        };
        let is_digit = |b: u8| matches!(b, b'0'..=b'9' | b'a'..=b'f');
        if sha256.len() != 64 || !sha256.bytes().all(is_digit) {
            return Err("an audio file's `sha256` is not a SHA-256 in lower case".to_owned());
        }
        Ok(Some(Self { bytes, sha256 }))
    }
}

/// Maximum length of a phone or pause, milliseconds: ten times the longest pause that markup can
/// request.
const MAX_PHONE_MSEC: u32 = 600_000;
/// The longest utterance, milliseconds: a day, the longest that alignments may have.
const MAX_MSEC: f64 = 86_400_000.0;

/// Milliseconds as seconds.
pub(super) fn secs(msec: f64) -> f64 {
    msec / 1000.0
}

impl Utterance {
    fn from_row(row: UtteranceRow) -> Result<Self, String> {
        let audio = row.audio.into_iter().map(AudioFile::from_row);
        let mut utterance = Self {
            key: row.key.0,
            content: row.content.0,
            source: row.source.map(|source| source.0),
            voice: row.voice,
            text: row.text,
            audio: audio.collect::<Result<_, _>>()?,
            ..Self::default()
        };
        utterance.read_phones(&row.phones, &row.msecs)?;
        utterance.read_words(&row.words)?;
        utterance.read_melody(Melody {
            syllables: row.syllables,
            phrases: row.phrases,
            sentences: row.sentences,
            emotions: row.emotions,
            f0: row.f0,
            intensity: row.intensity,
        })?;
        Ok(utterance)
    }

    fn read_phones(&mut self, phones: &str, msecs: &[u32]) -> Result<(), String> {
        let symbols = phones.split_ascii_whitespace();
        let mut end_msec: f64 = 0.0;
        let mut lengths_left = msecs.iter();
        for symbol in symbols {
            let Some(&length) = lengths_left.next() else {
                return Err("there are more phones than lengths".to_owned());
            };
            let start_secs = secs(end_msec);
            if length > MAX_PHONE_MSEC {
                return Err(format!(
                    "a phone or pause of {length} ms is longer than {MAX_PHONE_MSEC}"
                ));
            }
            end_msec += f64::from(length);
            if end_msec > MAX_MSEC {
                return Err(format!("the utterance is longer than {MAX_MSEC} ms"));
            }
            self.phones
                .push(Phone::new(symbol, start_secs, secs(end_msec), None));
        }
        if lengths_left.next().is_some() {
            return Err("there are more lengths than phones".to_owned());
        }
        self.duration_secs = secs(end_msec);
        Ok(())
    }

    fn read_words(&mut self, rows: &[[usize; 4]]) -> Result<(), String> {
        // A word without a sound has no length, at the end of the one before it.
        let mut silent_secs = 0.0;
        for [text_start, bytes, first, phones] in rows {
            let none = |what: &str| format!("word {} {what}", self.words.len() + 1);
            let text_end = text_start.saturating_add(*bytes);
            let text = self.text.get(*text_start..text_end);
            let spoken = self
                .phones
                .get_mut(*first..first.saturating_add(*phones))
                .ok_or_else(|| none("has phones that are not there"))?;
            let word = self.words.len();
            // A long number may pause inside.
            let is_still = |p: &Phone| p.symbol == SILENCE;
            if spoken.iter().any(|p| p.word.is_some())
                || spoken.first().is_some_and(is_still)
                || spoken.last().is_some_and(is_still)
            {
                return Err(none("has a phone that is not its own"));
            }
            for phone in spoken.iter_mut().filter(|p| !is_still(p)) {
                phone.word = Some(word);
            }
            let ends = spoken.first().zip(spoken.last());
            let (start_secs, end_secs) = ends
                .map_or((silent_secs, silent_secs), |(first, last)| {
                    (first.start_secs, last.end_secs)
                });
            if start_secs < silent_secs {
                return Err(none("begins before the one before it"));
            }
            silent_secs = end_secs;
            self.words.push(Word {
                text: text.ok_or_else(|| none("is not in the text"))?.to_owned(),
                start_secs,
                end_secs,
                emphasized: false,
            });
            self.text_starts.push(*text_start);
        }
        Ok(())
    }
}
