//! Range of wrist and forearm, and hand rotation in the frame of the forearm.
//!
//! A wrist rotation is a twist about the forearm's x axis, its pronation, followed by a swing: the
//! turning radius carries the axes of flexion and deviation along.

use core::f64::consts::PI;

use raconteur_base::curve::smooth;
use raconteur_base::{DQuat, DVec3, Length, Side, ops};
use raconteur_body::skeleton::twist_about_x;

use super::limits::Limit;

/// Share of a limit up to which a joint follows exactly; beyond, it approaches the limit.
const FREE_SHARE: f64 = 0.9;

/// Hand rotation relative to the forearm as pronation and swing; used to interpolate between
/// distant hand rotations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WristAngles {
    /// Pronation from the thumb-up middle, radians, −π..π.
    pub pronation_rad: f64,
    /// Rest of the rotation: axis times angle about y and z of the turned forearm, radians.
    pub(crate) swing: DVec3,
}

impl WristAngles {
    /// Returns the angles of a relaxed hand: some pronation and a little extension.
    #[must_use]
    pub fn relaxed(side: Side) -> Self {
        Self {
            pronation_rad: 0.45,
            swing: DVec3::new(0.0, 0.2 * side.sign(), 0.0),
        }
    }

    /// Returns the angles of a wrist rotation that is local to the forearm.
    #[must_use]
    pub fn from_local(side: Side, local: DQuat) -> Self {
        let twist = twist_about_x(local);
        let swing = (twist.inverse() * local).normalized();
        Self {
            // A positive turn about x pronates on the left (y front towards z down).
            pronation_rad: side.sign() * 2.0 * ops::atan2(twist.x, twist.w),
            swing: rotation_vector(if swing.w < 0.0 { -swing } else { swing }),
        }
    }

    /// Returns the wrist rotation with these angles, local to the forearm.
    #[must_use]
    pub fn rotation(&self, side: Side) -> DQuat {
        let twist = DQuat::from_rotation_x(side.sign() * self.pronation_rad);
        (twist * DQuat::from_scaled_axis(self.swing)).normalized()
    }

    /// Interpolates linearly; pronation never takes the long way round.
    #[must_use]
    pub fn lerp(&self, to: &Self, s: f64) -> Self {
        Self {
            pronation_rad: self.pronation_rad + (to.pronation_rad - self.pronation_rad) * s,
            swing: self.swing.lerp(to.swing, s),
        }
    }
}

/// Returns `x` softly limited to [−`low`, `high`]: unchanged up to [`FREE_SHARE`] of a limit, then
/// approaching it.
fn soft_limit(x: f64, [low, high]: [f64; 2]) -> f64 {
    let limit = if x < 0.0 { low } else { high };
    let (free, rest) = (FREE_SHARE * limit, (1.0 - FREE_SHARE) * limit);
    let over = x.abs() - free;
    if over <= 0.0 {
        x
    } else {
        x.signum() * (free + rest * over / (over + rest))
    }
}

/// Limits of one wrist and its forearm: pronation, flexion and deviation; hand rotations are
/// reduced to them.
#[derive(Clone, Copy, Debug)]
pub struct WristLimits {
    side: Side,
    /// Supination and pronation from the thumb-up middle, radians, both positive.
    twist_rad: [f64; 2],
    /// Flexion and extension.
    flexion_rad: [f64; 2],
    /// Limits of deviation, radians: towards the little finger and towards the thumb.
    deviation_rad: [f64; 2],
}

impl WristLimits {
    /// Returns the limits of the wrist of an arm whose seven joints (shoulder to hand) have these
    /// limits.
    #[must_use]
    pub fn new(side: Side, limits: &[Limit; 7]) -> Self {
        let [twist, deviation, flexion] = [3, 4, 5].map(|i: usize| limits[i]);
        Self {
            side,
            twist_rad: [-twist.min_rad, twist.max_rad],
            flexion_rad: [flexion.max_rad, -flexion.min_rad],
            deviation_rad: [-deviation.min_rad, deviation.max_rad],
        }
    }

