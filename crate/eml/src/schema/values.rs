//! Reads the values of attributes by the table. A value that does not fit is
//! reported and counts as left out.

use super::affect::{self, Meant};
use super::attribute::MAX_NUMBER;
use super::context::list;
use super::{Attribute, Context, Fields, Kind, Presence};
use crate::record::Value;
use crate::suggest::{nearest, quoted};
use crate::time_expr::{self, Problem};
use crate::{Diagnostic, EmotionSpace, Name, Span, TimeExpr, markup};
use std::borrow::Cow;

/// The most numbers in one list.
const MOST_NUMBERS: usize = 64;

/// Where on a gesture's time line a key lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum KeyTime {
    /// Seconds from its start.
    Secs(f64),
    /// A fraction of its duration.
    Fraction(f64),
}

impl Context<'_> {
    /// The value of an attribute by its kind: as written, or else the default.
    pub(crate) fn value(&mut self, fields: &Fields<'_>, name: &str) -> Value {
        let Some((attribute, written)) = fields.get(name) else {
            return Value::None;
        };
        let kind = beside(attribute, fields);
        let default = || match attribute.default {
            Presence::Default(text) => parse(kind, text).unwrap_or(Value::None),
            Presence::Required | Presence::Optional => Value::None,
        };
        let Some(written) = written else {
            return self.placed(fields, name).unwrap_or_else(default);
        };
        if written.is_plain
            && let Some(number) = usual_number(kind, written.value)
        {
            return Value::Number(number);
        }
        let resolved;
        let text = if written.is_plain {
            written.value
        } else {
            resolved = markup::resolve(written, self.sink);
            &*resolved
        };
        if is_emotion(fields, name) {
            return self.emotion_word(attribute, trimmed(text), written.value_span());
        }
        let text = match kind {
            Kind::Text => text,
            _ => self.unaliased(attribute, trimmed(text), written.value_span()),
        };
        match parse(kind, text) {
            // A switch among numbers is a number.
            Ok(Value::Flag(flag)) if attribute.kind == Kind::NumberOrBool => {
                Value::Number(f64::from(u8::from(flag)))
            }
            Ok(value) => value,
            Err(problem) => {
                self.report(problem, written.value_span());
                default()
            }
        }
    }

    /// A word of emotion; one beyond the table's leaves its place for the attributes that follow.
    fn emotion_word(&mut self, attribute: &Attribute, text: &str, span: Span) -> Value {
        self.placed = None;
        match (parse(attribute.kind, text), affect::meant(text)) {
            (Ok(value), _) => value,
            (Err(_), Some(Meant::Word(word))) => {
                self.report_spelling(text, word, span);
                Value::Word(word)
            }
            (Err(_), Some(Meant::Place(place))) => {
                self.sink.push(affect::told(text, place, span));
                self.placed = Some(place);
                Value::None
            }
            (Err(problem), None) => {
                self.report(problem, span);
                Value::None
            }
        }
    }

    /// What the place of an emotion's word gives an attribute that is not written.
    fn placed(&self, fields: &Fields<'_>, name: &str) -> Option<Value> {
        let [activation, evaluation] = self.placed.filter(|_| fields.element.name == "emotion")?;
        match name {
            "activation" => Some(Value::Number(activation)),
            "evaluation" => Some(Value::Number(evaluation)),
            "space" => Some(Value::Word(EmotionSpace::Disc.word())),
            _ => None,
        }
    }

    /// The table's word for another one.
    fn unaliased<'x>(&mut self, attribute: &Attribute, text: &'x str, span: Span) -> &'x str {
        let aliases = attribute.word_aliases.iter();
        match aliases
            .copied()
            .find(|(alias, _)| alias.eq_ignore_ascii_case(text))
        {
            Some((_, word)) => {
                self.report_spelling(text, word, span);
                word
            }
            None => text,
        }
    }

    /// Any text.
    pub(crate) fn text(&mut self, fields: &Fields<'_>, name: &str) -> Option<Name> {
        match self.value(fields, name) {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// A truth value.
    pub(crate) fn boolean(&mut self, fields: &Fields<'_>, name: &str) -> Option<bool> {
        match self.value(fields, name) {
            Value::Flag(flag) => Some(flag),
            _ => None,
        }
    }

    /// A number, whole number or length in seconds.
    pub(crate) fn number(&mut self, fields: &Fields<'_>, name: &str) -> Option<f64> {
        match self.value(fields, name) {
            Value::Number(number) => Some(number),
            _ => None,
        }
    }

    /// The table's spelling of a word.
    pub(crate) fn choice(&mut self, fields: &Fields<'_>, name: &str) -> Option<&'static str> {
        match self.value(fields, name) {
            Value::Word(word) => Some(word),
            _ => None,
        }
    }

    /// A time expression; `Err` when it is written and wrong.
    pub(crate) fn time(&mut self, fields: &Fields<'_>) -> Result<TimeExpr, ()> {
        let written = fields.get("time").and_then(|(_, written)| written);
        let Some(written) = written else {
            return Ok(TimeExpr {
                span: fields.tag,
                ..TimeExpr::default()
            });
        };
        let text = markup::resolve(written, self.sink);
        // Inside a value with references offsets shift; the whole value is shown then.
        let verbatim = matches!(text, Cow::Borrowed(_));
        match time_expr::parse(&text, written.value_start) {
            Ok(mut expr) => {
                if !verbatim {
                    expr.span = written.value_span();
                    expr.names.iter_mut().for_each(|n| n.span = expr.span);
                }
                Ok(expr)
            }
            Err(problem) => {
                let span = part(written.value_span(), verbatim.then_some(&problem));
                self.report(problem, span);
                Err(())
            }
        }
    }

    /// An offset in a gesture; `Err` when it is written and wrong.
    pub(crate) fn key_time(&mut self, fields: &Fields<'_>) -> Result<Option<KeyTime>, ()> {
        let Some(written) = fields.get("time").and_then(|(_, written)| written) else {
            return Ok(None);
        };
        let text = markup::resolve(written, self.sink);
        let read = || {
            let text = trimmed(&text);
            let (value, percent) = match text.strip_suffix('%') {
                Some(percent) => (number(percent.trim_end())? / 100.0, true),
                None => (time_expr::parse_secs(text)?, false),
            };
            let value = in_range(value, 0.0, MAX_NUMBER, text)?;
            Ok(Some(if percent {
                KeyTime::Fraction(value)
            } else {
                KeyTime::Secs(value)
            }))
        };
        read().map_err(|problem| self.report(problem, written.value_span()))
    }

    fn report(&mut self, problem: Problem, span: Span) {
        let hint = (!problem.hint.is_empty()).then(|| problem.hint.into_owned());
        self.push_with_hint(Diagnostic::error(problem.code, span, problem.message), hint);
    }
}

/// Whether an attribute holds a word of emotion.
fn is_emotion(fields: &Fields<'_>, name: &str) -> bool {
    name == "type" && fields.element.extension && fields.element.name == "emotion"
}

/// What an attribute may hold beside what else is written.
fn beside(attribute: &Attribute, fields: &Fields<'_>) -> Kind {
    let has = |other: &str, word: &str| {
        let written = fields.get(other).and_then(|(_, written)| written);
        written.is_some_and(|w| w.value.trim().eq_ignore_ascii_case(word))
    };
    let mut kinds = attribute.beside.iter();
    let found = kinds.find(|b| has(b.attribute, b.word));
    found.map_or(attribute.kind, |b| b.kind)
}

/// A number as nearly every one is written; none for all that needs a closer look. Numbers
/// are half of what a script's attributes hold.
fn usual_number(kind: Kind, text: &str) -> Option<f64> {
    let (least, most) = match kind {
        Kind::Number { least, most } => (least, most),
        Kind::Seconds { most } => (0.0, most),
        _ => return None,
    };
    let (sign, digits) = match text.strip_prefix('-') {
        Some(digits) if least < 0.0 => (-1.0, digits),
        _ => (1.0, text),
    };
    let value = sign * time_expr::unsigned(digits)?;
    (value >= least && value <= most && value.abs() <= MAX_NUMBER).then_some(value)
}

/// A text without the white space around it; there is nearly always none.
fn trimmed(text: &str) -> &str {
    let is_mark = |b: Option<&u8>| b.is_some_and(u8::is_ascii_graphic);
    if is_mark(text.as_bytes().first()) && is_mark(text.as_bytes().last()) {
        text
    } else {
        text.trim()
    }
}

fn part(value: Span, problem: Option<&Problem>) -> Span {
    match problem {
        Some(p) => {
            let start = value.start as usize;
            Span::of(start + p.start, start + p.end.max(p.start))
        }
        None => value,
    }
}

/// Reads a text by the kind of its attribute.
pub(crate) fn parse(kind: Kind, text: &str) -> Result<Value, Problem> {
    let wrong = |code, wanted: &str| Err(unexpected(code, text, wanted));
    match kind {
        Kind::Text => Ok(Value::Text(text.into())),
        Kind::Name if !time_expr::is_name(text) => Err(Problem {
            hint: "a name is a letter followed by letters, digits, `_` and `.`; `-` is a minus"
                .into(),
            ..problem(
                "eml::bad-name",
                format!("{} cannot name a moment", quoted(text)),
            )
        }),
        Kind::Identifier if text.is_empty() => wrong("eml::bad-name", "a name"),
        Kind::Path if !is_inner_path(text) => Err(Problem {
            hint: "paths are relative, without `..`, `:` and `\\`".into(),
            ..problem(
                "eml::bad-path",
                format!("{} does not stay in its folder", quoted(text)),
            )
        }),
        Kind::Url if !is_safe_url(text) => wrong(
            "eml::bad-url",
            "a relative address or one that starts with http: or https:",
        ),
        Kind::Name | Kind::Identifier | Kind::Path | Kind::Url => Ok(Value::Text(text.into())),
        Kind::Bool => match text {
            "1" => Ok(Value::Flag(true)),
            "0" => Ok(Value::Flag(false)),
            _ if text.eq_ignore_ascii_case("true") => Ok(Value::Flag(true)),
            _ if text.eq_ignore_ascii_case("false") => Ok(Value::Flag(false)),
            _ => wrong("eml::bad-boolean", "true, false, 1 or 0"),
        },
        Kind::Number { least, most } => {
            in_range(number(text)?, least, most, text).map(Value::Number)
        }
        Kind::Integer { least, most } => match text.parse::<i64>() {
            Ok(value) => in_range(value as f64, least as f64, most as f64, text).map(Value::Number),
            Err(_) => wrong("eml::bad-number", "a whole number"),
        },
        Kind::Seconds { most } => {
            let secs = time_expr::parse_secs(text)?;
            in_range(secs, 0.0, most, text).map(Value::Number)
        }
        // Both are read together with what stands around them.
        Kind::Time | Kind::KeyTime => Ok(Value::None),
        Kind::Choice(words) => word(words, text).ok_or_else(|| no_word(text, words)),
        Kind::Level {
            words,
            numbers,
            percent,
        } => level(words, numbers, percent, text),
        Kind::NumberOrBool if text.eq_ignore_ascii_case("true") => Ok(Value::Number(1.0)),
        Kind::NumberOrBool if text.eq_ignore_ascii_case("false") => Ok(Value::Number(0.0)),
        Kind::NumberOrBool => number(text).map(Value::Number),
        Kind::NumberOrText => Ok(match number(text) {
            Ok(value) => Value::Number(value),
            Err(_) => Value::Text(text.into()),
        }),
        Kind::Numbers => {
            let mut numbers = Vec::new();
            for word in text.split_ascii_whitespace() {
                numbers.push(number(word)?);
                if numbers.len() > MOST_NUMBERS {
                    return wrong("eml::bad-number", "at most 64 numbers");
                }
            }
            Ok(Value::Numbers(numbers))
        }
        Kind::Color => match color(text) {
            Some(color) => Ok(Value::Color(color)),
            None => wrong("eml::bad-color", "a colour such as #ffcc00"),
        },
    }
}

/// Whether a path stays in its folder on every system.
pub(super) fn is_inner_path(text: &str) -> bool {
    !text.is_empty()
        && !text.starts_with('/')
        && !text.contains([':', '\\'])
        && !text.contains(char::is_control)
        && text.split('/').all(|part| part != "..")
}

/// Whether an address is relative to the page, or is one that a page may fetch.
fn is_safe_url(text: &str) -> bool {
    let before = text.split(['/', '?', '#']).next().unwrap_or("");
    let scheme = before.split_once(':').map(|(scheme, _)| scheme);
    !text.is_empty()
        && !text.contains(char::is_control)
        && scheme.is_none_or(|s| s.eq_ignore_ascii_case("http") || s.eq_ignore_ascii_case("https"))
}

fn color(text: &str) -> Option<[u8; 3]> {
    let digits = text.strip_prefix('#')?;
    if digits.len() != 6 || !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return None;
    }
    let rgb = u32::from_str_radix(digits, 16).ok()?;
    let [_, red, green, blue] = rgb.to_be_bytes();
    Some([red, green, blue])
}

fn level(
    words: &'static [&'static str],
    [least, most]: [f64; 2],
    percent: Option<[f64; 2]>,
    text: &str,
) -> Result<Value, Problem> {
    if let Some(word) = word(words, text) {
        return Ok(word);
    }
    if let Some([least, most]) = percent
        && let Some(change) = text.strip_suffix('%')
    {
        let change = number(change.trim_end())?;
        let of = in_range(change, least, most, text).map(Value::Percent);
        return of.map_err(|problem| Problem {
            message: problem.message.replace(", found", " percent, found"),
            ..problem
        });
    }
    match number(text) {
        Ok(value) => in_range(value, least, most, text).map(Value::Number),
        Err(_) if text.starts_with(char::is_alphabetic) => Err(no_word(text, words)),
        Err(problem) => Err(problem),
    }
}

