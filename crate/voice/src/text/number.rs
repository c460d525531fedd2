//! Numbers written with digits, and their reading.

use super::grammar::{Form, Grammars as _};
use super::language::Language;

/// Number written with digits, as parsed from a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Number {
    /// True if a minus precedes it.
    pub(super) negative: bool,
    /// ASCII digits before the decimal sign, without grouping; may be empty (".5").
    pub(super) whole: String,
    /// The decimal sign and the ASCII digits after it.
    pub(super) decimals: Option<(char, String)>,
    /// Thousands were grouped, so this is no year.
    pub(super) grouped: bool,
}

/// Maximum number of digits that are read as one number; longer ones are read digit by digit (10^18
/// has no name in the tables).
const NAMED_DIGITS: usize = 18;

/// Returns true for a minus sign or a hyphen in its place.
pub(super) fn is_minus(c: char) -> bool {
    matches!(c, '-' | '\u{2212}')
}

fn all_digits(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())
}

impl Number {
    /// Reads `text` entirely as a number with the signs of `language`.
    pub(super) fn parse(text: &str, language: Language) -> Option<Self> {
        let unsigned = text.strip_prefix(is_minus);
        let negative = unsigned.is_some();
        let body = unsigned.unwrap_or(text);
        let body = body.strip_prefix('+').unwrap_or(body);
        let decimal = language.decimal_sign();
        let grouping = if decimal == '.' { ',' } else { '.' };
        let (whole, decimals) = match body.split_once(decimal) {
            Some((whole, digits)) if all_digits(digits) => {
                (whole, Some((decimal, digits.to_owned())))
            }
            Some(_) => return None,
            None => (body, None),
        };
        if whole.is_empty() {
            decimals.as_ref()?;
            return Some(Self {
                negative,
                whole: String::new(),
                decimals,
                grouped: false,
            });
        }
        if all_digits(whole) {
            return Some(Self {
                negative,
                whole: whole.to_owned(),
                decimals,
                grouped: false,
            });
        }
        let groups: Vec<&str> = whole
            .split([grouping, '\'', '\u{2019}', '\u{a0}', '\u{202f}', '\u{2009}'])
            .collect();
        let shaped = groups.iter().all(|group| all_digits(group))
            && groups.first().is_some_and(|group| group.len() <= 3)
            && groups.iter().skip(1).all(|group| group.len() == 3);
        if shaped {
            return Some(Self {
                negative,
                whole: groups.concat(),
                decimals,
                grouped: true,
            });
        }
        // The other language's decimal sign, where it cannot group: "2.0" in German.
        match whole.split_once(grouping) {
            Some((head, tail)) if decimals.is_none() && all_digits(head) && all_digits(tail) => {
                Some(Self {
                    negative,
                    whole: head.to_owned(),
                    decimals: Some((grouping, tail.to_owned())),
                    grouped: false,
                })
            }
            _ => None,
        }
    }

    /// Returns the whole value; `None` with a sign, with decimals or if it is too large.
    pub(super) fn natural(&self) -> Option<u64> {
        if self.negative || self.decimals.is_some() || self.whole.len() > NAMED_DIGITS {
            return None;
        }
        self.whole.parse().ok()
    }

    /// Returns true if a following noun is singular: exactly one.
    pub(super) fn is_one(&self) -> bool {
        self.decimals.is_none() && self.whole.trim_start_matches('0') == "1"
    }

    /// Returns the number as a cardinal in words, in the form for the following noun.
    pub(super) fn cardinal(&self, language: Language, form: Form) -> String {
        let mut spoken = String::new();
        if self.negative {
            spoken += "minus ";
            if language == Language::Portuguese {
                spoken = "menos ".to_owned();
            }
        }
        let form = if self.decimals.is_some() {
            Form::Alone
        } else {
            form
        };
        if !self.whole.is_empty() {
            spoken += &cardinal_of_digits(&self.whole, language, form);
        }
        if let Some((sign, decimals)) = &self.decimals {
            spoken += " ";
            spoken += language.decimal_word(*sign);
            spoken += " ";
            spoken += &if decimals.len() > NAMED_DIGITS {
                digits(decimals, language)
            } else {
                language.grammar().decimals(decimals)
            };
        }
        spoken.trim().to_owned()
    }
}

/// Returns ASCII digits as a cardinal in words; digit by digit if they begin with 0 or are too many
/// to name.
pub(super) fn cardinal_of_digits(text: &str, language: Language, form: Form) -> String {
    let leading_zero = text.len() > 1 && text.starts_with('0');
    match text.parse::<u64>() {
        Ok(n) if text.len() <= NAMED_DIGITS && !leading_zero => {
            language.grammar().cardinal(n, form)
        }
        _ => digits(text, language),
    }
}

/// Returns ASCII digits in words, one by one.
pub(super) fn digits(text: &str, language: Language) -> String {
    // No more than the tokens that a word may have are ever used.
    let names: Vec<String> = text
        .chars()
        .filter_map(|c| c.to_digit(10))
        .take(super::WORD_TOKENS)
        .map(|digit| language.grammar().cardinal(u64::from(digit), Form::Alone))
        .collect();
    names.join(" ")
}
