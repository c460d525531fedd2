//! Features of one hand or both: joined, cut and counted.

use raconteur_base::Side;
use raconteur_eml::Handedness;

use crate::gestura::{Form, Hands, Phase};
use crate::gsl::{Feature, Item, Offset, Position, Sequence, Value};

/// Returns the hands of EML.
pub(super) fn handedness(hands: Hands) -> Handedness {
    match hands {
        Hands::Right => Handedness::Right,
        Hands::Left => Handedness::Left,
        Hands::Both => Handedness::Both,
    }
}

/// Returns true if a hand takes part.
pub(super) fn includes(hands: Hands, side: Side) -> bool {
    match hands {
        Hands::Right => side == Side::Right,
        Hands::Left => side == Side::Left,
        Hands::Both => true,
    }
}

/// Returns the hands that the forms of phases name; `None` if none does.
pub(super) fn named(phases: &[Phase]) -> Option<Hands> {
    let mut both = phases.iter().filter(|phase| per_hand(&phase.form));
    both.next()?;
    let only = |side: Side| {
        let given = phases.iter().filter(|phase| per_hand(&phase.form));
        given.into_iter().all(|phase| phase.form.moves_only(side))
    };
    Some(if only(Side::Right) {
        Hands::Right
    } else if only(Side::Left) {
        Hands::Left
    } else {
        Hands::Both
    })
}

fn per_hand(form: &Form) -> bool {
    fn is<F>(value: Option<&Value<F>>) -> bool {
        matches!(value, Some(Value::PerHand { .. }))
    }
    let value = |noted: &Option<crate::gestura::Noted<Position>>| {
        is(noted.as_ref().and_then(|noted| noted.value.as_ref()))
    };
    value(&form.motion)
        || value(&form.source)
        || value(&form.target)
        || is(form
            .hand_shapes
            .as_ref()
            .and_then(|noted| noted.value.as_ref()))
        || is(form
            .palm_orientations
            .as_ref()
            .and_then(|noted| noted.value.as_ref()))
}

/// Applies a function to the sequence of each hand. `None` if nothing remains.
pub(super) fn map<F: Feature>(
    value: &Value<F>,
    change: impl Fn(&Sequence<F>) -> Option<Sequence<F>>,
) -> Option<Value<F>> {
    match value {
        Value::Common(sequence) => change(sequence).map(Value::Common),
        Value::PerHand { right, left } => {
            let right = right.as_ref().and_then(&change);
            let left = left.as_ref().and_then(&change);
            (right.is_some() || left.is_some()).then_some(Value::PerHand { right, left })
        }
    }
}

/// Returns a motion from the source to the target of a phase.
pub(super) fn path(
    source: Option<&Value<Position>>,
    target: Option<&Value<Position>>,
) -> Option<Value<Position>> {
    let ends = |side: Side| {
        let first = source
            .and_then(|value| value.of(side))
            .and_then(|s| s.items.first());
        let last = target
            .and_then(|value| value.of(side))
            .and_then(|s| s.items.last());
        let timed = |item: Option<&Item<Position>>, percent: f64| {
            item.map(|item| Item {
                offset: Some(Offset::Percent(percent)),
                feature: item.feature,
            })
        };
        let items: Vec<Item<Position>> = timed(first, 0.0)
            .into_iter()
            .chain(timed(last, 100.0))
            .collect();
        (!items.is_empty()).then_some(Sequence { items })
    };
    let is_common = |value: Option<&Value<Position>>| !matches!(value, Some(Value::PerHand { .. }));
    if is_common(source) && is_common(target) {
        return ends(Side::Right).map(Value::Common);
    }
    let (right, left) = (ends(Side::Right), ends(Side::Left));
    (right.is_some() || left.is_some()).then_some(Value::PerHand { right, left })
}

/// Returns the last feature of each hand as a value without times.
pub(super) fn last<F: Feature>(value: &Value<F>) -> Option<Value<F>> {
    map(value, |sequence| {
        let item = sequence.items.last()?.clone();
        Some(Sequence {
            items: vec![Item {
                offset: None,
                feature: item.feature,
            }],
        })
    })
}
