//! Levels of detail: coarser triangles over the existing vertices of a figure's meshes.
//!
//! The simplifier is meshoptimizer's (edge collapses by quadric error, Garland & Heckbert 1997, DOI
//! 10.1145/258734.258849, with attributes after Hoppe 1999). Vertices stay in place, so that
//! skinning, morph targets and tissue move all levels alike. Lips, lids and the other borders of
//! the skin are preserved completely: they must meet on every level.

mod cards;

use std::collections::HashMap;

use meshopt::{
    SimplifyOptions, VertexDataAdapter, optimize_vertex_cache, simplify_with_attributes_and_locks,
};
use raconteur_base::curve::smooth;
use raconteur_base::{DVec3, noise};
use raconteur_body::annotation::Annotations;
use raconteur_body::figure::{Figure, MaterialKind, Mesh};
use raconteur_body::skeleton::Drive;

use crate::cells::Cells;

/// Returns the share of a mesh's free triangles at each coarser level: about 40,000 and 16,000 of
/// the 106,000 of a whole figure. Faces keep more than shoes.
fn shares(kind: MaterialKind) -> [f64; 2] {
    match kind {
        MaterialKind::Skin => [0.36, 0.11],
        MaterialKind::Teeth => [0.7, 0.55],
        MaterialKind::Mouth => [0.4, 0.12],
        MaterialKind::Eye | MaterialKind::Cornea => [0.5, 0.2],
        MaterialKind::Lash => [0.8, 0.3],
        MaterialKind::Nail | MaterialKind::Leather => [0.4, 0.12],
        MaterialKind::Cloth | MaterialKind::Rib | MaterialKind::Fleece => [0.5, 0.15],
        _ => [0.4, 0.14],
    }
}

/// Triangle count below which meshes are not simplified at any level.
const WORTH_TRIANGLES: usize = 400;

/// Weight of an error at the centre of mouth and eyes relative to elsewhere.
const FOCUS: f64 = 5.0;

/// Maximum simplification error, metres.
const MAX_ERROR_M: f32 = 0.02;

/// Number of vertex attributes that the simplifier weighs in addition to the position.
const ATTRIBUTES: usize = 13;

/// Weights of a difference of 1 in each attribute, metres: the normal, the position times the local
/// error weight, the joints, colour and occlusion, the texture coordinates.
const ATTRIBUTE_ERROR_M: [f32; ATTRIBUTES] = [
    0.0015, 0.0015, 0.0015, 1.0, 1.0, 1.0, 0.06, 0.06, 0.06, 0.003, 0.01, 0.003, 0.003,
];

/// Distance within which layers of cloth touch, metres.
const TOUCHING_M: f64 = 0.008;

/// Weight of the upper lid's joint above which a vertex is kept: the lid is folded when open, and
/// must be round when closed.
const LID_WEIGHT: f32 = 0.5;

/// Seed of the random directions that represent joints.
const JOINT_SEED: u64 = 17;

/// Sphere in which errors are most visible.
struct Focus {
    centre: DVec3,
    radius_m: f64,
}

impl Focus {
    /// Returns the focus areas of a face, which keep more triangles: the mouth and both eyes,
    /// located by landmarks.
    fn of_face(figure: &Figure, annotations: &Annotations) -> Vec<Self> {
        let at = |name: &str| {
            let landmark = annotations.landmarks.iter().find(|l| l.name == name)?;
            let position = figure.meshes[landmark.mesh].positions[landmark.vertex as usize];
            Some(DVec3::from_array(position.map(f64::from)))
        };
        let around = |a: &str, b: &str| {
            let (a, b) = (at(a)?, at(b)?);
            Some(Self {
                centre: (a + b) * 0.5,
                radius_m: a.distance(b),
            })
        };
        [("ch_l", "ch_r"), ("ex_l", "en_l"), ("ex_r", "en_r")]
            .into_iter()
            .filter_map(|(a, b)| around(a, b))
            .collect()
    }

    /// Returns the weight of an error at a position, 0 outside.
    fn weight(&self, p: DVec3) -> f64 {
        FOCUS * smooth(2.0 * (1.0 - p.distance(self.centre) / self.radius_m))
    }
}

/// The joints of the upper lids.
struct Lids(Vec<u16>);

impl Lids {
    fn from_figure(figure: &Figure) -> Self {
        let joints = (0u16..).zip(figure.skeleton.joints());
        let lids = joints.filter(|(_, j)| matches!(j.drive, Drive::UpperLid(_)));
        Self(lids.map(|(i, _)| i).collect())
    }

