//! Affine changes of segments.

use raconteur_base::ops;

/// Affine change of a face segment (F&H 5.1.3): about its centre it is scaled, then rotated, then
/// moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    /// Factors along x, y and z.
    pub scale: [f64; 3],
    /// Turn about x, y and z in this order, radians.
    pub turn_rad: [f64; 3],
    /// Translation along x, y and z, metres.
    pub translation_m: [f64; 3],
}

impl Affine {
    /// Identity: no scaling, rotation or translation.
    pub const NONE: Self = Self {
        scale: [1.0; 3],
        turn_rad: [0.0; 3],
        translation_m: [0.0; 3],
    };

    pub(super) fn apply(&self, p: [f64; 3], middle: [f64; 3]) -> [f64; 3] {
        let mut q: [f64; 3] = core::array::from_fn(|i| (p[i] - middle[i]) * self.scale[i]);
        for (axis, angle) in self.turn_rad.into_iter().enumerate() {
            let (sin, cos) = ops::sincos(angle);
            let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
            (q[a], q[b]) = (q[a] * cos - q[b] * sin, q[a] * sin + q[b] * cos);
        }
        core::array::from_fn(|i| q[i] + middle[i] + self.translation_m[i])
    }
}
