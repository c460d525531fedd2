//! Renderer of one figure to any target of the selected format.

mod change;
mod passes;

use raconteur_body::Figure;
use raconteur_stage::{Fill, Frame, StageSet};
use wgpu::{Buffer, BufferUsages, Device, Queue, TextureFormat, TextureView};

use crate::backdrop::{Backdrop, BackdropMode};
use crate::counts::Counts;
use crate::detail::{self, Detail};
use crate::device_errors::DeviceErrors;
use crate::fallback::FallbackTextures;
use crate::figure::MAX_JOINTS;
use crate::gpu::{bind_group, binding, empty_buffer};
use crate::gpu_figure::GpuFigure;
use crate::lines::Lines;
use crate::overlay::Overlay;
use crate::pipeline::SharedResources;
use crate::shadow::{ShadowSubject, ShadowView};
use crate::target::{TargetKind, Targets};
use crate::tier::Tier;
use crate::uniform::{FrameUniform, stand_in_world};
use crate::view::View;
use crate::{Quality, RenderError, RenderInfo, RenderOptions};

/// Renderer of one figure on a stage set, for any target of the chosen format.
pub struct Renderer {
    device: Device,
    queue: Queue,
    shared: SharedResources,
    fallback: FallbackTextures,
    /// Target kind of the adapter at each quality.
    target_kinds: [TargetKind; Quality::NAMES.len()],
    tier: Tier,
    /// The next quality, while its programs are being compiled.
    coming: Option<Tier>,
    targets: Option<Targets>,
    /// Bindings of the tone-map pass, if there is one.
    tone_map_group: Option<wgpu::BindGroup>,
    /// The stage as a still, at qualities that draw it so.
    backdrop: Option<Backdrop>,
    /// Backdrop mode of the current image.
    backdrop_drawn: BackdropMode,
    frame_buffer: Buffer,
    frame_group: wgpu::BindGroup,
    picture_sampler: wgpu::Sampler,
    figure: Option<GpuFigure>,
    /// Level of detail in the current image.
    detail: Detail,
    rows: Vec<[f32; 4]>,
    /// The overlay, once it was requested.
    overlay: Option<Overlay>,
    /// Lines over figures, once there were any.
    lines: Option<Lines>,
    info: RenderInfo,
    /// Driver error, if any; returned by the next image.
    refused: DeviceErrors,
}

impl Renderer {
    /// Creates a renderer on an open device, for targets of `target_format` (8 bits per channel;
    /// sRGB formats are recognised).
    #[must_use]
    pub fn new(
        adapter: &wgpu::Adapter,
        device: Device,
        queue: Queue,
        target_format: TextureFormat,
        options: RenderOptions,
    ) -> Self {
        let refused = DeviceErrors::new(&device);

        let target_kinds =
            Quality::NAMES.map(|(quality, _)| TargetKind::choose(adapter, quality, target_format));
        let shared = SharedResources::new(&device, target_format);
        let frame_buffer = empty_buffer(
            &device,
            "frame",
            size_of::<FrameUniform>() as u64,
            BufferUsages::UNIFORM,
        );
        let frame_group = bind_group(
            &device,
            "frame",
            &shared.layouts.frame,
            &[binding(0, frame_buffer.as_entire_binding())],
        );
        let kind = target_kinds[options.quality as usize];
        let tier = Tier::new(&device, &shared, kind, &frame_buffer, options);
        let adapter_info = adapter.get_info();
        let mut renderer = Self {
            picture_sampler: device.create_sampler(&wgpu::SamplerDescriptor {
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            }),
            fallback: FallbackTextures::new(adapter, &device, &queue),
            shared,
            target_kinds,
            tier,
            coming: None,
            frame_buffer,
            frame_group,
            targets: None,
            tone_map_group: None,
            backdrop: None,
            backdrop_drawn: BackdropMode::Directly,
            figure: None,
            detail: Detail::new(options.quality, None),
            overlay: None,
            lines: None,
            rows: Vec::with_capacity(3 * MAX_JOINTS),
            info: RenderInfo {
                options,
                backend: adapter_info.backend.to_str().to_owned(),
                software: crate::device::is_software(&adapter_info),
                adapter: adapter_info.name,
                samples: 1,
                float_target: kind.is_float(),
                smooths_edges: true,
                shadow_texels: 0,
                figure_draw_calls: 0,
                draw_calls: 0,
                triangles: 0,
            },
            device,
            queue,
            refused,
        };
        // Most stories begin before a curtain.
        renderer.compile(StageSet::Curtain);
        renderer.update_tier();
        renderer
    }

