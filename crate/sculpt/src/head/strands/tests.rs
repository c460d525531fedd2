//! Invariants of brows and lashes on every head.

use raconteur_base::DVec3;

use super::lash::{Row, lashes};
use super::*;
use crate::head::{Head, build};
use crate::people::{NAMES, preset};

/// Triangles of the brows and lashes of one figure.
const MAX_TRIANGLES: usize = 3_400;

/// Their vertices.
const MAX_VERTICES: usize = 5_500;

/// Maximum distance of a brow hair above the skin, mm, for an old man's unruly brows; the next
/// constant is the maximum depth below it.
const MAX_OFF_SKIN_MM: f64 = 1.3;
const MAX_SUNK_MM: f64 = 0.45;

fn head(name: &str) -> Head {
    let p = preset(name).unwrap();
    build(&p.person, &p.head)
}

fn hair_parts(head: &Head) -> impl Iterator<Item = &MeshPart> {
    let parts = head.parts.iter();
    parts.filter(|p| p.material.kind == MaterialKind::Lash)
}

fn triangles(head: &Head) -> usize {
    let faces = hair_parts(head).flat_map(|p| &p.faces);
    faces.map(|f| f.len() - 2).sum()
}

/// Returns the distance of a position in front of the skin, along the skin's normal.
fn off_skin_mm(skin: &MeshPart, p: DVec3) -> Option<f64> {
    let corner = |v: u32| skin.vertices[v as usize].position;
    let faces = skin.faces.iter();
    let triangles = faces.flat_map(|f| f[1..].windows(2).map(|w| [f[0], w[0], w[1]].map(corner)));
    let over = triangles.filter_map(|[a, b, c]| {
        let n = (b - a).cross(c - a);
        let turn = |u: DVec3, v: DVec3| (v - u).truncate().perp_dot((p - u).truncate());
        let inside = n.z > 0.0 && turn(a, b) >= 0.0 && turn(b, c) >= 0.0 && turn(c, a) >= 0.0;
        inside.then(|| 1e3 * (p - a).dot(n.normalize()))
    });
    over.min_by(|a, b| a.abs().total_cmp(&b.abs()))
}

#[test]
fn brows_and_lashes_keep_within_their_budget() {
    for name in NAMES {
        let found = triangles(&head(name));
        assert!(found <= MAX_TRIANGLES, "{name}: {found}");
    }
    let mut p = preset("sofia").unwrap();
    p.head.brow.density = 9.0;
    let densest = build(&p.person, &p.head);
    let found = triangles(&densest);
    assert!(found <= MAX_TRIANGLES, "the densest: {found}");
    let vertices: usize = hair_parts(&densest).map(|p| p.vertices.len()).sum();
    assert!(vertices <= MAX_VERTICES, "the densest: {vertices}");
}

#[test]
fn hairs_of_brows_lie_on_the_skin() {
    for name in NAMES {
        let head = head(name);
        for part in hair_parts(&head).filter(|p| p.name.starts_with("brow")) {
            for v in &part.vertices {
                let off_mm = off_skin_mm(&head.parts[0], v.position).unwrap_or(f64::MAX);
                let fits = (-MAX_SUNK_MM..MAX_OFF_SKIN_MM).contains(&off_mm);
                assert!(fits, "{name}: {off_mm} at {}", v.position);
            }
        }
    }
}

#[test]
fn hairs_are_fine_and_pointed_and_brows_follow_the_tissue() {
    for part in hair_parts(&head("papous")) {
        let is_brow = part.name.starts_with("brow");
        assert!(
            !is_brow || part.bound.len() == part.vertices.len(),
            "every vertex of the brow is bound to tissue"
        );
        for v in &part.vertices {
            let aside_mm = 2.0 * REACH_MM * (v.uv[0] - 0.5).abs();
            assert!(aside_mm < 0.25, "{}: {aside_mm}", part.name);
            assert_eq!(v.uv[1] == 1.0, aside_mm == 0.0, "{}", part.name);
        }
    }
}

/// An arc like a lid's edge: 28 mm from corner to corner on a globe about the origin.
fn edge(sign: f64) -> Vec<DVec3> {
    let at = |i: i32| {
        let angle = 0.32 * f64::from(i - 4);
        DVec3::new(
            11.0 * angle,
            sign * (4.5 - 2.0 * angle * angle),
            12.0 - angle * angle,
        )
    };
    (0..=8).map(at).collect()
}

#[test]
fn lower_lashes_are_two_fifths_of_the_upper() {
    let p = BrowParams::default();
    let grown = |row, sign| lashes(&edge(sign), DVec3::ZERO, row, Side::Left, 5, &p);
    let (upper, lower) = (grown(Row::Upper, 1.0), grown(Row::Lower, -1.0));
    let mean = |row: &[Strand]| -> f64 {
        row.iter().map(Strand::length_mm).sum::<f64>() / row.len() as f64
    };
    let count = lower.len() as f64 / upper.len() as f64;
    let length = mean(&lower) / mean(&upper);
    assert!((count - 0.4).abs() < 0.02, "{count}");
    assert!((length - 0.4).abs() < 0.06, "{length}");
    let widest = |row: &[Strand]| row.iter().map(|l| l.half_width).fold(0.0, f64::max);
    assert!(
        widest(&lower) < 0.8 * widest(&upper),
        "the lower lashes are narrower"
    );
    let darkest = |row: &[Strand]| row.iter().map(|l| l.cover).fold(0.0, f64::max);
    assert!(
        darkest(&lower) < darkest(&upper),
        "the lower lashes have less coverage"
    );
}

#[test]
fn tips_of_lashes_meet_in_clumps() {
    let p = BrowParams::default();
    let row = lashes(&edge(1.0), DVec3::ZERO, Row::Upper, Side::Left, 5, &p);
    let gaps = |of: fn(&Strand) -> DVec3| -> Vec<f64> {
        row.windows(2)
            .map(|w| (of(&w[1]) - of(&w[0])).x.abs())
            .collect()
    };
    // Even at the lid, uneven at the tips.
    let uneven = |gaps: &[f64]| {
        let mean = gaps.iter().sum::<f64>() / gaps.len() as f64;
        let var = gaps.iter().map(|g| (g - mean) * (g - mean)).sum::<f64>();
        (var / gaps.len() as f64).sqrt() / mean
    };
    let roots = uneven(&gaps(|l| l.points[0]));
    let tips = uneven(&gaps(|l| l.points[l.points.len() - 1]));
    assert!(tips > 1.2 * roots, "{tips} {roots}");
}

#[test]
fn the_same_seed_grows_the_same_hairs() {
    let (a, b) = (head("nuno"), head("nuno"));
    for (a, b) in hair_parts(&a).zip(hair_parts(&b)) {
        assert_eq!(a.faces, b.faces);
        for (a, b) in a.vertices.iter().zip(&b.vertices) {
            assert_eq!((a.position, a.uv, a.color), (b.position, b.uv, b.color));
        }
    }
}
