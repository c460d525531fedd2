//! Blending at the borders of segments: wide for coarse form and narrow for fine, after Burt and
//! Adelson 1983 (doi:10.1145/245.247), on a mesh instead of an image.
//!
//! A difference between two faces is split into bands: the part removed by a mean over neighbours,
//! and again from the remainder. Each band is masked by a weight smoothed according to its
//! coarseness, and the bands are added.

use core::cmp::Reverse;
use std::collections::BinaryHeap;

/// Adjacency lists of a mesh: the neighbours of each vertex; used to smooth masks and differences.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VertexNeighbours {
    /// Start of each vertex's neighbours in `list`; one entry more than there are vertices.
    starts: Vec<u32>,
    list: Vec<u32>,
}

/// Steps of smoothing between bands: each band is about twice as coarse as the last. Vertices of a
/// face are some 3 mm apart, and so the borders 4, 8 and 16 mm wide.
const STEPS: [usize; 3] = [2, 8, 32];

impl VertexNeighbours {
    /// Builds the adjacency from triangles over a number of vertices; `None` if a triangle index is
    /// out of range.
    #[must_use]
    pub fn from_triangles(triangles: &[[u32; 3]], vertices: usize) -> Option<Self> {
        if triangles.iter().flatten().any(|&v| v as usize >= vertices) {
            return None;
        }
        let edges = triangles
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, a], [b, c], [c, b], [c, a], [a, c]]);
        Some(Self::of_edges(edges.collect(), vertices))
    }

    /// Builds the adjacency from edges, each listed once in either direction; all indices must be
    /// in range.
    pub(crate) fn of_edges(mut edges: Vec<[u32; 2]>, vertices: usize) -> Self {
        edges.sort_unstable();
        edges.dedup();
        let mut starts = vec![0; vertices + 1];
        for [from, _] in &edges {
            starts[*from as usize + 1] += 1;
        }
        for i in 0..vertices {
            starts[i + 1] += starts[i];
        }
        Self {
            starts,
            list: edges.into_iter().map(|[_, to]| to).collect(),
        }
    }

    pub(crate) fn of_vertex(&self, vertex: usize) -> &[u32] {
        &self.list[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }

    /// Smooths values at each vertex for a number of steps: half the value, plus half the mean of
    /// its neighbours.
    fn smoothed<const WIDTH: usize>(&self, numbers: &[f64], steps: usize) -> Vec<f64> {
        let mut out = numbers.to_vec();
        let mut before = out.clone();
        for _ in 0..steps {
            core::mem::swap(&mut out, &mut before);
            let from = before.as_chunks::<WIDTH>().0;
            for (vertex, to) in out.as_chunks_mut::<WIDTH>().0.iter_mut().enumerate() {
                let near = self.of_vertex(vertex);
                let own = from[vertex];
                *to = own;
                if near.is_empty() {
                    continue;
                }
                let mut sum = [0.0; WIDTH];
                for &n in near {
                    for (s, x) in sum.iter_mut().zip(from[n as usize]) {
                        *s += x;
                    }
                }
                let share = 0.5 / near.len() as f64;
                for ((to, own), s) in to.iter_mut().zip(own).zip(sum) {
                    *to = 0.5 * own + share * s;
                }
            }
        }
        out
    }

    /// Returns the number of vertices in the mesh.
    #[must_use]
    pub fn vertices(&self) -> usize {
        self.starts.len() - 1
    }

    /// Returns a mask with borders softened for each frequency band, wider for coarser bands.
    ///
    /// # Panics
    /// Panics if the mask does not match these vertices.
    #[must_use]
    pub fn softened(&self, mask: &[f64]) -> SoftMask {
        assert_eq!(mask.len(), self.vertices(), "a mask of these vertices");
        let mut soft = mask.to_vec();
        let mut done = 0;
        let band = |steps: usize| {
            soft = self.smoothed::<1>(&soft, steps - done);
            done = steps;
            soft.clone()
        };
        SoftMask(STEPS.into_iter().map(band).collect())
    }

    /// Applies a mask to a difference, three numbers at each vertex: full where the mask is 1,
    /// blended out around it. Vertices farther from the mask than the number of steps, in edges,
    /// get nothing.
    ///
    /// # Panics
    /// Panics if the mask or the difference does not match these vertices.
    #[must_use]
    pub fn blended(&self, difference: &[f64], mask: &SoftMask) -> Vec<f64> {
        assert_eq!(
            difference.len(),
            3 * self.vertices(),
            "a difference of these vertices"
        );
        let mut sum = vec![0.0; difference.len()];
        let mut rest = difference.to_vec();
        for (band, (steps, soft)) in STEPS.into_iter().zip(&mask.0).enumerate() {
            let is_last = band + 1 == STEPS.len();
            let coarse = if is_last {
                vec![0.0; rest.len()]
            } else {
                self.smoothed::<3>(&rest, steps)
            };
            for (vertex, share) in soft.iter().enumerate() {
                for k in 3 * vertex..3 * vertex + 3 {
                    sum[k] += share * (rest[k] - coarse[k]);
                }
            }
            rest = coarse;
        }
        sum
    }

    /// Returns the part of the values, three at each vertex, that averaging over neighbours
    /// removes: detail finer than about 5 mm.
    #[must_use]
    pub fn detail(&self, numbers: &[f64]) -> Vec<f64> {
        let smooth = self.smoothed::<3>(numbers, STEPS[0]);
        numbers.iter().zip(&smooth).map(|(x, s)| x - s).collect()
    }
}

