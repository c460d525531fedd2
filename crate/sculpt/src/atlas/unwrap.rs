//! Flattening of a surface: harmonic onto a given outline, which cannot fold, and conformal with a
//! free outline.
//!
//! Harmonic: Tutte 1963, doi:10.1112/plms/s3-13.1.743 (positive weights and a convex outline give a
//! map without overlap), with cotangent weights (Pinkall and Polthier 1993,
//! doi:10.1080/10586458.1993.10504266) constrained to be positive. Conformal: Lévy et al. 2002,
//! least squares conformal maps, doi:10.1145/566654.566590.

use std::collections::{BTreeMap, BTreeSet};

use raconteur_base::{DVec2, DVec3, ops};

use crate::least_squares::{Terms, least_squares};
use crate::subdivide::edge_faces;

/// Weight of a given position against the map's own equations.
const HOLD: f64 = 1e4;

/// Returns the corners of a face in turn, as the triangles of both possible diagonals.
fn both_cuts(face: &[u32]) -> impl Iterator<Item = [u32; 3]> + '_ {
    let n = face.len();
    (0..n).map(move |i| [face[i], face[(i + 1) % n], face[(i + 2) % n]])
}

/// Loops of open edges, each in order.
fn open_loops(faces: &[Vec<u32>]) -> Vec<Vec<u32>> {
    let edges = edge_faces(faces);
    let mut next: BTreeMap<u32, u32> = BTreeMap::new();
    for face in faces {
        for i in 0..face.len() {
            let (a, b) = (face[i], face[(i + 1) % face.len()]);
            if edges
                .get(&(a.min(b), a.max(b)))
                .is_some_and(|f| f.len() == 1)
            {
                next.insert(a, b);
            }
        }
    }
    let mut loops = Vec::new();
    while let Some((&start, _)) = next.iter().next() {
        let mut round = Vec::new();
        let mut at = start;
        while let Some(b) = next.remove(&at) {
            round.push(at);
            at = b;
        }
        loops.push(round);
    }
    loops
}

/// Flattens faces into the plane with some vertices fixed. `bridges` connect vertices across a
/// hole, with weights; a hole without bridges is closed by a vertex in the middle. `tension` is 1
/// for each vertex, more where the map should spread its surroundings. Returns a position for each
/// vertex (those of no face stay at the origin) and the borders of the holes without bridges.
///
/// # Panics
/// Never panics: the fixed rows make the system positive definite.
#[allow(clippy::expect_used, reason = "held rows make the system definite")]
pub(crate) fn harmonic(
    faces: &[Vec<u32>],
    positions: &[DVec3],
    held: &[(u32, DVec2)],
    bridges: &[(u32, u32, f64)],
    tension: &[f64],
) -> (Vec<DVec2>, Vec<Vec<u32>>) {
    let mut weights: BTreeMap<(u32, u32), f64> = BTreeMap::new();
    for face in faces {
        // A quad is split both ways with half the weight each; a fan of more corners is coarse, but
        // only the ends of pockets have them.
        for [a, b, c] in both_cuts(face) {
            for (i, j, k) in [(a, b, c), (b, c, a), (c, a, b)] {
                let [x, y] = [j, k].map(|v| positions[v as usize] - positions[i as usize]);
                let cotangent = x.dot(y) / x.cross(y).length().max(1e-6);
                *weights.entry((j.min(k), j.max(k))).or_insert(0.0) += 0.25 * cotangent;
            }
        }
    }
    // Diagonals count too; clamping keeps all weights positive.
    let mut rows: Vec<Terms> = weights
        .iter()
        .map(|(&(a, b), &w)| {
            let pull = tension[a as usize] * tension[b as usize];
            let w = (w.clamp(0.05, 4.0) / pull.sqrt()).sqrt();
            vec![(a, w), (b, -w)]
        })
        .collect();
    rows.extend(
        bridges
            .iter()
            .map(|&(a, b, w)| vec![(a, w.sqrt()), (b, -w.sqrt())]),
    );
    let is_held =
        |v: &u32| held.iter().any(|h| h.0 == *v) || bridges.iter().any(|b| b.0 == *v || b.1 == *v);
    let holes: Vec<Vec<u32>> = open_loops(faces)
        .into_iter()
        .filter(|l| !l.iter().any(is_held))
        .collect();
    let mut count = positions.len() as u32;
    for hole in &holes {
        rows.extend(hole.iter().map(|&v| vec![(v, 0.7), (count, -0.7)]));
        count += 1;
    }
    let fixed: Vec<(Terms, DVec3)> = held
        .iter()
        .map(|&(v, p)| (vec![(v, HOLD)], p.extend(0.0) * HOLD))
        .collect();
    let flat: Vec<DVec2> = least_squares(count as usize, &fixed, &rows)
        .expect("a definite system")
        .into_iter()
        .map(DVec3::truncate)
        .collect();
    (flat[..positions.len()].to_vec(), holes)
}

