//! Figure on the GPU: vertex streams, indices, joints and materials.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use raconteur_base::order::sort_by_number;
use raconteur_base::{DAffine3, Side};
use raconteur_body::figure::{Figure, MaterialKind, Mesh, TextureMaps};
use raconteur_body::skeleton::Drive;

use crate::RenderError;
use crate::morph::{MorphedMesh, ShapeVertex};
use crate::options::LEVELS;
use crate::tissue::{BoundMesh, Nodes};
use crate::vertices::{FixedVertex, fixed_vertices, shape_vertices};

/// Number of joints in the shader's table: 256 of 48 bytes fit the 16 KiB that every WebGL2 device
/// has, and vertices index joints by one byte.
pub(crate) const MAX_JOINTS: usize = 256;

/// Distance between materials in their buffer, bytes: the alignment of dynamic offsets.
pub(crate) const MATERIAL_STRIDE: u64 = 256;

/// Uniform data of a material, with the layout of `Material` in the shaders.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Pod, Zeroable)]
pub(crate) struct MaterialUniform {
    base: [f32; 4],
    params: [f32; 4],
    face: [f32; 4],
}

impl MaterialUniform {
    /// Creates the key of a mesh of a figure with or without corneas, with its face in `face`.
    fn from_mesh(mesh: &Mesh, alpha_mode: AlphaMode, has_cornea: bool, face: [f32; 4]) -> Self {
        Self {
            base: mesh.material.base_color,
            params: [
                mesh.material.roughness.clamp(0.05, 1.0),
                f32::from(u8::from(has_cornea)),
                f32::from(u8::from(alpha_mode == AlphaMode::Blend)),
                // For cloth, the flag is its weave; for other materials, whether a normal map
                // exists.
                mesh.material.kind.weave().map_or(
                    f32::from(u8::from(mesh.material.maps.normal.is_some())),
                    f32::from,
                ),
            ],
            face,
        }
    }
}

/// Alpha mode of a mesh, in glTF's terms: opaque, masked or blended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum AlphaMode {
    /// Covers everything behind it.
    Opaque,
    /// Covers where its texture or its strands do.
    Mask,
    /// Blends with everything rendered before it.
    Blend,
}

/// Shadow mode of a mesh: the part of it that is drawn into shadow maps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shadow {
    /// All triangles of the mesh.
    Solid,
    /// Cut as strands of hair.
    Strands,
    /// Cut out by the colour texture's alpha.
    Picture,
    /// No shadow: the inside of the mouth is shaded by its occlusion, lashes are finer than the
    /// map, and transparent surfaces cast none. Eyes cast shadows: otherwise the key light would
    /// shine through an open lid into the head and glow on the far cheek as through thin flesh.
    Nothing,
}

/// Parameters that select the render pipeline of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PipelineKey {
    pub(crate) kind: MaterialKind,
    pub(crate) double_sided: bool,
    pub(crate) alpha_mode: AlphaMode,
    /// True if the vertices follow facial tissue.
    pub(crate) bound: bool,
}

impl PipelineKey {
    fn from_mesh(figure: &Figure, mesh: &Mesh) -> Self {
        let material = &mesh.material;
        let kind = material.kind;
        let alpha_mode = match kind {
            MaterialKind::Hair => AlphaMode::Mask,
            // Hairs thinner than a pixel must cover less of it than one sample.
            MaterialKind::Cornea | MaterialKind::Lash => AlphaMode::Blend,
            MaterialKind::Plain if material.base_color[3] < 0.99 => AlphaMode::Blend,
            // A JPEG has no alpha that could cut.
            MaterialKind::Plain
                if material
                    .maps
                    .base_color
                    .and_then(|i| figure.images.get(i))
                    .is_some_and(|image| image.mime_type == "image/png") =>
            {
                AlphaMode::Mask
            }
            _ => AlphaMode::Opaque,
        };
        Self {
            // All weaves share one shader.
            kind: kind.weave().map_or(kind, |_| MaterialKind::Cloth),
            double_sided: material.double_sided,
            alpha_mode,
            bound: mesh.binding.is_some(),
        }
    }

    pub(crate) fn shadow(self) -> Shadow {
        match (self.kind, self.alpha_mode) {
            (MaterialKind::Teeth | MaterialKind::Mouth, _)
            | (MaterialKind::Lash, _)
            | (_, AlphaMode::Blend) => Shadow::Nothing,
            (MaterialKind::Hair, _) => Shadow::Strands,
            (_, AlphaMode::Mask) => Shadow::Picture,
            (_, AlphaMode::Opaque) => Shadow::Solid,
        }
    }
}

/// Draw call for all meshes of a figure that share a surface.
pub(crate) struct DrawnMesh {
    pub(crate) key: PipelineKey,
    pub(crate) maps: TextureMaps,
    /// Index ranges of the triangles at each level of detail, the finest first.
    pub(crate) levels: [Range<u32>; LEVELS],
    pub(crate) material_offset: u32,
}

