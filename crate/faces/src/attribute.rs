//! Facial attributes (F&H 3.2.2): directions of face space along which one property of a face
//! changes and all others change as little as the examples permit.

mod apart;

use crate::error::FaceError;
use crate::space::FaceSpace;

/// Facial attribute (F&H 3.2.2): a direction in the face space along which one property of shape or
/// texture changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// Name of the attribute, for example `narrow–wide mouth`.
    pub name: String,
    /// Δs of equation 3.4 in the coefficients of its space.
    direction: Vec<f64>,
    /// The coefficients that change the value by 1.
    change: Vec<f64>,
}

impl Attribute {
    /// Computes the attribute from labelled examples, after equation 3.4. Labels are relative to
    /// their mean; their scale is that of the attribute's values.
    ///
    /// # Errors
    /// Returns an error if labels are missing or do not define a direction.
    pub fn learn(
        name: &str,
        space: &FaceSpace,
        examples: &[Vec<f64>],
        labels: &[f64],
    ) -> Result<Self, FaceError> {
        let name = name.to_owned();
        if labels.len() != examples.len() {
            return Err(FaceError::Labels {
                name,
                found: labels.len(),
                expected: examples.len(),
            });
        }
        let count = labels.len() as f64;
        let mean = labels.iter().sum::<f64>() / count;
        let mut direction = vec![0.0; space.dimensions()];
        for (face, label) in examples.iter().zip(labels) {
            let weight = (label - mean) / count;
            for (sum, c) in direction.iter_mut().zip(face) {
                *sum += weight * c;
            }
        }
        Self::along(name, space, direction)
    }

    /// Creates an attribute from a known direction in face-space coefficients.
    ///
    /// # Errors
    /// Returns an error if the direction is not usable: the resulting change is not finite.
    pub fn along(name: String, space: &FaceSpace, direction: Vec<f64>) -> Result<Self, FaceError> {
        let mut attribute = Self {
            name,
            change: Vec::new(),
            direction,
        };
        // N/‖w‖² if all modes are present; if some were omitted, their share is restored.
        attribute.change = attribute.with_all(space);
        if attribute.change.iter().all(|c| c.is_finite()) {
            Ok(attribute)
        } else {
            Err(FaceError::NoDirection {
                name: attribute.name,
            })
        }
    }

    /// Returns the direction of the attribute, in face-space coefficients.
    #[must_use]
    pub fn direction(&self) -> &[f64] {
        &self.direction
    }

    /// Returns the attribute value of a face from its coefficients (F&H equation 3.5): 0 for the
    /// average face.
    #[must_use]
    pub fn value(&self, space: &FaceSpace, coefficients: &[f64]) -> f64 {
        space.product(coefficients, &self.direction)
    }

    /// Returns the change of the value per unit of each number of a face.
    #[cfg(feature = "learn")]
    pub(crate) fn gradient(&self, space: &FaceSpace) -> Vec<f64> {
        let pairs = self.direction.iter().zip(space.deviations());
        let shares: Vec<f64> = pairs.map(|(along, d)| along / (d * d)).collect();
        space.difference(&shares)
    }

    /// Returns an attribute that is measured by indexed numbers of a face: the direction in face
    /// space that correlates with the measure.
    ///
    /// # Errors
    /// Returns an error if the measure does not vary in the space.
    pub fn measured(
        name: &str,
        space: &FaceSpace,
        gradient: &[(u32, f64)],
    ) -> Result<Self, FaceError> {
        let along = |(mode, d): (usize, &f64)| {
            let numbers = space.mode(mode);
            let parts = gradient
                .iter()
                .map(|&(i, g)| g * numbers.get(i as usize).unwrap_or(&0.0));
            d * d * parts.sum::<f64>()
        };
        let direction = space.deviations().iter().enumerate().map(along).collect();
        Self::along(name.to_owned(), space, direction)
    }

    /// Changes a face's coefficients so that its attribute value increases by `more`.
    pub fn add(&self, coefficients: &mut [f64], more: f64) {
        for (c, by) in coefficients.iter_mut().zip(&self.change) {
            *c += more * by;
        }
    }

    /// Returns the coefficients that change the value by 1 in the most likely way among the
    /// examples (equation 3.7): traits that correlate with the attribute in people change with it.
    #[must_use]
    pub fn with_all(&self, space: &FaceSpace) -> Vec<f64> {
        let step = 1.0 / space.product(&self.direction, &self.direction);
        self.direction.iter().map(|along| step * along).collect()
    }

