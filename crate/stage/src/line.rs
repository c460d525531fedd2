//! Lines and dots over the body, for inspection.

/// A straight line over the body, or a dot if both ends coincide. Parts behind the body are
/// rendered fainter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// One end, world, metres.
    pub from_in_world: [f32; 3],
    /// The other end.
    pub to_in_world: [f32; 3],
    /// Linear RGB and cover, 0..255; before the tone curve, in any light the same.
    pub color: [u8; 4],
    /// Width, image pixels.
    pub width_px: f32,
}
