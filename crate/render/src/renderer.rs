//! Draws frames of one figure to any target of the chosen format.

use std::sync::{Arc, Mutex, PoisonError};

use raconteur_base::DAffine3;
use raconteur_body::{Figure, MaterialKind};
use raconteur_stage::Frame;
use wgpu::{Buffer, BufferUsages, Device, Queue, TextureFormat, TextureView};

use crate::figure::{DrawnMesh, FigureData, MATERIAL_STRIDE, MAX_JOINTS, draw_order, joint_rows};
use crate::morph::MorphedMesh;
use crate::pipeline::Pipelines;
use crate::shadow::ShadowView;
use crate::target::{DEPTH_FORMAT, TargetKind, Targets};
use crate::uniform::{FrameUniform, View, stand_in_world};
use crate::{RenderError, RenderInfo, RenderOptions};

/// The renderer: pipelines, the figure and the textures of the current size.
pub struct Renderer {
    device: Device,
    queue: Queue,
    pipelines: Pipelines,
    target_kind: TargetKind,
    targets: Option<(Targets, wgpu::BindGroup)>,
    frame_buffer: Buffer,
    frame_group: wgpu::BindGroup,
    lit_group: wgpu::BindGroup,
    shadow_map: TextureView,
    picture_sampler: wgpu::Sampler,
    figure: Option<GpuFigure>,
    rows: Vec<[f32; 4]>,
    info: RenderInfo,
    /// What the driver refused, if anything; told by the next picture.
    refused: Arc<Mutex<Option<String>>>,
}

struct GpuFigure {
    stature_m: f64,
    joint_from_bind: Vec<DAffine3>,
    shape: Buffer,
    fixed: Buffer,
    indices: Buffer,
    joints: Buffer,
    group: wgpu::BindGroup,
    meshes: Vec<DrawnMesh>,
    morphed: Vec<MorphedMesh>,
}

