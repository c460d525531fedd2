//! Transcriptions from plain data.

use std::ops::RangeInclusive;

use raconteur_eml::{Diagnostic, Span};

use super::{PlainLayer, PlainPhase, PlainPhrase, PlainProsody, PlainStaging, PlainTranscription};
use crate::gestura::{
    Form, Gesture, Interval, Layer, LevelSpan, Meaning, Noted, Phase, Phrase, Prosody, Setting,
    Staging, Transcription, Utterance, Vocabulary, Word,
};
use crate::gsl::{self, Feature};
use crate::xml::Text;

/// Distance of the places of two annotations, so that a place also names a field.
const STRIDE: u32 = 8;

impl PlainTranscription {
    /// Returns the transcription, and the problems of its forms. Its places do not refer to a file:
    /// [`super::items`] and [`super::field_of`] tell what they name.
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
        let prosody = reader.prosody(&self.prosody, words.len())?;
        let staging = self.staging.iter().map(|staging| reader.staging(staging));
        let staging = staging.collect();
        let settings = self.settings.iter().map(|setting| Setting {
            element: setting.element.clone(),
            attribute: setting.attribute.clone(),
            value: setting.value.clone(),
        });
        let settings = settings.collect();
        let layers = self.layers.iter().map(|layer| reader.layer(layer));
        let layers = layers.collect::<Result<_, String>>()?;
        let transcription = Transcription {
            media: self.media.clone(),
            coder: self.coder.clone(),
            words,
            utterances,
            levels,
            gestures,
            prosody,
            staging,
            settings,
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

    fn prosody(&mut self, list: &[PlainProsody], words: usize) -> Result<Vec<Prosody>, String> {
        let prosody = list.iter().map(|prosody| {
            Ok(Prosody {
                element: prosody.element.clone(),
                attributes: prosody.attributes.clone(),
                words: run(prosody.first, prosody.last, words)?,
                span: self.place(),
            })
        });
        prosody.collect()
    }

    fn staging(&mut self, staging: &PlainStaging) -> Staging {
        Staging {
            element: staging.element.clone(),
            attributes: staging.attributes.clone(),
            interval: Interval::new(staging.start, staging.end),
            span: self.place(),
        }
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
    phases: RangeInclusive<usize>,
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

fn run(first: usize, last: usize, count: usize) -> Result<RangeInclusive<usize>, String> {
    if first <= last && last < count {
        Ok(first..=last)
    } else {
        Err(format!("{first} to {last} is not a run of {count}"))
    }
}
