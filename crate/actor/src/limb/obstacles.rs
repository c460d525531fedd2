//! Obstacles of an arm: trunk and head of its figure, and the other arm.

use raconteur_base::{DAffine3, DVec3};

use super::body_space::BodySpace;

/// Radius of the arm about its bones for a stature of 1.7 m, metres: the elbow is some
/// 10 cm across, clothed.
const ARM_RADIUS_M: f64 = 0.045;
/// Clearance of an elbow from the trunk, in metres: it may touch the trunk, since flesh yields.
const ELBOW_M: f64 = 0.03;
/// Radius of the head with its hair, likewise. Head breadth and length are 15 and 19 cm.
const HEAD_RADIUS_M: f64 = 0.115;
/// Effort of an arm that intersects an obstacle by half its clearance. Designed.
const COLLISION: f64 = 3.0;
/// Share of that for the other arm, which moves faster than any other obstacle.
const OTHER_ARM: f64 = 0.3;

/// Obstacles that an arm avoids, figure axes: trunk and head of its figure, and the other forearm.
#[derive(Clone, Copy, Debug)]
pub struct Obstacles<'a> {
    /// Trunk and head of the figure.
    pub body: &'a BodySpace,
    /// Body axes of the zero pose from figure axes; the trunk is upright in them.
    pub body_from_figure: DAffine3,
    /// The middle of the head, metres.
    pub head: DVec3,
    /// Elbow and wrist of the other arm, metres; `None` if the arm is not considered.
    pub other_forearm: Option<[DVec3; 2]>,
}

/// Obstacles of an arm prepared for many distance queries: divisors are stored as factors.
pub(super) struct Clearance<'a> {
    obstacles: &'a Obstacles<'a>,
    arm_radius_m: f64,
    elbow_m: f64,
    /// Reciprocal of the squared clearance between the arm and the centre of the head.
    head: f64,
    other_arm: Option<OtherArm>,
}

/// Other forearm: elbow, forearm vector divided by its squared length, and the reciprocal squared
/// clearance between arms.
struct OtherArm {
    elbow: DVec3,
    forearm: DVec3,
    along: DVec3,
    per_square: f64,
}

impl OtherArm {
    fn depth(&self, point: DVec3) -> f64 {
        let share = (point - self.elbow).dot(self.along).clamp(0.0, 1.0);
        let near = self.elbow + self.forearm * share;
        depth(point.distance_squared(near) * self.per_square)
    }
}

impl<'a> Clearance<'a> {
    pub(super) fn new(obstacles: &'a Obstacles<'a>) -> Self {
        let scale = obstacles.body.scale();
        let inverse_square = |metres: f64| 1.0 / (metres * metres * scale * scale);
        Self {
            obstacles,
            arm_radius_m: ARM_RADIUS_M * scale,
            elbow_m: ELBOW_M * scale,
            head: inverse_square(HEAD_RADIUS_M + ARM_RADIUS_M),
            other_arm: obstacles.other_forearm.map(|[elbow, wrist]| {
                let forearm = wrist - elbow;
                OtherArm {
                    elbow,
                    forearm,
                    along: forearm / forearm.length_squared().max(1e-12),
                    per_square: inverse_square(2.0 * ARM_RADIUS_M),
                }
            }),
        }
    }

    /// Transforms a point to body axes.
    pub(super) fn in_body(&self, point: DVec3) -> DVec3 {
        self.obstacles.body_from_figure.transform_point3(point)
    }

    /// Returns the effort of an arm with shoulder, elbow and wrist at given positions, in figure
    /// axes and [body axes](Self::in_body).
    pub(super) fn effort(&self, arm: [DVec3; 3], arm_in_body: [DVec3; 3]) -> f64 {
        // The shoulder itself touches the trunk, and the wrist is at its target.
        let points = |[shoulder, elbow, wrist]: [DVec3; 3]| {
            [
                shoulder.lerp(elbow, 0.6),
                elbow,
                elbow.lerp(wrist, 0.35),
                elbow.lerp(wrist, 0.7),
            ]
        };
        let body = self.obstacles.body;
        // A hanging upper arm touches the ribs; its bone is outside them.
        let rooms = [0.0, self.elbow_m, self.arm_radius_m, self.arm_radius_m];
        let places = points(arm).into_iter().zip(points(arm_in_body)).zip(rooms);
        let mut sum = 0.0;
        for ((point, in_body), room) in places {
            let head = depth(point.distance_squared(self.obstacles.head) * self.head);
            let trunk = body.depth_in_trunk(in_body, room);
            sum += trunk * trunk + head * head;
            if let Some(other) = &self.other_arm {
                let other = other.depth(point);
                sum += OTHER_ARM * other * other;
            }
        }
        4.0 * COLLISION * sum
    }
}

/// Returns the depth inside an obstacle, 1 in its middle, from the squared distance as a share of
/// the clearance; 0 outside.
fn depth(share_squared: f64) -> f64 {
    if share_squared >= 1.0 {
        0.0
    } else {
        1.0 - share_squared.sqrt()
    }
}
