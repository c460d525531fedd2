//! Specifications: the tracks and attributes that an annotation may have.

use std::collections::BTreeMap;

use raconteur_eml::{Diagnostic, Span, quoted};

use super::{Annotation, Track};
use crate::xml::{Element, Text};

/// Specification file of GestuRA for ANVIL (GEVH C.4).
pub const GESTURA: &str = include_str!("gestura-spec.xml");

/// Specification of annotations.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Specification {
    tracks: Vec<TrackSpecification>,
}

#[derive(Clone, Debug, Default, PartialEq)]
struct TrackSpecification {
    /// Groups and name, joined by points.
    name: String,
    kind: String,
    reference: Option<String>,
    attributes: BTreeMap<String, ValueType>,
}

/// Type of the values of an attribute.
#[derive(Clone, Debug, PartialEq)]
enum ValueType {
    /// One of a list.
    Set(Vec<String>),
    /// Number in a range.
    Number(f64, f64),
    /// `true` or `false`.
    Boolean,
    /// Any text, also of types that are not checked.
    Any,
}

impl Specification {
    /// Reads a specification from the root of its file.
    #[must_use]
    pub fn read(root: &Element) -> Self {
        let mut sets = BTreeMap::new();
        let definitions = root
            .child("head")
            .into_iter()
            .flat_map(|head| head.all("valuetype-def"));
        for set in definitions.flat_map(|definition| definition.all("valueset")) {
            sets.insert(
                set.value("name").unwrap_or_default().to_owned(),
                values(set),
            );
        }
        let mut specification = Self::default();
        if let Some(body) = root.child("body") {
            specification.read_group(body, "", &BTreeMap::new(), &sets);
        }
        specification
    }

    /// Reads a group or the body: attributes of a group belong to all tracks inside. Recursion is
    /// limited by the depth of the file.
    fn read_group(
        &mut self,
        group: &Element,
        prefix: &str,
        inherited: &BTreeMap<String, ValueType>,
        sets: &BTreeMap<String, Vec<String>>,
    ) {
        let mut attributes = inherited.clone();
        attributes.extend(read_attributes(group, sets));
        for child in &group.children {
            let name = format!("{prefix}{}", child.value("name").unwrap_or_default());
            match child.name.as_str() {
                "group" => self.read_group(child, &format!("{name}."), &attributes, sets),
                "track-spec" => {
                    let mut attributes = attributes.clone();
                    attributes.extend(read_attributes(child, sets));
                    self.tracks.push(TrackSpecification {
                        name,
                        kind: child.value("type").unwrap_or("primary").to_owned(),
                        reference: child.value("ref").map(str::to_owned),
                        attributes,
                    });
                }
                _ => {}
            }
        }
    }
}

fn read_attributes<'a>(
    element: &'a Element,
    sets: &'a BTreeMap<String, Vec<String>>,
) -> impl Iterator<Item = (String, ValueType)> + 'a {
    element.all("attribute").map(|attribute| {
        let name = attribute.value("name").unwrap_or_default().to_owned();
        (name, value_type(attribute, sets))
    })
}

fn values(element: &Element) -> Vec<String> {
    element
        .all("value-el")
        .map(|value| value.text.value.clone())
        .collect()
}

fn value_type(attribute: &Element, sets: &BTreeMap<String, Vec<String>>) -> ValueType {
    let name = attribute.value("valuetype").unwrap_or_default();
    if let Some(set) = sets.get(name) {
        return ValueType::Set(set.clone());
    }
    let own = values(attribute);
    if !own.is_empty() {
        return ValueType::Set(own);
    }
    if name == "Boolean" {
        return ValueType::Boolean;
    }
    let range = name.strip_prefix("Number").and_then(|rest| {
        let (least, most) = rest.strip_prefix('(')?.strip_suffix(')')?.split_once(',')?;
        Some((least.trim().parse().ok()?, most.trim().parse().ok()?))
    });
    match range {
        Some((least, most)) => ValueType::Number(least, most),
        None if name == "Number" => ValueType::Number(f64::NEG_INFINITY, f64::INFINITY),
        None => ValueType::Any,
    }
}

/// Returns what a specification does not allow in an annotation: tracks and attributes that it does
/// not have, other types of tracks, tracks before those that they refer to, and values outside
/// their type.
#[must_use]
pub fn check(annotation: &Annotation, specification: &Specification) -> Vec<Diagnostic> {
    let mut problems = Vec::new();
    let mut known: Vec<&str> = Vec::new();
    for track in &annotation.tracks {
        let specified = specification.tracks.iter().find(|s| s.name == track.name);
        match specified {
            Some(specified) => check_track(track, specified, &mut problems),
            None => {
                let message = format!("the specification has no track {}", quoted(&track.name));
                problems.push(Diagnostic::error(
                    "anvil::unknown-track",
                    track.span,
                    message,
                ));
            }
        }
        if let Some(reference) = track.kind.reference()
            && !known.contains(&reference)
        {
            let message = format!("the track {} must come before this one", quoted(reference));
            problems.push(Diagnostic::error("anvil::track-order", track.span, message));
        }
        known.push(&track.name);
    }
    problems
}

fn check_track(track: &Track, specified: &TrackSpecification, problems: &mut Vec<Diagnostic>) {
    let mut report = |span: Span, message: String| {
        problems.push(Diagnostic::error("anvil::specification", span, message));
    };
    if track.kind.name() != specified.kind {
        let message = format!(
            "the track is of the type {} by its specification",
            specified.kind
        );
        report(track.span, message);
    }
    if track.kind.reference() != specified.reference.as_deref() {
        report(
            track.span,
            "the track refers to another one than its specification".into(),
        );
    }
    for element in &track.elements {
        for (name, text) in &element.attributes {
            match specified.attributes.get(name) {
                None => {
                    let message = format!("the track has no attribute {}", quoted(name));
                    report(element.span, message);
                }
                Some(kind) if !fits(text, kind) => {
                    let message = format!("{} is not a value of `{name}`", quoted(&text.value));
                    report(text.span, message);
                }
                Some(_) => {}
            }
        }
    }
}

fn fits(text: &Text, kind: &ValueType) -> bool {
    match kind {
        ValueType::Set(values) => values.contains(&text.value),
        ValueType::Number(least, most) => text
            .value
            .parse::<f64>()
            .is_ok_and(|n| (*least..=*most).contains(&n)),
        ValueType::Boolean => matches!(text.value.as_str(), "true" | "false"),
        ValueType::Any => true,
    }
}
