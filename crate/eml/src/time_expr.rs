//! Time expressions: `t1+2.5s-1m` (GEVH D.2.1 to D.2.3).

use crate::{Name, Span};
use std::borrow::Cow;

/// Time expression: a sum of seconds and named markers, for example `t1+2.5s`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TimeExpr {
    /// The sum of its numbers in seconds.
    pub offset_secs: f64,
    /// Named markers in source order; empty for a plain number.
    pub names: Vec<NameTerm>,
    /// Span in the source; that of the start tag if the expression is absent.
    pub span: Span,
}

/// Named marker in a [`TimeExpr`], added or subtracted.
#[derive(Clone, Debug, PartialEq)]
pub struct NameTerm {
    /// Name given by a `timeId` or a `tm`.
    pub name: Name,
    /// True if it is subtracted.
    pub negative: bool,
    /// Span in the source.
    pub span: Span,
}

impl TimeExpr {
    /// Returns true if it names a marker and so counts from the start of the script, also inside a
    /// group.
    #[must_use]
    pub fn is_absolute(&self) -> bool {
        !self.names.is_empty()
    }
}

/// Maximum number of seconds in a document, about 11 days. It keeps sums and repetitions finite.
pub(crate) const MAX_SECS: f64 = 1e6;

/// Error in a time expression, with its code, range and hint.
#[derive(Debug, PartialEq)]
pub(crate) struct Problem {
    pub(crate) code: &'static str,
    /// Bytes within the expression.
    pub(crate) start: usize,
    pub(crate) end: usize,
    pub(crate) message: String,
    pub(crate) hint: Cow<'static, str>,
}

/// Returns true if a `timeId` or a `tm` may use this name: a letter or `_`, then letters, digits,
/// `_` and `.`, and not readable as a number. A `-` would be a minus.
pub(crate) fn is_name(text: &str) -> bool {
    let mut chars = text.chars();
    chars.next().is_some_and(starts_name) && chars.all(continues_name) && !is_non_finite(text)
}

/// Parses `term (('+'|'-') term)*`, in which a term is a number with an optional unit or a name,
/// with an optional leading sign. `start` is the offset of `text` in the source.
pub(crate) fn parse(text: &str, start: u32) -> Result<TimeExpr, Problem> {
    if let Some(offset_secs) = plain(text) {
        let span = Span::from_offsets(start as usize, start as usize + text.len());
        return Ok(TimeExpr {
            offset_secs,
            names: Vec::new(),
            span,
        });
    }
    if let Some(expr) = moment(text, start) {
        return Ok(expr);
    }
    let at = |offset: usize| start.saturating_add(u32::try_from(offset).unwrap_or(u32::MAX));
    let mut lexer = Lexer { text, position: 0 };
    let mut expr = TimeExpr {
        span: Span::new(at(0), at(text.len())),
        ..TimeExpr::default()
    };
    let mut first = true;
    loop {
        lexer.skip_space();
        let sign = lexer.take(|c| matches!(c, '+' | '-'));
        lexer.skip_space();
        if sign.is_empty() && !first {
            return if lexer.rest().is_empty() {
                Ok(expr)
            } else {
                Err(lexer.unexpected("`+` or `-`"))
            };
        }
        if sign.len() > 1 {
            lexer.position -= sign.len();
            return Err(lexer.unexpected("one sign"));
        }
        first = false;
        let negative = sign == "-";
        let term_start = lexer.position;
        if lexer
            .rest()
            .starts_with(|c: char| c.is_ascii_digit() || c == '.')
        {
            let secs = lexer.seconds()?;
            expr.offset_secs += if negative { -secs } else { secs };
        } else {
            let name = lexer.take(continues_name);
            if is_non_finite(name) {
                return Err(Problem {
                    code: "eml::bad-number",
                    start: term_start,
                    end: lexer.position,
                    message: format!("`{name}` is not a finite number"),
                    hint: "".into(),
                });
            }
            if !is_name(name) {
                lexer.position = term_start;
                return Err(lexer.unexpected("a number or a name"));
            }
            if expr.names.is_empty() {
                // There is mostly one.
                expr.names.reserve_exact(1);
            }
            expr.names.push(NameTerm {
                name: name.into(),
                negative,
                span: Span::new(at(term_start), at(lexer.position)),
            });
        }
    }
}

