//! The head: skin, eyes, mouth, brows and lashes of one person, with face morph targets.
//!
//! A ring-structured cage is solved so that its limit surface passes through named points; weights,
//! colours and morph targets are specified on the cage and transferred to the rendered surface.
//!
//! Frame of the head: origin between the tragions, x left, y up, z front; metres outside this
//! module, millimetres inside it.

mod bare;
mod binding;
mod cage;
mod chart;
mod cut;
mod ear_relief;
mod eye;
mod field;
mod fitted_half;
mod fitting;
mod landmark;
mod lining;
mod mean;
mod measure;
mod morph;
mod mouth;
mod neck;
mod occlusion;
mod paint;
mod refined;
mod registration;
mod rig;
mod scalp;
mod scalp_binding;
mod seal;
mod segment;
mod sheet;
mod soft;
mod solve;
mod strands;
mod surface;
#[cfg(test)]
mod tests;

use raconteur_base::{DVec3, Side, mirror_vector};
use serde::{Deserialize, Serialize};

pub(crate) use self::bare::bare_sheet;
pub use self::bare::{BareSkin, Organs};
pub use self::binding::{Binding, ModelHeadShape};
use self::cage::{Cage, Key, LAST_ROW};
pub(crate) use self::chart::Places;
use self::chart::chart;
use self::cut::{PartCut, behind, cut_part, is_bag, skin_cut};
pub use self::field::{FIELDS, Field, expression_fields, field_index};
use self::fitted_half::FittedHalf;
pub(crate) use self::fitted_half::{CENTRED, eye_mm};
pub use self::fitting::{MeasureGoal, fit_measures, measures};
pub use self::measure::{KnownMeasure, Measure, known_measures};
use self::paint::coordinates;
pub(crate) use self::paint::{Coordinates, MOUTH_DEEP};
pub use self::registration::{Deviation, HeadRegistration, deviations, register};
pub use self::scalp::{Ear, Proportions, Scalp};
pub(crate) use self::scalp_binding::{ScalpBinding, VertexWeights};
pub use self::segment::HeadSegment;
pub(crate) use self::sheet::HeadSheet;
pub(crate) use self::soft::{LipPlace, Soft, SoftNode};
use self::strands::BrowLine;
pub use self::strands::BrowParams;
use self::surface::{Surface, triangles};
use super::model::Traits;
use super::part::{MOUTH_BAG, MeshPart, PartVertex};
use super::person::Person;
use crate::subdivide::Stencil;
use raconteur_base::surface::vertex_normals;
use raconteur_body::figure::MaterialKind;

/// Parameters that distinguish heads of the same sex and age: shape, iris, brows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeadParams {
    /// The person of the body model whose head it is.
    pub traits: Traits,
    /// Model's head for these traits. It is not stored in a description; readers evaluate the model
    /// instead.
    #[serde(skip)]
    pub bound: ModelHeadShape,
    /// Colour of the iris, linear RGB.
    pub iris: [f64; 3],
    /// Hairs of brows and lashes.
    pub brow: BrowParams,
    /// Strength of the natural differences between the two halves; 0 is mirror-symmetric,
    /// 1 usual.
    pub asymmetry: f64,
    /// Seed of everything scattered.
    pub seed: u64,
}

/// Built head, ready for rigging: parts, joints and landmarks. Everything is in metres in the frame
/// of the head: origin between the tragions, x left, y up, z front.
#[derive(Clone, Debug)]
pub struct Head {
    /// Drawable parts, the skin first, in the bind pose: lids open, jaw closed.
    pub parts: Vec<MeshPart>,
    /// Centres of the left and the right eyeball.
    pub eye_centres: [DVec3; 2],
    /// Position of `bone_chin`. A positive rotation about its local z opens the jaw: 0.30 rad is
    /// fully open.
    pub jaw_hinge: DVec3,
    /// Position of the joint `bone_skull`, metres.
    pub skull_origin: DVec3,
    /// The neck's open rim, counter-clockwise from above, closed implicitly.
    pub neck_rim: Vec<DVec3>,
    /// Upper-lid rotation that closes the eye with the lower lid at rest, left and right.
    pub lid_closure_rad: [f64; 2],
    /// Heights of the chin's lowest point and of the vertex.
    pub extent: [f64; 2],
    /// Measures for a beard.
    pub scalp: Scalp,
    /// The skin for the baking of its maps.
    pub(crate) sheet: HeadSheet,
    /// Named points: name and vertex of the first part, the skin.
    pub landmarks: Vec<(String, u32)>,
    /// Segments of the first part, the skin.
    pub segments: Vec<HeadSegment>,
    /// Moving soft tissue under the skin.
    pub(crate) soft: Soft,
}

