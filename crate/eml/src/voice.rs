//! Spoken text with its breaks and time markers (GEVH D.4).

use crate::clauses::speech::{Audio, Boundary, Markup, UtteranceKind, VoiceSay};
use crate::emoticon::{self, Spaced};
use crate::work::step;
use crate::{Name, Span};
use raconteur_base::text::signs::Shown;
use std::ops::ControlFlow;

/// SABLE's level of text without emphasis.
pub(crate) const NO_EMPHASIS: f64 = 0.5;
/// SABLE's `moderate`: from here on a word counts as emphasised.
pub(crate) const MODERATE_EMPHASIS: f64 = 1.0;

/// The content of a voice-text in document order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VoiceText {
    /// What it consists of.
    pub pieces: Vec<TextSegment>,
}

impl VoiceSay {
    /// Its text; empty when it is a file or a document of SABLE.
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

    /// What is heard: [`VoiceSay::text`], if anything is.
    #[must_use]
    pub fn spoken(&self) -> Option<VoiceText> {
        self.is_heard().then(|| self.text())
    }
}

/// A part of spoken text.
#[derive(Clone, Debug, PartialEq)]
pub enum TextSegment {
    /// Characters. They equal the source under `span`, unless that is one resolved
    /// reference such as `&amp;`.
    Text {
        /// The characters.
        text: Name,
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
        /// Their instruction.
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
        name: Name,
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
    /// The start of the first phone with this symbol in the word. Rare, so that it lies
    /// apart and leaves all pieces of speech smaller.
    OnPhone(Box<Name>),
}

/// A spoken word: a token between white space that holds a letter or a digit and is no emoticon.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    /// The token, punctuation attached, without emoji, and with the signs on their own that
    /// belong to it: "5 %". What captions show.
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
    pub name: Name,
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
        let mut words: Vec<Word> = Vec::new();
        let mut shown = Shown::default();
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
                    shown.take_back(parts);
                    if !rest.is_empty() {
                        shown.sign(rest);
                    }
                }
                Item::Gap => shown.part(),
                Item::Mark(_) => {}
            }
            ControlFlow::Continue(())
        });
        for (word, text) in words.iter_mut().zip(shown.finish()) {
            word.text = text;
        }
        words
    }

    /// The time markers in order, each with its word.
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

    /// The text with every run of white space as one space, markup left out.
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

    /// Whether it has time markers.
    #[must_use]
    pub fn has_marks(&self) -> bool {
        self.pieces
            .iter()
            .any(|p| matches!(p, TextSegment::Mark { .. }))
    }

    /// Whether there is a word in it.
    #[must_use]
    pub fn has_words(&self) -> bool {
        self.pieces.iter().any(|p| match p {
            TextSegment::Text { text, .. } => has_letter(text),
            _ => false,
        })
    }

    /// Goes through words and markers in order, as long as `visit` wants. A marker waits
    /// for the next letter or digit, be it in the middle of a token.
    pub(crate) fn scan<'v>(&'v self, visit: &mut Visit<'v, '_>) -> ControlFlow<()> {
        let mut token = Token::default();
        let mut words = 0;
        // The markers from this piece on wait, when there are any.
        let mut waiting: Option<usize> = None;
        for (place, piece) in self.pieces.iter().enumerate() {
            match piece {
                TextSegment::Text {
                    text,
                    emphasis,
                    span,
                } => {
                    let verbatim = text.len() == (span.end - span.start) as usize;
                    let bytes = text.as_bytes();
                    step(bytes.len());
                    let mut at = 0;
                    while at < bytes.len() {
                        let start = at;
                        let (mut letters, mut all, mut ends) = (0, 0, false);
                        while let Some(&b) = bytes.get(at) {
                            let class = CLASS[usize::from(b)];
                            if class == SPACE {
                                ends = true;
                                break;
                            }
                            letters += usize::from(class);
                            all |= b;
                            at += 1;
                        }
                        if at > start {
                            let part = &text[start..at];
                            if !all.is_ascii() {
                                letters = part.chars().filter(|c| c.is_alphanumeric()).count();
                            }
                            let first = span.start as usize;
                            let span = if verbatim {
                                Span::of(first + start, first + at)
                            } else {
                                *span
                            };
                            token.add(part, span, letters, *emphasis);
                            if letters > 0
                                && let Some(from) = waiting.take()
                            {
                                pass_marks(&self.pieces[from..place], words, visit)?;
                            }
                        }
                        if ends {
                            token.finish(&mut words, visit)?;
                            at += 1;
                        }
                    }
                }
                TextSegment::Mark { .. } => {
                    waiting.get_or_insert(place);
                }
                TextSegment::Break { .. }
                | TextSegment::Audio { .. }
                | TextSegment::DivStart { .. }
                | TextSegment::DivEnd => {
                    token.finish(&mut words, visit)?;
                    token.spaced.part();
                    visit(Item::Gap)?;
                }
                TextSegment::Marker { .. } | TextSegment::Start { .. } | TextSegment::End => {}
            }
        }
        token.finish(&mut words, visit)?;
        let from = waiting.unwrap_or(self.pieces.len());
        pass_marks(&self.pieces[from..], words, visit)
    }
}

