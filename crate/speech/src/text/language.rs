//! The languages that text is read in, and what the readers ask of each one's grammar.

use super::date::Date;
use super::english::English;
use super::german::German;
use super::portuguese::Portuguese;
use super::time::Clock;

/// A language whose numbers, dates and signs are read here. The order is that of the
/// columns in every table of words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Language {
    English,
    German,
    Portuguese,
}

/// How a number stands to the noun after it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// Counted or read out, with no noun: "eins".
    Alone,
    /// Before a noun that is masculine or neuter: "ein", "dois".
    Masculine,
    /// Before a feminine noun: "eine", "duas".
    Feminine,
}

/// What differs between languages by rule; what differs by word only is in tables.
///
/// Everything returned is a phrase: words with single spaces between them, perhaps a
/// comma after one.
pub(super) trait Grammar: Sync {
    /// A whole number below 10^18.
    fn cardinal(&self, n: u64, form: Form) -> String;
    /// The ordinal with the ending that the language takes here (see `ending`).
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

impl Language {
    /// Decided by the primary subtag of a BCP 47 tag (RFC 5646).
    pub(super) fn of(tag: &str) -> Option<Self> {
        let primary = tag.split(['-', '_']).next().unwrap_or_default();
        match primary.to_ascii_lowercase().as_str() {
            "en" => Some(Self::English),
            "de" => Some(Self::German),
            "pt" => Some(Self::Portuguese),
            _ => None,
        }
    }

    /// This language's column of a table row `[English, German, Portuguese]`.
    pub(super) fn pick<T: Copy>(self, row: [T; 3]) -> T {
        row[self as usize]
    }

    /// The grammar of the language.
    pub(super) fn grammar(self) -> &'static dyn Grammar {
        match self {
            Self::English => &English,
            Self::German => &German,
            Self::Portuguese => &Portuguese,
        }
    }

    /// The word for a decimal sign.
    pub(super) fn decimal_word(self, sign: char) -> &'static str {
        match sign {
            ',' => self.pick(["comma", "Komma", "vírgula"]),
            _ => self.pick(["point", "Punkt", "ponto"]),
        }
    }

    /// The decimal sign of the language; the other one of `,` and `.` groups thousands.
    pub(super) fn decimal_sign(self) -> char {
        self.pick(['.', ',', ','])
    }
}
