//! Figure on the device: buffers, textures and draw lists.

use raconteur_base::{DAffine3, DVec3};
use raconteur_body::face::NodeState;
use raconteur_body::figure::{Figure, TextureMaps};
use raconteur_body::skeleton::{Drive, Joint};
use raconteur_stage::{Fill, Frame, Visibility};
use wgpu::{Buffer, BufferUsages, Device, Queue, TextureView};

use crate::RenderError;
use crate::counts::Counts;
use crate::detail::Detail;
use crate::fallback::FallbackTextures;
use crate::figure::{
    DrawnMesh, FigureData, MATERIAL_STRIDE, MAX_JOINTS, PipelineKey, Shadow, is_reshaped,
    joint_rows, place_face,
};
use crate::gpu::{bind_group, binding, empty_buffer};
use crate::layouts::Layouts;
use crate::lid::LidEdge;
use crate::lip::Lips;
use crate::morph::{MorphedMesh, ShapeVertex};
use crate::texture::{self, Role};
use crate::tissue::{BoundMesh, Nodes, TissueVertex};
use crate::vertices::{FixedVertex, fixed_vertices, shape_vertices};

/// Figure on the GPU: buffers, textures, bind groups and draw calls.
pub(crate) struct GpuFigure {
    pub(crate) stature_m: f64,
    joint_from_bind: Vec<DAffine3>,
    /// A joint of its face, if it has one.
    face: Option<usize>,
    lids: [Option<LidEdge>; 4],
    lips: Lips,
    shape: Buffer,
    fixed: Buffer,
    indices: Buffer,
    /// Triangles, stored for the edges of a wireframe.
    triangles: Vec<u32>,
    /// Both ends of every edge of the triangles, twice as many; uploaded on first use.
    edges: Option<Buffer>,
    joints: Buffer,
    materials: Buffer,
    /// Content of `materials`.
    material_bytes: Vec<u8>,
    /// The first vertex of each of the figure's meshes.
    bases: Vec<usize>,
    /// True for each mesh that differs from an earlier one only in its shape.
    is_behind: Vec<bool>,
    group: wgpu::BindGroup,
    meshes: Vec<DrawnMesh>,
    morphed: Vec<MorphedMesh>,
    tissue: Option<GpuTissue>,
    /// Colour, normals and heights of each of the figure's images, if required and loaded.
    pictures: Vec<[Option<TextureView>; 3]>,
    /// Bind groups of textures that meshes use together.
    maps: Vec<(TextureMaps, wgpu::BindGroup)>,
}

/// Vertices bound to tissue, which precede all others.
struct GpuTissue {
    vertices: Buffer,
    nodes: Nodes,
    meshes: Vec<BoundMesh>,
    /// The level of detail whose vertices were sent.
    level: usize,
}

impl GpuTissue {
    /// Uploads the nodes' state for the rendered level of detail, if it or the level has changed.
    fn follow(&mut self, queue: &Queue, states: &[NodeState], level: usize) {
        let is_as_sent = !self.nodes.update(states) && self.level == level;
        if is_as_sent {
            return;
        }
        self.level = level;
        for mesh in &mut self.meshes {
            mesh.apply(&self.nodes, level);
            let offset = (mesh.first_vertex * size_of::<TissueVertex>()) as u64;
            queue.write_buffer(&self.vertices, offset, bytemuck::cast_slice(&mesh.current));
        }
    }
}

