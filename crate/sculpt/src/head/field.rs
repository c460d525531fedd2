//! Local fields: soft displacements of a head that move one small feature and nothing else. The
//! body model has no targets for them; they vary independently between faces.

use raconteur_base::Side::{Left, Right};
use raconteur_base::{DVec3, Side, mirror_vector, ops};

use super::binding::{Mark, ModelHeadShape};
use super::cage::Key;

/// Soft deformation: the surroundings of a point follow it with a falloff by distance.
#[derive(Clone, Copy, Debug)]
struct SoftPull {
    /// Point on the left.
    at: Mark,
    /// Standard deviation of the bell, mm.
    radius_mm: f64,
    /// Displacement of the point at amount 1: outwards, up, to the front; mm.
    shift_mm: [f64; 3],
    /// The only side that it is on.
    side: Option<Side>,
}

/// Local field: a soft displacement that moves one small feature of a head; faces vary in its
/// amount.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Name of the field, for example `curve of the brows`.
    pub name: &'static str,
    /// Standard deviation of its amount between faces. Designed: within the range seen on unposed
    /// faces; residual expressions are slight.
    pub deviation: f64,
    pulls: &'static [SoftPull],
}

const fn symmetric(at: Mark, radius_mm: f64, shift_mm: [f64; 3]) -> SoftPull {
    SoftPull {
        at,
        radius_mm,
        shift_mm,
        side: None,
    }
}

const fn one(side: Side, at: Mark, radius_mm: f64, shift_mm: [f64; 3]) -> SoftPull {
    SoftPull {
        at,
        radius_mm,
        shift_mm,
        side: Some(side),
    }
}

const fn grid(column: u8, row: u8) -> Mark {
    Mark::Cage(Key::Grid(column, row))
}

const fn eye(ring: u8, k: u8) -> Mark {
    Mark::Cage(Key::Eye(ring, k))
}

const fn mouth(ring: u8, k: u8) -> Mark {
    Mark::Cage(Key::Mouth(ring, k))
}

const fn ear(ring: u8, k: u8) -> Mark {
    Mark::Cage(Key::Ear(ring, k))
}

const fn brow(k: u8) -> Mark {
    Mark::Brow(k)
}

const fn field(name: &'static str, deviation: f64, pulls: &'static [SoftPull]) -> Field {
    Field {
        name,
        deviation,
        pulls,
    }
}