impl Head {
    /// Returns the skin, the first of the parts.
    pub fn skin(&self) -> &MeshPart {
        &self.parts[0]
    }
}

/// The shape of a head before it is painted, millimetres.
struct Shape {
    cage: Cage,
    solved: solve::Solved,
    rig: rig::Rig,
    surface: Surface,
    positions: Vec<DVec3>,
    coordinates: Vec<Coordinates>,
    shares: Vec<rig::Shares>,
    /// Fitted half for which it was solved.
    fitted: FittedHalf,
}

impl Shape {
    /// Builds the head of a person with a share of the model's asymmetry.
    fn build(person: &Person, bound: &ModelHeadShape, asymmetry: f64) -> Self {
        let cage = Cage::new();
        let fitted = fitted_half::fit(bound, |key| neck::rim(person, key));
        let mut solved = solve::solve(&cage, &fitted.points);
        for (p, &(key, side)) in solved.cage_points.iter_mut().zip(&cage.keys) {
            *p += fitted_half::sway(bound, key, side) * asymmetry;
        }
        seal::seal(&cage, &mut solved.cage_points);
        let rig = rig::rig(&cage, &solved, fitted.globe);
        let surface = Surface::new(&cage);
        let positions = surface.apply(&solved.cage_points);
        let coordinates = coordinates(&cage, &surface);
        let shares = surface.apply(&rig.shares);
        Self {
            cage,
            solved,
            rig,
            surface,
            positions,
            coordinates,
            shares,
            fitted,
        }
    }

    fn limit(&self, key: Key, side: Side) -> DVec3 {
        self.solved
            .limit_of(self.cage.vertex(key, side), &self.solved.cage_points)
    }
}

/// Data computed on the surface of a head before parts are cut from it.
struct Painted {
    proportions: Proportions,
    /// The vertices of the skin, and of the bag of the mouth with the colour of its lining.
    vertices: Vec<PartVertex>,
    lined: Vec<PartVertex>,
    /// Movements of the morphs, millimetres.
    moved: Vec<(&'static str, Vec<DVec3>)>,
    /// Weights of the tissue nodes for each vertex.
    rows: Vec<Stencil>,
}

/// Offset of the caruncle from the inner corner of the eye, left, mm.
const FLESH_FROM_CORNER_MM: DVec3 = DVec3::new(2.0, 0.8, -1.9);

impl Painted {
    fn evaluate(shape: &Shape, warp: &dyn Fn(DVec3) -> DVec3, follow: &soft::Follow) -> Self {
        let (positions, coordinates) = (&shape.positions, &shape.coordinates);
        let surface = &shape.surface;
        let normals = vertex_normals(positions, &surface.faces);
        let proportions = Proportions::measure(positions, coordinates);
        let triangles: Vec<[u32; 3]> = triangles(&surface.faces).collect();
        let receivers: Vec<(DVec3, DVec3)> = positions
            .iter()
            .copied()
            .zip(normals.iter().copied())
            .collect();
        let open = occlusion::openness(positions, &triangles, &receivers, 0.8);
        let moved = morph::morphs(&shape.cage, &shape.solved, &shape.rig.shares, warp)
            .iter()
            .map(|m| (m.name, surface.apply(&m.deltas)))
            .collect();
        let vertices: Vec<PartVertex> = (0..surface.len())
            .map(|v| shape.vertex(v, open[v]))
            .collect();
        let lined = vertices
            .iter()
            .zip(positions.iter().zip(coordinates))
            .map(|(v, (&p, c))| {
                let [r, g, b] = paint::lining(c, p);
                PartVertex {
                    color: [r, g, b, v.color[3]],
                    ..v.clone()
                }
            })
            .collect();
        Self {
            proportions,
            vertices,
            lined,
            moved,
            rows: surface.fine().iter().map(|&v| follow.row(v)).collect(),
        }
    }

