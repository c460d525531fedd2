//! Source of the tissue under the face: the skin between the cage and the rendered surface, as a
//! mesh of nodes with their properties.
//!
//! Nodes are the vertices of the cage subdivided once; rendered vertices follow them by the
//! stencils of the surface, so that a moved face stays as smooth as before.

use std::collections::BTreeMap;

use raconteur_base::{DVec3, Side};

use super::cage::{Cage, Key};
use super::mean;
use super::rig::Shares;
use super::solve::Solved;
use crate::subdivide::{Stencil, edge_faces, limit_stencils, subdivide};

/// Position on the lips: ring from the skin (0) inwards, and position from the middle of the upper
/// lip (0) over the corner (12) to the middle of the lower (24); both in half steps of the cage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct LipPlace {
    pub(crate) ring: u8,
    pub(crate) position: u8,
    pub(crate) side: Side,
}

/// Node of the skin in the tissue simulation, with its mobility and jaw share.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SoftNode {
    /// Position on the rendered surface, metres, frame of the head.
    pub(crate) place: DVec3,
    /// Share of the lower jaw.
    pub(crate) jaw: f64,
    /// Mobility under muscles of the face: 0 where skin is fixed to the skull, 1 for full mobility.
    pub(crate) mobility: f64,
    /// Mobility under the muscles of temple, ear and jaw angle, 0 to 1.
    pub(crate) mobility_aside: f64,
    /// Weight with which it follows the ear attached to it, 0 to 1.
    pub(crate) ear_root: f64,
    /// Lateral stiffness, 0 (slides) to 1.
    pub(crate) grip: f64,
    /// True if it lies inside nose or mouth.
    pub(crate) is_inside: bool,
    pub(crate) lip: Option<LipPlace>,
}

/// Skin of one head as a mesh of nodes, the source of its tissue simulation.
#[derive(Clone, Debug)]
pub(crate) struct Soft {
    pub(crate) nodes: Vec<SoftNode>,
    pub(crate) quads: Vec<[u32; 4]>,
    /// Pairs of points on the mean head, millimetres, and on this head, used to transfer layouts
    /// from the mean head.
    pub(crate) landmarks: Vec<(DVec3, DVec3)>,
}

/// Returns the mobility of the skin under muscles. Designed: lids are rigid, the scalp and the area
/// in front of the ears hardly move.
fn mobility(key: Key) -> f64 {
    match key {
        Key::Grid(column, row) => {
            let aside = match column {
                0..=8 => 1.0,
                9 => 0.85,
                10 => 0.5,
                11 => 0.15,
                _ => 0.0,
            };
            let down = match row {
                0 => 0.25,
                1 => 0.7,
                2..=23 => 1.0,
                24 => 0.9,
                25 => 0.7,
                26 => 0.5,
                27 => 0.3,
                28 => 0.15,
                _ => 0.0,
            };
            aside * down
        }
        Key::Eye(1, _) => 0.75,
        Key::Eye(2, _) => 0.4,
        Key::Eye(3, _) => 0.12,
        Key::Mouth(..) | Key::Nostril(..) => 1.0,
        Key::Eye(..) | Key::Ear(..) | Key::Crown(..) => 0.0,
    }
}

/// Returns the mobility of the skin at the side of the head, from the scalp above the temple to
/// behind the ear and down to the jaw angle, under the muscles of temple, ear and jaw angle.
/// Designed.
fn mobility_aside(key: Key) -> f64 {
    let Key::Grid(column, row) = key else {
        return 0.0;
    };
    let behind = match column {
        ..=7 => 0.0,
        8 => 0.6,
        9 => 0.8,
        10..=14 => 1.0,
        15 => 0.9,
        16 => 0.4,
        _ => 0.0,
    };
    let down = match row {
        0 => 0.5,
        13 if column > 12 => 0.3,
        14.. if column > 12 => 0.0,
        1..=23 => 1.0,
        24 => 0.8,
        25 => 0.4,
        26 => 0.15,
        _ => 0.0,
    };
    behind * down
}

