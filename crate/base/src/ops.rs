//! Transcendental functions through `libm`.
//!
//! The standard library calls the platform's functions, whose last bits differ between systems;
//! clippy forbids them in the workspace.

pub use libm::{acos, asin, atan, atan2, cbrt, cos, exp, hypot, log as ln, pow, sin, sincos, tan};

/// Returns `acos` of `x` clamped to [−1, 1], radians; rounding errors do not give NaN.
#[must_use]
pub fn acos_clamped(x: f64) -> f64 {
    acos(x.clamp(-1.0, 1.0))
}

/// Returns `asin` of `x` clamped to [−1, 1], radians.
#[must_use]
pub fn asin_clamped(x: f64) -> f64 {
    asin(x.clamp(-1.0, 1.0))
}

/// Returns the equivalent of an angle in (−π, π].
#[must_use]
pub fn wrap_angle(angle_rad: f64) -> f64 {
    use core::f64::consts::{PI, TAU};
    // Nearly all angles are already within the range, and a remainder is slow.
    if angle_rad > -PI && angle_rad <= PI {
        return angle_rad;
    }
    let turned = angle_rad % TAU;
    if turned > PI {
        turned - TAU
    } else if turned <= -PI {
        turned + TAU
    } else {
        turned
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    #[test]
    fn wrapped_angles_stay_in_one_turn_and_keep_their_direction() {
        for i in -40..=40 {
            let a = f64::from(i) * 0.37;
            let w = wrap_angle(a);
            assert!(w > -PI - 1e-12 && w <= PI + 1e-12, "{a} -> {w}");
            assert!(
                (cos(a) - cos(w)).abs() < 1e-12 && (sin(a) - sin(w)).abs() < 1e-12,
                "the wrapped angle has the same direction"
            );
        }
    }

    #[test]
    fn clamped_inverses_survive_rounding() {
        assert_eq!(acos_clamped(1.0 + 1e-9), 0.0);
        assert!(
            (asin_clamped(-1.5) + PI / 2.0).abs() < 1e-15,
            "asin of less than -1 is clamped"
        );
    }
}
