//! What a region of the generator yields: polygons with colours, weights and morphs.

use raconteur_base::DVec3;

use crate::figure::Material;

/// One vertex of a part, bind pose.
#[derive(Clone, Debug)]
pub struct PartVertex {
    /// World position, metres.
    pub position: DVec3,
    /// Texture coordinates; meaning by [`crate::figure::MaterialKind`].
    pub uv: [f64; 2],
    /// Linear RGB 0..1 and ambient occlusion (1 = open).
    pub color: [f64; 4],
    /// Joint names with weights; any number, any sum above zero. The assembly keeps the
    /// four largest and normalises.
    pub weights: Vec<(JointRef, f64)>,
}

/// A joint named before the skeleton exists.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointRef(pub crate::skeleton::Drive);

/// One morph target's part.
#[derive(Clone, Debug)]
pub struct PartMorph {
    /// ARKit's name where one fits, for example `mouthPucker`.
    pub name: String,
    /// Moved vertices and their displacements at weight 1, metres.
    pub deltas: Vec<(u32, DVec3)>,
}

/// One drawable region.
#[derive(Clone, Debug)]
pub struct Part {
    /// Name, for example `head`.
    pub name: String,
    /// Surface.
    pub material: Material,
    /// Vertices.
    pub vertices: Vec<PartVertex>,
    /// Polygons of three or four corners, counter-clockwise from outside.
    pub faces: Vec<Vec<u32>>,
    /// Morph targets.
    pub morphs: Vec<PartMorph>,
    /// Vertices that follow the tissue, rising, each with the nodes and weights it follows.
    pub bound: Vec<(u32, Vec<(u32, f64)>)>,
}
