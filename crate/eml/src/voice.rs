//! Spoken text with its breaks and time markers (GEVH D.4).

use crate::Span;
use crate::clauses::speech::{Audio, Boundary, Markup};
use std::borrow::Cow;

/// SABLE's level of text that nobody emphasised.
pub(crate) const NO_EMPHASIS: f64 = 0.5;
/// SABLE's `moderate`: from here on a word counts as emphasised.
pub(crate) const MODERATE_EMPHASIS: f64 = 1.0;

/// The content of a voice-text in document order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VoiceText {
    /// What it consists of.
    pub pieces: Vec<Piece>,
}

/// A part of spoken text.
#[derive(Clone, Debug, PartialEq)]
pub enum Piece {
    /// Characters. They equal the source under `span`, unless that is one resolved
    /// reference such as `&amp;`.
    Text {
        /// The characters.
        text: String,
        /// SABLE's emphasis level: 0 reduced, 0.5 none, 1 moderate, 2 strong.
        emphasis: f64,
        /// Where they are.
        span: Span,
    },
    /// A pause.
    Break {
        /// Its length in milliseconds; 0 asks for no pause at all.
        msec: u32,
        /// The punctuation mark whose intonation goes before it.
        boundary: Option<Boundary>,
        /// The element.
        span: Span,
    },
    /// A recording.
    Audio {
        /// What is played.
        audio: Box<Audio>,
        /// The element.
        span: Span,
    },
    /// A marker of SABLE's: tells listeners when the next word begins (extension).
    Marker {
        /// What they are told.
        mark: String,
        /// The element.
        span: Span,
    },
    /// A container other than a division opens.
    Start {
        /// What it does.
        markup: Box<Markup>,
        /// The start tag.
        span: Span,
    },
    /// The last opened container that is no division closes.
    End,
    /// A division opens.
    DivStart {
        /// What it is, when it says so.
        kind: Option<DivKind>,
        /// The start tag.
        span: Span,
    },
    /// The last opened division closes.
    DivEnd,
    /// A time marker: names a moment of the next word.
    Mark {
        /// The name.
        name: String,
        /// Which moment.
        event: MarkEvent,
        /// The element.
        span: Span,
    },
}

/// What a division is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DivKind {
    /// One sentence.
    Sentence,
    /// One paragraph.
    Paragraph,
}

/// The moment of a word that a marker names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MarkEvent {
    /// The start of the word.
    OnStart,
    /// The end of the word.
    OnEnd,
    /// The start of the first phone with this symbol in the word.
    OnPhone(String),
}

/// A spoken word: a token between white space that holds a letter or a digit.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    /// The token, punctuation attached.
    pub text: String,
    /// From its first to its last byte in the source; markup inside is included.
    pub span: Span,
    /// Whether any part of it is emphasised at least moderately.
    pub emphasized: bool,
}

/// A time marker and the word it belongs to.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// The name.
    pub name: String,
    /// Which moment of the word.
    pub event: MarkEvent,
    /// Index of the next word, or the number of words when none follows.
    pub word: usize,
    /// The element.
    pub span: Span,
}

impl VoiceText {
    /// The spoken words in order. Breaks, recordings and divisions end a word, other markup and
    /// comments do not.
    #[must_use]
    pub fn words(&self) -> Vec<Word> {
        let mut words = Vec::new();
        self.scan(|item| {
            if let Item::Word(token) = item {
                let Token {
                    text,
                    span,
                    emphasized,
                    ..
                } = token;
                words.push(Word {
                    text: text.into_owned(),
                    span,
                    emphasized,
                });
            }
        });
        words
    }

    /// The time markers in order, each with its word.
    #[must_use]
    pub fn marks(&self) -> Vec<Mark> {
        let mut marks = Vec::new();
        if self.has_marks() {
            self.scan(|item| {
                if let Item::Mark(mark) = item {
                    marks.push(mark);
                }
            });
        }
        marks
    }

    /// The text with every run of white space as one space, markup left out.
    #[must_use]
    pub fn plain_text(&self) -> String {
        let mut out = String::new();
        let mut gap = false;
        for piece in &self.pieces {
            match piece {
                Piece::Text { text, .. } => {
                    for c in text.chars() {
                        if u8::try_from(c).is_ok_and(is_space) {
                            gap = true;
                        } else {
                            if gap && !out.is_empty() {
                                out.push(' ');
                            }
                            gap = false;
                            out.push(c);
                        }
                    }
                }
                Piece::Break { .. }
                | Piece::Audio { .. }
                | Piece::DivStart { .. }
                | Piece::DivEnd => gap = true,
                Piece::Mark { .. } | Piece::Marker { .. } | Piece::Start { .. } | Piece::End => {}
            }
        }
        out
    }

    /// Whether it has time markers.
    #[must_use]
    pub fn has_marks(&self) -> bool {
        self.pieces.iter().any(|p| matches!(p, Piece::Mark { .. }))
    }

    /// Whether there is a word in it.
    pub(crate) fn has_words(&self) -> bool {
        self.pieces.iter().any(|p| match p {
            Piece::Text { text, .. } => text.contains(char::is_alphanumeric),
            _ => false,
        })
    }

