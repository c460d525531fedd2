//! Grammar interface of a language for the readers of text.

use super::date::Date;
use super::time::Clock;

/// Relation of a number to the following noun.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// Counted or read out, with no noun: "eins".
    Alone,
    /// Before a noun that is masculine or neuter: "ein", "dois".
    Masculine,
    /// Before a feminine noun: "eine", "duas".
    Feminine,
}

/// Language differences defined by rules; differences in words only are in tables.
///
/// Everything returned is a phrase: words with single spaces between them, perhaps a
/// comma after one.
pub(super) trait Grammar: Sync {
    /// A whole number below 10^18.
    fn cardinal(&self, n: u64, form: Form) -> String;
    /// Returns the ordinal with the ending required by the language (see `ending`).
    fn ordinal(&self, n: u64, ending: &str) -> String;
    /// The ending of an ordinal before `next`, after `previous` and `before` that.
    fn ending(&self, before: &str, previous: &str, next: &str) -> &'static str;
    /// A year of the calendar.
    fn year(&self, n: u64) -> String;
    /// The digits after the decimal sign; `digits` has only ASCII digits.
    fn decimals(&self, digits: &str) -> String;
    /// `numerator` parts of `denominator`, where the language has a name for the parts.
    fn fraction(&self, numerator: u64, denominator: u64) -> Option<String>;
    /// A whole number and a fraction below one.
    fn mixed(&self, whole: u64, numerator: u64, denominator: u64) -> Option<String>;
    /// A date with whichever parts are known; `ending` is of the day's ordinal.
    fn date(&self, date: &Date, ending: &str) -> String;
    /// A time of day.
    fn clock(&self, clock: &Clock) -> String;
    /// The gender of a noun, guessed from its ending.
    fn form_before(&self, noun: &str) -> Form;
}

/// Provider of a grammar.
pub(super) trait Grammars {
    /// The grammar of the language.
    fn grammar(self) -> &'static dyn Grammar;
}
