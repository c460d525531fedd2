//! Solver that puts the limit surface of the cage through given points and fairs the rest: one
//! sparse least-squares problem, solved twice because fairness is scaled by lengths that follow
//! from the first solution.

use raconteur_base::{DVec3, Side};

use super::cage::{Cage, Key, Points};
use crate::least_squares::{Terms, least_squares};
use crate::subdivide::{Stencil, limit_stencils};

/// Solved cage (coarse control mesh) of a head, and the stencils of its limit surface.
#[derive(Clone, Debug)]
pub(crate) struct Solved {
    /// Cage vertices, mm.
    pub(crate) cage_points: Vec<DVec3>,
    /// Limit position of each cage vertex as a stencil over the cage.
    pub(crate) limit: Vec<Stencil>,
}

impl Solved {
    /// Returns the limit position of a cage vertex for any positions of the cage, mm.
    pub(crate) fn limit_of(&self, v: usize, cage_points: &[DVec3]) -> DVec3 {
        self.limit[v]
            .iter()
            .map(|&(i, w)| cage_points[i as usize] * w)
            .sum()
    }
}

const ROUNDS: usize = 2;
const TWIST: f64 = 0.7;

/// Returns the weight of a bound point against fairness. Designed: lids and lips are exact.
fn weight(key: Key) -> f64 {
    match key {
        Key::Eye(5.., _) | Key::Mouth(4.., _) => 30.0,
        _ => 9.0,
    }
}

/// Neighbourhoods of the cage from which the fairness equations are built, computed once.
pub(crate) struct Fairness {
    neighbours: Vec<Vec<u32>>,
    /// Pairs of opposite neighbours at regular and rim vertices; `None` at poles.
    pairs: Vec<Option<Vec<[u32; 2]>>>,
    quads: Vec<[u32; 4]>,
}

impl Fairness {
    pub(crate) fn new(faces: &[Vec<u32>], vertex_count: usize) -> Self {
        let edges = crate::subdivide::edge_faces(faces);
        let mut neighbours = vec![Vec::new(); vertex_count];
        let mut rim = vec![Vec::new(); vertex_count];
        let mut around = vec![Vec::new(); vertex_count];
        for (&(a, b), sides) in &edges {
            for (v, u) in [(a, b), (b, a)] {
                neighbours[v as usize].push(u);
                if sides.len() == 1 {
                    rim[v as usize].push(u);
                }
            }
        }
        for (f, face) in faces.iter().enumerate() {
            for &v in face {
                around[v as usize].push(f);
            }
        }
        let pairs = (0..vertex_count)
            .map(|v| {
                if !rim[v].is_empty() {
                    return Some(match rim[v][..] {
                        [a, b] => vec![[a, b]],
                        _ => Vec::new(),
                    });
                }
                let around_v: &[u32] = &neighbours[v];
                let &[a, ..] = around_v else { return None };
                if around_v.len() != 4 {
                    return None;
                }
                let beside = |u: u32| {
                    around[v]
                        .iter()
                        .any(|&f: &usize| faces[f].contains(&a) && faces[f].contains(&u))
                };
                let (far, near): (Vec<u32>, Vec<u32>) =
                    around_v[1..].iter().partition(|&&u| !beside(u));
                Some(match (&far[..], &near[..]) {
                    (&[o], &[p, q]) => vec![[a, o], [p, q]],
                    _ => Vec::new(),
                })
            })
            .collect();
        let quads = faces
            .iter()
            .filter_map(|f| <[u32; 4]>::try_from(&f[..]).ok())
            .collect();
        Self {
            neighbours,
            pairs,
            quads,
        }
    }

    /// Returns the fairness equations: second differences along both grid directions, Laplacians at
    /// poles, the twist of every quad. With `points` they are scaled to curvature times the square
    /// root of area; otherwise dense rows bend too cheaply.
    pub(crate) fn rows(&self, points: Option<&[DVec3]>) -> Vec<Terms> {
        let length =
            |v: usize, u: u32| points.map_or(1.0, |p| (p[u as usize] - p[v]).length().max(0.3));
        let mut rows = Vec::new();
        for (v, pairs) in self.pairs.iter().enumerate() {
            let near = &self.neighbours[v];
            let mean = near.iter().map(|&u| length(v, u)).sum::<f64>() / near.len() as f64;
            let scale = |a: f64, b: f64| match points {
                None => 1.0,
                Some(_) => (6.0 * (mean * mean).max(0.1).sqrt() / (a * b)).clamp(0.25, 6.0),
            };
            if let Some(pairs) = pairs {
                for &[a, b] in pairs {
                    let (da, db) = (length(v, a), length(v, b));
                    let q = scale(da, db);
                    let share = db / (da + db);
                    rows.push(vec![(a, share * q), (b, (1.0 - share) * q), (v as u32, -q)]);
                }
            } else {
                let q = scale(mean, mean);
                let sum: f64 = near.iter().map(|&u| 1.0 / length(v, u)).sum();
                let mut row: Terms = near
                    .iter()
                    .map(|&u| (u, q / (length(v, u) * sum)))
                    .collect();
                row.push((v as u32, -q));
                rows.push(row);
            }
        }
        for &[a, b, c, d] in &self.quads {
            rows.push(vec![(a, TWIST), (b, -TWIST), (c, TWIST), (d, -TWIST)]);
        }
        rows
    }
}

/// Solves the cage for the points of the left half, mirrored.
///
/// # Panics
/// Panics if the normal equations are singular. The fixed topology and table rule that out.
#[allow(
    clippy::expect_used,
    reason = "depends on the built-in topology and table only"
)]
pub(crate) fn solve(cage: &Cage, points: &Points) -> Solved {
    let n = cage.len();
    let fairness = Fairness::new(&cage.faces, n);
    let mut solved = Solved {
        cage_points: Vec::new(),
        limit: limit_stencils(&cage.faces, n),
    };
    let rows: Vec<(Terms, DVec3)> = cage
        .keys
        .iter()
        .enumerate()
        .filter_map(|(v, &(key, side))| {
            let mut p = *points.get(&key)?;
            if key.on_midline() {
                p.x = 0.0;
            }
            p.x *= side.sign();
            let w = weight(key);
            let row = solved.limit[v].iter().map(|&(i, s)| (i, s * w)).collect();
            Some((row, p * w))
        })
        .collect();
    for round in 0..ROUNDS {
        let known = (round > 0).then_some(&solved.cage_points[..]);
        let fair = fairness.rows(known);
        solved.cage_points = least_squares(n, &rows, &fair).expect("a positive definite system");
        symmetrise(cage, &mut solved.cage_points);
    }
    solved
}

/// Removes the rounding by which the halves differ.
fn symmetrise(cage: &Cage, points: &mut [DVec3]) {
    for (v, &(key, side)) in cage.keys.iter().enumerate() {
        if key.on_midline() {
            points[v].x = 0.0;
        } else if side == Side::Left {
            let other = cage.vertex(key, Side::Right);
            let mean = (points[v] + raconteur_base::mirror_vector(points[other])) / 2.0;
            points[v] = mean;
            points[other] = raconteur_base::mirror_vector(mean);
        }
    }
}
