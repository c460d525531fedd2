//! The arrays that talking heads in browsers take: words, their times and durations, and the
//! same of visemes, in milliseconds.

use raconteur_base::json::Json;

use super::draft::{Draft, Kind};
use super::rhubarb::Places;
use super::text::{Bad, clip};
use super::viseme::OCULUS;
use super::{Units, VisemeSet};

pub(super) fn read(text: &str, draft: &mut Draft) -> Result<(), Bad> {
    let places = Places::new(text);
    let json = Json::read(text.as_bytes()).map_err(|e| Bad::new(places.at(e.place), e.what))?;
    draft.kind = Kind::Units(Units::None);
    let words = Arrays::of(&json, &places, ["words", "wtimes", "wdurations"])?;
    let visemes = Arrays::of(&json, &places, ["visemes", "vtimes", "vdurations"])?;
    if words.is_none() && visemes.is_none() {
        return Err(Bad::new(0, "neither \"words\" nor \"visemes\""));
    }
    if let Some(words) = words {
        for i in 0..words.labels.len() {
            let (word, start, end, at) = words.interval(i)?;
            draft.word(start, end, word, at)?;
        }
    }
    if let Some(visemes) = visemes {
        draft.kind = Kind::Units(Units::Visemes {
            set: VisemeSet::Oculus,
        });
        for i in 0..visemes.labels.len() {
            let (name, start, end, at) = visemes.interval(i)?;
            let shape = name.strip_prefix("viseme_").unwrap_or(name);
            if !OCULUS.contains(&shape) {
                return Err(Bad::new(at, format!("{:?} is no viseme", clip(name))));
            }
            draft.segment(start, end, shape, at)?;
        }
    }
    Ok(())
}

/// Three lists of one length.
struct Arrays<'a> {
    labels: &'a [Json<'a>],
    times: &'a [Json<'a>],
    durations: &'a [Json<'a>],
    places: &'a Places,
}

impl<'a> Arrays<'a> {
    fn of(json: &'a Json<'a>, places: &'a Places, names: [&str; 3]) -> Result<Option<Self>, Bad> {
        let [labels, times, durations] = names.map(|name| json.get(name));
        if labels.is_null() {
            return Ok(None);
        }
        for (name, list) in names.iter().zip([labels, times, durations]) {
            let at = if list.is_null() { labels } else { list };
            let at = places.at(at.place);
            if !list.is_list() {
                return Err(Bad::new(at, format!("{name:?} is not a list")));
            }
            let (count, wanted) = (list.items().len(), labels.items().len());
            if count != wanted {
                let message = format!("{count} {name:?} for {wanted} {:?}", names[0]);
                return Err(Bad::new(at, message));
            }
        }
        Ok(Some(Self {
            labels: labels.items(),
            times: times.items(),
            durations: durations.items(),
            places,
        }))
    }

    /// Label, begin, end in seconds, and place of the label.
    fn interval(&self, i: usize) -> Result<(&'a str, f64, f64, usize), Bad> {
        let secs = |json: &Json<'_>| {
            let ms = json.number();
            let ms = ms.ok_or_else(|| Bad::new(self.places.at(json.place), "no number"))?;
            Ok(ms / 1000.0)
        };
        let label = &self.labels[i];
        let at = self.places.at(label.place);
        let text = label.text().ok_or_else(|| Bad::new(at, "no text"))?;
        let start = secs(&self.times[i])?;
        let end = start + secs(&self.durations[i])?;
        Ok((text, start, end, at))
    }
}
