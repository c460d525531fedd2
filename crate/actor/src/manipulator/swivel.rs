//! The seventh degree of freedom: where the elbow or knee goes while the end keeps its place.
//!
//! Some directions around the line from shoulder to wrist are weighed by comfort, by the
//! strain of the wrist and by how deep the arm would lie in torso, head or the other arm;
//! their mean, weighted by that, is taken. The mean is a smooth function of the target,
//! where the best single direction would jump.

use core::f64::consts::{FRAC_PI_2, PI};

use raconteur_base::{DAffine3, DQuat, DVec3, Length, Side, ops};

use super::rig::{Base, LimbRig};
use super::{Frame, Joints};
use crate::arm_ik::{TRUNK_HALF_AXES_M, natural_elbow};

/// Swivels that are weighed: the first, radians from the natural direction (positive lifts
/// the elbow), how many there are, and how far each is from the last.
const FIRST_RAD: f64 = -0.75;
const CANDIDATES: usize = 9;
const STEP_RAD: f64 = 0.25;
/// Sine and cosine of the first swivel and of the step.
const FIRST_SIN_COS: [f64; 2] = [-0.681_638_760_023_334_2, 0.731_688_868_873_820_9];
const STEP_SIN_COS: [f64; 2] = [0.247_403_959_254_522_94, 0.968_912_421_710_644_7];
/// Effort by which one direction is e times as likely as another. Designed: sharp enough to
/// keep out of the body, soft enough to be steady.
const SOFTNESS: f64 = 0.04;
/// Weight of a direction that is out of the question: some stays where all are.
const LEAST_WEIGHT: f64 = 1e-200;
/// Radius of the arm about its bones for a stature of 1.7 m, metres: the elbow is some
/// 10 cm across, clothed.
const ARM_RADIUS_M: f64 = 0.045;
/// Radius of the head with its hair, likewise. Head breadth and length are 15 and 19 cm.
const HEAD_RADIUS_M: f64 = 0.115;
/// Effort of an arm that lies half its clearance deep in something. Designed.
const COLLISION: f64 = 3.0;
/// Share of that for the other arm, which comes and goes faster than anything else.
const OTHER_ARM: f64 = 0.3;

/// Effort of an upper arm a radian beyond the limits of the shoulder. Designed: more than any
/// collision, since beyond them it cannot go.
const LIMITS: f64 = 8.0;
/// Sine of the angle to the back below which every upper arm is within its limits: a little
/// less than the flexion overhead of table B.1 goes beyond 180°.
const BACKWARDS: f64 = 0.45;

/// Effort of an elbow or knee that points away from where the user prefers it. Designed: more
/// than to be raised or lowered, less than to strain the wrist to its limits, to go through the
/// body or beyond the limits of the shoulder.
const PREFERRED: f64 = 1.5;

/// Joint angles that the user prefers, and how much each set counts, 0 to 1.
#[derive(Clone, Copy, Debug, Default)]
pub struct Preference(pub [(Option<Joints>, f64); 2]);

/// What an arm must keep clear of, figure axes.
#[derive(Clone, Copy, Debug)]
pub struct Obstacles {
    /// Body axes of the zero pose from figure: where the torso stands upright at x = 0.
    pub body_from_figure: DAffine3,
    /// The middle of the shoulders in those axes, metres.
    pub shoulders_in_body: DVec3,
    /// The middle of the head, metres.
    pub head: DVec3,
    /// Elbow and wrist of the other arm, metres.
    pub other_forearm: [DVec3; 2],
    /// Stature over 1.7 m.
    pub scale: f64,
}

/// Obstacles prepared for many queries: divisors are stored as factors.
struct Clearance<'a> {
    obstacles: &'a Obstacles,
    /// One over the square of the arm's distance from the head's middle, and from the other arm.
    head: f64,
    other_arm: f64,
    /// The other forearm, and it over the square of its length.
    forearm: DVec3,
    along_forearm: DVec3,
    /// One over the squares of the torso's half axes with the arm about them.
    torso: [f64; 2],
    /// One over the height in which the torso's top ends, and where it begins to, metres.
    top: f64,
    top_m: f64,
}

impl<'a> Clearance<'a> {
    fn new(obstacles: &'a Obstacles) -> Self {
        let scale = obstacles.scale;
        let inverse_square = |metres: f64| 1.0 / (metres * metres * scale * scale);
        let [a, b] = obstacles.other_forearm;
        let forearm = b - a;
        Self {
            obstacles,
            head: inverse_square(HEAD_RADIUS_M + ARM_RADIUS_M),
            other_arm: inverse_square(2.0 * ARM_RADIUS_M),
            forearm,
            along_forearm: forearm / forearm.length_squared().max(1e-12),
            torso: TRUNK_HALF_AXES_M.map(|half| inverse_square(half + ARM_RADIUS_M)),
            // Above the shoulders there is only the neck.
            top: 1.0 / (0.06 * scale),
            top_m: 0.02 * scale,
        }
    }

