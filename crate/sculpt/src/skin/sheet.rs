//! The surfaces that skin is painted on, unwrapped.

use raconteur_base::DVec3;

use crate::head::{Coordinates, Places};

/// The head's skin as the baking needs it.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeadSheet {
    /// Place of each vertex in the atlas, 0..1.
    pub(crate) uv: Vec<[f64; 2]>,
    /// Triangles of the skin that is seen.
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
    /// Where lines are laid out.
    pub(crate) places: Option<&'static Places>,
}

/// The hand's skin as the baking needs it. Both hands share it as mirror images.
#[derive(Clone, Debug, Default)]
pub(crate) struct HandSheet {
    /// Place of each vertex in the atlas, 0..1.
    pub(crate) uv: Vec<[f64; 2]>,
    /// Triangles.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Right hand in the frame of its anatomy (radial, distal, palmar), mm.
    pub(crate) at: Vec<DVec3>,
    /// Unit normals.
    pub(crate) normals: Vec<DVec3>,
    /// What the anatomy says of each vertex.
    pub(crate) regions: Vec<HandRegion>,
    /// Lines that every hand has: depth in mm.
    pub(crate) creases: Vec<HandLine>,
    /// Lines of slack and old skin, drawn by age.
    pub(crate) slack: Vec<HandLine>,
    /// Courses of the veins on the back.
    pub(crate) veins: Vec<HandLine>,
}

/// A line on the hand.
#[derive(Clone, Debug)]
pub(crate) struct HandLine {
    /// Places on the surface, mm.
    pub(crate) through: Vec<DVec3>,
    /// Depth or strength.
    pub(crate) strength: f64,
    /// Half width, mm.
    pub(crate) width: f64,
    /// Share of its length lost to gaps.
    pub(crate) broken: f64,
}

/// Shares of a vertex, 0..1.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct HandRegion {
    /// Palm and inner side of the fingers.
    pub(crate) palm: f64,
    /// Fingertip, inner side.
    pub(crate) tip: f64,
    /// Over a joint on the back.
    pub(crate) knuckle: f64,
    /// Around a nail.
    pub(crate) nail: f64,
    /// Balls of the thumb and the little finger, heads of the metacarpals.
    pub(crate) cushion: f64,
}