fn number(text: &str) -> Result<f64, Problem> {
    let code = "eml::bad-number";
    match text.parse::<f64>() {
        Ok(value) if value.abs() <= MAX_NUMBER => Ok(value),
        Ok(value) if value.is_finite() => Err(Problem {
            hint: "the largest is 1000000".into(),
            ..problem(code, format!("{} is too large", quoted(text)))
        }),
        Ok(_) => Err(problem(
            code,
            format!("{} is not a finite number", quoted(text)),
        )),
        Err(_) => Err(Problem {
            hint: if text.contains(',') {
                "decimals are written with a point".into()
            } else {
                "".into()
            },
            ..problem(code, format!("{} is not a number", quoted(text)))
        }),
    }
}

fn in_range(value: f64, least: f64, most: f64, text: &str) -> Result<f64, Problem> {
    if (least..=most).contains(&value) {
        return Ok(value);
    }
    let wanted = if most < MAX_NUMBER {
        format!("{least} to {most}")
    } else if value < least {
        format!("at least {least}")
    } else {
        format!("at most {most}")
    };
    let nearest = value.clamp(least, most);
    Err(Problem {
        hint: format!("it counts as left out; the nearest value is {nearest}").into(),
        ..unexpected("eml::out-of-range", text, &wanted)
    })
}

