//! Lip separation of a face. Faces are sums, and a sum of faces with closed lips need not have
//! closed lips: where the upper lip would penetrate the lower one, both yield.
//!
//! Between closed lips the skin is nearly level, so each lip is represented by its height over the
//! plane of x and z.

use std::collections::BTreeMap;

use crate::blend::VertexNeighbours;
use crate::segment::Segments;

/// Minimum gap between the lips, metres: about that of the database heads.
const GAP_M: f64 = 1.5e-4;
/// Maximum depth inside the other lip that still counts as lip contact, metres.
const MAX_DEPTH_M: f64 = 8e-3;
/// Side of a cell, metres.
const CELL_M: f64 = 2e-3;
/// Number of relaxation rounds; each leaves a small share of the overlap.
const ROUNDS: usize = 16;
/// Number of neighbour steps over which a lip vertex spreads its displacement, and the share kept
/// at each step.
const STEPS: usize = 10;
const SHARE: f64 = 0.86;

type Place = [f64; 3];

/// Lip surface: the triangles that face the other lip.
#[derive(Clone, Debug)]
struct Lip {
    triangles: Vec<[u32; 3]>,
    vertices: Vec<u32>,
    /// 1 for the upper one, −1 for the lower one.
    up: f64,
}

/// Lips of a face model, used to keep them apart in edited faces.
#[derive(Clone, Debug)]
pub(crate) struct Lips {
    lips: [Lip; 2],
}

impl Lips {
    /// Finds the lips by the names of their segments; `None` if the model has no such segments.
    pub(crate) fn find(segments: &Segments, triangles: &[[u32; 3]], mean: &[f64]) -> Option<Self> {
        let places = mean.as_chunks::<3>().0;
        let lip = |name: &str, up: f64| {
            let mask = segments.mask(&[segments.find(name)?], places.len());
            let is_own = |t: &&[u32; 3]| t.iter().all(|&v| mask[v as usize] > 0.0);
            let faces_other = |t: &&[u32; 3]| up * normal_y(places, t) < 0.0;
            let own: Vec<[u32; 3]> = triangles
                .iter()
                .filter(is_own)
                .filter(faces_other)
                .copied()
                .collect();
            let mut vertices = own.concat();
            vertices.sort_unstable();
            vertices.dedup();
            Some(Lip {
                triangles: own,
                vertices,
                up,
            })
        };
        Some(Self {
            lips: [lip("upper lip", 1.0)?, lip("lower lip", -1.0)?],
        })
    }

    /// Moves the lips of a shape apart where they would be in each other.
    pub(crate) fn separate(&self, neighbours: &VertexNeighbours, shape: &mut [f64]) {
        for _ in 0..ROUNDS {
            let places = shape.as_chunks::<3>().0;
            let [upper, lower] = &self.lips;
            let ways =
                [(upper, lower), (lower, upper)].map(|(own, other)| missing(places, own, other));
            if ways.iter().all(Vec::is_empty) {
                break;
            }
            for (lip, way) in self.lips.iter().zip(ways) {
                for (v, by) in spread(neighbours, way) {
                    shape[3 * v as usize + 1] += lip.up * by;
                }
            }
        }
    }
}

/// Returns the y component of a triangle's normal, not normalised.
fn normal_y(places: &[Place], t: &[u32; 3]) -> f64 {
    let [a, b, c] = t.map(|v| places[v as usize]);
    (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2])
}

/// Returns half of the missing clearance of each vertex of a lip from the other lip.
fn missing(places: &[Place], own: &Lip, other: &Lip) -> Vec<(u32, f64)> {
    let cells = Cells::from_triangles(places, &other.triangles);
    let one = |&v: &u32| {
        let p = places[v as usize];
        let heights = cells.triangles_at(p).filter_map(|t| height(places, t, p));
        // The part of the other lip nearest to this one at this position.
        let nearest = heights
            .map(|y| own.up * (y - p[1]) + GAP_M)
            .fold(f64::MIN, f64::max);
        (nearest > 1e-6 && nearest < MAX_DEPTH_M).then_some((v, nearest / 2.0))
    };
    own.vertices.iter().filter_map(one).collect()
}

/// Returns the height of a triangle at the x and z of a position; `None` outside the triangle.
fn height(places: &[Place], t: &[u32; 3], p: Place) -> Option<f64> {
    let [a, b, c] = t.map(|v| places[v as usize]);
    let cross = |o: Place, q: Place, r: Place| {
        (q[0] - o[0]) * (r[2] - o[2]) - (q[2] - o[2]) * (r[0] - o[0])
    };
    let all = cross(a, b, c);
    if all.abs() < 1e-14 {
        return None;
    }
    let shares = [cross(p, b, c), cross(a, p, c), cross(a, b, p)].map(|x| x / all);
    let is_in = shares.iter().all(|s| *s >= -1e-9);
    is_in.then(|| shares[0] * a[1] + shares[1] * b[1] + shares[2] * c[1])
}

