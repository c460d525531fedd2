//! Head skin as the boundary of the bones: along rays, near a point, and in every direction of the
//! skull's map.

use std::collections::BTreeMap;

use raconteur_base::curve::lerp;
use raconteur_base::{DVec3, Side, ops};

use raconteur_body::figure::{Figure, MaterialKind};
use raconteur_body::skeleton::{Bone, Drive};

/// Rings and columns of the skull's map.
pub(super) const RINGS: usize = 44;
pub(super) const COLUMNS: usize = 64;

/// Skin of the head in the bind pose with its landmarks; limits the bones under it.
pub(super) struct Skin {
    triangles: Vec<[DVec3; 3]>,
    cells: BTreeMap<[i32; 3], Vec<u32>>,
    /// Middle between the eyeballs.
    pub(super) eyes: DVec3,
    /// Half the distance between the eyeballs, metres.
    pub(super) half_gap: f64,
    /// Middle of the jaw's hinges.
    pub(super) hinge: DVec3,
    /// Lowest point of the chin's skin on the midline, and the vertex.
    pub(super) chin: DVec3,
    pub(super) top: f64,
    /// Scale relative to the adult for which lengths here are given.
    pub(super) scale: f64,
}

/// Height from chin to vertex of that adult, metres (by eye from the mean head).
const REFERENCE_HEIGHT_M: f64 = 0.222;

impl Skin {
    pub(super) fn from_figure(figure: &Figure) -> Self {
        let joints = figure.skeleton.joints();
        let place = |i: usize| figure.inverse_bind[i].inverse().translation;
        let eye = |side: Side| {
            let index = joints.iter().position(|j| j.drive == Drive::Eye(side));
            place(index.unwrap_or(Bone::Skull.index()))
        };
        let of_head = |j: u16| {
            matches!(
                joints[usize::from(j)].drive,
                Drive::Bone(Bone::Skull | Bone::Chin | Bone::Cervical)
                    | Drive::Share(Bone::Skull, _)
                    | Drive::UpperLid(_)
                    | Drive::LowerLid(_)
            )
        };
        let mut triangles = Vec::new();
        for mesh in &figure.meshes {
            if mesh.material.kind != MaterialKind::Skin {
                continue;
            }
            let mine: Vec<bool> = (0..mesh.positions.len())
                .map(|v| (0..4).all(|k| mesh.weights[v][k] <= 0.0 || of_head(mesh.joints[v][k])))
                .collect();
            triangles.extend(
                mesh.indices
                    .chunks_exact(3)
                    .filter(|t| t.iter().all(|&v| mine[v as usize]))
                    .map(|t| {
                        [t[0], t[1], t[2]]
                            .map(|v| DVec3::from_array(mesh.positions[v as usize].map(f64::from)))
                    }),
            );
        }
        let (l, r) = (eye(Side::Left), eye(Side::Right));
        let eyes = (l + r) / 2.0;
        let points = || triangles.iter().flatten();
        let top = points().map(|p| p.y).fold(eyes.y, f64::max);
        let hinge = place(Bone::Chin.index());
        // The chin's underside: lowest skin of the midline in front of the middle of the jaw.
        let front = lerp(hinge.z, eyes.z, 0.75);
        let below = points().filter(|p| p.x.abs() < 0.006 && p.z > front && p.y < eyes.y);
        let chin = below
            .copied()
            .min_by(|a, b| a.y.total_cmp(&b.y))
            .unwrap_or(eyes - DVec3::Y * 0.11);
        Self {
            eyes,
            half_gap: (l.x - r.x).abs() / 2.0,
            hinge,
            chin,
            top,
            scale: (top - chin.y) / REFERENCE_HEIGHT_M,
            cells: cells_of(&triangles),
            triangles,
        }
    }

    /// Returns the distance to the outermost skin along a ray; `None` if there is none.
    pub(super) fn outermost(&self, from: DVec3, way: DVec3) -> Option<f64> {
        self.triangles
            .iter()
            .filter_map(|t| hit(t, from, way))
            .reduce(f64::max)
    }

    /// Returns the distance to the nearest skin within [`CELL_M`], and true if the point lies
    /// behind it; `None` if all skin is farther.
    pub(super) fn nearest(&self, p: DVec3) -> Option<(f64, bool)> {
        // Distance, and the signed distance from the triangle's plane.
        let mut best: Option<(f64, f64)> = None;
        for t in self.cells.get(&cell(p))? {
            let t = &self.triangles[*t as usize];
            let d = to_triangle(t, p);
            if d >= CELL_M {
                continue;
            }
            let normal = (t[1] - t[0]).cross(t[2] - t[0]);
            let before = normal.dot(p - t[0]) / normal.length().max(1e-12);
            // If an edge is nearest, its triangle with the steeper view determines the side of the
            // point.
            let is_nearer = best.is_none_or(|(least, plane)| {
                let is_same = (d - least).abs() < SAME_M;
                if is_same {
                    before.abs() > plane.abs()
                } else {
                    d < least
                }
            });
            if is_nearer {
                best = Some((d, before));
            }
        }
        best.map(|(d, before)| (d, before <= 0.0))
    }

