//! Render passes of a frame: shadow, backdrop, stage, tone mapping.

use raconteur_body::MaterialKind;
use raconteur_stage::{Fill, Visibility};
use wgpu::TextureView;

use super::Renderer;
use crate::backdrop::BackdropMode;
use crate::counts::Counts;
use crate::figure::{AlphaMode, PipelineKey};
use crate::pipeline::is_bare;

/// Share of the depth buffer, from the front, reserved for overlays. The near plane is 0.1 m away,
/// so a figure at half a metre begins at four fifths of the depth.
const OVERLAY_DEPTH: f32 = 0.05;

impl Renderer {
    pub(super) fn draw_shadow(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        shown: &Visibility,
        counts: &mut Counts,
    ) {
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
        // A hidden figure or a wireframe casts no shadow.
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

    /// Renders the stage as a still, if the image is the first that needs it.
    pub(super) fn draw_backdrop(&self, encoder: &mut wgpu::CommandEncoder, counts: &mut Counts) {
        let theatre = self.tier.pipelines.theatre();
        let still = theatre.and_then(|t| t.still.as_ref());
        let (BackdropMode::Now, Some(backdrop), Some(still)) =
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

    /// Fills the area not covered by solid surfaces with the stage.
    fn fill_with_stage(&self, pass: &mut wgpu::RenderPass<'_>, counts: &mut Counts) {
        let pipelines = &self.tier.pipelines;
        match (&self.backdrop, &pipelines.with_layout) {
            (Some(backdrop), Some(laid)) if self.backdrop_drawn != BackdropMode::Directly => {
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

    pub(super) fn draw_stage(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        view: &TextureView,
        shown: &Visibility,
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
        // Solid surfaces come first; then the theatre fills the rest; then additive and transparent
        // surfaces follow.
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
        shown: &Visibility,
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

    pub(super) fn tone_map(
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