    /// Returns the nearest rotation within the wrist's range. On the circle of twists the limit
    /// yields towards the far side, so no path of orientations makes the forearm snap.
    #[must_use]
    pub fn limited(&self, local: DQuat) -> DQuat {
        let WristAngles {
            pronation_rad,
            swing,
        } = WristAngles::from_local(self.side, local);
        let give_way = 1.0 - smooth((pronation_rad.abs() - 2.3) / (PI - 2.3));
        let pronation_rad = soft_limit(pronation_rad, self.twist_rad) * give_way;
        // Negative turns about y flex the left wrist; positive turns about z bend both to the
        // thumb's side.
        let sign = self.side.sign();
        let y = sign * soft_limit(sign * swing.y, self.flexion_rad);
        let z = soft_limit(swing.z, self.deviation_rad);
        WristAngles {
            pronation_rad,
            swing: DVec3::new(0.0, y, z),
        }
        .rotation(self.side)
    }

    /// Returns the amount by which a wrist rotation, local to the forearm, exceeds the wrist's
    /// range, radians; 0 within.
    #[must_use]
    pub fn beyond_rad(&self, local: DQuat) -> f64 {
        let angles = WristAngles::from_local(self.side, local);
        let beyond = |x: f64, [low, high]: [f64; 2]| (x - high).max(-low - x).max(0.0);
        beyond(angles.pronation_rad, self.twist_rad)
            .max(beyond(self.side.sign() * angles.swing.y, self.flexion_rad))
            .max(beyond(angles.swing.z, self.deviation_rad))
    }
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
    use crate::limb::Limb;
    use crate::limb::limits::{Sex, limits};
    use raconteur_base::noise;

    fn random_rotation(i: i64) -> DQuat {
        let r = |k| noise::signed(4, k, i);
        DQuat::from_xyzw(r(0), r(1), r(2), r(3)).normalize()
    }

    /// Returns left and right side, each with both sexes, for tests.
    fn all() -> [(Side, Sex); 4] {
        let on = |side| [Sex::Male, Sex::Female].map(|sex| (side, sex));
        let [[a, b], [c, d]] = Side::BOTH.map(on);
        [a, b, c, d]
    }

    fn wrist(side: Side, sex: Sex) -> WristLimits {
        let limb = [Limb::LeftArm, Limb::RightArm][side.index()];
        WristLimits::new(side, &limits(limb, sex))
    }

    #[test]
    fn wrists_stay_within_the_limits_of_their_figure() {
        for (side, sex) in all() {
            let limits = wrist(side, sex);
            for i in 0..5_000 {
                let limited = limits.limited(random_rotation(i));
                assert!(
                    limits.beyond_rad(limited) < 1e-9,
                    "a limited wrist is within its limits"
                );
                // GEVH tables B.1 and B.2.
                let angles = WristAngles::from_local(side, limited);
                let pronation = angles.pronation_rad.to_degrees();
                let [range, flexion, extension, ulnar, radial] = match sex {
                    Sex::Male => [151.9, 94.8, 78.0, 47.9, 36.7],
                    Sex::Female => [164.8, 98.1, 74.7, 43.0, 36.1],
                };
                let [most, least] = [80.0, -90.0].map(|d| range * d / 170.0);
                assert!((least..=most).contains(&pronation), "{pronation}");
                let bend = -side.sign() * angles.swing.y.to_degrees();
                assert!((-extension..=flexion).contains(&bend), "{bend}");
                let aside = angles.swing.z.to_degrees();
                assert!((-ulnar..=radial).contains(&aside), "{aside}");
            }
        }
    }

    #[test]
    fn angles_and_rotations_convert_both_ways() {
        for side in Side::BOTH {
            for i in 0..500 {
                let q = random_rotation(i);
                assert!(
                    WristAngles::from_local(side, q)
                        .rotation(side)
                        .angle_between(q)
                        < 1e-6,
                    "the wrist angles round trip"
                );
            }
        }
    }

    #[test]
    fn what_is_easy_is_left_alone() {
        for (side, sex) in all() {
            let q = WristAngles::relaxed(side).rotation(side);
            assert!(
                wrist(side, sex).limited(q).angle_between(q) < 1e-7,
                "a comfortable wrist rotation is unchanged"
            );
        }
    }
}
