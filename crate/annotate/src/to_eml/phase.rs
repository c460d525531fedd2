//! One phase as a gesture-key.

use raconteur_eml::{GestureKey, Handedness};

use super::hands;
use crate::gestura::{Form, Noted, Phase, PhaseKind};
use crate::gsl::{Feature, Position, Sequence, Value, tracks};
use crate::script::rounded;

/// Returns the gesture-key of a phase.
pub(super) fn gesture_key(phase: &Phase, length_secs: f64, handedness: Handedness) -> GestureKey {
    let form = &phase.form;
    let duration_secs = rounded(length_secs);
    let span = phase.span;
    GestureKey {
        duration_secs,
        handedness,
        phase: Some(eml_phase(phase.kind)),
        pace: None,
        hand_shapes: performed(form.hand_shapes.as_ref(), phase)
            .map(|value| tracks(&value, duration_secs, span))
            .unwrap_or_default()
            .into(),
        palms: performed(form.palm_orientations.as_ref(), phase)
            .map(|value| tracks(&value, duration_secs, span))
            .unwrap_or_default()
            .into(),
        motions: motion(form)
            .and_then(|value| inner(&value, phase))
            .map(|value| tracks(&value, duration_secs, span))
            .unwrap_or_default()
            .into(),
    }
}

fn eml_phase(kind: PhaseKind) -> raconteur_eml::Phase {
    use raconteur_eml::Phase as Eml;
    match kind {
        PhaseKind::Preparation => Eml::Preparation,
        PhaseKind::PreStrokeHold => Eml::PreStroke,
        PhaseKind::Stroke => Eml::Stroke,
        PhaseKind::PostStrokeHold => Eml::PostStroke,
        PhaseKind::PartialRetraction => Eml::PartialRetraction,
        PhaseKind::Retraction => Eml::Retraction,
    }
}

/// Returns the formal motion of a phase, else one from its source to its target.
pub(super) fn motion(form: &Form) -> Option<Value<Position>> {
    if let Some(value) = formal(form.motion.as_ref()) {
        return Some(value.clone());
    }
    hands::path(formal(form.source.as_ref()), formal(form.target.as_ref()))
}

/// Returns the value of a feature; `None` if it is absent or informal.
pub(super) fn formal<F>(noted: Option<&Noted<F>>) -> Option<&Value<F>> {
    noted.and_then(|noted| noted.value.as_ref())
}

fn performed<F: Feature>(noted: Option<&Noted<F>>, phase: &Phase) -> Option<Value<F>> {
    inner(formal(noted)?, phase)
}

/// Returns a value without what belongs to the rest of the source: the first item of a preparation
/// at its start, and the last one of a retraction at its end.
fn inner<F: Feature>(value: &Value<F>, phase: &Phase) -> Option<Value<F>> {
    let length_secs = phase.interval.length_secs();
    match phase.kind {
        PhaseKind::Preparation => hands::map(value, |sequence| {
            timed(sequence, length_secs, |time, count| {
                count == 1 || time > 0.0
            })
        }),
        PhaseKind::Retraction => hands::map(value, |sequence| {
            timed(sequence, length_secs, |time, count| {
                count > 1 && time > 0.0 && time < length_secs
            })
        }),
        _ => Some(value.clone()),
    }
}

/// Returns the items of a sequence whose time, seconds, is kept, with explicit times unless it is
/// alone. The predicate also receives the number of items.
fn timed<F: Feature>(
    sequence: &Sequence<F>,
    length_secs: f64,
    keep: impl Fn(f64, usize) -> bool,
) -> Option<Sequence<F>> {
    let count = sequence.items.len();
    let times = sequence.offsets_secs(length_secs);
    let mut items = Vec::new();
    for (item, time) in sequence.items.iter().zip(times) {
        if keep(time, count) {
            let mut item = item.clone();
            if count > 1 {
                item.offset = Some(crate::gsl::Offset::Secs(time));
            }
            items.push(item);
        }
    }
    (!items.is_empty()).then_some(Sequence { items })
}
