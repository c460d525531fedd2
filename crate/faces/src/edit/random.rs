//! Random faces. A mixture of a child and an old man does not exist: if a model records the people
//! of its faces, a random face is a person of one age, sex and ancestry, and differs from the mean
//! of such people as they differ from each other.

use raconteur_base::noise;

use super::{Editor, Face, TEXTURE_STREAM};
use crate::person::PersonRecord;
use crate::space::FaceSpace;

/// Maximum number of retries for a random face. A mixture of faces can be invalid even after
/// correction; then another one is generated.
const TURNS: u64 = 8;
/// Stream constant that separates the seeds of the retries.
const TURN_STREAM: u64 = 0x9e37_79b9_7f4a_7c15;
/// A random face is not farther from the average along a mode, standard deviations.
const MAX_DEVIATIONS: f64 = 3.0;
/// Number of database faces that count as similar to a person.
const ALIKE: usize = 24;
/// Number of similar faces mixed into a random face.
const MIXED: usize = 4;
/// Scales of dissimilarity between people: years, and the share of an ancestry. People of the other
/// sex never count as similar.
const YEARS: f64 = 10.0;
const SHARE: f64 = 0.25;

/// Spread of a random face around the mean of its mixture. The mean is of few faces and correlates
/// with each, so they differ from it by less than from the mean of all.
const SPREAD: f64 = 1.05;

/// Returns the dissimilarity of two people.
fn unlike(a: &PersonRecord, b: &PersonRecord) -> f64 {
    let square = |x: f64| x * x;
    let ancestry: f64 = (0..3)
        .map(|i| square((a.ancestry[i] - b.ancestry[i]) / SHARE))
        .sum();
    // A year counts for more while one grows.
    let years = (a.age_years - b.age_years) / (YEARS * (a.age_years / 30.0).clamp(0.25, 1.0));
    square(years) + ancestry + square((a.sex - b.sex) / 0.2)
}

impl Editor {
    /// Returns a random face, as likely as the examples and without self-intersecting skin; the
    /// same for the same seed.
    #[must_use]
    pub fn random(&self, seed: u64) -> Face {
        let mut face = self.random_at(seed, 0);
        for turn in 1..TURNS {
            if self.is_sound(&face) {
                break;
            }
            face = self.random_at(seed, turn);
        }
        face
    }

    /// Returns true if the displayed face has no self-intersections.
    fn is_sound(&self, face: &Face) -> bool {
        let untangle = self.untangle.as_ref();
        untangle.is_none_or(|untangle| untangle.is_sound(&self.drawn(face)))
    }

    /// Returns the random face of a seed at a given retry.
    fn random_at(&self, seed: u64, turn: u64) -> Face {
        let textures = self.model.texture.as_ref();
        if let Some(mixture) = self.mixture(seed, turn) {
            let mixed = |all: &[Vec<f64>]| mixture.coefficients(all);
            let texture = textures.map_or_else(Vec::new, |t| mixed(&t.examples));
            return self.face(&mixed(&self.model.examples), &texture);
        }
        let seed = seed ^ turn.wrapping_mul(TURN_STREAM);
        let texture = textures.map_or_else(Vec::new, |t| drawn(&t.space, seed ^ TEXTURE_STREAM));
        self.face(&drawn(&self.model.shape, seed), &texture)
    }

    /// Returns the database index of the person most similar to the random face of a seed; `None`
    /// if the model has no records of its people.
    #[must_use]
    pub fn random_person(&self, seed: u64) -> Option<usize> {
        self.mixture(seed, 0).map(|mixture| mixture.person)
    }

    /// Returns the mixture of a random face at a given retry; the person is the same at every
    /// retry.
    fn mixture(&self, seed: u64, turn: u64) -> Option<Mixture> {
        let people = &self.model.people;
        let pick = |turn: u64, k: i64, of: usize| {
            ((noise::unit(seed, 2 * turn, k) * of as f64) as usize).min(of - 1)
        };
        if people.len() <= ALIKE {
            return None;
        }
        let person = pick(0, 0, people.len());
        let own = people.get(person)?;
        let mut alike: Vec<usize> = (0..people.len()).collect();
        alike.sort_by(|&a, &b| unlike(&people[a], own).total_cmp(&unlike(&people[b], own)));
        alike.truncate(ALIKE);
        // Squares that sum to one preserve the variance of such people.
        let mut weights = vec![0.0; ALIKE];
        let mut drawn: Vec<f64> = (1..=MIXED as i64)
            .map(|k| 0.2 + noise::unit(seed, 2 * turn + 1, k))
            .collect();
        let length = drawn.iter().map(|w| w * w).sum::<f64>().sqrt() / SPREAD;
        drawn.iter_mut().for_each(|w| *w /= length);
        for (k, weight) in (1..).zip(drawn) {
            let start = pick(turn, k, ALIKE);
            // A face that was already drawn is replaced.
            let free = (0..ALIKE)
                .map(|i| (start + i) % ALIKE)
                .find(|&i| weights[i] == 0.0);
            weights[free?] = weight;
        }
        Some(Mixture {
            person,
            alike,
            weights,
        })
    }
}

/// Mixture of similar database faces, with the amount of each one's difference from their mean.
struct Mixture {
    person: usize,
    alike: Vec<usize>,
    weights: Vec<f64>,
}

impl Mixture {
    fn coefficients(&self, all: &[Vec<f64>]) -> Vec<f64> {
        let faces: Vec<&Vec<f64>> = self.alike.iter().filter_map(|&i| all.get(i)).collect();
        let length = faces.first().map_or(0, |face| face.len());
        let count = faces.len().max(1) as f64;
        let number = |k: usize| {
            let mean = faces.iter().map(|face| face[k]).sum::<f64>() / count;
            let parts = faces.iter().zip(&self.weights);
            mean + parts
                .map(|(face, weight)| weight * (face[k] - mean))
                .sum::<f64>()
        };
        (0..length).map(number).collect()
    }
}

/// Draws random coefficients from the deviations of a space alone.
fn drawn(space: &FaceSpace, seed: u64) -> Vec<f64> {
    let deviations = (0..).zip(space.deviations());
    let one = |(mode, deviation): (u64, &f64)| {
        // The sum of twelve: a bell of deviation 1.
        let sum: f64 = (0..12).map(|k| noise::unit(seed, mode, k)).sum();
        deviation * (sum - 6.0).clamp(-MAX_DEVIATIONS, MAX_DEVIATIONS)
    };
    deviations.map(one).collect()
}