/// Parses a time expression in its most common form, a name with an added or subtracted plain
/// number; otherwise `None`.
fn moment(text: &str, start: u32) -> Option<TimeExpr> {
    let bytes = text.as_bytes();
    let in_name = |b: &u8| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'.');
    let length = bytes.iter().position(|b| !in_name(b));
    let (name, rest) = text.split_at(length.unwrap_or(bytes.len()));
    let first = *bytes.first()?;
    if !(first.is_ascii_alphabetic() || first == b'_') || is_non_finite(name) {
        return None;
    }
    let offset_secs = match rest.as_bytes() {
        [] => 0.0,
        [sign @ (b'+' | b'-'), ..] => {
            let number = rest[1..].strip_suffix('s').unwrap_or(&rest[1..]);
            let secs = plain(number)?;
            // A sum from 0 on is never -0.
            0.0 + if *sign == b'-' { -secs } else { secs }
        }
        _ => return None,
    };
    let span = |end: usize| Span::from_offsets(start as usize, start as usize + end);
    Some(TimeExpr {
        offset_secs,
        names: vec![NameTerm {
            name: name.into(),
            negative: false,
            span: span(name.len()),
        }],
        span: span(text.len()),
    })
}

/// Parses a number of digits and a point only; `None` for other text.
pub(crate) fn unsigned(text: &str) -> Option<f64> {
    let is_plain = text.bytes().all(|b| b.is_ascii_digit() || b == b'.');
    is_plain.then(|| text.parse().ok()).flatten()
}

/// Parses a time expression that is a plain number, seconds; otherwise `None`.
fn plain(text: &str) -> Option<f64> {
    unsigned(text).filter(|&secs| secs <= MAX_SECS)
}

/// Reads a length: one number with an optional unit.
pub(crate) fn parse_secs(text: &str) -> Result<f64, Problem> {
    if let Some(secs) = plain(text) {
        return Ok(secs);
    }
    let expr = parse(text, 0)?;
    if expr.is_absolute() {
        return Err(Problem {
            code: "eml::bad-time",
            start: 0,
            end: text.len(),
            message: format!(
                "expected a length in seconds, found {}",
                crate::suggest::quoted(text)
            ),
            hint: "write seconds, such as 1.5 or 1.5s".into(),
        });
    }
    Ok(expr.offset_secs)
}

fn starts_name(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

fn continues_name(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '_' | '.')
}

pub(crate) fn is_non_finite(text: &str) -> bool {
    ["nan", "inf", "infinity"]
        .iter()
        .any(|n| text.eq_ignore_ascii_case(n))
}

struct Lexer<'a> {
    text: &'a str,
    position: usize,
}

