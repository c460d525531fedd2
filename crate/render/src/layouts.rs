//! Bind group layouts of the shaders.

use wgpu::{BindGroupLayout, Device, ShaderStages};

use crate::figure::MAX_JOINTS;
use crate::figure::MaterialUniform;
use crate::uniform::FrameUniform;

/// Bind group layouts of the shaders, named by their content.
pub(crate) struct Layouts {
    /// The frame only.
    pub(crate) frame: BindGroupLayout,
    /// The frame, the shadow map and its sampler.
    pub(crate) lit: BindGroupLayout,
    /// Joints and one material.
    pub(crate) figure: BindGroupLayout,
    /// A material's textures of colour, normals and wrinkles, their sampler, and the atlas of
    /// strands with its own.
    pub(crate) maps: BindGroupLayout,
    /// The frame, the finished image and its sampler.
    pub(crate) tone_map: BindGroupLayout,
}

impl Layouts {
    pub(crate) fn new(device: &Device) -> Self {
        let layout = |label, entries: &[wgpu::BindGroupLayoutEntry]| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(label),
                entries,
            })
        };
        let both = ShaderStages::VERTEX_FRAGMENT;
        let frame = uniform(0, both, false, size_of::<FrameUniform>() as u64);
        let texture = |binding, sample_type| {
            entry(
                binding,
                ShaderStages::FRAGMENT,
                wgpu::BindingType::Texture {
                    sample_type,
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
            )
        };
        let picture =
            |binding| texture(binding, wgpu::TextureSampleType::Float { filterable: true });
        let sampler = |binding, kind| {
            entry(
                binding,
                ShaderStages::FRAGMENT,
                wgpu::BindingType::Sampler(kind),
            )
        };
        let filtering = wgpu::SamplerBindingType::Filtering;
        Self {
            frame: layout("frame", &[frame]),
            lit: layout(
                "lit",
                &[
                    frame,
                    texture(1, wgpu::TextureSampleType::Depth),
                    sampler(2, wgpu::SamplerBindingType::Comparison),
                ],
            ),
            figure: layout(
                "figure",
                &[
                    uniform(0, ShaderStages::VERTEX, false, (3 * MAX_JOINTS * 16) as u64),
                    uniform(1, both, true, size_of::<MaterialUniform>() as u64),
                ],
            ),
            maps: layout(
                "maps",
                &[
                    picture(0),
                    picture(1),
                    sampler(2, filtering),
                    picture(3),
                    picture(4),
                    sampler(5, filtering),
                ],
            ),
            tone_map: layout("tone map", &[frame, picture(1), sampler(2, filtering)]),
        }
    }
}

fn entry(
    binding: u32,
    visibility: ShaderStages,
    ty: wgpu::BindingType,
) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty,
        count: None,
    }
}

fn uniform(
    binding: u32,
    stages: ShaderStages,
    dynamic: bool,
    size: u64,
) -> wgpu::BindGroupLayoutEntry {
    entry(
        binding,
        stages,
        wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: dynamic,
            min_binding_size: std::num::NonZeroU64::new(size),
        },
    )
}