fn problem(code: &'static str, message: String) -> Problem {
    Problem {
        code,
        start: 0,
        end: 0,
        message,
        hint: "".into(),
    }
}

fn unexpected(code: &'static str, text: &str, wanted: &str) -> Problem {
    problem(code, format!("expected {wanted}, found {}", quoted(text)))
}

fn word(words: &'static [&'static str], text: &str) -> Option<Value> {
    let word = words.iter().copied().find(|w| w.eq_ignore_ascii_case(text));
    word.map(Value::Word)
}

fn no_word(text: &str, words: &'static [&'static str]) -> Problem {
    let mut problem = unexpected("eml::bad-choice", text, &list(words));
    if let Some(near) = nearest(text, words.iter().copied()) {
        problem.hint = format!("did you mean `{near}`?").into();
    }
    problem
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_default_of_the_table_fits_its_kind() {
        for element in crate::schema::ELEMENTS {
            for attribute in element.all_attributes() {
                if let Presence::Default(text) = attribute.default {
                    let value = parse(attribute.kind, text);
                    assert!(value.is_ok(), "{} {}", element.name, attribute.name);
                }
            }
        }
    }

    #[test]
    fn paths_and_addresses_stay_where_they_may() {
        assert!(is_inner_path("a/b.xml") && is_inner_path("a..b"));
        for bad in [
            "",
            "/etc/passwd",
            "../a",
            "a/../../b",
            "c:\\x",
            "file:a",
            "a\\..\\b",
        ] {
            assert!(!is_inner_path(bad), "{bad}");
        }
        for good in ["a.ogg", "https://x.org/a:b", "a/b?c:d", "//x.org/a"] {
            assert!(is_safe_url(good), "{good}");
        }
        for bad in [
            "",
            "javascript:alert(1)",
            "file:///etc/passwd",
            "data:audio/wav,x",
        ] {
            assert!(!is_safe_url(bad), "{bad}");
        }
    }

    #[test]
    fn levels_are_words_changes_or_numbers() {
        let words = &["high", "low"];
        let changes = Some([-75.0, 300.0]);
        let level = |text| level(words, [1.0, 200.0], changes, text).map_err(|p| p.code);
        assert_eq!(level("HIGH"), Ok(Value::Word("high")));
        assert_eq!(level("-30%"), Ok(Value::Percent(-30.0)));
        assert_eq!(level("120"), Ok(Value::Number(120.0)));
        for beyond in ["-76%", "301%", "0", "201"] {
            assert_eq!(level(beyond), Err("eml::out-of-range"));
        }
        assert_eq!(level("hihg"), Err("eml::bad-choice"));
        assert_eq!(level("#"), Err("eml::bad-number"));
    }
}
