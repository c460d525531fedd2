//! Render target: float or encoded, sample count, and its textures, or the output itself.

use wgpu::{TextureFormat, TextureUsages};

use crate::Quality;

/// Format and sample count of the intermediate image that the device supports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TargetKind {
    pub(crate) format: TextureFormat,
    pub(crate) samples: u32,
    /// True if frames are rendered directly into the final target, without intermediate texture and
    /// tone-mapping pass.
    pub(crate) is_direct: bool,
}

pub(crate) const DEPTH_FORMAT: TextureFormat = TextureFormat::Depth32Float;

impl TargetKind {
    /// Returns the best target kind of an adapter for a quality and an `output` format: float with
    /// multisampling, float with one sample, eight bits encoded early, or the final target itself.
    pub(crate) fn choose(adapter: &wgpu::Adapter, quality: Quality, output: TextureFormat) -> Self {
        let samples_of = |format: TextureFormat| {
            let asked = quality.samples();
            let flags = adapter.get_texture_format_features(format).flags;
            let depth = adapter.get_texture_format_features(DEPTH_FORMAT).flags;
            let can = flags.sample_count_supported(asked)
                && depth.sample_count_supported(asked)
                && flags.contains(wgpu::TextureFormatFeatureFlags::MULTISAMPLE_RESOLVE);
            if can { asked } else { 1 }
        };
        // An sRGB target would encode twice.
        if quality.is_direct() && !output.is_srgb() {
            return Self {
                format: output,
                samples: samples_of(output),
                is_direct: true,
            };
        }
        let draws = |format: TextureFormat| {
            let usable = adapter
                .get_texture_format_features(format)
                .allowed_usages
                .contains(TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING);
            usable.then(|| Self {
                format,
                samples: samples_of(format),
                is_direct: false,
            })
        };
        draws(TextureFormat::Rgba16Float)
            .or_else(|| draws(TextureFormat::Rgba8Unorm))
            .unwrap_or(Self {
                format: TextureFormat::Rgba8Unorm,
                samples: 1,
                is_direct: false,
            })
    }

    /// Returns true if light is stored linearly in float.
    pub(crate) fn is_float(self) -> bool {
        self.format == TextureFormat::Rgba16Float
    }
}

/// Intermediate textures of one image size: samples, colour and depth.
pub(crate) struct Targets {
    pub(crate) size: (u32, u32),
    /// Render target; with more than one sample it is resolved into `picture`.
    pub(crate) samples: Option<wgpu::TextureView>,
    /// Input of the last pass; `None` if the stage is rendered directly to the target.
    pub(crate) picture: Option<wgpu::TextureView>,
    pub(crate) depth: wgpu::TextureView,
}

impl Targets {
    pub(crate) fn new(device: &wgpu::Device, kind: TargetKind, size: (u32, u32)) -> Self {
        let texture = |label, format, samples, usage| {
            device
                .create_texture(&wgpu::TextureDescriptor {
                    label: Some(label),
                    size: wgpu::Extent3d {
                        width: size.0,
                        height: size.1,
                        depth_or_array_layers: 1,
                    },
                    mip_level_count: 1,
                    sample_count: samples,
                    dimension: wgpu::TextureDimension::D2,
                    format,
                    usage,
                    view_formats: &[],
                })
                .create_view(&wgpu::TextureViewDescriptor::default())
        };
        let attachment = TextureUsages::RENDER_ATTACHMENT;
        Self {
            size,
            samples: (kind.samples > 1)
                .then(|| texture("samples", kind.format, kind.samples, attachment)),
            picture: (!kind.is_direct).then(|| {
                let usage = attachment | TextureUsages::TEXTURE_BINDING;
                texture("picture", kind.format, 1, usage)
            }),
            depth: texture("depth", DEPTH_FORMAT, kind.samples, attachment),
        }
    }
}
