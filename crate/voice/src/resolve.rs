//! Words in order, each with its style: content with its combined markup. Word counts of a content
//! are counts of these.

use core::fmt::Write as _;
use core::hash::Hasher as _;
use std::collections::BTreeMap;
use std::hash::DefaultHasher;

use crate::content::{Boundary, Content, Division, Markup, Segment, is_space};
use crate::style::Style;
use raconteur_eml::emoticon::{self, Spaced};

/// Nesting depth beyond which markup has no effect.
const MAX_DEPTH: usize = 1000;

/// Content with its markup resolved to a style for each word.
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// Words and events, in order.
    pub items: Vec<Item>,
    /// The styles of the words, each once, in the order of their first words.
    pub styles: Vec<Style>,
}

/// Spoken word, or event between words.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// Token between white space that contains a letter or digit.
    Word {
        /// Word with its attached punctuation.
        text: String,
        /// Index of its style: that of its first letter or digit.
        style: usize,
        /// Group number: words with the same number are read as one, because the surrounding markup
        /// gives a replacement (pronunciation, engine) or a text type for all of them.
        together: Option<usize>,
        /// Number of bytes at its end, all signs, that lie outside the markup with its text type.
        behind: usize,
    },
    /// Token without a letter or digit, such as a dash, that is not an emoticon.
    Punctuation(String),
    /// An emoticon (F&H table 4.1) or an emoji; its word of [`raconteur_speech::emotion::WORDS`].
    Emoticon(&'static str),
    /// A pause.
    Break {
        /// Milliseconds.
        msec: u32,
        /// Punctuation mark whose intonation precedes it.
        boundary: Option<Boundary>,
    },
    /// A sentence or a paragraph begins or ends.
    Division(Division),
    /// A recording.
    Audio {
        /// Path or URL of the recording.
        src: String,
        /// True if the recording plays under the speech that follows.
        background: bool,
        /// Amplitude factor; 1 plays the recording unchanged.
        level: f64,
    },
    /// Mark that sends an event to listeners. Inside a word it precedes that word.
    Mark(String),
}

impl Resolved {
    /// Iterates over the words in order.
    pub fn words(&self) -> impl Iterator<Item = &str> {
        self.items.iter().filter_map(|item| match item {
            Item::Word { text, .. } => Some(text.as_str()),
            _ => None,
        })
    }

    /// Returns the words in order, each with its style.
    #[must_use]
    pub fn styled_words(&self) -> Vec<(&str, &Style)> {
        let styled = |item| match item {
            &Item::Word {
                ref text, style, ..
            } => Some((text.as_str(), self.styles.get(style)?)),
            _ => None,
        };
        self.items.iter().filter_map(styled).collect()
    }
}

/// Resolves a content's markup. `engine` is the name of the engine that will speak. Unbalanced
/// markup is tolerated.
#[must_use]
pub fn resolve(content: &Content, engine: &str) -> Resolved {
    let mut walk = Resolver {
        engine,
        out: Resolved {
            items: Vec::new(),
            styles: Vec::new(),
        },
        known: BTreeMap::new(),
        levels: vec![Level::default()],
        too_deep: 0,
        openings: 0,
        token: Token::default(),
        spaced: Spaced::default(),
    };
    for segment in &content.segments {
        walk.segment(segment);
    }
    walk.end_token();
    walk.out
}

/// The settings inside a markup.
#[derive(Clone, Default)]
struct Level {
    style: Style,
    /// Index, assigned at the first word that needs it.
    index: Option<usize>,
    /// Markup with a replacement for its words.
    replaced: Option<usize>,
    /// Markup with the text type of its words.
    said_as: Option<usize>,
}

/// A token that is being read.
#[derive(Default)]
struct Token {
    text: String,
    /// Style and togetherness, from its first letter or digit on.
    word: Option<(usize, Option<usize>)>,
    /// Marks after its last letter or digit.
    marks: Vec<String>,
    /// Markup with its word's text type, and the end of its range, in bytes.
    said_as: Option<(usize, usize)>,
}

struct Resolver<'a> {
    engine: &'a str,
    out: Resolved,
    /// Indices of styles by the hash of their debug output.
    known: BTreeMap<u64, usize>,
    /// Never empty.
    levels: Vec<Level>,
    /// Number of open markups beyond the maximum depth.
    too_deep: usize,
    openings: usize,
    token: Token,
    /// Preceding text that may form an emoticon with the token.
    spaced: Spaced,
}