    /// A place in body axes, from the middle of the shoulders.
    fn in_body(&self, point: DVec3) -> DVec3 {
        let obstacles = self.obstacles;
        obstacles.body_from_figure.transform_point3(point) - obstacles.shoulders_in_body
    }

    /// How much effort it is to have an arm's shoulder, elbow and wrist in a place, which is
    /// given in figure axes and [in the body's](Self::in_body).
    fn effort(&self, arm: [DVec3; 3], arm_in_body: [DVec3; 3]) -> f64 {
        // The shoulder itself touches the torso, and the wrist is at its target.
        let points = |[shoulder, elbow, wrist]: [DVec3; 3]| {
            [
                shoulder.lerp(elbow, 0.6),
                elbow,
                elbow.lerp(wrist, 0.35),
                elbow.lerp(wrist, 0.7),
            ]
        };
        let [other_elbow, _] = self.obstacles.other_forearm;
        let mut sum = 0.0;
        for (point, in_body) in points(arm).into_iter().zip(points(arm_in_body)) {
            let head = depth(point.distance_squared(self.obstacles.head) * self.head);
            let share = (point - other_elbow).dot(self.along_forearm);
            let near = other_elbow + self.forearm * share.clamp(0.0, 1.0);
            let other = depth(point.distance_squared(near) * self.other_arm);
            let torso = self.depth_in_torso(in_body);
            sum += torso * torso + head * head + OTHER_ARM * other * other;
        }
        4.0 * COLLISION * sum
    }

    /// Depth of the bone of an arm, in body axes, in the torso, as a share of its half axes.
    fn depth_in_torso(&self, p: DVec3) -> f64 {
        let below = (1.0 - (p.y + self.top_m) * self.top).clamp(0.0, 1.0);
        below * depth(p.x * p.x * self.torso[0] + p.z * p.z * self.torso[1])
    }
}

/// How likely a direction of so much effort is: the exponential function of its negative over
/// [`SOFTNESS`], as the limit of powers stopped at the 1024th, because it is evaluated often.
fn likelihood(effort: f64) -> f64 {
    let mut power = (1.0 - effort * (1.0 / (1024.0 * SOFTNESS))).max(0.0);
    for _ in 0..10 {
        power *= power;
    }
    power
}

/// How deep a place is inside something, 1 in its middle, from the square of its distance as
/// a share of the clearance; 0 outside.
fn depth(share_squared: f64) -> f64 {
    if share_squared >= 1.0 {
        0.0
    } else {
        1.0 - share_squared.sqrt()
    }
}

/// A limb with everything settled but the swivel.
struct Circle {
    shoulder: DVec3,
    wrist: DVec3,
    direction: DVec3,
    /// Distance of the elbow's circle from the shoulder, and its radius, metres.
    along_m: f64,
    radius_m: f64,
    /// One over the length of the lower limb.
    per_lower: f64,
    /// The x and y axes of hand or foot.
    end_axes: [DVec3; 2],
}

impl Circle {
    fn elbow(&self, outwards: DVec3) -> DVec3 {
        self.shoulder + self.direction * self.along_m + outwards * self.radius_m
    }
}