/// All local fields, in the order of their amounts in parameters.
#[rustfmt::skip]
pub const FIELDS: [Field; 26] = [
    field("curve of the brows", 0.5, &[
        symmetric(brow(3), 7.0, [0.0, 3.0, 0.0]), symmetric(brow(1), 6.0, [0.0, -1.2, 0.0]), symmetric(brow(5), 6.0, [0.0, -1.8, 0.0]),
    ]),
    field("curve of the left brow", 0.25, &[
        one(Left, brow(3), 7.0, [0.0, 3.0, 0.0]), one(Left, brow(1), 6.0, [0.0, -1.2, 0.0]), one(Left, brow(5), 6.0, [0.0, -1.8, 0.0]),
    ]),
    field("curve of the right brow", 0.25, &[
        one(Right, brow(3), 7.0, [0.0, 3.0, 0.0]), one(Right, brow(1), 6.0, [0.0, -1.2, 0.0]), one(Right, brow(5), 6.0, [0.0, -1.8, 0.0]),
    ]),
    field("distance of the brows", 0.5, &[symmetric(brow(0), 8.0, [3.4, 0.6, 0.0]), symmetric(brow(1), 7.0, [2.4, 0.3, 0.0])]),
    field("height of the brows", 0.5, &[
        symmetric(brow(1), 7.0, [0.0, 2.2, 0.0]), symmetric(brow(3), 7.0, [0.0, 2.4, 0.0]), symmetric(brow(5), 7.0, [0.0, 2.2, 0.0]),
    ]),
    field("roundness of the alae", 0.7, &[
        symmetric(grid(4, 12), 3.2, [1.3, -0.2, 1.5]), symmetric(grid(4, 10), 3.0, [-0.9, 0.0, -0.8]), symmetric(grid(4, 14), 3.0, [0.2, -0.4, 0.6]),
    ]),
    field("nasolabial fold", 0.6, &[
        symmetric(grid(5, 14), 3.6, [0.0, 0.0, -1.5]), symmetric(grid(5, 16), 3.6, [0.0, 0.0, -1.7]), symmetric(grid(5, 18), 3.6, [0.0, 0.0, -1.4]),
        symmetric(grid(7, 14), 6.0, [0.3, -0.6, 1.6]), symmetric(grid(7, 17), 6.0, [0.6, -0.8, 1.5]),
    ]),
    field("double chin", 0.5, &[
        symmetric(grid(0, 27), 13.0, [0.0, -6.0, 4.0]), symmetric(grid(6, 27), 11.0, [0.0, -5.0, 3.0]), symmetric(grid(0, 25), 6.0, [0.0, -0.8, -0.6]),
    ]),
    field("fold of the upper lid", 0.5, &[symmetric(eye(2, 4), 4.5, [0.0, -1.4, 0.7]), symmetric(eye(2, 7), 4.5, [0.2, -1.6, 0.6])]),
    field("bag of the lower lid", 0.5, &[symmetric(eye(1, 12), 4.5, [0.0, -0.6, 1.4]), symmetric(grid(6, 8), 4.5, [0.0, 0.0, -0.9])]),
    field("hollow of the cheek", 0.5, &[symmetric(grid(8, 17), 12.0, [-3.2, 0.0, -1.6])]),
    field("cheekbone", 0.5, &[symmetric(grid(9, 9), 10.0, [2.0, 0.4, 1.4])]),
    field("ridge of the brow", 0.5, &[symmetric(grid(3, 4), 8.0, [0.0, 0.0, 1.8]), symmetric(grid(6, 4), 7.0, [0.0, 0.0, 1.6])]),
    field("red of the upper lip", 0.5, &[symmetric(mouth(2, 0), 5.0, [0.0, 0.0, 1.3]), symmetric(mouth(1, 2), 4.0, [0.0, 0.9, 0.3])]),
    field("red of the lower lip", 0.5, &[symmetric(mouth(2, 12), 6.0, [0.0, 0.0, 1.5]), symmetric(mouth(1, 10), 5.0, [0.0, -0.9, 0.4])]),
    field("line of the lips", 0.5, &[symmetric(mouth(1, 6), 7.0, [0.0, 2.6, 0.0]), symmetric(mouth(3, 0), 6.0, [0.0, -0.5, 0.0])]),
    field("cleft of the chin", 0.5, &[symmetric(grid(0, 23), 3.4, [0.0, 0.0, -1.3]), symmetric(grid(3, 23), 4.2, [0.0, 0.0, 0.9])]),
    field("pad of the chin", 0.5, &[symmetric(grid(0, 23), 8.0, [0.0, 0.0, 2.0])]),
    field("lobe of the ear", 0.5, &[symmetric(ear(4, 14), 6.0, [0.5, -2.8, 0.0])]),
    field("temple", 0.5, &[symmetric(grid(9, 3), 12.0, [2.2, 0.0, 0.0])]),
    field("smiling", 0.2, &[
        symmetric(mouth(1, 6), 8.0, [3.6, 4.4, -1.6]), symmetric(grid(7, 11), 13.0, [0.8, 2.4, 2.0]), symmetric(grid(5, 15), 4.5, [1.0, 0.6, -1.0]), symmetric(eye(3, 12), 4.5, [0.0, 0.9, 0.0]),
    ]),
    field("angry", 0.2, &[
        symmetric(brow(0), 8.0, [-2.4, -4.2, 1.0]), symmetric(brow(2), 7.0, [-0.8, -2.2, 0.4]), symmetric(brow(5), 6.0, [0.0, 1.2, 0.0]), symmetric(eye(5, 4), 4.5, [0.0, -0.9, 0.0]),
        symmetric(mouth(1, 0), 7.0, [0.0, -0.9, 0.0]), symmetric(mouth(1, 6), 6.0, [-1.2, -1.6, 0.0]), symmetric(grid(4, 12), 4.0, [1.0, 0.4, 0.0]),
    ]),
    field("surprised", 0.2, &[
        symmetric(brow(1), 8.0, [0.0, 3.2, 0.0]), symmetric(brow(3), 8.0, [0.0, 3.8, 0.0]), symmetric(brow(5), 7.0, [0.0, 2.6, 0.0]), symmetric(eye(5, 4), 5.0, [0.0, 1.5, 0.0]),
        symmetric(mouth(1, 6), 7.0, [-2.0, 0.0, 0.8]), symmetric(grid(0, 23), 14.0, [0.0, -2.0, 0.0]),
    ]),
    field("scared", 0.2, &[
        symmetric(brow(0), 8.0, [-1.8, 4.6, 0.4]), symmetric(brow(2), 7.0, [-0.6, 1.8, 0.0]), symmetric(brow(5), 6.0, [0.0, -1.0, 0.0]), symmetric(eye(5, 4), 5.0, [0.0, 1.3, 0.0]),
        symmetric(mouth(1, 6), 8.0, [3.2, -1.8, -1.2]),
    ]),
    field("deranged", 0.14, &[
        one(Left, brow(2), 9.0, [0.0, 5.0, 0.0]), one(Left, eye(5, 4), 5.0, [0.0, 1.5, 0.0]), one(Left, mouth(1, 6), 8.0, [3.0, 4.0, -1.2]),
        one(Right, brow(1), 8.0, [-1.6, -3.6, 0.6]), one(Right, mouth(1, 6), 8.0, [0.6, -1.8, 0.0]),
    ]),
    field("disgusted", 0.2, &[
        symmetric(mouth(1, 4), 6.0, [0.0, 2.6, 0.6]), symmetric(grid(3, 13), 6.0, [0.8, 2.0, 0.6]), symmetric(grid(5, 14), 4.0, [0.0, 0.6, -1.6]), symmetric(grid(2, 8), 6.0, [0.0, 0.8, 0.8]),
        symmetric(brow(1), 8.0, [-0.8, -3.2, 0.4]), symmetric(eye(3, 12), 4.5, [0.0, 1.0, 0.4]), symmetric(mouth(1, 6), 6.0, [-0.4, -2.2, 0.0]), symmetric(mouth(1, 12), 7.0, [0.0, 0.8, 1.4]),
    ]),
];

