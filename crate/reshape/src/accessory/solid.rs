//! Surfaces made of rows of points.

use std::f64::consts::TAU;

use raconteur_base::surface::area_vectors;
use raconteur_base::{DVec3, ops};

/// Mesh surface of an accessory, in the frame of the head, metres.
#[derive(Clone, Debug, Default)]
pub(super) struct Solid {
    pub(super) positions: Vec<DVec3>,
    pub(super) normals: Vec<DVec3>,
    pub(super) uvs: Vec<[f32; 2]>,
    pub(super) indices: Vec<u32>,
}

impl Solid {
    /// Builds a sheet from rows of equally many points; each row and each column connects to the
    /// next. Texture coordinates are metres along them. `closed`: rows end where they begin.
    pub(super) fn sheet(rows: &[Vec<DVec3>], closed: bool) -> Self {
        let (count, width) = (rows.len(), rows.first().map_or(0, Vec::len));
        let columns = if closed { width + 1 } else { width };
        let at = |i: usize, j: usize| rows[i][j % width.max(1)];
        let mut solid = Self::default();
        let mut down = vec![0.0; columns];
        for i in 0..count {
            let mut along = 0.0;
            for (j, down) in down.iter_mut().enumerate() {
                if i > 0 {
                    *down += (at(i, j) - at(i - 1, j)).length();
                }
                if j > 0 {
                    along += (at(i, j) - at(i, j - 1)).length();
                }
                solid.positions.push(at(i, j));
                solid.uvs.push([along as f32, *down as f32]);
            }
        }
        let index = |i: usize, j: usize| (i * columns + j) as u32;
        for i in 1..count {
            for j in 1..columns {
                let [a, b, c, d] =
                    [(i - 1, j - 1), (i - 1, j), (i, j - 1), (i, j)].map(|(i, j)| index(i, j));
                solid.indices.extend([a, c, b, b, c, d]);
            }
        }
        solid.light(columns, closed);
        solid
    }

    /// Normals from the triangles; both ends of a closed row have one.
    fn light(&mut self, columns: usize, closed: bool) {
        let mut normals = area_vectors(&self.positions, self.indices.as_chunks::<3>().0);
        if closed {
            for row in normals.chunks_mut(columns) {
                if let [first, .., last] = row {
                    let both = *first + *last;
                    (*first, *last) = (both, both);
                }
            }
        }
        let unit = |n: DVec3| n.try_normalize().unwrap_or(DVec3::Y);
        self.normals = normals.into_iter().map(unit).collect();
    }

    /// Returns the surface oriented so that it faces away from an inner point.
    pub(super) fn outward(self, inside: DVec3) -> Self {
        let lit = self.positions.iter().zip(&self.normals);
        let faces_in = lit.map(|(&p, n)| (p - inside).dot(*n)).sum::<f64>() < 0.0;
        if faces_in { self.flipped() } else { self }
    }

    fn flipped(mut self) -> Self {
        for t in self.indices.as_chunks_mut::<3>().0 {
            t.swap(1, 2);
        }
        for n in &mut self.normals {
            *n = -*n;
        }
        self
    }

    /// Appends another part of the same object.
    pub(super) fn join(&mut self, other: Self) {
        let first = self.positions.len() as u32;
        self.positions.extend(other.positions);
        self.normals.extend(other.normals);
        self.uvs.extend(other.uvs);
        self.indices.extend(other.indices.iter().map(|v| v + first));
    }

    /// Creates a rod of circular section along points; `closed` joins its ends.
    pub(super) fn rod(points: &[DVec3], radius: f64, closed: bool) -> Self {
        const SIDES: usize = 8;
        let count = points.len();
        if count < 2 {
            return Self::default();
        }
        let along = |i: usize| {
            let next = if closed {
                points[(i + 1) % count]
            } else {
                points[(i + 1).min(count - 1)]
            };
            let before = if closed {
                points[(i + count - 1) % count]
            } else {
                points[i.saturating_sub(1)]
            };
            (next - before).try_normalize().unwrap_or(DVec3::Z)
        };
        // The section is transported along the path, so that the rod does not twist.
        let mut across = along(0).any_orthonormal_vector();
        let ring = |i: usize, across: DVec3, r: f64| -> Vec<DVec3> {
            let other = along(i).cross(across);
            let point = |k: usize| {
                let turn = TAU * k as f64 / SIDES as f64;
                points[i] + r * (across * ops::cos(turn) + other * ops::sin(turn))
            };
            (0..SIDES).map(point).collect()
        };
        let mut rows = Vec::new();
        for i in 0..count {
            let forward = along(i);
            across = (across - forward * across.dot(forward))
                .try_normalize()
                .unwrap_or(across);
            if !closed && i == 0 {
                rows.push(ring(i, across, 1e-5));
            }
            rows.push(ring(i, across, radius));
            if !closed && i + 1 == count {
                rows.push(ring(i, across, 1e-5));
            }
        }
        if closed && let Some(first) = rows.first().cloned() {
            // At the closure, the section may have turned, so the nearest corner comes first.
            let last = ring(0, across, radius)[0];
            let turned = (0..SIDES).min_by(|&a, &b| {
                let far = |k: usize| (first[k] - last).length();
                far(a).total_cmp(&far(b))
            });
            let turned = turned.unwrap_or(0);
            rows.push((0..SIDES).map(|k| first[(k + turned) % SIDES]).collect());
        }
        let solid = Self::sheet(&rows, true);
        // All of a rod is turned as its second ring is.
        let ring = SIDES + 1..(SIDES + 1) * 2;
        let inside = if closed { points[1 % count] } else { points[0] };
        let out = solid.positions[ring.clone()]
            .iter()
            .zip(&solid.normals[ring]);
        let faces_in = out.map(|(&p, n)| (p - inside).dot(*n)).sum::<f64>() < 0.0;
        if faces_in { solid.flipped() } else { solid }
    }

    /// Creates a sphere.
    pub(super) fn ball(centre: DVec3, radius: f64) -> Self {
        const RINGS: usize = 8;
        const SIDES: usize = 12;
        let row = |i: usize| -> Vec<DVec3> {
            let tilt = std::f64::consts::PI * i as f64 / RINGS as f64;
            let point = |k: usize| {
                let turn = TAU * k as f64 / SIDES as f64;
                let (s, c) = (ops::sin(tilt).max(1e-3), ops::cos(tilt));
                centre + radius * DVec3::new(s * ops::sin(turn), c, s * ops::cos(turn))
            };
            (0..SIDES).map(point).collect()
        };
        Self::sheet(&(0..=RINGS).map(row).collect::<Vec<_>>(), true).outward(centre)
    }
}
