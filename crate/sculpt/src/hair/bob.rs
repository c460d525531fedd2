//! A bob and long hair: parted at the side, combed clear of the face, tucked behind the
//! ear on the parting's side.

use raconteur_base::curve::lerp;
use raconteur_base::{DVec3, ops};

use super::cut::{Cut, LAYER, Layer, Locks, Weave, Where, slope};
use super::{HairParams, HairStyle};
use crate::part::JointRef;
use raconteur_body::skeleton::{Bone, Drive};

const fn layer(cards: usize, height: f64, width: f64, open: [f64; 2], length: f64) -> Layer {
    Layer {
        cards,
        spans: 9,
        height,
        width,
        open,
        length,
        ..LAYER
    }
}

const LAYERS: [Layer; 7] = [
    layer(62, 0.0035, 0.032, [0.66, 0.70], 1.0),
    layer(106, 0.0075, 0.027, [0.76, 0.83], 1.0),
    layer(116, 0.0112, 0.023, [0.84, 0.95], 1.0),
    Layer {
        weave: Weave::Loose,
        ..layer(66, 0.0130, 0.018, [0.88, 1.0], 1.0)
    },
    // Fine hair along the hairline hides where the others begin.
    Layer {
        cards: 120,
        spans: 3,
        height: 0.0022,
        width: 0.010,
        open: [0.85, 0.95],
        length: 0.5,
        longest: 0.050,
        roots: Where::Hairline,
        weave: Weave::Loose,
    },
    // And fine hair along the parting.
    Layer {
        cards: 76,
        spans: 5,
        height: 0.0095,
        width: 0.010,
        open: [0.75, 0.95],
        length: 0.8,
        longest: 0.10,
        roots: Where::Parting,
        weave: Weave::Loose,
    },
    // A few hairs stand off.
    Layer {
        cards: 20,
        spans: 8,
        height: 0.0128,
        width: 0.008,
        open: [0.9, 1.0],
        length: 0.9,
        weave: Weave::Wisp,
        ..LAYER
    },
];

/// Parted hair down to a hem.
pub(super) struct Bob {
    parting_x: f64,
    wave: f64,
    length: f64,
    long: bool,
}

impl Bob {
    pub(super) fn new(p: &HairParams) -> Self {
        Self {
            parting_x: p.parting_x,
            wave: p.wave,
            length: p.length,
            long: p.style == HairStyle::Long,
        }
    }

    /// +1 on the left of the parting.
    fn side(&self, at: DVec3) -> f64 {
        if at.x < self.parting_x { -1.0 } else { 1.0 }
    }

    /// The parting's side is tucked behind the ear.
    fn tucked(&self, root: DVec3) -> bool {
        self.side(root) * self.parting_x >= 0.0
    }
}

impl Cut for Bob {
    fn layers(&self) -> &[Layer] {
        &LAYERS
    }

    fn locks(&self) -> Locks {
        Locks {
            count: 64,
            gather: 0.42,
            unruly: 0.10,
        }
    }

    fn parting(&self, at: DVec3) -> f64 {
        let off = (at.x - self.parting_x) / 0.009;
        let line = ops::exp(-off * off) * slope(-0.06, -0.02, at.z);
        // Hair parts to all sides at the crown.
        let crown = at.distance(DVec3::new(0.5 * self.parting_x, 0.11, -0.055)) / 0.028;
        line.max(0.6 * ops::exp(-crown * crown)) * slope(0.055, 0.07, at.y)
    }

    fn comb(&self, at: DVec3) -> DVec3 {
        let side = self.side(at);
        let top = slope(0.055, 0.105, at.y);
        let front = slope(0.0, 0.06, at.z);
        let back = slope(-0.02, -0.07, at.z);
        // The parting ends at the crown, behind which hair falls to all sides.
        let crown = slope(-0.015, -0.05, at.z);
        let aside = lerp(side * (0.15 + top), at.x / 0.06, crown);
        let tucked = self.tucked(at);
        let rear = if tucked {
            0.35 + 0.95 * front
        } else {
            0.2 + 0.62 * front
        };
        DVec3::new(aside, -0.75 + 0.5 * top, -rear * (1.0 - back) - 0.5 * back)
    }

