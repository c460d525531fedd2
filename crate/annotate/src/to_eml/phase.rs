//! One phase as a gesture-key.

use raconteur_base::Side;
use raconteur_eml::{GestureKey, Handedness, Track};

use super::hands;
use crate::gestura::{Form, Noted, Phase, PhaseKind};
use crate::gsl::{Feature, InEml, Offset, Position, Sequence, Value, tracks};
use crate::script::rounded;

/// Returns the gesture-key of a phase. Items after its end are performed at its end.
pub(super) fn gesture_key(phase: &Phase, handedness: Handedness) -> GestureKey {
    let form = &phase.form;
    GestureKey {
        duration_secs: rounded(phase.interval.length_secs()),
        handedness,
        phase: Some(eml_phase(phase.kind)),
        pace: None,
        hand_shapes: keyed(formal(form.hand_shapes.as_ref()).cloned(), phase),
        palms: keyed(formal(form.palm_orientations.as_ref()).cloned(), phase),
        motions: keyed(motion(form), phase),
    }
}

/// Returns the tracks of a feature.
fn keyed<F: InEml>(value: Option<Value<F>>, phase: &Phase) -> Box<[Track<F::Key>]> {
    let duration_secs = rounded(phase.interval.length_secs());
    let value = value.and_then(|value| inner(&value, phase));
    let tracks = value.map(|value| tracks(&value, duration_secs, phase.span));
    let mut tracks = tracks.unwrap_or_default();
    for key in tracks.iter_mut().flat_map(|track| &mut track.keys) {
        key.offset_secs = rounded(key.offset_secs).min(duration_secs);
    }
    tracks.into()
}

/// Returns true if an item of the form comes after the end of the phase.
pub(super) fn is_late(phase: &Phase) -> bool {
    fn late<F>(value: Option<&Value<F>>, length_secs: f64) -> bool {
        let sequences = Side::BOTH
            .into_iter()
            .filter_map(|side| value?.for_hand(side));
        let mut times = sequences.flat_map(|sequence| sequence.offsets_secs(length_secs));
        times.any(|time| time > length_secs + LATE_SECS)
    }
    let (form, length_secs) = (&phase.form, phase.interval.length_secs());
    late(formal(form.motion.as_ref()), length_secs)
        || late(formal(form.hand_shapes.as_ref()), length_secs)
        || late(formal(form.palm_orientations.as_ref()), length_secs)
}

/// Time after the end of a phase that counts as its end, seconds.
const LATE_SECS: f64 = 1e-3;

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
                item.offset = Some(Offset::Secs(time));
            }
            items.push(item);
        }
    }
    (!items.is_empty()).then_some(Sequence { items })
}