    /// Cuts a part out of the surface.
    fn cut_part(&self, shape: &Shape, cut: &PartCut<'_>) -> MeshPart {
        let mut part = cut_part(&shape.surface, chart(), &self.moved, cut);
        let source = behind(&part, &shape.positions);
        part.bound = (0u32..)
            .zip(&source)
            .filter_map(|(i, &v)| Some((i, self.rows.get(v as usize)?.clone())))
            .filter(|(_, row)| !row.is_empty())
            .collect();
        part
    }
}

impl Shape {
    /// Returns the sheet from which the maps of the skin are baked.
    fn sheet(&self, line: &BrowLine, brow_colour: [f64; 3]) -> HeadSheet {
        let chart = chart();
        let (positions, surface) = (&self.positions, &self.surface);
        HeadSheet {
            uv: chart.uv.clone(),
            triangles: surface
                .zones
                .iter()
                .zip(&chart.faces)
                .filter(|(z, _)| !is_bag(**z))
                .flat_map(|(_, f)| f[1..].windows(2).map(|w| [f[0], w[0], w[1]]))
                .collect(),
            at: chart.select(positions),
            mean: chart.select(&chart.mean),
            normals: chart.select(&vertex_normals(&chart.mean, &surface.faces)),
            rings: chart.select(&self.coordinates),
            brow: chart.select(&positions.iter().map(|&p| line.stain(p)).collect::<Vec<_>>()),
            brow_colour,
            places: Some(&chart.places),
        }
    }

    /// Returns a vertex of the skin; `open` is its visible share of the surroundings.
    fn vertex(&self, v: usize, open: f64) -> PartVertex {
        let (c, position) = (&self.coordinates[v], self.positions[v]);
        let side = if position.x < 0.0 {
            Side::Right
        } else {
            Side::Left
        };
        // The occlusion of touching lips and lids at rest must not remain when they open. The same
        // applies to the upper lid, which is folded away while the eye is open.
        let lid = 0.78 * rig::smooth(1.6, 3.2, c.eye) * c.eye_upper.max(0.0);
        let least = 0.55 * rig::smooth(2.8, 3.6, c.mouth).max(rig::smooth(4.6, 5.2, c.eye));
        // Light reflected from the surrounding skin, where the mesh is too coarse to distinguish a
        // fold from a pit.
        let skin = c.nostril < 0.5 && c.mouth < 3.0 && c.ear < 6.0;
        let least = least.max(lid).max(if skin { 0.3 } else { 0.0 });
        let deep = 1.0 - 0.8 * rig::smooth(5.0, 7.5, c.mouth);
        PartVertex {
            position: position * 1e-3,
            uv: [0.0; 2],
            // The map has the colour.
            color: [1.0, 1.0, 1.0, open.max(least) * deep],
            weights: rig::joints(self.shares[v], side),
        }
    }

    /// Returns the midpoint of the line where the lips meet, millimetres.
    fn lips(&self) -> DVec3 {
        let contact = |k| self.limit(Key::mouth(5, k), Side::Left);
        (contact(0) + contact(12)) / 2.0
    }

    /// Centres of the left and the right eyeball, millimetres.
    fn eye_centres(&self) -> [DVec3; 2] {
        [self.fitted.globe, mirror_vector(self.fitted.globe)]
    }