/// Returns the weight with which skin follows the ear: full at its root, less with each line of the
/// grid away from it.
fn ear_root(key: Key) -> f64 {
    match key {
        Key::Ear(..) => 1.0,
        Key::Grid(column, row) => {
            let off =
                |at: u8, [from, to]: [u8; 2]| from.saturating_sub(at).max(at.saturating_sub(to));
            let lines = off(column, EAR_COLUMNS).max(off(row, EAR_ROWS));
            match lines {
                0 => 1.0,
                1 => 0.55,
                2 => 0.2,
                _ => 0.0,
            }
        }
        _ => 0.0,
    }
}

/// Range of grid columns of the ear's root; the next constant is the range of rows.
const EAR_COLUMNS: [u8; 2] = [12, 15];
const EAR_ROWS: [u8; 2] = [6, 12];
/// Vertices of the ear's root, fixed to the skull independently of the jaw, that carry the ear:
/// above it and behind it.
const EAR_HOLDS: [(u8, u8); 4] = [(12, 7), (13, 6), (15, 6), (15, 9)];

/// Returns the pretension of the skin's attachment. Designed: firm at lips, nose and lids, loose
/// over cheeks and forehead, where skin slides.
fn grip(key: Key) -> f64 {
    match key {
        Key::Mouth(6.., _) => 0.9,
        Key::Mouth(..) => 0.85,
        Key::Nostril(..) => 0.7,
        Key::Eye(..) => 0.6,
        Key::Grid(column, row) => {
            if key.mouth_position().is_some() {
                0.7
            } else if column <= 5 && (5..=14).contains(&row) {
                0.65
            } else if mobility(key) < 0.6 {
                0.7
            } else {
                0.4
            }
        }
        Key::Ear(..) | Key::Crown(..) => 1.0,
    }
}

/// Returns, for each vertex of a subdivided mesh, the original vertices that it lies between, in
/// the order of [`subdivide`].
fn parents(faces: &[Vec<u32>], count: usize) -> Vec<Vec<u32>> {
    let own = (0..count as u32).map(|v| vec![v]);
    let edges = edge_faces(faces);
    let middles = edges.keys().map(|&(a, b)| vec![a, b]);
    own.chain(middles).chain(faces.iter().cloned()).collect()
}

/// Returns the lip position of a node between vertices of the cage; `None` elsewhere.
fn lip_place(cage: &Cage, between: &[u32]) -> Option<LipPlace> {
    let (mut rings, mut positions) = (0, 0);
    let mut side = Side::Left;
    for &v in between {
        let (key, own) = cage.keys[v as usize];
        let (ring, position) = key.mouth_position()?;
        rings += 2 * usize::from(ring);
        positions += 2 * position;
        if !key.on_midline() {
            side = own;
        }
    }
    let count = between.len();
    // Only edges and quads of the mouth's own rings have integer positions.
    let is_whole = count <= 4 && rings.is_multiple_of(count) && positions.is_multiple_of(count);
    is_whole.then(|| LipPlace {
        ring: (rings / count) as u8,
        position: (positions / count) as u8,
        side,
    })
}

/// Returns the vertices of the cage subdivided once that lie on the lips, with their positions.
pub(super) fn lip_places(cage: &Cage) -> impl Iterator<Item = (usize, LipPlace)> + '_ {
    let between = parents(&cage.faces, cage.len());
    let place = |(v, between): (usize, Vec<u32>)| Some((v, lip_place(cage, &between)?));
    between.into_iter().enumerate().filter_map(place)
}

/// Weights by which the rendered vertices of the skin follow the nodes.
pub(super) struct Follow {
    /// The node of each vertex of the cage subdivided once.
    node_of: Vec<Option<u32>>,
    /// The nodes that each of them follows in equal parts that is in an ear, and is no node.
    ear_of: Vec<Option<[u32; EAR_HOLDS.len()]>>,
    /// Stencils from there to the cage subdivided twice.
    finer: Vec<Stencil>,
}