    /// Returns the direction that changes the value by the same amount with the smallest change of
    /// the coefficient vector; a baseline for comparison with equation 3.7.
    #[must_use]
    pub fn steepest(&self, space: &FaceSpace) -> Vec<f64> {
        let deviations = space.deviations();
        let gradient: Vec<f64> = self
            .direction
            .iter()
            .zip(deviations)
            .map(|(along, d)| along / (d * d))
            .collect();
        let square: f64 = gradient.iter().map(|g| g * g).sum();
        gradient.into_iter().map(|g| g / square).collect()
    }
}

pub(crate) use apart::set_apart;

#[cfg(test)]
mod tests {
    use raconteur_base::noise;

    use super::*;
    use crate::sample::{examples, labelled};

    #[test]
    fn one_step_changes_the_value_by_one() {
        for seed in 0..20 {
            let faces = examples(60, 45, seed);
            let whole = FaceSpace::learn(&faces).expect("corresponding");
            for modes in [whole.dimensions(), 7, 1] {
                let space = whole.truncated(modes);
                let (own, labels) = labelled(&space, &faces, seed);
                let attribute = Attribute::learn("a", &space, &own, &labels).expect("a direction");
                let mut face = own[0].clone();
                let before = attribute.value(&space, &face);
                attribute.add(&mut face, 1.0);
                assert!(
                    (attribute.value(&space, &face) - before - 1.0).abs() < 1e-9,
                    "one step changes the attribute by 1"
                );
            }
        }
    }

    #[test]
    fn the_step_is_that_of_the_thesis_where_all_modes_are_there() {
        let faces = examples(30, 120, 4);
        let space = FaceSpace::learn(&faces).expect("corresponding");
        let (own, labels) = labelled(&space, &faces, 9);
        let attribute = Attribute::learn("a", &space, &own, &labels).expect("a direction");
        let mean = labels.iter().sum::<f64>() / 30.0;
        let square: f64 = labels.iter().map(|w| (w - mean) * (w - mean)).sum();
        let step = 30.0 / square;
        for (by, along) in attribute.change.iter().zip(attribute.direction()) {
            assert!(
                (by - step * along).abs() < 1e-9,
                "the step equals that of the thesis"
            );
        }
    }

    #[test]
    fn labels_are_told_again_by_the_values() {
        let faces = examples(200, 30, 6);
        let space = FaceSpace::learn(&faces).expect("corresponding");
        let own: Vec<Vec<f64>> = faces
            .iter()
            .map(|f| space.coefficients(f).unwrap())
            .collect();
        // A label that the faces do have: the first number of each.
        let labels: Vec<f64> = faces.iter().map(|f| f[0]).collect();
        let attribute = Attribute::learn("a", &space, &own, &labels).expect("a direction");
        let mean = labels.iter().sum::<f64>() / 200.0;
        for (face, label) in own.iter().zip(&labels) {
            assert!(
                (attribute.value(&space, face) - (label - mean)).abs() < 1e-9,
                "the attribute of a face is its label minus the mean"
            );
        }
    }

    /// Share of the difference between two faces that remains after both were set to the same
    /// value: the steepest direction in plain distance gives all faces the same small detail
    /// instead.
    #[test]
    fn the_way_by_deviations_stays_among_likely_faces() {
        let faces = examples(80, 45, 8);
        let space = FaceSpace::learn(&faces).expect("corresponding");
        let (own, labels) = labelled(&space, &faces, 3);
        let attribute = Attribute::learn("a", &space, &own, &labels).expect("a direction");
        let likely = |c: &[f64]| space.product(c, c);
        let mut face = own[5].clone();
        attribute.add(&mut face, 1.0);
        let mut other = own[5].clone();
        for (c, along) in other.iter_mut().zip(attribute.steepest(&space)) {
            *c += along;
        }
        let value = |c: &[f64]| attribute.value(&space, c);
        assert!(
            (value(&other) - value(&face)).abs() < 1e-9,
            "both faces have the same attribute value"
        );
        let change = |to: &[f64]| {
            let change: Vec<f64> = to.iter().zip(&own[5]).map(|(a, b)| a - b).collect();
            likely(&change)
        };
        assert!(
            change(&face) < change(&other),
            "the change by deviations is more likely"
        );
    }

    #[test]
    fn labels_without_a_meaning_are_refused() {
        let faces = examples(9, 30, 1);
        let space = FaceSpace::learn(&faces).expect("corresponding");
        let (own, _) = labelled(&space, &faces, 1);
        let same = Attribute::learn("a", &space, &own, &[0.3; 9]);
        assert!(
            matches!(same, Err(FaceError::NoDirection { .. })),
            "{same:?}"
        );
        let few = Attribute::learn("a", &space, &own, &[noise::signed(1, 1, 1); 3]);
        assert!(
            matches!(
                few,
                Err(FaceError::Labels {
                    found: 3,
                    expected: 9,
                    ..
                })
            ),
            "{few:?}"
        );
    }
}
