//! Changes that separate attributes. In a population, attributes correlate: a person with broad
//! wings of the nose has a broad nose, and the change of equation 3.4 brings both. A user who moves
//! one slider wants one change; the selected change is therefore the likeliest one that adds one of
//! its attribute and little of the others. It is equation 3.7 with the others constrained softly,
//! as equation 3.6 constrains them hard.

use super::Attribute;
use crate::space::FaceSpace;

/// Cost of one standard deviation of another attribute, relative to one of the face itself (1).
const COST: f64 = 2.0;
/// The equations count as solved when so much of their right side is left, as a share of its square.
const SOLVED: f64 = 1e-20;

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn add(to: &mut [f64], what: &[f64], times: f64) {
    for (to, what) in to.iter_mut().zip(what) {
        *to += times * what;
    }
}

/// Sets the changes of attributes of a space apart.
pub(crate) fn set_apart(space: &FaceSpace, mut attributes: Vec<&mut Attribute>) {
    let deviations = space.deviations();
    let direction = |attribute: &&mut Attribute| -> Vec<f64> {
        let pairs = attribute.direction.iter().zip(deviations);
        let all: Vec<f64> = pairs.map(|(along, d)| along / d).collect();
        let size = dot(&all, &all).sqrt();
        all.into_iter().map(|x| x / size).collect()
    };
    let directions: Vec<Vec<f64>> = attributes.iter().map(direction).collect();
    // Its own attribute is among the constrained ones; that changes only the length of the
    // solution.
    let product = |x: &[f64]| {
        let mut sum = x.to_vec();
        for held in &directions {
            add(&mut sum, held, COST * dot(held, x));
        }
        sum
    };
    for (attribute, own) in attributes.iter_mut().zip(&directions) {
        let pairs = solve(product, own).into_iter().zip(deviations);
        let change: Vec<f64> = pairs.map(|(x, d)| x * d).collect();
        let value = attribute.value(space, &change);
        attribute.change = change.into_iter().map(|x| x / value).collect();
    }
}

/// Solves a symmetric positive definite system by conjugate gradients.
fn solve(product: impl Fn(&[f64]) -> Vec<f64>, right: &[f64]) -> Vec<f64> {
    let mut solution = vec![0.0; right.len()];
    let mut rest = right.to_vec();
    let mut way = rest.clone();
    let mut square = dot(&rest, &rest);
    let enough = SOLVED * square;
    for _ in 0..2 * right.len() {
        if square <= enough {
            break;
        }
        let image = product(&way);
        let length = square / dot(&way, &image);
        add(&mut solution, &way, length);
        add(&mut rest, &image, -length);
        let before = core::mem::replace(&mut square, dot(&rest, &rest));
        for (way, rest) in way.iter_mut().zip(&rest) {
            *way = rest + square / before * *way;
        }
    }
    solution
}
