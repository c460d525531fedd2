//! Scanner of a spoken text: words, isolated signs, emoticons, markers and gaps.

use super::{MODERATE_EMPHASIS, Mark, TextSegment, VoiceText};
use crate::Span;
use crate::emoticon::{self, Spaced};
use crate::work::step;
use std::ops::ControlFlow;

impl VoiceText {
    /// Visits words and markers in order, until `visit` stops. A marker takes effect at the next
    /// letter or digit, even in the middle of a token.
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
                                Span::from_offsets(first + start, first + at)
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
                    token.spaced.separate();
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

/// Returns true if a byte is an ASCII letter or digit.
pub(crate) fn is_letter(b: u8) -> bool {
    CLASS[usize::from(b)] == LETTER
}

/// Class of ASCII letters and digits; 1, so adding classes counts them.
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

/// Returns true for XML white space. A no-break space is not included, since it joins words.
pub(super) const fn is_space(b: u8) -> bool {
    matches!(b, b' ' | b'\t' | b'\n' | b'\r')
}

/// Item found while scanning a spoken text: word, marker, signs, emoticon or gap.
pub(crate) enum Item<'i, 'v> {
    Word(&'i Token<'v>),
    Mark(Mark),
    /// A token without a letter or a digit, emoji aside.
    Signs(&'i str),
    /// An emoticon or an emoji.
    Emoticon {
        /// The word of its emotion.
        name: &'static str,
        /// Number of preceding sign items that belong to it.
        parts: usize,
        /// Punctuation right behind it.
        rest: &'i str,
    },
    /// A pause, a recording, or the border of a division.
    Gap,
}

/// Callback for the items of a spoken text; it may stop the scan.
pub(crate) type Visit<'v, 'c> = dyn FnMut(Item<'_, 'v>) -> ControlFlow<()> + 'c;

/// Token between white space in a spoken text; markup may divide it.
#[derive(Default)]
pub(crate) struct Token<'v> {
    /// Text of the token up to the first markup inside it.
    first: &'v str,
    /// Whole text of the token if it contains markup; otherwise empty.
    whole: String,
    pub(crate) span: Span,
    /// Number of letters and digits in it.
    pub(crate) letters: usize,
    pub(super) emphasized: bool,
    /// Preceding tokens that may form an emoticon with it.
    spaced: Spaced,
}

impl<'v> Token<'v> {
    /// Returns the text of the token without markup.
    pub(crate) fn text(&self) -> &str {
        if self.whole.is_empty() {
            self.first
        } else {
            &self.whole
        }
    }

    /// Returns the token as it is spoken and captioned: without markup and emoji.
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
        // No emoticon contains more than one letter.
        if self.letters > 1 {
            self.spaced.separate();
        } else {
            let mut spaced = core::mem::take(&mut self.spaced);
            let sign = match emoticon::whole(self.text()) {
                Some((name, rest)) => Some((0, name, rest)),
                None => spaced
                    .take(self.text(), self.letters > 0)
                    .map(|(parts, name)| (parts, name, "")),
            };
            if let Some((parts, name, rest)) = sign {
                // Earlier text does not belong to the next item.
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
