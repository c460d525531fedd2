//! Rhubarb Lip Sync's three ways to write when the mouth takes which shape.

use raconteur_base::json::Json;

use super::draft::{Draft, Kind, Point};
use super::text::{Bad, clip, fields, lines, number};
use super::viseme::rhubarb_viseme;
use super::xml::{Piece, Xml};
use super::{Units, VisemeSet};

const KIND: Kind = Kind::Units(Units::Visemes {
    set: VisemeSet::Rhubarb,
});

/// How long a last shape holds of which only the begin is told.
const LAST_SECS: f64 = 0.1;

fn shape(at: usize, shape: &str) -> Result<&str, Bad> {
    let shape = shape.trim();
    if rhubarb_viseme(shape).is_none() {
        let message = format!("{:?} is no mouth shape (A to H, X)", clip(shape));
        return Err(Bad::new(at, message));
    }
    Ok(shape)
}

pub(super) fn tsv(text: &str, draft: &mut Draft) -> Result<(), Bad> {
    draft.kind = KIND;
    let mut starts = Vec::new();
    for (at, line) in lines(text) {
        let mut fields = fields(at, line);
        let Some((time_at, time)) = fields.next() else {
            continue;
        };
        let Some((shape_at, label)) = fields.next() else {
            return Err(Bad::new(at + line.len(), "a mouth shape should follow"));
        };
        if let Some((more, _)) = fields.next() {
            return Err(Bad::new(more, "more than a time and a shape"));
        }
        draft.count(at)?;
        starts.push(Point {
            secs: number(time_at, time)?,
            label: shape(shape_at, label)?.to_owned(),
            at,
        });
    }
    if starts.is_empty() {
        return Err(Bad::new(0, "no mouth shapes"));
    }
    draft.segments_by_start(starts, "X", LAST_SECS)
}

pub(super) fn json(text: &str, draft: &mut Draft) -> Result<(), Bad> {
    draft.kind = KIND;
    let places = Places::new(text);
    let json = Json::read(text.as_bytes()).map_err(|e| Bad::new(places.at(e.place), e.what))?;
    let cues = json.get("mouthCues");
    if !cues.is_list() {
        return Err(Bad::new(0, "no list \"mouthCues\""));
    }
    for cue in cues.items() {
        let at = places.at(cue.place);
        let time = |name: &str| {
            let time = cue.get(name).number();
            time.ok_or_else(|| Bad::new(at, format!("a cue without the number {name:?}")))
        };
        let label = cue.get("value").text();
        let label = label.ok_or_else(|| Bad::new(at, "a cue without the text \"value\""))?;
        draft.segment(time("start")?, time("end")?, shape(at, label)?, at)?;
    }
    if let Some(end_secs) = json.get("metadata").get("duration").number() {
        draft.end_secs = end_secs;
    }
    Ok(())
}

pub(super) fn xml(text: &str, draft: &mut Draft) -> Result<(), Bad> {
    draft.kind = KIND;
    let mut xml = Xml::new(text);
    let mut cue: Option<(f64, f64, usize)> = None;
    let (mut content, mut known) = (String::new(), false);
    while let Some(piece) = xml.next()? {
        match piece {
            Piece::Start(element) => {
                content.clear();
                known |= element.name() == "rhubarbResult";
                if element.name() == "mouthCue" {
                    let time = |name: &str| {
                        let missing = || Bad::new(element.at, format!("a cue without {name:?}"));
                        element.number(name)?.ok_or_else(missing)
                    };
                    cue = Some((time("start")?, time("end")?, element.at));
                }
            }
            Piece::Text(text) => content.push_str(&text),
            Piece::End(name) => {
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
        return Err(Bad::new(0, "no element \"rhubarbResult\""));
    }
    Ok(())
}

/// Bytes of the places that the reader of JSON tells, which are lines and columns of bytes.
pub(super) struct Places(Vec<usize>);

impl Places {
    pub(super) fn new(text: &str) -> Self {
        let ends = text.bytes().enumerate().filter(|(_, b)| *b == b'\n');
        let starts = std::iter::once(0).chain(ends.map(|(i, _)| i + 1));
        Self(starts.collect())
    }

    pub(super) fn at(&self, place: raconteur_base::json::Place) -> usize {
        let line = place.line.saturating_sub(1) as usize;
        let start = self.0.get(line).or(self.0.last()).copied().unwrap_or(0);
        start + place.column.saturating_sub(1) as usize
    }
}