    /// Builds one eye with its lashes and its brow.
    fn eye_parts(
        &self,
        side: Side,
        params: &HeadParams,
        ride: &ScalpBinding,
        line: &BrowLine,
    ) -> Vec<MeshPart> {
        let flesh = self.fitted.points[&Key::eye(5, 0)] + FLESH_FROM_CORNER_MM;
        let flesh = if side == Side::Left {
            flesh
        } else {
            mirror_vector(flesh)
        };
        let globe = self.eye_centres()[side.index()];
        let mut parts: Vec<MeshPart> = eye::eye(side, globe, flesh, params.iris)
            .into_iter()
            .collect();
        let edge = |k: usize| self.limit(Key::eye(5, k), side);
        let edges = [
            (0..=8).map(edge).collect(),
            (8..=16).rev().map(edge).collect(),
        ];
        let (seed, hairs) = (params.seed, &params.brow);
        parts.push(strands::brow(ride, line, side, seed, hairs));
        parts.push(strands::lashes(ride, &edges, globe, side, seed, hairs));
        parts
    }

    /// Heights of the chin's lowest point and of the vertex, metres.
    fn extent(&self) -> [f64; 2] {
        let menton = self
            .positions
            .iter()
            .zip(&self.shares)
            .filter(|(_, s)| s.jaw > 0.9)
            .map(|(p, _)| p.y)
            .fold(f64::MAX, f64::min);
        let vertex = self.positions.iter().map(|p| p.y).fold(f64::MIN, f64::max);
        [menton * 1e-3, vertex * 1e-3]
    }
}

/// Builds the head of a person from its parameters.
#[must_use]
pub fn build(person: &Person, params: &HeadParams) -> Head {
    let shape = Shape::build(person, &params.bound, params.asymmetry);
    let (soft, follow) = soft::soft(&shape.cage, &shape.solved, &shape.rig.shares);
    let warp = mean::warp(&soft.landmarks);
    let line = BrowLine::above(&shape.fitted.brow);
    let painted = Painted::evaluate(&shape, &warp, &follow);
    let skin = skin_cut(&painted.vertices);
    let bag = PartCut {
        name: MOUTH_BAG,
        kind: MaterialKind::Mouth,
        roughness: 0.4,
        vertices: &painted.lined,
        keep: is_bag,
    };
    let mut parts = vec![
        painted.cut_part(&shape, &skin),
        painted.cut_part(&shape, &bag),
    ];
    let ride = ScalpBinding::new(&parts[0]);
    parts.extend(mouth::mouth(shape.lips()));
    for side in Side::BOTH {
        parts.extend(shape.eye_parts(side, params, &ride, &line));
    }
    let drawn = behind(&parts[0], &shape.positions);
    Head {
        parts,
        eye_centres: shape.eye_centres().map(|p| p * 1e-3),
        jaw_hinge: rig::JAW_HINGE_MM * 1e-3,
        skull_origin: rig::SKULL_ORIGIN_MM * 1e-3,
        neck_rim: neck_rim(&shape),
        lid_closure_rad: shape.rig.closure_rad,
        extent: shape.extent(),
        scalp: scalp::scalp(&shape.positions, &shape.coordinates, painted.proportions),
        sheet: shape.sheet(&line, params.brow.colour),
        landmarks: named(&shape, &drawn),
        segments: segment::segments(&shape, &drawn),
        soft,
    }
}

/// Returns the named points: name and vertex of the rendered surface.
fn named(shape: &Shape, drawn: &[u32]) -> Vec<(String, u32)> {
    let drawn_at = |v: u32| drawn.iter().position(|&d| d == v);
    landmark::landmarks(shape)
        .into_iter()
        .filter_map(|(name, v)| Some((name, drawn_at(v)? as u32)))
        .collect()
}

fn neck_rim(shape: &Shape) -> Vec<DVec3> {
    let at = |i: u8, side| shape.limit(Key::Grid(i, LAST_ROW), side) * 1e-3;
    let left = (0..=cage::LAST_COLUMN).map(|i| at(i, Side::Left));
    let right = (1..cage::LAST_COLUMN).rev().map(|i| at(i, Side::Right));
    left.chain(right).collect()
}
