//! Textures for meshes without images.

use wgpu::{Device, Queue, TextureView};

use crate::strands;
use crate::texture::{self, Role};

/// Substitute textures for meshes without images, with their samplers.
pub(crate) struct FallbackTextures {
    pub(crate) white: TextureView,
    pub(crate) flat: TextureView,
    pub(crate) level: TextureView,
    /// The atlas of strands, used for all hair.
    pub(crate) strands: TextureView,
    pub(crate) sampler: wgpu::Sampler,
    pub(crate) strand_sampler: wgpu::Sampler,
}

impl FallbackTextures {
    pub(crate) fn new(adapter: &wgpu::Adapter, device: &Device, queue: &Queue) -> Self {
        let anisotropic = adapter
            .get_downlevel_capabilities()
            .flags
            .contains(wgpu::DownlevelFlags::ANISOTROPIC_FILTERING);
        let dot = |role, rgba: [u8; 4]| texture::upload(device, queue, role, 1, 1, &rgba);
        Self {
            white: dot(Role::Color, [255; 4]),
            flat: dot(Role::Normal, [128, 128, 255, 255]),
            level: dot(Role::Height, [128; 4]),
            strands: texture::upload_levels(device, queue, &strands::atlas()),
            sampler: device.create_sampler(&wgpu::SamplerDescriptor {
                address_mode_u: wgpu::AddressMode::Repeat,
                address_mode_v: wgpu::AddressMode::Repeat,
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                mipmap_filter: wgpu::MipmapFilterMode::Linear,
                anisotropy_clamp: if anisotropic { 8 } else { 1 },
                ..Default::default()
            }),
            // Cards seen edge-on are hidden anyway, and software rendering with anisotropic
            // sampling reads the whole atlas for a pixel.
            strand_sampler: device.create_sampler(&wgpu::SamplerDescriptor {
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                mipmap_filter: wgpu::MipmapFilterMode::Linear,
                ..Default::default()
            }),
        }
    }
}