    fn lift(&self, at: DVec3) -> f64 {
        let top = slope(0.05, 0.10, at.y);
        let off = (at.x - self.parting_x).abs();
        0.08 + 0.30 * top * ops::exp(-off / 0.020)
    }

    fn bend(&self, at: DVec3, root: DVec3, _t: f64) -> DVec3 {
        let falls = lerp(0.16, 0.42, slope(0.11, 0.03, at.y));
        let mut d = DVec3::NEG_Y * falls;
        let below = slope(0.085, 0.03, at.y);
        if self.tucked(root) {
            // Over the ear's top to behind it.
            let limit = lerp(0.052, -0.036, slope(0.095, 0.035, at.y));
            d.z -= 1.1 * slope(0.0, 0.03, at.z - limit);
            // Behind the ear it falls freely.
            if at.z < -0.02 && at.y < 0.03 {
                d.y -= 0.5;
                d.z += 0.12;
            }
        } else {
            // Beside the face, never before it.
            let limit = lerp(0.050, 0.038, slope(0.07, -0.02, at.y));
            let before = slope(0.0, 0.025, at.z - limit) * slope(0.105, 0.075, at.y);
            let out = self.side(root);
            d += DVec3::new(0.55 * out, 0.10, -0.75) * before;
            d.z -= 0.25 * below * slope(0.0, 0.02, at.z - limit);
        }
        // The ends turn in to the neck.
        if !self.long {
            let turn = 0.25 * slope(0.0, -0.05, at.y) + 0.4 * slope(-0.05, -0.09, at.y);
            let out = DVec3::new(at.x, 0.0, at.z + 0.012).normalize_or_zero();
            d -= out * turn;
        }
        d
    }

    fn length(&self, _root: DVec3) -> f64 {
        if self.long { 0.44 } else { 0.30 }
    }

    fn hem(&self, root: DVec3, at: DVec3) -> Option<f64> {
        // Shorter behind; each lock has a length of its own, and what lies outside is
        // layered over what lies below.
        let front = slope(-0.06, 0.03, at.z);
        let lock = 0.008 * ops::sin(root.x * 410.0 + root.z * 170.0)
            + 0.006 * ops::sin(root.z * 530.0 - root.y * 260.0);
        let graded = 0.10 * (root.y - 0.04).max(0.0);
        let hem = if self.long {
            -0.215 + 1.4 * graded
        } else {
            lerp(-0.084, -0.097, front) + graded
        };
        Some(0.02 + (hem - 0.02) * self.length + lock)
    }

    fn over_ear(&self, root: DVec3) -> bool {
        !self.tucked(root)
    }

    fn volume(&self, at: DVec3) -> f64 {
        let crown =
            ops::exp(-((at.z + 0.05) / 0.06) * ((at.z + 0.05) / 0.06)) * slope(0.02, 0.09, at.y);
        1.0 + 0.3 * crown + 0.15 * slope(0.06, 0.11, at.y)
    }

    fn cling(&self, at: DVec3) -> f64 {
        0.45 * slope(-0.03, 0.03, at.y)
    }

    fn wave(&self) -> f64 {
        self.wave
    }

    /// The ends stay behind a little when the head turns; long hair lies on the shoulders.
    fn hang(&self, at: DVec3) -> Vec<(JointRef, f64)> {
        let bone = |b| JointRef(Drive::Bone(b));
        let neck = slope(-0.04, -0.11, at.y) * if self.long { 0.5 } else { 0.28 };
        let trunk = if self.long {
            slope(-0.11, -0.2, at.y)
        } else {
            0.0
        };
        vec![
            (bone(Bone::Skull), (1.0 - neck) * (1.0 - trunk)),
            (bone(Bone::Cervical), neck * (1.0 - trunk)),
            (bone(Bone::Thoracic), trunk),
        ]
    }
}
