//! User lexicon: pronunciations of words that engines mispronounce.

use std::collections::BTreeMap;

/// Lexicon entry for a word: a respelling or a pronunciation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Entry {
    /// Other words.
    Respelling(String),
    /// Phones of the International Phonetic Alphabet.
    Ipa(String),
}

/// Author's pronunciation lexicon, for words that speech engines get wrong.
///
/// A lexicon is a text with one entry per line: `word = other words` or `word = /IPA/`. A `#` at
/// the start of a line or after a space begins a comment. A line `[de]` limits the following
/// entries to German; `[*]` ends that. A lower-case word also matches its capitalised form; a word
/// with capitals matches only itself.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Lexicon {
    /// Entries by language ("" for all languages) and word.
    entries: BTreeMap<(String, String), Entry>,
}

/// Error returned when a lexicon cannot be parsed, with its position.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("lexicon, line {line}, column {column}: {problem}")]
pub struct LexiconError {
    /// Line number, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// Description of the problem.
    pub problem: LexiconProblem,
}

/// Kind of a problem in a lexicon file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LexiconProblem {
    /// An entry has no equals sign.
    #[error("expected `word = respelling` or `word = /IPA/`")]
    NoEquals,
    /// No word, or more than one, before the equals sign.
    #[error("expected one word before `=`")]
    NoWord,
    /// Nothing that can be spoken after the equals sign.
    #[error("expected a respelling or /IPA/ after `=`")]
    NothingSaid,
    /// The second slash of an IPA entry is missing.
    #[error("expected a `/` after the IPA")]
    OpenIpa,
    /// A head is not a language's primary subtag in brackets.
    #[error("expected a language such as `[de]`")]
    BadHead,
    /// The word is already in this section.
    #[error("`{0}` is already in this section")]
    Twice(String),
    /// A line, or the number of entries, is beyond the limit.
    #[error("too long: lines have at most 1000 characters, a lexicon 100000 entries")]
    TooLong,
}

const MAX_ENTRIES: usize = 100_000;
const MAX_CHARS: usize = 1000;

fn without_comment(line: &str) -> &str {
    let mut before = ' ';
    for (at, c) in line.char_indices() {
        if c == '#' && before.is_whitespace() {
            return &line[..at];
        }
        before = c;
    }
    line
}

/// Returns the language that a section heading names, "" for all languages; `None` if the line is
/// no heading.
fn head(line: &str) -> Option<String> {
    let name = line.strip_prefix('[')?.strip_suffix(']')?.trim();
    let subtag = (2..=8).contains(&name.len()) && name.bytes().all(|b| b.is_ascii_alphabetic());
    match name {
        "*" => Some(String::new()),
        _ if subtag => Some(name.to_ascii_lowercase()),
        _ => None,
    }
}

fn entry(said: &str) -> Result<Entry, LexiconProblem> {
    if let Some(rest) = said.strip_prefix('/') {
        let ipa = rest
            .strip_suffix('/')
            .ok_or(LexiconProblem::OpenIpa)?
            .trim();
        return match ipa.chars().any(char::is_alphabetic) {
            true => Ok(Entry::Ipa(ipa.to_owned())),
            false => Err(LexiconProblem::NothingSaid),
        };
    }
    match said.chars().any(char::is_alphabetic) {
        true => Ok(Entry::Respelling(said.to_owned())),
        false => Err(LexiconProblem::NothingSaid),
    }
}

impl Lexicon {
    /// Parses the text of a lexicon file.
    ///
    /// # Errors
    /// Returns an error with the position of the first line that is not an entry, a header or a
    /// comment.
    pub fn parse(text: &str) -> Result<Self, LexiconError> {
        let mut lexicon = Self::default();
        let mut language = String::new();
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        for (index, whole) in text.lines().enumerate() {
            let at = |part: &str, problem: LexiconProblem| {
                // `part` is a slice of the line, so its position is the difference.
                let bytes = (part.as_ptr() as usize).saturating_sub(whole.as_ptr() as usize);
                let column = whole.get(..bytes).map_or(0, |head| head.chars().count()) + 1;
                LexiconError {
                    line: index + 1,
                    column,
                    problem,
                }
            };
            if whole.chars().count() > MAX_CHARS || lexicon.entries.len() >= MAX_ENTRIES {
                return Err(at(whole, LexiconProblem::TooLong));
            }
            let line = without_comment(whole).trim();
            if line.is_empty() {
                continue;
            }
            if line.starts_with('[') && !line.contains('=') {
                language = head(line).ok_or_else(|| at(line, LexiconProblem::BadHead))?;
                continue;
            }
            let (word, said) = line
                .split_once('=')
                .ok_or_else(|| at(line, LexiconProblem::NoEquals))?;
            let (word, said) = (word.trim(), said.trim());
            if word.is_empty() || word.contains(char::is_whitespace) {
                return Err(at(word, LexiconProblem::NoWord));
            }
            let entry = entry(said).map_err(|problem| at(said, problem))?;
            let key = (language.clone(), super::word::composed(word).into_owned());
            if lexicon.entries.insert(key, entry).is_some() {
                return Err(at(word, LexiconProblem::Twice(word.to_owned())));
            }
        }
        Ok(lexicon)
    }

    /// Returns true if it has no entry, like the default one.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Returns the entry of `word`, in its exact form or else in lower case; one for the language's
    /// primary subtag takes precedence over one for every language.
    pub(super) fn get(&self, word: &str, language: &str) -> Option<&Entry> {
        if self.is_empty() {
            return None;
        }
        let primary = language
            .split(['-', '_'])
            .next()
            .unwrap_or_default()
            .to_ascii_lowercase();
        let small = word.to_lowercase();
        [
            (primary.as_str(), word),
            (primary.as_str(), small.as_str()),
            ("", word),
            ("", &small),
        ]
        .into_iter()
        .find_map(|(language, word)| self.entries.get(&(language.to_owned(), word.to_owned())))
    }
}