impl<'a> Lexer<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.position..]
    }

    fn take(&mut self, wanted: impl Fn(char) -> bool) -> &'a str {
        let rest = self.rest();
        let length = rest.find(|c| !wanted(c)).unwrap_or(rest.len());
        self.position += length;
        &rest[..length]
    }

    fn skip_space(&mut self) {
        // The next character is rarely a space.
        if !self.rest().starts_with(|c: char| c.is_ascii_graphic()) {
            self.take(char::is_whitespace);
        }
    }

    /// Parses a number with its unit and returns seconds.
    fn seconds(&mut self) -> Result<f64, Problem> {
        let start = self.position;
        self.take(|c| c.is_ascii_digit() || c == '.');
        let exponent = self.rest();
        let after = exponent.strip_prefix(['e', 'E']);
        let digits = after.map(|r| r.strip_prefix(['+', '-']).unwrap_or(r));
        if digits.is_some_and(|d| d.starts_with(|c: char| c.is_ascii_digit())) {
            self.position += exponent.len() - digits.unwrap_or("").len();
            self.take(|c| c.is_ascii_digit());
        }
        let number = &self.text[start..self.position];
        let problem = |code, end, message: String, hint: &'static str| {
            Err(Problem {
                code,
                start,
                end,
                message,
                hint: hint.into(),
            })
        };
        let value: f64 = match number.parse() {
            Ok(value) => value,
            Err(_) => {
                let message = format!("{} is not a number", crate::suggest::quoted(number));
                return problem("eml::bad-number", self.position, message, "");
            }
        };
        self.skip_space();
        let unit = self.take(char::is_alphanumeric);
        let factor = match unit {
            "" | "s" => 1.0,
            "m" => 60.0,
            "h" => 3600.0,
            _ => {
                let message = format!("{} is not a unit of time", crate::suggest::quoted(unit));
                let hint = "units are s (seconds, the default), m (minutes) and h (hours)";
                return problem("eml::bad-time", self.position, message, hint);
            }
        };
        let secs = value * factor;
        if secs > MAX_SECS {
            let message = "times are limited to 1000000 seconds".to_owned();
            return problem("eml::bad-number", self.position, message, "");
        }
        Ok(secs)
    }

    fn unexpected(&self, wanted: &str) -> Problem {
        let next = self.rest().chars().next();
        let found = match next {
            Some(c) => format!("`{c}`"),
            None => "the end".to_owned(),
        };
        Problem {
            code: "eml::bad-time",
            start: self.position,
            end: self.position + next.map_or(0, char::len_utf8),
            message: format!("expected {wanted} in the time expression, found {found}"),
            hint: match next {
                Some(',') => "use a point as the decimal separator",
                _ => "times look like 2.5, t1, t1-0.1s or 5+t1",
            }
            .into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(text: &str) -> Result<(f64, String), &'static str> {
        let expr = parse(text, 0).map_err(|p| p.code)?;
        let sign = |n: &NameTerm| if n.negative { "-" } else { "+" };
        Ok((
            expr.offset_secs,
            expr.names
                .iter()
                .map(|n| sign(n).to_owned() + &n.name)
                .collect(),
        ))
    }

    #[test]
    fn terms_come_in_any_order_with_units() {
        assert_eq!(flat("5.0"), Ok((5.0, "".into())));
        assert_eq!(flat("t1+4s-1s"), Ok((3.0, "+t1".into())));
        assert_eq!(flat("5+t1"), Ok((5.0, "+t1".into())));
        assert_eq!(flat(" -1m + 2 h - t_2 "), Ok((7140.0, "-t_2".into())));
        assert_eq!(flat("1e-3"), Ok((0.001, "".into())));
        assert_eq!(flat(".5"), Ok((0.5, "".into())));
        assert_eq!(flat("5+m"), Ok((5.0, "+m".into())));
    }

    #[test]
    fn the_usual_expressions_are_read_as_all_others() {
        let usual = ["t1", "_a.b+2", "t1-0.1s", "t1-0", "Info+12.25"];
        let others = [
            "t1+s",
            "t1+",
            "nan",
            "inf+1",
            "t1+1m",
            "t1+1+2",
            "t1+1000001",
            "é+1",
        ];
        for text in usual.iter().chain(&others) {
            // White space is left to the general reader.
            let spaced = parse(&format!("{text} "), 7);
            if let Some(expr) = moment(text, 7) {
                let general = spaced.unwrap();
                assert_eq!(
                    (expr.offset_secs, &expr.names),
                    (general.offset_secs, &general.names)
                );
                assert_eq!(expr.offset_secs.to_bits(), general.offset_secs.to_bits());
            }
            assert_eq!(moment(text, 7).is_some(), usual.contains(text), "{text}");
        }
    }

    #[test]
    fn what_is_no_time_says_why() {
        for bad in [
            "", "+", "5,0", "t1 t2", "5 +", "--5", "3 min", "5x", "t1**2",
        ] {
            assert_eq!(flat(bad), Err("eml::bad-time"), "{bad}");
        }
        for bad in ["NaN", "inf", "-Infinity", "1e999", "1.2.3", ".", "1000001"] {
            assert_eq!(flat(bad), Err("eml::bad-number"), "{bad}");
        }
    }

    #[test]
    fn spans_point_into_the_source() {
        let expr = parse("1+ab", 100).unwrap();
        assert_eq!(expr.names[0].span, Span::new(102, 104));
        assert_eq!(expr.span, Span::new(100, 104));
    }

    #[test]
    fn names_have_no_minus_and_are_no_numbers() {
        assert!(
            is_name("t1") && is_name("_x.y") && is_name("é"),
            "valid names are accepted"
        );
        assert!(
            !is_name("t-1") && !is_name("1t") && !is_name("") && !is_name("nan"),
            "names with a minus, digits and NaN are rejected"
        );
    }

    #[test]
    fn a_length_names_no_moment() {
        assert_eq!(parse_secs("0.2s"), Ok(0.2));
        assert_eq!(parse_secs("t1").unwrap_err().code, "eml::bad-time");
    }
}
