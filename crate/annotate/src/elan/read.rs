//! Reader of annotation files.
//!
//! Time slots without a time are evenly spaced between their neighbours in the tier. Annotations
//! that subdivide one without times share its time evenly; those associated with one have its time.

use std::collections::HashMap;

use raconteur_base::order::order_by_number;
use raconteur_eml::{Diagnostic, quoted};

use super::{Annotation, Elan, Tier};
use crate::gestura::Interval;
use crate::xml::{Element, Text};

/// Maximum number of annotations between one without times and one with times.
const MAX_REFERENCES: usize = 32;

/// Reads a file from its root. What cannot be read is reported and left out.
pub fn read(root: &Element, problems: &mut Vec<Diagnostic>) -> Elan {
    let slots = read_slots(root, problems);
    let mut drafts = Vec::new();
    for tier in root.all("TIER") {
        drafts.push(read_tier(tier, root, &slots, problems));
    }
    let resolver = Resolver::new(&drafts);
    let mut tiers = Vec::new();
    for (tier, draft) in root.all("TIER").zip(&drafts) {
        let annotations = draft.iter().filter_map(|annotation| {
            let interval = resolver.interval(annotation.id, MAX_REFERENCES);
            if interval.is_none() {
                let message = "the annotation has no time, nor an annotation that has one";
                let problem = Diagnostic::error("elan::no-time", annotation.element.tag, message);
                problems.push(problem);
            }
            Some(Annotation {
                interval: interval?,
                value: annotation.value.clone(),
                span: annotation.element.tag,
            })
        });
        let annotations = sorted(annotations.collect());
        tiers.push(Tier {
            name: tier.value("TIER_ID").unwrap_or_default().to_owned(),
            parent: tier.value("PARENT_REF").map(str::to_owned),
            annotations,
            span: tier.tag,
        });
    }
    Elan {
        media: media(root),
        author: root.value("AUTHOR").map(str::to_owned),
        tiers,
    }
}

fn sorted(annotations: Vec<Annotation>) -> Vec<Annotation> {
    match order_by_number(&annotations, |annotation| annotation.interval.start_secs) {
        Some(order) => order.into_iter().map(|i| annotations[i].clone()).collect(),
        None => annotations,
    }
}

fn media(root: &Element) -> Vec<String> {
    let header = root.child("HEADER").into_iter();
    let descriptors = header.flat_map(|header| header.all("MEDIA_DESCRIPTOR"));
    let path = |media: &Element| {
        let relative = media
            .value("RELATIVE_MEDIA_URL")
            .filter(|path| *path != ".");
        relative.or(media.value("MEDIA_URL")).map(str::to_owned)
    };
    descriptors.filter_map(path).collect()
}

/// Time slots by name: seconds if they have a time.
type Slots<'a> = HashMap<&'a str, Option<f64>>;

fn read_slots<'a>(root: &'a Element, problems: &mut Vec<Diagnostic>) -> Slots<'a> {
    let units = root
        .child("HEADER")
        .and_then(|header| header.value("TIME_UNITS"));
    let unit_secs = match units.unwrap_or("milliseconds") {
        "PAL-frames" => 1.0 / 25.0,
        "NTSC-frames" => 1001.0 / 30000.0,
        _ => 1.0 / 1000.0,
    };
    let mut slots = Slots::new();
    let order = root.child("TIME_ORDER").into_iter();
    for slot in order.flat_map(|order| order.all("TIME_SLOT")) {
        let time = slot.number("TIME_VALUE", "elan::number", problems);
        let time = time
            .filter(|time| *time >= 0.0)
            .map(|time| time * unit_secs);
        slots.insert(slot.value("TIME_SLOT_ID").unwrap_or_default(), time);
    }
    slots
}

/// Annotation before the times of all are known.
struct Draft<'a> {
    id: &'a str,
    time: Time<'a>,
    value: Text,
    element: &'a Element,
}

enum Time<'a> {
    /// Its own; `None` if its slots have none.
    Own(Option<Interval>),
    /// A share of that of another annotation: which of how many.
    Of {
        parent: &'a str,
        share: usize,
        count: usize,
    },
}

fn read_tier<'a>(
    tier: &'a Element,
    root: &'a Element,
    slots: &Slots<'_>,
    problems: &mut Vec<Diagnostic>,
) -> Vec<Draft<'a>> {
    let annotations: Vec<&Element> = tier
        .all("ANNOTATION")
        .flat_map(|annotation| &annotation.children)
        .collect();
    let times = slot_times(&annotations, slots, problems);
    let mut drafts: Vec<Draft<'a>> = Vec::new();
    for (element, time) in annotations.into_iter().zip(times) {
        let time = match element.value("ANNOTATION_REF") {
            Some(parent) => Time::Of {
                parent,
                share: 0,
                count: 1,
            },
            None => Time::Own(time),
        };
        drafts.push(Draft {
            id: element.value("ANNOTATION_ID").unwrap_or_default(),
            time,
            value: value(element, tier, root),
            element,
        });
    }
    subdivide(&mut drafts, problems);
    drafts
}