/// Hands on the markers among some pieces, which have found their word.
fn pass_marks<'v>(
    pieces: &'v [TextSegment],
    word: usize,
    visit: &mut Visit<'v, '_>,
) -> ControlFlow<()> {
    for piece in pieces {
        if let TextSegment::Mark { name, event, span } = piece {
            visit(Item::Mark(Mark {
                name: name.clone(),
                event: event.clone(),
                word,
                span: *span,
            }))?;
        }
    }
    ControlFlow::Continue(())
}

/// Whether a text holds a letter or a digit.
fn has_letter(text: &str) -> bool {
    text.bytes().any(is_letter) || (!text.is_ascii() && text.contains(char::is_alphanumeric))
}

/// Whether a byte is an ASCII letter or digit.
pub(crate) fn is_letter(b: u8) -> bool {
    CLASS[usize::from(b)] == LETTER
}

/// The class of ASCII letters and digits; 1, so that adding classes counts them.
const LETTER: u8 = 1;
/// The class of white space.
const SPACE: u8 = 2;

/// The class of every byte: [`LETTER`], [`SPACE`] or 0.
static CLASS: [u8; 256] = {
    let mut table = [0; 256];
    let mut b = 0;
    while b < table.len() {
        if (b as u8).is_ascii_alphanumeric() {
            table[b] = LETTER;
        } else if is_space(b as u8) {
            table[b] = SPACE;
        }
        b += 1;
    }
    table
};

/// XML's white space. A no-break space joins.
const fn is_space(b: u8) -> bool {
    matches!(b, b' ' | b'\t' | b'\n' | b'\r')
}

/// What a spoken text consists of for those who time it and those who feel it.
pub(crate) enum Item<'i, 'v> {
    Word(&'i Token<'v>),
    Mark(Mark),
    /// A token without a letter or a digit, emoji aside.
    Signs(&'i str),
    /// An emoticon or an emoji.
    Emoticon {
        /// The word of its emotion.
        name: &'static str,
        /// How many items of signs before it belong to it.
        parts: usize,
        /// Punctuation right behind it.
        rest: &'i str,
    },
    /// A pause, a recording, or the border of a division.
    Gap,
}

/// Takes what a spoken text consists of, until it has had enough.
pub(crate) type Visit<'v, 'c> = dyn FnMut(Item<'_, 'v>) -> ControlFlow<()> + 'c;

/// What stands between white space.
#[derive(Default)]
pub(crate) struct Token<'v> {
    /// Up to the first markup in it.
    first: &'v str,
    /// All of it, when there is markup in it.
    whole: String,
    pub(crate) span: Span,
    /// How many letters and digits it holds.
    pub(crate) letters: usize,
    emphasized: bool,
    /// What before it may be of an emoticon with it.
    spaced: Spaced,
}

impl<'v> Token<'v> {
    /// The token without markup.
    pub(crate) fn text(&self) -> &str {
        if self.whole.is_empty() {
            self.first
        } else {
            &self.whole
        }
    }

    /// The token as it is spoken and captioned: without markup and emoji.
    pub(crate) fn spoken_text(&self) -> String {
        let text = self.text();
        emoticon::without_emoji(text).unwrap_or_else(|| text.to_owned())
    }

    fn add(&mut self, part: &'v str, span: Span, letters: usize, emphasis: f64) {
        if self.first.is_empty() {
            self.first = part;
            self.span = span;
        } else {
            if self.whole.is_empty() {
                self.whole.push_str(self.first);
            }
            self.whole.push_str(part);
            self.span = self.span.to(span);
        }
        self.letters += letters;
        self.emphasized |= letters > 0 && emphasis >= MODERATE_EMPHASIS;
    }

    fn finish(&mut self, words: &mut usize, visit: &mut Visit<'v, '_>) -> ControlFlow<()> {
        if self.first.is_empty() {
            return ControlFlow::Continue(());
        }
        let flow = self.hand_on(words, visit);
        self.first = "";
        self.whole.clear();
        self.letters = 0;
        self.emphasized = false;
        flow
    }

    fn hand_on(&mut self, words: &mut usize, visit: &mut Visit<'v, '_>) -> ControlFlow<()> {
        // No emoticon holds more than one letter.
        if self.letters > 1 {
            self.spaced.part();
        } else {
            let mut spaced = core::mem::take(&mut self.spaced);
            let sign = match emoticon::whole(self.text()) {
                Some((name, rest)) => Some((0, name, rest)),
                None => spaced
                    .take(self.text(), self.letters > 0)
                    .map(|(parts, name)| (parts, name, "")),
            };
            if let Some((parts, name, rest)) = sign {
                // Nothing before it belongs to what follows.
                return visit(Item::Emoticon { name, parts, rest });
            }
            self.spaced = spaced;
        }
        let is_ascii = self.text().is_ascii();
        let [before, after] = if is_ascii {
            [const { Vec::new() }; 2]
        } else {
            emoticon::of_emoji(self.text())
        };
        let mut tell = |names: &[&'static str]| {
            names.iter().try_for_each(|name| {
                visit(Item::Emoticon {
                    name,
                    parts: 0,
                    rest: "",
                })
            })
        };
        tell(&before)?;
        if self.letters > 0 {
            *words += 1;
            visit(Item::Word(self))?;
            return after.iter().try_for_each(|name| {
                visit(Item::Emoticon {
                    name,
                    parts: 0,
                    rest: "",
                })
            });
        }
        match emoticon::without_emoji(self.text()) {
            Some(rest) if rest.is_empty() => ControlFlow::Continue(()),
            Some(rest) => visit(Item::Signs(&rest)),
            None => visit(Item::Signs(self.text())),
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
