//! Attributes that keep their value while others change (F&H 3.2.3).

use crate::attribute::Attribute;
use crate::error::FaceError;
use crate::space::FaceSpace;

/// Values of attributes that every face is brought back to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Constraints {
    held: Vec<(Attribute, f64)>,
}

/// Two attributes whose directions differ by less, as a share of their length squared, are one.
const SAME: f64 = 1e-9;
/// Values that differ by less are the same.
const MEETS: f64 = 1e-6;

impl Constraints {
    /// Holds an attribute at a value; one that is held already gets the new value.
    pub fn hold(&mut self, attribute: &Attribute, value: f64) {
        match self
            .held
            .iter_mut()
            .find(|(held, _)| held.name == attribute.name)
        {
            Some((_, held)) => *held = value,
            None => self.held.push((attribute.clone(), value)),
        }
    }

    /// Lets an attribute go; whether it was held.
    pub fn release(&mut self, name: &str) -> bool {
        let before = self.held.len();
        self.held.retain(|(held, _)| held.name != name);
        self.held.len() < before
    }

    /// Names and values, in the order in which they were set.
    pub fn iter(&self) -> impl Iterator<Item = (&str, f64)> {
        self.held
            .iter()
            .map(|(held, value)| (held.name.as_str(), *value))
    }

    /// Brings a face to the values by multiples of the attributes' own directions (equation 3.6):
    /// the least change in standard deviations.
    ///
    /// The equations for the multiples are solved by making the directions orthogonal one after
    /// another, which finds out which of them says nothing new.
    ///
    /// # Errors
    /// When no face meets them all; the face is as it was then. The first that contradicts those
    /// before it is named.
    pub fn apply(&self, space: &FaceSpace, coefficients: &mut [f64]) -> Result<(), FaceError> {
        let mut face = coefficients.to_vec();
        // Directions that keep all values before them, and the square of each.
        let mut free: Vec<(Vec<f64>, f64)> = Vec::new();
        for (attribute, value) in &self.held {
            let mut along = attribute.direction().to_vec();
            let own = space.product(&along, &along);
            for (before, square) in &free {
                let share = space.product(&along, before) / square;
                for (a, b) in along.iter_mut().zip(before) {
                    *a -= share * b;
                }
            }
            let left = value - attribute.value(space, &face);
            let square = space.product(&along, &along);
            if square <= SAME * own {
                if left.abs() > MEETS {
                    return Err(FaceError::Contradiction {
                        name: attribute.name.clone(),
                        value: *value,
                    });
                }
                continue;
            }
            for (c, a) in face.iter_mut().zip(&along) {
                *c += left / square * a;
            }
            free.push((along, square));
        }
        coefficients.copy_from_slice(&face);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use raconteur_base::noise;

    use super::*;
    use crate::sample::{examples, labelled};

    fn attributes(
        space: &FaceSpace,
        faces: &[Vec<f64>],
        count: u64,
    ) -> (Vec<Vec<f64>>, Vec<Attribute>) {
        let own = labelled(space, faces, 0).0;
        let learned = (0..count).map(|seed| {
            let labels = labelled(space, faces, seed + 1).1;
            Attribute::learn(&format!("attribute {seed}"), space, &own, &labels)
                .expect("a direction")
        });
        let learned = learned.collect();
        (own, learned)
    }

    #[test]
    fn held_values_stay_through_a_hundred_random_edits() {
        let faces = examples(120, 60, 7);
        let space = FaceSpace::learn(&faces).expect("corresponding");
        let (own, attributes) = attributes(&space, &faces, 12);
        let mut constraints = Constraints::default();
        for (attribute, value) in attributes.iter().zip([0.7, -0.4, 0.1, 1.0]) {
            constraints.hold(attribute, value);
        }
        let mut face = own[3].clone();
        for edit in 0..100 {
            let which = (noise::unit(5, 1, edit) * 12.0) as usize % 12;
            attributes[which].add(&mut face, noise::signed(5, 2, edit));
            constraints.apply(&space, &mut face).expect("they agree");
            for ((name, value), attribute) in constraints.iter().zip(&attributes) {
                assert!(
                    (attribute.value(&space, &face) - value).abs() < 1e-9,
                    "{name}"
                );
            }
        }
    }

    #[test]
    fn the_change_is_the_least_in_deviations() {
        let faces = examples(60, 60, 2);
        let space = FaceSpace::learn(&faces).expect("corresponding");
        let (own, attributes) = attributes(&space, &faces, 3);
        let mut constraints = Constraints::default();
        attributes.iter().for_each(|a| constraints.hold(a, 0.5));
        let mut face = own[0].clone();
        constraints.apply(&space, &mut face).expect("they agree");
        let change: Vec<f64> = face.iter().zip(&own[0]).map(|(a, b)| a - b).collect();
        // No other face that meets them is nearer: what is left to choose is orthogonal to it.
        for seed in 0..20 {
            let mut other: Vec<f64> = (0..space.dimensions() as i64)
                .map(|i| noise::signed(seed, 9, i) * 0.1)
                .collect();
            let mut keeps = Constraints::default();
            attributes.iter().for_each(|a| keeps.hold(a, 0.0));
            keeps.apply(&space, &mut other).expect("they agree");
            assert!(space.product(&change, &other).abs() < 1e-9);
        }
    }

    #[test]
    fn contradictions_are_named_and_change_nothing() {
        let faces = examples(40, 30, 3);
        let space = FaceSpace::learn(&faces).expect("corresponding");
        let (own, attributes) = attributes(&space, &faces, 2);
        let twice: Vec<f64> = attributes[0].direction().iter().map(|d| 2.0 * d).collect();
        let double = Attribute::along("double".to_owned(), &space, twice).expect("a direction");
        let mut constraints = Constraints::default();
        constraints.hold(&attributes[0], 0.2);
        constraints.hold(&attributes[1], 0.2);
        constraints.hold(&double, 0.4);
        let mut face = own[0].clone();
        assert_eq!(constraints.apply(&space, &mut face), Ok(()));
        constraints.hold(&double, 0.9);
        let before = face.clone();
        let told = constraints
            .apply(&space, &mut face)
            .expect_err("it cannot be");
        assert!(told.to_string().contains("double at 0.90"), "{told}");
        assert_eq!(face, before);
        assert!(constraints.release("double") && !constraints.release("double"));
        assert_eq!(constraints.apply(&space, &mut face), Ok(()));
    }
}
