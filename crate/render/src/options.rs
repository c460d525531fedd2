//! What a renderer is asked for, and what it turned out to be.

/// How much work goes into a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// One sample a pixel with edge smoothing, 1024² shadow, no fine bumps.
    Low,
    /// Four samples, 1024² shadow, fine bumps.
    Medium,
    /// Four samples, 2048² shadow with a wide filter, fine bumps.
    #[default]
    High,
}

impl Quality {
    /// Samples a pixel that are asked for.
    pub(crate) fn samples(self) -> u32 {
        if self == Self::Low { 1 } else { 4 }
    }

    /// Side of the shadow map, texels.
    pub(crate) fn shadow_texels(self) -> u32 {
        if self == Self::High { 2048 } else { 1024 }
    }

    /// Reach of the shadow filter, taps: 1 is a cross of 5, 2 a diamond of 13.
    pub(crate) fn shadow_reach(self) -> u32 {
        if self == Self::High { 2 } else { 1 }
    }

    pub(crate) fn fine_detail(self) -> bool {
        self != Self::Low
    }
}

/// Choices for a new renderer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RenderOptions {
    /// How much work goes into a picture. Default: high.
    pub quality: Quality,
}

/// What the renderer turned out to be and what the last picture took.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RenderInfo {
    /// `vulkan`, `metal`, `dx12`, `webgpu` or `gl`.
    pub backend: String,
    /// The adapter's own name.
    pub adapter: String,
    /// Samples a pixel.
    pub samples: u32,
    /// Whether light is kept in a float target; otherwise materials encode at once.
    pub float_target: bool,
    /// Whether edges are smoothed in the last pass, because there is one sample a pixel.
    pub smooths_edges: bool,
    /// Side of the shadow map, texels.
    pub shadow_texels: u32,
    /// Draw calls of the last picture, all passes.
    pub draw_calls: u32,
    /// Triangles of the last picture, all passes.
    pub triangles: u32,
}
