//! Vector lengths by the language's square root.
//!
//! IEEE 754 rounds a square root identically everywhere, so the language's own is safe, and in wasm
//! it is one instruction. `glam` is built with `libm` for its trigonometry and then also takes
//! roots from there, where they are computed in software: a quarter of the time of a tick. Code
//! that runs in a tick uses these instead of `length()`, `distance()` and `normalize()`; the bits
//! are the same.

use core::ops::{Mul, Sub};

use glam::{DQuat, DVec3};

/// Euclidean length of vectors and quaternions, by the language's own square root, which rounds the
/// same everywhere.
pub trait Length: Copy + Mul<f64, Output = Self> + Sub<Output = Self> {
    /// Returns the squared length.
    #[must_use]
    fn squared(self) -> f64;

    /// Returns the length, in the unit of the components.
    #[inline]
    #[must_use]
    fn magnitude(self) -> f64 {
        self.squared().sqrt()
    }

    /// Returns the distance to another one, in the unit of the components.
    #[inline]
    #[must_use]
    fn distance_to(self, other: Self) -> f64 {
        (self - other).magnitude()
    }

    /// Returns the vector or quaternion scaled to length 1; not finite for length 0.
    #[inline]
    #[must_use]
    fn normalized(self) -> Self {
        self * self.magnitude().recip()
    }

    /// Returns the same direction with length 1; `None` for a length whose reciprocal is not finite
    /// and positive.
    #[inline]
    #[must_use]
    fn try_normalized(self) -> Option<Self> {
        let scale = self.magnitude().recip();
        (scale.is_finite() && scale > 0.0).then(|| self * scale)
    }
}

impl Length for DVec3 {
    #[inline]
    fn squared(self) -> f64 {
        self.dot(self)
    }
}

impl Length for DQuat {
    #[inline]
    fn squared(self) -> f64 {
        self.dot(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise;

    #[test]
    fn they_are_those_of_glam_to_the_bit() {
        let component = |seed: u64, i: i64| {
            let magnitude = crate::ops::exp(40.0 * noise::unit(seed, 2, i) - 20.0);
            (noise::unit(seed, 1, i) - 0.5) * magnitude
        };
        for i in 0..10_000 {
            let [x, y, z, w] = [0, 1, 2, 3].map(|k| component(k, i));
            let (v, q) = (DVec3::new(x, y, z), DQuat::from_xyzw(x, y, z, w));
            assert_eq!(v.magnitude().to_bits(), v.length().to_bits());
            assert_eq!(v.normalized(), v.normalize());
            assert_eq!(q.magnitude().to_bits(), q.length().to_bits());
            assert_eq!(q.normalized(), q.normalize());
            assert_eq!(v.try_normalized(), v.try_normalize());
            assert_eq!(v.distance_to(q.xyz() * w), v.distance(q.xyz() * w));
        }
        for v in [
            DVec3::ZERO,
            DVec3::INFINITY,
            DVec3::splat(f64::NAN),
            DVec3::splat(1e-320),
        ] {
            assert_eq!(v.try_normalized(), v.try_normalize());
        }
    }
}