/// Data of a figure, ready for upload to the GPU: vertices, indices, materials and draw calls.
pub(crate) struct FigureData {
    pub(crate) shape: Vec<ShapeVertex>,
    pub(crate) fixed: Vec<FixedVertex>,
    pub(crate) indices: Vec<u32>,
    pub(crate) materials: Vec<u8>,
    pub(crate) meshes: Vec<DrawnMesh>,
    pub(crate) morphed: Vec<MorphedMesh>,
    pub(crate) bound: Vec<BoundMesh>,
    /// Number of bound vertices, which precede all others.
    pub(crate) bound_vertices: usize,
    pub(crate) nodes: Nodes,
    /// The first vertex of each of the figure's meshes.
    pub(crate) bases: Vec<usize>,
}

/// Meshes of the same surface, before they are laid one behind the other.
struct Batch {
    key: PipelineKey,
    maps: TextureMaps,
    material: MaterialUniform,
    /// Triangle indices at each level of detail.
    levels: [Vec<u32>; LEVELS],
}

impl Batch {
    /// Adds this one to those that have been made: to the one of the same surface, if there is one.
    fn join(self, batches: &mut Vec<Self>) {
        match batches
            .iter_mut()
            .find(|b| b.key == self.key && b.maps == self.maps && b.material == self.material)
        {
            Some(batch) => {
                for (all, own) in batch.levels.iter_mut().zip(self.levels) {
                    all.extend(own);
                }
            }
            None => batches.push(self),
        }
    }

    /// Returns the sort key of the batch, which determines the drawing order.
    fn place(&self) -> f64 {
        let before = match self.key.kind {
            MaterialKind::Cornea => 1,
            MaterialKind::Lash => 2,
            _ => 0,
        };
        let (alpha_mode, shadow) = (self.key.alpha_mode as u32, self.key.shadow() as u32);
        let bound = u32::from(self.key.bound);
        f64::from(
            (((alpha_mode * 8 + shadow) * 4 + before) * 2 + bound) * 32 + self.key.kind as u32,
        )
    }
}

impl FigureData {
    /// Packs a figure.
    ///
    /// # Errors
    /// Returns an error if the figure has too many joints or a mesh is inconsistent.
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
            bases: vec![0; figure.meshes.len()],
            shape: Vec::new(),
            fixed: Vec::new(),
            indices: Vec::new(),
            materials: Vec::new(),
            meshes: Vec::new(),
            morphed: Vec::new(),
            bound: Vec::new(),
            bound_vertices: 0,
            nodes: Nodes::from_meshes(figure.meshes.iter()),
        };
        let mut batches: Vec<Batch> = Vec::new();
        // The tissue stream needs only the length of the bound meshes.
        let meshes = figure.meshes.iter().enumerate();
        let (bound, free): (Vec<_>, Vec<_>) = meshes.partition(|(_, m)| m.binding.is_some());
        let face = face_place(figure);
        for (index, mesh) in bound.into_iter().chain(free) {
            check(mesh, joints)?;
            let key = PipelineKey::from_mesh(figure, mesh);
            data.bases[index] = data.shape.len();
            let material = MaterialUniform::from_mesh(mesh, key.alpha_mode, has_cornea, face);
            let maps = mesh.material.maps;
            let levels = data.push(mesh, key.alpha_mode);
            // Ends and gaps omitted by the alpha-tested cards are rendered over them from the scalp
            // outwards.
            if key.kind == MaterialKind::Hair {
                let soft = PipelineKey {
                    alpha_mode: AlphaMode::Blend,
                    ..key
                };
                let outwards = levels
                    .clone()
                    .map(|level| from_outside_in(level.into_iter()));
                batches.push(Batch {
                    key: soft,
                    maps,
                    material,
                    levels: outwards,
                });
            }
            let batch = Batch {
                key,
                maps,
                material,
                levels,
            };
            batch.join(&mut batches);
        }
        batches.retain(|b| !b.levels[0].is_empty());
        // Solid batches come first, grouped by shadow casting, so that their shadow is one call;
        // the wet surface of the eyes comes after the other transparent ones, and the hairs before
        // it.
        sort_by_number(&mut batches, Batch::place);
        data.pack(&batches);
        Ok(data)
    }

    /// Adds a mesh's vertices; returns its triangles at each level of detail.
    fn push(&mut self, mesh: &Mesh, alpha_mode: AlphaMode) -> [Vec<u32>; LEVELS] {
        let base = self.shape.len();
        self.shape.extend(shape_vertices(mesh));
        self.fixed.extend(fixed_vertices(mesh));
        self.morphed.extend(MorphedMesh::new(mesh, base));
        if mesh.binding.is_some() {
            self.bound_vertices = self.shape.len();
            self.bound.extend(BoundMesh::new(mesh, base));
        }
        let is_cards = alpha_mode == AlphaMode::Mask && mesh.material.kind != MaterialKind::Plain;
        std::array::from_fn(|level| {
            // WebGL2 has no base vertex, so the indices include the offset.
            let indices = mesh.triangles_at(level).iter().map(|i| i + base as u32);
            if is_cards {
                from_outside_in(indices)
            } else {
                indices.collect()
            }
        })
    }

    /// Arranges batches level by level, with batches of the same shadow mode contiguous.
    fn pack(&mut self, batches: &[Batch]) {
        for batch in batches {
            let material_offset = self.materials.len();
            self.materials
                .extend_from_slice(bytemuck::bytes_of(&batch.material));
            self.materials
                .resize(material_offset + MATERIAL_STRIDE as usize, 0);
            self.meshes.push(DrawnMesh {
                key: batch.key,
                maps: batch.maps,
                levels: std::array::from_fn(|_| 0..0),
                material_offset: material_offset as u32,
            });
        }
        for level in 0..LEVELS {
            for (batch, mesh) in batches.iter().zip(&mut self.meshes) {
                let first = self.indices.len() as u32;
                self.indices.extend(&batch.levels[level]);
                mesh.levels[level] = first..self.indices.len() as u32;
            }
        }
    }
}

