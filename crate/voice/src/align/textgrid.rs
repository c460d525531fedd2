//! Praat's TextGrid as text, long or short.
//!
//! Both are one language (Praat manual, "TextGrid file formats"): only numbers, quoted texts and
//! flags in angle brackets that are free-standing between white space count, and `!` begins a
//! comment. The additions of the long form (`xmin =`, `intervals [1]:`) are not free-standing.

use super::draft::{Draft, Point, Raw};
use super::text::{TextError, clip};
use super::tiers::{Tier, choose};

enum Token<'a> {
    Number(f64),
    /// Quoted, quotes still doubled.
    Text(&'a str),
    Flag(&'a str),
}

struct Tokens<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Tokens<'a> {
    /// Returns the next significant token and its position.
    fn next(&mut self) -> Result<(usize, Token<'a>), TextError> {
        loop {
            let rest = &self.text[self.at..];
            self.at += rest.len() - rest.trim_start().len();
            let (at, rest) = (self.at, &self.text[self.at..]);
            let word_end = rest.find(char::is_whitespace).unwrap_or(rest.len());
            match rest.chars().next() {
                None => return Err(TextError::new(at, "the file ends too early")),
                Some('!') => self.at += rest.find(['\n', '\r']).unwrap_or(rest.len()),
                Some('"') => {
                    let length = quoted(&rest[1..])
                        .ok_or_else(|| TextError::new(at, "a quoted text does not end"))?;
                    self.at += length + 2;
                    return Ok((at, Token::Text(&rest[1..=length])));
                }
                Some('<') => {
                    self.at += word_end;
                    return Ok((at, Token::Flag(&rest[..word_end])));
                }
                Some(_) => {
                    self.at += word_end;
                    if let Ok(value) = rest[..word_end].parse::<f64>() {
                        if !value.is_finite() {
                            return Err(TextError::new(at, "a number that is not finite"));
                        }
                        return Ok((at, Token::Number(value)));
                    }
                }
            }
        }
    }

    fn number(&mut self, what: &str) -> Result<(usize, f64), TextError> {
        match self.next()? {
            (at, Token::Number(value)) => Ok((at, value)),
            (at, _) => Err(TextError::new(at, format!("{what} should be a number"))),
        }
    }

    fn text(&mut self, what: &str) -> Result<(usize, String), TextError> {
        match self.next()? {
            (at, Token::Text(text)) => Ok((at, text.replace("\"\"", "\""))),
            (at, _) => Err(TextError::new(
                at,
                format!("{what} should be a quoted text"),
            )),
        }
    }

    fn size(&mut self, what: &str) -> Result<u64, TextError> {
        let (at, size) = self.number(what)?;
        if !(0.0..=1e9).contains(&size) || size % 1.0 != 0.0 {
            return Err(TextError::new(
                at,
                format!("{size} is not a number of {what}"),
            ));
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "in range"
        )]
        Ok(size as u64)
    }
}

/// Returns the length up to the closing quote of a text; two quotes are an escaped one.
fn quoted(rest: &str) -> Option<usize> {
    let mut at = 0;
    loop {
        at += rest.get(at..)?.find('"')?;
        if !rest[at + 1..].starts_with('"') {
            return Some(at);
        }
        at += 2;
    }
}

pub(super) fn read(text: &str, draft: &mut Draft) -> Result<(), TextError> {
    let mut tokens = Tokens { text, at: 0 };
    let (at, kind) = tokens.text("the file type")?;
    if !kind.starts_with("ooTextFile") {
        return Err(TextError::new(
            at,
            format!("{:?} is not \"ooTextFile\"", clip(&kind)),
        ));
    }
    let (at, class) = tokens.text("the object class")?;
    if class != "TextGrid" {
        return Err(TextError::new(
            at,
            format!("{:?} is not \"TextGrid\"", clip(&class)),
        ));
    }
    tokens.number("the begin")?;
    let (_, end_secs) = tokens.number("the end")?;
    match tokens.next()? {
        (_, Token::Flag("<exists>")) => {}
        (at, _) => return Err(TextError::new(at, "no tiers exist")),
    }
    let mut tiers = Vec::new();
    for _ in 0..tokens.size("tiers")? {
        tiers.push(tier(&mut tokens, draft)?);
    }
    draft.end_secs = end_secs;
    choose(tiers, draft, at)
}

fn tier(tokens: &mut Tokens<'_>, draft: &mut Draft) -> Result<Tier, TextError> {
    let (class_at, class) = tokens.text("the tier's class")?;
    let is_points = match class.as_str() {
        "IntervalTier" => false,
        "TextTier" => true,
        _ => {
            let message = format!("{:?} is not a tier class", clip(&class));
            return Err(TextError::new(class_at, message));
        }
    };
    let (at, name) = tokens.text("the tier's name")?;
    tokens.number("the tier's begin")?;
    tokens.number("the tier's end")?;
    let mut tier = Tier {
        name: name.trim().to_lowercase(),
        at,
        intervals: Vec::new(),
        points: Vec::new(),
        is_points,
    };
    for _ in 0..tokens.size("intervals")? {
        let (at, start) = tokens.number("a begin")?;
        draft.count(at)?;
        if is_points {
            let label = tokens.text("a mark")?.1;
            tier.points.push(Point {
                secs: start,
                label,
                at,
            });
        } else {
            let end = tokens.number("an end")?.1;
            let label = tokens.text("a label")?.1.trim().to_owned();
            tier.intervals.push(Raw {
                start,
                end,
                label,
                at,
            });
        }
    }
    Ok(tier)
}
