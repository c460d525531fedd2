//! Tests of the skin of the shipped figures: head, neck, mouth bag and both hands in the bind pose.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use crate::build::build;
use crate::built::AnnotatedFigure;
use raconteur_base::self_intersection::crossings;

use crate::crossing::{Skin, farthest_from_mirrored};
use crate::people::{self, FigureParams};
use raconteur_tier::{is_long, share};

/// A figure by name, made once for all tests.
pub(crate) fn shipped(name: &str) -> &'static (FigureParams, AnnotatedFigure) {
    type Made = [OnceLock<(FigureParams, AnnotatedFigure)>; people::NAMES.len()];
    static MADE: Made = [const { OnceLock::new() }; people::NAMES.len()];
    let index = people::NAMES.iter().position(|n| *n == name).unwrap();
    MADE[index].get_or_init(|| {
        let params = people::preset(name).unwrap();
        let built = build(&params);
        (params, built)
    })
}

/// The people whose figures are looked at: in the gate those that some tests need by name.
pub(crate) fn people_built() -> Vec<&'static str> {
    if is_long() {
        return people::NAMES.to_vec();
    }
    vec!["sofia", "papous", "kenji"]
}

#[test]
fn the_skin_of_no_figure_crosses_itself() {
    for name in people_built() {
        let skin = Skin::from_figure(&shipped(name).1.figure);
        assert!(
            skin.triangles.len() > 40_000,
            "the skin has more than 40000 triangles"
        );
        let found = crossings(&skin.points, &skin.triangles);
        let first = found.first();
        let first = first.map(|&[a, _]| skin.points[skin.triangles[a][0] as usize]);
        assert!(found.is_empty(), "{name}: {} at {first:?}", found.len());
    }
}

#[test]
fn no_edge_of_the_skin_has_three_faces_and_none_is_degenerate() {
    for name in people_built() {
        let skin = Skin::from_figure(&shipped(name).1.figure);
        // Each direction of an edge occurs once: adjacent faces have the same winding.
        let mut seen = BTreeSet::new();
        for t in &skin.triangles {
            for k in 0..3 {
                let edge = (t[k], t[(k + 1) % 3]);
                let at = skin.points[edge.0 as usize];
                assert!(seen.insert(edge), "{name} {at}");
            }
            let [a, b, c] = t.map(|v| skin.points[v as usize]);
            // Twice a thousandth of a square millimetre.
            let area = (b - a).cross(c - a).length();
            assert!(area > 2e-9, "{name} {a} {area}");
        }
    }
}

#[test]
fn without_asymmetry_the_skin_mirrors_itself() {
    // The gate makes one of them.
    for name in share(&people::NAMES, 1, people::NAMES.len()) {
        let mut params = people::preset(name).unwrap();
        params.head.asymmetry = 0.0;
        let skin = Skin::from_figure(&build(&params).figure);
        let hands = skin.points.iter().filter(|p| p.x.abs() > 0.25).count();
        assert!(
            hands > 3000 && skin.points.len() - hands > 6000,
            "hands and body have enough mirrored points"
        );
        let (far, at) = farthest_from_mirrored(&skin.points, 5e-4);
        assert!(far < 1e-4, "{name}: {far} m at {at}");
    }
}