    /// Goes through words and markers in order. A marker waits for the next letter or
    /// digit, be it in the middle of a token.
    pub(crate) fn scan<'v>(&'v self, mut visit: impl FnMut(Item<'v>)) {
        let mut token = Token::default();
        let mut words = 0;
        let mut waiting: Vec<Mark> = Vec::new();
        for piece in &self.pieces {
            match piece {
                Piece::Text {
                    text,
                    emphasis,
                    span,
                } => {
                    let verbatim = text.len() == (span.end - span.start) as usize;
                    let mut rest = text.as_str();
                    while !rest.is_empty() {
                        let length = rest.bytes().position(is_space).unwrap_or(rest.len());
                        if length > 0 {
                            let start = span.start as usize + (text.len() - rest.len());
                            let span = if verbatim {
                                Span::of(start, start + length)
                            } else {
                                *span
                            };
                            token.add(&rest[..length], span, *emphasis);
                            if token.spoken {
                                waiting.drain(..).for_each(|mut mark| {
                                    mark.word = words;
                                    visit(Item::Mark(mark));
                                });
                            }
                        }
                        rest = &rest[length..];
                        if !rest.is_empty() {
                            token.finish(&mut words, &mut visit);
                            rest = &rest[rest
                                .bytes()
                                .position(|b| !is_space(b))
                                .unwrap_or(rest.len())..];
                        }
                    }
                }
                Piece::Mark { name, event, span } => {
                    waiting.push(Mark {
                        name: name.clone(),
                        event: event.clone(),
                        word: 0,
                        span: *span,
                    });
                }
                Piece::Break { .. }
                | Piece::Audio { .. }
                | Piece::DivStart { .. }
                | Piece::DivEnd => {
                    token.finish(&mut words, &mut visit);
                }
                Piece::Marker { .. } | Piece::Start { .. } | Piece::End => {}
            }
        }
        token.finish(&mut words, &mut visit);
        waiting.into_iter().for_each(|mut mark| {
            mark.word = words;
            visit(Item::Mark(mark));
        });
    }
}

/// XML's white space. A no-break space joins.
fn is_space(b: u8) -> bool {
    matches!(b, b' ' | b'\t' | b'\n' | b'\r')
}

/// What a spoken text consists of for those who time it.
pub(crate) enum Item<'v> {
    Word(Token<'v>),
    Mark(Mark),
}

/// What stands between white space.
#[derive(Default)]
pub(crate) struct Token<'v> {
    /// Copied only when markup cuts it in pieces.
    pub(crate) text: Cow<'v, str>,
    pub(crate) span: Span,
    emphasized: bool,
    /// Whether it holds a letter or a digit.
    has_letter: bool,
    /// Whether the part added last does.
    spoken: bool,
}

impl<'v> Token<'v> {
    fn add(&mut self, part: &'v str, span: Span, emphasis: f64) {
        self.span = if self.text.is_empty() {
            span
        } else {
            self.span.to(span)
        };
        if self.text.is_empty() {
            self.text = Cow::Borrowed(part);
        } else {
            self.text.to_mut().push_str(part);
        }
        self.spoken = part.contains(char::is_alphanumeric);
        self.has_letter |= self.spoken;
        self.emphasized |= self.spoken && emphasis >= MODERATE_EMPHASIS;
    }

    fn finish(&mut self, words: &mut usize, visit: &mut impl FnMut(Item<'v>)) {
        let token = std::mem::take(self);
        if token.has_letter {
            *words += 1;
            visit(Item::Word(token));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ClauseKind, parse};

    fn voice(source: &str) -> VoiceText {
        let parsed = parse(source);
        match parsed.document.clauses.into_iter().next().map(|c| c.kind) {
            Some(ClauseKind::VoiceText(text)) => text,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn words_point_into_the_source() {
        let source = "<eml><body><voice-text time='0'>\n Hello, <emph>w&#246;rld!</emph> \u{2014} \
                      it<!-- x -->'s 42.<break/>So<div>me</div></voice-text></body></eml>";
        let words = voice(source).words();
        let texts: Vec<&str> = words.iter().map(|w| w.text.as_str()).collect();
        assert_eq!(texts, ["Hello,", "w\u{f6}rld!", "it's", "42.", "So", "me"]);
        let sources: Vec<&str> = words.iter().map(|w| w.span.slice(source)).collect();
        assert_eq!(
            sources,
            ["Hello,", "w&#246;rld!", "it<!-- x -->'s", "42.", "So", "me"]
        );
    }

    #[test]
    fn a_marker_inside_a_token_belongs_to_what_follows_it() {
        let source = "<eml><body><voice-text time='0'>he<tm name='a'/>llo<tm name='b'/>! <tm \
                      name='c'/>- you<tm name='d'/></voice-text></body></eml>";
        let marks = voice(source).marks();
        let words: Vec<_> = marks.iter().map(|m| (m.name.as_str(), m.word)).collect();
        assert_eq!(words, [("a", 0), ("b", 1), ("c", 1), ("d", 2)]);
    }

    #[test]
    fn plain_text_has_single_spaces() {
        let source = "<eml><body><voice-text time='0'> a\n\n<emph>b</emph>c <break/>d<tm \
                      name='x'/>e </voice-text></body></eml>";
        assert_eq!(voice(source).plain_text(), "a bc de");
    }
}
