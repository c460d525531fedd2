//! Surfaces that cross themselves.
//!
//! Two triangles that share no corner cross when an edge of one passes through the inside of
//! the other; triangles in one plane do not. Candidates come from a grid of cells, so that a
//! whole head takes a fraction of a second.

use std::collections::BTreeMap;

use raconteur_base::DVec3;
#[cfg(test)]
use raconteur_base::mirror_vector;
use raconteur_body::figure::{Figure, MaterialKind};

/// The skin of a figure, with the bag of the mouth: places that several vertices share made one.
#[derive(Clone, Debug, Default)]
pub struct Skin {
    /// Places, metres.
    pub points: Vec<DVec3>,
    /// Counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Skin {
    /// That of a figure in the bind pose.
    #[must_use]
    pub fn of(figure: &Figure) -> Self {
        let mut places: BTreeMap<[u32; 3], u32> = BTreeMap::new();
        let mut skin = Self::default();
        let is_skin = |m: &&raconteur_body::Mesh| {
            m.material.kind == MaterialKind::Skin || m.name == crate::part::MOUTH_BAG
        };
        for mesh in figure.meshes.iter().filter(is_skin) {
            let mut at = |v: u32| {
                let p = mesh.positions[v as usize];
                *places.entry(p.map(f32::to_bits)).or_insert_with(|| {
                    skin.points.push(DVec3::from_array(p.map(f64::from)));
                    skin.points.len() as u32 - 1
                })
            };
            let triangles = mesh.indices.chunks_exact(3);
            skin.triangles
                .extend(triangles.map(|t| [at(t[0]), at(t[1]), at(t[2])]));
        }
        skin.triangles
            .retain(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
        skin
    }
}

/// Whether an edge of one triangle passes through the other.
pub(super) fn cross(a: &[DVec3; 3], b: &[DVec3; 3]) -> bool {
    let through = |t: &[DVec3; 3], p: DVec3, q: DVec3| {
        let n = (t[1] - t[0]).cross(t[2] - t[0]);
        let (dp, dq) = ((p - t[0]).dot(n), (q - t[0]).dot(n));
        if dp * dq >= 0.0 {
            return false;
        }
        let x = p.lerp(q, dp / (dp - dq));
        (0..3).all(|k| n.cross(t[(k + 1) % 3] - t[k]).dot(x - t[k]) >= 0.0)
    };
    (0..3).any(|k| through(a, b[k], b[(k + 1) % 3]) || through(b, a[k], a[(k + 1) % 3]))
}

/// Pairs of triangles that share no corner and cross. Points at one place must be one point;
/// any unit of length.
#[must_use]
pub fn crossings(points: &[DVec3], triangles: &[[u32; 3]]) -> Vec<[usize; 2]> {
    let corners: Vec<[DVec3; 3]> = triangles
        .iter()
        .map(|t| t.map(|v| points[v as usize]))
        .collect();
    let boxes: Vec<(DVec3, DVec3)> = corners
        .iter()
        .map(|p| (p[0].min(p[1]).min(p[2]), p[0].max(p[1]).max(p[2])))
        .collect();
    let sum: f64 = boxes
        .iter()
        .map(|(low, high)| (*high - *low).length())
        .sum();
    let cell = (sum / boxes.len().max(1) as f64).max(1e-12);
    let index = |p: DVec3| (p / cell).floor().to_array().map(|x| x as i64);
    let mut cells: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
    let mut found = Vec::new();
    for (i, (low, high)) in boxes.iter().enumerate() {
        let (from, to) = (index(*low), index(*high));
        for x in from[0]..=to[0] {
            for y in from[1]..=to[1] {
                for z in from[2]..=to[2] {
                    let here = cells.entry([x, y, z]).or_default();
                    for &j in here.iter() {
                        let (other_low, other_high) = boxes[j];
                        let apart = low.cmpgt(other_high).any() || other_low.cmpgt(*high).any();
                        // A pair that meets in several cells counts in the first of them.
                        let first = index(low.max(other_low)) == [x, y, z];
                        let joined = triangles[i].iter().any(|v| triangles[j].contains(v));
                        if first && !apart && !joined && cross(&corners[i], &corners[j]) {
                            found.push([j, i]);
                        }
                    }
                    here.push(i);
                }
            }
        }
    }
    found
}

/// How far a point's mirror image can lie from the nearest of the points, and that point. `cell` is the
/// length within which one is sought, at least the tolerance; beyond it the distance counts
/// as infinite.
#[cfg(test)]
pub(super) fn farthest_from_mirrored(points: &[DVec3], cell: f64) -> (f64, DVec3) {
    let index = |p: DVec3| (p / cell).round().to_array().map(|x| x as i64);
    let mut cells: BTreeMap<[i64; 3], Vec<DVec3>> = BTreeMap::new();
    for &p in points {
        cells.entry(index(p)).or_default().push(p);
    }
    let mut far = (0.0, DVec3::ZERO);
    for &p in points {
        let q = mirror_vector(p);
        let [x, y, z] = index(q);
        let mut nearest = f64::INFINITY;
        for (i, j, k) in (0..27).map(|n| (n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)) {
            for r in cells.get(&[x + i, y + j, z + k]).into_iter().flatten() {
                nearest = nearest.min(r.distance(q));
            }
        }
        if nearest > far.0 {
            far = (nearest, p);
        }
    }
    far
}

#[test]
fn crossings_are_found_and_neighbours_are_not() {
    let v = DVec3::new;
    let sheet = [
        v(0.0, 0.0, 0.0),
        v(3.0, 0.0, 0.0),
        v(0.0, 3.0, 0.0),
        v(3.0, 3.0, 0.0),
    ];
    let folded = [v(1.0, 1.0, -1.0), v(1.2, 1.0, 1.0), v(1.0, 1.3, 1.0)];
    let far = [v(9.0, 9.0, -1.0), v(9.2, 9.0, 1.0), v(9.0, 9.3, 1.0)];
    let points: Vec<DVec3> = [&sheet[..], &folded, &far].concat();
    let triangles = [[0, 1, 2], [1, 3, 2], [4, 5, 6], [7, 8, 9]];
    assert_eq!(crossings(&points, &triangles), [[0, 2]]);
    let points: Vec<DVec3> = points.iter().map(|p| *p * 1e-3).collect();
    assert_eq!(crossings(&points, &triangles), [[0, 2]]);
}
