//! Swivel angle, the seventh degree of freedom: the position of the elbow or knee while the end
//! effector stays in place.
//!
//! Directions around the line from shoulder to wrist are weighted by comfort, by the strain of the
//! wrist and by the penetration of the arm into torso, head or the other arm. The result is their
//! weighted mean. The mean is a smooth function of the target; the best single direction would
//! jump.

use core::f64::consts::{FRAC_PI_2, PI};

use raconteur_base::{DQuat, DVec3, Length, ops};

use super::chain::{LimbBase, LimbRig};
use super::obstacles::{Clearance, Obstacles};
use super::{Joints, RigidFrame};

/// Direction, in body axes of the left side (x outwards), of a hand held in front at ease, where
/// [`ELBOW_AT_EASE`] applies; the swivel field is singular opposite to it.
const HAND_AT_EASE: DVec3 = DVec3::new(0.22, 0.12, 1.0);
/// Direction of the elbow from the line between shoulder and wrist there. Designed.
const ELBOW_AT_EASE: DVec3 = DVec3::new(0.42, -1.0, 0.0);

/// Swivel candidates: the first, radians from the natural direction (positive lifts the elbow),
/// their number, and their spacing.
const FIRST_RAD: f64 = -0.75;
const CANDIDATES: usize = 9;
const STEP_RAD: f64 = 0.25;
/// Sine and cosine of the first swivel and of the step.
const FIRST_SIN_COS: [f64; 2] = [-0.681_638_760_023_334_2, 0.731_688_868_873_820_9];
const STEP_SIN_COS: [f64; 2] = [0.247_403_959_254_522_94, 0.968_912_421_710_644_7];
/// Effort difference that makes one direction e times as likely as another. Designed: sharp enough
/// to avoid the body, soft enough to be steady.
const SOFTNESS: f64 = 0.04;
/// Effort of a lifted or lowered elbow, per square radian. Designed.
const LIFTED: f64 = 0.16;

/// Effort of an upper arm a radian beyond the limits of the shoulder. Designed: more than any
/// collision, since beyond them it cannot go.
const LIMITS: f64 = 8.0;
/// Sine of the angle to the back below which every upper arm is within its limits: slightly less
/// than the overhead flexion of table B.1 exceeds 180°.
const BACKWARDS: f64 = 0.45;

/// Effort of an elbow or knee that points away from where the user prefers it. Designed: more
/// than to be raised or lowered, less than to strain the wrist to its limits, to go through the
/// body or beyond the limits of the shoulder.
const PREFERRED: f64 = 1.5;

/// Preferred joint angles with their weights, 0 to 1; they influence the swivel angle of elbow or
/// knee.
#[derive(Clone, Copy, Debug, Default)]
pub struct JointPreference(pub [(Option<Joints>, f64); 2]);

/// Criteria for the swivel angle of elbow or knee: obstacles, preferred joint angles, and
/// relaxation.
#[derive(Clone, Copy, Debug, Default)]
pub struct SwivelCriteria<'a> {
    /// Obstacles that the arm avoids; `None` to ignore them.
    pub obstacles: Option<&'a Obstacles<'a>>,
    /// The user's preference; has priority over comfort (GEVH 3.3.2.1).
    pub preference: JointPreference,
    /// True if the end may turn freely, whatever the rotation of the target.
    pub is_relaxed: bool,
}

/// Returns the likelihood of a direction with a given excess effort over the best: the exponential
/// function of its negative over [`SOFTNESS`], approximated by the limit of powers stopped at the
/// 1024th because it is evaluated often.
fn likelihood(effort: f64) -> f64 {
    let mut power = (1.0 - effort * (1.0 / (1024.0 * SOFTNESS))).max(0.0);
    for _ in 0..10 {
        power *= power;
    }
    power
}

/// Returns the mean of the candidate swivel angles, radians, weighted by the likelihood of their
/// efforts.
fn mean_swivel(efforts: &[f64; CANDIDATES]) -> f64 {
    // From the least: where every direction is bad they still differ.
    let least = efforts.iter().copied().fold(f64::INFINITY, f64::min);
    let (mut sum, mut weights, mut swivel) = (0.0, 0.0, FIRST_RAD);
    for effort in efforts {
        let weight = likelihood(effort - least);
        sum += weight * swivel;
        weights += weight;
        swivel += STEP_RAD;
    }
    sum / weights
}

/// A limb with everything settled but the swivel.
struct SwivelCircle {
    shoulder: DVec3,
    wrist: DVec3,
    direction: DVec3,
    /// Distance of the elbow's circle from the shoulder, and its radius, metres.
    along_m: f64,
    radius_m: f64,
    /// Reciprocal of the length of the limb's lower bone.
    per_lower: f64,
    /// The x and y axes of hand or foot.
    end_axes: [DVec3; 2],
}

