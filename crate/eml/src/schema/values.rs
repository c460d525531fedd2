//! Reader of attribute values by the table. An invalid value is reported and counts as absent.

mod kinds;

pub(super) use self::kinds::is_inner_path;
pub(crate) use self::kinds::parse;
use self::kinds::{in_range, number};
use super::affect::{self, WordMeaning};
use super::attribute::MAX_NUMBER;
use super::{Attribute, Context, Fields, Kind, Presence};
use crate::record::Value;
use crate::time_expr::{self, Problem};
use crate::{Diagnostic, EmotionSpace, Name, Span, TimeExpr, markup};
use std::borrow::Cow;

/// Time of a key within a gesture, in seconds or as a fraction of its duration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum KeyTime {
    /// Seconds from its start.
    Secs(f64),
    /// A fraction of its duration.
    Fraction(f64),
}

impl Context<'_> {
    /// Returns the value of an attribute by its kind: as written, or else the default.
    pub(crate) fn value(&mut self, fields: &Fields<'_>, name: &str) -> Value {
        let Some((attribute, written)) = fields.get(name) else {
            return Value::None;
        };
        let kind = conditional_kind(attribute, fields);
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

    /// Reads an emotion word; for a word outside the table, stores its place for the following
    /// attributes.
    fn emotion_word(&mut self, attribute: &Attribute, text: &str, span: Span) -> Value {
        self.placed = None;
        match (parse(attribute.kind, text), affect::meant(text)) {
            (Ok(value), _) => value,
            (Err(_), Some(WordMeaning::Word(word))) => {
                self.report_spelling(text, word, span);
                Value::Word(word)
            }
            (Err(_), Some(WordMeaning::Place(place))) => {
                self.sink.push(affect::report_place(text, place, span));
                self.placed = Some(place);
                Value::None
            }
            (Err(problem), None) => {
                self.report(problem, span);
                Value::None
            }
        }
    }

    /// Returns the value that the place of an emotion word gives to an absent attribute.
    fn placed(&self, fields: &Fields<'_>, name: &str) -> Option<Value> {
        let [activation, evaluation] = self.placed.filter(|_| fields.element.name == "emotion")?;
        match name {
            "activation" => Some(Value::Number(activation)),
            "evaluation" => Some(Value::Number(evaluation)),
            "space" => Some(Value::Word(EmotionSpace::Disc.word())),
            _ => None,
        }
    }

    /// Replaces an alias of a word by the word in the table, and reports the spelling.
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

    /// Returns the text value of an attribute; `None` if it is absent or invalid.
    pub(crate) fn text(&mut self, fields: &Fields<'_>, name: &str) -> Option<Name> {
        match self.value(fields, name) {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Returns the boolean value of an attribute; `None` if it is absent or invalid.
    pub(crate) fn boolean(&mut self, fields: &Fields<'_>, name: &str) -> Option<bool> {
        match self.value(fields, name) {
            Value::Flag(flag) => Some(flag),
            _ => None,
        }
    }

    /// Returns the number, integer or duration (seconds) of an attribute; `None` if it is absent or
    /// invalid.
    pub(crate) fn number(&mut self, fields: &Fields<'_>, name: &str) -> Option<f64> {
        match self.value(fields, name) {
            Value::Number(number) => Some(number),
            _ => None,
        }
    }

    /// Returns the word of an attribute in the table's spelling; `None` if it is absent or invalid.
    pub(crate) fn choice(&mut self, fields: &Fields<'_>, name: &str) -> Option<&'static str> {
        match self.value(fields, name) {
            Value::Word(word) => Some(word),
            _ => None,
        }
    }

    /// Returns the time expression of a clause; `Err` if it is invalid.
    pub(crate) fn time(&mut self, fields: &Fields<'_>) -> Result<TimeExpr, ()> {
        let written = fields.get("time").and_then(|(_, written)| written);
        let Some(written) = written else {
            return Ok(TimeExpr {
                span: fields.tag,
                ..TimeExpr::default()
            });
        };
        let text = markup::resolve(written, self.sink);
        // References in a value shift its offsets, so the span covers the whole value.
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

    /// Returns the time of a key in a gesture; `None` if it is absent, `Err` if it is invalid.
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

/// Returns true if an attribute holds an emotion word.
fn is_emotion(fields: &Fields<'_>, name: &str) -> bool {
    name == "type" && fields.element.extension && fields.element.name == "emotion"
}

/// Returns the kind of an attribute's value, given the other attributes.
fn conditional_kind(attribute: &Attribute, fields: &Fields<'_>) -> Kind {
    let has = |other: &str, word: &str| {
        let written = fields.get(other).and_then(|(_, written)| written);
        written.is_some_and(|w| w.value.trim().eq_ignore_ascii_case(word))
    };
    let mut kinds = attribute.conditional_kinds.iter();
    let found = kinds.find(|b| has(b.attribute, b.word));
    found.map_or(attribute.kind, |b| b.kind)
}

/// Parses a number in its usual form; `None` for forms that need the full parser. Numbers are half
/// of the attribute values of a script.
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

/// Trims white space, which is nearly always absent.
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
            Span::from_offsets(start + p.start, start + p.end.max(p.start))
        }
        None => value,
    }
}
