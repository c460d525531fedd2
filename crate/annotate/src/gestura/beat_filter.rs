//! The beat filter (GEVH C.3.7, after McNeill 1992): tells imagistic gesticulation from beats by
//! form alone.

use super::{Layer, Phase, PhaseKind, Phrase};
use crate::gsl::{Feature, Position, Value};

use super::form::Noted;
use raconteur_base::Side;

/// Half width of the centre of gesture space, skeleton units: about the width of the shoulders.
/// Designed after McNeill 1992, figure 3.1.
const CENTRE_HALF_WIDTH: f64 = 9.0;
/// Height of the centre of gesture space above the pelvis, skeleton units: from the belly to the
/// shoulders. Designed likewise.
const CENTRE_HEIGHT: [f64; 2] = [2.0, 25.0];

/// Score of the beat filter by question; the higher, the more imagery on formal grounds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BeatScore {
    /// 1 if the gesticulation has other than two movement phases.
    pub phases: u32,
    /// Movements of wrist or fingers and tensed stases in phases that do not end at rest.
    pub movements: u32,
    /// 1 if it begins outside the centre of gesture space and a later phase is in it.
    pub centre: u32,
    /// 1 if it has exactly two movement phases in different spaces.
    pub space: u32,
}

impl BeatScore {
    /// Returns the sum; 0 for a gesture that is probably a beat.
    #[must_use]
    pub fn total(self) -> u32 {
        self.phases + self.movements + self.centre + self.space
    }
}

/// Returns the score of a phrase. Phases without a formal position count as executed where the one
/// before was.
#[must_use]
pub fn beat_score(layer: &Layer, phrase: &Phrase) -> BeatScore {
    let phases = layer.phases_of(phrase);
    let moving: Vec<&Phase> = phases
        .iter()
        .filter(|phase| !phase.kind.is_hold())
        .collect();
    let mut spaces: Vec<bool> = Vec::new();
    for phase in &moving {
        let known = space(phase).or(spaces.last().copied());
        spaces.extend(known);
    }
    let is_pair = moving.len() == 2;
    let returns = spaces.first() == Some(&false) && spaces.iter().skip(1).any(|&centre| centre);
    BeatScore {
        phases: u32::from(!is_pair),
        movements: phases.iter().map(movements).sum(),
        centre: u32::from(returns),
        space: u32::from(is_pair && spaces.len() == 2 && spaces[0] != spaces[1]),
    }
}

/// Counts movements of wrist and fingers and tensed stases in a phase that does not end at rest.
fn movements(phase: &Phase) -> u32 {
    if phase.kind == PhaseKind::Retraction {
        return 0;
    }
    let form = &phase.form;
    u32::from(changes(form.hand_shapes.as_ref()))
        + u32::from(changes(form.palm_orientations.as_ref()))
        + u32::from(phase.kind.is_hold())
}

fn changes<F: Feature>(noted: Option<&Noted<F>>) -> bool {
    let value = noted.and_then(|noted| noted.value.as_ref());
    value.is_some_and(|value| {
        let sequences = Side::BOTH
            .into_iter()
            .filter_map(|side| value.for_hand(side));
        sequences
            .into_iter()
            .any(|s| s.items.iter().any(|i| i.feature != s.items[0].feature))
    })
}

/// Returns true if a phase ends in the centre of gesture space; `None` if its place is unknown.
fn space(phase: &Phase) -> Option<bool> {
    let form = &phase.form;
    let noted = [&form.motion, &form.target, &form.source];
    let value = noted
        .into_iter()
        .flatten()
        .find_map(|noted| noted.value.as_ref())?;
    let Position([x, y, _]) = last(value)?;
    let [low, high] = CENTRE_HEIGHT;
    Some(x.abs() <= CENTRE_HALF_WIDTH && (low..=high).contains(&y))
}

fn last(value: &Value<Position>) -> Option<Position> {
    let sequence = value.for_hand(Side::Right).or(value.for_hand(Side::Left))?;
    sequence.items.last().map(|item| item.feature)
}