impl SwivelCircle {
    fn elbow(&self, outwards: DVec3) -> DVec3 {
        self.shoulder + self.direction * self.along_m + outwards * self.radius_m
    }
}

impl LimbRig {
    /// Returns the natural direction of elbow or knee for a direction of the limb's end, and that
    /// direction lifted by a right angle; unit vectors, figure axes.
    fn natural(&self, direction: DVec3, base: &LimbBase) -> [DVec3; 2] {
        // The base has x down, y left and z to the front.
        let body = base.rotation * DQuat::from_rotation_z(FRAC_PI_2);
        let in_body = body.inverse() * direction;
        let natural = if self.is_arm {
            natural_elbow(self.sign, in_body)
        } else {
            // Knees point forwards and a little outwards.
            DQuat::from_rotation_arc(DVec3::NEG_Y, in_body) * DVec3::new(0.12 * self.sign, 0.0, 1.0)
        };
        let across = body * natural;
        let first = (across - direction * direction.dot(across))
            .try_normalized()
            .unwrap_or_else(|| direction.any_orthonormal_vector());
        [first, direction.cross(first) * self.sign]
    }

    /// Returns the direction from base to target, the natural direction of elbow or knee around it,
    /// and that direction lifted by a right angle; unit vectors, figure axes.
    fn axes_for(&self, target: &RigidFrame, base: &LimbBase) -> [DVec3; 3] {
        let direction = (target.position - base.origin)
            .try_normalized()
            .unwrap_or(base.rotation * DVec3::X);
        let [first, second] = self.natural(direction, base);
        [direction, first, second]
    }

    /// Returns the direction of elbow or knee for a swivel angle, radians from the natural
    /// direction; a unit vector across the line to the target, figure axes.
    #[must_use]
    pub fn elbow_at(&self, target: &RigidFrame, base: &LimbBase, swivel_rad: f64) -> DVec3 {
        let [_, first, second] = self.axes_for(target, base);
        let (s, c) = ops::sincos(swivel_rad);
        first * c + second * s
    }

    /// Returns the swivel angle of an elbow or knee in direction `hinge` from the base, radians
    /// from the natural direction.
    #[must_use]
    pub fn swivel_of(&self, hinge: DVec3, target: &RigidFrame, base: &LimbBase) -> f64 {
        let [_, first, second] = self.axes_for(target, base);
        ops::atan2(hinge.dot(second), hinge.dot(first))
    }

    /// Returns the best swivel for a target in reach, radians from the natural direction: the mean
    /// of nine around it, each weighted by the exponential function of its negative effort. Effort
    /// grows with lifting, strain of the hand, shoulder angles beyond the limits, deviation from
    /// the user's preference, and obstacles.
    #[must_use]
    pub fn swivel_for(
        &self,
        target: &RigidFrame,
        base: &LimbBase,
        comfort: &SwivelCriteria<'_>,
    ) -> f64 {
        let axes = self.axes_for(target, base);
        let [direction, first, second] = axes;
        let preferred = comfort.preference.0.map(|(joints, weight)| {
            let joints = joints.filter(|_| weight > 0.0)?;
            Some((self.hinge_across(&joints, base, axes), weight))
        });
        let distance = (target.position - base.origin).magnitude();
        let [flexion, _] = self.chain.flexions_for(distance);
        let hinge = self.chain.hinge();
        let end = self.chain.end_in_upper(flexion);
        let along_m = hinge.dot(end) / end.magnitude().max(1e-9);
        let radius_m = (hinge.length_squared() - along_m * along_m).max(0.0).sqrt();
        let lower_m = ((distance - along_m) * (distance - along_m) + radius_m * radius_m).sqrt();
        let circle = SwivelCircle {
            shoulder: base.origin,
            wrist: target.position,
            direction,
            along_m,
            radius_m,
            per_lower: 1.0 / lower_m.max(1e-9),
            end_axes: [DVec3::X, DVec3::Y].map(|axis| target.rotation * axis),
        };
        let to_base = base.rotation.inverse();
        // Only an upper arm that points to the back is ever beyond its limits.
        let back = base.rotation * DVec3::NEG_Z;
        let most_back_m = BACKWARDS * hinge.magnitude();
        let clearance = comfort.obstacles.map(Clearance::new);
        let clearance = clearance.as_ref().map(|c| {
            let ends = [circle.shoulder, circle.wrist].map(|p| c.in_body(p));
            (c, ends)
        });
        let mut efforts = [0.0; CANDIDATES];
        let ([mut s, mut c], [step_s, step_c]) = (FIRST_SIN_COS, STEP_SIN_COS);
        let (mut swivel, mut outwards) = (FIRST_RAD, first * c + second * s);
        for effort in &mut efforts {
            *effort = LIFTED * swivel * swivel;
            if !comfort.is_relaxed {
                *effort += self.strain(&circle, outwards);
            }
            let elbow = circle.elbow(outwards);
            let upper = elbow - base.origin;
            if self.is_arm && upper.dot(back) >= most_back_m {
                *effort += LIMITS * self.excess_squared(to_base * upper);
            }
            for ([along_first, along_second], weight) in preferred.into_iter().flatten() {
                let aside = ops::hypot(along_first, along_second);
                let off = aside - (along_first * c + along_second * s);
                *effort += PREFERRED * weight * off;
            }
            if let Some((clearance, [shoulder, wrist])) = clearance {
                let arm = [circle.shoulder, elbow, circle.wrist];
                *effort += clearance.effort(arm, [shoulder, clearance.in_body(elbow), wrist]);
            }
            (s, c) = (s * step_c + c * step_s, c * step_c - s * step_s);
            outwards = first * c + second * s;
            swivel += STEP_RAD;
        }
        mean_swivel(&efforts)
    }

