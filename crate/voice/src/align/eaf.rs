//! ELAN annotation files (EAF): tiers whose annotations begin and end at time slots.
//!
//! Slots without a time are distributed evenly between those with one, as in ELAN's display. Tiers
//! without own times, which refer to annotations of others, are not read.

use std::collections::HashMap;

use super::draft::{Draft, Raw};
use super::text::TextError;
use super::tiers::{Tier, choose};
use super::xml::{Element, Xml, XmlEvent};

/// An annotation between two slots.
struct Annotation {
    slots: [String; 2],
    label: String,
    at: usize,
}

/// Time slots by name: their order, and seconds if known.
type Slots = HashMap<String, (usize, Option<f64>)>;

/// Name, position and annotations of a tier.
type Annotated = (String, usize, Vec<Annotation>);

pub(super) fn read(text: &str, draft: &mut Draft) -> Result<(), TextError> {
    let mut xml = Xml::new(text);
    let mut slots = Slots::new();
    let mut tiers: Vec<Annotated> = Vec::new();
    let mut open: Option<Annotation> = None;
    let mut known = false;
    while let Some(piece) = xml.next()? {
        match piece {
            XmlEvent::Start(element) => match element.name() {
                "ANNOTATION_DOCUMENT" => known = true,
                "TIME_SLOT" => {
                    draft.count(element.at)?;
                    let millis = element.number("TIME_VALUE")?;
                    let slot = (slots.len(), millis.map(|ms| ms / 1000.0));
                    slots.insert(required_attribute(&element, "TIME_SLOT_ID")?, slot);
                }
                "TIER" => {
                    draft.count(element.at)?;
                    let name = required_attribute(&element, "TIER_ID")?;
                    tiers.push((name.trim().to_lowercase(), element.at, Vec::new()));
                }
                "ALIGNABLE_ANNOTATION" => {
                    draft.count(element.at)?;
                    open = Some(Annotation {
                        slots: [
                            required_attribute(&element, "TIME_SLOT_REF1")?,
                            required_attribute(&element, "TIME_SLOT_REF2")?,
                        ],
                        label: String::new(),
                        at: element.at,
                    });
                }
                _ => {}
            },
            XmlEvent::Text(text) => {
                if let Some(annotation) = &mut open {
                    annotation.label.push_str(&text);
                }
            }
            XmlEvent::End(name) if name == "ALIGNABLE_ANNOTATION" => {
                if let (Some((_, _, list)), Some(annotation)) = (tiers.last_mut(), open.take()) {
                    list.push(annotation);
                }
            }
            XmlEvent::End(_) => {}
        }
    }
    if !known {
        return Err(TextError::new(0, "no element \"ANNOTATION_DOCUMENT\""));
    }
    let timed = tiers.into_iter().filter(|t| !t.2.is_empty());
    let timed = timed.map(|tier| intervals(tier, &slots));
    choose(timed.collect::<Result<_, _>>()?, draft, 0)
}

fn required_attribute(element: &Element<'_>, name: &str) -> Result<String, TextError> {
    let missing = || TextError::new(element.at, format!("no attribute {name:?}"));
    element.attribute(name)?.ok_or_else(missing)
}

/// Computes a tier from the times of its annotations.
fn intervals((name, at, mut annotations): Annotated, slots: &Slots) -> Result<Tier, TextError> {
    // They are written in the order in which they were made.
    annotations.sort_by_key(|a| slots.get(&a.slots[0]).map(|s| s.0));
    // Each slot once, in order; neighbours share one.
    let mut line: Vec<(&str, usize)> = Vec::new();
    for annotation in &annotations {
        for slot in &annotation.slots {
            if line.last().is_none_or(|(last, _)| last != slot) {
                line.push((slot, annotation.at));
            }
        }
    }
    let mut times = Vec::with_capacity(line.len());
    for (slot, at) in &line {
        let missing = || TextError::new(*at, format!("no slot of time {slot:?}"));
        times.push(slots.get(*slot).ok_or_else(missing)?.1);
    }
    let mut known: Option<usize> = None;
    for i in 0..times.len() {
        let Some(here) = times[i] else { continue };
        let (from, before) = known.map_or((i, here), |k| (k, times[k].unwrap_or(here)));
        let count = i - from;
        for (k, time) in times.iter_mut().enumerate().take(i).skip(from + 1) {
            let share = (k - from) as f64 / count as f64;
            *time = Some(before + (here - before) * share);
        }
        known = Some(i);
    }
    let mut tier = Tier {
        name,
        at,
        intervals: Vec::with_capacity(annotations.len()),
        points: Vec::new(),
        is_points: false,
    };
    let mut place = 0;
    for Annotation { slots, label, at } in &annotations {
        let untold = || TextError::new(*at, "no time before or after it");
        if line[place].0 != slots[0] {
            place += 1;
        }
        let start = times[place].ok_or_else(untold)?;
        if slots[1] != slots[0] {
            place += 1;
        }
        let end = times[place].ok_or_else(untold)?;
        tier.intervals.push(Raw {
            start,
            end,
            label: label.trim().to_owned(),
            at: *at,
        });
    }
    Ok(tier)
}
