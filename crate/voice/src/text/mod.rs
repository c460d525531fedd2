//! Conversion of written text to spoken text.
//!
//! Scope: numbers, dates, times, money, measures, fractions, abbreviations, acronyms, addresses and
//! signs of English, German and European Portuguese as words; the modes of SABLE's SAYAS; a user's
//! lexicon. The result maps every written word to its spoken ones.
//! Out of scope: other languages (their words pass unchanged) and audio.

mod amount;
mod date;
mod english;
mod german;
mod grammar;
mod grammars;
mod lexicon;
mod measure;
mod money;
mod number;
mod ordinal;
mod portuguese;
mod read;
mod roman;
mod runs;
mod say_as;
mod spelling;
mod time;
mod token;

pub use lexicon::{Lexicon, LexiconError, LexiconProblem};

use raconteur_base::text::{abbreviation, language, word};

use language::Language;
use lexicon::Entry;
use read::{Reader, Reading};
use word::Word;

/// The most characters of one token; longer ones are cut.
pub const TOKEN_CHARS: usize = 40;
/// Maximum number of tokens for one written word.
pub const WORD_TOKENS: usize = 300;

/// Order of day, month and year in a date.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// Day, month, year.
    Dmy,
    /// Month, day, year.
    Mdy,
    /// Year, month, day.
    Ymd,
    /// Year, month.
    Ym,
    /// Month, year.
    My,
    /// Month, day.
    Md,
}

/// Text type of marked text: the modes of SABLE's SAYAS element (GEVH D.4.12).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SayAs {
    /// Letters, digits and signs by their names.
    Literal,
    /// A date; without an order the language's usual one.
    Date(Option<Order>),
    /// A time of day, with seconds or without by its content.
    Time,
    /// A telephone number, digit by digit.
    Phone,
    /// An address of the net.
    Net {
        /// True for an e-mail address, in which every part is spoken even without a dot; false for
        /// a URL.
        email: bool,
    },
    /// A postal address: codes digit by digit, house numbers whole, streets written out.
    Postal,
    /// An amount of money.
    Currency,
    /// A formula.
    Math,
    /// A fraction: 3/8.
    Fraction,
    /// A quantity with its unit.
    Measure,
    /// Numbers as ordinals.
    Ordinal,
    /// Numbers as cardinals, never as years.
    Cardinal,
    /// A name: numerals are a ruler's, capitals are not spelled.
    Name,
}

/// Spoken word that results from normalising a text, with its punctuation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Token {
    /// Letters, apostrophes and hyphens only, at most [`TOKEN_CHARS`]; capitals as written.
    /// In a language that is not read here, the word as it was written.
    pub text: String,
    /// Characters of `,.;:!?` after it; usually empty.
    pub punctuation: String,
    /// Pronunciation in the International Phonetic Alphabet, from the lexicon.
    pub ipa: Option<String>,
}