impl VertexNeighbours {
    /// Returns the distance of each vertex from the masked vertices along edges, in the unit of the
    /// positions, clamped to `most`.
    pub(crate) fn distances(&self, places: &[[f64; 3]], mask: &[f64], most: f64) -> Vec<f64> {
        // Distances that are not negative have the order of their bits.
        let mut found = vec![most; places.len()];
        let mut next = BinaryHeap::new();
        for (v, _) in (0u32..).zip(mask).filter(|(_, share)| **share > 0.0) {
            found[v as usize] = 0.0;
            next.push(Reverse((0u64, v)));
        }
        while let Some(Reverse((bits, v))) = next.pop() {
            let so_far = f64::from_bits(bits);
            if so_far > found[v as usize] {
                continue;
            }
            for &n in self.of_vertex(v as usize) {
                let (a, b) = (&places[v as usize], &places[n as usize]);
                let square: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
                let far = so_far + square.sqrt();
                if far < found[n as usize] {
                    found[n as usize] = far;
                    next.push(Reverse((far.to_bits(), n)));
                }
            }
        }
        found
    }
}

/// Mask over vertices, softened separately for each frequency band; limits a change of a face to
/// segments.
#[derive(Clone, Debug, PartialEq)]
pub struct SoftMask(Vec<Vec<f64>>);

impl SoftMask {
    /// Scales the mask at each vertex by a share.
    pub(crate) fn lessen(&mut self, shares: &[f64]) {
        for band in &mut self.0 {
            for (x, share) in band.iter_mut().zip(shares) {
                *x *= share;
            }
        }
    }

    /// Returns the weight of the coarse form at a vertex, 0 to 1.
    #[must_use]
    pub fn weight(&self, vertex: usize) -> f64 {
        let coarsest = self.0.last().and_then(|band| band.get(vertex));
        coarsest.copied().unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use raconteur_base::noise;

    use super::*;

    const SIDE: usize = 120;

    /// Returns the adjacency of a square grid of triangles, for tests.
    fn grid() -> VertexNeighbours {
        let at = |x: usize, y: usize| (y * SIDE + x) as u32;
        let squares = (0..SIDE - 1).flat_map(|y| (0..SIDE - 1).map(move |x| (x, y)));
        let triangles: Vec<[u32; 3]> = squares
            .flat_map(|(x, y)| {
                let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)];
                [[a, b, c], [b, d, c]]
            })
            .collect();
        VertexNeighbours::from_triangles(&triangles, SIDE * SIDE).expect("vertices")
    }

    fn disc(radius: f64) -> Vec<f64> {
        let middle = SIDE as f64 / 2.0;
        (0..SIDE * SIDE)
            .map(|v| {
                let [x, y] = [v % SIDE, v / SIDE].map(|n| n as f64 - middle);
                f64::from(u8::from((x * x + y * y).sqrt() < radius))
            })
            .collect()
    }

    #[test]
    fn all_of_a_difference_is_let_in_by_the_whole_and_nothing_by_none() {
        let grid = grid();
        let difference: Vec<f64> = (0..3 * SIDE as i64 * SIDE as i64)
            .map(|i| noise::signed(1, 2, i))
            .collect();
        let all = grid.blended(&difference, &grid.softened(&[1.0; SIDE * SIDE]));
        assert!(
            all.iter()
                .zip(&difference)
                .all(|(a, b)| (a - b).abs() < 1e-12),
            "a weight of 1 keeps the whole difference"
        );
        let none = grid.blended(&difference, &grid.softened(&[0.0; SIDE * SIDE]));
        assert!(
            none.iter().all(|x| *x == 0.0),
            "a weight of 0 keeps no difference"
        );
    }

    #[test]
    fn the_middle_is_changed_the_far_is_not_and_the_border_has_no_step() {
        let grid = grid();
        let difference = vec![1.0; 3 * SIDE * SIDE];
        let blended = grid.blended(&difference, &grid.softened(&disc(30.0)));
        let along = |x: usize| blended[3 * (SIDE / 2 * SIDE + x)];
        assert!((along(SIDE / 2) - 1.0).abs() < 0.01, "{}", along(SIDE / 2));
        assert!(along(5).abs() < 0.01, "{}", along(5));
        let steepest = (1..SIDE)
            .map(|x| (along(x) - along(x - 1)).abs())
            .fold(0.0, f64::max);
        assert!(steepest < 0.15, "{steepest}");
    }

    #[test]
    fn fine_form_is_cut_off_sooner_than_coarse() {
        let grid = grid();
        let mask = disc(30.0);
        let share = |wave: f64| {
            let difference: Vec<f64> = (0..SIDE * SIDE)
                .flat_map(|v| {
                    // A saw of this length.
                    [2.0 * ((v % SIDE) as f64 / wave).fract() - 1.0, 0.0, 0.0]
                })
                .collect();
            let blended = grid.blended(&difference, &grid.softened(&mask));
            // In the ring just outside the mask.
            let ring = (0..SIDE * SIDE).filter(|v| {
                let [x, y] = [v % SIDE, v / SIDE].map(|n| n as f64 - SIDE as f64 / 2.0);
                (33.0..38.0).contains(&(x * x + y * y).sqrt())
            });
            let [got, all] = ring.fold([0.0; 2], |[got, all], v| {
                let own = difference[3 * v];
                [got + blended[3 * v].powi(2), all + own * own]
            });
            (got / all).sqrt()
        };
        assert!(share(3.0) < share(80.0), "{} {}", share(3.0), share(80.0));
    }

    #[test]
    fn triangles_of_other_vertices_are_refused() {
        assert_eq!(VertexNeighbours::from_triangles(&[[0, 1, 3]], 3), None);
        assert_eq!(
            VertexNeighbours::from_triangles(&[], 2)
                .expect("none")
                .vertices(),
            2
        );
    }
}
