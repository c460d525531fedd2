//! Measures of an ear.

use raconteur_base::DVec3;

/// Shape of the ear; also a change of one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EarShape {
    /// Height against the mean of men and women.
    pub(crate) height: f64,
    /// Breadth against the mean of men and women.
    pub(crate) breadth: f64,
    /// How far the lobe hangs lower, mm.
    pub(crate) lobe_drop: f64,
    /// Angle to the side of the head, degrees.
    pub(crate) protrusion_deg: f64,
    /// Backward tilt, degrees.
    pub(crate) tilt_deg: f64,
    /// Shift of the whole ear, mm.
    pub(crate) shift: DVec3,
}

impl EarShape {
    /// No change.
    pub(crate) const NONE: Self = Self {
        height: 0.0,
        breadth: 0.0,
        lobe_drop: 0.0,
        protrusion_deg: 0.0,
        tilt_deg: 0.0,
        shift: DVec3::ZERO,
    };
    /// Mean of men and women.
    pub(crate) const MEAN: Self = Self {
        height: 1.0,
        breadth: 1.0,
        protrusion_deg: 19.0,
        tilt_deg: 10.0,
        ..Self::NONE
    };

    /// Changed by an amount of a form.
    pub(crate) fn plus(&self, change: &Self, amount: f64) -> Self {
        Self {
            height: self.height + change.height * amount,
            breadth: self.breadth + change.breadth * amount,
            lobe_drop: self.lobe_drop + change.lobe_drop * amount,
            protrusion_deg: self.protrusion_deg + change.protrusion_deg * amount,
            tilt_deg: self.tilt_deg + change.tilt_deg * amount,
            shift: self.shift + change.shift * amount,
        }
    }
}
