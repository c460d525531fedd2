//! Transcriptions as plain data for pages: numbers and texts, with kinds as their words and forms as
//! their GSL. On the way back, texts are parsed again, and each problem knows its annotation.

use raconteur_eml::{Diagnostic, Span};
use serde::{Deserialize, Serialize};

use crate::gestura::{
    Form, Gesture, Interval, Layer, LevelSpan, Meaning, Noted, Phase, Phrase, Transcription,
    Utterance, Vocabulary, Word,
};
use crate::gsl::{self, Feature};
use crate::xml::Text;

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

/// Distance of the places of two annotations, so that a place also names a field.
const STRIDE: u32 = 8;

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

impl From<&Transcription> for PlainTranscription {
    fn from(transcription: &Transcription) -> Self {
        let words = transcription.words.iter().map(|word| PlainWord {
            token: word.token.clone(),
            start: word.interval.start_secs,
            end: word.interval.end_secs,
        });
        let utterances = transcription.utterances.iter().map(|u| PlainUtterance {
            text: u.text.clone(),
            first: *u.words.start(),
            last: *u.words.end(),
        });
        let levels = transcription.levels.iter().map(|span| PlainLevel {
            level: span.level.word().into(),
            first: *span.utterances.start(),
            last: *span.utterances.end(),
        });
        let gestures = transcription.gestures.iter().map(|gesture| PlainGesture {
            class: gesture.class.word().into(),
            confidence: gesture.confidence,
            animation: gesture.animation.clone(),
            start: gesture.interval.start_secs,
            end: gesture.interval.end_secs,
        });
        let layers = transcription.layers.iter().map(|layer| PlainLayer {
            name: layer.name.clone(),
            phases: layer.phases.iter().map(PlainPhase::from).collect(),
            phrases: layer.phrases.iter().map(PlainPhrase::from).collect(),
        });
        Self {
            media: transcription.media.clone(),
            coder: transcription.coder.clone(),
            words: words.collect(),
            utterances: utterances.collect(),
            levels: levels.collect(),
            gestures: gestures.collect(),
            layers: layers.collect(),
        }
    }
}

impl From<&Phase> for PlainPhase {
    fn from(phase: &Phase) -> Self {
        fn text<F>(noted: Option<&Noted<F>>) -> Option<String> {
            noted.map(|noted| noted.text.clone())
        }
        let form = &phase.form;
        Self {
            kind: phase.kind.word().into(),
            start: phase.interval.start_secs,
            end: phase.interval.end_secs,
            source: text(form.source.as_ref()),
            target: text(form.target.as_ref()),
            motion: text(form.motion.as_ref()),
            hand_shapes: text(form.hand_shapes.as_ref()),
            palm_orientations: text(form.palm_orientations.as_ref()),
            body_shape: form.body_shape.clone(),
        }
    }
}

impl From<&Phrase> for PlainPhrase {
    fn from(phrase: &Phrase) -> Self {
        fn word<V: Vocabulary>(value: Option<V>) -> Option<String> {
            value.map(|value| value.word().to_owned())
        }
        let meaning = phrase.meaning.clone();
        Self {
            first: *phrase.phases.start(),
            last: *phrase.phases.end(),
            dimension: word(phrase.dimension),
            handedness: word(phrase.handedness),
            symmetry: phrase.symmetry,
            speaker_frame_position: phrase.speaker_frame_position.clone(),
            confidence: phrase.confidence,
            contribution: phrase.contribution.clone(),
            iconic_body: meaning.iconic_body,
            iconic_motion: meaning.iconic_motion,
            iconic_viewpoint: word(meaning.iconic_viewpoint),
            metaphoric_base: meaning.metaphoric_base,
            metaphoric_referent: meaning.metaphoric_referent,
            metaphoric_motion: meaning.metaphoric_motion,
            deictic_geographic_target: meaning.deictic_geographic_target,
            deictic_narration_target: meaning.deictic_narration_target,
        }
    }
}

impl PlainTranscription {
    /// Returns the transcription, and the problems of its forms. Its places do not refer to a file:
    /// [`items`] and [`field_of`] tell what they name.
    ///
    /// # Errors
    /// Returns a message for data that no transcription can have: a word that is not in its list, or
    /// a run of annotations that do not exist.
    pub fn transcription(&self) -> Result<(Transcription, Vec<Diagnostic>), String> {
        let mut reader = Reader::default();
        let words = self.words.iter().map(|word| Word {
            token: word.token.clone(),
            interval: Interval::new(word.start, word.end),
            span: reader.place(),
        });
        let words: Vec<Word> = words.collect();
        let utterances = self.utterances.iter().map(|u| {
            Ok(Utterance {
                text: u.text.clone(),
                words: run(u.first, u.last, words.len())?,
                span: reader.place(),
            })
        });
        let utterances: Vec<Utterance> = utterances.collect::<Result<_, String>>()?;
        let levels = self.levels.iter().map(|level| {
            Ok(LevelSpan {
                level: required(&level.level)?,
                utterances: run(level.first, level.last, utterances.len())?,
                span: reader.place(),
            })
        });
        let levels = levels.collect::<Result<_, String>>()?;
        let gestures = self.gestures.iter().map(|gesture| {
            Ok(Gesture {
                class: required(&gesture.class)?,
                confidence: gesture.confidence,
                animation: filled(gesture.animation.as_ref()),
                interval: Interval::new(gesture.start, gesture.end),
                span: reader.place(),
            })
        });
        let gestures = gestures.collect::<Result<_, String>>()?;
        let layers = self.layers.iter().map(|layer| reader.layer(layer));
        let layers = layers.collect::<Result<_, String>>()?;
        let transcription = Transcription {
            media: self.media.clone(),
            coder: self.coder.clone(),
            words,
            utterances,
            levels,
            gestures,
            layers,
        };
        Ok((transcription, reader.problems))
    }
}

