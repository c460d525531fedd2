//! Hair that penetrates skin or clothes, measured on the rendered meshes.

use std::collections::HashMap;

use raconteur_base::{DAffine3, DVec3};
use raconteur_body::figure::{Figure, MaterialKind, Mesh};
use raconteur_body::surface::lies_under;

use super::Check;

/// Sampling rate, hertz.
pub(super) const RATE_HZ: f64 = 4.0;
/// Thinning: one hair vertex in this many is checked.
const THINNED: usize = 3;
/// Share of a strip next to its root that is not checked, since roots are in the skin.
const ROOTED: f32 = 0.3;
/// Surface farther than this from all hair is not looked at, and cells of the surface, metres.
const NEAR_M: f64 = 0.12;
const CELL_M: f64 = 0.02;
/// Hair this deep is through, metres: cards are flat between their rows, and so is the surface.
const THROUGH_M: f64 = 0.005;

/// Maximum share of penetrating hair, percent: chains avoid their colliders, but where a raised
/// shoulder lifts long hair, cards between two chains go under its surface, invisibly.
const MAX_THROUGH: f64 = 8.0;

/// A vertex: its mesh in the figure and its number there.
type Vertex = (usize, usize);

type Cell = [i64; 3];

fn cell(p: DVec3) -> Cell {
    (p / CELL_M).floor().to_array().map(|x| x as i64)
}

fn about([x, y, z]: Cell) -> impl Iterator<Item = Cell> {
    (0..27).map(move |i| [x + i / 9 - 1, y + i / 3 % 3 - 1, z + i % 3 - 1])
}

/// Check for hair that penetrates skin or clothes: hair vertices and the surfaces around them.
pub(super) struct HairSweep<'a> {
    figure: &'a Figure,
    hair: Vec<Vertex>,
    surface: Vec<Vertex>,
    check: Check,
}

impl<'a> HairSweep<'a> {
    /// Creates the check; `None` if there is no swinging hair.
    pub(super) fn new(figure: &'a Figure) -> Option<Self> {
        if figure.springs.is_empty() {
            return None;
        }
        let of = |wanted: fn(MaterialKind) -> bool| {
            let meshes = figure.meshes.iter().enumerate();
            meshes.filter(move |(_, m)| wanted(m.material.kind))
        };
        let hair: Vec<Vertex> = of(|k| k == MaterialKind::Hair)
            .flat_map(|(number, m)| {
                let far = (0..m.positions.len()).filter(|&i| m.uvs[i][1] > ROOTED);
                far.step_by(THINNED).map(move |i| (number, i))
            })
            .collect();
        let bound = |(mesh, i): Vertex| bound(&figure.meshes[mesh], i);
        let coarse = |p: DVec3| cell(p * (CELL_M / NEAR_M));
        let near = sorted(hair.iter().map(|v| bound(*v)[0]), coarse);
        let is_near = |p: DVec3| {
            let mut cells = about(coarse(p)).filter_map(|c| near.get(&c)).flatten();
            cells.any(|&i| bound(hair[i])[0].distance(p) < NEAR_M)
        };
        let surface: Vec<Vertex> = of(MaterialKind::stops_hair)
            .flat_map(|(number, m)| (0..m.positions.len()).map(move |i| (number, i)))
            .filter(|v| is_near(bound(*v)[0]))
            .collect();
        let cells = sorted(surface.iter().map(|v| bound(*v)[0]), cell);
        let is_seen = |v: &Vertex| {
            let p = bound(*v);
            let mut others = about(cell(p[0])).filter_map(|c| cells.get(&c)).flatten();
            !others.any(|&i| lies_under(p, bound(surface[i])))
        };
        Some(Self {
            figure,
            surface: surface.iter().copied().filter(is_seen).collect(),
            hair,
            check: Check::new("hair-through", MAX_THROUGH, "%"),
        })
    }

    pub(super) fn check(self) -> Check {
        self.check
    }

    /// Measures a frame.
    pub(super) fn measure(&mut self, world_from_joint: &[DAffine3], t: f64) {
        let binds = world_from_joint.iter().zip(&self.figure.inverse_bind);
        let moved: Vec<DAffine3> = binds.map(|(w, b)| *w * *b).collect();
        let drawn = |&(mesh, i): &Vertex| self.figure.meshes[mesh].skinned(&moved, i);
        let surface: Vec<[DVec3; 2]> = self.surface.iter().map(drawn).collect();
        let cells = sorted(surface.iter().map(|s| s[0]), cell);
        let is_through = |v: &&Vertex| {
            let [p, _] = drawn(v);
            let candidates = about(cell(p)).filter_map(|c| cells.get(&c)).flatten();
            let nearest = candidates
                .map(|&i| (surface[i][0].distance_squared(p), i))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            nearest.is_some_and(|(_, i)| {
                let [q, normal] = surface[i];
                (p - q).dot(normal) < -THROUGH_M
            })
        };
        let through = self.hair.iter().filter(is_through).count();
        let share = 100.0 * through as f64 / self.hair.len().max(1) as f64;
        self.check.measure(share, "hair", t);
    }
}

/// Returns a vertex of the file: position and normal.
fn bound(mesh: &Mesh, i: usize) -> [DVec3; 2] {
    [mesh.positions[i], mesh.normals[i]].map(|v| DVec3::from_array(v.map(f64::from)))
}

/// Returns the indices of points by their cells.
fn sorted(
    places: impl Iterator<Item = DVec3>,
    cell: impl Fn(DVec3) -> Cell,
) -> HashMap<Cell, Vec<usize>> {
    let mut cells: HashMap<Cell, Vec<usize>> = HashMap::new();
    for (i, p) in places.enumerate() {
        cells.entry(cell(p)).or_default().push(i);
    }
    cells
}
