//! Arrays for talking heads in browsers: words, their times and durations, and the same for
//! visemes, in milliseconds.

use serde::Deserialize;
use serde_json::value::RawValue;

use super::draft::{Draft, Kind};
use super::rhubarb::{place, read as read_json};
use super::text::{TextError, clip};
use super::viseme::{OCULUS, oculus};
use super::{Units, VisemeSet};

pub(super) fn read(text: &str, draft: &mut Draft) -> Result<(), TextError> {
    let file: File<'_> = read_json(text)?;
    draft.kind = Kind::Units(Units::None);
    let words = Arrays::check(text, "words", [file.words, file.wtimes, file.wdurations])?;
    let visemes = [file.visemes, file.vtimes, file.vdurations];
    let visemes = Arrays::check(text, "visemes", visemes)?;
    if words.is_none() && visemes.is_none() {
        return Err(TextError::new(0, "neither \"words\" nor \"visemes\""));
    }
    if let Some(words) = words {
        for i in 0..words.labels.len() {
            let (word, start, end, at) = words.interval(i)?;
            draft.word(start, end, &word, at)?;
        }
    }
    if let Some(visemes) = visemes {
        draft.kind = Kind::Units(Units::Visemes {
            set: VisemeSet::Oculus,
        });
        for i in 0..visemes.labels.len() {
            let (name, start, end, at) = visemes.interval(i)?;
            let shape = oculus(&name).ok_or_else(|| {
                let known = OCULUS.join(", ");
                let message = format!("{:?} is not a viseme; known: {known}", clip(&name));
                TextError::new(at, message)
            })?;
            draft.segment(start, end, shape, at)?;
        }
    }
    Ok(())
}

/// Contents of a file.
#[derive(Deserialize)]
struct File<'a> {
    #[serde(borrow)]
    words: Option<&'a RawValue>,
    wtimes: Option<&'a RawValue>,
    wdurations: Option<&'a RawValue>,
    visemes: Option<&'a RawValue>,
    vtimes: Option<&'a RawValue>,
    vdurations: Option<&'a RawValue>,
}

/// Three lists of one length.
struct Arrays<'a> {
    text: &'a str,
    labels: Vec<&'a RawValue>,
    times: Vec<&'a RawValue>,
    durations: Vec<&'a RawValue>,
}

impl<'a> Arrays<'a> {
    /// Checks labels, times and durations, whose names differ only in the last part; returns `None`
    /// without labels.
    fn check(
        text: &'a str,
        name: &str,
        [labels, times, durations]: [Option<&'a RawValue>; 3],
    ) -> Result<Option<Self>, TextError> {
        let Some(written) = labels else {
            return Ok(None);
        };
        let letter = &name[..1];
        let list = |value: Option<&'a RawValue>, name: &str| {
            let at = place(text, value.unwrap_or(written));
            let list = value.and_then(|value| serde_json::from_str(value.get()).ok());
            list.ok_or_else(|| TextError::new(at, format!("{name:?} is not a list")))
        };
        let labels: Vec<&RawValue> = list(labels, name)?;
        let column = |value: Option<&'a RawValue>, kind: &str| {
            let own = format!("{letter}{kind}");
            let column: Vec<&RawValue> = list(value, &own)?;
            if column.len() == labels.len() {
                return Ok(column);
            }
            let message = format!("{} {own:?} for {} {name:?}", column.len(), labels.len());
            Err(TextError::new(
                place(text, value.unwrap_or(written)),
                message,
            ))
        };
        Ok(Some(Self {
            text,
            times: column(times, "times")?,
            durations: column(durations, "durations")?,
            labels,
        }))
    }

    /// Returns label, start and end in seconds, and position of the label.
    fn interval(&self, i: usize) -> Result<(String, f64, f64, usize), TextError> {
        let secs = |value: &RawValue| {
            let ms: Result<f64, _> = serde_json::from_str(value.get());
            let ms = ms.map_err(|_| TextError::new(place(self.text, value), "no number"))?;
            Ok(ms / 1000.0)
        };
        let at = place(self.text, self.labels[i]);
        let text = serde_json::from_str(self.labels[i].get());
        let text = text.map_err(|_| TextError::new(at, "no text"))?;
        let start = secs(self.times[i])?;
        let end = start + secs(self.durations[i])?;
        Ok((text, start, end, at))
    }
}
