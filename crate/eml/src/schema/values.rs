//! Reads the values of attributes by the table. A value that does not fit is
//! reported and counts as left out.

use super::context::list;
use super::{Attribute, Context, Fields, Kind, Presence};
use crate::suggest::{nearest, quoted};
use crate::time_expr::{self, Problem};
use crate::{Diagnostic, Name, Span, TimeExpr, syntax};
use std::borrow::Cow;

/// The largest number either way that a document may write: it keeps products and
/// sums of a few of them finite.
const MAX_NUMBER: f64 = 1e6;

/// Where on a gesture's time line a key lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum KeyTime {
    /// Seconds from its start.
    Secs(f64),
    /// A fraction of its duration.
    Fraction(f64),
}

/// A number, or one of the words of a choice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NumberOrWord {
    Number(f64),
    Word(&'static str),
}

/// An attribute of the table and how it is written, when it is.
type Entry<'t> = (&'static Attribute, Option<&'t syntax::Attribute<'t>>);

/// A written value, or the default that stands for it.
struct Given<'t> {
    text: Cow<'t, str>,
    /// Where a written one is.
    span: Option<Span>,
}

impl Context<'_> {
    /// Any text.
    pub(crate) fn text(&mut self, fields: &Fields<'_>, name: &str) -> Option<String> {
        let (attribute, written) = fields.get(name)?;
        self.given(attribute, written)
            .map(|given| given.text.into_owned())
    }

    /// A short text.
    pub(crate) fn label(&mut self, fields: &Fields<'_>, name: &str) -> Option<Name> {
        let (attribute, written) = fields.get(name)?;
        self.given(attribute, written)
            .map(|given| given.text.into())
    }

    /// A name for a moment.
    pub(crate) fn name(&mut self, fields: &Fields<'_>, name: &str) -> Option<Name> {
        let (attribute, written) = fields.get(name)?;
        let given = self.given(attribute, written)?;
        let text = trimmed(&given.text);
        if time_expr::is_name(text) {
            return Some(text.into());
        }
        self.sink.push(
            Diagnostic::error(
                "eml::bad-name",
                given.span.unwrap_or(fields.tag),
                format!("{} cannot name a moment", quoted(text)),
            )
            .hint("a name is a letter followed by letters, digits, `_` and `.`; `-` is a minus"),
        );
        None
    }

    /// A truth value.
    pub(crate) fn boolean(&mut self, fields: &Fields<'_>, name: &str) -> Option<bool> {
        self.read(fields, name, |text| {
            if text == "1" || text.eq_ignore_ascii_case("true") {
                Ok(true)
            } else if text == "0" || text.eq_ignore_ascii_case("false") {
                Ok(false)
            } else {
                Err(bad_value(text, "true, false, 1 or 0"))
            }
        })
    }

    /// A finite number.
    pub(crate) fn number(&mut self, fields: &Fields<'_>, name: &str) -> Option<f64> {
        self.read(fields, name, number)
    }

    /// A whole number in the table's range.
    pub(crate) fn integer(&mut self, fields: &Fields<'_>, name: &str) -> Option<i64> {
        let entry = fields.get(name)?;
        let Kind::Integer { least, most } = entry.0.kind else {
            return None;
        };
        self.read_entry(entry, |text| match text.parse::<i64>() {
            Ok(value) if (least..=most).contains(&value) => Ok(value),
            _ if most == i64::MAX => Err(bad_value(text, &format!("a whole number from {least}"))),
            _ => Err(bad_value(
                text,
                &format!("a whole number from {least} to {most}"),
            )),
        })
    }

    /// A length in seconds.
    pub(crate) fn seconds(&mut self, fields: &Fields<'_>, name: &str) -> Option<f64> {
        self.read(fields, name, |text| {
            let secs = time_expr::parse_secs(text)?;
            if secs < 0.0 {
                Err(bad_value(text, "a length of at least 0"))
            } else {
                Ok(secs)
            }
        })
    }

    /// The table's spelling of a word.
    pub(crate) fn choice(&mut self, fields: &Fields<'_>, name: &str) -> Option<&'static str> {
        let entry = fields.get(name)?;
        let Kind::Choice(words) = entry.0.kind else {
            return None;
        };
        self.read_entry(entry, |text| {
            word(words, text).ok_or_else(|| no_word(text, words))
        })
    }

    /// A number, or the table's spelling of a word.
    pub(crate) fn number_or_choice(
        &mut self,
        fields: &Fields<'_>,
        name: &str,
    ) -> Option<NumberOrWord> {
        let entry = fields.get(name)?;
        let Kind::NumberOrChoice(words) = entry.0.kind else {
            return None;
        };
        self.read_entry(entry, |text| {
            if let Some(word) = word(words, text) {
                return Ok(NumberOrWord::Word(word));
            }
            match number(text) {
                Ok(value) => Ok(NumberOrWord::Number(value)),
                Err(_) if text.starts_with(char::is_alphabetic) => Err(no_word(text, words)),
                Err(problem) => Err(problem),
            }
        })
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
        let text = syntax::resolve(written, self.sink);
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
        let entry = fields.get("time").filter(|(_, written)| written.is_some());
        let Some(entry) = entry else { return Ok(None) };
        let read = self.read_entry(entry, |text| {
            let (value, percent) = match text.strip_suffix('%') {
                Some(percent) => (number(percent.trim_end())? / 100.0, true),
                None => (time_expr::parse_secs(text)?, false),
            };
            if value < 0.0 {
                return Err(bad_value(text, "an offset of at least 0"));
            }
            Ok(if percent {
                KeyTime::Fraction(value)
            } else {
                KeyTime::Secs(value)
            })
        });
        read.map(Some).ok_or(())
    }

    fn read<T>(
        &mut self,
        fields: &Fields<'_>,
        name: &str,
        parse: impl FnMut(&str) -> Result<T, Problem>,
    ) -> Option<T> {
        self.read_entry(fields.get(name)?, parse)
    }

    fn read_entry<T>(
        &mut self,
        (attribute, written): Entry<'_>,
        mut parse: impl FnMut(&str) -> Result<T, Problem>,
    ) -> Option<T> {
        let given = self.given(attribute, written)?;
        let text = trimmed(&given.text);
        match (parse(text), given.span) {
            (Ok(value), _) => Some(value),
            // A default of the table fits; a test reads each of them.
            (Err(_), None) => None,
            (Err(problem), Some(span)) => {
                self.report(problem, span);
                match attribute.default {
                    Presence::Default(text) => parse(text).ok(),
                    Presence::Required | Presence::Optional => None,
                }
            }
        }
    }

    fn given<'f>(
        &mut self,
        attribute: &Attribute,
        written: Option<&'f syntax::Attribute<'f>>,
    ) -> Option<Given<'f>> {
        match (written, attribute.default) {
            (Some(written), _) => Some(Given {
                text: syntax::resolve(written, self.sink),
                span: Some(written.value_span()),
            }),
            (None, Presence::Default(text)) => Some(Given {
                text: Cow::Borrowed(text),
                span: None,
            }),
            (None, _) => None,
        }
    }

    fn report(&mut self, problem: Problem, span: Span) {
        let hint = (!problem.hint.is_empty()).then(|| problem.hint.to_owned());
        self.push_with_hint(Diagnostic::error(problem.code, span, problem.message), hint);
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

/// A text without the white space around it; there is nearly always none.
fn trimmed(text: &str) -> &str {
    let is_mark = |b: Option<&u8>| b.is_some_and(u8::is_ascii_graphic);
    if is_mark(text.as_bytes().first()) && is_mark(text.as_bytes().last()) {
        text
    } else {
        text.trim()
    }
}

fn number(text: &str) -> Result<f64, Problem> {
    match crate::decimal::parse(text) {
        Some(value) if value.abs() <= MAX_NUMBER => Ok(value),
        Some(value) if value.is_finite() => Err(bad_number(
            format!("{} is too large", quoted(text)),
            "the largest is 1000000",
        )),
        Some(_) => Err(bad_number(
            format!("{} is not a finite number", quoted(text)),
            "",
        )),
        None if text.contains(',') => {
            let message = format!("{} is not a number", quoted(text));
            Err(bad_number(message, "decimals are written with a point"))
        }
        None => Err(bad_number(format!("{} is not a number", quoted(text)), "")),
    }
}

fn bad_number(message: String, hint: &'static str) -> Problem {
    Problem {
        code: "eml::bad-number",
        start: 0,
        end: 0,
        message,
        hint,
    }
}

fn bad_value(text: &str, wanted: &str) -> Problem {
    let message = format!("expected {wanted}, found {}", quoted(text));
    Problem {
        code: "eml::bad-value",
        start: 0,
        end: 0,
        message,
        hint: "",
    }
}

fn word(words: &'static [&'static str], text: &str) -> Option<&'static str> {
    words.iter().copied().find(|w| w.eq_ignore_ascii_case(text))
}

fn no_word(text: &str, words: &'static [&'static str]) -> Problem {
    let mut problem = bad_value(text, &list(words));
    if let Some(near) = nearest(text, words.iter().copied()) {
        problem
            .message
            .push_str(&format!(" (did you mean `{near}`?)"));
    }
    problem
}
