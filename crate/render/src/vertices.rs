//! Vertices of a mesh on the device: positions and other attributes.

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};
use raconteur_body::figure::Mesh;
use raconteur_body::skeleton::Bone;
use wgpu::{VertexBufferLayout, VertexFormat, VertexStepMode};

use crate::gpu::attribute;
use crate::morph::{ShapeVertex, shape_vertex};

/// Vertex data that neither morphs nor tissue change: texture coordinates, colour, joints and
/// weights.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(crate) struct FixedVertex {
    uv: [f32; 2],
    color: [u8; 4],
    joint: [u8; 4],
    weight: [u16; 4],
    /// Direction of growing v, bind pose, −127..127; last the curvature: the root of its
    /// share of [`SHARPEST_PER_M`], negative where hollow.
    along: [i8; 4],
}

impl FixedVertex {
    /// Vertex buffer layout of the constant stream.
    pub(crate) const LAYOUT: VertexBufferLayout<'static> = VertexBufferLayout {
        array_stride: size_of::<Self>() as u64,
        step_mode: VertexStepMode::Vertex,
        attributes: &[
            attribute(VertexFormat::Float32x2, 0, 2),
            attribute(VertexFormat::Unorm8x4, 8, 3),
            attribute(VertexFormat::Uint8x4, 12, 4),
            attribute(VertexFormat::Unorm16x4, 16, 5),
            attribute(VertexFormat::Snorm8x4, 24, 6),
        ],
    };
}

/// Returns the shape data of a mesh's vertices.
pub(crate) fn shape_vertices(mesh: &Mesh) -> Vec<ShapeVertex> {
    let both = mesh.positions.iter().zip(&mesh.normals);
    both.map(|(p, n)| shape_vertex(*p, *n)).collect()
}

/// Returns the constant data of a mesh's vertices, whose lengths have been checked.
pub(crate) fn fixed_vertices(mesh: &Mesh) -> Vec<FixedVertex> {
    let curvature = curvature_per_m(mesh);
    let fixed = |(i, along): (usize, Vec3)| {
        let bend = curvature[i] / SHARPEST_PER_M;
        let bend = bend.signum() * bend.abs().min(1.0).sqrt();
        FixedVertex {
            uv: mesh.uvs[i],
            color: mesh.colors[i],
            joint: mesh.joints[i].map(|j| j as u8),
            weight: mesh.weights[i].map(|w| (w.clamp(0.0, 1.0) * 65535.0).round() as u16),
            along: [along.x, along.y, along.z, bend].map(|c| (c * 127.0).round() as i8),
        }
    };
    let mut fixed: Vec<FixedVertex> = growing_v(mesh).into_iter().enumerate().map(fixed).collect();
    // The nodes already contain the jaw's turn.
    for &vertex in mesh.binding.iter().flat_map(|b| &b.vertices) {
        for joint in &mut fixed[vertex as usize].joint {
            if usize::from(*joint) == Bone::Chin.index() {
                *joint = Bone::Skull.index() as u8;
            }
        }
    }
    fixed
}

/// Returns the direction of increasing v for each vertex, averaged over its triangles: the
/// direction of a strand on a card, wales on cloth, up on an eye. Bind pose, unit length.
fn growing_v(mesh: &Mesh) -> Vec<Vec3> {
    let mut sum = vec![Vec3::ZERO; mesh.positions.len()];
    for t in mesh.indices.chunks_exact(3) {
        let [a, b, c] = [t[0] as usize, t[1] as usize, t[2] as usize];
        let p = Vec3::from(mesh.positions[a]);
        let (e1, e2) = (
            Vec3::from(mesh.positions[b]) - p,
            Vec3::from(mesh.positions[c]) - p,
        );
        let q = Vec2::from(mesh.uvs[a]);
        let (d1, d2) = (Vec2::from(mesh.uvs[b]) - q, Vec2::from(mesh.uvs[c]) - q);
        let det = d1.x * d2.y - d2.x * d1.y;
        // Normalised before summing: an area weight would favour stretched triangles.
        let along = ((e2 * d1.x - e1 * d2.x) * det.signum()).normalize_or_zero();
        if det != 0.0 {
            for i in [a, b, c] {
                sum[i] += along;
            }
        }
    }
    sum.iter()
        .zip(&mesh.normals)
        .map(|(s, n)| {
            // Without a uv direction, up along the surface serves.
            let n = Vec3::from(*n);
            let up = Vec3::Y - n * n.y;
            s.try_normalize()
                .or_else(|| up.try_normalize())
                .unwrap_or(Vec3::Z)
        })
        .collect()
}

/// Largest curvature representable in a vertex, 1/m: a bead of 4 mm radius.
const SHARPEST_PER_M: f32 = 250.0;

/// Returns the mean curvature of each vertex, 1/m, positive where the surface bulges: the
/// divergence of its neighbours' normals, averaged over its edges.
fn curvature_per_m(mesh: &Mesh) -> Vec<f32> {
    let mut sum = vec![(0.0, 0.0); mesh.positions.len()];
    for t in mesh.indices.chunks_exact(3) {
        for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            let (a, b) = (a as usize, b as usize);
            let edge = Vec3::from(mesh.positions[b]) - Vec3::from(mesh.positions[a]);
            let lean = Vec3::from(mesh.normals[b]) - Vec3::from(mesh.normals[a]);
            let length = edge.length_squared();
            if length > 1e-12 {
                for i in [a, b] {
                    sum[i].0 += lean.dot(edge) / length;
                    sum[i].1 += 1.0;
                }
            }
        }
    }
    sum.iter()
        .map(|&(k, n): &(f32, f32)| if k.is_finite() { k / n.max(1.0) } else { 0.0 })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_body::figure::{Material, MaterialKind, TextureMaps};

    fn card() -> Mesh {
        Mesh {
            name: "card".to_owned(),
            material: Material {
                kind: MaterialKind::Hair,
                base_color: [1.0; 4],
                roughness: 0.5,
                double_sided: true,
                maps: TextureMaps::default(),
            },
            positions: vec![
                [0.0, 1.0, 0.0],
                [0.1, 1.0, 0.0],
                [0.0, 0.0, 0.0],
                [0.1, 0.0, 0.0],
            ],
            normals: vec![[0.0, 0.0, 1.0]; 4],
            uvs: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]],
            colors: vec![[255; 4]; 4],
            joints: vec![[0; 4]; 4],
            weights: vec![[1.0, 0.0, 0.0, 0.0]; 4],
            indices: vec![0, 2, 1, 1, 2, 3],
            morphs: Vec::new(),
            coarser: Vec::new(),
            binding: None,
        }
    }

    #[test]
    fn strands_run_from_root_to_tip() {
        for along in growing_v(&card()) {
            assert!((along - Vec3::NEG_Y).length() < 1e-6, "{along}");
        }
    }

    #[test]
    fn without_texture_coordinates_strands_run_up_the_surface() {
        let mut mesh = card();
        mesh.uvs.fill([0.5, 0.5]);
        for along in growing_v(&mesh) {
            assert!((along - Vec3::Y).length() < 1e-6, "{along}");
        }
    }
}
