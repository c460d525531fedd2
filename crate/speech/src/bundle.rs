//! The speech bundle, version 1: `voice/speech.json` beside its audio files.

use raconteur_base::decimal::shortest;
use raconteur_base::json::{Fault, Json};
use serde::Serialize;

/// The version this code reads and writes.
pub const VERSION: u32 = 1;

/// Everything that a story says, computed ahead. Unknown fields are ignored.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Bundle {
    /// Always `raconteur-speech`.
    pub format: String,
    /// [`VERSION`].
    pub version: u32,
    /// BCP 47 language tag, for example `en-US`.
    pub language: String,
    /// Name of the phone set, for example `radio`.
    pub phone_set: String,
    /// Voice, as its engine calls it.
    pub voice: String,
    /// Engine and version.
    pub engine: String,
    /// Utterances in the order of the story.
    pub utterances: Vec<Utterance>,
}

/// One utterance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Utterance {
    /// [`crate::Content::key`] of what is said.
    pub key: String,
    /// The words as plain text, for people.
    pub text: String,
    /// Length of the sound, seconds.
    pub duration_secs: f64,
    /// The sound, in order of preference; relative to the bundle's folder.
    pub audio: Vec<AudioFile>,
    /// Words in order, matching [`crate::Content::words`] one to one.
    pub words: Vec<Word>,
    /// Phones in order; they tile [0, duration] without gaps.
    pub phones: Vec<Phone>,
}

/// One encoding of an utterance's sound.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AudioFile {
    /// File name in the bundle's folder: letters, digits, `.`, `_`, `-` only.
    pub file: String,
    /// MIME type with codecs.
    pub mime: String,
}

/// One spoken word.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Word {
    /// As written, punctuation attached.
    pub text: String,
    /// Seconds from the start of the utterance.
    pub start_secs: f64,
    /// Seconds from the start of the utterance.
    pub end_secs: f64,
}

/// One phone.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Phone {
    /// Symbol in the bundle's phone set; `pau` is silence.
    pub symbol: String,
    /// Seconds from the start of the utterance.
    pub start_secs: f64,
    /// Seconds from the start of the utterance.
    pub end_secs: f64,
    /// Index of its word; `None` for silence.
    pub word: Option<usize>,
}

/// Why a bundle was refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BundleError {
    /// The file is not JSON of the right shape.
    #[error("the speech bundle cannot be read: {0}")]
    Json(#[from] Fault),
    /// Another format or a later version.
    #[error(
        "the speech bundle is {format} version {version}; this program reads raconteur-speech version 1"
    )]
    Version {
        /// What the file says it is.
        format: String,
        /// Its version.
        version: u32,
    },
    /// Times or names that cannot be.
    #[error("utterance {utterance} of the speech bundle: {what}")]
    Invalid {
        /// Index of the utterance.
        utterance: usize,
        /// What is wrong with it.
        what: String,
    },
}

impl Bundle {
    /// Reads and checks a bundle.
    ///
    /// # Errors
    /// When the text is not a bundle, has another version, or holds impossible times or
    /// file names that leave the folder.
    pub fn from_json(json: &[u8]) -> Result<Self, BundleError> {
        let bundle = Self::of(&Json::read(json)?)?;
        if bundle.format != "raconteur-speech" || bundle.version != VERSION {
            return Err(BundleError::Version {
                format: bundle.format,
                version: bundle.version,
            });
        }
        for (i, utterance) in bundle.utterances.iter().enumerate() {
            utterance
                .check()
                .map_err(|what| BundleError::Invalid { utterance: i, what })?;
        }
        Ok(bundle)
    }

    fn of(json: &Json<'_>) -> Result<Self, Fault> {
        Ok(Self {
            format: text(json, "format")?,
            version: field(json, "version", |v| u32::try_from(v.whole()?).ok())?,
            language: text(json, "language")?,
            phone_set: text(json, "phone_set")?,
            voice: text(json, "voice")?,
            engine: text(json, "engine")?,
            utterances: list(json, "utterances", Utterance::of)?,
        })
    }

    /// The utterance with this key.
    #[must_use]
    pub fn find(&self, key: &str) -> Option<(usize, &Utterance)> {
        self.utterances
            .iter()
            .enumerate()
            .find(|(_, u)| u.key == key)
    }
}