/// The fields by which faces are posed.
const EXPRESSIONS: [&str; 6] = [
    "smiling",
    "angry",
    "surprised",
    "scared",
    "deranged",
    "disgusted",
];

/// Indices of the fields by which faces are posed.
pub fn expression_fields() -> impl Iterator<Item = usize> {
    EXPRESSIONS.into_iter().filter_map(field_index)
}

/// Returns the index of the field with a name in [`FIELDS`]; `None` for an unknown name.
#[must_use]
pub fn field_index(name: &str) -> Option<usize> {
    FIELDS.iter().position(|field| field.name == name)
}

impl ModelHeadShape {
    /// Returns the head displaced by the amounts of [`FIELDS`]; missing amounts are zero.
    #[must_use]
    pub fn with_fields(&self, amounts: &[f64]) -> Self {
        let mut bells = Vec::new();
        for (field, amount) in FIELDS.iter().zip(amounts) {
            let pulls = field.pulls.iter().flat_map(|p| self.bells(p, *amount));
            bells.extend(pulls);
        }
        self.moved(|p| bells.iter().map(|b| b.displacement(p)).sum())
    }

    /// Returns the displacements of a pull on this head, one on each of its sides; a pull on the
    /// midline counts once.
    fn bells(&self, pull: &SoftPull, amount: f64) -> Vec<Bell> {
        let shift = DVec3::from_array(pull.shift_mm) * amount;
        let is_middle = self.position_of(pull.at, Right).is_none();
        let sides = Side::BOTH.into_iter().filter(|&side| {
            let wanted = pull.side.is_none_or(|only| only == side);
            wanted && (side == Left || !is_middle)
        });
        let bell = |side| {
            let shift = if side == Left {
                shift
            } else {
                mirror_vector(shift)
            };
            Some(Bell {
                centre: self.position_of(pull.at, side)?,
                radius_mm: pull.radius_mm,
                shift,
            })
        };
        sides.filter_map(bell).collect()
    }
}

/// A pull on one head, mm.
struct Bell {
    centre: DVec3,
    radius_mm: f64,
    shift: DVec3,
}

impl Bell {
    /// Returns the displacement of a position.
    fn displacement(&self, place: DVec3) -> DVec3 {
        let far = (place - self.centre).length_squared() / (self.radius_mm * self.radius_mm);
        if far > 16.0 {
            DVec3::ZERO
        } else {
            self.shift * ops::exp(-0.5 * far)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn amounts(name: &str, amount: f64) -> Vec<f64> {
        let mut all = vec![0.0; FIELDS.len()];
        all[field_index(name).expect("a field")] = amount;
        all
    }

    #[test]
    fn every_field_moves_something_and_only_near_its_places() {
        let mean = ModelHeadShape::default();
        let rest = mean.flat_coordinates_mm();
        for field in &FIELDS {
            let moved = mean
                .with_fields(&amounts(field.name, 1.0))
                .flat_coordinates_mm();
            let step = |i: usize| (moved[i] - rest[i]).abs();
            let most = (0..rest.len()).map(step).fold(0.0, f64::max);
            assert!((0.8..9.0).contains(&most), "{}: {most}", field.name);
            let count = (0..rest.len()).filter(|&i| step(i) > 0.05).count();
            assert!(
                count > 8 && count < rest.len() / 2,
                "{}: {count}",
                field.name
            );
        }
    }

    #[test]
    fn fields_of_both_sides_keep_a_head_symmetric() {
        let mean = ModelHeadShape::default();
        let moved = mean.with_fields(&amounts("smiling", 1.0));
        let [left, right] = Side::BOTH.map(|s| moved.position_of(mouth(1, 6), s).expect("bound"));
        assert!(
            (left - mirror_vector(right)).length() < 0.05,
            "the symmetric field mirrors the head"
        );
        let crooked = mean.with_fields(&amounts("deranged", 1.0));
        let [left, right] = Side::BOTH.map(|s| crooked.position_of(mouth(1, 6), s).expect("bound"));
        assert!(
            left.y - right.y > 4.0,
            "the one-sided field raises one side"
        );
    }
}
