//! Body of a garment's wearer.

use super::neck::Neck;
use crate::torso::{BodyParams, Cage, Field, Joints};

/// A body with everything that tailoring needs to know of it.
#[derive(Clone, Copy, Debug)]
pub struct Wearer<'a> {
    /// Its distance field.
    pub field: &'a Field,
    /// The cage wrapped on it.
    pub cage: &'a Cage,
    /// Its joints.
    pub joints: &'a Joints,
    /// Skin under the collar.
    pub neck: &'a Neck,
    /// Standing height, metres.
    pub stature_m: f64,
    /// Size of cuts and folds against a body of 175 cm.
    pub scale: f64,
}

impl<'a> Wearer<'a> {
    /// The wearer of a body's measures.
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
