//! Builder of a content from the meaning of a document's elements.

use super::xml::{Pieces, Tag, Token};
use super::{MAX_DEPTH, Problem, levels};
use crate::content::{Content, Division, Markup, Segment, Setting, is_space};

/// Maximum number of markups, pauses and other points in a document.
const MAX_SEGMENTS: usize = 50_000;

/// Interpretation of a markup element: its points, its markup and its division.
#[derive(Default)]
pub(crate) struct Meaning {
    /// Points at its start.
    pub(crate) points: Vec<Segment>,
    /// Markup of its content, from outside to inside.
    pub(crate) markups: Vec<Markup>,
    /// Division between its content and its surroundings.
    pub(crate) division: Option<Division>,
    /// True if its content is not spoken.
    pub(crate) silent: bool,
    /// True if its content is a word, even without white space before the next such one.
    pub(crate) is_token: bool,
}

impl From<Markup> for Meaning {
    fn from(markup: Markup) -> Self {
        Self {
            markups: vec![markup],
            ..Self::default()
        }
    }
}

impl From<Segment> for Meaning {
    fn from(point: Segment) -> Self {
        Self {
            points: vec![point],
            ..Self::default()
        }
    }
}

/// An open element.
struct Frame {
    closes: usize,
    division: Option<Division>,
    silent: bool,
    is_token: bool,
}

