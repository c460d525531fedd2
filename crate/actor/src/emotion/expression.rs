//! Expression: the value of each muscle and each direct parameter, with the antagonists (F&H table
//! 4.6).

use raconteur_body::face::{ANTAGONISTS, FaceControls, Muscle as M};

use super::basic::BasicEmotion;
use super::look::BaseExpression;
use crate::parameters::{FACE_CONTROLS, FaceControl};

/// Returns true if a control is of a muscle that has antagonists.
#[must_use]
pub fn has_antagonist(dial: FaceControl) -> bool {
    let muscles = ANTAGONISTS.iter().flat_map(|(a, b)| a.iter().chain(*b));
    muscles
        .into_iter()
        .any(|m| FaceControl::from_muscle(*m) == dial)
}

/// Facial expression: the value of each face control, −1 to 1; muscles 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expression {
    /// Control values in the order of [`FaceControl::index`].
    pub values: [f64; FACE_CONTROLS],
}

impl Default for Expression {
    fn default() -> Self {
        Self {
            values: [0.0; FACE_CONTROLS],
        }
    }
}

/// Limit up to which a value is unchanged; the rest of the range compresses all larger requests on
/// the way to 1. It equals the greatest value of any of the six basic expressions at its place, so
/// none of them is changed there.
const ROOM_FROM: f64 = 0.95;

/// Compresses a value of any size into −1 to 1. The result always grows with the request, and
/// equals it up to [`ROOM_FROM`].
#[must_use]
pub(super) fn compress(value: f64) -> f64 {
    let over = value.abs() - ROOM_FROM;
    if over <= 0.0 {
        return value;
    }
    let room = 1.0 - ROOM_FROM;
    (ROOM_FROM + room * over / (room + over)).copysign(value)
}

impl Expression {
    /// Returns the expression of a basic emotion at its place.
    #[must_use]
    pub fn from_basic(basic: BasicEmotion) -> Self {
        let mut expression = Self::default();
        expression.gather(BaseExpression::Basic(basic), 1.0, 1.0);
        expression
    }

    /// Adds a base expression, with separate factors for free muscles and for those with
    /// antagonists.
    pub(super) fn gather(&mut self, look: BaseExpression, free: f64, bound: f64) {
        look.for_each_control(&mut |dial, percent| {
            let factor = if has_antagonist(dial) { bound } else { free };
            self.values[dial.index()] += factor * f64::from(percent) * 0.01;
        });
    }

    /// Converts sums of muscles with antagonists to contractions: of two opposing sets the stronger
    /// keeps its excess, distributed by the contributions of its muscles (F&H equation 4.10).
    pub(super) fn settle(&mut self) {
        for (one, other) in ANTAGONISTS {
            let sum = |set: &[M]| set.iter().map(|m| self.values[m.index()]).sum::<f64>();
            let (plus, minus) = (sum(one), sum(other));
            for (set, own, against) in [(one, plus, minus), (other, minus, plus)] {
                let left = if own > against {
                    (own - against) / own
                } else {
                    0.0
                };
                set.iter().for_each(|m| self.values[m.index()] *= left);
            }
        }
    }

    /// Limits every value to its range independently: the stronger an emotion, the stronger all of
    /// its components.
    pub(super) fn limit(&mut self) {
        self.values.iter_mut().for_each(|v| *v = compress(*v));
    }

    /// Returns the value of one face control, −1 to 1.
    #[must_use]
    pub fn value(&self, dial: FaceControl) -> f64 {
        self.values[dial.index()]
    }

    /// Adds the expression to the controls of a face.
    pub fn add(&self, controls: &mut FaceControls) {
        for (i, value) in self.values.iter().enumerate() {
            if *value != 0.0
                && let Some(dial) = FaceControl::from_index(i)
            {
                dial.add(*value, controls);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn basic_expressions_are_symmetric_in_range_and_at_peace_with_themselves() {
        for basic in BasicEmotion::ALL {
            let face = Expression::from_basic(basic);
            for m in M::all() {
                let value = face.values[m.index()];
                assert!((0.0..=1.0).contains(&value), "{basic:?} {m:?}");
                assert_eq!(value, face.values[m.mirrored().index()], "{basic:?} {m:?}");
            }
            let mut settled = face;
            settled.settle();
            settled.limit();
            assert_eq!(settled, face, "{basic:?}");
            // Another module controls the eyes.
            for i in 0..FACE_CONTROLS {
                let dial = FaceControl::from_index(i).expect("a dial");
                assert!(
                    !dial.name().starts_with("Gaze") || face.value(dial) == 0.0,
                    "basic expressions leave the gaze at rest"
                );
            }
        }
    }

    #[test]
    fn every_look_is_in_range_and_at_peace_with_itself() {
        for look in BaseExpression::ALL {
            let mut face = Expression::default();
            face.gather(look, 1.0, 1.0);
            assert_eq!(BaseExpression::ALL[look.index()], look);
            for (i, value) in face.values.iter().enumerate() {
                let least = if FaceControl::from_index(i).is_some_and(FaceControl::is_signed) {
                    -1.0
                } else {
                    0.0
                };
                assert!((least..=1.0).contains(value), "{look:?} {i}");
            }
            let mut settled = face;
            settled.settle();
            let lost = face.values.iter().zip(&settled.values);
            let lost = lost.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
            assert!(lost < 1e-12, "{look:?} pulls against itself");
        }
    }

    #[test]
    fn values_grow_with_what_is_asked_for_and_never_leave_their_range() {
        let mut before = 0.0;
        for i in 1..4000 {
            let asked = f64::from(i) * 0.001;
            let value = compress(asked);
            assert!(value > before && value < 1.0, "{asked}");
            assert!(value - before < 1.001e-3, "{asked}");
            assert_eq!(compress(-asked), -value);
            assert!(
                asked > 0.95 || value == asked,
                "a requested value within range is kept"
            );
            before = value;
        }
    }

    #[test]
    fn the_stronger_of_two_keeps_what_it_has_more() {
        let mut face = Expression::default();
        let set = |face: &mut Expression, m: M, v: f64| face.values[m.index()] = v;
        set(&mut face, M::OrbicularisOrisUpper, 0.6);
        set(&mut face, M::OrbicularisOrisLower, 0.2);
        set(&mut face, M::RisoriusLeft, 0.3);
        set(&mut face, M::RisoriusRight, 0.1);
        face.settle();
        // The sums are 0.8 and 0.4: half of the first remains, nothing of the second.
        assert!(
            (face.values[M::OrbicularisOrisUpper.index()] - 0.3).abs() < 1e-12,
            "the upper half of the ring keeps half of its value"
        );
        assert!(
            (face.values[M::OrbicularisOrisLower.index()] - 0.1).abs() < 1e-12,
            "the lower half of the ring keeps half of its value"
        );
        assert_eq!(face.values[M::RisoriusLeft.index()], 0.0);
    }
}
