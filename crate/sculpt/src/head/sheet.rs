//! Head data for the skin's baking.

use raconteur_base::DVec3;

use super::chart::Places;
use super::paint::Coordinates;

/// Skin of the head as input of the texture baking.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeadSheet {
    /// Texture coordinates of each vertex in the atlas, 0..1.
    pub(crate) uv: Vec<[f64; 2]>,
    /// Triangles of the visible skin.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Vertices on this person and on the mean head, mm.
    pub(crate) at: Vec<DVec3>,
    pub(crate) mean: Vec<DVec3>,
    /// Unit normals on the mean head.
    pub(crate) normals: Vec<DVec3>,
    /// Coordinates about eyes, mouth, nostrils and ears.
    pub(crate) rings: Vec<Coordinates>,
    /// Share that brows cover.
    pub(crate) brow: Vec<f64>,
    /// Linear RGB of brows.
    pub(crate) brow_colour: [f64; 3],
    /// Positions on which lines are laid out.
    pub(crate) places: Option<&'static Places>,
}
