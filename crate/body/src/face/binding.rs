//! How the vertices of a mesh follow the nodes of the tissue.

/// A node of the tissue as it is now, in the figure's bind pose (before joints move it).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct NodeState {
    /// From its place at rest, metres.
    pub displacement: [f32; 3],
    /// Change of the surface's unit normal there.
    pub normal_delta: [f32; 3],
    /// Strength of the expressive wrinkles there, 0 to 1: of the first to third channel of
    /// the wrinkle map.
    pub wrinkles: [f32; 3],
    /// More (positive) or less blood in the skin than at rest, −1 to 1.
    pub blush: f32,
}

/// Which vertices of a mesh follow which nodes: a sparse matrix of one row a vertex. What is
/// bound has no share of the lower jaw left when it is drawn: its nodes carry the jaw's turn,
/// so that whoever draws moves such shares to the skull.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Binding {
    /// The vertices, rising.
    pub vertices: Vec<u32>,
    /// Where the row of each begins in `nodes` and `weights`; one more for the end.
    pub starts: Vec<u32>,
    /// Indices of nodes.
    pub nodes: Vec<u16>,
    /// Their weights. Rows sum to 1, or to less where a vertex only follows in part.
    pub weights: Vec<f32>,
}
