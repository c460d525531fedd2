//! Conversion of emotions of face and voice to the expression of the environment (GEVH 3.5.4).

use raconteur_actor::parameters::{ParameterCommand, ParameterScript, ParameterTrack};
use raconteur_actor::{Affect, EmotionSpan, Library};
use raconteur_base::ops;
use raconteur_speech::emotion::{self, EmotionPoint};
use raconteur_spoken::PLAIN_POTENTIAL;
use raconteur_stage::{EmotionEnvelope, EmotionType};

/// Emotion of the face, with the potential (strength) of the events that elicit it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ExpressedEmotion {
    pub(crate) span: EmotionSpan,
    /// Potential, 0 to 10; the span's intensity is the part above the threshold.
    pub(crate) potential: f64,
}

/// Activation that counts as full: the most of F&H table 4.4.
const FULL_ACTIVATION: f64 = 60.0;
/// Sampling interval of emotion parameters, seconds, and the maximum number of samples.
const STEP_SECS: f64 = 0.25;
const MAX_STEPS: f64 = 20_000.0;
/// Smallest value of a control parameter that drives an emotion.
const MIN_LED: f64 = 0.1;

/// Returns the envelope of an emotion for the environment; `None` if it has no such type.
pub(crate) fn of_span(felt: &ExpressedEmotion) -> Option<EmotionEnvelope> {
    let span = &felt.span;
    Some(EmotionEnvelope {
        kind: kind_of(&span.affect)?,
        potential: felt.potential,
        intensity: span.intensity * PLAIN_POTENTIAL,
        activation: span.affect.place.activation / FULL_ACTIVATION,
        start_secs: span.start_secs,
        apex_secs: span.apex_secs,
        until_secs: span.until_secs,
        end_secs: span.end_secs,
    })
}

/// Returns the type of an emotion: that of its word, or of the word in its direction.
fn kind_of(affect: &Affect) -> Option<&'static EmotionType> {
    if let Some(word) = affect.word {
        return EmotionType::named(word);
    }
    let along = |a: EmotionPoint, b: EmotionPoint| {
        let dot = a.activation * b.activation + a.evaluation * b.evaluation + a.power * b.power;
        dot / length(b).max(1e-9)
    };
    let words = emotion::WORDS.iter().filter_map(|(word, _)| {
        let place = emotion::place(word).filter(|place| !place.is_neutral())?;
        Some((EmotionType::named(word)?, along(affect.place, place)))
    });
    // Among several at one point, the first is selected.
    let nearest = words.rev().max_by(|(_, a), (_, b)| a.total_cmp(b));
    nearest.map(|(kind, _)| kind)
}

/// Returns the distance of a place from neutral.
fn length(place: EmotionPoint) -> f64 {
    let level = ops::hypot(place.activation, place.evaluation);
    ops::hypot(level, place.power)
}

/// Returns the emotions driven by control parameters, over a performance of a length in seconds.
pub(crate) fn of_parameters<'c>(
    commands: impl Iterator<Item = &'c (f64, ParameterCommand)>,
    library: &Library,
    end_secs: f64,
) -> Vec<EmotionEnvelope> {
    let script = ParameterScript {
        commands: commands.cloned().collect(),
    };
    if script.commands.is_empty() {
        return Vec::new();
    }
    let find = |name: &str| library.parameters(name);
    let track = ParameterTrack::new(&script, &find);
    let step_secs = STEP_SECS.max(end_secs / MAX_STEPS);
    let mut felt = Vec::new();
    for (word, curve) in track.emotions() {
        let affect = Affect::named(word).unwrap_or_default();
        let Some(kind) = kind_of(&affect) else {
            continue;
        };
        let (mut begun, mut most) = (None, 0.0_f64);
        let mut t = 0.0;
        while t <= end_secs + step_secs {
            let led = if t > end_secs { 0.0 } else { curve.sample(t) };
            if led > MIN_LED {
                begun.get_or_insert(t);
                most = most.max(led);
            } else if let Some(start_secs) = begun.take() {
                let potential = std::mem::take(&mut most) * PLAIN_POTENTIAL;
                felt.push(EmotionEnvelope {
                    kind,
                    potential,
                    intensity: potential,
                    activation: affect.place.activation / FULL_ACTIVATION,
                    start_secs,
                    apex_secs: start_secs + step_secs,
                    until_secs: t - step_secs,
                    end_secs: t,
                });
            }
            t += step_secs;
        }
    }
    felt
}
