//! Spoken text with its breaks and time markers (GEVH D.4).

mod scan;

use self::scan::is_space;
pub(crate) use self::scan::{Item, is_letter};
use crate::clauses::speech::{Audio, Boundary, Markup, UtteranceKind, VoiceSay};
use crate::{Name, Span};
use raconteur_base::text::signs::DisplayedWords;
use std::ops::ControlFlow;

/// SABLE's level of text without emphasis.
pub(crate) const NO_EMPHASIS: f64 = 0.5;
/// SABLE's `moderate`: from here on a word counts as emphasised.
pub(crate) const MODERATE_EMPHASIS: f64 = 1.0;

/// Spoken text of a clause as segments in document order: text, breaks, audio, markup and time
/// markers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VoiceText {
    /// Segments of the text.
    pub pieces: Vec<TextSegment>,
}

impl VoiceSay {
    /// Returns the spoken text; empty if the content is a file or a SABLE document.
    #[must_use]
    pub fn text(&self) -> VoiceText {
        let mut pieces = Vec::new();
        if !self.is_file() && self.kind == UtteranceKind::Text {
            pieces.push(TextSegment::Text {
                text: self.content.as_str().into(),
                emphasis: NO_EMPHASIS,
                span: self.content_span,
            });
        }
        VoiceText { pieces }
    }

    /// Returns the audible text: [`VoiceSay::text`], if anything is audible.
    #[must_use]
    pub fn spoken_text(&self) -> Option<VoiceText> {
        self.is_heard().then(|| self.text())
    }
}

/// Segment of a spoken text: text, break, recording, markup or time marker.
#[derive(Clone, Debug, PartialEq)]
pub enum TextSegment {
    /// Characters. They equal the source under `span`, unless it is one resolved reference such as
    /// `&amp;`.
    Text {
        /// The characters.
        text: Name,
        /// SABLE's emphasis level: 0 reduced, 0.5 none, 1 moderate, 2 strong.
        emphasis: f64,
        /// Span in the source.
        span: Span,
    },
    /// A pause.
    Break {
        /// Length in milliseconds; 0 requests no pause at all.
        msec: u32,
        /// Punctuation mark whose intonation precedes it.
        boundary: Option<Boundary>,
        /// The element.
        span: Span,
    },
    /// A recording.
    Audio {
        /// Recording to play.
        audio: Box<Audio>,
        /// The element.
        span: Span,
    },
    /// A SABLE marker: notifies listeners when the next word begins (extension).
    Marker {
        /// Their instruction.
        mark: String,
        /// The element.
        span: Span,
    },
    /// A container other than a division opens.
    Start {
        /// Effect of the markup.
        markup: Box<Markup>,
        /// The start tag.
        span: Span,
    },
    /// The last opened container that is no division closes.
    End,
    /// A division opens.
    DivStart {
        /// Kind of the division, if given.
        kind: Option<DivKind>,
        /// The start tag.
        span: Span,
    },
    /// The last opened division closes.
    DivEnd,
    /// A time marker: names an event of the next word.
    Mark {
        /// The name.
        name: Name,
        /// Event of the word.
        event: MarkEvent,
        /// The element.
        span: Span,
    },
}

/// Kind of a text division: sentence or paragraph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DivKind {
    /// Division that is one sentence.
    Sentence,
    /// Division that is one paragraph.
    Paragraph,
}

/// Event of a word that a time marker refers to: start, end or a phone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MarkEvent {
    /// The start of the word.
    OnStart,
    /// The end of the word.
    OnEnd,
    /// The start of the first phone with this symbol in the word. Rare, so it is boxed to keep all
    /// segments smaller.
    OnPhone(Box<Name>),
}

/// Spoken word: a token between white space that contains a letter or a digit and is not an
/// emoticon.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    /// Text in captions: the token, punctuation attached, without emoji, and with the separate
    /// signs that belong to it: "5 %".
    pub text: String,
    /// Span from the first to the last byte of the word in the source, including markup inside it.
    pub span: Span,
    /// True if any part of it is emphasised at least moderately.
    pub emphasized: bool,
}

