//! Meaning of SABLE's words and numbers: one table for all front ends with pitch, rate, loudness,
//! emphasis and pauses.
//!
//! The factors of words are those of Festival's `sable-mode.scm`. Emphasis is interpreted as in the
//! description of SABLE 1.0. The lengths of pauses are *designed*, near Festival's mean pause of
//! 200 ms and its long one at the end of an utterance.

use core::fmt::Write as _;

use crate::content::{Boundary, Setting};
use crate::style::NO_EMPHASIS;

/// Maximum length of a pause, milliseconds.
pub const MAX_MSEC: u32 = 60_000;

/// Emphasis of an EMPH element without a level.
pub const MODERATE_EMPHASIS: f64 = 1.0;

/// Pauses of SABLE's levels, milliseconds; a number from 0 to 3 counts along them.
pub const PAUSES: [(&str, f64); 4] = [
    ("none", 0.0),
    ("small", 150.0),
    ("medium", 350.0),
    ("large", 800.0),
];

/// Emphasis levels by SABLE's words.
pub const EMPHASES: [(&str, f64); 4] = [
    ("reduced", 0.0),
    ("none", NO_EMPHASIS),
    ("moderate", MODERATE_EMPHASIS),
    ("strong", 2.0),
];

/// Prosodic property that SABLE sets by words or numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// The base or the middle line of the pitch; numbers are hertz.
    Height,
    /// The range of the pitch; numbers are hertz.
    Range,
    /// The pace; numbers are words a minute.
    Speed,
    /// The amplitude; numbers are gains, and 0 is one.
    Loudness,
}

impl Property {
    /// All properties.
    pub const ALL: [Self; 4] = [Self::Height, Self::Range, Self::Speed, Self::Loudness];

    /// Returns the words of the property with their factors on the surrounding level.
    #[must_use]
    pub fn words(self) -> &'static [(&'static str, f64)] {
        match self {
            Self::Height => &[
                ("highest", 1.2),
                ("high", 1.1),
                ("medium", 1.0),
                ("low", 0.9),
                ("lowest", 0.8),
            ],
            Self::Range => &[
                ("largest", 1.2),
                ("large", 1.1),
                ("medium", 1.0),
                ("small", 0.9),
                ("smallest", 0.8),
                ("highest", 1.2),
                ("high", 1.1),
                ("low", 0.9),
                ("lowest", 0.8),
            ],
            Self::Speed => &[
                ("fastest", 1.5),
                ("fast", 1.2),
                ("medium", 1.0),
                ("slow", 0.8),
                ("slowest", 0.6),
            ],
            Self::Loudness => &[
                ("loudest", 2.0),
                ("loud", 1.5),
                ("medium", 1.0),
                ("quiet", 0.5),
            ],
        }
    }

    /// Returns the setting of a word in any case; `default` is the voice's own value, `None` an
    /// unknown word.
    #[must_use]
    pub fn word(self, word: &str) -> Option<Setting> {
        if word.eq_ignore_ascii_case("default") {
            return Some(Setting::Default);
        }
        let (_, factor) = self
            .words()
            .iter()
            .find(|(name, _)| name.eq_ignore_ascii_case(word))?;
        Some(Setting::Factor(*factor))
    }

    /// Returns a change in percent of the surrounding level; `None` if the result is zero or below.
    /// Loudness may be zero.
    #[must_use]
    pub fn percent(self, percent: f64) -> Option<Setting> {
        self.change(percent / 100.0)
    }

    /// Returns the setting for a relative change, as a share of 1; `None` if it is not allowed.
    fn change(self, share: f64) -> Option<Setting> {
        self.positive(1.0 + share).map(Setting::Factor)
    }

    /// Returns a number in the property's unit; `None` if it is invalid.
    #[must_use]
    pub fn number(self, number: f64) -> Option<Setting> {
        self.positive(number).map(Setting::Value)
    }

    fn positive(self, x: f64) -> Option<f64> {
        let enough = x > 0.0 || (self == Self::Loudness && x == 0.0);
        (x.is_finite() && enough).then_some(x)
    }

    /// Parses an attribute: a word, a change in percent with or without a sign, or an unsigned
    /// number.
    #[must_use]
    pub fn read(self, text: &str) -> Option<Setting> {
        let text = text.trim();
        if let Some(number) = text.strip_suffix('%') {
            return self.change(shifted(number.trim_end(), -2)?);
        }
        match text.as_bytes().first()? {
            b'0'..=b'9' | b'.' => self.number(number(text)?),
            _ => self.word(text),
        }
    }

    /// Formats a setting for [`Property::read`], as accurately as possible; `None` if it changes
    /// nothing.
    #[must_use]
    pub fn write(self, setting: Setting) -> Option<String> {
        match setting {
            Setting::Default => Some("default".to_owned()),
            Setting::Value(value) => self.positive(value).map(|v| format!("{v}")),
            Setting::Factor(factor) => self.positive(factor).map(change_text),
        }
    }
}

