//! Form of a phase (GEVH C.3.6): formal in GSL, or noted informally.

use raconteur_base::Side;
use raconteur_eml::Diagnostic;

use crate::gsl::{self, Feature, Palm, Position, Shape, Value};
use crate::xml::Text;

/// Distance from which two places differ, units: tolerance of the places of hands.
pub(crate) const MIN_DISTANCE: f64 = 1.0;

/// Form of a gesticulation phase.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Form {
    /// Position of the wrist at the start.
    pub source: Option<Noted<Position>>,
    /// Position of the wrist at the end.
    pub target: Option<Noted<Position>>,
    /// Course of the wrist.
    pub motion: Option<Noted<Position>>,
    /// Shapes of the hand.
    pub hand_shapes: Option<Noted<Shape>>,
    /// Palm orientations.
    pub palm_orientations: Option<Noted<Palm>>,
    /// The rest of the body, as noted.
    pub body_shape: Option<String>,
}

/// Annotated feature: its text, and its value if it is formal.
#[derive(Clone, Debug, PartialEq)]
pub struct Noted<F> {
    /// Text as annotated.
    pub text: String,
    /// Value of the text; `None` if it is informal or has an error.
    pub value: Option<Value<F>>,
}

impl<F: Feature> Noted<F> {
    /// Reads an annotation. An error in a formal one is reported; an informal one is a note.
    pub fn read(text: &Text, problems: &mut Vec<Diagnostic>) -> Option<Self> {
        if text.value.is_empty() {
            return None;
        }
        let value = if gsl::is_formal(&text.value) {
            gsl::parse(&text.value)
                .map_err(|error| {
                    let span = text.span_within(error.start, error.end);
                    let mut problem = Diagnostic::error(error.code, span, error.message);
                    if !error.hint.is_empty() {
                        problem = problem.hint(error.hint);
                    }
                    problems.push(problem);
                })
                .ok()
        } else {
            let message = format!("this {} is informal and cannot be performed", F::NAME);
            let problem = Diagnostic::warning("gestura::informal", text.span, message);
            problems.push(problem.hint("formal annotations are in GSL (GEVH C.3.6)"));
            None
        };
        Some(Self {
            text: text.value.clone(),
            value,
        })
    }

    /// Creates the annotation of a value.
    #[must_use]
    pub fn formal(value: Value<F>) -> Self {
        Self {
            text: value.to_string(),
            value: Some(value),
        }
    }
}

impl Form {
    /// Returns true if a feature is given for one hand only, the one on a side.
    #[must_use]
    pub fn has_only(&self, side: Side) -> bool {
        let is_only = |moved: [bool; 2]| moved[side.index()] && !moved[side.opposite().index()];
        self.hands().into_iter().any(is_only)
    }

    /// Returns true if only one hand has a form, the one on a side.
    #[must_use]
    pub fn moves_only(&self, side: Side) -> bool {
        let hands = self.hands();
        let any = |side: Side| hands.iter().any(|moved| moved[side.index()]);
        any(side) && !any(side.opposite())
    }

    /// Returns true if the motion leads a hand away from where it begins, by more than a unit.
    #[must_use]
    pub fn travels(&self) -> bool {
        let motion = self.motion.as_ref().and_then(|noted| noted.value.as_ref());
        Side::BOTH.into_iter().any(|side| {
            let items = motion.and_then(|value| value.for_hand(side));
            let items = items.map_or(&[][..], |sequence| &sequence.items);
            let places = items.iter().map(|item| &item.feature);
            items.first().is_some_and(|first| {
                let mut far = places.map(|place| place.distance(&first.feature));
                far.any(|distance| distance > MIN_DISTANCE)
            })
        })
    }

    /// Returns the hands that each feature moves, by [`Side::index`].
    fn hands(&self) -> [[bool; 2]; 5] {
        [
            hands(self.source.as_ref()),
            hands(self.target.as_ref()),
            hands(self.motion.as_ref()),
            hands(self.hand_shapes.as_ref()),
            hands(self.palm_orientations.as_ref()),
        ]
    }
}

/// Returns the hands that a feature moves, by [`Side::index`].
fn hands<F: Feature>(noted: Option<&Noted<F>>) -> [bool; 2] {
    let value = noted.and_then(|noted| noted.value.as_ref());
    let mut moved = [false; 2];
    for side in Side::BOTH {
        moved[side.index()] = value.is_some_and(|value| value.for_hand(side).is_some());
    }
    moved
}
