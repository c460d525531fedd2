//! Joint limits: GEVH appendix B, the 95th percentile of men and women.

use core::f64::consts::PI;

use raconteur_base::curve::smooth;
use raconteur_base::ops;

use super::{Joints, Limb};

/// Sex whose table of joint limits applies (GEVH appendix B).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sex {
    /// GEVH table B.1; also the default for unknown sex.
    #[default]
    Male,
    /// GEVH table B.2.
    Female,
}

impl Sex {
    /// Returns the sex for a share of female body shape, 0 to 1: female above 0.5, otherwise male;
    /// male for `None`.
    #[must_use]
    pub fn from_share(share: Option<f64>) -> Self {
        if share.is_some_and(|share| share > 0.5) {
            Self::Female
        } else {
            Self::Male
        }
    }
}

/// Joint limits of one sex from GEVH appendix B, degrees, minimum and maximum. X is the axis from
/// back to front, Y from side to side, Z upright.
struct Anthropometry {
    neck: [[f64; 2]; 3],
    cervical: [[f64; 2]; 2],
    shoulder: [[f64; 2]; 2],
    elbow_y: [f64; 2],
    wrist: [[f64; 2]; 3],
    thigh: [[f64; 2]; 2],
    knee_y: [f64; 2],
    ankle: [[f64; 2]; 3],
}

/// GEVH table B.1. (The right thigh's −53.0 is read as the left one's −53.5.)
const MALE: Anthropometry = Anthropometry {
    neck: [[-63.5, 63.5], [-71.0, 70.0], [-99.1, 99.6]],
    cervical: [[-45.0, 45.0], [-25.0, 40.0]],
    shoulder: [[-188.7, 63.0], [-83.3, 210.9]],
    elbow_y: [0.0, 159.0],
    wrist: [[-47.9, 36.7], [-78.0, 94.8], [-125.8, 26.1]],
    thigh: [[-53.5, 53.5], [-148.0, 148.0]],
    knee_y: [0.0, 145.6],
    ankle: [[-39.0, 35.0], [-19.9, 79.6], [-55.0, 63.0]],
};

/// GEVH table B.2.
const FEMALE: Anthropometry = Anthropometry {
    neck: [[-77.2, 63.5], [-84.4, 70.0], [-109.0, 108.8]],
    cervical: [[-45.0, 45.0], [-25.0, 40.0]],
    shoulder: [[-192.9, 63.0], [-87.9, 217.9]],
    elbow_y: [0.0, 165.9],
    wrist: [[-43.0, 36.1], [-74.7, 98.1], [-135.9, 28.9]],
    thigh: [[-53.0, 40.15], [-148.0, 148.0]],
    knee_y: [0.0, 145.2],
    ankle: [[-39.0, 35.0], [-19.9, 79.6], [-55.0, 63.0]],
};

/// Share of pronation in the forearm's range, counted from the thumb-up middle: 80° and 90° are the
/// clinical norms (AAOS 1965). GEVH prints the range without its zero; read from either end it
/// would forbid a palm held down at the waist.
const PRONATION_SHARE: f64 = 80.0 / 170.0;

/// Range of a joint angle, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Minimum angle, radians.
    pub min_rad: f64,
    /// Maximum angle, radians.
    pub max_rad: f64,
}

impl Limit {
    /// Without limits.
    const FREE: Self = Self {
        min_rad: f64::NEG_INFINITY,
        max_rad: f64::INFINITY,
    };

    fn from_degrees([least_deg, most_deg]: [f64; 2]) -> Self {
        Self {
            min_rad: least_deg.to_radians(),
            max_rad: most_deg.to_radians(),
        }
    }

    /// Returns true if an angle is within the limit.
    #[must_use]
    pub fn contains(self, angle_rad: f64) -> bool {
        (self.min_rad..=self.max_rad).contains(&angle_rad)
    }

    /// Returns the equivalent angle (up to full turns) nearest to the middle of the range; without
    /// a limit the angle itself.
    #[must_use]
    pub fn wrapped(self, angle_rad: f64) -> f64 {
        if self.min_rad.is_infinite() {
            return angle_rad;
        }
        let middle = 0.5 * (self.min_rad + self.max_rad);
        middle + ops::wrap_angle(angle_rad - middle)
    }

    /// Clamps an angle to the range. Beyond a limit it stays there; on the far side of the circle
    /// the limit yields, so turning further past it makes no joint snap from one limit to the
    /// other.
    #[must_use]
    pub fn clamp(self, angle_rad: f64) -> f64 {
        let angle = self.wrapped(angle_rad);
        if self.contains(angle) {
            return angle;
        }
        let middle = 0.5 * (self.min_rad + self.max_rad);
        let half = 0.5 * (self.max_rad - self.min_rad);
        let off = angle - middle;
        let beyond = (off.abs() - half) / (PI - half);
        let kept = middle + off.signum() * half * (1.0 - smooth(2.0 * beyond - 1.0));
        kept.clamp(self.min_rad, self.max_rad)
    }
}

