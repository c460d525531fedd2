//! Binding of hair to skin: joint weights and morph targets are those of the skin below.

use std::collections::BTreeMap;

use raconteur_base::DVec3;

use super::surface::nearest;
use crate::part::{JointRef, MeshPart, PartMorph};
use raconteur_base::surface::vertex_normals;

/// Skin in which hairs are rooted, with the weights that a hair inherits from it; metres, frame of
/// the head.
pub(crate) struct ScalpBinding {
    pub(crate) positions: Vec<DVec3>,
    pub(crate) normals: Vec<DVec3>,
    weights: Vec<Vec<(JointRef, f64)>>,
    morphs: Vec<(String, Vec<DVec3>)>,
    /// Weights of the tissue nodes for each vertex.
    bound: Vec<Vec<(u32, f64)>>,
}

/// Vertices of the skin with their shares, which a hair follows.
pub(crate) type VertexWeights = Vec<(u32, f64)>;

impl ScalpBinding {
    pub(crate) fn new(skin: &MeshPart) -> Self {
        let positions: Vec<DVec3> = skin.vertices.iter().map(|v| v.position).collect();
        let dense = |m: &PartMorph| {
            let mut all = vec![DVec3::ZERO; positions.len()];
            for &(v, d) in &m.deltas {
                all[v as usize] = d;
            }
            (m.name.clone(), all)
        };
        let mut bound = vec![Vec::new(); positions.len()];
        for (v, row) in &skin.bound {
            bound[*v as usize].clone_from(row);
        }
        Self {
            bound,
            normals: vertex_normals(&positions, &skin.faces),
            weights: skin.vertices.iter().map(|v| v.weights.clone()).collect(),
            morphs: skin.morphs.iter().map(dense).collect(),
            positions,
        }
    }

    /// Returns the `count` vertices nearest to a root, with their shares.
    pub(crate) fn nearest_vertices(&self, root: DVec3, count: usize) -> VertexWeights {
        nearest(&self.positions, root, count, 1.5e-4)
    }

    /// Returns the joint weights of the skin that a vertex is attached to.
    pub(crate) fn weights(&self, holds: &VertexWeights) -> Vec<(JointRef, f64)> {
        let mut weights: Vec<(JointRef, f64)> = Vec::new();
        for &(v, share) in holds {
            for &(joint, w) in &self.weights[v as usize] {
                match weights.iter_mut().find(|k| k.0 == joint) {
                    Some(k) => k.1 += w * share,
                    None => weights.push((joint, w * share)),
                }
            }
        }
        weights
    }

    /// Returns the tissue weights of the vertices of an attached part.
    pub(crate) fn bound(&self, holds: &[VertexWeights]) -> Vec<(u32, Vec<(u32, f64)>)> {
        let row = |h: &VertexWeights| {
            let mut sums: BTreeMap<u32, f64> = BTreeMap::new();
            for &(v, share) in h {
                for &(node, weight) in &self.bound[v as usize] {
                    *sums.entry(node).or_insert(0.0) += share * weight;
                }
            }
            sums.into_iter().collect::<Vec<_>>()
        };
        let rows = (0u32..).zip(holds.iter().map(row));
        rows.filter(|(_, row)| !row.is_empty()).collect()
    }

    /// Returns the morphs of an attached part; movements below `least` metres are omitted.
    pub(crate) fn morphs(&self, holds: &[VertexWeights], least: f64) -> Vec<PartMorph> {
        let of = |deltas: &[DVec3]| -> Vec<(u32, DVec3)> {
            (0u32..)
                .zip(holds)
                .map(|(i, h)| (i, h.iter().map(|&(v, w)| deltas[v as usize] * w).sum()))
                .filter(|(_, d): &(u32, DVec3)| d.length() > least)
                .collect()
        };
        self.morphs
            .iter()
            .map(|(name, deltas)| PartMorph {
                name: name.clone(),
                deltas: of(deltas),
            })
            .filter(|m| !m.deltas.is_empty())
            .collect()
    }
}
