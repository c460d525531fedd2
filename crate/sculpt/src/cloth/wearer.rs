//! Body of a garment's wearer.

use super::neck::Neck;
use crate::torso::{BodyParams, Cage, Field, Joints};

/// Body for which garments are tailored, with its distance field, cage, joints and measures.
#[derive(Clone, Copy, Debug)]
pub struct Wearer<'a> {
    /// Distance field of the body, from which cloth keeps clear.
    pub field: &'a Field,
    /// The cage wrapped on it.
    pub cage: &'a Cage,
    /// Positions and orientations of the bones in the rest pose.
    pub joints: &'a Joints,
    /// Skin under the collar.
    pub neck: &'a Neck,
    /// Standing height, metres.
    pub stature_m: f64,
    /// Size of cuts and folds against a body of 175 cm.
    pub scale: f64,
}

impl<'a> Wearer<'a> {
    /// Creates the wearer from the measures of a body and its surfaces.
    #[must_use]
    pub fn new(
        body: &BodyParams,
        field: &'a Field,
        cage: &'a Cage,
        joints: &'a Joints,
        neck: &'a Neck,
    ) -> Self {
        Self {
            field,
            cage,
            joints,
            neck,
            stature_m: body.stature_m,
            scale: body.stature_m / 1.75,
        }
    }
}
