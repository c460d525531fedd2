//! What the picture is formed in: float or encoded, samples, and its textures.

use wgpu::{TextureFormat, TextureUsages};

/// The kind of target that the device allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TargetKind {
    pub(crate) format: TextureFormat,
    pub(crate) samples: u32,
}

pub(crate) const DEPTH_FORMAT: TextureFormat = TextureFormat::Depth32Float;

impl TargetKind {
    /// The best that the adapter draws: float with the asked samples, float with one,
    /// or eight bits encoded early.
    pub(crate) fn choose(adapter: &wgpu::Adapter, asked_samples: u32) -> Self {
        let draws = |format: TextureFormat| {
            let features = adapter.get_texture_format_features(format);
            let usable = features
                .allowed_usages
                .contains(TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING);
            let depth = adapter.get_texture_format_features(DEPTH_FORMAT);
            let samples = if features.flags.sample_count_supported(asked_samples)
                && depth.flags.sample_count_supported(asked_samples)
                && features
                    .flags
                    .contains(wgpu::TextureFormatFeatureFlags::MULTISAMPLE_RESOLVE)
            {
                asked_samples
            } else {
                1
            };
            usable.then_some(Self { format, samples })
        };
        draws(TextureFormat::Rgba16Float)
            .or_else(|| draws(TextureFormat::Rgba8Unorm))
            .unwrap_or(Self {
                format: TextureFormat::Rgba8Unorm,
                samples: 1,
            })
    }

    /// Whether light is kept linear in float.
    pub(crate) fn is_float(self) -> bool {
        self.format == TextureFormat::Rgba16Float
    }
}

/// The textures of one picture size.
pub(crate) struct Targets {
    pub(crate) size: (u32, u32),
    /// Drawn to; with more than one sample it is resolved into `picture`.
    pub(crate) samples: Option<wgpu::TextureView>,
    pub(crate) picture: wgpu::TextureView,
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
            picture: texture(
                "picture",
                kind.format,
                1,
                attachment | TextureUsages::TEXTURE_BINDING,
            ),
            depth: texture("depth", DEPTH_FORMAT, kind.samples, attachment),
        }
    }
}