impl Renderer {
    /// A renderer on an open device, for targets of `target_format` (8 bits a channel;
    /// sRGB formats are recognised).
    #[must_use]
    pub fn new(
        adapter: &wgpu::Adapter,
        device: Device,
        queue: Queue,
        target_format: TextureFormat,
        options: RenderOptions,
    ) -> Self {
        let refused = Arc::new(Mutex::new(None));
        let slot = Arc::clone(&refused);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            let mut slot = slot.lock().unwrap_or_else(PoisonError::into_inner);
            slot.get_or_insert_with(|| error.to_string());
        }));

        let quality = options.quality;
        let target_kind = TargetKind::choose(adapter, quality.samples());
        let shadow_texels = quality
            .shadow_texels()
            .min(device.limits().max_texture_dimension_2d);
        let pipelines = Pipelines::new(&device, target_kind, target_format, quality);
        let layouts = &pipelines.layouts;

        let frame_buffer = empty_buffer(
            &device,
            "frame",
            size_of::<FrameUniform>() as u64,
            BufferUsages::UNIFORM,
        );
        let shadow_map = device
            .create_texture(&wgpu::TextureDescriptor {
                label: Some("shadow"),
                size: wgpu::Extent3d {
                    width: shadow_texels,
                    height: shadow_texels,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: DEPTH_FORMAT,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                    | wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            })
            .create_view(&wgpu::TextureViewDescriptor::default());
        let sampler = |compare| {
            device.create_sampler(&wgpu::SamplerDescriptor {
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                compare,
                ..Default::default()
            })
        };
        let shadow_sampler = sampler(Some(wgpu::CompareFunction::LessEqual));
        let frame_entry = binding(0, frame_buffer.as_entire_binding());
        let frame_group = bind_group(
            &device,
            "frame",
            &layouts.frame,
            std::slice::from_ref(&frame_entry),
        );
        let lit_group = bind_group(
            &device,
            "lit",
            &layouts.lit,
            &[
                frame_entry,
                binding(1, wgpu::BindingResource::TextureView(&shadow_map)),
                binding(2, wgpu::BindingResource::Sampler(&shadow_sampler)),
            ],
        );
        let adapter_info = adapter.get_info();
        Self {
            picture_sampler: sampler(None),
            frame_buffer,
            frame_group,
            lit_group,
            shadow_map,
            targets: None,
            figure: None,
            rows: Vec::with_capacity(3 * MAX_JOINTS),
            info: RenderInfo {
                backend: adapter_info.backend.to_str().to_owned(),
                adapter: adapter_info.name,
                samples: target_kind.samples,
                float_target: target_kind.is_float(),
                smooths_edges: target_kind.samples == 1,
                shadow_texels,
                draw_calls: 0,
                triangles: 0,
            },
            pipelines,
            target_kind,
            device,
            queue,
            refused,
        }
    }

    /// What the renderer turned out to be, with the counts of the last picture.
    #[must_use]
    pub fn info(&self) -> &RenderInfo {
        &self.info
    }

    /// Sends a figure to the device, in place of the one before.
    ///
    /// # Errors
    /// When it has more than 128 joints or a mesh contradicts itself; the figure before stays.
    pub fn set_figure(&mut self, figure: &Figure) -> Result<(), RenderError> {
        let data = FigureData::new(figure)?;
        for mesh in &data.meshes {
            self.pipelines
                .prepare(&self.device, mesh.kind, mesh.double_sided);
        }
        if data.meshes.is_empty() {
            self.figure = None;
            return Ok(());
        }
        let filled = |label, bytes: &[u8], usage| {
            let buffer = empty_buffer(&self.device, label, bytes.len() as u64, usage);
            self.queue.write_buffer(&buffer, 0, bytes);
            buffer
        };
        let shape = filled(
            "shape",
            bytemuck::cast_slice(&data.shape),
            BufferUsages::VERTEX,
        );
        let fixed = filled(
            "fixed",
            bytemuck::cast_slice(&data.fixed),
            BufferUsages::VERTEX,
        );
        let indices = filled(
            "indices",
            bytemuck::cast_slice(&data.indices),
            BufferUsages::INDEX,
        );
        let materials = filled("materials", &data.materials, BufferUsages::UNIFORM);
        let joints = empty_buffer(
            &self.device,
            "joints",
            (3 * MAX_JOINTS * 16) as u64,
            BufferUsages::UNIFORM,
        );
        let group = bind_group(
            &self.device,
            "figure",
            &self.pipelines.layouts.figure,
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
        self.figure = Some(GpuFigure {
            stature_m: figure.skeleton.stature_m(),
            joint_from_bind: figure.inverse_bind.clone(),
            shape,
            fixed,
            indices,
            joints,
            group,
            meshes: data.meshes,
            morphed: data.morphed,
        });
        Ok(())
    }

    /// Draws a frame into `view`, a texture of the renderer's format and of `size` pixels.
    ///
    /// Joints and morph weights that the frame lacks stay at rest. In a steady state
    /// (same figure and size) nothing is allocated on this side of wgpu.
    ///
    /// # Errors
    /// When the size is zero or beyond the device, or the driver refused a pipeline.
    pub fn render(
        &mut self,
        frame: &Frame,
        view: &TextureView,
        size: (u32, u32),
    ) -> Result<(), RenderError> {
        self.fit(size)?;
        self.send(frame, size);
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut counts = Counts::default();
        self.draw_shadow(&mut encoder, &mut counts);
        self.draw_stage(&mut encoder, &mut counts);
        self.draw_last(&mut encoder, view, &mut counts);
        self.queue.submit([encoder.finish()]);
        self.info.draw_calls = counts.draw_calls;
        self.info.triangles = counts.triangles;
        let mut refused = self.refused.lock().unwrap_or_else(PoisonError::into_inner);
        refused
            .take()
            .map_or(Ok(()), |message| Err(RenderError::Refused(message)))
    }

    /// Shows a drawn texture of a surface.
    #[cfg(target_arch = "wasm32")]
    pub(crate) fn present(&self, texture: wgpu::SurfaceTexture) {
        self.queue.present(texture);
    }

    /// Makes the textures of this size, if they are not there yet.
    fn fit(&mut self, size: (u32, u32)) -> Result<(), RenderError> {
        if self.targets.as_ref().is_some_and(|(t, _)| t.size == size) {
            return Ok(());
        }
        let limit = self.device.limits().max_texture_dimension_2d;
        let (width, height) = size;
        if width == 0 || height == 0 || width > limit || height > limit {
            return Err(RenderError::BadSize {
                width,
                height,
                limit,
            });
        }
        let targets = Targets::new(&self.device, self.target_kind, size);
        let group = bind_group(
            &self.device,
            "last",
            &self.pipelines.layouts.last,
            &[
                binding(0, self.frame_buffer.as_entire_binding()),
                binding(1, wgpu::BindingResource::TextureView(&targets.picture)),
                binding(2, wgpu::BindingResource::Sampler(&self.picture_sampler)),
            ],
        );
        self.targets = Some((targets, group));
        Ok(())
    }

    /// Sends what changes from frame to frame.
    fn send(&mut self, frame: &Frame, size: (u32, u32)) {
        let stature_m = self.figure.as_ref().map_or(1.7, |f| f.stature_m);
        let view = View::new(&frame.camera, f64::from(size.0) / f64::from(size.1));
        let shadow = ShadowView::new(
            &frame.lighting.key,
            &frame.camera,
            &view,
            stand_in_world(frame),
            stature_m,
            self.info.shadow_texels,
        );
        let uniform = FrameUniform::new(frame, &view, &shadow, stature_m, size);
        self.queue
            .write_buffer(&self.frame_buffer, 0, bytemuck::bytes_of(&uniform));
        let Some(figure) = &mut self.figure else {
            return;
        };
        joint_rows(
            &frame.world_from_joint,
            &figure.joint_from_bind,
            &mut self.rows,
        );
        self.queue
            .write_buffer(&figure.joints, 0, bytemuck::cast_slice(&self.rows));
        for mesh in &mut figure.morphed {
            if mesh.apply(&frame.morph_weights) {
                let offset = (mesh.first_vertex * size_of_val(&mesh.current[0])) as u64;
                self.queue
                    .write_buffer(&figure.shape, offset, bytemuck::cast_slice(&mesh.current));
            }
        }
    }

    fn draw_shadow(&self, encoder: &mut wgpu::CommandEncoder, counts: &mut Counts) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.shadow_map,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        let Some(figure) = &self.figure else { return };
        pass.set_bind_group(0, &self.frame_group, &[]);
        figure.bind(&mut pass);
        for mesh in figure.meshes.iter().filter(|m| casts(m.kind)) {
            let cut = mesh.kind == MaterialKind::Hair;
            pass.set_pipeline(if cut {
                &self.pipelines.shadow_cut
            } else {
                &self.pipelines.shadow
            });
            figure.draw(&mut pass, mesh, counts);
        }
    }

    fn draw_stage(&self, encoder: &mut wgpu::CommandEncoder, counts: &mut Counts) {
        let Some((targets, _)) = &self.targets else {
            return;
        };
        let color = match &targets.samples {
            Some(samples) => (samples, Some(&targets.picture), wgpu::StoreOp::Discard),
            None => (&targets.picture, None, wgpu::StoreOp::Store),
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("stage"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: color.0,
                depth_slice: None,
                resolve_target: color.1,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store: color.2,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &targets.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_bind_group(0, &self.lit_group, &[]);
        // What is solid goes first; then the theatre fills what is left; then what adds light.
        self.draw_meshes(&mut pass, counts, |order| order < 2);
        pass.set_pipeline(&self.pipelines.theatre);
        pass.draw(0..3, 0..1);
        counts.add(1);
        self.draw_meshes(&mut pass, counts, |order| order == 2);
    }

    fn draw_meshes(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        counts: &mut Counts,
        wanted: impl Fn(u8) -> bool,
    ) {
        let Some(figure) = &self.figure else { return };
        figure.bind(pass);
        for mesh in figure.meshes.iter().filter(|m| wanted(draw_order(m.kind))) {
            if let Some(pipeline) = self.pipelines.material(mesh.kind, mesh.double_sided) {
                pass.set_pipeline(pipeline);
                figure.draw(pass, mesh, counts);
            }
        }
    }

    fn draw_last(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        view: &TextureView,
        counts: &mut Counts,
    ) {
        let Some((_, group)) = &self.targets else {
            return;
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("last"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        pass.set_pipeline(&self.pipelines.last);
        pass.set_bind_group(0, group, &[]);
        pass.draw(0..3, 0..1);
        counts.add(1);
    }
}

impl GpuFigure {
    fn bind(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.shape.slice(..));
        pass.set_vertex_buffer(1, self.fixed.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>, mesh: &DrawnMesh, counts: &mut Counts) {
        pass.set_bind_group(1, &self.group, &[mesh.material_offset]);
        pass.draw_indexed(mesh.indices.clone(), 0, 0..1);
        counts.add(mesh.indices.len() as u32 / 3);
    }
}

#[derive(Default)]
struct Counts {
    draw_calls: u32,
    triangles: u32,
}

impl Counts {
    fn add(&mut self, triangles: u32) {
        self.draw_calls += 1;
        self.triangles += triangles;
    }
}

/// Whether a kind casts a shadow. What lies inside the head is shaded by its occlusion,
/// lashes are finer than the map, and the tear layer is clear.
fn casts(kind: MaterialKind) -> bool {
    !matches!(
        kind,
        MaterialKind::Eye
            | MaterialKind::Cornea
            | MaterialKind::Teeth
            | MaterialKind::Mouth
            | MaterialKind::Lash
    )
}

fn empty_buffer(device: &Device, label: &str, size: u64, usage: BufferUsages) -> Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: usage | BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn binding(binding: u32, resource: wgpu::BindingResource<'_>) -> wgpu::BindGroupEntry<'_> {
    wgpu::BindGroupEntry { binding, resource }
}

fn bind_group(
    device: &Device,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    entries: &[wgpu::BindGroupEntry<'_>],
) -> wgpu::BindGroup {
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(label),
        layout,
        entries,
    })
}
