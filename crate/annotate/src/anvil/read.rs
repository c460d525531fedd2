//! Reader of annotation files.

use std::collections::BTreeSet;

use raconteur_eml::{Diagnostic, Span, quoted};

use super::{Annotation, Extent, Info, Media, Track, TrackElement, TrackKind};
use crate::gestura::Interval;
use crate::xml::Element;

/// Maximum time in a file, seconds: more than a day.
const MAX_SECS: f64 = 1e5;

/// Reads an annotation from the root of its file. What cannot be read is reported and left out.
pub fn read(root: &Element, problems: &mut Vec<Diagnostic>) -> Annotation {
    let mut annotation = Annotation::default();
    if let Some(head) = root.child("head") {
        read_head(head, &mut annotation);
    }
    let Some(body) = root.child("body") else {
        problems.push(Diagnostic::error(
            "anvil::no-body",
            root.tag,
            "the annotation has no `body`",
        ));
        return annotation;
    };
    let mut names = BTreeSet::new();
    for track in body.all("track") {
        if let Some(track) = read_track(track, problems) {
            if names.insert(track.name.to_lowercase()) {
                annotation.tracks.push(track);
            } else {
                let message = format!("a second track {}", quoted(&track.name));
                problems.push(Diagnostic::error(
                    "anvil::duplicate-track",
                    track.span,
                    message,
                ));
            }
        }
    }
    annotation
}

fn read_head(head: &Element, annotation: &mut Annotation) {
    for child in &head.children {
        let source = || child.value("src").unwrap_or_default().to_owned();
        match child.name.as_str() {
            "specification" => annotation.specification = Some(source()),
            "video" | "audio" => annotation.media.push(Media {
                kind: child.name.clone(),
                source: source(),
                is_master: child.value("master") == Some("true"),
            }),
            "info" => annotation.info.push(Info {
                key: child.value("key").unwrap_or_default().to_owned(),
                kind: child.value("type").unwrap_or("String").to_owned(),
                text: child.text.value.clone(),
            }),
            _ => {}
        }
    }
}

fn read_track(track: &Element, problems: &mut Vec<Diagnostic>) -> Option<Track> {
    let Some(name) = track.value("name") else {
        problems.push(Diagnostic::error(
            "anvil::missing-attribute",
            track.tag,
            "the track has no `name`",
        ));
        return None;
    };
    let mut reference = || match track.value("ref") {
        Some(name) => Some(name.to_owned()),
        None => {
            let message = "the track has no `ref`, the track that it refers to";
            problems.push(Diagnostic::error(
                "anvil::missing-attribute",
                track.tag,
                message,
            ));
            None
        }
    };
    let kind = match track.value("type").unwrap_or("primary") {
        "primary" => TrackKind::Primary,
        "span" => TrackKind::Span(reference()?),
        "singleton" => TrackKind::Singleton(reference()?),
        "subdivision" => TrackKind::Subdivision(reference()?),
        other => TrackKind::Other(other.to_owned()),
    };
    let mut elements = Vec::new();
    let mut indices = BTreeSet::new();
    if !matches!(kind, TrackKind::Other(_)) {
        for (position, element) in track.all("el").enumerate() {
            let Some(element) = read_element(element, position, &kind, problems) else {
                continue;
            };
            if !indices.insert(element.index) {
                let message = format!("a second element with the index {}", element.index);
                problems.push(Diagnostic::error(
                    "anvil::duplicate-index",
                    element.span,
                    message,
                ));
                continue;
            }
            elements.push(element);
        }
    }
    Some(Track {
        name: name.to_owned(),
        kind,
        elements,
        span: track.tag,
    })
}

fn read_element(
    element: &Element,
    position: usize,
    kind: &TrackKind,
    problems: &mut Vec<Diagnostic>,
) -> Option<TrackElement> {
    let index = match element.value("index") {
        Some(_) => index(element, "index", problems)?,
        None => position,
    };
    let extent = match kind {
        TrackKind::Primary | TrackKind::Subdivision(_) | TrackKind::Other(_) => {
            Extent::Times(times(element, problems)?)
        }
        TrackKind::Span(_) => {
            let (first, last) = (
                index_of(element, "start", problems)?,
                index_of(element, "end", problems)?,
            );
            if last < first {
                let message = "the end of the element is before its start";
                problems.push(Diagnostic::error("anvil::order", element.tag, message));
                return None;
            }
            Extent::Elements(first, last)
        }
        TrackKind::Singleton(_) => {
            let name = if element.value("ref").is_some() {
                "ref"
            } else {
                "start"
            };
            let at = index_of(element, name, problems)?;
            Extent::Elements(at, at)
        }
    };
    let mut attributes = Vec::new();
    for attribute in element.all("attribute") {
        match attribute.value("name") {
            Some(name) => attributes.push((name.to_owned(), attribute.text.clone())),
            None => problems.push(Diagnostic::error(
                "anvil::missing-attribute",
                attribute.tag,
                "the attribute has no `name`",
            )),
        }
    }
    let comment = element
        .child("comment")
        .map(|comment| comment.text.value.clone());
    Some(TrackElement {
        index,
        extent,
        attributes,
        comment: comment.filter(|text| !text.is_empty()),
        span: element.tag,
    })
}

fn times(element: &Element, problems: &mut Vec<Diagnostic>) -> Option<Interval> {
    let mut time = |name: &str| {
        let before = problems.len();
        let time = element.number(name, "anvil::number", problems);
        if time.is_none() && problems.len() == before {
            missing(element, name, problems);
        }
        time
    };
    let (start, end) = (time("start")?, time("end")?);
    let fault = if start < 0.0 || end > MAX_SECS {
        format!("times are 0 to {MAX_SECS} s")
    } else if end < start {
        "the end of the element is before its start".to_owned()
    } else {
        return Some(Interval::new(start, end));
    };
    problems.push(Diagnostic::error("anvil::order", element.tag, fault));
    None
}

/// Returns the index that an attribute must hold.
fn index_of(element: &Element, name: &str, problems: &mut Vec<Diagnostic>) -> Option<usize> {
    if element.value(name).is_none() {
        missing(element, name, problems);
        return None;
    }
    index(element, name, problems)
}

fn missing(element: &Element, name: &str, problems: &mut Vec<Diagnostic>) {
    let message = format!("the element has no `{name}`");
    problems.push(Diagnostic::error(
        "anvil::missing-attribute",
        element.tag,
        message,
    ));
}

fn index(element: &Element, name: &str, problems: &mut Vec<Diagnostic>) -> Option<usize> {
    let text = element.attribute(name)?;
    // Some programs write indices as decimals.
    let whole = text.value.strip_suffix(".0").unwrap_or(&text.value);
    let index = whole.parse::<u32>().ok();
    if index.is_none() {
        let message = format!("{} is not the index of an element", quoted(&text.value));
        let span = if text.span == Span::default() {
            element.tag
        } else {
            text.span
        };
        problems.push(Diagnostic::error("anvil::number", span, message));
    }
    index.map(|index| index as usize)
}