impl Follow {
    /// Returns the nodes and weights that drive a vertex of the cage subdivided twice. Where part
    /// of its surroundings is fixed, weights sum to less than 1.
    pub(super) fn row(&self, fine: u32) -> Vec<(u32, f64)> {
        let mut row: BTreeMap<u32, f64> = BTreeMap::new();
        for &(v, weight) in &self.finer[fine as usize] {
            let v = v as usize;
            if let Some(node) = self.node_of[v] {
                *row.entry(node).or_default() += weight;
            } else if let Some(nodes) = self.ear_of[v] {
                for node in nodes {
                    *row.entry(node).or_default() += weight / nodes.len() as f64;
                }
            }
        }
        row.into_iter().filter(|(_, w)| *w > 1e-4).collect()
    }
}

/// Finds the nodes of a head.
pub(super) fn soft(cage: &Cage, solved: &Solved, shares: &[Shares]) -> (Soft, Follow) {
    let once = subdivide(&cage.faces, cage.len(), 1);
    let finer = subdivide(&once.faces, once.stencils.len(), 1).stencils;
    let limit = limit_stencils(&once.faces, once.stencils.len());
    let at = once.apply(&solved.cage_points);
    let by_key = |f: fn(Key) -> f64| {
        let values: Vec<f64> = cage.keys.iter().map(|&(key, _)| f(key)).collect();
        once.apply(&values)
    };
    let (mobilities, grips) = (by_key(mobility), by_key(grip));
    let (aside, ear_roots) = (by_key(mobility_aside), by_key(ear_root));
    // An ear is stiff: only its root moves.
    let ears = by_key(|key| f64::from(u8::from(matches!(key, Key::Ear(..)))));
    let inside = by_key(|key| match key {
        Key::Mouth(5.., _) | Key::Nostril(1.., _) => 1.0,
        _ => 0.0,
    });
    let jaws = once.apply(&shares.iter().map(|s| s.jaw).collect::<Vec<f64>>());
    // Lids go with their own joints.
    let lids = once.apply(
        &shares
            .iter()
            .map(|s| s.upper_lid + s.lower_lid)
            .collect::<Vec<f64>>(),
    );
    let between = parents(&cage.faces, cage.len());
    let mut node_of = vec![None; at.len()];
    let mut nodes = Vec::new();
    for v in 0..at.len() {
        let is_fixed = mobilities[v].max(aside[v]) < 0.02 && jaws[v] < 0.005;
        if is_fixed || lids[v] > 0.5 || ears[v] > 0.3 {
            continue;
        }
        node_of[v] = Some(nodes.len() as u32);
        let place: DVec3 = limit[v].iter().map(|&(i, w)| at[i as usize] * w).sum();
        nodes.push(SoftNode {
            place: place * 1e-3,
            jaw: jaws[v].clamp(0.0, 1.0),
            mobility: mobilities[v].clamp(0.0, 1.0),
            mobility_aside: aside[v].clamp(0.0, 1.0),
            ear_root: ear_roots[v].clamp(0.0, 1.0),
            grip: grips[v].clamp(0.0, 1.0),
            is_inside: inside[v] > 0.5,
            lip: lip_place(cage, &between[v]),
        });
    }
    // Subdivision keeps the initial vertices first.
    let held = |side| {
        let nodes = EAR_HOLDS.map(|(c, r)| node_of[cage.vertex(Key::Grid(c, r), side)]);
        nodes
            .iter()
            .all(Option::is_some)
            .then(|| nodes.map(Option::unwrap_or_default))
    };
    let held_ears = Side::BOTH.map(held);
    let ear_of = ears
        .iter()
        .zip(&at)
        .map(|(ear, p)| held_ears[usize::from(p.x < 0.0)].filter(|_| *ear > 0.3))
        .collect();
    let quads = once
        .faces
        .iter()
        .filter_map(|f| {
            let q: Vec<u32> = f.iter().filter_map(|&v| node_of[v as usize]).collect();
            <[u32; 4]>::try_from(q).ok()
        })
        .collect();
    let landmarks = mean::landmarks(cage, solved);
    (
        Soft {
            nodes,
            quads,
            landmarks,
        },
        Follow {
            node_of,
            ear_of,
            finer,
        },
    )
}