/// Parses a document; `meaning` returns the meaning of each tag.
pub(crate) fn read(
    source: &str,
    any_case: bool,
    mut meaning: impl FnMut(&Tag, &mut Pieces<'_>) -> Meaning,
) -> Result<(Content, Vec<Problem>), Problem> {
    let mut pieces = Pieces::new(source, any_case)?;
    let mut segments: Vec<Segment> = Vec::new();
    let mut frames: Vec<Frame> = Vec::new();
    let mut depth = 0;
    let mut count = 0;
    let mut is_behind_token = false;
    while let Some(token) = pieces.next()? {
        let is_silent = frames.last().is_some_and(|f| f.silent);
        match token {
            Token::Text(_) if is_silent => {}
            Token::Text(text) => {
                is_behind_token = false;
                push_text(&mut segments, text);
            }
            Token::Start(_) if is_silent => frames.push(Frame {
                closes: 0,
                division: None,
                silent: true,
                is_token: false,
            }),
            Token::Start(tag) => {
                let Meaning {
                    points,
                    markups,
                    division,
                    silent,
                    is_token,
                } = meaning(&tag, &mut pieces);
                depth += markups.len();
                count += points.len() + markups.len() + usize::from(division.is_some());
                if depth > MAX_DEPTH {
                    let message = format!("more than {MAX_DEPTH} markups deep");
                    return Err(pieces.problem(tag.at, message));
                }
                if count > MAX_SEGMENTS {
                    let message = format!("more than {MAX_SEGMENTS} markups");
                    return Err(pieces.problem(tag.at, message));
                }
                if is_token && is_behind_token {
                    push_text(&mut segments, " ".to_owned());
                }
                segments.extend(points);
                if let Some(division) = division {
                    divide(&mut segments, division);
                }
                frames.push(Frame {
                    closes: markups.len(),
                    division,
                    silent,
                    is_token,
                });
                segments.extend(markups.into_iter().map(Segment::Open));
            }
            Token::End => {
                // The pieces end with as many ends as there were starts.
                if let Some(frame) = frames.pop() {
                    is_behind_token |= frame.is_token;
                    depth -= frame.closes;
                    segments.extend(core::iter::repeat_n(Segment::Close, frame.closes));
                    if let Some(division) = frame.division {
                        divide(&mut segments, division);
                    }
                }
            }
        }
    }
    Ok((Content { segments }, pieces.into_problems()))
}

fn push_text(segments: &mut Vec<Segment>, text: String) {
    match segments.last_mut() {
        Some(Segment::Text(before)) => before.push_str(&text),
        _ => segments.push(Segment::Text(text)),
    }
}

/// Adds a division. One right behind another is the same, and of a paragraph where one of
/// them is.
pub(crate) fn divide(segments: &mut Vec<Segment>, division: Division) {
    let before = segments.iter_mut().rev().find(|s| !is_blank(s));
    match before {
        Some(Segment::Division(before)) => {
            if division == Division::Paragraph {
                *before = division;
            }
        }
        _ => segments.push(Segment::Division(division)),
    }
}

/// Returns true if a segment is only white space.
pub(crate) fn is_blank(segment: &Segment) -> bool {
    matches!(segment, Segment::Text(text) if text.chars().all(is_space))
}

/// Reports that an element lacks a required part and is therefore ignored.
pub(crate) fn needs(tag: &Tag, pieces: &mut Pieces<'_>, what: &str) -> Meaning {
    pieces.report(tag.at, format!("{} needs {what}", tag.name));
    Meaning::default()
}

/// Parses an attribute value; an unreadable one is reported.
pub(crate) fn word<T>(
    tag: &Tag,
    pieces: &mut Pieces<'_>,
    name: &str,
    read: impl Fn(&str) -> Option<T>,
) -> Option<T> {
    let text = tag.get(name)?;
    let value = read(text);
    if value.is_none() {
        pieces.report(tag.at, format!("{name}=\"{text}\" is not understood"));
    }
    value
}

/// Parses the exact settings in an attribute of Raconteur's namespace: `default`, `=90`, `*1.2`.
pub(crate) fn exact(text: &str) -> Option<Vec<Setting>> {
    text.split(is_space)
        .take(4)
        .map(|word| {
            if word == "default" {
                Some(Setting::Default)
            } else if let Some(value) = word.strip_prefix('=') {
                levels::number(value).map(Setting::Value)
            } else {
                levels::number(word.strip_prefix('*')?).map(Setting::Factor)
            }
        })
        .collect()
}

/// Formats a setting so that [`exact`] parses it.
pub(crate) fn exact_text(setting: Setting) -> String {
    match setting {
        Setting::Default => "default".to_owned(),
        Setting::Value(value) => format!("={value}"),
        Setting::Factor(factor) => format!("*{factor}"),
    }
}

/// Converts a pause to whole milliseconds, and returns true if it was too long.
pub(crate) fn pause_msec(msec: f64) -> (u32, bool) {
    let longest = f64::from(levels::MAX_MSEC);
    (msec.clamp(0.0, longest).round() as u32, msec > longest)
}

/// Returns the text of an attribute; `None` if it is empty.
pub(crate) fn filled(value: Option<&str>) -> Option<String> {
    value.filter(|v| !v.is_empty()).map(str::to_owned)
}

/// Returns the emotion of a Raconteur element.
pub(crate) fn emotion(tag: &Tag, pieces: &mut Pieces<'_>) -> Markup {
    let name = tag.get("name").unwrap_or_default();
    let place = raconteur_speech::emotion::place(name);
    let mut axis = |attribute: &str, of_word: f64| match tag.get(attribute) {
        None => of_word,
        Some(text) => levels::number(text.trim()).unwrap_or_else(|| {
            pieces.report(tag.at, format!("{attribute}=\"{text}\" is not a number"));
            of_word
        }),
    };
    let of_word = place.unwrap_or_default();
    let markup = Markup::Emotion {
        activation: axis("activation", of_word.activation),
        evaluation: axis("evaluation", of_word.evaluation),
        power: axis("power", of_word.power),
        name: name.to_owned(),
    };
    let says_where = ["activation", "evaluation", "power"].map(|a| tag.get(a));
    if place.is_none() && says_where.iter().all(Option::is_none) {
        pieces.report(tag.at, format!("the emotion {name:?} is not known"));
    }
    markup
}

/// Markups of the pitch that set each line to its listed value, in turn.
pub(crate) fn pitch(base: &[Setting], middle: &[Setting], range: &[Setting]) -> Vec<Markup> {
    let count = base.len().max(middle.len()).max(range.len());
    (0..count)
        .map(|i| Markup::Pitch {
            base: base.get(i).copied(),
            middle: middle.get(i).copied(),
            range: range.get(i).copied(),
        })
        .collect()
}