    /// Returns the position of elbow or knee with these joints, perpendicular to the line to a
    /// target: along the two axes of a swivel, shares of the upper limb.
    fn hinge_across(&self, joints: &Joints, base: &LimbBase, axes: [DVec3; 3]) -> [f64; 2] {
        let upper = base.rotation * self.link(joints) * self.link_from_upper;
        let hinge = upper * self.chain.hinge();
        let unit = hinge.try_normalized().unwrap_or(DVec3::ZERO);
        let [_, first, second] = axes;
        [unit.dot(first), unit.dot(second)]
    }

    /// Returns the squared angle by which an upper arm in direction `upper` (base axes, any length)
    /// exceeds the shoulder's limits.
    fn excess_squared(&self, upper: DVec3) -> f64 {
        let level = (upper.x * upper.x + upper.y * upper.y).sqrt();
        let aside = self.sign * ops::atan2(upper.y, upper.x);
        let forth = ops::atan2(upper.z, level);
        // Both solutions of the shoulder turn.
        let ways = [[aside, forth], [aside + PI, PI - forth]];
        let off = ways.map(|way| {
            let off = |i: usize| {
                let angle = self.limits[i].wrapped(way[i]);
                let over = angle - angle.clamp(self.limits[i].min_rad, self.limits[i].max_rad);
                over * over
            };
            off(0) + off(1)
        });
        off[0].min(off[1])
    }

    /// Returns the strain of a swivel on the wrist or ankle beyond its relaxed range: bend and
    /// twist, by their cosines.
    fn strain(&self, circle: &SwivelCircle, outwards: DVec3) -> f64 {
        const FREE_BEND: f64 = 0.17;
        const FREE_TWIST: f64 = 0.62;
        let fore = (circle.wrist - circle.elbow(outwards)) * circle.per_lower;
        let [hand, side] = circle.end_axes;
        let bend = (1.0 - FREE_BEND - fore.dot(hand)).max(0.0);
        // The hinge is perpendicular to limb and elbow direction; a hand at rest has its y axis
        // along it.
        let facing = if self.is_arm { 1.0 } else { -1.0 };
        let hinge = circle.direction.cross(outwards) * facing;
        let across = side - fore * fore.dot(side);
        let twist = (FREE_TWIST - across.dot(hinge) / across.magnitude().max(0.2)).max(0.0);
        1.2 * bend * bend + 0.95 * twist * twist
    }
}

/// Returns the natural direction of the elbow, away from the line between shoulder and wrist, for a
/// wrist in a unit direction from the shoulder; body axes, not normalised. `sign` is +1 on the
/// left, −1 on the right.
fn natural_elbow(sign: f64, direction_in_body: DVec3) -> DVec3 {
    let mirrored = |v: DVec3| DVec3::new(v.x * sign, v.y, v.z);
    let ease = mirrored(HAND_AT_EASE).normalized();
    DQuat::from_rotation_arc(ease, direction_in_body) * mirrored(ELBOW_AT_EASE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_direction_that_is_less_bad_is_taken_however_bad_all_are() {
        for floor in [0.0, 5.0, 18.0, 40.0, 1e3] {
            let towards = |best: f64| {
                let mut efforts = [0.0; CANDIDATES];
                for (i, effort) in efforts.iter_mut().enumerate() {
                    let off = FIRST_RAD + STEP_RAD * i as f64 - best;
                    *effort = floor + off * off;
                }
                mean_swivel(&efforts)
            };
            for best in [-0.5, 0.0, 0.6, 1.0] {
                let found = towards(best);
                assert!((found - best).abs() < 0.02, "{floor} {best}: {found}");
            }
        }
    }
}
