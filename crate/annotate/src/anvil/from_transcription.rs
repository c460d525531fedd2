//! A GestuRA transcription as tracks of an annotation (GEVH C.4).

use std::ops::RangeInclusive;

use super::{Annotation, Extent, Info, Media, Track, TrackElement, TrackKind};
use crate::gestura::{Interval, Layer, Noted, Phase, Phrase, Transcription, Vocabulary};
use crate::gsl::Feature;
use crate::names::*;
use crate::xml::Text;

/// File name of the specification that the annotation refers to.
const SPECIFICATION: &str = "gestura-spec.xml";

/// Converts a transcription. Reading the annotation gives it again.
#[must_use]
pub fn from_transcription(transcription: &Transcription) -> Annotation {
    let media = transcription.media.iter().enumerate();
    let coder = transcription.coder.iter().map(|coder| Info {
        key: CODER.into(),
        kind: "String".into(),
        text: coder.clone(),
    });
    let settings = transcription.settings.iter().map(|setting| Info {
        key: format!("{}.{}", setting.element, setting.attribute),
        kind: "String".into(),
        text: setting.value.clone(),
    });
    Annotation {
        specification: Some(SPECIFICATION.into()),
        media: media
            .map(|(at, source)| Media {
                kind: "video".into(),
                source: source.clone(),
                is_master: at == 0,
            })
            .collect(),
        info: coder.chain(settings).collect(),
        tracks: tracks(transcription),
    }
}

fn tracks(transcription: &Transcription) -> Vec<Track> {
    let mut tracks = vec![
        track(WORDS, TrackKind::Primary, &transcription.words, |word| {
            let attributes = AttributeList::default().text(TOKEN, Some(&word.token));
            (Extent::Times(word.interval), attributes)
        }),
        track(
            UTTERANCES,
            TrackKind::Span(WORDS.into()),
            &transcription.utterances,
            |utterance| {
                let attributes = AttributeList::default().text(TEXT, Some(&utterance.text));
                (run(&utterance.words), attributes)
            },
        ),
        track(
            LEVELS,
            TrackKind::Span(UTTERANCES.into()),
            &transcription.levels,
            |span| {
                let attributes = AttributeList::default().word(LEVEL, Some(span.level));
                (run(&span.utterances), attributes)
            },
        ),
        track(
            GESTURES,
            TrackKind::Primary,
            &transcription.gestures,
            |gesture| {
                let attributes = AttributeList::default()
                    .word(TYPE, Some(gesture.class))
                    .confidence(gesture.confidence)
                    .text(ANIMATION, gesture.animation.as_ref());
                (Extent::Times(gesture.interval), attributes)
            },
        ),
    ];
    let prosody = by_element(&transcription.prosody, |prosody| &prosody.element);
    tracks.extend(prosody.into_iter().map(|(element, items)| {
        let name = format!("{PROSODY}.{element}");
        track(&name, TrackKind::Span(WORDS.into()), &items, |prosody| {
            (
                run(&prosody.words),
                AttributeList::from_list(&prosody.attributes),
            )
        })
    }));
    let staging = by_element(&transcription.staging, |event| &event.element);
    tracks.extend(staging.into_iter().map(|(element, items)| {
        let name = format!("{STAGING}.{element}");
        track(&name, TrackKind::Primary, &items, |event| {
            let attributes = AttributeList::from_list(&event.attributes);
            (Extent::Times(event.interval), attributes)
        })
    }));
    let layers = &transcription.layers;
    tracks.extend(layers.iter().map(phases));
    tracks.extend(layers.iter().map(phrases));
    tracks
}

/// Groups items by their element, in the order of their first one.
fn by_element<T>(items: &[T], element: impl Fn(&T) -> &String) -> Vec<(&String, Vec<&T>)> {
    let mut groups: Vec<(&String, Vec<&T>)> = Vec::new();
    for item in items {
        let name = element(item);
        match groups.iter_mut().find(|(known, _)| *known == name) {
            Some((_, group)) => group.push(item),
            None => groups.push((name, vec![item])),
        }
    }
    groups
}

