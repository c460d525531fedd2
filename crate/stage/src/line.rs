//! Lines and dots over the body, for those who look at its making.

/// A straight line over the body, or a dot where both ends are one. What lies behind the
/// body shines through it, fainter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// One end, world, metres.
    pub from_in_world: [f32; 3],
    /// The other end.
    pub to_in_world: [f32; 3],
    /// Linear RGB and cover, 0..255; before the tone curve, in any light the same.
    pub color: [u8; 4],
    /// Width, pixels of the picture.
    pub width_px: f32,
}
