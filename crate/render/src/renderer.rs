//! Draws frames of one figure to any target of the chosen format.

mod change;

use raconteur_body::{Figure, MaterialKind};
use raconteur_stage::{Fill, Frame, SetKind, Shown};
use wgpu::{Buffer, BufferUsages, Device, Queue, TextureFormat, TextureView};

use crate::backdrop::{Backdrop, Drawn};
use crate::counts::Counts;
use crate::detail::{self, Detail};
use crate::figure::{AlphaMode, MAX_JOINTS, PipelineKey};
use crate::gpu::{bind_group, binding, empty_buffer};
use crate::gpu_figure::{FallbackTextures, GpuFigure};
use crate::lines::Lines;
use crate::overlay::Overlay;
use crate::pipeline::{SharedResources, is_bare};
use crate::refusal::Refusal;
use crate::shadow::{ShadowView, Subject};
use crate::target::{TargetKind, Targets};
use crate::tier::Tier;
use crate::uniform::{FrameUniform, stand_in_world};
use crate::view::View;
use crate::{Quality, RenderError, RenderInfo, RenderOptions};

/// Share of the depth buffer, from the front, that overlays take. The near
/// plane is 0.1 m away, so a figure at half a metre begins at four fifths of the depth.
const OVERLAY_DEPTH: f32 = 0.05;