fn phases(layer: &Layer) -> Track {
    let name = format!("{PHASES}.{}", layer.name);
    track(&name, TrackKind::Primary, &layer.phases, |phase: &Phase| {
        let form = &phase.form;
        let attributes = AttributeList::default()
            .word(PHASE, Some(phase.kind))
            .noted(SOURCE, form.source.as_ref())
            .noted(TARGET, form.target.as_ref())
            .noted(MOTION, form.motion.as_ref())
            .noted(HAND_SHAPES, form.hand_shapes.as_ref())
            .noted(PALM_ORIENTATIONS, form.palm_orientations.as_ref())
            .text(BODY_SHAPE, form.body_shape.as_ref());
        (Extent::Times(phase.interval), attributes)
    })
}

fn phrases(layer: &Layer) -> Track {
    let name = format!("{PHRASES}.{}", layer.name);
    let kind = TrackKind::Span(format!("{PHASES}.{}", layer.name));
    track(&name, kind, &layer.phrases, |phrase: &Phrase| {
        let meaning = &phrase.meaning;
        let symmetry = phrase.symmetry.map(|symmetry| symmetry.to_string());
        let attributes = AttributeList::default()
            .word(PHRASE, phrase.dimension)
            .word(HANDEDNESS, phrase.handedness)
            .text(SYMMETRY, symmetry.as_ref())
            .text(
                SPEAKER_FRAME_POSITION,
                phrase.speaker_frame_position.as_ref(),
            )
            .confidence(phrase.confidence)
            .text(CONTRIBUTION, phrase.contribution.as_ref())
            .text(ICONIC_BODY, meaning.iconic_body.as_ref())
            .text(ICONIC_MOTION, meaning.iconic_motion.as_ref())
            .word(ICONIC_VIEWPOINT, meaning.iconic_viewpoint)
            .text(METAPHORIC_BASE, meaning.metaphoric_base.as_ref())
            .text(METAPHORIC_REFERENT, meaning.metaphoric_referent.as_ref())
            .text(METAPHORIC_MOTION, meaning.metaphoric_motion.as_ref())
            .text(
                DEICTIC_GEOGRAPHIC,
                meaning.deictic_geographic_target.as_ref(),
            )
            .text(DEICTIC_NARRATION, meaning.deictic_narration_target.as_ref());
        (run(&phrase.phases), attributes)
    })
}

fn track<T>(
    name: &str,
    kind: TrackKind,
    items: &[T],
    content: impl Fn(&T) -> (Extent, AttributeList),
) -> Track {
    let element = |(index, item): (usize, &T)| {
        let (extent, attributes) = content(item);
        TrackElement {
            index,
            extent: match extent {
                Extent::Times(interval) => Extent::Times(rounded(interval)),
                Extent::Elements(..) => extent,
            },
            attributes: attributes.list,
            ..TrackElement::default()
        }
    };
    Track {
        name: name.into(),
        kind,
        elements: items.iter().enumerate().map(element).collect(),
        ..Track::default()
    }
}

/// Rounds times to microseconds, so that sums of binary fractions do not fill files with digits.
fn rounded(interval: Interval) -> Interval {
    let round = |secs: f64| (secs * 1e6).round() / 1e6;
    Interval::new(round(interval.start_secs), round(interval.end_secs))
}

fn run(range: &RangeInclusive<usize>) -> Extent {
    Extent::Elements(*range.start(), *range.end())
}

/// Attributes of an element in the order of the specification; absent ones are left out.
#[derive(Default)]
struct AttributeList {
    list: Vec<(String, Text)>,
}

impl AttributeList {
    fn from_list(list: &[(String, String)]) -> Self {
        let list = list.iter();
        Self {
            list: list
                .map(|(name, text)| (name.clone(), Text::from(text.clone())))
                .collect(),
        }
    }

    fn text(mut self, name: &str, text: Option<&String>) -> Self {
        if let Some(text) = text.filter(|text| !text.is_empty()) {
            self.list.push((name.into(), Text::from(text.clone())));
        }
        self
    }

    fn word<V: Vocabulary>(self, name: &str, value: Option<V>) -> Self {
        self.text(name, value.map(|value| value.word().to_owned()).as_ref())
    }

    fn noted<F: Feature>(self, name: &str, noted: Option<&Noted<F>>) -> Self {
        self.text(name, noted.map(|noted| &noted.text))
    }

    fn confidence(self, confidence: Option<u8>) -> Self {
        self.text(
            CONFIDENCE,
            confidence.map(|level| level.to_string()).as_ref(),
        )
    }
}
