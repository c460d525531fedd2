//! A figure on the GPU: two vertex streams, indices, joints and materials.

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};
use raconteur_base::DAffine3;
use raconteur_base::order::sort_by_number;
use raconteur_body::{Figure, MaterialKind, Mesh};

use crate::RenderError;
use crate::morph::{MorphedMesh, ShapeVertex, shape_vertex};

/// Joints that the shader's table holds: 128 of 48 bytes fit the 16 KiB that every
/// WebGL2 device has, and joints are numbered by one byte in the vertices.
pub(crate) const MAX_JOINTS: usize = 128;

/// Distance between materials in their buffer, bytes: the alignment of dynamic offsets.
pub(crate) const MATERIAL_STRIDE: u64 = 256;

/// What never changes in a vertex.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(crate) struct FixedVertex {
    uv: [f32; 2],
    color: [u8; 4],
    joint: [u8; 4],
    weight: [u16; 4],
    /// Direction of growing v, bind pose, −127..127.
    along: [i8; 4],
}

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(crate) struct MaterialUniform {
    base: [f32; 4],
    params: [f32; 4],
}

/// One mesh of the drawn figure.
pub(crate) struct DrawnMesh {
    pub(crate) kind: MaterialKind,
    pub(crate) double_sided: bool,
    pub(crate) indices: std::ops::Range<u32>,
    pub(crate) material_offset: u32,
}

/// A figure's data, ready to be sent.
pub(crate) struct FigureData {
    pub(crate) shape: Vec<ShapeVertex>,
    pub(crate) fixed: Vec<FixedVertex>,
    pub(crate) indices: Vec<u32>,
    pub(crate) materials: Vec<u8>,
    pub(crate) meshes: Vec<DrawnMesh>,
    pub(crate) morphed: Vec<MorphedMesh>,
}

impl FigureData {
    /// Packs a figure.
    ///
    /// # Errors
    /// When it has too many joints or a mesh contradicts itself.
    pub(crate) fn new(figure: &Figure) -> Result<Self, RenderError> {
        let joints = figure.inverse_bind.len();
        if joints > MAX_JOINTS {
            return Err(RenderError::TooManyJoints {
                found: joints,
                limit: MAX_JOINTS,
            });
        }
        let has_cornea = figure
            .meshes
            .iter()
            .any(|m| m.material.kind == MaterialKind::Cornea);
        let mut data = Self {
            shape: Vec::new(),
            fixed: Vec::new(),
            indices: Vec::new(),
            materials: Vec::new(),
            meshes: Vec::new(),
            morphed: Vec::new(),
        };
        for mesh in &figure.meshes {
            check(mesh, joints)?;
            if !mesh.indices.is_empty() {
                data.push(mesh, has_cornea);
            }
        }
        // Opaque kinds first, by material, then cards, then what only adds light.
        sort_by_number(&mut data.meshes, |m| {
            f64::from(draw_order(m.kind)) * 100.0
                + f64::from(m.kind as u8) * 2.0
                + f64::from(u8::from(m.double_sided))
        });
        Ok(data)
    }

    fn push(&mut self, mesh: &Mesh, has_cornea: bool) {
        let base = self.shape.len();
        let first_index = self.indices.len() as u32;
        let along = growing_v(mesh);
        for (i, along) in along.iter().enumerate() {
            self.shape
                .push(shape_vertex(mesh.positions[i], mesh.normals[i]));
            self.fixed.push(FixedVertex {
                uv: mesh.uvs[i],
                color: mesh.colors[i],
                joint: mesh.joints[i].map(|j| j as u8),
                weight: mesh.weights[i].map(|w| (w.clamp(0.0, 1.0) * 65535.0).round() as u16),
                along: [along.x, along.y, along.z, 0.0].map(|c| (c * 127.0).round() as i8),
            });
        }
        // WebGL2 has no base vertex: the offset goes into the indices.
        let indices = mesh.indices.iter().map(|i| i + base as u32);
        if draw_order(mesh.material.kind) == 1 {
            // Cards are laid from the scalp outwards; drawn from the outside in, the depth
            // test spares the strands that are covered. Read backwards a triangle turns
            // over, so its corners are swapped back.
            self.indices.extend(indices.rev());
            for t in self.indices[first_index as usize..].chunks_exact_mut(3) {
                t.swap(0, 2);
            }
        } else {
            self.indices.extend(indices);
        }
        let material_offset = self.materials.len() as u32;
        let material = MaterialUniform {
            base: mesh.material.base_color,
            params: [
                mesh.material.roughness.clamp(0.05, 1.0),
                f32::from(u8::from(has_cornea)),
                f32::from(mesh.material.kind.weave().unwrap_or(0)),
                0.0,
            ],
        };
        self.materials
            .extend_from_slice(bytemuck::bytes_of(&material));
        self.materials
            .resize((material_offset as u64 + MATERIAL_STRIDE) as usize, 0);
        self.meshes.push(DrawnMesh {
            kind: mesh.material.kind,
            double_sided: mesh.material.double_sided,
            indices: first_index..self.indices.len() as u32,
            material_offset,
        });
        self.morphed.extend(MorphedMesh::new(mesh, base));
    }
}