impl LimbRig {
    /// The natural direction of the elbow or knee for a direction of the end, and that
    /// direction turned by a right angle in the sense of a lift; unit, figure axes.
    fn natural(&self, direction: DVec3, base: &Base) -> [DVec3; 2] {
        // The base has x down, y left and z to the front.
        let body = base.rotation * DQuat::from_rotation_z(FRAC_PI_2);
        let in_body = body.inverse() * direction;
        let natural = if self.is_arm {
            let side = if self.sign > 0.0 {
                Side::Left
            } else {
                Side::Right
            };
            natural_elbow(side, in_body)
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

    /// The line from the base to a target, and around it the natural direction of elbow or
    /// knee and that direction lifted by a right angle.
    fn axes_for(&self, target: &Frame, base: &Base) -> [DVec3; 3] {
        let direction = (target.position - base.origin)
            .try_normalized()
            .unwrap_or(base.rotation * DVec3::X);
        let [first, second] = self.natural(direction, base);
        [direction, first, second]
    }

    /// The direction of the elbow or knee (unit, across the line to the target, figure axes)
    /// for a swivel, radians from the natural direction.
    #[must_use]
    pub fn elbow_at(&self, target: &Frame, base: &Base, swivel_rad: f64) -> DVec3 {
        let [_, first, second] = self.axes_for(target, base);
        let (s, c) = ops::sincos(swivel_rad);
        first * c + second * s
    }

    /// The swivel of an elbow or knee in a direction from the base, radians.
    #[must_use]
    pub fn swivel_of(&self, hinge: DVec3, target: &Frame, base: &Base) -> f64 {
        let [_, first, second] = self.axes_for(target, base);
        ops::atan2(hinge.dot(second), hinge.dot(first))
    }

    /// The best swivel for a target in reach, radians from the natural direction. Without
    /// obstacles nothing is in the way.
    #[must_use]
    pub fn swivel_for(&self, target: &Frame, base: &Base, obstacles: Option<&Obstacles>) -> f64 {
        self.swivel_by(target, base, obstacles, &Preference::default())
    }

    /// The same by the user's preference, which goes before comfort (GEVH 3.3.2.1).
    #[must_use]
    pub fn swivel_by(
        &self,
        target: &Frame,
        base: &Base,
        obstacles: Option<&Obstacles>,
        preference: &Preference,
    ) -> f64 {
        let axes = self.axes_for(target, base);
        let [direction, first, second] = axes;
        let preferred = preference.0.map(|(joints, weight)| {
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
        let circle = Circle {
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
        let clearance = obstacles.map(Clearance::new);
        let clearance = clearance.as_ref().map(|c| {
            let ends = [circle.shoulder, circle.wrist].map(|p| c.in_body(p));
            (c, ends)
        });
        let (mut sum, mut weights) = (0.0, 0.0);
        let ([mut s, mut c], [step_s, step_c]) = (FIRST_SIN_COS, STEP_SIN_COS);
        let (mut swivel, mut outwards) = (FIRST_RAD, first * c + second * s);
        for _ in 0..CANDIDATES {
            let mut effort = 0.16 * swivel * swivel + self.strain(&circle, outwards);
            let elbow = circle.elbow(outwards);
            let upper = elbow - base.origin;
            if self.is_arm && upper.dot(back) >= most_back_m {
                effort += LIMITS * self.beyond(to_base * upper);
            }
            for ([along_first, along_second], weight) in preferred.into_iter().flatten() {
                let aside = ops::hypot(along_first, along_second);
                let off = aside - (along_first * c + along_second * s);
                effort += PREFERRED * weight * off;
            }
            if let Some((clearance, [shoulder, wrist])) = clearance {
                let arm = [circle.shoulder, elbow, circle.wrist];
                effort += clearance.effort(arm, [shoulder, clearance.in_body(elbow), wrist]);
            }
            let weight = likelihood(effort).max(LEAST_WEIGHT);
            sum += weight * swivel;
            weights += weight;
            (s, c) = (s * step_c + c * step_s, c * step_c - s * step_s);
            outwards = first * c + second * s;
            swivel += STEP_RAD;
        }
        sum / weights
    }

    /// Where elbow or knee are with these joints, across the line to a target: along the two
    /// axes that a swivel turns in, shares of the upper limb.
    fn hinge_across(&self, joints: &Joints, base: &Base, axes: [DVec3; 3]) -> [f64; 2] {
        let upper = base.rotation * self.link(joints) * self.link_from_upper;
        let hinge = upper * self.chain.hinge();
        let unit = hinge.try_normalized().unwrap_or(DVec3::ZERO);
        let [_, first, second] = axes;
        [unit.dot(first), unit.dot(second)]
    }

    /// Square of the angle by which an upper arm (base axes, any length) is beyond the limits of
    /// the shoulder.
    fn beyond(&self, upper: DVec3) -> f64 {
        let level = (upper.x * upper.x + upper.y * upper.y).sqrt();
        let aside = self.sign * ops::atan2(upper.y, upper.x);
        let forth = ops::atan2(upper.z, level);
        // Both ways to turn the shoulder.
        let ways = [[aside, forth], [aside + PI, PI - forth]];
        let off = ways.map(|way| {
            let off = |i: usize| {
                let angle = self.limits[i].wrapped(way[i]);
                let over = angle - angle.clamp(self.limits[i].least_rad, self.limits[i].most_rad);
                over * over
            };
            off(0) + off(1)
        });
        off[0].min(off[1])
    }

    /// What a swivel asks of the wrist or ankle beyond what it does without thinking: bend
    /// and twist, by their cosines.
    fn strain(&self, circle: &Circle, outwards: DVec3) -> f64 {
        const FREE_BEND: f64 = 0.17;
        const FREE_TWIST: f64 = 0.62;
        let fore = (circle.wrist - circle.elbow(outwards)) * circle.per_lower;
        let [hand, side] = circle.end_axes;
        let bend = (1.0 - FREE_BEND - fore.dot(hand)).max(0.0);
        // The hinge lies across limb and elbow; a hand at rest has its y axis along it.
        let facing = if self.is_arm { 1.0 } else { -1.0 };
        let hinge = circle.direction.cross(outwards) * facing;
        let across = side - fore * fore.dot(side);
        let twist = (FREE_TWIST - across.dot(hinge) / across.magnitude().max(0.2)).max(0.0);
        1.2 * bend * bend + 0.8 * twist * twist
    }
}
