//! Where hair grows: the hairline, the skin above it, and the measures of a head by which
//! hair made for one head fits another.

use raconteur_base::{DVec3, ops};

use super::paint::Coordinates;
use super::rig::smooth;

/// A vertex of the head's skin as hair sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScalpPoint {
    /// Position, metres, frame of the head.
    pub position: DVec3,
    /// Outward unit normal.
    pub normal: DVec3,
    /// 1 where hair grows densely, falling to 0 over the hairline.
    pub density: f64,
}

/// The part of the skin on which hair grows, with what hair must keep clear of.
#[derive(Clone, Debug, Default)]
pub struct Scalp {
    /// Vertices.
    pub points: Vec<ScalpPoint>,
    /// Triangles, counter-clockwise from outside; each has a vertex of density above zero.
    pub triangles: Vec<[u32; 3]>,
    /// Measures of the head.
    pub proportions: Proportions,
    /// The left and the right ear.
    pub ears: [Ear; 2],
    /// Points of the red of the lips, metres.
    pub lips: Vec<DVec3>,
}

/// The room an ear takes: an ellipsoid along the axes; metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ear {
    /// Middle.
    pub centre: DVec3,
    /// Half axes.
    pub radii: DVec3,
}

impl Ear {
    fn around(points: impl Iterator<Item = DVec3>) -> Self {
        let (low, high) = points.fold((DVec3::MAX, DVec3::MIN), |(a, b), p| (a.min(p), b.max(p)));
        if low.cmpgt(high).any() {
            return Self::default();
        }
        Self {
            centre: (low + high) * 0.5,
            radii: (high - low) * 0.5,
        }
    }
}

/// Measures from the middle between the tragions, metres. Hair is described on a common
/// head; [`Self::common`] finds the place on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proportions {
    /// Half the breadth of the skull.
    pub half_breadth: f64,
    /// Height of the vertex.
    pub vertex: f64,
    /// Depth of the menton below the tragions, positive.
    pub menton: f64,
    /// Reach of the forehead to the front.
    pub front: f64,
    /// Reach of the occiput to the back, positive.
    pub back: f64,
}

/// The common head: the generator's own mean, to the millimetre.
const COMMON: Proportions = Proportions {
    half_breadth: 0.073,
    vertex: 0.127,
    menton: 0.089,
    front: 0.097,
    back: 0.092,
};

impl Default for Proportions {
    fn default() -> Self {
        COMMON
    }
}

impl Proportions {
    /// Measures a head given in mm.
    pub(super) fn of(positions: &[DVec3], coordinates: &[Coordinates]) -> Self {
        let skin = || {
            positions
                .iter()
                .zip(coordinates)
                .filter(|(_, c)| c.ear < 0.02)
                .map(|(p, _)| *p)
        };
        let most = |f: &dyn Fn(DVec3) -> Option<f64>| skin().filter_map(f).fold(1.0, f64::max);
        let vertex = most(&|p| Some(p.y));
        let front = most(&|p| (p.y > 0.35 * vertex && p.y < 0.5 * vertex).then_some(p.z));
        Self {
            half_breadth: 1e-3 * most(&|p| (p.y > 0.35 * vertex).then_some(p.x.abs())),
            vertex: 1e-3 * vertex,
            menton: 1e-3 * most(&|p| (p.z > 0.88 * front).then_some(-p.y)),
            front: 1e-3 * front,
            back: 1e-3 * most(&|p| (p.y > 0.0).then_some(-p.z)),
        }
    }

    /// The place on the common head that answers to a place on this one; metres.
    #[must_use]
    pub fn common(&self, p: DVec3) -> DVec3 {
        let y = if p.y > 0.0 {
            COMMON.vertex / self.vertex
        } else {
            COMMON.menton / self.menton
        };
        let z = if p.z > 0.0 {
            COMMON.front / self.front
        } else {
            COMMON.back / self.back
        };
        p * DVec3::new(COMMON.half_breadth / self.half_breadth, y, z)
    }

    /// This head's size over the common one's.
    #[must_use]
    pub fn size(&self) -> f64 {
        (self.half_breadth / COMMON.half_breadth
            + self.vertex / COMMON.vertex
            + (self.front + self.back) / (COMMON.front + COMMON.back))
            / 3.0
    }
}

/// Height of the hairline on the common head, mm, by angle from the front in degrees.
const HAIRLINE: [[f64; 2]; 14] = [
    [0.0, 80.0],
    [15.0, 80.0],
    [28.0, 82.0],
    [40.0, 79.0],
    [52.0, 66.0],
    [62.0, 54.0],
    [72.0, 42.0],
    [80.0, 22.0],
    [88.0, -6.0],
    [100.0, 26.0],
    [112.0, 20.0],
    [125.0, -24.0],
    [150.0, -48.0],
    [180.0, -54.0],
];

/// Density of hair at a place on the common head, 0..1; metres.
pub(super) fn hairline(p: DVec3) -> f64 {
    let angle = ops::atan2(p.x.abs(), p.z).to_degrees();
    let next = HAIRLINE
        .iter()
        .position(|h| h[0] >= angle)
        .unwrap_or(13)
        .max(1);
    let ([a, low], [b, high]) = (HAIRLINE[next - 1], HAIRLINE[next]);
    let line = low + (high - low) * ((angle - a) / (b - a)).clamp(0.0, 1.0);
    smooth(-4.0, 11.0, p.y * 1e3 - line)
}

/// The part of the skin with hair; positions in mm.
pub(super) fn scalp(
    positions: &[DVec3],
    normals: &[DVec3],
    coordinates: &[Coordinates],
    density: &[f64],
    all: &[[u32; 3]],
    proportions: Proportions,
) -> Scalp {
    let mut index = vec![u32::MAX; positions.len()];
    let chosen = |want: &dyn Fn(&Coordinates) -> bool| -> Vec<DVec3> {
        positions
            .iter()
            .zip(coordinates)
            .filter(|(_, c)| want(c))
            .map(|(p, _)| *p * 1e-3)
            .collect()
    };
    // The outer rings of an ear lie flat on the head.
    let ear = chosen(&|c| c.ear > 2.0);
    let of_side = |sign: f64| Ear::around(ear.iter().copied().filter(|p| p.x * sign > 0.0));
    let mut scalp = Scalp {
        points: Vec::new(),
        triangles: Vec::new(),
        proportions,
        ears: [of_side(1.0), of_side(-1.0)],
        lips: chosen(&|c| (0.8..4.0).contains(&c.mouth)),
    };
    for t in all
        .iter()
        .filter(|t| t.iter().any(|&v| density[v as usize] > 0.0))
    {
        scalp.triangles.push(t.map(|v| {
            let slot = &mut index[v as usize];
            if *slot == u32::MAX {
                *slot = scalp.points.len() as u32;
                scalp.points.push(ScalpPoint {
                    position: positions[v as usize] * 1e-3,
                    normal: normals[v as usize],
                    density: density[v as usize],
                });
            }
            *slot
        }));
    }
    scalp
}