/// 0 for opaque surfaces, 1 for cards, 2 for the transparent layer.
pub(crate) fn draw_order(kind: MaterialKind) -> u8 {
    match kind {
        MaterialKind::Hair | MaterialKind::Lash => 1,
        MaterialKind::Cornea => 2,
        _ => 0,
    }
}

fn check(mesh: &Mesh, joints: usize) -> Result<(), RenderError> {
    let n = mesh.positions.len();
    let problem = if [
        mesh.normals.len(),
        mesh.uvs.len(),
        mesh.colors.len(),
        mesh.joints.len(),
        mesh.weights.len(),
    ]
    .iter()
    .any(|&len| len != n)
    {
        "its vertex attributes differ in number"
    } else if !mesh.indices.len().is_multiple_of(3) {
        "its indices do not make whole triangles"
    } else if mesh.indices.iter().any(|&i| i as usize >= n) {
        "an index lies beyond its vertices"
    } else if mesh
        .joints
        .iter()
        .flatten()
        .any(|&j| usize::from(j) >= joints)
    {
        "a vertex names a joint that the figure has not"
    } else if mesh.morphs.iter().any(|m| {
        m.position_deltas.len() != m.vertices.len() || m.normal_deltas.len() != m.vertices.len()
    }) {
        "a morph's displacements differ in number from its vertices"
    } else if mesh
        .morphs
        .iter()
        .flat_map(|m| &m.vertices)
        .any(|&v| v as usize >= n)
    {
        "a morph moves a vertex beyond the mesh"
    } else {
        return Ok(());
    };
    Err(RenderError::BadMesh {
        mesh: mesh.name.clone(),
        problem,
    })
}

/// Direction in which v grows, for each vertex, averaged over its triangles: the way a
/// strand runs on a card, wales on cloth, up on an eye. Bind pose, unit length.
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

/// World from bind of each joint as the shader's rows; `rows` is cleared first. Joints
/// that the frame does not give stay in the bind pose.
pub(crate) fn joint_rows(
    world_from_joint: &[DAffine3],
    joint_from_bind: &[DAffine3],
    rows: &mut Vec<[f32; 4]>,
) {
    rows.clear();
    for (i, inverse_bind) in joint_from_bind.iter().enumerate() {
        let m = world_from_joint
            .get(i)
            .map_or(DAffine3::IDENTITY, |w| *w * *inverse_bind);
        let (r, t) = (m.matrix3.transpose(), m.translation);
        for (row, offset) in [(r.x_axis, t.x), (r.y_axis, t.y), (r.z_axis, t.z)] {
            rows.push([row.x as f32, row.y as f32, row.z as f32, offset as f32]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_body::Material;

    fn card() -> Mesh {
        Mesh {
            name: "card".to_owned(),
            material: Material {
                kind: MaterialKind::Hair,
                base_color: [1.0; 4],
                roughness: 0.5,
                double_sided: true,
                maps: Maps::default(),
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

    #[test]
    fn joints_that_are_not_given_stay_in_the_bind_pose() {
        let mut rows = vec![[9.0; 4]];
        joint_rows(
            &[],
            &[DAffine3::from_scale(raconteur_base::DVec3::splat(3.0))],
            &mut rows,
        );
        assert_eq!(
            rows,
            [
                [1.0, 0.0, 0.0, 0.0],
                [0.0, 1.0, 0.0, 0.0],
                [0.0, 0.0, 1.0, 0.0]
            ]
        );
    }
}
