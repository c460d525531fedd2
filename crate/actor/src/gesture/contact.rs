//! Collision of hands with each other and with the body.
//!
//! A hand is a bundle of capsules about its bones. The separation needs a continuous function of
//! the requested hand positions, so that a hand slides along an obstacle.

use raconteur_base::{DQuat, DVec3, Length, Side};
use raconteur_body::hand_shape::finger_bones;
use raconteur_body::{Bone, Pose, Skeleton};

use crate::kinematics::{rotation_of, world_from_bone};
use crate::limb::BodySpace;

/// Bones of a hand that have a capsule: four for each finger, the one in the palm first.
pub const CAPSULES: usize = 20;
/// Radii of a palm's bone and of the three of a finger, and of the thumb's, for a stature of
/// 1.7 m, metres: middle distances of our figures' skin from the bones.
const RADII_M: [[f64; 4]; 2] = [
    [0.013, 0.0108, 0.0096, 0.0078],
    [0.013, 0.0165, 0.0112, 0.0098],
];
/// Length of the last bone of a finger, as a share of the one before.
pub const TIP_SHARE: f64 = 0.8;
/// Width of the contact edge in which hands begin to yield, metres.
const EDGE_M: f64 = 0.004;
/// Share of a push directed to the hands' own sides, whatever the contact direction. Designed.
const BIAS: f64 = 0.5;
/// Steps of the search for where two hands are free of each other.
const STEPS: usize = 8;

/// Sphere swept along a line segment; approximates a finger bone or a part of a hand in collision
/// tests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// Ends of its axis, metres.
    pub ends: [DVec3; 2],
    /// Radius of the capsule, metres.
    pub radius_m: f64,
}

impl Capsule {
    /// Returns the penetration depth of this capsule and another, moved by an offset; negative when
    /// apart; metres.
    #[must_use]
    pub fn depth_m(&self, other: &Self, offset: DVec3) -> f64 {
        self.radius_m + other.radius_m - self.gap(other, offset).magnitude()
    }

    /// Returns the shortest vector from the axis of the other, moved by an offset, to this one's
    /// axis.
    fn gap(&self, other: &Self, offset: DVec3) -> DVec3 {
        shortest(self.ends, other.ends.map(|p| p + offset))
    }
}

/// Returns the shortest vector from line segment `b` to another, metres.
fn shortest(a: [DVec3; 2], b: [DVec3; 2]) -> DVec3 {
    let (u, v, w) = (a[1] - a[0], b[1] - b[0], a[0] - b[0]);
    let (uu, uv, vv) = (u.dot(u), u.dot(v), v.dot(v));
    let (uw, vw) = (u.dot(w), v.dot(w));
    let share = |over: f64, under: f64| {
        if under > 1e-12 {
            (over / under).clamp(0.0, 1.0)
        } else {
            0.0
        }
    };
    // The nearest point on one line to the nearest point on the other, corrected once.
    let s = share(uv * vw - vv * uw, uu * vv - uv * uv);
    let t = share(uv * s + vw, vv);
    let s = share(uv * t - uw, uu);
    w + u * s - v * t
}

/// Pose-independent measures of one hand of a figure.
#[derive(Clone, Debug)]
struct HandSolid {
    /// World from wrist in the zero pose.
    wrist_zero: DQuat,
    /// Start of each finger bone in the frame of its parent, metres, and its zero rotation.
    bones: [(DVec3, DQuat); 15],
    radii_m: [[f64; 4]; 2],
}

impl HandSolid {
    fn new(skeleton: &Skeleton, side: Side) -> Self {
        let wrist = Bone::on(side, "wrist");
        let scale = skeleton.scale();
        let bones = finger_bones(side).map(|bone| {
            let joint = &skeleton.joints()[bone.index()];
            (joint.translation_in_parent, joint.zero_rotation)
        });
        Self {
            wrist_zero: rotation_of(&world_from_bone(skeleton, &Pose::zero(), wrist)),
            bones,
            radii_m: RADII_M.map(|radii| radii.map(|r| r * scale)),
        }
    }

