//! Morph targets, applied on the CPU to the few affected vertices.
//!
//! WebGL2 has no storage buffers, and the morph targets of a face affect few vertices. They are
//! therefore summed here, and only the affected range of the vertex buffer is uploaded again.

use raconteur_body::Mesh;
use wgpu::{VertexBufferLayout, VertexStepMode, vertex_attr_array};

/// Position and normal of one vertex, in the vertex stream that morphs change.
pub(crate) type ShapeVertex = [f32; 6];

/// Vertex buffer layout of [`ShapeVertex`].
pub(crate) const SHAPE_LAYOUT: VertexBufferLayout<'static> = VertexBufferLayout {
    array_stride: size_of::<ShapeVertex>() as u64,
    step_mode: VertexStepMode::Vertex,
    attributes: &vertex_attr_array![0 => Float32x3, 1 => Float32x3],
};

/// Vertices of one mesh that morph targets move, summed on the CPU.
pub(crate) struct MorphedMesh {
    /// First vertex of the affected range, in the figure's vertex buffer.
    pub(crate) first_vertex: usize,
    /// The affected range at rest.
    rest: Vec<ShapeVertex>,
    /// The affected range as rendered.
    pub(crate) current: Vec<ShapeVertex>,
    parts: Vec<TargetDeltas>,
    /// Weights that `current` was made with, one a part.
    weights: Vec<f32>,
}

struct TargetDeltas {
    target: usize,
    /// Vertices within the range.
    vertices: Vec<u32>,
    deltas: Vec<ShapeVertex>,
}

impl MorphedMesh {
    /// Returns the morphs of a mesh whose vertices begin at `base` in the figure's buffer; `None`
    /// if it has none. The mesh's indices and lengths have been checked.
    pub(crate) fn new(mesh: &Mesh, base: usize) -> Option<Self> {
        let touched = || mesh.morphs.iter().flat_map(|m| m.vertices.iter().copied());
        let (low, high) = (touched().min()? as usize, touched().max()? as usize);
        let rest: Vec<ShapeVertex> = (low..=high)
            .map(|i| shape_vertex(mesh.positions[i], mesh.normals[i]))
            .collect();
        let parts: Vec<TargetDeltas> = mesh
            .morphs
            .iter()
            .map(|m| TargetDeltas {
                target: m.target,
                vertices: m.vertices.iter().map(|v| v - low as u32).collect(),
                deltas: m
                    .position_deltas
                    .iter()
                    .zip(&m.normal_deltas)
                    .map(|(p, n)| shape_vertex(*p, *n))
                    .collect(),
            })
            .collect();
        Some(Self {
            first_vertex: base + low,
            current: rest.clone(),
            rest,
            weights: vec![0.0; parts.len()],
            parts,
        })
    }

    /// Updates `current` to these weights of the figure's targets; missing ones are zero. Returns
    /// true if anything changed. Allocates nothing.
    pub(crate) fn apply(&mut self, weights: &[f32]) -> bool {
        let mut changed = false;
        for (part, old) in self.parts.iter().zip(&mut self.weights) {
            let new = weights
                .get(part.target)
                .copied()
                .filter(|w| w.is_finite())
                .unwrap_or(0.0);
            changed |= new != *old;
            *old = new;
        }
        if !changed {
            return false;
        }
        self.current.copy_from_slice(&self.rest);
        for (part, &weight) in self.parts.iter().zip(&self.weights) {
            if weight == 0.0 {
                continue;
            }
            for (&v, delta) in part.vertices.iter().zip(&part.deltas) {
                for (c, d) in self.current[v as usize].iter_mut().zip(delta) {
                    *c += weight * d;
                }
            }
        }
        true
    }
}

pub(crate) fn shape_vertex(p: [f32; 3], n: [f32; 3]) -> ShapeVertex {
    [p[0], p[1], p[2], n[0], n[1], n[2]]
}