/// Time marker in a spoken text, with the word that it belongs to.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Name of the marker, used in time expressions.
    pub name: Name,
    /// Event of the word.
    pub event: MarkEvent,
    /// Index of the next word, or the number of words if none follows.
    pub word: usize,
    /// Span of the marker element.
    pub span: Span,
}

impl VoiceText {
    /// Returns the spoken words in order. Breaks, recordings and divisions end a word; other markup
    /// and comments do not.
    #[must_use]
    pub fn words(&self) -> Vec<Word> {
        let mut words: Vec<Word> = Vec::new();
        let mut shown = DisplayedWords::default();
        let _ = self.scan(&mut |item| {
            match item {
                Item::Word(token) => {
                    shown.word(&token.spoken_text());
                    words.push(Word {
                        text: String::new(),
                        span: token.span,
                        emphasized: token.emphasized,
                    });
                }
                Item::Signs(signs) => shown.sign(signs),
                Item::Emoticon { parts, rest, .. } => {
                    shown.remove_last(parts);
                    if !rest.is_empty() {
                        shown.sign(rest);
                    }
                }
                Item::Gap => shown.separate(),
                Item::Mark(_) => {}
            }
            ControlFlow::Continue(())
        });
        for (word, text) in words.iter_mut().zip(shown.finish()) {
            word.text = text;
        }
        words
    }

    /// Returns the time markers in order, each with its word.
    #[must_use]
    pub fn marks(&self) -> Vec<Mark> {
        let mut marks = Vec::new();
        self.each_mark(&mut |mark| marks.push(mark));
        marks
    }

    /// Shows the time markers in order, each with its word; reads no further than the last.
    pub(crate) fn each_mark(&self, visit: &mut dyn FnMut(Mark)) {
        let is_mark = |piece: &&TextSegment| matches!(piece, TextSegment::Mark { .. });
        let mut left = self.pieces.iter().filter(is_mark).count();
        if left == 0 {
            return;
        }
        let _ = self.scan(&mut |item| {
            if let Item::Mark(mark) = item {
                visit(mark);
                left -= 1;
            }
            if left == 0 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
    }

    /// Returns the text without markup, with every run of white space as one space.
    #[must_use]
    pub fn plain_text(&self) -> String {
        let mut out = String::new();
        let mut gap = false;
        for piece in &self.pieces {
            match piece {
                TextSegment::Text { text, .. } => {
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
                TextSegment::Break { .. }
                | TextSegment::Audio { .. }
                | TextSegment::DivStart { .. }
                | TextSegment::DivEnd => gap = true,
                TextSegment::Mark { .. }
                | TextSegment::Marker { .. }
                | TextSegment::Start { .. }
                | TextSegment::End => {}
            }
        }
        out
    }

    /// Returns true if the text contains time markers.
    #[must_use]
    pub fn has_marks(&self) -> bool {
        self.pieces
            .iter()
            .any(|p| matches!(p, TextSegment::Mark { .. }))
    }

    /// Returns true if the text contains a word.
    #[must_use]
    pub fn has_words(&self) -> bool {
        self.pieces.iter().any(|p| match p {
            TextSegment::Text { text, .. } => has_letter(text),
            _ => false,
        })
    }
}

/// Returns true if a text contains a letter or a digit.
fn has_letter(text: &str) -> bool {
    text.bytes().any(is_letter) || (!text.is_ascii() && text.contains(char::is_alphanumeric))
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
        assert_eq!(
            texts,
            ["Hello,", "w\u{f6}rld!", "\u{2014} it's", "42.", "So", "me"]
        );
        let sources: Vec<&str> = words.iter().map(|w| w.span.slice(source)).collect();
        assert_eq!(
            sources,
            ["Hello,", "w&#246;rld!", "it<!-- x -->'s", "42.", "So", "me"]
        );
    }

    #[test]
    fn emoticons_are_no_words() {
        let source = "<eml><body><voice-text time='0'>nicht :-o irdisch ;-) mehr o :-) \
                      :-oh : - o :- o :-O : o</voice-text></body></eml>";
        let words = voice(source).words();
        let texts: Vec<&str> = words.iter().map(|w| w.text.as_str()).collect();
        assert_eq!(texts, ["nicht", "irdisch", "mehr", "o", ":-oh :", "o"]);
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