/// Formats a factor as a signed change in percent; short if that is exact.
pub(crate) fn change_text(factor: f64) -> String {
    let change = factor - 1.0;
    let short = format!("{:.6}", change * 100.0);
    let short = short.trim_end_matches('0').trim_end_matches('.');
    let text = match shifted(short, -2) {
        Some(share) if 1.0 + share == factor => short.to_owned(),
        _ => shifted_text(change, 2),
    };
    let sign = if text.starts_with('-') { "" } else { "+" };
    format!("{sign}{text}%")
}

/// Parses a decimal number with an optional sign; infinities and exponents are rejected.
#[must_use]
pub fn number(text: &str) -> Option<f64> {
    shifted(text, 0)
}

/// Parses a decimal number, multiplied by a power of ten and rounded once.
pub(crate) fn shifted(text: &str, exponent: i32) -> Option<f64> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    let plain = digits.bytes().all(|b| b.is_ascii_digit() || b == b'.');
    if !plain || digits.is_empty() {
        return None;
    }
    let number: f64 = format!("{text}e{exponent}").parse().ok()?;
    number.is_finite().then_some(number)
}

/// Formats a number times a power of ten as a decimal; exact inverse of [`shifted`].
pub(crate) fn shifted_text(number: f64, exponent: i32) -> String {
    let short = format!("{number:e}");
    let (mantissa, power) = short.split_once('e').unwrap_or((&short, "0"));
    let power = power.parse::<i32>().unwrap_or(0) + exponent;
    let (sign, mantissa) = match mantissa.strip_prefix('-') {
        Some(rest) => ("-", rest),
        None => ("", mantissa),
    };
    let digits = mantissa.replace('.', "");
    // The decimal point follows this many digits.
    let point = power + 1;
    let mut out = sign.to_owned();
    if point <= 0 {
        out.push_str("0.");
        out.extend(core::iter::repeat_n('0', point.unsigned_abs() as usize));
        out.push_str(&digits);
    } else {
        let whole = point.unsigned_abs() as usize;
        // Writing into a string cannot fail.
        let _ = write!(out, "{digits:0<whole$}");
        if digits.len() > whole {
            out.insert(sign.len() + whole, '.');
        }
    }
    out
}

/// Parses an emphasis on SABLE's scale: a word in any case, or a number, limited to 0 to 2.
#[must_use]
pub fn emphasis(text: &str) -> Option<f64> {
    let text = text.trim();
    let word = EMPHASES
        .iter()
        .find(|(name, _)| name.eq_ignore_ascii_case(text));
    word.map(|(_, level)| *level)
        .or_else(|| number(text).map(|level| level.clamp(0.0, 2.0)))
}

/// Parses the length of a pause in milliseconds: a word in any case or a number as in
/// [`pause_of_level`].
#[must_use]
pub fn pause(text: &str) -> Option<f64> {
    let text = text.trim();
    let word = PAUSES
        .iter()
        .find(|(name, _)| name.eq_ignore_ascii_case(text));
    word.map(|(_, msec)| *msec)
        .or_else(|| number(text).map(pause_of_level))
}

/// Returns the length of a pause in milliseconds for a level from 0 (none) to 3 (large), clamped to
/// that range.
#[must_use]
pub fn pause_of_level(level: f64) -> f64 {
    let level = level.clamp(0.0, 3.0);
    // NaN counts as none; the cast saturates.
    let below = (level as usize).min(2);
    raconteur_base::curve::lerp(PAUSES[below].1, PAUSES[below + 1].1, level - below as f64)
}