/// Spreads displacements of vertices to their neighbours, with less at each step.
fn spread(neighbours: &VertexNeighbours, ways: Vec<(u32, f64)>) -> Vec<(u32, f64)> {
    let mut all = BTreeMap::from_iter(ways);
    let mut edge: Vec<u32> = all.keys().copied().collect();
    for _ in 0..STEPS {
        let mut next = BTreeMap::new();
        for v in &edge {
            let way = SHARE * all[v];
            for n in neighbours.of_vertex(*v as usize) {
                let known = all.get(n).copied().unwrap_or(0.0);
                if way > known + 1e-7 {
                    let most = next.entry(*n).or_insert(way);
                    *most = f64::max(*most, way);
                }
            }
        }
        edge = next.keys().copied().collect();
        all.extend(next);
    }
    all.into_iter().collect()
}

/// Triangles by the x-z grid cells that they cover, in the order of the cells.
struct Cells<'t> {
    cells: Vec<([i64; 2], &'t [u32; 3])>,
}

fn cell(x: f64) -> i64 {
    (x / CELL_M).floor() as i64
}

impl<'t> Cells<'t> {
    fn from_triangles(places: &[Place], triangles: &'t [[u32; 3]]) -> Self {
        let mut cells = Vec::with_capacity(2 * triangles.len());
        for t in triangles {
            let corners = t.map(|v| places[v as usize]);
            let range = |k: usize| {
                let all = corners.map(|p| cell(p[k]));
                all.into_iter().min().unwrap_or(0)..=all.into_iter().max().unwrap_or(0)
            };
            // A lip that was torn apart covers no cell.
            if range(0).count() > 20 || range(2).count() > 20 {
                continue;
            }
            for x in range(0) {
                cells.extend(range(2).map(|z| ([x, z], t)));
            }
        }
        cells.sort_by_key(|(cell, _)| *cell);
        Self { cells }
    }

    fn triangles_at(&self, p: Place) -> impl Iterator<Item = &'t [u32; 3]> {
        let own = [cell(p[0]), cell(p[2])];
        let first = self.cells.partition_point(|(cell, _)| *cell < own);
        let from = self.cells[first..].iter();
        from.take_while(move |(cell, _)| *cell == own)
            .map(|(_, t)| *t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::segment::Segment;

    const SIDE: u32 = 20;

    /// Returns two flat lips, 0.4 mm apart; the upper one comes second.
    fn lips() -> (Vec<f64>, Vec<[u32; 3]>, Segments) {
        let places = (0..2 * SIDE * SIDE).flat_map(|v| {
            let [x, z, lip] = [v % SIDE, v / SIDE % SIDE, v / (SIDE * SIDE)].map(f64::from);
            [1e-3 * x, 4e-4 * lip, 1e-3 * z]
        });
        let squares =
            (0..2 * SIDE * SIDE).filter(|v| v % SIDE + 1 < SIDE && v / SIDE % SIDE + 1 < SIDE);
        let triangles = squares.flat_map(|a| {
            let [b, c, d] = [a + 1, a + SIDE, a + SIDE + 1];
            let up = [[a, c, b], [b, c, d]];
            if a < SIDE * SIDE {
                up
            } else {
                up.map(|[a, b, c]| [a, c, b])
            }
        });
        let segment = |name: &str, first: u32| Segment {
            name: name.to_owned(),
            parent: None,
            runs: vec![[first, SIDE * SIDE]],
        };
        let all = vec![segment("lower lip", 0), segment("upper lip", SIDE * SIDE)];
        let segments = Segments::new(all, (2 * SIDE * SIDE) as usize).expect("lips");
        (places.collect(), triangles.collect(), segments)
    }

    #[test]
    fn lips_that_slide_into_each_other_part_and_others_stay() {
        let (mean, triangles, segments) = lips();
        let lips = Lips::find(&segments, &triangles, &mean).expect("both");
        let count = (SIDE * SIDE) as usize;
        let neighbours = VertexNeighbours::from_triangles(&triangles, 2 * count).expect("vertices");
        let mut shape = mean.clone();
        lips.separate(&neighbours, &mut shape);
        assert_eq!(shape, mean);
        // Half a square to the side and 2 mm too high.
        for v in 0..count {
            shape[3 * v] += 5e-4;
            shape[3 * v + 1] += 2e-3;
        }
        lips.separate(&neighbours, &mut shape);
        let middle = (SIDE / 2 * SIDE + SIDE / 2) as usize;
        let gap = shape[3 * (count + middle) + 1] - shape[3 * middle + 1];
        assert!(gap > 0.0, "{gap}");
        assert!(
            Lips::find(&Segments::default(), &triangles, &mean).is_none(),
            "a mesh without lip segments has no lips"
        );
    }
}
