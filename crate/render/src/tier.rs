//! Quality-dependent objects: pipelines, the shadow map, and its bind groups.

use wgpu::{Buffer, Device, TextureView};

use crate::RenderOptions;
use crate::gpu::{bind_group, binding};
use crate::pipeline::{Pipelines, SharedResources};
use crate::target::{DEPTH_FORMAT, TargetKind};

/// Resources of one quality tier: pipelines, shadow map and bind groups.
pub(crate) struct Tier {
    pub(crate) options: RenderOptions,
    pub(crate) target: TargetKind,
    pub(crate) pipelines: Pipelines,
    /// Lights that cast, one square of the map each, side by side.
    pub(crate) lights: u32,
    /// Side of a square, texels.
    pub(crate) shadow_texels: u32,
    pub(crate) shadow_map: TextureView,
    pub(crate) lit_group: wgpu::BindGroup,
}

impl Tier {
    /// Creates the tier that `options` request, within the device's abilities; no program is
    /// compiled yet.
    pub(crate) fn new(
        device: &Device,
        shared: &SharedResources,
        target: TargetKind,
        frame: &Buffer,
        options: RenderOptions,
    ) -> Self {
        let quality = options.quality;
        let lights = quality.shadows();
        let limit = device.limits().max_texture_dimension_2d;
        // Without shadow-casting lights, one texel replaces the map.
        let shadow_texels = match lights {
            0 => 1,
            _ => quality.shadow_texels().min(limit / lights),
        };
        let shadow_map = device
            .create_texture(&wgpu::TextureDescriptor {
                label: Some("shadow"),
                size: wgpu::Extent3d {
                    width: shadow_texels * lights.max(1),
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
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(wgpu::CompareFunction::LessEqual),
            ..Default::default()
        });
        let lit_group = bind_group(
            device,
            "lit",
            &shared.layouts.lit,
            &[
                binding(0, frame.as_entire_binding()),
                binding(1, wgpu::BindingResource::TextureView(&shadow_map)),
                binding(2, wgpu::BindingResource::Sampler(&sampler)),
            ],
        );
        Self {
            options,
            target,
            pipelines: Pipelines::new(target, quality),
            lights,
            shadow_texels,
            shadow_map,
            lit_group,
        }
    }
}
