//! How the vertices of a mesh follow the nodes of the tissue.

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