    fn capsules(&self, hand: &TargetHand) -> [Capsule; CAPSULES] {
        let mut capsules = [Capsule {
            ends: [hand.wrist; 2],
            radius_m: 0.0,
        }; CAPSULES];
        for finger in 0..5 {
            let mut at = hand.wrist;
            let mut rotation = hand.hand * self.wrist_zero;
            for k in 0..4 {
                let i = 3 * finger + k;
                // The last bone ends in the tip.
                let offset = if k < 3 {
                    self.bones[i].0
                } else {
                    self.bones[i - 1].0 * TIP_SHARE
                };
                let to = at + rotation * offset;
                capsules[4 * finger + k] = Capsule {
                    ends: [at, to],
                    // The thumb is the last.
                    radius_m: self.radii_m[finger / 4][k],
                };
                if k < 3 {
                    rotation = rotation * self.bones[i].1 * hand.fingers[i].1;
                }
                at = to;
            }
        }
        capsules
    }
}

/// Requested pose of a hand before collisions are resolved: wrist, rotation and fingers.
#[derive(Clone, Copy, Debug)]
pub struct TargetHand {
    /// Position of the wrist, metres.
    pub wrist: DVec3,
    /// Rotation of the hand ([`crate::palm`]).
    pub hand: DQuat,
    /// Local rotations of the finger bones, in the order of [`finger_bones`].
    pub fingers: [(Bone, DQuat); 15],
}

/// Collision model of a figure's hands and body; moves hands out of the body and apart from each
/// other.
#[derive(Clone, Debug)]
pub struct Contact {
    hands: [HandSolid; 2],
    space: BodySpace,
    /// 1 if the left hand passes behind the right, −1 if it passes in front.
    left_behind: f64,
}

impl Contact {
    /// Measures a figure with a dominant hand, which passes in front of the other.
    #[must_use]
    pub fn new(skeleton: &Skeleton, space: &BodySpace, dominant: Side) -> Self {
        Self {
            hands: Side::BOTH.map(|side| HandSolid::new(skeleton, side)),
            space: *space,
            left_behind: match dominant {
                Side::Right => 1.0,
                Side::Left => -1.0,
            },
        }
    }

    /// Returns the displacement that moves a hand (in the axes of the zero pose's trunk) out of
    /// trunk and head.
    #[must_use]
    pub fn exit_displacement(&self, side: Side, hand: &TargetHand) -> DVec3 {
        let mut sum = DVec3::ZERO;
        let (mut deepest, mut total) = (0.0_f64, 0.0);
        for capsule in self.hands[side.index()].capsules(hand) {
            let out = self
                .space
                .exit_displacement(capsule.ends[1], capsule.radius_m);
            let depth = out.magnitude();
            deepest = deepest.max(depth);
            // Deeper contacts have a larger weight in the direction.
            sum += out * depth;
            total += depth * depth;
        }
        if total > 0.0 {
            sum.try_normalized().unwrap_or(DVec3::ZERO) * deepest
        } else {
            DVec3::ZERO
        }
    }

    /// Returns the displacement that separates the left hand from the right; each hand takes half.
    /// The axes are the body's left and front.
    #[must_use]
    pub fn apart(&self, hands: [&TargetHand; 2], [left, front]: [DVec3; 2]) -> DVec3 {
        let [a, b] = [0, 1].map(|i| self.hands[i].capsules(hands[i]));
        // A sphere about each hand, from the middle of the palm.
        let [ca, cb] = [&a, &b].map(|c| c[4].ends[1]);
        let reach = |capsules: &[Capsule], centre: DVec3| {
            let ends = capsules.iter().flat_map(|c| c.ends);
            ends.map(|p| p.distance_to(centre)).fold(0.0, f64::max)
        };
        let touch = 2.0 * (self.hands[0].radii_m[1][1] + EDGE_M);
        if ca.distance_to(cb) > reach(&a, ca) + reach(&b, cb) + touch {
            return DVec3::ZERO;
        }
        // Crossed fingers cancel their pushes; then the hands move sideways, the dominant hand to
        // the front.
        let bias = (left * 0.8 - front * (0.6 * self.left_behind)) * BIAS;
        let mut parted = DVec3::ZERO;
        for _ in 0..STEPS {
            let mut sum = DVec3::ZERO;
            let (mut deepest, mut total) = (0.0_f64, 0.0);
            for x in &a {
                for y in &b {
                    // Intersecting axes separate sideways.
                    let gap = x.gap(y, -parted) + left * 1e-4;
                    let length = gap.magnitude();
                    let depth = eased(x.radius_m + y.radius_m - length);
                    if depth > 0.0 {
                        deepest = deepest.max(depth);
                        // Deeper contacts have a larger weight in the direction.
                        sum += gap * (depth / length);
                        total += depth;
                    }
                }
            }
            if deepest <= 0.0 {
                break;
            }
            let way = sum / total + bias;
            parted += way.try_normalized().unwrap_or(left) * deepest;
        }
        parted
    }
}

