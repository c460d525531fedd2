//! Smoothing of the skin over its mesh: where fibres pull across the mesh, its nodes buckle at its
//! own scale, and real skin, which is thicker than that, does not follow.
//!
//! The displacement of a node moves partly to the mean of its neighbours', several times (Taubin
//! 1995, doi:10.1145/218380.218473, without his second step: the displacement shrinks, not the
//! face). The amount depends on the region: zero on lips, lids and nose, which muscle holds on all
//! sides, and between the brows, where skin folds.

use super::Muscle;
use super::lanes::{Vector, vector};
use super::tissue::{FibreCurve, Tissue};

/// Number of smoothing passes; the next constant is the maximum weight of each. A wave over two
/// nodes keeps a ten-millionth (0.2 each time), one over eight nodes a seventh (0.82). Chosen by
/// `folds.rs` of the player's tests.
const PASSES: usize = 10;
const STEP: f32 = 0.6;
/// Distances from a node of the lips, and from an eye's centre across and up, within which nothing
/// is smoothed, and beyond which smoothing is full; millimetres on the reference head.
const FROM_LIPS_MM: [f32; 2] = [2.5, 10.0];
const FROM_EYE_MM: [f32; 2] = [17.0, 26.0];
/// Distances from the midline, between the base of the nose and the eyes, within which nothing is
/// smoothed and beyond which smoothing is full; millimetres on the reference head.
const FROM_NOSE_MM: [f32; 2] = [14.0, 20.0];
/// Distances from the ends of the ear muscles within which nothing is smoothed and beyond which
/// smoothing is full, millimetres on the reference head: the ear's root is stiff.
const FROM_EAR_MM: [f32; 2] = [7.0, 16.0];
/// Distance below the lips at which the throat begins: the jaw's effect on it during opening is
/// smooth, with a sharp bend at the end of the jaw's weight.
const BELOW_LIPS_MM: [f32; 2] = [38.0, 52.0];
/// Height above the eyes at which the nose's region ends, millimetres.
const ABOVE_NOSE_MM: [f32; 2] = [22.0, 34.0];

/// Smoothing of the displacements of a face's skin.
#[derive(Clone, Debug)]
pub(super) struct Smoothing {
    /// Moving nodes, and the weight of each towards the mean of its neighbours.
    steps: Vec<(u16, f32)>,
    /// Start of each one's neighbours in `around`, plus one entry for the end.
    starts: Vec<u32>,
    around: Vec<u16>,
    moved: Vec<Vector>,
    means: Vec<Vector>,
}

/// The muscles of the ear.
const EARS: [Muscle; 6] = [
    Muscle::AuricularisAnteriorLeft,
    Muscle::AuricularisAnteriorRight,
    Muscle::AuricularisSuperiorLeft,
    Muscle::AuricularisSuperiorRight,
    Muscle::AuricularisPosteriorLeft,
    Muscle::AuricularisPosteriorRight,
];

/// Returns a linear ramp: 0 below the first value, 1 above the second.
fn ramp([low, high]: [f32; 2], x: f32) -> f32 {
    ((x - low) / (high - low)).clamp(0.0, 1.0)
}

impl Smoothing {
    pub(super) fn new(tissue: &Tissue) -> Self {
        let mut near = vec![Vec::new(); tissue.rest.len()];
        for q in &tissue.quads {
            for k in 0..4 {
                let (a, b) = (q[k], q[(k + 1) % 4]);
                for (a, b) in [(a, b), (b, a)] {
                    let own = &mut near[usize::from(a)];
                    if a != b && !own.contains(&b) {
                        own.push(b);
                    }
                }
            }
        }
        let (mut steps, mut starts, mut around) = (Vec::new(), vec![0], Vec::new());
        for ((i, own), share) in (0u16..).zip(&near).zip(shares(tissue)) {
            if share > 0.0 && !own.is_empty() {
                steps.push((i, share * STEP));
                around.extend(own);
                starts.push(around.len() as u32);
            }
        }
        Self {
            means: vec![Vector::default(); steps.len()],
            moved: vec![Vector::default(); tissue.rest.len()],
            steps,
            starts,
            around,
        }
    }

    /// Smooths the displacements of positions from rest.
    pub(super) fn apply(&mut self, rest: &[[f32; 3]], places: &mut [Vector]) {
        for ((moved, place), rest) in self.moved.iter_mut().zip(&*places).zip(rest) {
            *moved = *place - vector(*rest);
        }
        for _ in 0..PASSES {
            for (mean, own) in self.means.iter_mut().zip(self.starts.windows(2)) {
                let own = &self.around[own[0] as usize..own[1] as usize];
                let sum = own.iter().fold(Vector::default(), |sum, i| {
                    sum + self.moved[usize::from(*i)]
                });
                *mean = sum * (1.0 / own.len() as f32);
            }
            for ((i, step), mean) in self.steps.iter().zip(&self.means) {
                let moved = &mut self.moved[usize::from(*i)];
                *moved += (*mean - *moved) * *step;
            }
        }
        for (i, _) in &self.steps {
            let i = usize::from(*i);
            places[i] = vector(rest[i]) + self.moved[i];
        }
    }
}

/// Returns the smoothing weight of each node, 0 to 1.
fn shares(tissue: &Tissue) -> Vec<f32> {
    let mm = 1e-3 * tissue.scale;
    let lips = tissue.lips.iter().map(|l| tissue.rest[usize::from(l.node)]);
    let lips: Vec<[f32; 3]> = lips.collect();
    let eyes = tissue.fibres.iter().filter_map(|f| match f.course {
        FibreCurve::Towards(centre) => Some(centre),
        _ => None,
    });
    let eyes: Vec<[f32; 3]> = eyes.collect();
    let ears = tissue.fibres.iter().filter(|f| EARS.contains(&f.muscle));
    let ears = ears.map(|f| tissue.points[usize::from(f.first) + usize::from(f.count) - 1].rest);
    let ears: Vec<[f32; 3]> = ears.collect();
    let top_of_lips = lips.iter().map(|p| p[1]).fold(f32::MIN, f32::max);
    let bottom_of_lips = lips.iter().map(|p| p[1]).fold(f32::MAX, f32::min);
    let eye_height = eyes.iter().map(|p| p[1]).sum::<f32>() / eyes.len().max(1) as f32;
    let nearest = |p: &[f32; 3], all: &[[f32; 3]], deep: f32| {
        let off = |q: &[f32; 3]| {
            let [x, y, z] = [0, 1, 2].map(|k| p[k] - q[k]);
            (x * x + y * y + deep * z * z).sqrt() / mm
        };
        all.iter().map(off).fold(f32::MAX, f32::min)
    };
    let of = |p: &[f32; 3]| {
        let from_lips = ramp(FROM_LIPS_MM, nearest(p, &lips, 1.0));
        let from_eyes = ramp(FROM_EYE_MM, nearest(p, &eyes, 0.0));
        let aside = ramp(FROM_NOSE_MM, p[0].abs() / mm);
        let above = ramp(ABOVE_NOSE_MM, (p[1] - eye_height) / mm);
        let below = 1.0 - ramp([0.0, 6.0], (p[1] - top_of_lips) / mm);
        let from_ears = ramp(FROM_EAR_MM, nearest(p, &ears, 1.0));
        let off_throat = 1.0 - ramp(BELOW_LIPS_MM, (bottom_of_lips - p[1]) / mm);
        off_throat * from_lips * from_eyes * from_ears * aside.max(above).max(below)
    };
    tissue.rest.iter().map(of).collect()
}