/// Returns the limits of a limb's joints, in the order and with the signs of [`Joints`]: positive
/// is abduction, forward flexion (elbow, knee and wrist: towards the inside, ankle: toes down),
/// pronation or inward rotation, deviation to the thumb, eversion of the sole; for the head a tilt
/// to the left, a nod forwards and a turn to the left. The seventh joint, which is not in the
/// appendix, is free.
#[must_use]
pub fn limits(limb: Limb, sex: Sex) -> [Limit; 7] {
    let table = match sex {
        Sex::Male => &MALE,
        Sex::Female => &FEMALE,
    };
    // Appendix B counts abduction as negative, the example of D.3.20 as positive.
    let turned = |[least, most]: [f64; 2]| [-most, -least];
    let degrees = match limb {
        Limb::LeftArm | Limb::RightArm => {
            let twist = table.wrist[2][1] - table.wrist[2][0];
            let pronation = twist * PRONATION_SHARE;
            [
                turned(table.shoulder[0]),
                table.shoulder[1],
                table.elbow_y,
                [pronation - twist, pronation],
                table.wrist[0],
                table.wrist[1],
            ]
        }
        Limb::LeftLeg | Limb::RightLeg => [
            turned(table.thigh[0]),
            table.thigh[1],
            table.knee_y,
            table.ankle[2],
            table.ankle[1],
            table.ankle[0],
        ],
        Limb::Head => {
            let [x, y, z] = table.neck;
            let mut limits = [Limit::FREE; 7];
            let rows = [table.cervical[0], table.cervical[1], z, y, x];
            for (limit, row) in limits.iter_mut().zip(rows) {
                *limit = Limit::from_degrees(row);
            }
            return limits;
        }
    };
    let mut limits = [Limit::FREE; 7];
    for (limit, row) in limits.iter_mut().zip(degrees) {
        *limit = Limit::from_degrees(row);
    }
    limits
}

/// Moves joints towards their limits by a share.
pub(crate) fn clamp_joints(limits: &[Limit; 7], share: f64, joints: &Joints) -> Joints {
    let mut kept = *joints;
    for (angle, limit) in kept.iter_mut().zip(limits) {
        // The equivalent angle within a turn of the limits makes a partial change short.
        let within = limit.clamp(*angle);
        let near = limit.wrapped(*angle);
        *angle = if share >= 1.0 {
            within
        } else {
            near + share * (within - near)
        };
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_kept_within_and_never_snap() {
        for sex in [Sex::Male, Sex::Female] {
            for limb in Limb::ALL {
                for limit in limits(limb, sex) {
                    let mut last: Option<f64> = None;
                    for i in -4000..=4000 {
                        let angle = f64::from(i) * 1e-3;
                        let kept = limit.clamp(angle);
                        if limit.min_rad.is_finite() {
                            assert!(limit.contains(kept), "{limb:?} {angle} {kept}");
                            let jump = last.map_or(0.0, |l| (kept - l).abs());
                            assert!(jump < 0.05, "{limb:?} {angle}: {jump}");
                            last = Some(kept);
                        }
                        if limit.contains(ops::wrap_angle(angle)) {
                            let same = ops::wrap_angle(kept - angle);
                            assert!(
                                same.abs() < 1e-12,
                                "an angle within its limits is unchanged"
                            );
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn the_rows_are_those_of_the_appendix() {
        let degrees = |limb, sex, joint: usize| {
            let limit = limits(limb, sex)[joint];
            [limit.min_rad.to_degrees(), limit.max_rad.to_degrees()]
        };
        let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() + (a[1] - b[1]).abs() < 1e-9;
        assert!(
            near(degrees(Limb::LeftArm, Sex::Male, 0), [-63.0, 188.7]),
            "male left shoulder limits"
        );
        assert!(
            near(degrees(Limb::RightArm, Sex::Female, 2), [0.0, 165.9]),
            "female right shoulder limits"
        );
        assert!(
            near(degrees(Limb::LeftLeg, Sex::Female, 0), [-40.15, 53.0]),
            "female left hip limits"
        );
        assert!(
            near(degrees(Limb::RightLeg, Sex::Male, 4), [-19.9, 79.6]),
            "male right ankle limits"
        );
        assert!(
            near(degrees(Limb::Head, Sex::Female, 2), [-109.0, 108.8]),
            "female neck limits"
        );
        let [least, most] = degrees(Limb::LeftArm, Sex::Male, 3);
        assert!(
            (most - least - 151.9).abs() < 1e-9,
            "the range of the male left forearm"
        );
    }
}