/// Returns true if figures differ only in vertex positions, normals and colours, and in joint
/// positions: then one can replace the other mesh by mesh.
pub(crate) fn is_reshaped(before: &Figure, after: &Figure) -> bool {
    let is_alike = |(a, b): (&Mesh, &Mesh)| {
        let lengths = |m: &Mesh| [m.positions.len(), m.normals.len(), m.colors.len()];
        lengths(a) == lengths(b)
            && a.material == b.material
            && (&a.uvs, &a.joints, &a.weights) == (&b.uvs, &b.joints, &b.weights)
            && (&a.indices, &a.coarser) == (&b.indices, &b.coarser)
            && (&a.morphs, &a.binding) == (&b.morphs, &b.binding)
    };
    before.meshes.len() == after.meshes.len()
        && before.images.len() == after.images.len()
        && before.inverse_bind.len() == after.inverse_bind.len()
        && before.meshes.iter().zip(&after.meshes).all(is_alike)
}

/// Sets the position of the face in the materials.
pub(crate) fn place_face(materials: &mut [u8], figure: &Figure) {
    let face = face_place(figure);
    for bytes in materials.chunks_exact_mut(MATERIAL_STRIDE as usize) {
        let own = &mut bytes[..size_of::<MaterialUniform>()];
        let mut material: MaterialUniform = bytemuck::pod_read_unaligned(own);
        material.face = face;
        own.copy_from_slice(bytemuck::bytes_of(&material));
    }
}

/// Reverses the order of hair cards. They are listed from the scalp outwards; rendered from the
/// outside in, the depth test skips covered strands. Reversal flips a triangle, so its corners are
/// swapped back.
fn from_outside_in(indices: impl DoubleEndedIterator<Item = u32>) -> Vec<u32> {
    let mut indices: Vec<u32> = indices.rev().collect();
    for t in indices.chunks_exact_mut(3) {
        t.swap(0, 2);
    }
    indices
}

/// Returns the point between the eyes in the bind pose and, last, their distance, metres; all 0 for
/// a figure without eye joints.
fn face_place(figure: &Figure) -> [f32; 4] {
    let eye = |side: Side| {
        let joints = figure.skeleton.joints();
        let i = joints.iter().position(|j| j.drive == Drive::Eye(side))?;
        Some(figure.inverse_bind.get(i)?.inverse().translation)
    };
    match (eye(Side::Left), eye(Side::Right)) {
        (Some(l), Some(r)) if (l - r).is_finite() => {
            let middle = ((l + r) * 0.5).as_vec3();
            middle.extend((l - r).length() as f32).into()
        }
        _ => [0.0; 4],
    }
}

fn check(mesh: &Mesh, joints: usize) -> Result<(), RenderError> {
    let n = mesh.positions.len();
    let levels = || std::iter::once(&mesh.indices).chain(&mesh.coarser);
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
    } else if levels().any(|l| !l.len().is_multiple_of(3)) {
        "its indices do not make whole triangles"
    } else if levels().flatten().any(|&i| i as usize >= n) {
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
    } else if let Some(fault) = mesh.binding_fault() {
        fault
    } else {
        return Ok(());
    };
    Err(RenderError::BadMesh {
        mesh: mesh.name.clone(),
        problem,
    })
}

/// Computes world from bind of each joint as the shader's rows; `rows` is cleared first. Joints
/// missing in the frame stay in the bind pose.
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
