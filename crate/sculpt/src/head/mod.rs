//! The head: skin, eyes, mouth, brows and lashes of one person, with face morphs.
//!
//! A ring-structured cage is solved so that its limit surface passes through named points;
//! weights, colours and morphs are given on the cage and follow to the drawn surface.
//!
//! Frame of the head: origin between the tragions, x left, y up, z front; metres outside
//! this module, millimetres inside it.

mod asymmetry;
mod cage;
mod chart;
mod ear;
mod ear_shape;
mod eye;
mod form;
mod individual;
mod landmark;
mod measure;
mod morph;
mod mouth;
mod occlusion;
mod paint;
mod points;
mod ride;
mod rig;
mod scalp;
mod segment;
mod soft;
pub(crate) mod solve;
mod strands;
mod surface;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use raconteur_base::{DVec3, Side, mirror_vector};
use serde::{Deserialize, Serialize};

use self::cage::{Cage, Key, LAST_ROW, Zone};
pub(crate) use self::chart::Places;
use self::chart::{Chart, chart};
pub use self::measure::{KnownMeasure, Measure, Measures, known_measures};
pub(crate) use self::paint::Coordinates;
use self::paint::coordinates;
use self::points::Individual;
pub(crate) use self::ride::{Holds, Ride};
use self::scalp::hairline;
pub use self::scalp::{Ear, Proportions, Scalp, ScalpPoint};
pub use self::segment::HeadSegment;
pub(crate) use self::soft::{LipPlace, Soft, SoftNode};
use self::strands::BrowLine;
pub use self::strands::BrowParams;
use self::surface::{Surface, triangles};
use super::part::{MOUTH_BAG, MeshPart, PartMorph, PartVertex};
use super::person::Person;
use super::skin::HeadSheet;
use crate::subdivide::{Stencil, vertex_normals};
use raconteur_body::figure::{Maps, Material, MaterialKind};

/// What tells one head from another of the same sex and age.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeadParams {
    /// Friendliness of the face at rest, 0 neutral to 1 a light smile.
    pub smile: f64,
    /// Measures of head and face against the mean for sex and age.
    pub measures: Measures,
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

impl Default for HeadParams {
    /// The mean face with brown eyes.
    fn default() -> Self {
        Self {
            smile: 0.0,
            measures: Measures::default(),
            iris: [0.15, 0.085, 0.042],
            brow: BrowParams::default(),
            asymmetry: 1.0,
            seed: 1,
        }
    }
}

/// A built head. Everything is in metres in the frame of the head: origin between the
/// tragions, x left, y up, z front.
#[derive(Clone, Debug)]
pub struct Head {
    /// Drawable parts, the skin first, in the bind pose: lids open, jaw closed.
    pub parts: Vec<MeshPart>,
    /// Centres of the left and the right eyeball.
    pub eye_centres: [DVec3; 2],
    /// Where `bone_chin` belongs. A positive turn about its local z opens the jaw: 0.30 rad
    /// is fully open.
    pub jaw_hinge: DVec3,
    /// Where `bone_skull` belongs.
    pub skull_origin: DVec3,
    /// The neck's open rim, counter-clockwise from above, closed implicitly.
    pub neck_rim: Vec<DVec3>,
    /// Upper-lid rotation that closes the eye with the lower lid at rest, left and right.
    pub lid_closure_rad: [f64; 2],
    /// Heights of the chin's lowest point and of the vertex.
    pub extent: [f64; 2],
    /// Where hair grows.
    pub scalp: Scalp,
    /// The skin for the baking of its maps.
    pub(crate) sheet: HeadSheet,
    /// Named points: name and vertex of the first part, the skin.
    pub landmarks: Vec<(String, u32)>,
    /// Segments of the first part, the skin.
    pub segments: Vec<HeadSegment>,
    /// What moves under the skin.
    pub(crate) soft: Soft,
}

impl Head {
    /// The skin, which is the first of its parts.
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
    /// Centre of the left eyeball.
    globe: DVec3,
    individual: Individual,
}

impl Shape {
    fn of(person: &Person, params: &HeadParams) -> Self {
        let cage = Cage::new();
        let individual = individual::individual(person, params, &cage);
        Self::new(cage, individual, params.asymmetry, params.seed)
    }

    fn new(cage: Cage, individual: Individual, asymmetry: f64, seed: u64) -> Self {
        let mut solved = solve::solve(&cage, &points::points(&individual));
        let pulls = asymmetry::pulls(seed, asymmetry, &points::warp(&individual));
        for p in &mut solved.cage_points {
            let symmetric = *p;
            for pull in &pulls {
                *p += pull.shift * pull.share(symmetric);
            }
        }
        let rig = rig::rig(&cage, &solved, individual.globe_centre());
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
            globe: individual.globe_centre(),
            individual,
        }
    }

    fn limit(&self, key: Key, side: Side) -> DVec3 {
        self.solved
            .limit_of(self.cage.at(key, side), &self.solved.cage_points)
    }
}

