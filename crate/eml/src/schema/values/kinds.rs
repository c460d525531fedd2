//! Conversion of texts to values of the attribute kinds.

use crate::record::Value;
use crate::schema::Kind;
use crate::schema::attribute::MAX_NUMBER;
use crate::schema::context::list;
use crate::suggest::{nearest, quoted};
use crate::time_expr::{self, Problem};

/// The most numbers in one list.
const MAX_NUMBERS: usize = 64;

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
                format!("{} cannot be a name in time expressions", quoted(text)),
            )
        }),
        Kind::Identifier if text.is_empty() => wrong("eml::bad-name", "a name"),
        Kind::Path if !is_inner_path(text) => Err(Problem {
            hint: "paths are relative, without `..`, `:` and `\\`".into(),
            ..problem(
                "eml::bad-path",
                format!("{} leads out of its folder", quoted(text)),
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
        // Both are read together with adjacent attributes.
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
                if numbers.len() > MAX_NUMBERS {
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

/// Returns true if a path stays in its folder on every system.
pub(in crate::schema) fn is_inner_path(text: &str) -> bool {
    !text.is_empty()
        && !text.starts_with('/')
        && !text.contains([':', '\\'])
        && !text.contains(char::is_control)
        && text.split('/').all(|part| part != "..")
}

/// Returns true if a URL is relative to the page, or may be fetched by a page.
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

pub(super) fn number(text: &str) -> Result<f64, Problem> {
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
                "use a point as the decimal separator".into()
            } else {
                "".into()
            },
            ..problem(code, format!("{} is not a number", quoted(text)))
        }),
    }
}

pub(super) fn in_range(value: f64, least: f64, most: f64, text: &str) -> Result<f64, Problem> {
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
        hint: format!("it counts as omitted; the nearest value is {nearest}").into(),
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
    use crate::schema::Presence;

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
        assert!(
            is_inner_path("a/b.xml") && is_inner_path("a..b"),
            "inner paths are accepted"
        );
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