/// What `take` makes of a member that must be there.
fn field<'v, 'a, T>(
    object: &'v Json<'a>,
    name: &str,
    take: fn(&'v Json<'a>) -> Option<T>,
) -> Result<T, Fault> {
    let member = object.get(name);
    take(member).ok_or_else(|| {
        if member.is_null() {
            object.fault(["`", name, "` is missing"].concat())
        } else {
            member.fault(["`", name, "` has another type"].concat())
        }
    })
}

fn text(object: &Json<'_>, name: &str) -> Result<String, Fault> {
    field(object, name, |v| v.text().map(str::to_owned))
}

fn number(object: &Json<'_>, name: &str) -> Result<f64, Fault> {
    field(object, name, Json::number)
}

fn list<'v, 'a, T>(
    object: &'v Json<'a>,
    name: &str,
    one: fn(&'v Json<'a>) -> Result<T, Fault>,
) -> Result<Vec<T>, Fault> {
    let items = field(object, name, |v| v.is_list().then_some(v.items()))?;
    items.iter().map(one).collect()
}

impl AudioFile {
    fn of(json: &Json<'_>) -> Result<Self, Fault> {
        Ok(Self {
            file: text(json, "file")?,
            mime: text(json, "mime")?,
        })
    }
}

impl Word {
    fn of(json: &Json<'_>) -> Result<Self, Fault> {
        Ok(Self {
            text: text(json, "text")?,
            start_secs: number(json, "start_secs")?,
            end_secs: number(json, "end_secs")?,
        })
    }
}

impl Phone {
    fn of(json: &Json<'_>) -> Result<Self, Fault> {
        Ok(Self {
            symbol: text(json, "symbol")?,
            start_secs: number(json, "start_secs")?,
            end_secs: number(json, "end_secs")?,
            word: if json.get("word").is_null() {
                None
            } else {
                Some(field(json, "word", Json::index)?)
            },
        })
    }
}

impl Utterance {
    fn of(json: &Json<'_>) -> Result<Self, Fault> {
        Ok(Self {
            key: text(json, "key")?,
            text: text(json, "text")?,
            duration_secs: number(json, "duration_secs")?,
            audio: list(json, "audio", AudioFile::of)?,
            words: list(json, "words", Word::of)?,
            phones: list(json, "phones", Phone::of)?,
        })
    }

    /// What is wrong with it, if anything.
    fn check(&self) -> Result<(), String> {
        let in_order = |name: &str, spans: &mut dyn Iterator<Item = (f64, f64)>| {
            let mut last = 0.0;
            for (start, end) in spans {
                // Written so that a NaN fails as well; 1 ms forgives rounding.
                let fine = start >= last - 1e-3 && end >= start && end <= self.duration_secs + 1e-3;
                if !fine {
                    return Err(format!(
                        "{name} at {} to {} s are out of order",
                        shortest(start),
                        shortest(end)
                    ));
                }
                last = end;
            }
            Ok(())
        };
        if !(self.duration_secs.is_finite() && self.duration_secs >= 0.0) {
            return Err("the duration is not a length of time".to_owned());
        }
        in_order(
            "words",
            &mut self.words.iter().map(|w| (w.start_secs, w.end_secs)),
        )?;
        in_order(
            "phones",
            &mut self.phones.iter().map(|p| (p.start_secs, p.end_secs)),
        )?;
        if self
            .phones
            .iter()
            .any(|p| p.word.is_some_and(|w| w >= self.words.len()))
        {
            return Err("a phone belongs to a word that is not there".to_owned());
        }
        let plain = |name: &str| {
            !name.is_empty()
                && !name.starts_with('.')
                && name
                    .chars()
                    .all(|c| c.is_ascii_alphanumeric() || "._-".contains(c))
        };
        match self.audio.iter().find(|a| !plain(&a.file)) {
            Some(bad) => Err(format!(
                "\"{}\" is not a plain file name",
                bad.file.escape_default()
            )),
            None => Ok(()),
        }
    }

