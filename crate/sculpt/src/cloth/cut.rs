//! Cut of a top, and its intermediate state.

use raconteur_base::{DVec3, Side, mirror_vector};

use super::finish::Fabric;
use super::sheet::Sheet;

/// Cut of a top garment, such as a sweater; centimetres on a body of 175 cm unless stated
/// otherwise.
#[derive(Clone, Copy, Debug)]
pub struct TopCut {
    /// Name of its parts.
    pub name: &'static str,
    /// Cloth of the body and sleeves.
    pub fabric: Fabric,
    /// Positions of hem and neckline, shares of an adult's stature.
    pub reach: [f64; 2],
    /// Straightness of the fall from chest to hip, 0..1.
    pub straight: f64,
    /// Distance from the body at yoke and waist.
    pub ease_cm: [f64; 2],
    /// Distance from the arm below the sleeve's cap.
    pub sleeve_ease_cm: f64,
    /// Excess of the sleeve's length, share.
    pub slack: f64,
    /// Height of its folds against those of a fine sweater.
    pub gather: f64,
    /// Thickness of the garment below it, above and below the waist.
    pub over_cm: [f64; 2],
    /// True if the cloth is taut over the chest, like a knit; wide cuts hang.
    pub is_taut: bool,
    /// Seed of its folds.
    pub seed: u64,
}

/// Draped top garment before its edges are finished.
#[derive(Clone, Debug)]
pub struct Top {
    /// Draped cloth of the garment.
    pub sheet: Sheet,
    /// Loop at the neck.
    pub neck: Vec<u32>,
    /// Loop at the bottom.
    pub hem: Vec<u32>,
    /// Loops at the wrists.
    pub cuffs: Vec<Vec<u32>>,
}

/// Zone of the cloth to which a fold applies: trunk or one sleeve.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum ClothZone {
    Trunk,
    Sleeve(Side),
}

pub(super) fn mirrored_to(side: Side, v: DVec3) -> DVec3 {
    if side == Side::Left {
        v
    } else {
        mirror_vector(v)
    }
}