/// Returns the boundary of a punctuation mark, or of its name in SABLE 0.2; `None` if unknown.
#[must_use]
pub fn boundary(text: &str) -> Option<Boundary> {
    let lower = text.trim().to_ascii_lowercase();
    Some(match lower.as_str() {
        "?" | "quest" => Boundary::Question,
        "!" | "excl" => Boundary::Exclamation,
        "." | "period" => Boundary::Statement,
        "," | "comma" => Boundary::Comma,
        _ => return None,
    })
}

/// Returns the punctuation mark of a boundary.
#[must_use]
pub fn boundary_sign(boundary: Boundary) -> &'static str {
    match boundary {
        Boundary::Question => "?",
        Boundary::Exclamation => "!",
        Boundary::Statement => ".",
        Boundary::Comma => ",",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_percents_and_numbers_are_settings() {
        use Property::{Height, Loudness, Range, Speed};
        assert_eq!(Height.read("Highest"), Some(Setting::Factor(1.2)));
        assert_eq!(Range.read("smallest"), Some(Setting::Factor(0.8)));
        assert_eq!(Range.read("low"), Some(Setting::Factor(0.9)));
        assert_eq!(Speed.read(" +20% "), Some(Setting::Factor(1.2)));
        assert_eq!(Speed.read("-40%"), Some(Setting::Factor(0.6)));
        assert_eq!(Speed.read("20 %"), Some(Setting::Factor(1.2)));
        assert_eq!(Speed.read("90"), Some(Setting::Value(90.0)));
        assert_eq!(Loudness.read("default"), Some(Setting::Default));
        assert_eq!(Loudness.read("0"), Some(Setting::Value(0.0)));
        assert_eq!(Loudness.read("-100%"), Some(Setting::Factor(0.0)));
        for bad in [
            "", "%", "+5", "-5", "0", "-100%", "1e3", "inf", "nan", "loud", "1.2.3",
        ] {
            assert_eq!(Speed.read(bad), None, "{bad}");
        }
    }

    #[test]
    fn what_is_written_is_read_the_same() {
        for property in Property::ALL {
            for (word, factor) in property.words() {
                assert_eq!(property.word(word), Some(Setting::Factor(*factor)));
                let text = property.write(Setting::Factor(*factor)).unwrap();
                assert_eq!(
                    property.read(&text),
                    Some(Setting::Factor(*factor)),
                    "{text}"
                );
            }
        }
        let speed = Property::Speed;
        assert_eq!(speed.write(Setting::Factor(1.2)).as_deref(), Some("+20%"));
        assert_eq!(speed.write(Setting::Factor(0.6)).as_deref(), Some("-40%"));
        assert_eq!(speed.write(Setting::Factor(1.0)).as_deref(), Some("+0%"));
        assert_eq!(speed.write(Setting::Value(92.5)).as_deref(), Some("92.5"));
        assert_eq!(speed.write(Setting::Factor(f64::NAN)), None);
    }

    #[test]
    fn decimals_are_shifted_without_rounding() {
        for x in [
            1.2,
            0.1,
            1e-9,
            123.456,
            1e20,
            0.0,
            -0.375,
            1.0 / 3.0,
            5e-324,
        ] {
            let text = shifted_text(x, 2);
            assert_eq!(shifted(&text, -2), Some(x), "{text}");
        }
        assert_eq!(shifted_text(1.2, 2), "120");
        assert_eq!(shifted_text(0.005, 2), "0.5");
        assert_eq!(shifted_text(12.345, 2), "1234.5");
    }

    #[test]
    fn pauses_and_emphases_have_levels() {
        assert_eq!(pause("Large"), Some(800.0));
        assert_eq!(
            [pause("1.5"), pause("99"), pause("-1")],
            [Some(250.0), Some(800.0), Some(0.0)]
        );
        assert_eq!(pause_of_level(f64::NAN).to_bits(), f64::NAN.to_bits());
        assert_eq!(
            [emphasis("strong"), emphasis("9"), emphasis("0.5")],
            [Some(2.0), Some(2.0), Some(0.5)]
        );
        assert_eq!([emphasis("very"), pause("tiny")], [None, None]);
        for b in [
            Boundary::Question,
            Boundary::Exclamation,
            Boundary::Statement,
            Boundary::Comma,
        ] {
            assert_eq!(boundary(boundary_sign(b)), Some(b));
        }
        assert_eq!(boundary("Quest"), Some(Boundary::Question));
    }
}