    /// Index of the word being spoken `offset_secs` into the utterance: the last one that
    /// has begun, until it ends. O(log n).
    #[must_use]
    pub fn word_at(&self, offset_secs: f64) -> Option<usize> {
        let i = self
            .words
            .partition_point(|w| w.start_secs <= offset_secs)
            .checked_sub(1)?;
        (offset_secs < self.words[i].end_secs).then_some(i)
    }

    /// Index of the phone heard `offset_secs` into the utterance. O(log n).
    #[must_use]
    pub fn phone_at(&self, offset_secs: f64) -> Option<usize> {
        let i = self
            .phones
            .partition_point(|p| p.start_secs <= offset_secs)
            .checked_sub(1)?;
        (offset_secs < self.phones[i].end_secs).then_some(i)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Bundle {
        let word = |t: &str, a, b| Word {
            text: t.to_owned(),
            start_secs: a,
            end_secs: b,
        };
        let phone = |s: &str, a, b, w| Phone {
            symbol: s.to_owned(),
            start_secs: a,
            end_secs: b,
            word: w,
        };
        Bundle {
            format: "raconteur-speech".to_owned(),
            version: VERSION,
            language: "en-US".to_owned(),
            phone_set: "radio".to_owned(),
            voice: "test".to_owned(),
            engine: "test 1".to_owned(),
            utterances: vec![Utterance {
                key: "0".to_owned(),
                text: "Hi you".to_owned(),
                duration_secs: 1.0,
                audio: vec![AudioFile {
                    file: "u0.opus".to_owned(),
                    mime: "audio/ogg".to_owned(),
                }],
                words: vec![word("Hi", 0.1, 0.4), word("you", 0.5, 0.9)],
                phones: vec![
                    phone("pau", 0.0, 0.1, None),
                    phone("hh", 0.1, 0.2, Some(0)),
                    phone("ay", 0.2, 0.5, Some(0)),
                    phone("y", 0.5, 0.6, Some(1)),
                    phone("uw", 0.6, 1.0, Some(1)),
                ],
            }],
        }
    }

    fn round_trip(bundle: &Bundle) -> Result<Bundle, BundleError> {
        Bundle::from_json(serde_json::to_string(bundle).unwrap_or_default().as_bytes())
    }

    #[test]
    fn what_is_written_is_read_again() {
        assert_eq!(round_trip(&sample()).ok(), Some(sample()));
    }

    #[test]
    fn words_are_found_by_time_and_gaps_are_silent() {
        let u = &sample().utterances[0];
        assert_eq!(u.word_at(0.05), None);
        assert_eq!(u.word_at(0.1), Some(0));
        assert_eq!(u.word_at(0.45), None);
        assert_eq!(u.word_at(0.8), Some(1));
        assert_eq!(u.phone_at(0.25), Some(2));
    }

    #[test]
    fn files_outside_the_folder_and_impossible_times_are_refused() {
        for bad in ["../u.opus", "/etc/passwd", "a/b.opus", "", ".hidden"] {
            let mut b = sample();
            bad.clone_into(&mut b.utterances[0].audio[0].file);
            assert!(
                matches!(round_trip(&b), Err(BundleError::Invalid { .. })),
                "{bad}"
            );
        }
        let mut b = sample();
        b.utterances[0].words[1].start_secs = 0.2;
        assert!(round_trip(&b).is_err());
        let mut b = sample();
        b.utterances[0].phones[1].word = Some(9);
        assert!(round_trip(&b).is_err());
        let mut b = sample();
        b.version = 2;
        assert!(matches!(round_trip(&b), Err(BundleError::Version { .. })));
    }

    #[test]
    fn a_fault_of_the_json_names_what_is_wrong_and_where() {
        let fault = |json: &str| Bundle::from_json(json.as_bytes()).unwrap_err().to_string();
        assert_eq!(
            fault("not json"),
            "the speech bundle cannot be read: expected a value at line 1 column 1"
        );
        assert_eq!(
            fault("{\"format\": \"raconteur-speech\",\n \"version\": \"1\"}"),
            "the speech bundle cannot be read: `version` has another type at line 2 column 13"
        );
        let whole = serde_json::to_string(&sample()).unwrap();
        assert_eq!(
            fault(&whole.replace("\"mime\"", "\"kind\"")),
            "the speech bundle cannot be read: `mime` is missing at line 1 column 184"
        );
    }
}