/// Returns max(x, 0) with its corner rounded within ±[`EDGE_M`].
fn eased(x: f64) -> f64 {
    if x >= EDGE_M {
        x
    } else if x <= -EDGE_M {
        0.0
    } else {
        (x + EDGE_M) * (x + EDGE_M) / (4.0 * EDGE_M)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gesture::RestPostures;
    use crate::palm;
    use raconteur_base::mirror_rotation;

    fn placed(side: Side, wrist: DVec3, hand: DQuat) -> TargetHand {
        TargetHand {
            wrist,
            hand,
            fingers: RestPostures::shape().rotations(side),
        }
    }

    #[test]
    fn capsules_know_how_deep_they_are_in_each_other() {
        let along = |from: DVec3, to: DVec3| Capsule {
            ends: [from, to],
            radius_m: 0.1,
        };
        let a = along(DVec3::ZERO, DVec3::X);
        let crossing = along(DVec3::new(0.5, 0.15, -1.0), DVec3::new(0.5, 0.15, 1.0));
        assert!(
            (a.depth_m(&crossing, DVec3::ZERO) - 0.05).abs() < 1e-12,
            "crossing capsules overlap by 5 cm"
        );
        let beyond = along(DVec3::new(1.5, 0.0, 0.0), DVec3::new(2.0, 0.0, 0.0));
        assert!(
            (a.depth_m(&beyond, DVec3::ZERO) + 0.3).abs() < 1e-12,
            "separate capsules have a negative depth"
        );
        assert!(
            (a.depth_m(&a, DVec3::Y * 0.2)).abs() < 1e-12,
            "two capsules that touch have a depth of 0"
        );
    }

    #[test]
    fn hands_that_want_one_place_are_parted_and_slide() {
        let skeleton = Skeleton::example();
        let contact = Contact::new(&skeleton, &BodySpace::new(&skeleton, None), Side::Right);
        for (fingers, normal) in [
            (DVec3::Z, DVec3::X),
            (DVec3::new(1.0, -0.2, 0.2), DVec3::NEG_Z),
            (DVec3::Z, DVec3::NEG_Y),
        ] {
            let right = palm::from_directions(Side::Right, fingers, normal).expect("square");
            let left = mirror_rotation(right);
            let (mut last, mut worst): (Option<DVec3>, f64) = (None, 0.0);
            for i in 0..200 {
                let x = 0.2 - 0.001 * f64::from(i);
                // The right hand a little before the left, as hands that cross are.
                let at = |sign: f64| DVec3::new(sign * x, 1.2, 0.3 - 0.01 * sign);
                let mut hands = [
                    placed(Side::Left, at(1.0), left),
                    placed(Side::Right, at(-1.0), right),
                ];
                let apart = contact.apart([&hands[0], &hands[1]], [DVec3::X, DVec3::Z]);
                hands[0].wrist += apart * 0.5;
                hands[1].wrist -= apart * 0.5;
                let [a, b] = [0, 1].map(|k| contact.hands[k].capsules(&hands[k]));
                let pairs = a.iter().flat_map(|a| b.iter().map(move |b| (a, b)));
                let deepest = pairs
                    .map(|(a, b)| a.depth_m(b, DVec3::ZERO))
                    .fold(f64::MIN, f64::max);
                assert!(deepest < 0.004, "{normal} {x}: {deepest}");
                // The hands approach by 2 mm; each hand moves by half of this.
                if let Some(last) = last {
                    worst = worst.max(apart.distance(last));
                }
                last = Some(apart);
            }
            // No jump: by less than the thickness of a finger.
            assert!(worst < 0.03, "{normal}: {worst}");
            assert!(
                last.is_some_and(|v| v.length() > 0.01),
                "the separated hands slide"
            );
        }
    }
}
