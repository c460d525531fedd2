//! Interface between a face's tissue and the renderers of its skin.

/// A node of the tissue as it is now, in the figure's bind pose (before joints move it).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct NodeState {
    /// Displacement from its rest position, metres.
    pub displacement: [f32; 3],
    /// Change of the surface's unit normal there.
    pub normal_delta: [f32; 3],
    /// Strength of the expressive wrinkles there, 0 to 1: of the first to third channel of
    /// the wrinkle map.
    pub wrinkles: [f32; 3],
    /// More (positive) or less blood in the skin than at rest, −1 to 1.
    pub blush: f32,
}
