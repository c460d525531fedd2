//! Transcriptions as plain data for pages: numbers and texts, with kinds as their words and forms as
//! their GSL. On the way back, texts are parsed again, and each problem knows its annotation.

mod read;
mod write;

use raconteur_eml::Span;
use serde::{Deserialize, Serialize};

use crate::gestura::{Attributes, Transcription};

macro_rules! plain {
    ($(#[$doc:meta])* $name:ident { $($field:ident: $type:ty,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
        #[serde(rename_all = "camelCase", default)]
        pub struct $name {
            $(pub(crate) $field: $type,)*
        }
    };
}

plain! {
    /// Transcription; `Transcription` in `web/pages/transcribe/types.ts`.
    PlainTranscription {
        media: Vec<String>,
        coder: Option<String>,
        words: Vec<PlainWord>,
        utterances: Vec<PlainUtterance>,
        levels: Vec<PlainLevel>,
        gestures: Vec<PlainGesture>,
        prosody: Vec<PlainProsody>,
        staging: Vec<PlainStaging>,
        settings: Vec<PlainSetting>,
        layers: Vec<PlainLayer>,
    }
}

plain! {
    /// Spoken word; times are seconds.
    PlainWord {
        token: String,
        start: f64,
        end: f64,
    }
}

plain! {
    /// Utterance over the words `first` to `last`.
    PlainUtterance {
        text: String,
        first: usize,
        last: usize,
    }
}

plain! {
    /// Discourse level over utterances.
    PlainLevel {
        level: String,
        first: usize,
        last: usize,
    }
}

plain! {
    /// Gesture with its class.
    PlainGesture {
        class: String,
        confidence: Option<u8>,
        animation: Option<String>,
        start: f64,
        end: f64,
    }
}

plain! {
    /// Manner in which the words `first` to `last` are spoken: an element of EML.
    PlainProsody {
        element: String,
        attributes: Attributes,
        first: usize,
        last: usize,
    }
}

plain! {
    /// Event on stage: an element of EML.
    PlainStaging {
        element: String,
        attributes: Attributes,
        start: f64,
        end: f64,
    }
}

plain! {
    /// Setting of the whole performance.
    PlainSetting {
        element: String,
        attribute: String,
        value: String,
    }
}

plain! {
    /// Layer of gesticulation.
    PlainLayer {
        name: String,
        phases: Vec<PlainPhase>,
        phrases: Vec<PlainPhrase>,
    }
}

plain! {
    /// Phase with its form.
    PlainPhase {
        kind: String,
        start: f64,
        end: f64,
        source: Option<String>,
        target: Option<String>,
        motion: Option<String>,
        hand_shapes: Option<String>,
        palm_orientations: Option<String>,
        body_shape: Option<String>,
    }
}

plain! {
    /// Phrase over phases of its layer.
    PlainPhrase {
        first: usize,
        last: usize,
        dimension: Option<String>,
        handedness: Option<String>,
        symmetry: Option<bool>,
        speaker_frame_position: Option<String>,
        confidence: Option<u8>,
        contribution: Option<String>,
        iconic_body: Option<String>,
        iconic_motion: Option<String>,
        iconic_viewpoint: Option<String>,
        metaphoric_base: Option<String>,
        metaphoric_referent: Option<String>,
        metaphoric_motion: Option<String>,
        deictic_geographic_target: Option<String>,
        deictic_narration_target: Option<String>,
    }
}

/// Names of the GSL fields of a phase on the page.
const FIELDS: [&str; 5] = [
    "source",
    "target",
    "motion",
    "handShapes",
    "palmOrientations",
];

/// Annotation that a diagnostic is about; `Item` in `web/pages/transcribe/types.ts`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Item {
    /// Track: `words`, `phases.0` and so on.
    pub track: String,
    /// Number in the track, from 0.
    pub index: usize,
}

/// Returns all annotations of a transcription with their places, track after track.
#[must_use]
pub fn items(transcription: &Transcription) -> Vec<(Span, Item)> {
    fn add<T>(out: &mut Vec<(Span, Item)>, track: &str, list: &[T], span: fn(&T) -> Span) {
        out.extend(list.iter().enumerate().map(|(index, item)| {
            let track = track.to_owned();
            (span(item), Item { track, index })
        }));
    }
    let mut out = Vec::new();
    add(&mut out, "words", &transcription.words, |w| w.span);
    add(&mut out, "utterances", &transcription.utterances, |u| {
        u.span
    });
    add(&mut out, "levels", &transcription.levels, |l| l.span);
    add(&mut out, "gestures", &transcription.gestures, |g| g.span);
    add(&mut out, "prosody", &transcription.prosody, |p| p.span);
    add(&mut out, "staging", &transcription.staging, |s| s.span);
    for (number, layer) in transcription.layers.iter().enumerate() {
        add(&mut out, &format!("phases.{number}"), &layer.phases, |p| {
            p.span
        });
        add(
            &mut out,
            &format!("phrases.{number}"),
            &layer.phrases,
            |p| p.span,
        );
    }
    out
}

/// Returns the field that the place of a diagnostic names, if it names one.
#[must_use]
pub fn field_of(span: Span) -> Option<&'static str> {
    let within = span.end.checked_sub(span.start)?;
    FIELDS
        .get(usize::try_from(within).ok()?.checked_sub(1)?)
        .copied()
}

/// Returns true if a place is that of an annotation or of one of its fields.
#[must_use]
pub fn is_at(span: Span, item: Span) -> bool {
    span.start == item.start
}
