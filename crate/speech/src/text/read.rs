//! Which kind of text a word is, and who reads it.

use super::language::Language;
use super::word::Word;
use super::{SayAs, abbreviation, money, number, roman, spelling, time};

/// What words are read as: one phrase for each word that is taken, which may be empty.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Reading {
    pub(super) spoken: Vec<String>,
    /// A full stop after the last word ends a sentence, and is not the word's own.
    pub(super) ends: bool,
}

impl Reading {
    /// One word read as `phrase`.
    pub(super) fn one(phrase: impl Into<String>) -> Self {
        Self::several([phrase.into()])
    }

    /// Several words, each with its phrase.
    pub(super) fn several<const N: usize>(phrases: [String; N]) -> Self {
        Self {
            spoken: phrases.into(),
            ends: true,
        }
    }

    /// The same with its full stop taken for the word's own.
    pub(super) fn owning_stop(mut self, ends: bool) -> Self {
        self.ends = ends;
        self
    }
}

/// Reads the words of a text in one language.
pub(super) struct Reader<'a> {
    pub(super) words: &'a [Word<'a>],
    pub(super) language: Language,
    /// Dates like 12/25/1998.
    pub(super) month_first: bool,
    pub(super) say_as: Option<&'a SayAs>,
    /// Most words are all in capitals, which then mean nothing.
    shouted: bool,
}

impl<'a> Reader<'a> {
    /// A reader of `words`; `tag` is the whole language tag, whose region tells the order
    /// of English dates.
    pub(super) fn new(
        words: &'a [Word<'a>],
        language: Language,
        tag: &str,
        say_as: Option<&'a SayAs>,
    ) -> Self {
        let tag = tag.to_ascii_lowercase();
        let region = tag.split(['-', '_']).skip(1).find(|part| part.len() == 2);
        let letters = |word: &&Word<'_>| word.is_plain() && word.core.chars().count() > 1;
        let long = words.iter().filter(letters).count();
        let capital = |word: &&Word<'_>| letters(word) && !word.core.contains(char::is_lowercase);
        let shouted = words.iter().filter(capital).count();
        Self {
            words,
            language,
            month_first: language == Language::English && matches!(region, None | Some("us")),
            say_as,
            shouted: shouted > 2 && shouted * 2 > long,
        }
    }

    /// The word before, where nothing parts the two.
    pub(super) fn previous(&self, at: usize) -> &str {
        match at.checked_sub(1).and_then(|before| self.words.get(before)) {
            Some(word) if !word.closes && matches!(word.end.as_str(), "" | ".") => &word.core,
            _ => "",
        }
    }

    /// The word after, where nothing parts the two.
    pub(super) fn next(&self, at: usize) -> &str {
        match (self.words.get(at), self.words.get(at + 1)) {
            (Some(word), Some(next)) if word.end.is_empty() && !word.closes && !next.opens => {
                &next.core
            }
            _ => "",
        }
    }

    /// The word after, a full stop being allowed between.
    pub(super) fn next_after_stop(&self, at: usize) -> &str {
        match (self.words.get(at), self.words.get(at + 1)) {
            (Some(word), Some(next)) if matches!(word.end.as_str(), "" | ".") => &next.core,
            _ => "",
        }
    }

    /// Reads the word at `at`, and those after it that belong to it.
    pub(super) fn read(&self, at: usize) -> Reading {
        let Some(word) = self.words.get(at) else {
            return Reading::one("");
        };
        if let Some(mode) = self.say_as
            && let Some(reading) = self.read_as(mode, at, word)
        {
            return reading;
        }
        self.read_unmarked(at, word)
    }

    /// As [`Reader::read`], without regard to a mode.
    pub(super) fn read_unmarked(&self, at: usize, word: &Word<'_>) -> Reading {
        let core = word.core.as_str();
        if core.is_empty() {
            return Reading::one("");
        }
        if core.contains(|c: char| c.is_numeric() || matches!(c, 'º' | 'ª'))
            && !spelling::is_net(core)
            && let Some(reading) = self.amount(at, word)
        {
            return reading;
        }
        if let Some(found) = abbreviation::expand(self.words, at, self.language) {
            return Reading {
                spoken: found.spoken,
                ends: found.ends,
            };
        }
        if core.contains(['.', ':', '@', '/']) && spelling::is_net(core) {
            return Reading::one(spelling::net(core, self.language));
        }
        if word.is_plain() {
            return self.plain(at, word);
        }
        if let Some(reading) = self.lone_sign(at, core) {
            return reading;
        }
        Reading::one(self.runs(core, false))
    }

    /// A word of letters: mostly itself.
    fn plain(&self, at: usize, word: &Word<'_>) -> Reading {
        let core = word.core.as_str();
        if !word.is_capital() || core.chars().skip(1).any(char::is_lowercase) {
            return Reading::one(self.letters(core));
        }
        // "I" is a word of English, and "D", "C" or "L" are more often letters.
        let pronoun =
            self.language == Language::English && core == "I" && !self.next(at).is_empty();
        if !pronoun && let Some(numeral) = roman::after(self.previous(at), core, self.language) {
            // The stop of a German numeral is its own: "Heinrich VIII. war König".
            let own = self.language == Language::German && at + 1 < self.words.len();
            return Reading::one(numeral).owning_stop(!own);
        }
        Reading::one(self.letters(core))
    }

    /// Letters as a word, or by their names where they are an acronym.
    pub(super) fn letters(&self, word: &str) -> String {
        let named = matches!(self.say_as, Some(SayAs::Name));
        if !named && spelling::is_acronym(word, self.shouted) {
            return spelling::literal(word, self.language);
        }
        // "CDs": the plural of an acronym.
        if let Some(stem) = word.strip_suffix("'s").or_else(|| word.strip_suffix('s'))
            && !named
            && stem.len() > 1
            && spelling::is_acronym(stem, self.shouted)
        {
            let s = if self.language == Language::German {
                "s"
            } else {
                "'s"
            };
            let plural = if word.contains('\'') { s } else { "s" };
            return spelling::literal(stem, self.language) + plural;
        }
        word.to_owned()
    }

    /// A sign that is a word of its own.
    fn lone_sign(&self, at: usize, core: &str) -> Option<Reading> {
        let next = self.next(at);
        if let Some(currency) = money::currency(core) {
            let amount = number::Number::parse(next, self.language);
            return Some(match amount {
                Some(amount) => {
                    Reading::several([String::new(), currency.amount(&amount, self.language)])
                }
                None => Reading::one(currency.name(false, self.language)),
            });
        }
        let mut chars = core.chars();
        let (Some(sign), None) = (chars.next(), chars.next()) else {
            return None;
        };
        let said = match sign {
            '/' => self.language.pick(["or", "oder", "ou"]),
            '-' => return Some(Reading::one("")),
            _ => spelling::sign(sign, self.language)?,
        };
        Some(Reading::one(said))
    }

    /// Whether the word at `at` is the half of a day of the hour before it.
    pub(super) fn half_after(&self, at: usize) -> Option<time::Half> {
        time::half(self.next(at))
    }
}
