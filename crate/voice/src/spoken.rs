//! Interface between the baker and its engines: a sentence to be spoken, and the engine's result.

use raconteur_speech::bundle::SentenceKind;

/// Sentence as input of a speech engine, spoken in one pass by one voice.
#[derive(Clone, Debug, PartialEq)]
pub struct Sentence {
    /// Tokens of the sentence; at least one.
    pub tokens: Vec<Token>,
    /// Type of the sentence.
    pub kind: SentenceKind,
    /// BCP 47 tag of its language.
    pub language: String,
    /// Speech rate, for engines that apply it themselves; 1 is the voice's own.
    pub pace: f64,
}

impl Default for Sentence {
    fn default() -> Self {
        Self {
            tokens: Vec::new(),
            kind: SentenceKind::default(),
            language: String::new(),
            pace: 1.0,
        }
    }
}

/// Token of a sentence, read by a speech engine as one word.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Token {
    /// Index of the written word that it belongs to.
    pub word: usize,
    /// Letters of any alphabet, apostrophes and hyphens; at most 40 characters.
    pub text: String,
    /// Pronunciation in the International Phonetic Alphabet, if given by the author.
    pub ipa: Option<String>,
    /// Punctuation after it, of `,.;:!?`; may be empty.
    pub punctuation: String,
    /// SABLE emphasis level: 0 reduced, 0.5 none, 1 moderate, 2 strong.
    pub emphasis: f64,
    /// True if the author requests a pause after it; the baker sets its length, the engine only has
    /// to separate the phrases there.
    pub pause: bool,
    /// Index of its [`crate::style::Style`] in the plan.
    pub style: usize,
}

/// Audio of a sentence with its phones and syllables, as returned by a speech engine.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spoken {
    /// Mono, −1 to 1.
    pub samples: Vec<f64>,
    /// Sample rate, Hz.
    pub rate_hz: f64,
    /// Phone set of the segments, one of [`raconteur_speech::phones::PHONE_SETS`].
    pub phone_set: String,
    /// Phones in order, without gaps; the first begins at 0. The last ends with the audio, within
    /// 50 ms.
    pub segments: Vec<Segment>,
    /// Syllables in order.
    pub syllables: Vec<SpokenSyllable>,
    /// Ends of intonational phrases: index of the last token and, if the engine reports it, the
    /// boundary tone in ToBI.
    pub breaks: Vec<(usize, String)>,
}

/// Phone of a sentence, with its time as reported by the engine.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Segment {
    /// Symbol; [`raconteur_speech::bundle::SILENCE`] is silence.
    pub symbol: String,
    /// Seconds from the start of the sentence.
    pub end_secs: f64,
    /// Index of its token in the sentence; `None` for silence.
    pub token: Option<usize>,
}

/// Syllable of a sentence as reported by the engine, a run of segments.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpokenSyllable {
    /// Index of its first segment.
    pub first: usize,
    /// Number of segments.
    pub count: usize,
    /// Stress: 0 none, 1 primary, 2 secondary.
    pub stress: u8,
    /// Pitch accent in ToBI, `*` if its type is unknown, empty if there is none.
    pub accent: String,
}

impl Segment {
    /// Returns true if the segment is silence.
    #[must_use]
    pub fn is_silent(&self) -> bool {
        self.symbol == raconteur_speech::bundle::SILENCE
    }
}
