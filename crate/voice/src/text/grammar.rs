//! Grammar interface of a language for the readers of text.

use super::date::Date;
use super::time::Clock;

/// Grammatical form of a number, which depends on the following noun.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// Counted or read out, with no noun: "eins".
    Alone,
    /// Before a masculine or neuter noun: "ein", "dois".
    Masculine,
    /// Before a feminine noun: "eine", "duas".
    Feminine,
}

/// Grammar rules of one language for reading numbers, dates and times aloud. Differences only in
/// words are in tables.
///
/// Every returned text is a phrase: words separated by single spaces, possibly with a comma after a
/// word.
pub(super) trait Grammar: Sync {
    /// Returns a whole number below 10^18 in words.
    fn cardinal(&self, n: u64, form: Form) -> String;
    /// Returns the ordinal with the ending required by the language (see `ending`).
    fn ordinal(&self, n: u64, ending: &str) -> String;
    /// Returns the ending of an ordinal before the word `next`, after the words `before` and
    /// `previous`.
    fn ending(&self, before: &str, previous: &str, next: &str) -> &'static str;
    /// Returns a calendar year in words.
    fn year(&self, n: u64) -> String;
    /// Returns the digits after the decimal sign in words; `digits` has only ASCII digits.
    fn decimals(&self, digits: &str) -> String;
    /// Returns a fraction in words; `None` if the language has no name for the parts.
    fn fraction(&self, numerator: u64, denominator: u64) -> Option<String>;
    /// Returns a whole number with a fraction below one in words; `None` if the parts have no name.
    fn mixed(&self, whole: u64, numerator: u64, denominator: u64) -> Option<String>;
    /// Returns a date in words, with the parts that are known; `ending` is that of the day's
    /// ordinal.
    fn date(&self, date: &Date, ending: &str) -> String;
    /// Returns a time of day in words.
    fn clock(&self, clock: &Clock) -> String;
    /// Returns the form of a number before a noun; the noun's gender is guessed from its ending.
    fn form_before(&self, noun: &str) -> Form;
}

/// Source of the grammar of a language.
pub(super) trait Grammars {
    /// Returns the grammar of the language.
    fn grammar(self) -> &'static dyn Grammar;
}