/// The renderer: pipelines, the figure and the textures of the current size.
pub struct Renderer {
    device: Device,
    queue: Queue,
    shared: SharedResources,
    fallback: FallbackTextures,
    /// What the adapter draws at each quality.
    target_kinds: [TargetKind; Quality::NAMES.len()],
    tier: Tier,
    /// The next quality, while its programs are being compiled.
    coming: Option<Tier>,
    targets: Option<Targets>,
    /// What the tone-map pass reads, where there is one.
    tone_map_group: Option<wgpu::BindGroup>,
    /// The stage as a still, at qualities that draw it so.
    backdrop: Option<Backdrop>,
    /// How that of the picture that is made comes about.
    backdrop_drawn: Drawn,
    frame_buffer: Buffer,
    frame_group: wgpu::BindGroup,
    picture_sampler: wgpu::Sampler,
    figure: Option<GpuFigure>,
    /// At which it is drawn in the picture that is made.
    detail: Detail,
    rows: Vec<[f32; 4]>,
    /// The overlay, once it was requested.
    overlay: Option<Overlay>,
    /// Lines over figures, once there were any.
    lines: Option<Lines>,
    info: RenderInfo,
    /// What the driver refused, if anything; returned by the next picture.
    refused: Refusal,
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
        let refused = Refusal::of(&device);

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
            backdrop_drawn: Drawn::Directly,
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
        renderer.compile(SetKind::Curtain);
        renderer.tell_tier();
        renderer
    }

    /// What the renderer turned out to be, with the counts of the last picture.
    #[must_use]
    pub fn info(&self) -> &RenderInfo {
        &self.info
    }

    /// Sends a figure to the device, in place of the one before. Its pictures are white
    /// and flat until [`Self::set_image`].
    ///
    /// # Errors
    /// When it has more than 256 joints or a mesh contradicts itself; the figure before stays.
    pub fn set_figure(&mut self, figure: &Figure) -> Result<(), RenderError> {
        let layouts = &self.shared.layouts;
        self.figure = GpuFigure::new(&self.device, &self.queue, layouts, &self.fallback, figure)?;
        self.compile(SetKind::Curtain);
        Ok(())
    }

    /// Sends the figure in another shape, with another face for example; `before` is what was sent last. Pictures that have
    /// come stay where it has as many as before, and what is alike in both is not sent again. Of one that `moves`, which is on its
    /// way to another, the curvature of skin and the way of strands stay as they were until one comes that does not.
    ///
    /// # Errors
    /// As [`Renderer::set_figure`].
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
        self.compile(SetKind::Curtain);
        Ok(())
    }

    /// Shows a decoded picture of the figure: `index` as in `Figure::images`, RGBA bytes in
    /// rows from the top. One that the figure does not show is let go.
    ///
    /// # Errors
    /// When the bytes are not four a pixel, or a side is zero or longer than
    /// [`LARGEST_SIDE`](crate::LARGEST_SIDE); the picture before stays.
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
    /// Joints, morph weights and nodes of the tissue that the frame lacks stay at rest. In a steady state
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
        self.go_on(frame.set.kind);
        self.fit(size)?;
        self.send(frame, size);
        self.send_shown(frame);
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut counts = Counts::default();
        self.draw_shadow(&mut encoder, &frame.shown, &mut counts);
        self.draw_backdrop(&mut encoder, &mut counts);
        self.draw_stage(&mut encoder, view, &frame.shown, &mut counts);
        self.tone_map(&mut encoder, view, &mut counts);
        self.queue.submit([encoder.finish()]);
        self.info.figure_draw_calls = counts.figure_draw_calls;
        self.info.draw_calls = counts.draw_calls;
        self.info.triangles = counts.triangles;
        self.refused
            .take()
            .map_or(Ok(()), |message| Err(RenderError::Refused(message)))
    }

    /// Shows a drawn texture of a surface.
    #[cfg(target_arch = "wasm32")]
    pub(crate) fn present(&self, texture: wgpu::SurfaceTexture) {
        self.queue.present(texture);
    }

    /// Makes the textures of a picture of this size, if they are not there yet.
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

    /// Sends what changes from frame to frame.
    fn send(&mut self, frame: &Frame, size: (u32, u32)) {
        let stature_m = self.figure.as_ref().map_or(1.7, |f| f.stature_m);
        let view = View::new(&frame.camera, f64::from(size.0) / f64::from(size.1));
        let subject = Subject {
            camera: &frame.camera,
            view: &view,
            stand_in_world: stand_in_world(frame),
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
        self.backdrop_drawn = backdrop.map_or(Drawn::Directly, |b| b.next(&mut uniform));
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

    /// Compiles and sends what a look behind the scenes needs.
    fn send_shown(&mut self, frame: &Frame) {
        let (device, queue) = (&self.device, &self.queue);
        let pipelines = &mut self.tier.pipelines;
        pipelines.prepare_theatre(device, &self.shared, frame.set.kind);
        let has_tissue = self.figure.as_ref().is_some_and(GpuFigure::has_tissue);
        pipelines.prepare_shown(device, &self.shared, &frame.shown, has_tissue);
        if !frame.lines.is_empty() {
            pipelines.prepare_lines(device, &self.shared);
        }
        if !frame.lines.is_empty() || self.lines.is_some() {
            let lines = self.lines.get_or_insert_with(|| Lines::new(device));
            lines.send(device, queue, &frame.lines);
        }
        let stature_m = match &mut self.figure {
            Some(figure) => {
                if frame.shown.fill == Fill::Wireframe {
                    figure.prepare_edges(device, queue);
                }
                figure.stature_m
            }
            None => return,
        };
        if frame.shown.has_overlay() {
            let overlay = self.overlay.get_or_insert_with(|| Overlay::new(device));
            overlay.send(queue, frame, stature_m as f32);
        }
    }

    fn draw_shadow(&self, encoder: &mut wgpu::CommandEncoder, shown: &Shown, counts: &mut Counts) {
        if self.tier.lights == 0 {
            return;
        }
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.tier.shadow_map,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        let Some(figure) = &self.figure else { return };
        // A hidden figure or a wireframe casts nothing.
        if !shown.body || shown.fill != Fill::Solid {
            return;
        }
        pass.set_bind_group(0, &self.frame_group, &[]);
        let side = self.tier.shadow_texels as f32;
        for light in 0..self.tier.lights {
            pass.set_viewport(side * light as f32, 0.0, side, side, 0.0, 1.0);
            figure.draw_shadow(&mut pass, counts, self.detail, |shadow, bound| {
                self.tier.pipelines.shadow(light, shadow, bound)
            });
        }
    }

    /// Draws the stage as a still, if the picture is the first that needs it.
    fn draw_backdrop(&self, encoder: &mut wgpu::CommandEncoder, counts: &mut Counts) {
        let theatre = self.tier.pipelines.theatre();
        let still = theatre.and_then(|t| t.still.as_ref());
        let (Drawn::Now, Some(backdrop), Some(still)) =
            (self.backdrop_drawn, &self.backdrop, still)
        else {
            return;
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("backdrop"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &backdrop.view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        let (width, height) = backdrop.drawn_size();
        pass.set_viewport(0.0, 0.0, width, height, 0.0, 1.0);
        pass.set_bind_group(0, &self.tier.lit_group, &[]);
        pass.set_pipeline(still);
        pass.draw(0..3, 0..1);
        counts.add(1);
    }

    /// Fills what solid surfaces leave with the stage.
    fn fill_with_stage(&self, pass: &mut wgpu::RenderPass<'_>, counts: &mut Counts) {
        let pipelines = &self.tier.pipelines;
        match (&self.backdrop, &pipelines.laid) {
            (Some(backdrop), Some(laid)) if self.backdrop_drawn != Drawn::Directly => {
                pass.set_bind_group(0, &backdrop.group, &[]);
                pass.set_pipeline(laid);
                pass.draw(0..3, 0..1);
                pass.set_bind_group(0, &self.tier.lit_group, &[]);
            }
            _ => {
                let Some(theatre) = pipelines.theatre() else {
                    return;
                };
                pass.set_pipeline(&theatre.behind);
                pass.draw(0..3, 0..1);
            }
        }
        counts.add(1);
    }

    fn draw_stage(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        view: &TextureView,
        shown: &Shown,
        counts: &mut Counts,
    ) {
        let Some(targets) = &self.targets else {
            return;
        };
        let picture = targets.picture.as_ref().unwrap_or(view);
        let color = match &targets.samples {
            Some(samples) => (samples, Some(picture), wgpu::StoreOp::Discard),
            None => (picture, None, wgpu::StoreOp::Store),
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
        pass.set_bind_group(0, &self.tier.lit_group, &[]);
        let pipelines = &self.tier.pipelines;
        let is_bare = is_bare(shown);
        let bare = |key: PipelineKey| pipelines.bare(shown, key.bound).filter(|_| is_bare);
        // By edges or in clay, brows and lashes are as solid as all else.
        let opaque = |key: PipelineKey| {
            key.alpha_mode != AlphaMode::Blend || is_bare && key.kind == MaterialKind::Lash
        };
        // The lowest quality has no time for soft ends of hair.
        let is_soft_hair = |key: PipelineKey| key.kind == MaterialKind::Hair;
        let is_direct = self.tier.target.is_direct;
        let blended = |key: PipelineKey| {
            key.alpha_mode == AlphaMode::Blend && !(is_direct && is_soft_hair(key))
        };
        let thin = shown.fill != Fill::Solid;
        let at = (shown, self.detail);
        // Solid surfaces go first; then the theatre fills the rest; then what adds light
        // and what lets it through.
        let figure = self.figure.as_ref().filter(|_| shown.body);
        if let Some(figure) = figure.filter(|_| !thin) {
            figure.draw(&mut pass, counts, at, opaque, |key| {
                bare(key).or_else(|| pipelines.material(key))
            });
        }
        self.fill_with_stage(&mut pass, counts);
        if let Some(figure) = figure {
            if thin {
                figure.draw(&mut pass, counts, at, opaque, bare);
            } else if !is_bare {
                figure.draw(&mut pass, counts, at, blended, |key| {
                    pipelines.material(key)
                });
            }
        }
        self.draw_lines(&mut pass, counts);
        self.draw_overlay(&mut pass, shown, targets.size, counts);
    }

    /// Draws lines over the figure: those behind it, then those before it.
    fn draw_lines(&self, pass: &mut wgpu::RenderPass<'_>, counts: &mut Counts) {
        let lines = self.lines.as_ref().filter(|l| l.count() > 0);
        let (Some(lines), Some(both)) = (lines, &self.tier.pipelines.lines) else {
            return;
        };
        pass.set_vertex_buffer(0, lines.buffer.slice(..));
        for pipeline in both {
            pass.set_pipeline(pipeline);
            pass.draw(0..4, 0..lines.count());
            counts.add(2 * lines.count());
        }
    }

    /// Draws bones, frames and targets nearer than everything else, and among themselves as near
    /// as they are.
    fn draw_overlay(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        shown: &Shown,
        (width, height): (u32, u32),
        counts: &mut Counts,
    ) {
        let overlay = self.overlay.as_ref().filter(|o| o.len() > 0);
        let (true, Some(overlay), Some(pipeline)) =
            (shown.has_overlay(), overlay, &self.tier.pipelines.overlay)
        else {
            return;
        };
        pass.set_viewport(0.0, 0.0, width as f32, height as f32, 0.0, OVERLAY_DEPTH);
        pass.set_pipeline(pipeline);
        pass.set_vertex_buffer(0, overlay.buffer.slice(..));
        pass.draw(0..overlay.len(), 0..1);
        counts.add(overlay.len() / 3);
    }

    fn tone_map(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        view: &TextureView,
        counts: &mut Counts,
    ) {
        let (Some(group), Some(pipeline)) = (&self.tone_map_group, &self.tier.pipelines.tone_map)
        else {
            return;
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("tone map"),
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
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.draw(0..3, 0..1);
        counts.add(1);
    }
}
