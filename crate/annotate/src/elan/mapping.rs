//! Mapping of tiers to tracks of GestuRA, from a file or a guess.

use std::collections::BTreeMap;

use raconteur_eml::{Diagnostic, Span, quoted};

use super::{Annotation as Annotated, Elan, Tier};
use crate::anvil::{Annotation, Extent, Info, Media, Track, TrackElement, TrackKind};
use crate::gestura::letters;
use crate::names::*;
use crate::xml::Text;

/// Words that transcribers use for those of GestuRA.
const ALIASES: &[(&str, &str)] = &[
    ("prep", "preparation"),
    ("p", "preparation"),
    ("prestrokehold", "pre-stroke hold"),
    ("prehold", "pre-stroke hold"),
    ("psh", "pre-stroke hold"),
    ("s", "stroke"),
    ("str", "stroke"),
    ("posthold", "post-stroke hold"),
    ("r", "retraction"),
    ("retr", "retraction"),
    ("retract", "retraction"),
    ("recovery", "retraction"),
    ("partial", "partial-retraction"),
    ("iconics", "iconic"),
    ("representational", "iconic"),
    ("metaphor", "metaphoric"),
    ("deictics", "deictic"),
    ("pointing", "deictic"),
    ("beats", "beat"),
    ("baton", "beat"),
    ("right", "RH"),
    ("left", "LH"),
    ("both", "BH"),
    ("adapter", "adaptor"),
    ("emblematic", "emblem"),
];

/// Mapping of tiers to the tracks and attributes of GestuRA.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mapping {
    /// Tier by track, or by track and attribute joined by a point.
    pub tiers: BTreeMap<String, String>,
    /// Word of GestuRA by the letters of a value.
    pub values: BTreeMap<String, String>,
}

impl Mapping {
    /// Reads a mapping file: lines `TRACK = TIER`, `TRACK.ATTRIBUTE = TIER` and `value NAME = WORD`;
    /// lines that begin with `#` are comments.
    ///
    /// ```text
    /// words = W-Spch
    /// gesticulation.phases.layer1 = G-Phase
    /// gesticulation.phases.layer1.hand-shapes = G-Shape
    /// value prep = preparation
    /// ```
    pub fn read(text: &str, problems: &mut Vec<Diagnostic>) -> Self {
        let mut mapping = Self::default();
        let mut at = 0;
        for line in text.split_inclusive('\n') {
            let start = at;
            at += line.len();
            let place = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
            let span = Span::new(place(start), place(start + line.trim_end().len()));
            let content = line.trim_start_matches('\u{feff}').trim();
            // Names of tiers may contain the sign.
            if content.is_empty() || content.starts_with('#') {
                continue;
            }
            match content
                .split_once('=')
                .map(|(name, value)| (name.trim(), value.trim()))
            {
                Some((name, value)) if !name.is_empty() && !value.is_empty() => {
                    let before = match name.strip_prefix("value ") {
                        Some(name) => mapping.values.insert(letters(name), value.to_owned()),
                        None => mapping.tiers.insert(name.to_owned(), value.to_owned()),
                    };
                    if let Some(before) = before.filter(|before| before != value) {
                        let message = format!("{} was {} before", quoted(name), quoted(&before));
                        problems.push(Diagnostic::warning("elan::mapping", span, message));
                    }
                }
                _ => {
                    let message = "expected `TRACK = TIER` or `value NAME = WORD`";
                    problems.push(Diagnostic::error("elan::mapping", span, message));
                }
            }
        }
        mapping
    }

    /// Returns the word of GestuRA for a value.
    pub(super) fn word(&self, value: &str) -> String {
        let key = letters(value);
        if let Some(word) = self.values.get(&key) {
            return word.clone();
        }
        let alias = ALIASES.iter().find(|(alias, _)| *alias == key);
        alias.map_or(value, |(_, word)| word).to_owned()
    }
}

/// Returns the attribute that the value of a track's main tier fills.
fn main_attribute(track: &str) -> Option<&'static str> {
    let group = |name: &str| {
        track
            .strip_prefix(name)
            .is_some_and(|rest| rest.starts_with('.'))
    };
    Some(match track {
        WORDS => TOKEN,
        UTTERANCES => TEXT,
        LEVELS => LEVEL,
        GESTURES => TYPE,
        _ if group(PHASES) => PHASE,
        _ if group(PHRASES) => PHRASE,
        _ => return None,
    })
}

