//! Reads a bundle. Times are told as lengths of phones, and words as phones, so that they
//! tile the utterance whatever a file says.

use raconteur_base::json::{Fault, Json};

use super::{AudioFile, Bundle, Phone, SILENCE, Utterance, VERSION, Voice, Word};

/// Why a bundle was refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BundleError {
    /// The file is not JSON of the right shape.
    #[error("the speech bundle cannot be read: {0}")]
    Json(#[from] Fault),
    /// Another format or another version.
    #[error(
        "the speech bundle is {format} version {version}; this program reads raconteur-speech version 2"
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
    /// Reads and checks a bundle. Unknown members are ignored.
    ///
    /// # Errors
    /// When the text is not a bundle, has another version, or holds impossible times or
    /// file names that leave the folder.
    pub fn from_json(json: &[u8]) -> Result<Self, BundleError> {
        Self::read_with(json, true)
    }

    /// As [`Bundle::from_json`], but without the melody of its utterances where that is not wanted.
    ///
    /// # Errors
    /// As those of [`Bundle::from_json`], but for the melody's.
    pub fn read_with(json: &[u8], melody: bool) -> Result<Self, BundleError> {
        let json = Json::read(json)?;
        let format = text(&json, "format")?;
        let version = field(&json, "version", |v| u32::try_from(v.whole()?).ok())?;
        if format != "raconteur-speech" || version != VERSION {
            return Err(BundleError::Version { format, version });
        }
        let mut bundle = Self {
            voices: list(&json, "voices", Voice::of)?,
            utterances: list(&json, "utterances", Utterance::of)?,
        };
        if melody {
            super::melody::read(&mut bundle.utterances, json.get("utterances").items())?;
        }
        for (utterance, u) in bundle.utterances.iter().enumerate() {
            u.check(bundle.voices.len())
                .map_err(|what| BundleError::Invalid { utterance, what })?;
        }
        Ok(bundle)
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

/// A digest of 16 hexadecimal digits.
fn digest(member: &Json<'_>) -> Option<u64> {
    let digits = member.text().filter(|digits| digits.len() == 16)?;
    u64::from_str_radix(digits, 16).ok()
}

fn text(object: &Json<'_>, name: &str) -> Result<String, Fault> {
    field(object, name, |v| v.text().map(str::to_owned))
}

fn index(object: &Json<'_>, name: &str) -> Result<usize, Fault> {
    field(object, name, Json::index)
}

fn list<'v, 'a, T>(
    object: &'v Json<'a>,
    name: &str,
    one: fn(&'v Json<'a>) -> Result<T, Fault>,
) -> Result<Vec<T>, Fault> {
    let items = field(object, name, |v| v.is_list().then_some(v.items()))?;
    items.iter().map(one).collect()
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
    fn of(json: &Json<'_>) -> Result<Self, Fault> {
        // A player needs not know who they are.
        #[cfg(feature = "bake")]
        let (engine, voice) = (text(json, "engine")?, text(json, "voice")?);
        #[cfg(not(feature = "bake"))]
        let (engine, voice) = Default::default();
        Ok(Self {
            engine,
            voice,
            language: text(json, "language")?,
            phone_set: text(json, "phone_set")?,
            mouth: pairs(json.get("mouth").text().unwrap_or_default()),
        })
    }
}

impl AudioFile {
    fn of(json: &Json<'_>) -> Result<Self, Fault> {
        Ok(Self {
            file: text(json, "file")?,
            mime: text(json, "mime")?,
            #[cfg(feature = "bake")]
            holds: super::Holds::of(json)?,
            #[cfg(not(feature = "bake"))]
            holds: None,
        })
    }
}

#[cfg(feature = "bake")]
impl super::Holds {
    /// Both members or neither.
    fn of(json: &Json<'_>) -> Result<Option<Self>, Fault> {
        if json.get("bytes").is_null() && json.get("sha256").is_null() {
            return Ok(None);
        }
        let is_digit = |b: u8| matches!(b, b'0'..=b'9' | b'a'..=b'f');
        let sha256 = text(json, "sha256")?;
        if sha256.len() != 64 || !sha256.bytes().all(is_digit) {
            return Err(json["sha256"].fault("this is no SHA-256 in small letters".to_owned()));
        }
        let bytes = field(json, "bytes", Json::whole)?;
        Ok(Some(Self { bytes, sha256 }))
    }
}
/// The longest phone or pause, milliseconds: ten times the longest pause that markup can ask for.
const LONGEST_PHONE_MSEC: u32 = 600_000;
/// The longest utterance, milliseconds: a day, as much as alignments may tell of.
const LONGEST_MSEC: f64 = 86_400_000.0;

/// Milliseconds as seconds.
pub(super) fn secs(msec: f64) -> f64 {
    msec / 1000.0
}

impl Utterance {
    fn of(json: &Json<'_>) -> Result<Self, Fault> {
        let mut utterance = Self {
            key: field(json, "key", digest)?,
            #[cfg(feature = "bake")]
            content: field(json, "content", digest)?,
            #[cfg(feature = "bake")]
            source: if json.get("source").is_null() {
                None
            } else {
                Some(field(json, "source", digest)?)
            },
            voice: index(json, "voice")?,
            text: text(json, "text")?,
            audio: list(json, "audio", AudioFile::of)?,
            ..Self::default()
        };
        utterance.read_phones(json)?;
        utterance.read_words(json)?;
        Ok(utterance)
    }

    fn read_phones(&mut self, json: &Json<'_>) -> Result<(), Fault> {
        let symbols = field(json, "phones", Json::text)?.split_ascii_whitespace();
        let lengths = list(json, "msecs", |v| {
            v.index()
                .and_then(|msec| u32::try_from(msec).ok())
                .ok_or_else(|| v.fault("this is no number of milliseconds".to_owned()))
        })?;
        let mut end_msec: f64 = 0.0;
        let mut lengths_left = lengths.iter();
        for symbol in symbols {
            let Some(&length) = lengths_left.next() else {
                return Err(json["msecs"].fault("there are more phones than lengths".to_owned()));
            };
            let start_secs = secs(end_msec);
            if length > LONGEST_PHONE_MSEC {
                return Err(json["msecs"].fault(format!(
                    "a phone or pause of {length} ms is longer than {LONGEST_PHONE_MSEC}"
                )));
            }
            end_msec += f64::from(length);
            if end_msec > LONGEST_MSEC {
                return Err(
                    json["msecs"].fault(format!("the utterance is longer than {LONGEST_MSEC} ms"))
                );
            }
            self.phones.push(Phone {
                symbol: symbol.to_owned(),
                start_secs,
                end_secs: secs(end_msec),
                word: None,
            });
        }
        if lengths_left.next().is_some() {
            return Err(json["msecs"].fault("there are more lengths than phones".to_owned()));
        }
        self.duration_secs = secs(end_msec);
        Ok(())
    }

    fn read_words(&mut self, json: &Json<'_>) -> Result<(), Fault> {
        // A word without a sound stands where the one before it ends.
        let mut silent_secs = 0.0;
        for row in field(json, "words", |v| v.is_list().then_some(v.items()))? {
            let none = |what: &str| row.fault(["a word ", what].concat());
            let numbers: Option<Vec<usize>> = row.items().iter().map(Json::index).collect();
            let Some([text_start, bytes, first, phones]) = numbers.as_deref() else {
                return Err(none("is not four numbers"));
            };
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
            });
            #[cfg(feature = "bake")]
            self.text_starts.push(*text_start);
        }
        Ok(())
    }
}