/// Returns the value of an annotation, else that of its entry in a controlled vocabulary.
fn value(element: &Element, tier: &Element, root: &Element) -> Text {
    let own = element
        .child("ANNOTATION_VALUE")
        .map(|value| value.text.clone());
    let own = own.unwrap_or_default();
    if !own.value.is_empty() {
        return own;
    }
    let entry = || {
        let id = element.value("CVE_REF")?;
        let kind = tier.value("LINGUISTIC_TYPE_REF")?;
        let mut kinds = root.all("LINGUISTIC_TYPE");
        let kind = kinds.find(|k| k.value("LINGUISTIC_TYPE_ID") == Some(kind))?;
        let vocabulary = kind.value("CONTROLLED_VOCABULARY_REF")?;
        let mut all = root.all("CONTROLLED_VOCABULARY");
        let vocabulary = all.find(|v| v.value("CV_ID") == Some(vocabulary))?;
        let mut entries = vocabulary.children.iter();
        let entry = entries.find(|entry| entry.value("CVE_ID") == Some(id))?;
        Some(entry.child("CVE_VALUE").unwrap_or(entry).text.clone())
    };
    entry().unwrap_or(own)
}

/// Returns the times of the annotations of a tier by their slots.
fn slot_times(
    annotations: &[&Element],
    slots: &Slots<'_>,
    problems: &mut Vec<Diagnostic>,
) -> Vec<Option<Interval>> {
    // Slots in the order of the tier: neighbours share one, so it counts once.
    let mut chain: Vec<(&str, Option<f64>)> = Vec::new();
    let mut ends: Vec<Option<[usize; 2]>> = Vec::new();
    for element in annotations {
        let mut place = |name: &str| {
            let id = element.value(name)?;
            let Some(&time) = slots.get(id) else {
                let message = format!("{} is not a time slot", quoted(id));
                let text = element.attribute(name)?;
                problems.push(Diagnostic::error("elan::no-slot", text.span, message));
                return None;
            };
            if chain.last().is_none_or(|(last, _)| *last != id) {
                chain.push((id, time));
            }
            Some(chain.len() - 1)
        };
        let first = place("TIME_SLOT_REF1");
        let last = place("TIME_SLOT_REF2");
        ends.push(first.zip(last).map(|(first, last)| [first, last]));
    }
    let mut times: Vec<Option<f64>> = chain.into_iter().map(|(_, time)| time).collect();
    let known: Vec<usize> = (0..times.len()).filter(|&i| times[i].is_some()).collect();
    for pair in known.windows(2) {
        let (Some(from), Some(to)) = (times[pair[0]], times[pair[1]]) else {
            continue;
        };
        let steps = (pair[1] - pair[0]) as f64;
        for (step, time) in times[pair[0] + 1..pair[1]].iter_mut().enumerate() {
            *time = Some(from + (to - from) * (step + 1) as f64 / steps);
        }
    }
    let interval = |end: &Option<[usize; 2]>| {
        let [first, last] = (*end)?;
        let (start, end) = (times[first]?, times[last]?);
        Some(Interval::new(start.min(end), start.max(end)))
    };
    ends.iter().map(interval).collect()
}

/// Orders the annotations that subdivide one and gives each its share.
fn subdivide(drafts: &mut [Draft<'_>], problems: &mut Vec<Diagnostic>) {
    // Chains by their parent: each annotation names the one before.
    let mut after: HashMap<&str, usize> = HashMap::new();
    let mut chains: Vec<Vec<usize>> = Vec::new();
    for (i, draft) in drafts.iter().enumerate() {
        let Time::Of { .. } = draft.time else {
            continue;
        };
        match draft.element.value("PREVIOUS_ANNOTATION") {
            None => chains.push(vec![i]),
            Some(previous) => {
                if after.insert(previous, i).is_some() {
                    let message = "two annotations follow the same one";
                    let problem = Diagnostic::error("elan::order", draft.element.tag, message);
                    problems.push(problem);
                }
            }
        }
    }
    for chain in &mut chains {
        // Each step takes an entry away, so cycles end.
        while let Some(next) = chain.last().and_then(|&last| after.remove(drafts[last].id)) {
            chain.push(next);
        }
        for (at, &i) in chain.iter().enumerate() {
            if let Time::Of { share, count, .. } = &mut drafts[i].time {
                (*share, *count) = (at, chain.len());
            }
        }
    }
}

/// Annotations of all tiers by their name.
struct Resolver<'a> {
    by_id: HashMap<&'a str, &'a Draft<'a>>,
}

impl<'a> Resolver<'a> {
    fn new(tiers: &'a [Vec<Draft<'a>>]) -> Self {
        let all = tiers.iter().flatten();
        Self {
            by_id: all.map(|draft| (draft.id, draft)).collect(),
        }
    }

    /// Returns the time of an annotation; recursion ends after `depth` references.
    fn interval(&self, id: &str, depth: usize) -> Option<Interval> {
        match self.by_id.get(id)?.time {
            Time::Own(interval) => interval,
            Time::Of { .. } if depth == 0 => None,
            Time::Of {
                parent,
                share,
                count,
            } => {
                let whole = self.interval(parent, depth - 1)?;
                let at = |share: usize| {
                    whole.start_secs + whole.length_secs() * share as f64 / count as f64
                };
                Some(Interval::new(at(share), at(share + 1)))
            }
        }
    }
}