/// Builds the head of a person. `hair_colour`, linear RGB, shines through where hair grows.
#[must_use]
pub fn build(person: &Person, params: &HeadParams, hair_colour: [f64; 3]) -> Head {
    let shape = Shape::of(person, params);
    let Shape {
        cage,
        solved,
        rig,
        surface,
        positions,
        coordinates,
        shares,
        globe,
        individual,
    } = &shape;
    let globe = *globe;
    let normals = vertex_normals(positions, &surface.faces);
    let (soft, follow) = soft::soft(cage, solved, &rig.shares, individual);
    let rows: Vec<Stencil> = surface.fine().iter().map(|&v| follow.row(v)).collect();
    let warp = points::warp(individual);
    let proportions = Proportions::of(positions, coordinates);
    let hair: Vec<f64> = positions
        .iter()
        .zip(coordinates)
        .map(|(&p, c)| {
            if c.ear > 0.02 {
                0.0
            } else {
                hairline(proportions.common(p * 1e-3))
            }
        })
        .collect();

    let all_triangles: Vec<[u32; 3]> = triangles(&surface.faces).collect();
    let receivers: Vec<(DVec3, DVec3)> = positions
        .iter()
        .copied()
        .zip(normals.iter().copied())
        .collect();
    let open = occlusion::openness(positions, &all_triangles, &receivers, 0.8);

    let cage_morphs = morph::morphs(cage, solved, &rig.shares, &warp);
    let moved: Vec<(&'static str, Vec<DVec3>)> = cage_morphs
        .iter()
        .map(|m| (m.name, surface.apply(&m.deltas)))
        .collect();

    let line = BrowLine::new(&warp);
    let chart = chart();
    let vertices: Vec<PartVertex> = (0..surface.len())
        .map(|v| {
            let c = &coordinates[v];
            let side = if positions[v].x < 0.0 {
                Side::Right
            } else {
                Side::Left
            };
            // What is dark only because lips and lids touch at rest must not stay so.
            // So with the upper lid, which is folded away while the eye is open.
            let lid = 0.78 * rig::smooth(1.6, 3.2, c.eye) * c.eye_upper.max(0.0);
            let least = 0.55 * rig::smooth(2.8, 3.6, c.mouth).max(rig::smooth(4.6, 5.2, c.eye));
            let least = least.max(lid);
            let deep = 1.0 - 0.8 * rig::smooth(5.0, 7.5, c.mouth);
            PartVertex {
                position: positions[v] * 1e-3,
                uv: [0.0; 2],
                // The map has the colour.
                color: [1.0, 1.0, 1.0, open[v].max(least) * deep],
                weights: rig::joints(shares[v], side),
            }
        })
        .collect();
    let bag = |z: Zone| matches!(z, Zone::Mouth(5..));
    let sheet = HeadSheet {
        uv: chart.uv.clone(),
        triangles: surface
            .zones
            .iter()
            .zip(&chart.faces)
            .filter(|(z, _)| !bag(**z))
            .flat_map(|(_, f)| f[1..].windows(2).map(|w| [f[0], w[0], w[1]]))
            .collect(),
        at: chart.of(positions),
        mean: chart.of(&chart.mean),
        normals: chart.of(&vertex_normals(&chart.mean, &surface.faces)),
        rings: chart.of(coordinates),
        hair: chart.of(&hair),
        brow: chart.of(&positions.iter().map(|&p| line.stain(p)).collect::<Vec<_>>()),
        hair_colour,
        brow_colour: params.brow.colour,
        places: Some(&chart.places),
    };
    let lined: Vec<PartVertex> = vertices
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
    let cut = |name: &str, kind, roughness, from: &[PartVertex], keep: &dyn Fn(Zone) -> bool| {
        let mut part = cut_part(name, kind, roughness, surface, chart, from, &moved, keep);
        let source = behind(&part, positions);
        part.bound = (0u32..)
            .zip(&source)
            .filter_map(|(i, &v)| Some((i, rows.get(v as usize)?.clone())))
            .filter(|(_, row)| !row.is_empty())
            .collect();
        part
    };
    let mut parts = vec![
        cut("head", MaterialKind::Skin, 0.48, &vertices, &|z| !bag(z)),
        cut(MOUTH_BAG, MaterialKind::Mouth, 0.4, &lined, &bag),
    ];
    let ride = Ride::new(&parts[0]);
    let contact = |k| shape.limit(Key::mouth(5, k), Side::Left);
    parts.extend(mouth::mouth((contact(0) + contact(12)) / 2.0));
    let eye_centres = [globe, mirror_vector(globe)];
    for side in Side::BOTH {
        let flesh = DVec3::new(19.8, 20.1, 80.1) + points::shift(individual, Key::eye(5, 0));
        let flesh = if side == Side::Left {
            flesh
        } else {
            mirror_vector(flesh)
        };
        parts.extend(eye::eye(
            side,
            eye_centres[side.index()],
            flesh,
            params.iris,
        ));
        let edge = |k: usize| shape.limit(Key::eye(5, k), side);
        let edges = [
            (0..=8).map(edge).collect(),
            (8..=16).rev().map(edge).collect(),
        ];
        let globe = eye_centres[side.index()];
        parts.extend(strands::hairs(
            &ride,
            &line,
            &edges,
            globe,
            side,
            params.seed,
            &params.brow,
        ));
    }

    let drawn = behind(&parts[0], positions);
    let menton = positions
        .iter()
        .zip(shares)
        .filter(|(_, s)| s.jaw > 0.9)
        .map(|(p, _)| p.y)
        .fold(f64::MAX, f64::min);
    let vertex = positions.iter().map(|p| p.y).fold(f64::MIN, f64::max);
    Head {
        parts,
        eye_centres: eye_centres.map(|p| p * 1e-3),
        jaw_hinge: rig::JAW_HINGE_MM * 1e-3,
        skull_origin: rig::SKULL_ORIGIN_MM * 1e-3,
        neck_rim: neck_rim(&shape),
        lid_closure_rad: rig.closure_rad,
        extent: [menton * 1e-3, vertex * 1e-3],
        scalp: scalp::scalp(
            positions,
            &normals,
            coordinates,
            &hair,
            &all_triangles,
            proportions,
        ),
        sheet,
        landmarks: landmark::landmarks(&shape)
            .into_iter()
            .filter_map(|(name, v)| {
                let at = drawn.iter().position(|&d| d == v)?;
                Some((name, at as u32))
            })
            .collect(),
        segments: segment::segments(&shape, &drawn),
        soft,
    }
}

/// The surface's vertex behind each vertex of a part cut from it, by place: a part may hold
/// a place twice where its texture has a seam.
fn behind(part: &MeshPart, positions: &[DVec3]) -> Vec<u32> {
    let key = |p: DVec3| p.to_array().map(f64::to_bits);
    let by_place: BTreeMap<[u64; 3], u32> = positions
        .iter()
        .zip(0u32..)
        .map(|(&p, v)| (key(p * 1e-3), v))
        .collect();
    part.vertices
        .iter()
        .map(|v| by_place.get(&key(v.position)).copied().unwrap_or(u32::MAX))
        .collect()
}

/// The faces of some zones as a part of their own, with vertices doubled along the chart's
/// cut.
#[allow(
    clippy::too_many_arguments,
    reason = "everything that a part is made of"
)]
fn cut_part(
    name: &str,
    kind: MaterialKind,
    roughness: f32,
    surface: &Surface,
    chart: &Chart,
    vertices: &[PartVertex],
    moved: &[(&'static str, Vec<DVec3>)],
    keep: &dyn Fn(Zone) -> bool,
) -> MeshPart {
    let mut index = vec![u32::MAX; chart.uv.len()];
    let mut used: Vec<usize> = Vec::new();
    let kept = chart
        .faces
        .iter()
        .zip(&surface.zones)
        .filter(|&(_, &z)| keep(z));
    let faces = kept
        .map(|(face, _)| {
            let slot = |&v: &u32| {
                let slot = &mut index[v as usize];
                if *slot == u32::MAX {
                    *slot = used.len() as u32;
                    used.push(v as usize);
                }
                *slot
            };
            face.iter().map(slot).collect()
        })
        .collect();
    let source = |v: &usize| chart.source[*v] as usize;
    let morphs = moved
        .iter()
        .map(|(name, d)| part_morph(name, &used.iter().map(|v| d[source(v)]).collect::<Vec<_>>()))
        .filter(|m| !m.deltas.is_empty())
        .collect();
    MeshPart {
        name: name.to_owned(),
        material: Material {
            kind,
            base_color: [1.0; 4],
            roughness,
            double_sided: false,
            maps: Maps::default(),
        },
        vertices: used
            .iter()
            .map(|v| PartVertex {
                uv: chart.uv[*v],
                ..vertices[source(v)].clone()
            })
            .collect(),
        faces,
        morphs,
        bound: Vec::new(),
    }
}

/// Movements below 20 µm are left out.
fn part_morph(name: &str, deltas_mm: &[DVec3]) -> PartMorph {
    let kept = |(_, d): &(usize, &DVec3)| d.length_squared() > 4e-4;
    PartMorph {
        name: name.to_owned(),
        deltas: deltas_mm
            .iter()
            .enumerate()
            .filter(kept)
            .map(|(i, &d)| (i as u32, d * 1e-3))
            .collect(),
    }
}

fn neck_rim(shape: &Shape) -> Vec<DVec3> {
    let at = |i: u8, side| shape.limit(Key::Grid(i, LAST_ROW), side) * 1e-3;
    let left = (0..=cage::LAST_COLUMN).map(|i| at(i, Side::Left));
    let right = (1..cage::LAST_COLUMN).rev().map(|i| at(i, Side::Right));
    left.chain(right).collect()
}