/// Reader of plain data: gives each annotation a place of its own.
#[derive(Default)]
struct Reader {
    places: u32,
    problems: Vec<Diagnostic>,
}

impl Reader {
    fn place(&mut self) -> Span {
        self.places += STRIDE;
        Span::new(self.places, self.places)
    }

    fn layer(&mut self, layer: &PlainLayer) -> Result<Layer, String> {
        let phases = layer.phases.iter().map(|phase| {
            let span = self.place();
            Ok(Phase {
                kind: required(&phase.kind)?,
                interval: Interval::new(phase.start, phase.end),
                form: self.form(phase, span),
                span,
            })
        });
        let phases: Vec<Phase> = phases.collect::<Result<_, String>>()?;
        let phrases = layer.phrases.iter().map(|phrase| {
            let phases = run(phrase.first, phrase.last, phases.len())?;
            phrase_of(phrase, phases, self.place())
        });
        let phrases = phrases.collect::<Result<_, String>>()?;
        Ok(Layer {
            name: layer.name.clone(),
            phases,
            phrases,
        })
    }

    fn form(&mut self, phase: &PlainPhase, span: Span) -> Form {
        Form {
            source: self.noted(phase.source.as_ref(), span, 1),
            target: self.noted(phase.target.as_ref(), span, 2),
            motion: self.noted(phase.motion.as_ref(), span, 3),
            hand_shapes: self.noted(phase.hand_shapes.as_ref(), span, 4),
            palm_orientations: self.noted(phase.palm_orientations.as_ref(), span, 5),
            body_shape: filled(phase.body_shape.as_ref()),
        }
    }

    /// Parses a field; a problem relates to the range of its text that is wrong.
    fn noted<F: Feature>(
        &mut self,
        text: Option<&String>,
        span: Span,
        field: u32,
    ) -> Option<Noted<F>> {
        let text = text?;
        let mut problems = Vec::new();
        let noted = Noted::read(&Text::from(text.clone()), &mut problems);
        let is_wrong = noted.as_ref().is_some_and(|noted| noted.value.is_none());
        let error = (is_wrong && gsl::is_formal(text)).then(|| gsl::parse::<F>(text).err());
        for mut problem in problems {
            problem.span = Span::new(span.start, span.start + field);
            if let Some(Some(error)) = &error {
                let offset = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
                let range = Span::new(offset(error.start), offset(error.end));
                problem = problem.related(range, "in the field");
            }
            self.problems.push(problem);
        }
        noted
    }
}

fn phrase_of(
    phrase: &PlainPhrase,
    phases: std::ops::RangeInclusive<usize>,
    span: Span,
) -> Result<Phrase, String> {
    Ok(Phrase {
        phases,
        dimension: optional(phrase.dimension.as_ref())?,
        handedness: optional(phrase.handedness.as_ref())?,
        symmetry: phrase.symmetry,
        speaker_frame_position: filled(phrase.speaker_frame_position.as_ref()),
        confidence: phrase.confidence,
        contribution: filled(phrase.contribution.as_ref()),
        meaning: Meaning {
            iconic_body: filled(phrase.iconic_body.as_ref()),
            iconic_motion: filled(phrase.iconic_motion.as_ref()),
            iconic_viewpoint: optional(phrase.iconic_viewpoint.as_ref())?,
            metaphoric_base: filled(phrase.metaphoric_base.as_ref()),
            metaphoric_referent: filled(phrase.metaphoric_referent.as_ref()),
            metaphoric_motion: filled(phrase.metaphoric_motion.as_ref()),
            deictic_geographic_target: filled(phrase.deictic_geographic_target.as_ref()),
            deictic_narration_target: filled(phrase.deictic_narration_target.as_ref()),
        },
        span,
    })
}

/// Returns a text; `None` if it is empty.
fn filled(text: Option<&String>) -> Option<String> {
    text.filter(|text| !text.is_empty()).cloned()
}

fn required<V: Vocabulary>(word: &str) -> Result<V, String> {
    V::from_word(word).ok_or_else(|| format!("`{word}` is not one of {}", V::list()))
}

fn optional<V: Vocabulary>(word: Option<&String>) -> Result<Option<V>, String> {
    filled(word).map(|word| required(&word)).transpose()
}

fn run(first: usize, last: usize, count: usize) -> Result<std::ops::RangeInclusive<usize>, String> {
    if first <= last && last < count {
        Ok(first..=last)
    } else {
        Err(format!("{first} to {last} is not a run of {count}"))
    }
}
