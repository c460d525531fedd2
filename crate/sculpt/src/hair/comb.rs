//! Combing field: the direction of hair by its root.

use raconteur_base::curve::{lerp, ramp};
use raconteur_base::{DVec3, ops};

use super::HairParams;
use super::line::angles;
use super::style::{Comb, Style};
use crate::texture::space_noise;

/// Smooth step: returns 0 at `from` and before, 1 at `to` and beyond; `from` may be greater than
/// `to`.
pub(super) fn step(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Returns a vector of three independent noise values at a position; `pace` is the frequency, cells
/// per metre.
pub(super) fn stray(seed: u64, p: DVec3, pace: f64) -> DVec3 {
    let q = p * pace;
    DVec3::new(
        space_noise(seed, q),
        space_noise(seed + 1, q),
        space_noise(seed + 2, q),
    )
}

/// Combing field of a head of hair: gives the direction of a hair by the position of its root.
pub(super) struct Field {
    comb: Comb,
    /// Position of the parting's start, to the left.
    parting: f64,
    pub(super) crown: DVec3,
    seed: u64,
}

impl Field {
    pub(super) fn new(p: &HairParams, style: &Style) -> Self {
        Self {
            comb: style.comb,
            parting: p.parting_x,
            crown: match style.comb {
                Comb::Whorl => DVec3::new(-0.012, 0.078, -0.050),
                _ => DVec3::new(0.33 * p.parting_x, 0.075, -0.045),
            },
            seed: p.seed,
        }
    }

    /// Returns the x of the parting at a depth, slightly irregular.
    fn parting_at(&self, z: f64) -> f64 {
        lerp(self.crown.x, self.parting, step(self.crown.z, 0.05, z)) + 0.0007 * ops::sin(110.0 * z)
    }

    /// Returns the distance from the parting, metres; behind the crown, the distance from the
    /// crown; a large value if there is no parting.
    pub(super) fn off_parting(&self, p: DVec3) -> f64 {
        if !matches!(self.comb, Comb::Parted) {
            return 1.0;
        }
        if p.z > self.crown.z {
            (p.x - self.parting_at(p.z)).abs()
        } else {
            (p - self.crown).with_y(0.0).length()
        }
    }

    /// Returns the preferred direction at `at`, `arc` metres from the root; not normalised, not
    /// tangent to the skin.
    pub(super) fn direction(&self, root: DVec3, at: DVec3, arc: f64) -> DVec3 {
        match self.comb {
            Comb::Parted => self.parted(root, arc),
            Comb::Combed {
                top,
                side,
                back,
                stray: share,
            } => {
                let (_, elevation) = angles(root);
                let up = step(22.0, 52.0, elevation);
                let behind = step(-0.02, -0.07, root.z);
                let turn = if self.parting < 0.0 { -1.0 } else { 1.0 };
                let top = DVec3::new(top.x * turn, top.y, top.z);
                side.lerp(back, behind).lerp(top, up)
                    + stray(self.seed + 3, root, 70.0) * share
                    + stray(self.seed + 31, at, 160.0) * (0.75 * share)
            }
            Comb::Whorl => self.whorl(root, at),
            Comb::Tied(tie) => {
                let to = tie - at;
                // Hair below the tie goes up to it around the back, not over the cheek.
                to + stray(self.seed + 3, root, 45.0) * (0.12 * to.length())
            }
            Comb::Coily => stray(self.seed + 3, at, 90.0) + DVec3::splat(1e-3),
        }
    }

    fn parted(&self, root: DVec3, arc: f64) -> DVec3 {
        let side = if root.x < self.parting_at(root.z) {
            -1.0
        } else {
            1.0
        };
        let back = step(self.crown.z + 0.02, self.crown.z - 0.02, root.z);
        let front = step(0.02, 0.08, root.z);
        let radial = (root - self.crown).with_y(0.0).normalize_or(DVec3::NEG_Z);
        let rear = -0.20 - 0.10 * front * step(0.0, 0.09, arc) - 0.1 * (1.0 - front)
            + 0.18 * space_noise(self.seed + 11, root * 45.0);
        let aside = DVec3::new(side, -0.35 * step(0.0, 0.05, arc), rear);
        let low = step(0.045, -0.005, root.y);
        let aside = aside * (1.0 - 0.75 * low) + DVec3::new(0.0, -1.0, -0.12) * low;
        aside * (1.0 - back) + (radial + DVec3::new(0.0, -0.5, 0.0)) * back
    }

    fn whorl(&self, root: DVec3, at: DVec3) -> DVec3 {
        let radial = (root - self.crown).with_y(0.0).normalize_or(DVec3::Z);
        let turned = DVec3::new(-radial.z, 0.0, radial.x);
        let (_, elevation) = angles(root);
        let front = step(0.01, 0.07, root.z);
        let mut d = radial
            + turned * 0.35
            + DVec3::new(-0.75, 0.0, 0.12) * front
            + stray(self.seed + 51, root, 38.0) * 0.62
            + stray(self.seed + 61, root, 110.0) * 0.35;
        d.y -= 0.25 + 0.9 * (1.0 - step(10.0, 50.0, elevation));
        d.normalize_or(DVec3::NEG_Y) + stray(self.seed + 71, at, 60.0) * 0.25
    }

    /// Returns the share of gravity in the direction of a hair, `arc` metres from its root.
    pub(super) fn gravity(&self, arc: f64) -> f64 {
        match self.comb {
            Comb::Parted => (0.06 + 0.9 * step(0.03, 0.13, arc)).min(1.0),
            Comb::Combed { .. } => (0.03 + 2.0 * arc).min(0.3),
            Comb::Whorl => (0.08 + 3.5 * arc).min(0.6),
            Comb::Tied(_) | Comb::Coily => 0.02 * ramp(0.0, 0.1, arc),
        }
    }
}