    /// Returns the share of a vertex that follows the joints of an upper lid, 0..1.
    fn weight(&self, mesh: &Mesh, vertex: usize) -> f32 {
        let pairs = mesh.joints[vertex].iter().zip(mesh.weights[vertex]);
        pairs
            .filter(|(j, _)| self.0.contains(j))
            .map(|(_, w)| w)
            .sum()
    }
}

/// Adds coarser levels of detail to every mesh.
pub(crate) fn add(figure: &mut Figure, annotations: &Annotations) {
    let focus = Focus::of_face(figure, annotations);
    let layers = Layers::new(figure);
    let lids = Lids::from_figure(figure);
    for (number, mesh) in figure.meshes.iter_mut().enumerate() {
        if mesh.material.kind == MaterialKind::Hair {
            mesh.coarser = cards::coarser(mesh);
        } else if mesh.indices.len() / 3 >= WORTH_TRIANGLES {
            let mut locked = layers.touching(number);
            locked.resize(mesh.positions.len(), false);
            for (v, locked) in locked.iter_mut().enumerate() {
                *locked |= lids.weight(mesh, v) > LID_WEIGHT;
            }
            mesh.coarser = coarser(mesh, &focus, &locked);
        }
    }
}

/// Share of the spans of a card, and most triangles, of hair that is lent.
const LENT: (f64, usize) = (0.62, 9_600);

/// Reduces hair for storage in a separate file: fewer cards with fewer spans, and one coarser
/// level.
pub(crate) fn lighten(mesh: &mut Mesh) {
    let (share, most) = LENT;
    mesh.indices = cards::thinned(mesh, share, most);
    mesh.drop_unused();
    let coarser = cards::coarser(mesh);
    let finest = mesh.indices.len();
    mesh.coarser = coarser
        .into_iter()
        .filter(|c| 2 * c.len() < finest)
        .collect();
}

/// Sorts triangles so that those that share vertices are adjacent: the vertex cache is used better,
/// and a packed file is a sixteenth shorter. Transparent meshes keep their order: cards of hair are
/// rendered from the scalp outwards.
pub(crate) fn sort_triangles(figure: &mut Figure) {
    for mesh in &mut figure.meshes {
        let is_clear = mesh.material.base_color[3] < 1.0;
        if is_clear || matches!(mesh.material.kind, MaterialKind::Hair | MaterialKind::Lash) {
            continue;
        }
        for triangles in std::iter::once(&mut mesh.indices).chain(&mut mesh.coarser) {
            *triangles = optimize_vertex_cache(triangles, mesh.positions.len());
        }
    }
}

fn coarser(mesh: &Mesh, focus: &[Focus], locked: &[bool]) -> Vec<Vec<u32>> {
    let attributes = attributes(mesh, focus);
    let positions: Vec<u8> = mesh
        .positions
        .iter()
        .flatten()
        .flat_map(|x| x.to_ne_bytes())
        .collect();
    // Positions fill whole strides, so no error can occur.
    let Ok(vertices) = VertexDataAdapter::new(&positions, size_of::<[f32; 3]>(), 0) else {
        return Vec::new();
    };
    let options = match mesh.material.kind {
        // Cards consist only of borders.
        MaterialKind::Lash => SimplifyOptions::ErrorAbsolute,
        _ => SimplifyOptions::ErrorAbsolute | SimplifyOptions::LockBorder,
    };
    // The simplifier measures positions by the mesh's extent, and attributes as they are.
    let per_m = 1.0 / extent_m(mesh);
    let weights = ATTRIBUTE_ERROR_M.map(|m| m * per_m);
    let is_locked = |v: &u32| locked[*v as usize];
    let triangles = mesh.indices.chunks_exact(3);
    let fixed = triangles.filter(|t| t.iter().all(is_locked)).count();
    let free = mesh.indices.len() / 3 - fixed;
    let mut levels: Vec<Vec<u32>> = Vec::new();
    for share in shares(mesh.material.kind) {
        let target = 3 * (fixed + (share * free as f64) as usize);
        let from = levels.last().unwrap_or(&mesh.indices);
        let level = simplify_with_attributes_and_locks(
            from,
            &vertices,
            &attributes,
            &weights,
            ATTRIBUTES * size_of::<f32>(),
            locked,
            target,
            MAX_ERROR_M,
            options,
            None,
        );
        if level.is_empty() || level.len() >= from.len() {
            break;
        }
        levels.push(level);
    }
    levels
}

