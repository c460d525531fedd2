//! Content to be spoken, independent of its markup language. SABLE, SSML and EML are all converted
//! to this; [`crate::style`] defines its meaning.

use crate::text::SayAs;

/// Text of an utterance with its speech markup, as a sequence of segments.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Content {
    /// Texts, pauses, and openings and closings of markup.
    pub segments: Vec<Segment>,
}

/// Element of a content: text, a pause, a recording, or the start or end of markup.
#[derive(Clone, Debug, PartialEq)]
pub enum Segment {
    /// Characters; words may go on in the next text.
    Text(String),
    /// A pause.
    Break {
        /// Length, milliseconds; 0 requests no pause at all.
        msec: u32,
        /// Punctuation mark whose intonation precedes it.
        boundary: Option<Boundary>,
    },
    /// A sentence or a paragraph begins or ends.
    Division(Division),
    /// A recording.
    Audio {
        /// Path or URL as written by the author.
        src: String,
        /// True if the recording plays under the speech that follows; otherwise it plays before it.
        background: bool,
        /// Amplitude factor; 1 plays the recording unchanged.
        level: f64,
    },
    /// Mark that sends an event to listeners.
    Mark(String),
    /// Start of markup, up to the matching [`Segment::Close`].
    Open(Markup),
    /// The last opened markup ends.
    Close,
}

/// Intonation before a pause.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boundary {
    /// Intonation of a question.
    Question,
    /// Intonation of an exclamation.
    Exclamation,
    /// Intonation of a statement.
    Statement,
    /// Intonation of an incomplete phrase, as before a comma.
    Comma,
}

/// Unit of text whose boundary a division marks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Division {
    /// Sentences.
    Sentence,
    /// Paragraphs.
    Paragraph,
}

/// Change of a speech property by markup: a factor, an absolute value or the default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Setting {
    /// A factor on the value around it; changes inside each other multiply.
    Factor(f64),
    /// The value itself: hertz, words a minute, or amplitude.
    Value(f64),
    /// The voice's own value, regardless of the surroundings.
    Default,
}

/// Speech markup that applies to the content it encloses.
#[derive(Clone, Debug, PartialEq)]
pub enum Markup {
    /// Emphasis on SABLE's scale: 0 reduced, 0.5 none, 1 moderate, 2 strong.
    Emphasis(f64),
    /// Pitch; values are hertz.
    Pitch {
        /// Pitch base line: the value to which the intonation falls.
        base: Option<Setting>,
        /// The middle line: its mean.
        middle: Option<Setting>,
        /// Pitch range around the middle; values are hertz from the lowest to the highest.
        range: Option<Setting>,
    },
    /// Pace; values are words a minute.
    Rate(Setting),
    /// Amplitude; values are gains.
    Volume(Setting),
    /// Pronunciation; one of them, or both.
    Pronunciation {
        /// Pronunciation in the International Phonetic Alphabet.
        ipa: Option<String>,
        /// Respelling with the intended sound.
        sub: Option<String>,
        /// Language of origin.
        origin: Option<String>,
    },
    /// Type of the text.
    SayAs(SayAs),
    /// Language, a BCP 47 tag or a name such as `German`.
    Language(String),
    /// Speaker.
    Speaker(Speaker),
    /// Alternative text for one engine.
    Engine {
        /// The engine's name.
        id: String,
        /// Alternative text.
        data: String,
    },
    /// Emotion in which the content is spoken (F&H table 4.4); each dimension from −100 to 100.
    Emotion {
        /// Emotion word; may be empty.
        name: String,
        /// Passive to active.
        activation: f64,
        /// Negative to positive.
        evaluation: f64,
        /// Submissive to dominant.
        power: f64,
    },
    /// Unsupported markup, retained so that openings and closings match.
    Other,
}

/// Speaker that markup selects: the properties that its voice should have.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Speaker {
    /// Sex of the speaker; `None` if the text does not specify it.
    pub gender: Option<Gender>,
    /// Age of the speaker; `None` if the text does not specify it.
    pub age: Option<Age>,
    /// Name of the voice; `None` if the text does not specify it.
    pub name: Option<String>,
}

/// Sex of a speaker, used to select a voice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gender {
    /// A man.
    Male,
    /// A woman.
    Female,
}

/// Age of a speaker, used to select a voice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Age {
    /// Old.
    Older,
    /// Middle-aged speaker.
    Middle,
    /// Young.
    Younger,
    /// Adolescent speaker.
    Teen,
    /// A child.
    Child,
}

impl Content {
    /// Creates content from a text without markup.
    #[must_use]
    pub fn plain(text: &str) -> Self {
        Self {
            segments: vec![Segment::Text(text.to_owned())],
        }
    }
}

/// Returns true for the white space of XML. A no-break space joins words.
pub(crate) fn is_space(c: char) -> bool {
    matches!(c, ' ' | '\t' | '\n' | '\r')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_does_not_part_words_but_pauses_do() {
        let text = |t: &str| Segment::Text(t.to_owned());
        let pause = Segment::Break {
            msec: 100,
            boundary: None,
        };
        let content = Content {
            segments: vec![
                text(" un"),
                Segment::Open(Markup::Emphasis(1.0)),
                text("be"),
                Segment::Close,
                text("lievable\n \u{2013} stuff one"),
                pause,
                text("two :-o three"),
                Segment::Division(Division::Sentence),
                text("four"),
            ],
        };
        assert_eq!(
            content.words(),
            ["unbelievable", "stuff", "one", "two", "three", "four"]
        );
    }
}
