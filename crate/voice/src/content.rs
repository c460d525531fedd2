//! Content to be spoken, independent of its markup language. SABLE, SSML and EML are all converted
//! to this; [`crate::style`] defines its meaning.

use crate::text::SayAs;

/// The content, in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Content {
    /// Texts, pauses, and openings and closings of markup.
    pub segments: Vec<Segment>,
}

/// Span or point of an utterance.
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
        /// Its path or address, as the author wrote it.
        src: String,
        /// It plays under the speech that follows instead of before it.
        background: bool,
        /// Its amplitude; 1 as recorded.
        level: f64,
    },
    /// Mark that sends an event to listeners.
    Mark(String),
    /// Start of markup, up to the matching [`Segment::Close`].
    Open(Markup),
    /// The last opened markup ends.
    Close,
}

/// The melody before a pause.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boundary {
    /// As after a question.
    Question,
    /// As after an exclamation.
    Exclamation,
    /// As after a statement.
    Statement,
    /// As when more is coming.
    Comma,
}

/// Unit separated by a division.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Division {
    /// Sentences.
    Sentence,
    /// Paragraphs.
    Paragraph,
}

/// Change of a property.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Setting {
    /// A factor on the value around it; changes inside each other multiply.
    Factor(f64),
    /// The value itself: hertz, words a minute, or amplitude.
    Value(f64),
    /// The voice's own value, regardless of the surroundings.
    Default,
}

/// Speech markup of its content.
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
        /// Its range around the middle; values are hertz from the lowest to the highest.
        range: Option<Setting>,
    },
    /// Pace; values are words a minute.
    Rate(Setting),
    /// Amplitude; values are gains.
    Volume(Setting),
    /// Pronunciation; one of them, or both.
    Pronunciation {
        /// In the International Phonetic Alphabet.
        ipa: Option<String>,
        /// In a spelling that sounds like it.
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
    /// In an emotion (F&H table 4.4), from −100 to 100 each.
    Emotion {
        /// Its word; may be empty.
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

/// Speaker properties given by a text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Speaker {
    /// Sex.
    pub gender: Option<Gender>,
    /// Age.
    pub age: Option<Age>,
    /// The voice's name.
    pub name: Option<String>,
}

/// A speaker's sex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gender {
    /// A man.
    Male,
    /// A woman.
    Female,
}

/// A speaker's age.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Age {
    /// Old.
    Older,
    /// In the middle of life.
    Middle,
    /// Young.
    Younger,
    /// Half grown.
    Teen,
    /// A child.
    Child,
}

impl Content {
    /// A text without any markup.
    #[must_use]
    pub fn plain(text: &str) -> Self {
        Self {
            segments: vec![Segment::Text(text.to_owned())],
        }
    }
}

/// XML's white space. A no-break space joins.
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
