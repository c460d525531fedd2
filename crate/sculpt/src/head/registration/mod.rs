//! Registration: determines the positions of the binding on the body model's mean head again, and
//! measures the distance of heads from the model.
//!
//! Rings of lids, lips and nostrils and the named points carry the meaning and keep their
//! positions; ears follow lines drawn on the model's ear ([`ear`]). Registration determines the
//! rest: the mean head is bent through those points, and drawn onto the model's surface in rounds
//! with decreasing stiffness (Amberg et al. 2007, "Optimal step nonrigid ICP algorithms for surface
//! registration", doi:10.1109/CVPR.2007.383165).

mod deviation;
pub(super) mod ear;

use std::collections::BTreeMap;

use raconteur_base::{DVec3, Side};

pub use self::deviation::{Deviation, deviations};
use super::binding::{Binding, refined, rewritten};
use super::cage::{Cage, Key};
use super::landmark::is_named;
use super::mean;
use super::refined::{InFace, Refined};
use super::solve::Fairness;
use crate::least_squares::{Terms, least_squares};
use crate::model::{Ancestry, Model, ModelError, Traits};
use crate::surface::{Place, Surface};
use raconteur_base::surface::vertex_normals;

/// Weights of the smoothness of the deformation and of the attraction to the nearest point, by
/// round. Designed.
const ROUNDS: [[f64; 2]; 9] = [
    [30.0, 0.3],
    [30.0, 0.3],
    [15.0, 0.5],
    [8.0, 0.7],
    [5.0, 1.0],
    [3.0, 1.0],
    [2.0, 1.0],
    [1.5, 1.0],
    [1.0, 1.0],
];
/// Weight of a given position.
const GIVEN: f64 = 6.0;
/// Weight of the previous position, which stops vertices from sliding along flat skin.
const BEFORE: f64 = 1.0;
/// Search radius for the nearest point, mm; the next constant is the minimum cosine between the
/// normals.
const REACH_MM: f64 = 12.0;
const FACING: f64 = 0.35;

/// Binding of the head's cage to the body model, newly computed by [`register`], with its quality.
#[derive(Clone, Debug)]
pub struct HeadRegistration {
    /// Table of the binding, in the format of `head/binding.tsv`.
    pub table: String,
    /// Number of cage vertices with a match, on both halves.
    pub found_points: usize,
    /// Number of vertices without a match, which keep their positions.
    pub used_points: usize,
    /// Mean and maximum displacement from the previous positions, mm.
    pub moved_mm: [f64; 2],
}

/// Returns the traits of the model's mean adult.
fn mean_traits() -> Traits {
    Traits {
        age_years: 32.0,
        sex: 0.5,
        ancestry: Ancestry {
            african: 1.0,
            asian: 1.0,
            european: 1.0,
        },
        muscle: 0.5,
        weight: 0.5,
        height: 0.5,
        proportions: 0.6,
        details: BTreeMap::new(),
    }
}

/// The model's head in the frame of ours, as triangles, mm.
struct ModelHead {
    refined: Refined,
    surface: Surface,
}

impl ModelHead {
    fn new(model: &Model, binding: &Binding, shape: &[DVec3]) -> Self {
        let refined = refined(model.faces());
        let points = refined.points(&binding.in_frame(shape));
        Self {
            surface: Surface::new(points, refined.triangles(), REACH_MM),
            refined,
        }
    }

    fn place(&self, place: &Place) -> (u32, InFace) {
        self.refined.place(place.triangle, place.shares)
    }
}

/// Returns true if a vertex of the cage keeps its position in the binding.
fn is_given(key: Key) -> bool {
    match key {
        Key::Eye(5.., _) | Key::Mouth(1.., _) | Key::Nostril(..) => true,
        Key::Ear(..) => true,
        _ => is_named(key) || key.mouth_position().is_some(),
    }
}

/// Registers the mean head to the mean head of the body model and returns the new binding.
///
/// # Errors
/// Returns an error if the model lacks a target.
pub fn register(model: &Model) -> Result<HeadRegistration, ModelError> {
    let shape = model.shape(&mean_traits())?;
    let binding = Binding::new(model.faces());
    let theirs = ModelHead::new(model, &binding, &shape);
    let before = binding.bind(&shape);
    let cage = Cage::new();
    let ears = ear::places(&theirs.surface);
    let given = |key: Key, side: Side| match ears.get(&(key, side)) {
        Some(place) => Some(place.at),
        None if is_given(key) => before.place(key, side),
        None => None,
    };
    let bent = bend(
        &cage,
        &theirs.surface,
        &|key, side| before.place(key, side),
        &given,
    );
    let normals = vertex_normals(&bent, &cage.faces);
    let mut found: BTreeMap<(Key, Side), (u32, InFace)> = ears
        .iter()
        .map(|(&at, place)| (at, theirs.place(place)))
        .collect();
    // If lines miss the ear, its positions stay unchanged.
    let mut kept = ear::COUNT - ears.len();
    let (mut sum, mut most, mut count) = (0.0, 0.0f64, 0);
    for (v, &(key, side)) in cage.keys.iter().enumerate() {
        let Some(was) = before
            .place(key, side)
            .filter(|_| given(key, side).is_none())
        else {
            continue;
        };
        let place = nearest(&theirs.surface, bent[v], normals[v]);
        let Some(place) = place else {
            kept += 1;
            continue;
        };
        let way = place.at.distance(was);
        (sum, most, count) = (sum + way, most.max(way), count + 1);
        found.insert((key, side), theirs.place(&place));
    }
    Ok(HeadRegistration {
        table: rewritten(&found),
        found_points: found.len(),
        used_points: kept,
        moved_mm: [sum / f64::from(count.max(1)), most],
    })
}

