//! Hair drawn back into a knot.

use raconteur_base::{DVec3, ops};

use super::HairParams;
use super::cut::{Coil, Cut, LAYER, Layer, Locks, Weave, Where, slope};

/// Middle of the knot on the common head, metres.
const KNOT: DVec3 = DVec3::new(0.0, 0.062, -0.112);
/// Radius of the knot.
const RADIUS: f64 = 0.027;

const LAYERS: [Layer; 4] = [
    Layer {
        cards: 110,
        spans: 8,
        height: 0.0023,
        width: 0.026,
        open: [0.5, 0.55],
        ..LAYER
    },
    Layer {
        cards: 190,
        spans: 8,
        height: 0.0053,
        width: 0.020,
        open: [0.7, 0.85],
        ..LAYER
    },
    Layer {
        cards: 70,
        spans: 7,
        height: 0.0075,
        width: 0.014,
        open: [0.85, 1.0],
        weave: Weave::Loose,
        ..LAYER
    },
    Layer {
        cards: 130,
        spans: 3,
        height: 0.0023,
        width: 0.008,
        open: [0.75, 0.95],
        length: 0.4,
        longest: 0.035,
        roots: Where::Hairline,
        weave: Weave::Wisp,
    },
];

pub(super) struct Bun {
    seed: u64,
}

impl Bun {
    pub(super) fn new(p: &HairParams) -> Self {
        Self { seed: p.seed }
    }
}

impl Cut for Bun {
    fn layers(&self) -> &[Layer] {
        &LAYERS
    }

    fn locks(&self) -> Locks {
        Locks {
            count: 60,
            gather: 0.25,
            unruly: 0.05,
        }
    }

    fn comb(&self, at: DVec3) -> DVec3 {
        let d = (KNOT - at).normalize_or_zero();
        // Over the ears hair first rises.
        d + DVec3::Y * (0.5 * slope(0.055, 0.02, at.y) * slope(-0.06, 0.0, at.z))
    }

    fn lift(&self, _at: DVec3) -> f64 {
        0.15
    }

    fn bend(&self, at: DVec3, _root: DVec3, _t: f64) -> DVec3 {
        (KNOT - at).normalize_or_zero() * 0.8
    }

    fn length(&self, root: DVec3) -> f64 {
        // Around the head it is longer than straight.
        (root.distance(KNOT) * 1.25 - 0.010).clamp(0.015, 0.28)
    }

    fn cling(&self, _at: DVec3) -> f64 {
        0.5
    }

    fn extra(&self) -> Vec<Coil> {
        // Bands wound round a ball, each about an axis of its own.
        (0..54)
            .map(|i| {
                let dice = |k: u64| raconteur_base::noise::signed(self.seed, 300 + k, i);
                let axis = DVec3::new(0.5 * dice(1), 0.7 * dice(2), -1.0).normalize();
                let a = axis.any_orthonormal_vector();
                let b = axis.cross(a);
                let start = core::f64::consts::PI * dice(3);
                let off = 0.85 * dice(4);
                let ring = (1.0 - off * off).sqrt();
                let (curve, normals) = (0..=8)
                    .map(|k| {
                        let (s, c) = ops::sincos(start + 0.36 * f64::from(k));
                        let n = (a * c + b * s) * ring + axis * off;
                        let squash = DVec3::new(1.0, 1.0, 0.82);
                        (KNOT + n * squash * (RADIUS * (1.0 + 0.06 * dice(5))), n)
                    })
                    .unzip();
                Coil {
                    curve,
                    normals,
                    width: 0.015,
                }
            })
            .collect()
    }
}
