//! Motion profiles: the share of a path covered at a share of its time (GEVH 3.5.1).
//!
//! A *piecewise* profile is a list of keys, each with the profile of the path to it. A
//! *hierarchical* one passes the value of one profile to another as its share of time. Either may
//! overshoot: beyond its ends a profile continues with its end slope, so that hierarchies of
//! overshooting profiles stay continuous.

use crate::curve::{hermite, minimum_jerk};
use crate::ops;

/// Motion profile between two keys: share of the distance covered at a share of the time (GEVH
/// 3.5.1).
///
/// # Examples
///
/// ```
/// use raconteur_base::profile::Profile;
///
/// let profile = Profile::default();
/// assert_eq!(profile.sample(0.5), 0.5, "half of the way at half of the time");
/// assert!(profile.sample(0.1) < 0.1, "the movement starts slowly");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Profile {
    /// Minimum jerk ([`minimum_jerk`]), the profile of human hand movements.
    #[default]
    MinimumJerk,
    /// Constant speed.
    Linear,
    /// Half a period of a cosine; zero speed at both ends.
    Cosine,
    /// A cubic Bézier curve from (0, 0) to (1, 1) with the control points (x1, y1) and (x2, y2): x
    /// is the share of time, clamped to 0..1, y that of the distance, which may overshoot.
    Bezier([f64; 4]),
    /// A cubic Hermite curve from 0 to 1 with a slope at its start and at its end, in shares of the
    /// distance per share of the time.
    Hermite([f64; 2]),
}

impl Profile {
    /// Returns the share of the distance at a share `s` of the time: 0 at 0 and 1 at 1.
    #[must_use]
    pub fn sample(&self, s: f64) -> f64 {
        let inside = s.clamp(0.0, 1.0);
        let way = match self {
            Self::MinimumJerk => minimum_jerk(inside),
            Self::Linear => inside,
            Self::Cosine => 0.5 - 0.5 * ops::cos(core::f64::consts::PI * inside),
            Self::Bezier([x1, y1, x2, y2]) => {
                let (x1, x2) = (x1.clamp(0.0, 1.0), x2.clamp(0.0, 1.0));
                bezier(*y1, *y2, parameter(x1, x2, inside))
            }
            Self::Hermite([from, to]) => hermite(0.0, *from, 1.0, *to, inside),
        };
        way + self.end_slope(s) * (s - inside)
    }

    /// Returns the slope of the nearer end for a share outside the curve.
    fn end_slope(&self, s: f64) -> f64 {
        let at_end = s > 0.5;
        match self {
            Self::MinimumJerk | Self::Cosine => 0.0,
            Self::Linear => 1.0,
            Self::Hermite(slopes) => slopes[usize::from(at_end)],
            Self::Bezier([x1, y1, x2, y2]) => {
                let (dx, dy) = if at_end {
                    (1.0 - x2.clamp(0.0, 1.0), 1.0 - y2)
                } else {
                    (x1.clamp(0.0, 1.0), *y1)
                };
                // A vertical end lasts no time, so its slope is zero.
                if dx > 1e-6 { dy / dx } else { 0.0 }
            }
        }
    }

    /// Returns the peak speed as a multiple of the mean: the greatest absolute slope.
    #[must_use]
    pub fn peak(&self) -> f64 {
        const STEPS: u32 = 64;
        let at = |i: u32| self.sample(f64::from(i) / f64::from(STEPS));
        (0..STEPS)
            .map(|i| (at(i + 1) - at(i)).abs() * f64::from(STEPS))
            .fold(0.0, f64::max)
    }
}

/// Returns one coordinate of a cubic Bézier curve from 0 to 1 at parameter `u`, with inner control
/// values `a` and `b`.
fn bezier(a: f64, b: f64, u: f64) -> f64 {
    let v = 1.0 - u;
    u * (3.0 * v * (v * a + u * b) + u * u)
}

/// Returns the parameter at which a monotonic Bézier curve with inner abscissae `a` and `b` in 0..1
/// has the abscissa `x`. By bisection: 48 steps leave 4e-15 for every curve.
fn parameter(a: f64, b: f64, x: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..48 {
        let middle = 0.5 * (low + high);
        if bezier(a, b, middle) < x {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Profile; 6] = [
        Profile::MinimumJerk,
        Profile::Linear,
        Profile::Cosine,
        Profile::Bezier([0.2, 0.0, 0.4, 1.3]),
        Profile::Hermite([0.0, 2.0]),
        Profile::Hermite([-1.5, -2.0]),
    ];

    #[test]
    fn every_profile_leads_from_0_to_1_without_a_jump() {
        for profile in ALL {
            assert!(profile.sample(0.0).abs() < 1e-12, "{profile:?}");
            assert!((profile.sample(1.0) - 1.0).abs() < 1e-12, "{profile:?}");
            let mut last = profile.sample(-0.5);
            for i in -499..1_500 {
                let now = profile.sample(f64::from(i) * 1e-3);
                assert!((now - last).abs() < 4e-3, "{profile:?} at {i}");
                last = now;
            }
        }
    }

    #[test]
    fn a_bezier_curve_on_the_diagonal_is_linear() {
        let straight = Profile::Bezier([0.25, 0.25, 0.7, 0.7]);
        for i in 0..100 {
            let s = f64::from(i) * 0.01;
            assert!(
                (straight.sample(s) - s).abs() < 1e-12,
                "the Bézier curve on the diagonal is linear"
            );
        }
    }

    #[test]
    fn curves_decelerate_and_overshoot() {
        // Most of the path is covered early; the approach to the goal is slow.
        let decelerating = Profile::Hermite([3.0, 0.0]);
        assert!(
            decelerating.sample(0.5) > 0.8,
            "the decelerating curve is past 0.8 at its middle"
        );
        // Arriving from beyond: a negative slope at the end.
        let overshooting = Profile::Hermite([0.0, -2.0]);
        let most = (0..=100)
            .map(|i| overshooting.sample(f64::from(i) * 0.01))
            .fold(0.0, f64::max);
        assert!((1.1..1.5).contains(&most), "{most}");
    }

    #[test]
    fn peaks_are_those_of_the_curves() {
        assert!(
            (Profile::MinimumJerk.peak() - 1.875).abs() < 0.01,
            "the peak speed of the minimum-jerk profile"
        );
        assert!(
            (Profile::Linear.peak() - 1.0).abs() < 1e-9,
            "the peak speed of the linear profile"
        );
        assert!(
            (Profile::Cosine.peak() - core::f64::consts::FRAC_PI_2).abs() < 0.01,
            "the peak speed of the cosine profile"
        );
    }
}
