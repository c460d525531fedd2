//! Measurements of the performing figure.

use std::sync::Arc;

use raconteur_actor::FaceRig;
use raconteur_actor::limb::Build;
use raconteur_base::Side;
use raconteur_body::Figure;
use raconteur_eml::{Diagnostic, Document};

use crate::lower::gestures::Hands;
use crate::lower::reach::{self, Reach};
use crate::lower::units::Units;
use crate::lower::{manipulators, parameters};

/// Performing figure with the measures that lowering and evaluation need: face, units, reach, build
/// and hands.
pub(crate) struct Cast {
    pub(crate) figure: Arc<Figure>,
    pub(crate) face: FaceRig,
    pub(crate) units: Units,
    pub(crate) reach: Reach,
    pub(crate) build: Build,
    pub(crate) hands: Hands,
}

impl Cast {
    /// Measures a figure for a story. `handedness` is the dominant hand chosen by the page, if any.
    pub(crate) fn new(figure: Arc<Figure>, document: &Document, handedness: Option<Side>) -> Self {
        let build = Build::from_figure(&figure);
        Self {
            face: FaceRig::new(&figure),
            units: Units::from_skeleton(&figure.skeleton),
            reach: Reach::new(&figure.skeleton, &build),
            build,
            hands: Hands::from_document(document, handedness, figure.dominant_hand),
            figure,
        }
    }

    /// Returns the parts of a document that this figure cannot perform: unreachable targets,
    /// unknown control parameters.
    pub(crate) fn problems(&self, document: &Document) -> Vec<Diagnostic> {
        let far = reach::unreachable(document, &self.units, &self.reach, self.hands);
        far.into_iter()
            .chain(parameters::problems(document))
            .chain(manipulators::problems(document, &self.units, &self.reach))
            .collect()
    }

    /// Returns the number of the figure's morph targets.
    pub(crate) fn morphs(&self) -> usize {
        self.figure.morph_names.len()
    }
}