/// Returns the attributes that mesh simplification must preserve, vertex after vertex.
fn attributes(mesh: &Mesh, focus: &[Focus]) -> Vec<f32> {
    // Texture coordinates of cloth are metres, of which the shader needs no exact ones.
    let uv_counts = f32::from(u8::from(mesh.material.kind.weave().is_none()));
    (0..mesh.positions.len())
        .flat_map(|i| {
            let p = DVec3::from_array(mesh.positions[i].map(f64::from));
            let counts = focus.iter().map(|f| f.weight(p)).fold(0.0, f64::max);
            let [x, y, z] = (p * counts).to_array().map(|x| x as f32);
            let [nx, ny, nz] = mesh.normals[i];
            let [r, g, _, occlusion] = mesh.colors[i].map(|c| f32::from(c) / 255.0);
            let [u, v] = mesh.uvs[i].map(|t| t * uv_counts);
            let [a, b, c] = joints(mesh, i);
            [nx, ny, nz, x, y, z, a, b, c, 0.5 * (r + g), occlusion, u, v]
        })
        .collect()
}

/// Vertices of all cloth of a figure, used to keep overlapping layers intact: hems, cuffs and
/// collars are folded in, tops hang over trousers, pockets lie on tops, and layers that lose
/// different vertices would intersect.
struct Layers {
    at: Vec<DVec3>,
    normals: Vec<DVec3>,
    /// Piece of cloth to which each vertex belongs.
    pieces: Vec<usize>,
    /// First vertex of each mesh.
    first: Vec<usize>,
    cells: Cells,
}

impl Layers {
    fn new(figure: &Figure) -> Self {
        let vector = |v: &[f32; 3]| DVec3::from_array(v.map(f64::from));
        let (mut at, mut normals, mut pieces) = (Vec::new(), Vec::new(), Vec::new());
        let mut first = Vec::new();
        for mesh in &figure.meshes {
            first.push(at.len());
            if mesh.material.kind.weave().is_some() {
                pieces.extend(connected(mesh).into_iter().map(|v| at.len() + v));
                at.extend(mesh.positions.iter().map(vector));
                normals.extend(mesh.normals.iter().map(vector));
            }
        }
        first.push(at.len());
        let cells = Cells::new(&at, TOUCHING_M);
        Self {
            at,
            normals,
            pieces,
            first,
            cells,
        }
    }

    /// Returns, for each vertex of a mesh, true if another layer of cloth is close. Empty for other
    /// materials.
    fn touching(&self, mesh: usize) -> Vec<bool> {
        let layered = |i: usize, j: usize| {
            let turned = self.normals[i].dot(self.normals[j]) < -0.5;
            (turned || self.pieces[i] != self.pieces[j])
                && self.at[i].distance(self.at[j]) < TOUCHING_M
        };
        (self.first[mesh]..self.first[mesh + 1])
            .map(|i| {
                self.cells
                    .neighbours(self.at[i])
                    .any(|j| layered(i, j as usize))
            })
            .collect()
    }
}

/// Returns, for each vertex of a mesh, the representative of its component, connected by edges or
/// equal positions.
fn connected(mesh: &Mesh) -> Vec<usize> {
    let mut up: Vec<usize> = (0..mesh.positions.len()).collect();
    let top = |up: &mut Vec<usize>, mut v: usize| {
        while up[v] != v {
            up[v] = up[up[v]];
            v = up[v];
        }
        v
    };
    let mut placed: HashMap<[u32; 3], usize> = HashMap::new();
    for (v, position) in mesh.positions.iter().enumerate() {
        let twin = *placed.entry(position.map(f32::to_bits)).or_insert(v);
        up[v] = twin;
    }
    for triangle in mesh.indices.chunks_exact(3) {
        for edge in triangle.windows(2) {
            let (a, b) = (
                top(&mut up, edge[0] as usize),
                top(&mut up, edge[1] as usize),
            );
            up[a] = b;
        }
    }
    (0..up.len()).map(|v| top(&mut up, v)).collect()
}

/// Returns three numbers that differ where joints and weights do: each joint has its own direction,
/// a vertex the weighted mean of its joints'.
fn joints(mesh: &Mesh, vertex: usize) -> [f32; 3] {
    let mut sum = [0.0; 3];
    for (joint, weight) in mesh.joints[vertex].iter().zip(mesh.weights[vertex]) {
        for (axis, s) in (0..).zip(&mut sum) {
            *s += weight * noise::unit(JOINT_SEED, axis, i64::from(*joint)) as f32;
        }
    }
    sum
}

/// Returns the longest side of the bounding box of a mesh, metres.
fn extent_m(mesh: &Mesh) -> f32 {
    let bound = |pick: fn(f32, f32) -> f32, from: f32| {
        let mut corner = [from; 3];
        for p in &mesh.positions {
            for (c, x) in corner.iter_mut().zip(p) {
                *c = pick(*c, *x);
            }
        }
        corner
    };
    let (low, high) = (bound(f32::min, f32::MAX), bound(f32::max, f32::MIN));
    (0..3).map(|k| high[k] - low[k]).fold(1e-3, f32::max)
}
