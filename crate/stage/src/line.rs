//! Lines and dots over the body, for inspection.

/// Straight line drawn over the body, or a dot if both ends coincide; annotation of a frame. Parts
/// behind the body are rendered fainter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// First end, world, metres.
    pub from_in_world: [f32; 3],
    /// Second end, world, metres.
    pub to_in_world: [f32; 3],
    /// Linear RGB and cover, 0..255; before the tone curve, in any light the same.
    pub color: [u8; 4],
    /// Line width, image pixels.
    pub width_px: f32,
}
