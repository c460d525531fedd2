//! Words of mixed letters, digits and signs, read run by run; and formulas.

use super::grammar::{Form, Grammars as _};
use super::language::Language;
use super::number::{self, Number};
use super::read::Reader;
use super::spelling;
use super::word::{is_joiner, is_letter};
use raconteur_base::text::capitals::{CapitalContext, is_capitals};

/// Halves, thirds and so on that have a character of their own.
const VULGAR: &[(char, u64, u64)] = &[
    ('½', 1, 2),
    ('⅓', 1, 3),
    ('⅔', 2, 3),
    ('¼', 1, 4),
    ('¾', 3, 4),
    ('⅕', 1, 5),
    ('⅖', 2, 5),
    ('⅗', 3, 5),
    ('⅘', 4, 5),
    ('⅙', 1, 6),
    ('⅚', 5, 6),
    ('⅐', 1, 7),
    ('⅛', 1, 8),
    ('⅜', 3, 8),
    ('⅝', 5, 8),
    ('⅞', 7, 8),
    ('⅑', 1, 9),
    ('⅒', 1, 10),
];

/// Returns numerator and denominator of a fraction character such as ½; `None` for other
/// characters.
pub(super) fn vulgar(c: char) -> Option<(u64, u64)> {
    VULGAR
        .iter()
        .find(|row| row.0 == c)
        .map(|row| (row.1, row.2))
}

/// Returns the length in bytes of the initial run of characters that `belong`.
fn run(text: &str, belongs: impl Fn(char) -> bool) -> usize {
    text.find(|c| !belongs(c)).unwrap_or(text.len())
}

impl Reader<'_> {
    /// Reads `text` run by run. In a formula (`math`) hyphens are minus signs, slashes divide,
    /// single letters are variables.
    pub(super) fn runs(&self, text: &str, math: bool) -> String {
        let language = self.language;
        let mut spoken: Vec<String> = Vec::new();
        let mut rest = text;
        let mut before = ' ';
        while let Some(c) = rest.chars().next() {
            if spoken.len() >= super::WORD_TOKENS {
                break;
            }
            let next = rest[c.len_utf8()..].chars().next().unwrap_or(' ');
            let length = if c.is_ascii_digit() {
                let length = number_run(rest, language);
                spoken.push(self.digits(&rest[..length]));
                length
            } else if is_letter(c) {
                let joins = |c: char| is_letter(c) || !math && is_joiner(c);
                let length = run(rest, joins);
                let word = rest[..length].trim_end_matches(is_joiner);
                let after = rest[word.len()..].chars().next().unwrap_or(' ');
                // A letter next to a sign is a name ("R&B"), next to a dash mostly a word.
                let named = math || !is_break(before) || !is_break(after);
                spoken.push(match word.chars().count() {
                    1 if named => spelling::literal(word, language),
                    // "AT&T": so are capitals.
                    2 | 3 if named && is_capitals(word) => spelling::literal(word, language),
                    _ => self.letters(word, CapitalContext::Nothing),
                });
                word.len().max(c.len_utf8())
            } else {
                let and = self.language.pick(["and", "und", "e"]);
                let doubled = c == '/' && spoken.last().is_some_and(|last| last == and);
                if let Some(said) = self
                    .sign_between(c, before, next, math)
                    .filter(|_| !doubled)
                {
                    // A comma follows the preceding word.
                    match (said, spoken.last_mut()) {
                        (",", Some(last)) if !last.is_empty() && !last.ends_with(',') => {
                            last.push(',');
                        }
                        (",", _) => {}
                        (said, _) => spoken.push(said.to_owned()),
                    }
                } else if let Some((numerator, denominator)) = vulgar(c) {
                    spoken.extend(language.grammar().fraction(numerator, denominator));
                }
                c.len_utf8()
            };
            before = rest[..length].chars().next_back().unwrap_or(' ');
            rest = &rest[length..];
        }
        spoken.join(" ")
    }

    /// Digits of a run, as a number where they are one.
    fn digits(&self, text: &str) -> String {
        match Number::parse(text, self.language) {
            Some(number) => number.cardinal(self.language, Form::Alone),
            None => number::digits(text, self.language),
        }
    }

    /// Returns the spoken form of a sign between two characters; `None` if it is silent.
    fn sign_between(&self, c: char, before: char, next: char, math: bool) -> Option<&'static str> {
        let language = self.language;
        let digits = before.is_ascii_digit() && next.is_ascii_digit();
        let letters = is_letter(before) && is_letter(next);
        match c {
            '-' | '\u{2212}' if math || c == '\u{2212}' => spelling::sign('\u{2212}', language),
            '/' if math => Some(language.pick(["over", "durch", "sobre"])),
            '*' | '·' if math || digits => spelling::sign('×', language),
            '!' if math => Some(language.pick(["factorial", "Fakultät", "fatorial"])),
            '(' | ')' | '[' | ']' if math => spelling::sign(c, language),
            '<' if next == '=' => spelling::sign('≤', language),
            '>' if next == '=' => spelling::sign('≥', language),
            '=' if matches!(before, '<' | '>') => None,
            '^' if math || next.is_ascii_digit() || next == '-' => {
                Some(language.pick(["to the power of", "hoch", "elevado a"]))
            }
            '²' => Some(language.pick(["squared", "hoch zwei", "ao quadrado"])),
            '³' => Some(language.pick(["cubed", "hoch drei", "ao cubo"])),
            ':' if math || digits => Some(language.pick(["to", "zu", "para"])),
            '#' if next.is_ascii_digit() => Some(language.pick(["number", "Nummer", "número"])),
            '#' if is_letter(next) => Some(language.pick(["hashtag", "Hashtag", "hashtag"])),
            '/' if letters => Some(language.pick(["or", "oder", "ou"])),
            // A dot in a name or a version: "node.js", "1.2.3".
            '.' if (letters || digits) && before != '.' => spelling::sign('.', language),
            '-' | '_' | '*' | '"' | '\'' | '\u{2019}' | '~' | '|' | '^' => None,
            ','
            | ';'
            | ':'
            | '!'
            | '?'
            | '\u{2026}'
            | '('
            | ')'
            | '['
            | ']'
            | '{'
            | '}'
            | '.'
            | '\u{2012}'..='\u{2015}'
            | '\u{2e3a}' => Some(","),
            'º' => Some(language.pick(["degrees", "Grad", "graus"])),
            _ => spelling::sign(c, language),
        }
    }
}

/// Returns true if `c` separates words, such as a dash.
fn is_break(c: char) -> bool {
    matches!(
        c,
        ' ' | ',' | ';' | ':' | '!' | '?' | '\u{2026}' | '\u{2012}'..='\u{2015}'
    )
}

/// Returns the length of a number at the start of `text`: including grouping and decimal signs if
/// the whole is then a number, otherwise only its digits.
fn number_run(text: &str, language: Language) -> usize {
    let digits = run(text, |c| c.is_ascii_digit());
    let signed = run(text, |c| c.is_ascii_digit() || matches!(c, '.' | ','));
    let signed = text[..signed].trim_end_matches(['.', ',']).len();
    match Number::parse(&text[..signed], language) {
        Some(_) => signed,
        None => digits,
    }
}