impl Resolver<'_> {
    fn segment(&mut self, segment: &Segment) {
        match segment {
            Segment::Text(text) => {
                let mut pieces = text.split(is_space);
                self.append(pieces.next().unwrap_or_default());
                for piece in pieces {
                    self.end_token();
                    self.append(piece);
                }
            }
            Segment::Break { msec, boundary } => self.between(Item::Break {
                msec: *msec,
                boundary: *boundary,
            }),
            Segment::Division(division) => self.between(Item::Division(*division)),
            Segment::Audio {
                src,
                background,
                level,
            } => self.between(Item::Audio {
                src: src.clone(),
                background: *background,
                level: *level,
            }),
            Segment::Mark(name) if self.token.word.is_some() => {
                self.token.marks.push(name.clone());
            }
            Segment::Mark(name) => self.out.items.push(Item::Mark(name.clone())),
            Segment::Open(markup) => self.open(markup),
            Segment::Close if self.too_deep > 0 => self.too_deep -= 1,
            Segment::Close if self.levels.len() > 1 => {
                self.levels.pop();
            }
            Segment::Close => {}
        }
    }

    fn between(&mut self, item: Item) {
        self.end_token();
        self.spaced.separate();
        self.out.items.push(item);
    }

    fn open(&mut self, markup: &Markup) {
        self.openings += 1;
        if self.levels.len() > MAX_DEPTH {
            self.too_deep += 1;
            return;
        }
        let Some(outer) = self.levels.last() else {
            return;
        };
        let style = outer.style.with(markup, self.engine);
        let number = Some(self.openings);
        let (replaced, said_as) = match markup {
            Markup::Pronunciation { .. } => {
                let any = style.ipa.is_some() || style.instead.is_some();
                (number.filter(|_| any), outer.said_as)
            }
            Markup::Engine { id, .. } if self.engine.eq_ignore_ascii_case(id) => {
                (number, outer.said_as)
            }
            Markup::SayAs(_) => (outer.replaced, number),
            _ => (outer.replaced, outer.said_as),
        };
        // Most markup changes something; markup without effect costs only an entry.
        self.levels.push(Level {
            style,
            index: None,
            replaced,
            said_as,
        });
    }

    /// Adds characters to the token.
    fn append(&mut self, piece: &str) {
        self.token.text.push_str(piece);
        let kind = self.levels.last().and_then(|level| level.said_as);
        let length = self.token.text.len();
        match (&mut self.token.said_as, kind) {
            (Some((of, end)), Some(kind)) if *of == kind => *end = length,
            (none @ None, Some(kind)) => *none = Some((kind, length)),
            _ => {}
        }
        if !piece.contains(char::is_alphanumeric) {
            return;
        }
        if self.token.word.is_none() {
            self.token.word = Some(self.current());
        }
        let marks = self.token.marks.drain(..);
        self.out.items.extend(marks.map(Item::Mark));
    }

    /// Returns the index of the current style, and the group of its words.
    fn current(&mut self) -> (usize, Option<usize>) {
        let Some(level) = self.levels.last_mut() else {
            return (0, None);
        };
        let styles = &mut self.out.styles;
        let index = *level.index.get_or_insert_with(|| {
            let mut print = FormatHasher(DefaultHasher::new());
            // Writing to a hasher cannot fail.
            let _ = write!(print, "{:?}", level.style);
            let hash = print.0.finish();
            match self.known.get(&hash) {
                Some(&index) if styles.get(index) == Some(&level.style) => index,
                _ => {
                    styles.push(level.style.clone());
                    self.known.insert(hash, styles.len() - 1);
                    styles.len() - 1
                }
            }
        });
        (index, level.replaced.or(level.said_as))
    }

    fn end_token(&mut self) {
        let Token {
            text,
            word,
            marks,
            said_as,
        } = core::mem::take(&mut self.token);
        let behind = said_as.map_or("", |(_, end)| &text[end..]);
        let behind = match behind.contains(char::is_alphanumeric) {
            true => 0,
            false => behind.len(),
        };
        self.token_read(text, word, behind);
        self.out.items.extend(marks.into_iter().map(Item::Mark));
    }

    fn token_read(&mut self, text: String, word: Option<(usize, Option<usize>)>, behind: usize) {
        if text.is_empty() {
            return;
        }
        if let Some((emotion, rest)) = emoticon::whole(&text) {
            self.spaced.separate();
            self.out.items.push(Item::Emoticon(emotion));
            // A sentence may end right behind an emoticon.
            if !rest.is_empty() {
                self.out.items.push(Item::Punctuation(rest.to_owned()));
            }
            return;
        }
        if let Some((parts, emotion)) = self.spaced.take(&text, word.is_some()) {
            self.remove_last(parts);
            self.out.items.push(Item::Emoticon(emotion));
            return;
        }
        let [before, after] = emoticon::of_emoji(&text);
        let shown = emoticon::without_emoji(&text);
        // Without the emoji, the remaining length of the end is unknown.
        let behind = if shown.is_some() { 0 } else { behind };
        let bare = shown.unwrap_or(text);
        self.out
            .items
            .extend(before.into_iter().map(Item::Emoticon));
        if let Some((style, together)) = word {
            self.out.items.push(Item::Word {
                text: bare,
                style,
                together,
                behind,
            });
        } else if !bare.is_empty() {
            self.out.items.push(Item::Punctuation(bare));
        }
        self.out.items.extend(after.into_iter().map(Item::Emoticon));
    }

    /// Removes the last tokens without a letter or a digit, which belong to an emoticon.
    fn remove_last(&mut self, parts: usize) {
        for _ in 0..parts {
            let is_sign = |item: &Item| matches!(item, Item::Punctuation(_));
            if let Some(last) = self.out.items.iter().rposition(is_sign) {
                self.out.items.remove(last);
            }
        }
    }
}

/// Hashes formatted output.
struct FormatHasher(DefaultHasher);

impl core::fmt::Write for FormatHasher {
    fn write_str(&mut self, text: &str) -> core::fmt::Result {
        self.0.write(text.as_bytes());
        Ok(())
    }
}

impl Content {
    /// Returns the words in order: tokens between white space that contain a letter or digit;
    /// punctuation stays attached. Markup does not separate words; pauses, divisions and recordings
    /// do. Emoticons (F&H tables 4.1 and 4.2) are not words.
    #[must_use]
    pub fn words(&self) -> Vec<String> {
        let resolved = resolve(self, "");
        resolved.words().map(str::to_owned).collect()
    }

    /// Returns the words joined with single spaces.
    #[must_use]
    pub fn plain_text(&self) -> String {
        self.words().join(" ")
    }
}

#[cfg(test)]
mod tests;