    /// Returns the renderer's properties, with the counts of the last image.
    #[must_use]
    pub fn info(&self) -> &RenderInfo {
        &self.info
    }

    /// Uploads a figure, replacing the previous one. Its textures are white and flat until
    /// [`Self::set_image`].
    ///
    /// # Errors
    /// Returns an error if the figure has more than 256 joints or a mesh is inconsistent; the
    /// previous figure is then kept.
    pub fn set_figure(&mut self, figure: &Figure) -> Result<(), RenderError> {
        let layouts = &self.shared.layouts;
        self.figure = GpuFigure::new(&self.device, &self.queue, layouts, &self.fallback, figure)?;
        self.compile(StageSet::Curtain);
        Ok(())
    }

    /// Uploads another shape of the figure, for example with another face; `before` was uploaded
    /// last. Loaded images are kept if their number is equal, and equal parts are not uploaded
    /// again. With `moves`, for an intermediate shape, the curvature of skin and the direction of
    /// strands are kept until a final shape.
    ///
    /// # Errors
    /// Returns the same errors as [`Renderer::set_figure`].
    pub fn set_shape(
        &mut self,
        before: &Figure,
        figure: &Figure,
        moves: bool,
    ) -> Result<(), RenderError> {
        if let Some(sent) = &mut self.figure
            && sent.reshape(&self.queue, before, figure, moves)
        {
            return Ok(());
        }
        let layouts = &self.shared.layouts;
        let mut made = GpuFigure::new(&self.device, &self.queue, layouts, &self.fallback, figure)?;
        if let (Some(made), Some(sent)) = (&mut made, self.figure.take()) {
            made.take_pictures(sent, &self.device, layouts, &self.fallback);
        }
        self.figure = made;
        self.compile(StageSet::Curtain);
        Ok(())
    }

    /// Sets a decoded image of the figure: `index` as in `Figure::images`, RGBA bytes in rows from
    /// the top. An unused one is discarded.
    ///
    /// # Errors
    /// Returns an error if there are not four bytes per pixel, or a side is zero or longer than
    /// [`MAX_SIDE_PX`](crate::MAX_SIDE_PX); the previous image is then kept.
    pub fn set_image(
        &mut self,
        index: usize,
        width: u32,
        height: u32,
        rgba: &[u8],
    ) -> Result<(), RenderError> {
        let Some(figure) = &mut self.figure else {
            return Ok(());
        };
        figure.set_image(
            (&self.device, &self.queue),
            (&self.shared.layouts, &self.fallback),
            index,
            (width, height),
            rgba,
        )
    }

    /// Draws a frame into `view`, a texture of the renderer's format and of `size` pixels.
    ///
    /// Joints, morph weights and tissue nodes that the frame lacks stay at rest. In a steady state
    /// (same figure and size), nothing is allocated on this side of wgpu.
    ///
    /// # Errors
    /// Returns an error if the size is zero or exceeds the limits of the device, or if the driver
    /// rejected a pipeline.
    pub fn render(
        &mut self,
        frame: &Frame,
        view: &TextureView,
        size: (u32, u32),
    ) -> Result<(), RenderError> {
        self.resume(frame.set.kind);
        self.fit(size)?;
        self.send(frame, size);
        self.send_shown(frame);
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut counts = Counts::default();
        self.draw_shadow(&mut encoder, &frame.visibility, &mut counts);
        self.draw_backdrop(&mut encoder, &mut counts);
        self.draw_stage(&mut encoder, view, &frame.visibility, &mut counts);
        self.tone_map(&mut encoder, view, &mut counts);
        self.queue.submit([encoder.finish()]);
        self.info.figure_draw_calls = counts.figure_draw_calls;
        self.info.draw_calls = counts.draw_calls;
        self.info.triangles = counts.triangles;
        self.refused
            .take_first()
            .map_or(Ok(()), |message| Err(RenderError::Refused(message)))
    }

