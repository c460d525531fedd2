//! Whether hair goes through skin or clothes, measured on the drawn meshes.

use std::collections::HashMap;

use raconteur_base::{DAffine3, DVec3};
use raconteur_body::figure::{Figure, MaterialKind, Mesh};

use super::Check;

/// Looks a second.
pub(super) const RATE_HZ: f64 = 4.0;
/// One vertex of hair in so many is looked at.
const THINNED: usize = 3;
/// Roots are in the skin: what is nearer to its root than this share of its strip is not looked at.
const ROOTED: f32 = 0.3;
/// Surface farther than this from all hair is not looked at, and cells of the surface, metres.
const NEAR_M: f64 = 0.12;
const CELL_M: f64 = 0.02;
/// Surface that lies at most so far under another, and beside it, is not seen, metres.
const UNDER_M: [f64; 2] = [0.03, 0.008];
/// Hair this deep is through, metres: cards are flat between their rows, and so is the surface.
const THROUGH_M: f64 = 0.005;

/// Share of hair that may be through, percent: chains pass round what they meet, but where a raised
/// shoulder lifts long hair, cards between two chains go under its surface, out of sight.
const MOST_THROUGH: f64 = 8.0;

/// A vertex with its joints.
struct Skinned {
    at: DVec3,
    normal: DVec3,
    joints: [(usize, f64); 4],
}

impl Skinned {
    fn of(mesh: &Mesh, i: usize) -> Self {
        let wide = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
        Self {
            at: wide(mesh.positions[i]),
            normal: wide(mesh.normals[i]),
            joints: core::array::from_fn(|k| {
                (
                    usize::from(mesh.joints[i][k]),
                    f64::from(mesh.weights[i][k]),
                )
            }),
        }
    }

    /// Where it is drawn, and its normal.
    fn drawn(&self, moved: &[DAffine3]) -> (DVec3, DVec3) {
        let (mut at, mut normal) = (DVec3::ZERO, DVec3::ZERO);
        for (joint, weight) in self.joints.iter().filter(|j| j.1 > 0.0) {
            at += moved[*joint].transform_point3(self.at) * *weight;
            normal += moved[*joint].transform_vector3(self.normal) * *weight;
        }
        (at, normal.normalize_or(DVec3::Y))
    }
}

type Cell = [i64; 3];

fn cell(p: DVec3) -> Cell {
    (p / CELL_M).floor().to_array().map(|x| x as i64)
}

fn about([x, y, z]: Cell) -> impl Iterator<Item = Cell> {
    (0..27).map(move |i| [x + i / 9 - 1, y + i / 3 % 3 - 1, z + i % 3 - 1])
}

/// Hair and what it may not go through.
pub(super) struct HairSweep {
    hair: Vec<Skinned>,
    surface: Vec<Skinned>,
    bind: Vec<DAffine3>,
    check: Check,
}

impl HairSweep {
    /// None where no hair swings.
    pub(super) fn new(figure: &Figure) -> Option<Self> {
        if figure.springs.is_empty() {
            return None;
        }
        use MaterialKind::{Cornea, Eye, Hair, Lash, Mouth, Teeth};
        let hair = figure.meshes.iter().filter(|m| m.material.kind == Hair);
        let hair: Vec<Skinned> = hair
            .flat_map(|m| {
                let far = (0..m.positions.len()).filter(|&i| m.uvs[i][1] > ROOTED);
                far.step_by(THINNED).map(|i| Skinned::of(m, i))
            })
            .collect();
        let mut near: HashMap<Cell, Vec<DVec3>> = HashMap::new();
        let coarse = |p: DVec3| cell(p * (CELL_M / NEAR_M));
        for h in &hair {
            near.entry(coarse(h.at)).or_default().push(h.at);
        }
        let is_near = |p: DVec3| {
            let mut cells = about(coarse(p)).filter_map(|c| near.get(&c));
            cells.any(|c| c.iter().any(|q| q.distance(p) < NEAR_M))
        };
        let solid =
            |m: &&Mesh| !matches!(m.material.kind, Cornea | Eye | Hair | Lash | Mouth | Teeth);
        let surface = figure.meshes.iter().filter(solid).flat_map(|m| {
            (0..m.positions.len())
                .map(|i| Skinned::of(m, i))
                .filter(|v| is_near(v.at))
        });
        Some(Self {
            hair,
            surface: seen(surface.collect()),
            bind: figure.inverse_bind.clone(),
            check: Check::new("hair-through", MOST_THROUGH, "%"),
        })
    }

    pub(super) fn check(self) -> Check {
        self.check
    }

    /// Measures a frame.
    pub(super) fn look(&mut self, world_from_joint: &[DAffine3], t: f64) {
        let moved: Vec<DAffine3> = world_from_joint
            .iter()
            .zip(&self.bind)
            .map(|(w, b)| *w * *b)
            .collect();
        let drawn: Vec<(DVec3, DVec3)> = self.surface.iter().map(|s| s.drawn(&moved)).collect();
        let mut cells: HashMap<Cell, Vec<usize>> = HashMap::new();
        for (i, (p, _)) in drawn.iter().enumerate() {
            cells.entry(cell(*p)).or_default().push(i);
        }
        let is_through = |v: &&Skinned| {
            let (p, _) = v.drawn(&moved);
            let candidates = about(cell(p)).filter_map(|c| cells.get(&c)).flatten();
            let nearest = candidates
                .map(|&i| (drawn[i].0.distance_squared(p), i))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            nearest.is_some_and(|(_, i)| {
                let (q, normal) = drawn[i];
                (p - q).dot(normal) < -THROUGH_M
            })
        };
        let through = self.hair.iter().filter(is_through).count();
        let share = 100.0 * through as f64 / self.hair.len().max(1) as f64;
        self.check.measure(share, "hair", t);
    }
}

/// What no other surface covers.
fn seen(all: Vec<Skinned>) -> Vec<Skinned> {
    let mut cells: HashMap<Cell, Vec<usize>> = HashMap::new();
    for (i, v) in all.iter().enumerate() {
        cells.entry(cell(v.at)).or_default().push(i);
    }
    let covers = |p: &Skinned, q: &Skinned| {
        let off = q.at - p.at;
        let up = off.dot(p.normal);
        up > 0.001
            && up < UNDER_M[0]
            && q.normal.dot(p.normal) > 0.3
            && (off - p.normal * up).length() < UNDER_M[1]
    };
    let covered: Vec<bool> = all
        .iter()
        .map(|p| {
            let near = about(cell(p.at)).filter_map(|c| cells.get(&c)).flatten();
            near.into_iter().any(|&q| covers(p, &all[q]))
        })
        .collect();
    let mut is_covered = covered.into_iter();
    all.into_iter()
        .filter(|_| is_covered.next() == Some(false))
        .collect()
}