fn nearest(theirs: &Surface, p: DVec3, normal: DVec3) -> Option<Place> {
    theirs.nearest(p, |place| place.normal.dot(normal) > FACING)
}

/// Deforms the mean head's limit positions to the given positions and projects them onto a surface.
///
/// # Panics
/// Panics if the normal equations are singular. The fixed topology and the given positions rule
/// that out.
#[allow(
    clippy::expect_used,
    reason = "depends on the built-in topology and table only"
)]
fn bend(
    cage: &Cage,
    theirs: &Surface,
    before: &dyn Fn(Key, Side) -> Option<DVec3>,
    given: &dyn Fn(Key, Side) -> Option<DVec3>,
) -> Vec<DVec3> {
    let mean = mean::solved(cage);
    let at: Vec<DVec3> = (0..cage.len())
        .map(|v| mean.limit_of(v, &mean.cage_points))
        .collect();
    let fairness = Fairness::new(&cage.faces, cage.len()).rows(Some(&at));
    let row = |v: usize, weight: f64| -> Terms { vec![(v as u32, weight)] };
    let fixed: Vec<(usize, DVec3)> = cage
        .keys
        .iter()
        .enumerate()
        .filter_map(|(v, &(key, side))| Some((v, given(key, side)? - at[v])))
        .collect();
    let free: Vec<(usize, DVec3)> = cage
        .keys
        .iter()
        .enumerate()
        .filter(|(_, (key, side))| given(*key, *side).is_none())
        .filter_map(|(v, &(key, side))| Some((v, before(key, side)? - at[v])))
        .collect();
    let mut bent = at.clone();
    for (round, [stiff, holds]) in ROUNDS.into_iter().enumerate() {
        let mut rows: Vec<(Terms, DVec3)> = fixed
            .iter()
            .map(|&(v, shift)| (row(v, GIVEN), shift * GIVEN))
            .collect();
        rows.extend(free.iter().map(|&(v, was)| (row(v, BEFORE), was * BEFORE)));
        // The first round only bends the head: before the bend, the nearest positions belong to
        // other parts.
        if round > 0 {
            let normals = vertex_normals(&bent, &cage.faces);
            let found = free.iter().filter_map(|&(v, _)| {
                let place = nearest(theirs, bent[v], normals[v])?;
                Some((row(v, holds), (place.at - at[v]) * holds))
            });
            rows.extend(found);
        }
        let smooth: Vec<Terms> = fairness
            .iter()
            .map(|r| r.iter().map(|&(v, w)| (v, w * stiff)).collect())
            .collect();
        let shifts = least_squares(cage.len(), &rows, &smooth).expect("a positive definite system");
        bent = at.iter().zip(shifts).map(|(&p, s)| p + s).collect();
    }
    bent
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::subdivide::subdivide;

    /// Returns a point displaced by a smooth test deformation of the head, mm.
    fn bulge(p: DVec3) -> DVec3 {
        let away = (p - DVec3::new(60.0, -30.0, 60.0)).length_squared();
        p * DVec3::new(1.06, 0.96, 1.03)
            + DVec3::X * (5.0 * raconteur_base::ops::exp(-away / 1800.0))
    }

    #[test]
    fn a_head_that_was_bent_smoothly_is_found_again() {
        let cage = Cage::new();
        let mean = mean::solved(&cage);
        let fine = subdivide(&cage.faces, cage.len(), 2);
        let points: Vec<DVec3> = fine
            .apply(&mean.cage_points)
            .into_iter()
            .map(bulge)
            .collect();
        let triangles = fine.faces.iter();
        let triangles = triangles.flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]);
        let theirs = Surface::new(points, triangles.collect(), REACH_MM);
        let limit = |v: usize| bulge(mean.limit_of(v, &mean.cage_points));
        let given = |key: Key, side: Side| is_given(key).then(|| limit(cage.vertex(key, side)));
        // The previous positions are a millimetre and a half away.
        let before = |key: Key, side: Side| Some(limit(cage.vertex(key, side)) + DVec3::Y * 1.5);
        let bent = bend(&cage, &theirs, &before, &given);
        let mut errors: Vec<f64> = Vec::new();
        for (v, &(key, _)) in cage.keys.iter().enumerate() {
            // The end of the neck has no constraint.
            let is_neck = matches!(key, Key::Grid(_, 26..));
            if !is_given(key) && !is_neck && matches!(key, Key::Grid(..) | Key::Crown(..)) {
                let place = theirs.nearest(bent[v], |_| true).unwrap();
                errors.push(place.at.distance(limit(v)));
            }
        }
        errors.sort_by(f64::total_cmp);
        let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
        assert!(errors.len() > 500 && rms < 1.5, "{rms} mm");
    }
}