    /// Returns the distance from a centre to the outermost skin in every direction of the skull's
    /// radial map, metres; `None` without skin.
    pub(super) fn outermost_map(&self, centre: DVec3) -> Vec<Vec<Option<f64>>> {
        let mut map = vec![vec![None; COLUMNS]; RINGS];
        let turn = core::f64::consts::TAU;
        for t in &self.triangles {
            // Rings and columns that the triangle can cover.
            let rings = t.map(|p| {
                let d = (p - centre).normalize();
                ops::acos_clamped(d.y) / core::f64::consts::PI * (RINGS as f64 + 1.0) - 1.0
            });
            let columns = t.map(|p| {
                let a = ops::atan2(p.x - centre.x, p.z - centre.z);
                a.rem_euclid(turn) / turn * COLUMNS as f64
            });
            let least = |v: [f64; 3]| v.into_iter().fold(f64::INFINITY, f64::min);
            let most = |v: [f64; 3]| v.into_iter().fold(f64::NEG_INFINITY, f64::max);
            let (r0, r1) = (least(rings).floor() - 1.0, most(rings).ceil() + 1.0);
            let (c0, c1) = (least(columns), most(columns));
            let all_round = c1 - c0 > COLUMNS as f64 / 4.0;
            for (i, row) in map.iter_mut().enumerate() {
                if (i as f64) < r0 || i as f64 > r1 {
                    continue;
                }
                for (j, far) in row.iter_mut().enumerate() {
                    if !all_round && ((j as f64) < c0 - 1.0 || j as f64 > c1 + 1.0) {
                        continue;
                    }
                    if let Some(d) = hit(t, centre, direction(i, j)) {
                        *far = Some(far.map_or(d, |f: f64| f.max(d)));
                    }
                }
            }
        }
        map
    }
}

/// Returns the direction of a cell of the skull's map.
pub(super) fn direction(ring: usize, column: usize) -> DVec3 {
    let (s, c) = ops::sincos(core::f64::consts::PI * (ring as f64 + 1.0) / (RINGS as f64 + 1.0));
    let (sk, ck) = ops::sincos(core::f64::consts::TAU * column as f64 / COLUMNS as f64);
    DVec3::new(s * sk, c, s * ck)
}

/// Side of the cells in which nearby skin is looked up, metres.
const CELL_M: f64 = 0.006;
/// Triangles whose distances differ by less are equally near, metres.
const SAME_M: f64 = 1e-9;

fn cell(p: DVec3) -> [i32; 3] {
    (p / CELL_M).floor().to_array().map(|x| x as i32)
}

/// Returns, for every cell, the triangles within one cell width.
fn cells_of(triangles: &[[DVec3; 3]]) -> BTreeMap<[i32; 3], Vec<u32>> {
    let mut cells: BTreeMap<[i32; 3], Vec<u32>> = BTreeMap::new();
    for (t, index) in triangles.iter().zip(0u32..) {
        let reach = DVec3::splat(CELL_M);
        let low = cell(t[0].min(t[1]).min(t[2]) - reach);
        let high = cell(t[0].max(t[1]).max(t[2]) + reach);
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    cells.entry([x, y, z]).or_default().push(index);
                }
            }
        }
    }
    cells
}

/// Returns the distance along a ray to a triangle (Möller and Trumbore's test), in lengths of
/// `way`; `None` if the ray misses.
pub(crate) fn hit(t: &[DVec3; 3], from: DVec3, way: DVec3) -> Option<f64> {
    let (e1, e2) = (t[1] - t[0], t[2] - t[0]);
    let p = way.cross(e2);
    let det = e1.dot(p);
    if det.abs() < 1e-14 {
        return None;
    }
    let s = from - t[0];
    let u = s.dot(p) / det;
    let q = s.cross(e1);
    let v = way.dot(q) / det;
    let d = e2.dot(q) / det;
    (u >= -1e-9 && v >= -1e-9 && u + v <= 1.0 + 1e-9 && d > 0.0).then_some(d)
}

/// Returns the distance from a point to a triangle.
pub(super) fn to_triangle(t: &[DVec3; 3], p: DVec3) -> f64 {
    let edge = |a: DVec3, b: DVec3| {
        let ab = b - a;
        let s = ((p - a).dot(ab) / ab.length_squared().max(1e-18)).clamp(0.0, 1.0);
        (p - a - ab * s).length()
    };
    let normal = (t[1] - t[0]).cross(t[2] - t[0]);
    let inside = (0..3).all(|i| {
        let (a, b) = (t[i], t[(i + 1) % 3]);
        normal.cross(b - a).dot(p - a) >= 0.0
    });
    let length = normal.length();
    if inside && length > 1e-12 {
        return ((p - t[0]).dot(normal) / length).abs();
    }
    edge(t[0], t[1]).min(edge(t[1], t[2])).min(edge(t[2], t[0]))
}
