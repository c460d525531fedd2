//! Mean adult head. Muscles, maps of the skin and morph targets are laid out on it, and transferred
//! to a person's head by common points.

use std::sync::OnceLock;

use raconteur_base::{DVec3, Side};

use super::binding::ModelHeadShape;
use super::cage::{Cage, Key};
use super::solve::{Solved, solve};
use super::surface::nearest;

const TABLE: &str = include_str!("mean.tsv");

impl Default for ModelHeadShape {
    /// The mean adult, midway between the sexes.
    #[allow(
        clippy::expect_used,
        reason = "the table is part of the program and tested"
    )]
    fn default() -> Self {
        static MEAN: OnceLock<ModelHeadShape> = OnceLock::new();
        MEAN.get_or_init(|| Self::from_text(TABLE).expect("a head"))
            .clone()
    }
}

/// Returns the solved cage of the mean head, computed once.
pub(super) fn solved(cage: &Cage) -> &'static Solved {
    static SOLVED: OnceLock<Solved> = OnceLock::new();
    SOLVED.get_or_init(|| solve(cage, &ModelHeadShape::default().symmetric()))
}

/// Returns true if a vertex of the cage is used to transfer layouts: every second one of the grid,
/// lips and lids.
fn carries(key: Key) -> bool {
    match key {
        Key::Grid(column, row) => (column + row) % 2 == 0,
        Key::Mouth(ring, _) => ring <= 4,
        Key::Eye(ring, _) => ring <= 3,
        _ => false,
    }
}

/// Points of its left half and midline, and where they are on a person's head, mm.
pub(super) fn landmarks(cage: &Cage, person: &Solved) -> Vec<(DVec3, DVec3)> {
    let mean = solved(cage);
    let on = |head: &Solved, v| head.limit_of(v, &head.cage_points);
    (0..cage.len())
        .filter(|&v| carries(cage.keys[v].0) && cage.keys[v].1 == Side::Left)
        .map(|v| (on(mean, v), on(person, v)))
        .collect()
}

/// Returns a map from positions on the left half to those of a person, by the mean shift of the
/// nearest landmarks.
pub(super) fn warp(landmarks: &[(DVec3, DVec3)]) -> impl Fn(DVec3) -> DVec3 + use<> {
    let (places, shifts): (Vec<DVec3>, Vec<DVec3>) =
        landmarks.iter().map(|&(at, own)| (at, own - at)).unzip();
    move |p| {
        let near = nearest(&places, p, 6, 2.0);
        p + near
            .iter()
            .map(|&(i, w)| shifts[i as usize] * w)
            .sum::<DVec3>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_vertex_of_the_cage_has_its_place_and_the_mean_carries_itself() {
        let cage = Cage::new();
        let places = ModelHeadShape::default().symmetric();
        let mean = solved(&cage);
        for (v, &(key, side)) in cage.keys.iter().enumerate() {
            if side == Side::Left {
                let far = mean.limit_of(v, &mean.cage_points).distance(places[&key]);
                assert!(far < 0.6, "{key:?}: {far} mm");
            }
        }
        let own = warp(&landmarks(&cage, mean));
        let p = DVec3::new(31.0, 10.0, 80.0);
        assert!(
            own(p).distance(p) < 1e-9,
            "the warp to the same head is the identity"
        );
    }
}
