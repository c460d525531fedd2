//! Interface between a face's tissue and the renderers of its skin.

/// Current state of a node of the facial tissue, in the figure's bind pose (before joints move it);
/// the renderer deforms the skin by it.
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
    /// Change of the blood in the skin relative to rest, −1 (pale) to 1 (flushed).
    pub blush: f32,
}
