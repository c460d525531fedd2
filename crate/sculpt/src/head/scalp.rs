//! Head measures for fitting a beard to another head.

use raconteur_base::DVec3;

use super::paint::Coordinates;

/// Measures of the head on which hair is laid out, and the areas that a beard must avoid.
#[derive(Clone, Debug, Default)]
pub struct Scalp {
    /// Measures of the head.
    pub proportions: Proportions,
    /// The left and the right ear.
    pub ears: [Ear; 2],
    /// Points of the red of the lips, metres.
    pub lips: Vec<DVec3>,
}

/// Bounds of an ear, which hair avoids: an axis-aligned ellipsoid, metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ear {
    /// Centre of the ellipsoid, metres.
    pub centre: DVec3,
    /// Half axes of the ellipsoid x, y, z, metres.
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

/// Measures of the head from the midpoint between the tragions, metres. Hair is described on a
/// common head; [`Self::common`] maps positions to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proportions {
    /// Half the breadth of the skull, metres.
    pub half_breadth: f64,
    /// Height of the vertex.
    pub vertex: f64,
    /// Height of the tragions (notches in front of the ears) above the menton (lowest point of the
    /// chin), metres, positive.
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
    pub(super) fn measure(positions: &[DVec3], coordinates: &[Coordinates]) -> Self {
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

    /// Returns the position on the common head that corresponds to a position on this one; metres.
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

    /// Returns the size of this head relative to the common head.
    #[must_use]
    pub fn size(&self) -> f64 {
        (self.half_breadth / COMMON.half_breadth
            + self.vertex / COMMON.vertex
            + (self.front + self.back) / (COMMON.front + COMMON.back))
            / 3.0
    }
}

/// Measures a head given in mm.
pub(super) fn scalp(
    positions: &[DVec3],
    coordinates: &[Coordinates],
    proportions: Proportions,
) -> Scalp {
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
    Scalp {
        proportions,
        ears: [of_side(1.0), of_side(-1.0)],
        lips: chosen(&|c| (0.8..4.0).contains(&c.mouth)),
    }
}