/// Converts a file to tracks of GestuRA. All have times of their own. Tiers that are mapped and do
/// not exist are reported.
#[must_use]
pub fn to_annotation(elan: &Elan, mapping: &Mapping, problems: &mut Vec<Diagnostic>) -> Annotation {
    let mut tracks: Vec<Track> = Vec::new();
    let mut attributes: Vec<(&str, &Tier)> = Vec::new();
    for (name, tier) in &mapping.tiers {
        let Some(found) = elan
            .tiers
            .iter()
            .find(|t| t.name.eq_ignore_ascii_case(tier))
        else {
            let (tier, name) = (quoted(tier), quoted(name));
            let message =
                format!("the file has no tier {tier}, which the mapping gives for {name}");
            let names: Vec<String> = elan.tiers.iter().map(|tier| quoted(&tier.name)).collect();
            let hint = format!("its tiers are {}", names.join(", "));
            let problem = Diagnostic::error("elan::no-tier", Span::new(0, 0), message);
            problems.push(problem.hint(hint));
            continue;
        };
        // `gesticulation.phases.layer1` is a track, `gesticulation.phases.layer1.motion` one of its
        // attributes.
        let depth = name.split('.').count();
        let is_track = depth == 1 || (name.starts_with("gesticulation.") && depth == 3);
        match main_attribute(name).filter(|_| is_track) {
            Some(attribute) => tracks.push(track(name, attribute, found, mapping)),
            None => attributes.push((name, found)),
        }
    }
    for (name, tier) in attributes {
        let Some((track, attribute)) = name.rsplit_once('.') else {
            let message = format!("{} is not a track of GestuRA", quoted(name));
            problems.push(Diagnostic::error("elan::mapping", Span::new(0, 0), message));
            continue;
        };
        match tracks.iter_mut().find(|t| t.name == track) {
            Some(track) => add_attribute(track, attribute, tier, mapping),
            None => {
                let message = format!("the track of {} is not mapped", quoted(name));
                problems.push(Diagnostic::error("elan::mapping", Span::new(0, 0), message));
            }
        }
    }
    let media = elan.media.iter().enumerate().map(|(at, source)| Media {
        kind: "video".into(),
        source: source.clone(),
        is_master: at == 0,
    });
    let coder = elan
        .author
        .iter()
        .filter(|author| !author.is_empty())
        .map(|author| Info {
            key: CODER.into(),
            kind: "String".into(),
            text: author.clone(),
        });
    Annotation {
        specification: None,
        media: media.collect(),
        info: coder.collect(),
        tracks,
    }
}

fn track(name: &str, attribute: &str, tier: &Tier, mapping: &Mapping) -> Track {
    let free_text = matches!(name, WORDS | UTTERANCES);
    let elements = tier
        .annotations
        .iter()
        .enumerate()
        .map(|(index, annotation)| {
            let mut text = annotation.value.clone();
            if attribute == PHASE && letters(&text.value) == "hold" {
                text = replaced(text, hold(&tier.annotations, index, mapping));
            } else if !free_text {
                let word = mapping.word(&text.value);
                text = replaced(text, &word);
            }
            TrackElement {
                index,
                extent: Extent::Times(annotation.interval),
                attributes: vec![(attribute.to_owned(), text)],
                comment: None,
                span: annotation.span,
            }
        });
    Track {
        name: name.to_owned(),
        kind: TrackKind::Primary,
        elements: elements.collect(),
        span: tier.span,
    }
}

/// Returns the kind of a hold without one: before the stroke if a stroke follows it and none
/// precedes it since a preparation.
fn hold(annotations: &[Annotated], index: usize, mapping: &Mapping) -> &'static str {
    let is = |annotation: Option<&Annotated>, word: &str| {
        annotation.is_some_and(|a| letters(&mapping.word(&a.value.value)) == word)
    };
    let before = index.checked_sub(1).and_then(|i| annotations.get(i));
    if is(annotations.get(index + 1), "stroke") && !is(before, "stroke") {
        "pre-stroke hold"
    } else {
        "post-stroke hold"
    }
}

/// Returns another value at the place of a text.
fn replaced(text: Text, value: &str) -> Text {
    if text.value == value {
        return text;
    }
    text.with_value(value.to_owned())
}

/// Adds the values of a tier to the elements of a track that they lie in.
fn add_attribute(track: &mut Track, attribute: &str, tier: &Tier, mapping: &Mapping) {
    let is_list = matches!(attribute, HANDEDNESS | ICONIC_VIEWPOINT);
    for element in &mut track.elements {
        let Extent::Times(whole) = element.extent else {
            continue;
        };
        let inside = |annotation: &&Annotated| {
            let middle = 0.5 * (annotation.interval.start_secs + annotation.interval.end_secs);
            (whole.start_secs..=whole.end_secs).contains(&middle)
        };
        if let Some(annotation) = tier.annotations.iter().find(inside) {
            let mut text = annotation.value.clone();
            if is_list {
                let word = mapping.word(&text.value);
                text = replaced(text, &word);
            }
            element.attributes.push((attribute.to_owned(), text));
        }
    }
}