/// Flattens triangles into the plane as conformally as possible, with two vertices fixed.
///
/// # Panics
/// Never panics, for the same reason as [`harmonic`].
#[allow(clippy::expect_used, reason = "held rows make the system definite")]
pub(crate) fn conformal(
    triangles: &[[u32; 3]],
    positions: &[DVec3],
    held: [(u32, DVec2); 2],
) -> Vec<DVec2> {
    let n = positions.len() as u32;
    let mut rows: Vec<Terms> = Vec::with_capacity(2 * triangles.len());
    for t in triangles {
        let [a, b, c] = t.map(|v| positions[v as usize]);
        let Some(x) = (b - a).try_normalize() else {
            continue;
        };
        let normal = (b - a).cross(c - a);
        let Some(y) = normal.cross(x).try_normalize() else {
            continue;
        };
        let local = [a, b, c].map(|p| DVec2::new((p - a).dot(x), (p - a).dot(y)));
        let scale = 1.0 / normal.length().max(1e-6).sqrt();
        let (mut real, mut imaginary) = (Vec::with_capacity(6), Vec::with_capacity(6));
        for k in 0..3 {
            let w = (local[(k + 2) % 3] - local[(k + 1) % 3]) * scale;
            real.extend([(t[k], w.x), (t[k] + n, -w.y)]);
            imaginary.extend([(t[k], w.y), (t[k] + n, w.x)]);
        }
        rows.extend([real, imaginary]);
    }
    let fixed: Vec<(Terms, DVec3)> = held
        .iter()
        .flat_map(|&(v, p)| {
            [
                (vec![(v, HOLD)], DVec3::X * p.x * HOLD),
                (vec![(v + n, HOLD)], DVec3::X * p.y * HOLD),
            ]
        })
        .collect();
    let flat = least_squares(2 * n as usize, &fixed, &rows).expect("a definite system");
    (0..n as usize)
        .map(|i| DVec2::new(flat[i].x, flat[i + n as usize].x))
        .collect()
}

/// Raises the tension of [`harmonic`] where a map gives too little area and lowers it where it
/// gives too much, weighted by each vertex's share (0..1). After Yoshizawa, Belyaev and Seidel
/// 2004, doi:10.1109/SMI.2004.1314507; weights stay positive, so the next map has no overlap
/// either.
pub(crate) fn even_out(
    faces: &[Vec<u32>],
    positions: &[DVec3],
    flat: &[DVec2],
    share: &[f64],
    tension: &mut [f64],
) {
    let mut area = vec![[0.0; 2]; positions.len()];
    for face in faces {
        for t in both_cuts(face) {
            let [a, b, c] = t.map(|v| positions[v as usize]);
            let [p, q, r] = t.map(|v| flat[v as usize]);
            let (real, laid) = ((b - a).cross(c - a).length(), (q - p).perp_dot(r - p).abs());
            for v in t {
                area[v as usize][0] += real;
                area[v as usize][1] += laid;
            }
        }
    }
    let whole: [f64; 2] =
        core::array::from_fn(|i| area.iter().zip(share).map(|(a, s)| a[i] * s).sum());
    let mean = whole[0] / whole[1].max(1e-9);
    for ((t, [real, laid]), s) in tension.iter_mut().zip(area).zip(share) {
        if laid > 0.0 && *s > 0.0 {
            let stretch = (real / laid / mean).sqrt().clamp(0.5, 2.5);
            *t = (*t * ops::pow(stretch, *s)).clamp(0.1, 10.0);
        }
    }
}

/// Number of smoothing rounds for a fold; each round reaches one vertex further.
const ROUNDS: usize = 60;

