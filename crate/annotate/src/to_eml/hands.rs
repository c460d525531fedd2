//! Features of one hand or both: joined, cut and counted.

use raconteur_base::Side;
use raconteur_eml::Handedness;

use crate::gestura::{Form, Hands, Phase, letters};
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

/// Returns true if a value is for a hand that takes part.
pub(super) fn moves<F>(value: &Value<F>, hands: Hands) -> bool {
    let mut sides = Side::BOTH.into_iter().filter(|side| includes(hands, *side));
    sides.any(|side| value.for_hand(side).is_some())
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

/// Returns the hand after which a layer is named.
pub(super) fn of_layer(name: &str) -> Option<Hands> {
    match letters(name).as_str() {
        "right" | "rh" | "righthand" => Some(Hands::Right),
        "left" | "lh" | "lefthand" => Some(Hands::Left),
        _ => None,
    }
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
            .and_then(|value| value.for_hand(side))
            .and_then(|s| s.items.first());
        let last = target
            .and_then(|value| value.for_hand(side))
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

/// Returns the first feature of each hand as a value without times.
pub(super) fn first<F: Feature>(value: &Value<F>) -> Option<Value<F>> {
    map(value, |sequence| Some(alone(sequence.items.first()?)))
}

/// Returns the last feature of each hand as a value without times.
pub(super) fn last<F: Feature>(value: &Value<F>) -> Option<Value<F>> {
    map(value, |sequence| Some(alone(sequence.items.last()?)))
}

fn alone<F: Feature>(item: &Item<F>) -> Sequence<F> {
    Sequence {
        items: vec![Item {
            offset: None,
            feature: item.feature.clone(),
        }],
    }
}

/// Returns a value that leads to another one: a feature alone is reached by half of the phase if
/// the next one differs.
pub(super) fn before<F: Feature>(value: &Value<F>, next: &Value<F>) -> Value<F> {
    let led = |sequence: &Sequence<F>, next: Option<&Sequence<F>>| match (&sequence.items[..], next)
    {
        ([item], Some(next)) if item.offset.is_none() && item.feature != next.items[0].feature => {
            let half = Item {
                offset: Some(Offset::Percent(50.0)),
                feature: item.feature.clone(),
            };
            Sequence { items: vec![half] }
        }
        _ => sequence.clone(),
    };
    match value {
        Value::Common(sequence) => Value::Common(led(sequence, next.for_hand(Side::Right))),
        Value::PerHand { right, left } => Value::PerHand {
            right: right
                .as_ref()
                .map(|right| led(right, next.for_hand(Side::Right))),
            left: left
                .as_ref()
                .map(|left| led(left, next.for_hand(Side::Left))),
        },
    }
}
