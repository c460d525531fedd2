//! Brows and lashes: hairs on the skin, each a separate ribbon.

mod brow;
mod lash;
#[cfg(test)]
mod tests;

use raconteur_base::{DVec3, Side, noise};
use serde::{Deserialize, Serialize};

pub(crate) use self::brow::BrowLine;
use super::scalp_binding::{ScalpBinding, VertexWeights};
use crate::part::{MeshPart, PartVertex};
use raconteur_body::figure::{Material, MaterialKind, TextureMaps};

/// Parameters of the hairs of brows and lashes: colour, density, length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BrowParams {
    /// Colour of the brows, linear RGB; lashes are darker.
    pub colour: [f64; 3],
    /// Relative number of hairs in a brow, 0.3..1.6.
    pub density: f64,
    /// Length of its hairs against the usual, 0.5..2.
    pub length: f64,
    /// Height of the brow against the usual, 0.6..1.5.
    pub height: f64,
    /// Deviation of hairs from their direction, 0..1.
    pub unruly: f64,
    /// Difference between the two brows, 0..1.
    pub asymmetry: f64,
    /// Length of the lashes against the usual, 0.4..1.3.
    pub lash_length: f64,
    /// Lightness of the lashes against the brows.
    pub lash_tone: f64,
}

impl Default for BrowParams {
    fn default() -> Self {
        Self {
            colour: [0.11, 0.062, 0.038],
            density: 1.0,
            length: 1.0,
            height: 1.0,
            unruly: 0.35,
            asymmetry: 0.5,
            lash_length: 1.0,
            lash_tone: 0.35,
        }
    }
}

/// One hair of a brow or a lash, modelled as a ribbon.
struct Strand {
    /// Middle line from root to tip, mm.
    points: Vec<DVec3>,
    /// Half width at the root, mm.
    half_width: f64,
    /// Outward direction, which the ribbon faces.
    facing: DVec3,
    /// Factor of the colour.
    shade: f64,
    /// Share of the light behind it that the hair blocks, 0..1.
    cover: f64,
}

impl Strand {
    /// Returns the length of the middle line, mm.
    #[cfg(test)]
    fn length_mm(&self) -> f64 {
        self.points.windows(2).map(|w| w[0].distance(w[1])).sum()
    }
}

/// Seeded numbers of one hair.
struct StrandRandom {
    seed: u64,
    hair: u64,
    next: i64,
}

impl StrandRandom {
    fn unit(&mut self) -> f64 {
        self.next += 1;
        noise::unit(self.seed, self.hair, self.next)
    }

    fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    fn normal(&mut self) -> f64 {
        noise::normal(core::array::from_fn(|_| self.unit()))
    }
}

/// Movements of a hair below this are left out, metres.
const STILL: f64 = 1.2e-4;

/// Distance of texture coordinates 0 and 1 from the middle of a hair, mm. The hair shader derives
/// the width from it.
const REACH_MM: f64 = 0.5;

/// Builds a mesh of hairs; each hair follows the skin through the `near` nearest vertices at its
/// root.
fn build_mesh(
    name: String,
    strands: &[Strand],
    ride: &ScalpBinding,
    near: usize,
    color: [f64; 3],
) -> MeshPart {
    let mut part = MeshPart {
        name,
        material: Material {
            kind: MaterialKind::Lash,
            base_color: [1.0; 4],
            roughness: 0.55,
            double_sided: true,
            maps: TextureMaps::default(),
        },
        vertices: Vec::new(),
        faces: Vec::new(),
        morphs: Vec::new(),
        bound: Vec::new(),
    };
    let mut roots: Vec<VertexWeights> = Vec::new();
    for strand in strands {
        let holds = ride.nearest_vertices(strand.points[0] * 1e-3, near);
        append_ribbon(&mut part, strand, ride, &holds, color);
        roots.resize(part.vertices.len(), holds);
    }
    part.morphs = ride.morphs(&roots, STILL);
    part.bound = ride.bound(&roots);
    part
}

/// Adds the ribbon of one hair, which tapers to a single vertex.
fn append_ribbon(
    part: &mut MeshPart,
    strand: &Strand,
    ride: &ScalpBinding,
    holds: &VertexWeights,
    color: [f64; 3],
) {
    let base = part.vertices.len() as u32;
    let weights = ride.weights(holds);
    let [r, g, b] = color.map(|c| (c * strand.shade).clamp(0.0, 1.0));
    let last = strand.points.len() - 1;
    for (row, &middle) in strand.points.iter().enumerate() {
        let v = row as f64 / last as f64;
        let along = strand.points[(row + 1).min(last)] - strand.points[row.max(1) - 1];
        let across = along.cross(strand.facing).normalize();
        let half_width = strand.half_width * (1.0 - 0.6 * v * v);
        let sides: &[f64] = if row < last { &[-1.0, 1.0] } else { &[0.0] };
        for side in sides {
            let aside_mm = side * half_width;
            part.vertices.push(PartVertex {
                position: (middle + across * aside_mm) * 1e-3,
                uv: [0.5 + 0.5 * aside_mm / REACH_MM, v],
                color: [r, g, b, strand.cover],
                weights: weights.clone(),
            });
        }
    }
    let quads = last as u32 - 1;
    for q in 0..quads {
        let a = base + 2 * q;
        part.faces.push(vec![a, a + 1, a + 3, a + 2]);
    }
    let a = base + 2 * quads;
    part.faces.push(vec![a, a + 1, a + 2]);
}

fn letter(side: Side) -> &'static str {
    if side == Side::Left { "left" } else { "right" }
}

/// Builds the brow of one side as a mesh part.
pub(crate) fn brow(
    ride: &ScalpBinding,
    line: &BrowLine,
    side: Side,
    seed: u64,
    p: &BrowParams,
) -> MeshPart {
    let brow = brow::brow(ride, line, side, seed, p);
    let name = format!("brow_{}", letter(side));
    build_mesh(name, &brow, ride, 3, p.colour)
}

/// Builds the lashes of one side as a mesh part. `edges` are the lash edges of the upper and the
/// lower lid from the inner to the outer corner.
pub(crate) fn lashes(
    ride: &ScalpBinding,
    edges: &[Vec<DVec3>; 2],
    globe: DVec3,
    side: Side,
    seed: u64,
    p: &BrowParams,
) -> MeshPart {
    let mut lashes = lash::lashes(&edges[0], globe, lash::Row::Upper, side, seed, p);
    lashes.extend(lash::lashes(
        &edges[1],
        globe,
        lash::Row::Lower,
        side,
        seed,
        p,
    ));
    let lash_color = p.colour.map(|c| c * p.lash_tone);
    let name = format!("lash_{}", letter(side));
    build_mesh(name, &lashes, ride, 2, lash_color)
}