/// Returns the spoken tokens of each of the `written` words.
///
/// `written` contains the words of one or a few sentences, split at white space, with their
/// punctuation. `language` is a BCP 47 tag; its primary subtag selects the language. In English,
/// dates are month first for the United States and if no region is given. `say_as` applies to all
/// words. A word whose pronunciation was merged into that of a neighbour ("Uhr" in "14:30 Uhr")
/// gets no token, nor does a word without spoken content. The result has one list for each written
/// word, each with at most [`WORD_TOKENS`] tokens.
#[must_use]
pub fn speakable(
    written: &[&str],
    language: &str,
    say_as: Option<&SayAs>,
    lexicon: &Lexicon,
) -> Vec<Vec<Token>> {
    let mut words: Vec<Word<'_>> = written.iter().map(|word| Word::parse(word)).collect();
    if matches!(say_as, Some(SayAs::Literal | SayAs::Math)) {
        // Their signs are read, and are no punctuation too.
        words.iter_mut().for_each(Word::forget_signs);
    }
    word::soften_ellipses(&mut words);
    word::mark_sums(&mut words);
    let known = Language::from_tag(language);
    let reader = known.map(|known| Reader::new(&words, known, language, say_as));
    let mut spoken: Vec<Vec<Token>> = vec![Vec::new(); words.len()];
    let mut latest = None;
    let mut at = 0;
    while let Some(word) = words.get(at) {
        let custom = if matches!(say_as, None | Some(SayAs::Name)) {
            from_lexicon(word, language, lexicon, reader.as_ref(), at)
        } else {
            None
        };
        let (tokens, ends) = match (custom, &reader) {
            (Some(tokens), _) => (vec![tokens], true),
            (None, Some(reader)) => {
                let Reading { spoken, ends } = reader.read(at);
                (
                    spoken.iter().map(|phrase| token::tokens(phrase)).collect(),
                    ends,
                )
            }
            (None, None) => (vec![token::untouched(&word.core)], true),
        };
        let taken = tokens.len().clamp(1, words.len() - at);
        for (offset, tokens) in tokens.into_iter().take(taken).enumerate() {
            spoken[at + offset] = tokens;
            // Stops within a reading are the words' own.
            let dot = ends && offset + 1 == taken;
            punctuate(
                &words[at + offset],
                &mut spoken,
                at + offset,
                &mut latest,
                dot,
            );
        }
        at += taken;
    }
    // A comma for a bracket or dash separates nothing at the end.
    if let (Some(last), Some(word)) = (spoken.iter_mut().flatten().next_back(), words.last())
        && last.punctuation == ","
        && !word.end.contains(',')
    {
        last.punctuation.clear();
    }
    spoken
}

/// Attaches the punctuation of the word at `at` to its last token, or to the `latest` before it.
/// `dot` is true if a full stop is punctuation.
fn punctuate(
    word: &Word<'_>,
    spoken: &mut [Vec<Token>],
    at: usize,
    latest: &mut Option<usize>,
    dot: bool,
) {
    if word.opens
        && let Some(before) = latest.and_then(|at| spoken[at].last_mut())
        && before.punctuation.is_empty()
    {
        before.punctuation.push(',');
    }
    if !spoken[at].is_empty() {
        *latest = Some(at);
    }
    let mut end = word.end.as_str();
    if !dot {
        end = end.strip_prefix('.').unwrap_or(end);
    }
    // "it...", and then a comma: the comma is more specific.
    if end.len() > 1 {
        end = end.strip_prefix('.').unwrap_or(end);
    }
    if end.is_empty() && word.closes {
        end = ",";
    }
    if let Some(last) = latest.and_then(|at| spoken[at].last_mut())
        && (last.punctuation.is_empty() || last.punctuation == ",")
        && !end.is_empty()
    {
        last.punctuation = end.to_owned();
    }
}

/// Looks up a word in the lexicon: with all its signs, without those around it, or with the full
/// stop of an abbreviation.
fn from_lexicon(
    word: &Word<'_>,
    language: &str,
    lexicon: &Lexicon,
    reader: Option<&Reader<'_>>,
    at: usize,
) -> Option<Vec<Token>> {
    if lexicon.is_empty() || word.raw.is_empty() {
        return None;
    }
    let dotted = format!("{}.", word.core);
    let entry = lexicon
        .get(&word.raw, language)
        .or_else(|| {
            word.dotted()
                .then(|| lexicon.get(&dotted, language))
                .flatten()
        })
        .or_else(|| lexicon.get(&word.core, language))?;
    match entry {
        Entry::Respelling(words) => Some(token::tokens(words)),
        Entry::Ipa(ipa) => {
            // The text is for captions and alignment: the word's letters, or the reading of a word
            // without letters.
            let mut token = Token::parse(&word.core.chars().take(TOKEN_CHARS).collect::<String>());
            if token.is_none() {
                let said = reader
                    .map(|reader| reader.read(at).spoken)
                    .unwrap_or_default();
                token = said.iter().flat_map(|phrase| token::tokens(phrase)).next();
            }
            let mut token = token?;
            token.punctuation.clear();
            token.ipa = Some(ipa.clone());
            Some(vec![token])
        }
    }
}