/// Removes folds from a flattened surface: the corners of an inverted triangle (anticlockwise with
/// y down is correct) move towards the mean of their neighbours, those on an open edge along that
/// edge, until none is left. Triangles that are already flat stay. Triangles without area, such as
/// those between closed lips, are skipped.
pub(crate) fn unfold(triangles: &[[u32; 3]], flat: &mut [DVec2]) {
    let edges = edge_faces(&triangles.iter().map(|t| t.to_vec()).collect::<Vec<_>>());
    let mut around: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    let mut along: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (&(a, b), faces) in &edges {
        around.entry(a).or_default().push(b);
        around.entry(b).or_default().push(a);
        if faces.len() == 1 {
            along.entry(a).or_default().push(b);
            along.entry(b).or_default().push(a);
        }
    }
    for _ in 0..ROUNDS {
        let folded: BTreeSet<u32> = triangles
            .iter()
            .filter(|t| {
                let [a, b, c] = t.map(|v| flat[v as usize]);
                (b - a).perp_dot(c - a) > 1e-9
            })
            .flatten()
            .copied()
            .collect();
        if folded.is_empty() {
            return;
        }
        for v in folded {
            // Smoothing an edge separately shrinks it little; its inside follows.
            let near = along.get(&v).unwrap_or(&around[&v]);
            let sum: DVec2 = near.iter().map(|&u| flat[u as usize]).sum();
            let middle = sum / near.len() as f64;
            flat[v as usize] = flat[v as usize].lerp(middle, 0.7);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a bumpy square of 8 × 8 quads with a hole in the middle, for tests.
    fn bumpy() -> (Vec<Vec<u32>>, Vec<DVec3>) {
        let at = |i: u32, j: u32| j * 9 + i;
        let mut faces = Vec::new();
        for j in 0..8 {
            for i in 0..8 {
                if (i, j) != (4, 4) {
                    faces.push(vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                }
            }
        }
        let p = (0..81).map(|v| {
            let (x, y) = (f64::from(v % 9) - 4.0, f64::from(v / 9) - 4.0);
            DVec3::new(x, y, 5.0 / (1.0 + 0.4 * (x * x + y * y)))
        });
        (faces, p.collect())
    }

    #[test]
    fn a_harmonic_map_does_not_fold() {
        let (faces, p) = bumpy();
        let held: Vec<(u32, DVec2)> = (0..81)
            .filter(|v| v % 9 == 0 || v % 9 == 8 || v / 9 == 0 || v / 9 == 8)
            .map(|v| (v, p[v as usize].truncate()))
            .collect();
        let (flat, holes) = harmonic(&faces, &p, &held, &[], &[1.0; 81]);
        assert_eq!(holes.len(), 1);
        for f in &faces {
            for i in 0..4 {
                let [a, b, c] = [i, i + 1, i + 2].map(|k| flat[f[k % 4] as usize]);
                assert!(
                    (b - a).perp_dot(c - a) > 0.0,
                    "the triangle of the harmonic map is not folded"
                );
            }
        }
    }

    #[test]
    fn a_fold_is_opened_and_the_rest_stays() {
        let at = |i: u32, j: u32| j * 9 + i;
        let mut triangles = Vec::new();
        for j in 0..8 {
            for i in 0..8 {
                let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        let even: Vec<DVec2> = (0..81)
            .map(|v| DVec2::new(f64::from(v % 9), f64::from(v / 9)))
            .collect();
        let mut flat = even.clone();
        // Two vertices inside and one on the edge have crossed their neighbours.
        for (i, j, x, y) in [(4, 4, 2.4, 0.3), (5, 4, -1.7, 0.0), (3, 0, 1.6, 0.0)] {
            flat[at(i, j) as usize] += DVec2::new(x, y);
        }
        unfold(&triangles, &mut flat);
        for t in triangles {
            let [a, b, c] = t.map(|v| flat[v as usize]);
            assert!(
                (b - a).perp_dot(c - a) <= 1e-9,
                "the fold has no positive area"
            );
        }
        assert_eq!(flat[at(1, 7) as usize], even[at(1, 7) as usize]);
    }

    #[test]
    fn a_conformal_map_of_a_bent_sheet_keeps_lengths() {
        // A quarter of a cylinder flattens without any change.
        let p: Vec<DVec3> = (0..45)
            .map(|v| {
                let (a, y) = (f64::from(v % 9) * 0.2, f64::from(v / 9));
                let (s, c) = ops::sincos(a);
                DVec3::new(5.0 * s, y, 5.0 * c)
            })
            .collect();
        let mut t = Vec::new();
        for j in 0..4 {
            for i in 0..8 {
                let a = j * 9 + i;
                t.extend([[a, a + 1, a + 10], [a, a + 10, a + 9]]);
            }
        }
        let flat = conformal(&t, &p, [(0, DVec2::ZERO), (36, DVec2::new(0.0, 4.0))]);
        for [a, b, c] in t {
            for (i, j) in [(a, b), (b, c), (c, a)] {
                let (i, j) = (i as usize, j as usize);
                let stretch = flat[i].distance(flat[j]) / p[i].distance(p[j]);
                assert!((stretch - 1.0).abs() < 0.02, "{stretch}");
            }
        }
    }
}
