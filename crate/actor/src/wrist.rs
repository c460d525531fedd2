//! What a wrist and forearm can do: their limits, what strains them, and a hand rotation
//! as the forearm sees it.
//!
//! A wrist rotation is a twist about the forearm's x axis, which is the forearm's pronation,
//! and then a swing: the radius takes the axes of flexion and deviation along as it turns.

use core::f64::consts::PI;

use raconteur_base::curve::smooth;
use raconteur_base::{DQuat, DVec3, Length, Side, ops};
use raconteur_body::skeleton::twist_about_x;

use crate::manipulator::limits::{WRIST_DEVIATION_DEG, WRIST_FLEXION_DEG};

/// Pronation and supination from the thumb-up middle position, degrees (80 is the
/// clinical norm for both, AAOS 1965). GEVH prints −125.8..26.1 without its zero; read
/// from full supination it would forbid a palm held down at the waist.
const FOREARM_TWIST_DEG: [f64; 2] = [80.0, 90.0];
/// Share of a limit up to which a joint follows exactly; beyond, it approaches the limit.
const FREE_SHARE: f64 = 0.9;

/// A hand rotation as the forearm sees it, for moving between hand rotations that lie far
/// apart the way a wrist does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WristAngles {
    /// Pronation from the thumb-up middle, radians, −π..π.
    pub pronation_rad: f64,
    /// Rest of the rotation: axis times angle about y and z of the turned forearm, radians.
    pub(crate) swing: DVec3,
}

impl WristAngles {
    /// A relaxed hand: some pronation and a little extension, neither blade nor tray.
    #[must_use]
    pub fn relaxed(side: Side) -> Self {
        Self {
            pronation_rad: 0.45,
            swing: DVec3::new(0.0, 0.2 * side.sign(), 0.0),
        }
    }

    /// The angles of a wrist rotation, local to the forearm.
    #[must_use]
    pub fn of(side: Side, local: DQuat) -> Self {
        let twist = twist_about_x(local);
        let swing = (twist.inverse() * local).normalized();
        Self {
            // A positive turn about x pronates on the left (y front towards z down).
            pronation_rad: side.sign() * 2.0 * ops::atan2(twist.x, twist.w),
            swing: rotation_vector(if swing.w < 0.0 { -swing } else { swing }),
        }
    }

    /// The wrist rotation with these angles, local to the forearm.
    #[must_use]
    pub fn rotation(&self, side: Side) -> DQuat {
        let twist = DQuat::from_rotation_x(side.sign() * self.pronation_rad);
        (twist * DQuat::from_scaled_axis(self.swing)).normalized()
    }

    /// Linear interpolation: pronation never goes the long way round.
    #[must_use]
    pub fn lerp(&self, to: &Self, s: f64) -> Self {
        Self {
            pronation_rad: self.pronation_rad + (to.pronation_rad - self.pronation_rad) * s,
            swing: self.swing.lerp(to.swing, s),
        }
    }
}

/// Discomfort of a wrist rotation: grows beyond the range that is used without
/// thinking, and levels off towards the far side of the circle, where going either way
/// is as bad.
pub(crate) fn strain(side: Side, local: DQuat) -> f64 {
    let angles = WristAngles::of(side, local);
    let beyond = |x: f64, free: f64| smooth((x.abs() - free) / (PI - free));
    4.0 * beyond(angles.pronation_rad, 0.9)
        + 3.0 * beyond(angles.swing.y, 0.6)
        + 4.0 * beyond(angles.swing.z, 0.25)
}

/// `x` limited to [−`low`, `high`]: exact up to [`FREE_SHARE`] of a limit, then
/// approaching it.
fn soft_limit(x: f64, low: f64, high: f64) -> f64 {
    let limit = if x < 0.0 { low } else { high };
    let (free, rest) = (FREE_SHARE * limit, (1.0 - FREE_SHARE) * limit);
    let over = x.abs() - free;
    if over <= 0.0 {
        x
    } else {
        x.signum() * (free + rest * over / (over + rest))
    }
}

/// The nearest rotation that a wrist can make. On the circle of twists the limit gives way
/// towards the far side, so that no path of orientations makes the forearm snap.
pub(crate) fn limited(side: Side, local: DQuat) -> DQuat {
    let WristAngles {
        pronation_rad,
        swing,
    } = WristAngles::of(side, local);
    let [most_pronation, most_supination] = FOREARM_TWIST_DEG.map(f64::to_radians);
    let give_way = 1.0 - smooth((pronation_rad.abs() - 2.3) / (PI - 2.3));
    let pronation_rad = soft_limit(pronation_rad, most_supination, most_pronation) * give_way;

    let sign = side.sign();
    let [flexion, extension] = WRIST_FLEXION_DEG.map(f64::to_radians);
    let [ulnar, radial] = WRIST_DEVIATION_DEG.map(f64::to_radians);
    // Negative turns about y flex the left wrist; positive turns about z bend both to the
    // thumb's side.
    let y = sign * soft_limit(sign * swing.y, flexion, extension);
    let z = soft_limit(swing.z, ulnar, radial);
    WristAngles {
        pronation_rad,
        swing: DVec3::new(0.0, y, z),
    }
    .rotation(side)
}

/// How far a wrist rotation, local to the forearm, lies beyond what a wrist can do, radians;
/// 0 within.
#[must_use]
pub fn beyond_limits_rad(side: Side, local: DQuat) -> f64 {
    let angles = WristAngles::of(side, local);
    let beyond = |x: f64, [low, high]: [f64; 2]| {
        let (low, high) = (low.to_radians(), high.to_radians());
        (x - high).max(-low - x).max(0.0)
    };
    let [pronation, supination] = FOREARM_TWIST_DEG;
    beyond(angles.pronation_rad, [supination, pronation])
        .max(beyond(side.sign() * angles.swing.y, WRIST_FLEXION_DEG))
        .max(beyond(angles.swing.z, WRIST_DEVIATION_DEG))
}

/// Axis times angle of a rotation with w ≥ 0: the angle is at most π.
pub(crate) fn rotation_vector(q: DQuat) -> DVec3 {
    let v = DVec3::new(q.x, q.y, q.z);
    let length = v.magnitude();
    if length < 1e-12 {
        v * 2.0
    } else {
        v * (2.0 * ops::atan2(length, q.w) / length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::noise;

    fn random_rotation(i: i64) -> DQuat {
        let r = |k| noise::signed(4, k, i);
        DQuat::from_xyzw(r(0), r(1), r(2), r(3)).normalize()
    }

    #[test]
    fn wrists_stay_within_their_limits() {
        for side in Side::BOTH {
            for i in 0..5_000 {
                let limited = limited(side, random_rotation(i));
                assert!(beyond_limits_rad(side, limited) < 1e-9);
                let angles = WristAngles::of(side, limited);
                let pronation = angles.pronation_rad.to_degrees();
                assert!((-90.0..=80.0).contains(&pronation), "{pronation}");
                let swing = angles.swing.abs() * 1f64.to_degrees();
                assert!(swing.y <= 94.8 && swing.z <= 47.9, "{swing}");
            }
        }
    }

    #[test]
    fn angles_and_rotations_convert_both_ways() {
        for side in Side::BOTH {
            for i in 0..500 {
                let q = random_rotation(i);
                assert!(WristAngles::of(side, q).rotation(side).angle_between(q) < 1e-6);
            }
        }
    }

    #[test]
    fn what_is_easy_is_left_alone() {
        for side in Side::BOTH {
            let q = WristAngles::relaxed(side).rotation(side);
            assert!(limited(side, q).angle_between(q) < 1e-7);
        }
    }
}