impl GpuFigure {
    /// Uploads a figure without its images; `None` if nothing of it is visible.
    ///
    /// # Errors
    /// Returns an error if the figure has too many joints or a mesh is inconsistent.
    pub(crate) fn new(
        device: &Device,
        queue: &Queue,
        layouts: &Layouts,
        fallback: &FallbackTextures,
        figure: &Figure,
    ) -> Result<Option<Self>, RenderError> {
        let data = FigureData::new(figure)?;
        if data.meshes.is_empty() {
            return Ok(None);
        }
        let filled = |label, bytes: &[u8], usage| {
            let buffer = empty_buffer(device, label, bytes.len() as u64, usage);
            queue.write_buffer(&buffer, 0, bytes);
            buffer
        };
        let shape = bytemuck::cast_slice(&data.shape);
        let fixed = bytemuck::cast_slice(&data.fixed);
        let indices = bytemuck::cast_slice(&data.indices);
        let materials = filled("materials", &data.materials, BufferUsages::UNIFORM);
        let joints = empty_buffer(
            device,
            "joints",
            (3 * MAX_JOINTS * 16) as u64,
            BufferUsages::UNIFORM,
        );
        let group = bind_group(
            device,
            "figure",
            &layouts.figure,
            &[
                binding(0, joints.as_entire_binding()),
                binding(
                    1,
                    wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                        buffer: &materials,
                        offset: 0,
                        size: std::num::NonZeroU64::new(MATERIAL_STRIDE),
                    }),
                ),
            ],
        );
        let tissue = (data.bound_vertices > 0).then(|| {
            let rest = vec![TissueVertex::REST; data.bound_vertices];
            GpuTissue {
                vertices: filled("tissue", bytemuck::cast_slice(&rest), BufferUsages::VERTEX),
                nodes: data.nodes,
                meshes: data.bound,
                level: 0,
            }
        });
        let mut sent = Self {
            stature_m: figure.skeleton.stature_m(),
            joint_from_bind: figure.inverse_bind.clone(),
            face: face_joint(figure),
            lids: LidEdge::from_figure(figure),
            lips: Lips::from_figure(figure),
            shape: filled("shape", shape, BufferUsages::VERTEX),
            fixed: filled("fixed", fixed, BufferUsages::VERTEX),
            indices: filled("indices", indices, BufferUsages::INDEX),
            triangles: data.indices,
            edges: None,
            joints,
            materials,
            material_bytes: data.materials,
            is_behind: vec![false; data.bases.len()],
            bases: data.bases,
            group,
            meshes: data.meshes,
            morphed: data.morphed,
            tissue,
            pictures: vec![[None, None, None]; figure.images.len()],
            maps: Vec::new(),
        };
        sent.group_maps(device, layouts, fallback);
        Ok(Some(sent))
    }

    /// Uploads the differences of another shape of the figure that was uploaded last; returns
    /// false, and does nothing, if that is not possible. With `moves`, only vertex positions and
    /// colours are updated.
    pub(crate) fn reshape(
        &mut self,
        queue: &Queue,
        before: &Figure,
        after: &Figure,
        moves: bool,
    ) -> bool {
        if !is_reshaped(before, after) {
            return false;
        }
        let meshes = before.meshes.iter().zip(&after.meshes);
        let sent = self.bases.iter().zip(&mut self.is_behind);
        for ((was, mesh), (&base, is_behind)) in meshes.zip(sent) {
            let is_same = (&was.positions, &was.normals) == (&mesh.positions, &mesh.normals);
            let is_coloured = was.colors != mesh.colors;
            let at = |size: usize| (base * size) as u64;
            if is_coloured || !moves && (*is_behind || !is_same) {
                let fixed = fixed_vertices(mesh);
                queue.write_buffer(
                    &self.fixed,
                    at(size_of::<FixedVertex>()),
                    bytemuck::cast_slice(&fixed),
                );
                *is_behind = false;
            } else {
                *is_behind |= !is_same;
            }
            if is_same {
                continue;
            }
            let shape = shape_vertices(mesh);
            queue.write_buffer(
                &self.shape,
                at(size_of::<ShapeVertex>()),
                bytemuck::cast_slice(&shape),
            );
            let own = base..base + mesh.positions.len();
            let morphed = self.morphed.iter_mut();
            for morphed in morphed.filter(|m| own.contains(&m.first_vertex)) {
                if let Some(new) = MorphedMesh::new(mesh, base) {
                    *morphed = new;
                }
            }
        }
        place_face(&mut self.material_bytes, after);
        queue.write_buffer(&self.materials, 0, &self.material_bytes);
        self.joint_from_bind.clone_from(&after.inverse_bind);
        self.stature_m = after.skeleton.stature_m();
        self.face = face_joint(after);
        self.lids = LidEdge::from_figure(after);
        self.lips = Lips::from_figure(after);
        true
    }

    /// Takes over the previous figure's images, if their number is equal.
    pub(crate) fn take_pictures(
        &mut self,
        before: Self,
        device: &Device,
        layouts: &Layouts,
        fallback: &FallbackTextures,
    ) {
        if before.pictures.len() == self.pictures.len() {
            self.pictures = before.pictures;
            self.group_maps(device, layouts, fallback);
        }
    }

    /// Rebuilds the texture bind groups, with blanks for missing textures.
    fn group_maps(&mut self, device: &Device, layouts: &Layouts, fallback: &FallbackTextures) {
        self.maps.clear();
        // Without images, only blank textures are used.
        let all = self
            .meshes
            .iter()
            .map(|m| m.maps)
            .chain([TextureMaps::default()]);
        for wanted in all {
            if self.maps.iter().any(|(maps, _)| *maps == wanted) {
                continue;
            }
            let come = |index: Option<usize>, role: usize| {
                index.and_then(|i| self.pictures.get(i)?[role].as_ref())
            };
            let color = come(wanted.base_color, 0).unwrap_or(&fallback.white);
            let normal = come(wanted.normal, 1).unwrap_or(&fallback.flat);
            let wrinkles = come(wanted.wrinkles, 2).unwrap_or(&fallback.level);
            let group = bind_group(
                device,
                "maps",
                &layouts.maps,
                &[
                    binding(0, wgpu::BindingResource::TextureView(color)),
                    binding(1, wgpu::BindingResource::TextureView(normal)),
                    binding(2, wgpu::BindingResource::Sampler(&fallback.sampler)),
                    binding(3, wgpu::BindingResource::TextureView(wrinkles)),
                    binding(4, wgpu::BindingResource::TextureView(&fallback.strands)),
                    binding(5, wgpu::BindingResource::Sampler(&fallback.strand_sampler)),
                ],
            );
            self.maps.push((wanted, group));
        }
    }

    /// Sends the edges of the triangles, if they have not been sent.
    pub(crate) fn prepare_edges(&mut self, device: &Device, queue: &Queue) {
        if self.edges.is_some() {
            return;
        }
        let triangles = std::mem::take(&mut self.triangles);
        let mut ends = Vec::with_capacity(2 * triangles.len());
        for t in triangles.chunks_exact(3) {
            ends.extend([t[0], t[1], t[1], t[2], t[2], t[0]]);
        }
        let bytes: &[u8] = bytemuck::cast_slice(&ends);
        let buffer = empty_buffer(device, "edges", bytes.len() as u64, BufferUsages::INDEX);
        queue.write_buffer(&buffer, 0, bytes);
        self.edges = Some(buffer);
    }

    /// Sets a decoded image in the materials that use it; discards an unused one.
    ///
    /// # Errors
    /// Returns an error if the image's bytes do not match its size, or it is too large.
    pub(crate) fn set_image(
        &mut self,
        (device, queue): (&Device, &Queue),
        (layouts, fallback): (&Layouts, &FallbackTextures),
        index: usize,
        (width, height): (u32, u32),
        rgba: &[u8],
    ) -> Result<(), RenderError> {
        texture::check(width, height, rgba)?;
        let Some(slots) = self.pictures.get_mut(index) else {
            return Ok(());
        };
        let wanted = Some(index);
        let shown = |of: fn(&TextureMaps) -> Option<usize>| {
            self.meshes.iter().any(|m| of(&m.maps) == wanted)
        };
        for (slot, role, shown) in [
            (0, Role::Color, shown(|m| m.base_color)),
            (1, Role::Normal, shown(|m| m.normal)),
            (2, Role::Height, shown(|m| m.wrinkles)),
        ] {
            if shown {
                slots[slot] = Some(texture::upload(device, queue, role, width, height, rgba));
            }
        }
        self.group_maps(device, layouts, fallback);
        Ok(())
    }

    /// Returns the pipeline keys of its meshes.
    pub(crate) fn pipeline_keys(&self) -> impl Iterator<Item = PipelineKey> {
        self.meshes.iter().map(|m| m.key)
    }

    /// Returns the present position of its face, world, metres.
    pub(crate) fn face(&self, world_from_joint: &[DAffine3]) -> Option<DVec3> {
        Some(world_from_joint.get(self.face?)?.translation)
    }

    /// Returns the present planes of the lid edges, see [`LidEdge::plane`].
    pub(crate) fn lids(&self, world_from_joint: &[DAffine3]) -> [[f32; 4]; 4] {
        self.lids
            .map(|lid| LidEdge::plane(lid, world_from_joint, &self.joint_from_bind))
    }

    /// Returns the present distance of its lips, see [`Lips::apart_mm`].
    pub(crate) fn lips_apart_mm(&self, nodes: &[NodeState]) -> f32 {
        self.lips.apart_mm(nodes)
    }

    /// Uploads the present joints, morphs and tissue for a level of detail; `rows` is a scratch
    /// buffer.
    pub(crate) fn pose(
        &mut self,
        queue: &Queue,
        frame: &Frame,
        level: usize,
        rows: &mut Vec<[f32; 4]>,
    ) {
        joint_rows(&frame.world_from_joint, &self.joint_from_bind, rows);
        queue.write_buffer(&self.joints, 0, bytemuck::cast_slice(rows));
        for mesh in &mut self.morphed {
            if mesh.apply(&frame.morph_weights) {
                let offset = (mesh.first_vertex * size_of_val(&mesh.current[0])) as u64;
                queue.write_buffer(&self.shape, offset, bytemuck::cast_slice(&mesh.current));
            }
        }
        if let Some(tissue) = &mut self.tissue {
            tissue.follow(queue, &frame.tissue, level);
        }
    }

    /// Returns true if some of its vertices are bound to tissue.
    pub(crate) fn has_tissue(&self) -> bool {
        self.tissue.is_some()
    }

    fn bind(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.shape.slice(..));
        pass.set_vertex_buffer(1, self.fixed.slice(..));
        if let Some(tissue) = &self.tissue {
            pass.set_vertex_buffer(2, tissue.vertices.slice(..));
        }
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
    }

    fn bind_maps(&self, pass: &mut wgpu::RenderPass<'_>, maps: TextureMaps) {
        if let Some((_, group)) = self.maps.iter().find(|(m, _)| *m == maps) {
            pass.set_bind_group(2, group, &[]);
        }
    }

    /// Draws the meshes selected by `wanted`, according to `shown`.
    pub(crate) fn draw<'p>(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        counts: &mut Counts,
        (shown, detail): (&Visibility, Detail),
        wanted: impl Fn(PipelineKey) -> bool,
        pipeline: impl Fn(PipelineKey) -> Option<&'p wgpu::RenderPipeline>,
    ) {
        self.bind(pass);
        let mut ends = 1;
        if let (Fill::Wireframe, Some(edges)) = (shown.fill, &self.edges) {
            pass.set_index_buffer(edges.slice(..), wgpu::IndexFormat::Uint32);
            ends = 2;
        }
        for mesh in self.meshes.iter().filter(|m| wanted(m.key)) {
            if let Some(pipeline) = pipeline(mesh.key) {
                pass.set_pipeline(pipeline);
                pass.set_bind_group(1, &self.group, &[mesh.material_offset]);
                let maps = if shown.textures {
                    mesh.maps
                } else {
                    TextureMaps::default()
                };
                self.bind_maps(pass, maps);
                let indices = &mesh.levels[detail.level_for(mesh.key.kind)];
                pass.draw_indexed(indices.start * ends..indices.end * ends, 0, 0..1);
                counts.add_figure(indices.len() as u32 / 3);
            }
        }
    }

    /// Draws the shadow casters; contiguous meshes share one draw call.
    pub(crate) fn draw_shadow<'p>(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        counts: &mut Counts,
        detail: Detail,
        pipeline: impl Fn(Shadow, bool) -> Option<&'p wgpu::RenderPipeline>,
    ) {
        self.bind(pass);
        let mut rest = self.meshes.as_slice();
        while let Some(first) = rest.first() {
            let (shadow, bound) = (first.key.shadow(), first.key.bound);
            let alike = |m: &&DrawnMesh| {
                (m.key.shadow(), m.key.bound) == (shadow, bound)
                    && (!is_cut(shadow) || m.maps == first.maps)
            };
            let count = rest.iter().take_while(alike).count();
            let (run, after) = rest.split_at(count);
            rest = after;
            let (Some(last), Some(pipeline)) = (run.last(), pipeline(shadow, bound)) else {
                continue;
            };
            pass.set_pipeline(pipeline);
            pass.set_bind_group(1, &self.group, &[first.material_offset]);
            if is_cut(shadow) {
                self.bind_maps(pass, first.maps);
            }
            let level = detail.of_caster(shadow);
            let indices = first.levels[level].start..last.levels[level].end;
            counts.add_figure(indices.len() as u32 / 3);
            pass.draw_indexed(indices, 0, 0..1);
        }
    }
}

/// Returns true if a shadow is cut out by a texture.
fn is_cut(shadow: Shadow) -> bool {
    matches!(shadow, Shadow::Strands | Shadow::Picture)
}

/// Returns the index of an eye joint; `None` if the figure has none.
fn face_joint(figure: &Figure) -> Option<usize> {
    let is_eye = |j: &Joint| matches!(j.drive, Drive::Eye(_));
    figure.skeleton.joints().iter().position(is_eye)
}
