//! Sentences of a plain text, with their emotions.

use std::ops::ControlFlow;

use raconteur_base::text::capitals::is_stressed;
use raconteur_base::text::language::Language;
use raconteur_base::text::sentence::ends_after;
use raconteur_base::text::signs::DisplayedWords;
use raconteur_base::text::word::Word;

use crate::voice::{Item, NO_EMPHASIS};
use crate::{Span, TextSegment, VoiceText};

/// Minimum number of words in a phrase. *Designed*: a breath.
const MIN_WORDS: usize = 4;
const MAX_WORDS: usize = 12;

/// Word of a sentence, with its stress.
#[derive(Clone, Debug)]
pub(super) struct SpokenWord {
    /// Text of the word with its punctuation and adjacent free-standing signs.
    pub(super) text: String,
    /// True if emphasised: in capitals among words that are not.
    pub(super) is_stressed: bool,
}

/// Sentence or phrase that is spoken in one clause, with its emotion.
#[derive(Clone, Debug, Default)]
pub(super) struct Sentence {
    pub(super) words: Vec<SpokenWord>,
    /// Emotion word given by an emoticon.
    pub(super) emotion: Option<&'static str>,
    /// True if more of the same sentence follows.
    pub(super) continues: bool,
}

/// Words, signs on their own and emoticons of a line, as EML has them.
enum Part {
    Word(String),
    Sign(String),
    Emotion(&'static str),
}

/// Returns the sentences of a text; a line ends one as well. An emoticon after the end of a
/// sentence belongs to that sentence.
pub(super) fn sentences(text: &str, language: &str) -> Vec<Sentence> {
    let language = Language::from_tag(language);
    text.split(['\n', '\r', '\u{2028}', '\u{2029}'])
        .flat_map(|line| of_line(line, language))
        .collect()
}

fn parts_of(line: &str) -> Vec<Part> {
    let text = VoiceText {
        pieces: vec![TextSegment::Text {
            text: line.into(),
            emphasis: NO_EMPHASIS,
            span: Span::from_offsets(0, line.len()),
        }],
    };
    let mut parts: Vec<Part> = Vec::new();
    let _ = text.scan(&mut |item| {
        match item {
            Item::Word(token) => parts.push(Part::Word(token.spoken_text())),
            Item::Signs(signs) => parts.push(Part::Sign(signs.to_owned())),
            Item::Emoticon {
                name,
                parts: signs,
                rest,
            } => {
                parts.truncate(parts.len().saturating_sub(signs));
                parts.push(Part::Emotion(name));
                if !rest.is_empty() {
                    parts.push(Part::Sign(rest.to_owned()));
                }
            }
            Item::Mark(_) | Item::Gap => {}
        }
        ControlFlow::Continue(())
    });
    parts
}

fn of_line(line: &str, language: Option<Language>) -> Vec<Sentence> {
    let parts = parts_of(line);
    let mut shown = DisplayedWords::default();
    let mut written: Vec<Word<'_>> = Vec::new();
    for part in &parts {
        match part {
            Part::Word(text) => {
                shown.word(text);
                written.push(Word::parse(text));
            }
            Part::Sign(text) => {
                shown.sign(text);
                written.push(Word::parse(text));
            }
            Part::Emotion(_) => {}
        }
    }
    let mut shown = shown.finish().into_iter();
    let mut all: Vec<Sentence> = Vec::new();
    let mut open = Sentence::default();
    let (mut at, mut is_over) = (0, false);
    for part in &parts {
        if matches!(part, Part::Word(_)) && core::mem::take(&mut is_over) {
            all.push(core::mem::take(&mut open));
        }
        match part {
            Part::Word(_) => open.words.push(SpokenWord {
                text: shown.next().unwrap_or_default(),
                is_stressed: is_stressed(&written, at, language),
            }),
            Part::Sign(_) => {}
            Part::Emotion(name) => {
                open.emotion.get_or_insert(name);
                continue;
            }
        }
        is_over |= !open.words.is_empty() && ends_after(&written, at, language);
        at += 1;
    }
    all.push(open);
    all.retain(|sentence| !sentence.words.is_empty());
    all
}

/// Splits a sentence into phrases, at commas and similar marks, or between ordinary words where it
/// becomes long, since numbers, capitals and abbreviations are read together.
pub(super) fn phrases(sentence: &Sentence) -> Vec<Sentence> {
    let words = &sentence.words;
    let is_ordinary = |word: &SpokenWord| word.text.chars().all(|c| c.is_lowercase() || c == '\'');
    let mut out = Vec::new();
    let mut from = 0;
    for to in 1..=words.len() {
        let length = to - from;
        let last = words[to - 1]
            .text
            .trim_end_matches(['"', '\'', '”', '’', ')']);
        let parts = last.ends_with([',', ';', ':', '—', '–'])
            && !last.contains(|c: char| c.is_numeric())
            && length >= MIN_WORDS
            && words.len() - to >= 2;
        let is_long = length >= MAX_WORDS && words[to - 1..].iter().take(2).all(is_ordinary);
        if to < words.len() && !parts && !is_long && length < 2 * MAX_WORDS {
            continue;
        }
        out.push(Sentence {
            words: words[from..to].to_vec(),
            emotion: sentence.emotion,
            continues: to < words.len(),
        });
        from = to;
    }
    out
}
