//! The options of a renderer, and what the device made of them.

/// Levels of detail that are drawn.
pub(crate) const LEVELS: usize = 3;

/// How much work goes into a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quality {
    /// What a processor alone draws: light without shadows, colour maps alone, in one pass of four
    /// samples a pixel.
    Lowest,
    /// One sample a pixel with edge smoothing, a small shadow, no fine bumps.
    Low,
    /// Four samples, shadows from key and rim, fine bumps.
    Medium,
    /// Four samples, shadows of 2048² with a wide filter, fine bumps.
    #[default]
    High,
}

impl Quality {
    /// Every tier with its name.
    pub const NAMES: [(Self, &'static str); 4] = [
        (Self::Lowest, "lowest"),
        (Self::Low, "low"),
        (Self::Medium, "medium"),
        (Self::High, "high"),
    ];

    /// Requested samples a pixel.
    pub(crate) fn samples(self) -> u32 {
        if self == Self::Low { 1 } else { 4 }
    }

    /// Side of a light's shadow map, texels.
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

    /// The level of detail of figures, 0 the finest.
    pub(crate) fn level_of_detail(self) -> usize {
        match self {
            Self::Lowest => 2,
            Self::Low => 1,
            Self::Medium | Self::High => 0,
        }
    }

    /// Whether the stage is drawn straight to the target, tone curve and encoding included.
    pub(crate) fn is_direct(self) -> bool {
        self == Self::Lowest
    }

    /// The shadow filter: 1 is a disc of 7 taps, 2 one of 24 that sharpens towards contact.
    pub(crate) fn shadow_reach(self) -> u32 {
        if self == Self::High { 2 } else { 1 }
    }

    pub(crate) fn fine_detail(self) -> bool {
        self > Self::Low
    }
}

/// Choices for a renderer; they can be changed while it draws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RenderOptions {
    /// How much work goes into a picture. Default: high.
    pub quality: Quality,
}

/// What the renderer turned out to be and what the last picture took.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RenderInfo {
    /// The choices in force.
    pub options: RenderOptions,
    /// `vulkan`, `metal`, `dx12`, `webgpu` or `gl`.
    pub backend: String,
    /// The adapter's own name.
    pub adapter: String,
    /// Whether a processor draws, as far as the adapter tells.
    pub software: bool,
    /// Samples a pixel.
    pub samples: u32,
    /// Whether light is kept in a float target; otherwise materials encode at once.
    pub float_target: bool,
    /// Whether edges are smoothed in the last pass, because there is one sample a pixel.
    pub smooths_edges: bool,
    /// Side of a light's shadow map, texels.
    pub shadow_texels: u32,
    /// Draw calls of the last picture that drew the figure, its shadows included.
    pub figure_draw_calls: u32,
    /// Draw calls of the last picture, all passes.
    pub draw_calls: u32,
    /// Triangles of the last picture, all passes.
    pub triangles: u32,
}
