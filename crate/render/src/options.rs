//! Options of a renderer, and the features supported by the device.

/// Number of levels of detail.
pub(crate) const LEVELS: usize = 3;

/// Rendering quality tier: resolution of shadows, samples per pixel and level of detail.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quality {
    /// For software rendering: light without shadows, colour textures only, in one pass of four
    /// samples per pixel.
    Lowest,
    /// One sample per pixel with edge smoothing, a small shadow map, no fine bumps.
    Low,
    /// Four samples, shadows from key and rim, fine bumps.
    Medium,
    /// Four samples, shadows of 2048² with a wide filter, fine bumps.
    #[default]
    High,
}

impl Quality {
    /// All quality tiers with their names.
    pub const NAMES: [(Self, &'static str); 4] = [
        (Self::Lowest, "lowest"),
        (Self::Low, "low"),
        (Self::Medium, "medium"),
        (Self::High, "high"),
    ];

    /// Returns the requested number of samples per pixel.
    pub(crate) fn samples(self) -> u32 {
        if self == Self::Low { 1 } else { 4 }
    }

    /// Returns the side length of a light's shadow map, texels.
    pub(crate) fn shadow_texels(self) -> u32 {
        if self == Self::High { 2048 } else { 1024 }
    }

    /// Lights that cast a shadow: the key, then the rim.
    pub(crate) fn shadows(self) -> u32 {
        match self {
            Self::Lowest => 0,
            Self::Low => 1,
            Self::Medium | Self::High => 2,
        }
    }

    /// Returns the level of detail of figures, 0 the finest.
    pub(crate) fn level_of_detail(self) -> usize {
        match self {
            Self::Lowest => 2,
            Self::Low => 1,
            Self::Medium | Self::High => 0,
        }
    }

    /// Returns true if the stage is rendered directly to the target, including tone curve and
    /// encoding.
    pub(crate) fn is_direct(self) -> bool {
        self == Self::Lowest
    }

    /// Returns the shadow filter: 1 is a disc of 7 taps, 2 one of 24 that sharpens towards contact.
    pub(crate) fn shadow_reach(self) -> u32 {
        if self == Self::High { 2 } else { 1 }
    }

    pub(crate) fn fine_detail(self) -> bool {
        self > Self::Low
    }
}

/// Options of a renderer, which can be changed while it runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RenderOptions {
    /// Rendering quality. Default: high.
    pub quality: Quality,
}

/// Properties of the renderer and statistics of the last image, for diagnostics.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RenderInfo {
    /// The choices in force.
    pub options: RenderOptions,
    /// `vulkan`, `metal`, `dx12`, `webgpu` or `gl`.
    pub backend: String,
    /// The adapter's own name.
    pub adapter: String,
    /// True for software rendering, if the adapter reports it.
    pub software: bool,
    /// Number of samples per pixel.
    pub samples: u32,
    /// True if light is stored in a float target; otherwise materials encode it directly.
    pub float_target: bool,
    /// True if edges are smoothed in the last pass, because there is one sample per pixel.
    pub smooths_edges: bool,
    /// Side of a light's shadow map, texels.
    pub shadow_texels: u32,
    /// Draw calls of the figure in the last image, including its shadows.
    pub figure_draw_calls: u32,
    /// Draw calls of the last image, all passes.
    pub draw_calls: u32,
    /// Triangles of the last image, all passes.
    pub triangles: u32,
}
