//! Path of a wrist between two positions.

use raconteur_base::curve::minimum_jerk;
use raconteur_base::{DVec3, Length, ops};

/// Abscissae and weights of Gauss and Legendre's quadrature with five points on [0, 1].
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_5),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_2),
    (0.5, 0.284_444_444_444_444_4),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_2),
    (0.953_089_922_969_332, 0.118_463_442_528_094_5),
];

/// Path of a free wrist movement from its start: `along` with a parabolic bulge of `arch` in the
/// middle; metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArcPath {
    /// Displacement from start to end, metres.
    pub(super) along: DVec3,
    /// Displacement of the middle.
    pub(super) arch: DVec3,
}

impl ArcPath {
    /// Returns the position at a parameter 0..1, from the start.
    pub(super) fn place(&self, u: f64) -> DVec3 {
        self.along * u + self.arch * (4.0 * u * (1.0 - u))
    }

    fn slope(&self, u: f64) -> f64 {
        (self.along + self.arch * (4.0 - 8.0 * u)).magnitude()
    }

    /// Returns the path length up to a parameter.
    fn length(&self, u: f64) -> f64 {
        let between = |a: f64, b: f64| {
            let parts = GAUSS.iter().map(|(x, w)| w * self.slope(a + (b - a) * x));
            (b - a) * parts.sum::<f64>()
        };
        // A high bow turns sharply in its middle, which no one piece follows well.
        if u <= 0.5 {
            between(0.0, u)
        } else {
            between(0.0, 0.5) + between(0.5, u)
        }
    }

    /// Returns the position after a share of the path length. Movements follow the speed of a
    /// profile along their curved path, whatever its curvature.
    pub(super) fn after(&self, share: f64) -> DVec3 {
        let whole = self.length(1.0);
        let mut u = share;
        if self.arch != DVec3::ZERO && whole > 0.0 {
            // Newton's steps; a parabola's length is nearly straight in its parameter.
            for _ in 0..4 {
                let slope = self.slope(u).max(1e-3 * whole);
                u = (u - (self.length(u) - share * whole) / slope).clamp(0.0, 1.0);
            }
        }
        self.place(u)
    }
}

/// Returns the displacement from the start, metres, at share `s` of a movement with given start and
/// end velocities, m/s: a minimum-jerk quintic plus a bulge of `arch`. `secs` is its duration.
pub(super) fn flowing(bow: &ArcPath, velocities: [DVec3; 2], secs: f64, s: f64) -> DVec3 {
    bow.along * minimum_jerk(s)
        + velocities[0] * (secs * start_slope(s))
        + velocities[1] * (secs * end_slope(s))
        + bow.arch * arch(s)
}

/// Returns the minimum-jerk quintic for an initial velocity: no displacement at either end, slope 1
/// at the start and 0 at the end, no acceleration at either.
fn start_slope(s: f64) -> f64 {
    s - s * s * s * (6.0 - s * (8.0 - 3.0 * s))
}

/// Returns the minimum-jerk quintic for a final velocity: no displacement at either end, slope 0 at
/// the start and 1 at the end, no acceleration at either.
fn end_slope(s: f64) -> f64 {
    -s * s * s * (4.0 - s * (7.0 - 3.0 * s))
}

/// Returns a bump of height 1 with zero speed and acceleration at its ends, `s` 0 and 1.
fn arch(s: f64) -> f64 {
    let u = 4.0 * s * (1.0 - s);
    u * u * u
}

/// Returns the duration of a hand movement of this length, seconds: Fitts's law (1954,
/// doi:10.1037/h0055392) with a target width of 5 cm; slope and limits designed.
pub(super) fn reach_secs(distance_m: f64) -> f64 {
    (0.21 + 0.13 * ops::ln(1.0 + distance_m / 0.05) / core::f64::consts::LN_2).clamp(0.28, 0.8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bows_are_passed_at_the_speed_of_the_profile() {
        for height in [0.0, 0.05, 0.2, 0.5] {
            let bow = ArcPath {
                along: DVec3::new(0.5, 0.1, 0.0),
                arch: DVec3::new(0.0, height, 0.3 * height),
            };
            let n = 200;
            let step = |i: u32| {
                let at = |i: u32| bow.after(f64::from(i) / f64::from(n));
                at(i).distance(at(i + 1)) * f64::from(n)
            };
            let speeds: Vec<f64> = (0..n).map(step).collect();
            let mean = speeds.iter().sum::<f64>() / speeds.len() as f64;
            let worst = speeds.iter().map(|v| (v / mean - 1.0).abs());
            assert!(worst.fold(0.0, f64::max) < 0.03, "{height}");
            assert!(
                bow.after(0.0).length() < 1e-9,
                "the bow starts at its first point"
            );
            assert!(
                bow.after(1.0).distance(bow.along) < 1e-9,
                "the bow ends at its last point"
            );
        }
    }

    #[test]
    fn flowing_movements_meet_their_velocities() {
        let bow = ArcPath {
            along: DVec3::X,
            arch: DVec3::Y,
        };
        let v = [DVec3::Z, DVec3::NEG_Y];
        let h = 1e-5;
        let at = |s| flowing(&bow, v, 2.0, s);
        assert!(
            ((at(h) - at(0.0)) / (2.0 * h)).distance(v[0]) < 1e-3,
            "the initial velocity of the flow"
        );
        assert!(
            ((at(1.0) - at(1.0 - h)) / (2.0 * h)).distance(v[1]) < 1e-3,
            "the final velocity of the flow"
        );
        assert!(
            at(1.0).distance(DVec3::X) < 1e-12,
            "the flow ends at its target"
        );
    }
}
