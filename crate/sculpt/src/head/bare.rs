//! Skin of a head alone.

use raconteur_base::DVec3;

use super::chart::chart;
use super::cut::{behind, cut_part, faces_of_zones, skin_cut};
use super::segment::{self, HeadSegment};
use super::sheet::HeadSheet;
use super::strands::BrowLine;
use super::{HeadParams, Shape, named};
use crate::part::PartVertex;
use crate::person::Person;

/// Skin of a head without anything else, built in a fraction of the time; it has the same vertices
/// as the skin of [`build`](super::build).
#[derive(Clone, Debug)]
pub struct BareSkin {
    /// Vertex positions; metres, frame of the head.
    pub positions: Vec<DVec3>,
    /// Polygons, counter-clockwise from outside.
    pub faces: Vec<Vec<u32>>,
    /// Named points: name and vertex.
    pub landmarks: Vec<(String, u32)>,
    /// Segments of the head's skin, which the face space models separately.
    pub segments: Vec<HeadSegment>,
    /// Inner parts of the head.
    pub organs: Organs,
}

/// Positions of the inner parts of a head that move independently: eyeballs, lids and chin; metres,
/// frame of the head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Organs {
    /// Centres of the left and the right eyeball.
    pub eye_centres: [DVec3; 2],
    /// Upper-lid rotation that closes the eye, left and right, radians.
    pub lid_closure_rad: [f64; 2],
    /// Height of the chin's lowest point.
    pub chin: f64,
}

impl Organs {
    /// Returns all values in one list: eye centres, lid angles, chin.
    #[must_use]
    pub fn numbers(&self) -> Vec<f64> {
        let all = self.eye_centres.iter().flat_map(DVec3::to_array);
        all.chain(self.lid_closure_rad).chain([self.chin]).collect()
    }
}

impl BareSkin {
    /// Builds the skin of a person's head.
    #[must_use]
    pub fn build(person: &Person, params: &HeadParams) -> Self {
        let shape = Shape::build(person, &params.bound, params.asymmetry);
        let vertices: Vec<PartVertex> = (0..shape.surface.len())
            .map(|v| shape.vertex(v, 1.0))
            .collect();
        let part = cut_part(&shape.surface, chart(), &[], &skin_cut(&vertices));
        let drawn = behind(&part, &shape.positions);
        Self {
            positions: part.vertices.iter().map(|v| v.position).collect(),
            faces: part.faces,
            landmarks: named(&shape, &drawn),
            segments: segment::segments(&shape, &drawn),
            organs: Organs {
                eye_centres: shape.eye_centres().map(|p| p * 1e-3),
                lid_closure_rad: shape.rig.closure_rad,
                chin: shape.extent()[0],
            },
        }
    }
}

/// Returns the sheet on which a head's skin is painted, and the sheet vertex of each vertex of the
/// rendered skin.
pub(crate) fn bare_sheet(person: &Person, params: &HeadParams) -> (HeadSheet, Vec<usize>) {
    let shape = Shape::build(person, &params.bound, params.asymmetry);
    let line = BrowLine::above(&shape.fitted.brow);
    let (used, _) = faces_of_zones(&shape.surface, chart(), skin_cut(&[]).keep);
    (shape.sheet(&line, params.brow.colour), used)
}
