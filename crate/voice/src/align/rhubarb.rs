//! Rhubarb Lip Sync's three formats of mouth shapes with times.

use serde::Deserialize;
use serde_json::value::RawValue;

use super::draft::{Draft, Kind, Point};
use super::text::{TextError, clip, fields, lines, number};
use super::viseme::rhubarb_viseme;
use super::xml::{Xml, XmlEvent};
use super::{Units, VisemeSet};

const KIND: Kind = Kind::Units(Units::Visemes {
    set: VisemeSet::Rhubarb,
});

/// Duration of a final shape without an end time.
const LAST_SECS: f64 = 0.1;

/// Contents of a JSON file.
#[derive(Deserialize)]
struct File<'a> {
    #[serde(borrow, rename = "mouthCues")]
    cues: Option<&'a RawValue>,
    metadata: Option<Metadata>,
}

#[derive(Deserialize)]
struct Metadata {
    duration: Option<f64>,
}

#[derive(Deserialize)]
struct Cue {
    start: Option<f64>,
    end: Option<f64>,
    value: Option<String>,
}

fn shape(at: usize, shape: &str) -> Result<&str, TextError> {
    let shape = shape.trim();
    if rhubarb_viseme(shape).is_none() {
        let message = format!("{:?} is not a mouth shape (A to H, X)", clip(shape));
        return Err(TextError::new(at, message));
    }
    Ok(shape)
}

pub(super) fn tsv(text: &str, draft: &mut Draft) -> Result<(), TextError> {
    draft.kind = KIND;
    let mut starts = Vec::new();
    for (at, line) in lines(text) {
        let mut fields = fields(at, line);
        let Some((time_at, time)) = fields.next() else {
            continue;
        };
        let Some((shape_at, label)) = fields.next() else {
            return Err(TextError::new(
                at + line.len(),
                "a mouth shape should follow",
            ));
        };
        if let Some((more, _)) = fields.next() {
            return Err(TextError::new(more, "more than a time and a shape"));
        }
        draft.count(at)?;
        starts.push(Point {
            secs: number(time_at, time)?,
            label: shape(shape_at, label)?.to_owned(),
            at,
        });
    }
    if starts.is_empty() {
        return Err(TextError::new(0, "no mouth shapes"));
    }
    draft.segments_by_start(starts, "X", LAST_SECS)
}

pub(super) fn json(text: &str, draft: &mut Draft) -> Result<(), TextError> {
    draft.kind = KIND;
    let file: File<'_> = read(text)?;
    let cues: Vec<&RawValue> = file
        .cues
        .and_then(|cues| serde_json::from_str(cues.get()).ok())
        .ok_or_else(|| TextError::new(0, "no list \"mouthCues\""))?;
    for cue in cues {
        let at = place(text, cue);
        let cue: Cue = serde_json::from_str(cue.get()).map_err(|_| {
            TextError::new(
                at,
                "a cue is not an object with \"start\", \"end\" and \"value\"",
            )
        })?;
        let time = |time: Option<f64>, name: &str| {
            time.ok_or_else(|| TextError::new(at, format!("a cue without the number {name:?}")))
        };
        let label = cue.value.as_deref();
        let label = label.ok_or_else(|| TextError::new(at, "a cue without the text \"value\""))?;
        let (start, end) = (time(cue.start, "start")?, time(cue.end, "end")?);
        draft.segment(start, end, shape(at, label)?, at)?;
    }
    if let Some(end_secs) = file.metadata.and_then(|metadata| metadata.duration) {
        draft.end_secs = end_secs;
    }
    Ok(())
}

pub(super) fn xml(text: &str, draft: &mut Draft) -> Result<(), TextError> {
    draft.kind = KIND;
    let mut xml = Xml::new(text);
    let mut cue: Option<(f64, f64, usize)> = None;
    let (mut content, mut known) = (String::new(), false);
    while let Some(piece) = xml.next()? {
        match piece {
            XmlEvent::Start(element) => {
                content.clear();
                known |= element.name() == "rhubarbResult";
                if element.name() == "mouthCue" {
                    let time = |name: &str| {
                        let missing =
                            || TextError::new(element.at, format!("a cue without {name:?}"));
                        element.number(name)?.ok_or_else(missing)
                    };
                    cue = Some((time("start")?, time("end")?, element.at));
                }
            }
            XmlEvent::Text(text) => content.push_str(&text),
            XmlEvent::End(name) => {
                if name == "mouthCue"
                    && let Some((start, end, at)) = cue.take()
                {
                    draft.segment(start, end, shape(at, &content)?, at)?;
                } else if name == "duration" {
                    draft.end_secs = number(0, &content)?;
                }
                content.clear();
            }
        }
    }
    if !known {
        return Err(TextError::new(0, "no element \"rhubarbResult\""));
    }
    Ok(())
}

/// Reads a value of JSON; a fault is reported with its byte.
pub(super) fn read<'a, T: Deserialize<'a>>(text: &'a str) -> Result<T, TextError> {
    serde_json::from_str(text).map_err(|error| {
        let before = text
            .split_inclusive('\n')
            .take(error.line().saturating_sub(1));
        let line_start: usize = before.map(str::len).sum();
        let at = line_start + error.column().saturating_sub(1);
        let told = error.to_string();
        let place = format!(" at line {} column {}", error.line(), error.column());
        let what = told.strip_suffix(&place).unwrap_or(&told);
        TextError::new(at.min(text.len()), what.to_owned())
    })
}

/// Returns the byte offset in a text at which one of its values begins.
pub(super) fn place(text: &str, value: &RawValue) -> usize {
    (value.get().as_ptr() as usize).saturating_sub(text.as_ptr() as usize)
}