    /// Presents a rendered surface texture.
    #[cfg(target_arch = "wasm32")]
    pub(crate) fn present(&self, texture: wgpu::SurfaceTexture) {
        self.queue.present(texture);
    }

    /// Creates the textures for this image size, if missing.
    fn fit(&mut self, size: (u32, u32)) -> Result<(), RenderError> {
        let (width, height) = size;
        let limit = self.device.limits().max_texture_dimension_2d;
        if width == 0 || height == 0 || width > limit || height > limit {
            return Err(RenderError::BadSize {
                width,
                height,
                limit,
            });
        }
        if self.targets.as_ref().is_some_and(|t| t.size == size) {
            return Ok(());
        }
        let targets = Targets::new(&self.device, self.tier.target, size);
        self.tone_map_group = targets.picture.as_ref().map(|picture| {
            bind_group(
                &self.device,
                "tone map",
                &self.shared.layouts.tone_map,
                &[
                    binding(0, self.frame_buffer.as_entire_binding()),
                    binding(1, wgpu::BindingResource::TextureView(picture)),
                    binding(2, wgpu::BindingResource::Sampler(&self.picture_sampler)),
                ],
            )
        });
        self.backdrop = self.tier.target.is_direct.then(|| {
            Backdrop::new(
                &self.device,
                &self.shared.layouts,
                &self.frame_buffer,
                &self.picture_sampler,
                self.tier.target.format,
                size,
            )
        });
        self.targets = Some(targets);
        Ok(())
    }

    /// Uploads the data that change from frame to frame.
    fn send(&mut self, frame: &Frame, size: (u32, u32)) {
        let stature_m = self.figure.as_ref().map_or(1.7, |f| f.stature_m);
        let view = View::new(&frame.camera, f64::from(size.0) / f64::from(size.1));
        let subject = ShadowSubject {
            camera: &frame.camera,
            view: &view,
            feet_in_world: stand_in_world(frame),
            stature_m,
        };
        let softness = f64::from(frame.lighting.softness);
        let texels = self.tier.shadow_texels;
        let shadows = [&frame.lighting.key, &frame.lighting.rim]
            .map(|light| ShadowView::new(light, softness, &subject, texels));
        let mut uniform = FrameUniform::new(frame, &view, &shadows, stature_m, size);
        if let Some(figure) = &self.figure {
            uniform.lids = figure.lids(&frame.world_from_joint);
            uniform.eyes[1] = figure.lips_apart_mm(&frame.tissue);
        }
        let backdrop = self.backdrop.as_mut();
        self.backdrop_drawn = backdrop.map_or(BackdropMode::Directly, |b| b.next(&mut uniform));
        self.queue
            .write_buffer(&self.frame_buffer, 0, bytemuck::bytes_of(&uniform));
        if let Some(figure) = &mut self.figure {
            let place = figure.face(&frame.world_from_joint);
            let near = place.and_then(|p| detail::pixels_per_m(&frame.camera, &view, size.1, p));
            let detail = Detail::new(self.tier.options.quality, near);
            figure.pose(&self.queue, frame, detail.figure, &mut self.rows);
            self.detail = detail;
        }
    }

    /// Compiles and uploads the overlays and fill modes of a frame.
    fn send_shown(&mut self, frame: &Frame) {
        let (device, queue) = (&self.device, &self.queue);
        let pipelines = &mut self.tier.pipelines;
        pipelines.prepare_theatre(device, &self.shared, frame.set.kind);
        let has_tissue = self.figure.as_ref().is_some_and(GpuFigure::has_tissue);
        pipelines.prepare_shown(device, &self.shared, &frame.visibility, has_tissue);
        if !frame.lines.is_empty() {
            pipelines.prepare_lines(device, &self.shared);
        }
        if !frame.lines.is_empty() || self.lines.is_some() {
            let lines = self.lines.get_or_insert_with(|| Lines::new(device));
            lines.send(device, queue, &frame.lines);
        }
        let stature_m = match &mut self.figure {
            Some(figure) => {
                if frame.visibility.fill == Fill::Wireframe {
                    figure.prepare_edges(device, queue);
                }
                figure.stature_m
            }
            None => return,
        };
        if frame.visibility.has_overlay() {
            let overlay = self.overlay.get_or_insert_with(|| Overlay::new(device));
            overlay.send(queue, frame, stature_m as f32);
        }
    }
}
