//! The stage without a figure as a still picture: while the camera stands, the lowest quality draws
//! curtain and boards once and lays them under every picture.

use wgpu::{Device, TextureFormat, TextureUsages, TextureView};

use crate::gpu::{bind_group, binding};
use crate::layouts::Layouts;
use crate::uniform::FrameUniform;

/// Curtain and boards of one picture size.
pub(crate) struct Backdrop {
    pub(crate) view: TextureView,
    /// What the pass that lays it down reads.
    pub(crate) group: wgpu::BindGroup,
    /// What the picture before showed.
    last: Option<FrameUniform>,
    is_drawn: bool,
}

/// How the backdrop of a picture comes about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Drawn {
    /// With the picture: it is another one than before, and may be once more.
    Directly,
    /// As a still, from now on.
    Now,
    /// As a still that is there.
    Before,
}

impl Backdrop {
    pub(crate) fn new(
        device: &Device,
        layouts: &Layouts,
        frame: &wgpu::Buffer,
        sampler: &wgpu::Sampler,
        format: TextureFormat,
        (width, height): (u32, u32),
    ) -> Self {
        let view = device
            .create_texture(&wgpu::TextureDescriptor {
                label: Some("backdrop"),
                size: wgpu::Extent3d {
                    width,
                    height,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            })
            .create_view(&wgpu::TextureViewDescriptor::default());
        let group = bind_group(
            device,
            "backdrop",
            &layouts.tone_map,
            &[
                binding(0, frame.as_entire_binding()),
                binding(1, wgpu::BindingResource::TextureView(&view)),
                binding(2, wgpu::BindingResource::Sampler(sampler)),
            ],
        );
        Self {
            view,
            group,
            last: None,
            is_drawn: false,
        }
    }

    /// How the next picture's comes about.
    pub(crate) fn next(&mut self, uniform: &FrameUniform) -> Drawn {
        let shown = uniform.of_backdrop();
        let is_same = self
            .last
            .is_some_and(|last| bytemuck::bytes_of(&last) == bytemuck::bytes_of(&shown));
        self.last = Some(shown);
        let drawn = match (is_same, self.is_drawn) {
            (false, _) => Drawn::Directly,
            (true, false) => Drawn::Now,
            (true, true) => Drawn::Before,
        };
        self.is_drawn = is_same;
        drawn
    }
}
