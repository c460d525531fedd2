//! The arm's inverse kinematics: wrist position and hand rotation to joint rotations, in
//! closed form (GEVH section 3.3.2.1: two links and a spherical wrist; targets outside the
//! workspace are projected onto it).
//!
//! Three freedoms are left to comfort and are smooth functions of the target:
//! - the girdle rises and reaches with the arm (a share of scapulohumeral rhythm);
//! - the elbow's swivel: the elbow direction that is natural for a hand held in front,
//!   carried along to the target's direction by the smallest rotation, so that it points
//!   back when the arm hangs and forward when it is raised; its only singularity lies
//!   behind the back. Pronation the forearm lacks lifts the elbow, as people do;
//! - a hand rotation that the wrist cannot reach is brought back to its limits.

use std::sync::Arc;

use raconteur_base::curve::smooth;
use raconteur_base::{DAffine3, DQuat, DVec3, Length, Side, ops};
use raconteur_body::{Bone, Pose, Skeleton};

use crate::kinematics::{TwoBone, rotation_of, world_from_bone};
pub use crate::manipulator::limits::ELBOW_MAX_DEG;
use crate::wrist::{self, WristAngles};

/// The last share of the reach, in which the elbow eases out instead of snapping: a wrist
/// there stays short of its goal by up to 0.4 of this share (2 mm). Designed.
const SOFT_SHARE: f64 = 0.01;

/// Direction, in body axes of the left side (x outwards), of a hand held in front at
/// ease, where [`ELBOW_AT_EASE`] applies; the swivel field is singular opposite to it.
const HAND_AT_EASE: DVec3 = DVec3::new(0.22, 0.12, 1.0);
/// Direction of the elbow from the line between shoulder and wrist there. Designed.
const ELBOW_AT_EASE: DVec3 = DVec3::new(0.42, -1.0, 0.0);

/// Depth to which an elbow gives way to the trunk only by and by, as a share of its half axes.
const ELBOW_EDGE: f64 = 0.2;

/// Greatest rise of the clavicle with the arm, radians: 20° of the arm's 180°. Designed, within
/// the 30° at its sternal end that Inman et al. 1944 measured.
const SCAPULA_RISE_RAD: f64 = 0.34;
/// How far below the horizontal (sine) an arm makes the scapula rise, and the range in
/// which the rise becomes complete. Designed: an arm that hangs leaves it down.
const SCAPULA_RISE_FROM: f64 = 0.3;
const SCAPULA_RISE_RANGE: f64 = 1.25;
/// Distance of the wrist, as a share of the reach, from which the scapula rises, and the range
/// in which the rise becomes complete. Designed.
const SCAPULA_RISE_REACH: [f64; 2] = [0.35, 0.6];
/// Greatest protraction of the scapula for a direction of unit weight, radians. Designed.
const SCAPULA_PROTRACTION_RAD: f64 = 0.2;
/// Weights in the protraction of a wrist in front and of one across the chest. Designed.
const PROTRACTION_AHEAD: f64 = 0.7;
const PROTRACTION_ACROSS: f64 = 0.5;
/// Distance of the wrist, as a share of the reach, from which the scapula protracts, and the
/// range in which the protraction becomes complete. Designed.
const SCAPULA_PROTRACTION_REACH: [f64; 2] = [0.5, 0.5];

/// Cost of a lifted elbow, per square radian, against the strain of the wrist. Designed.
const SWIVEL_COST: f64 = 0.16;
/// Middle of the comfortable range of the swivel and half its width, radians. Designed.
const SWIVEL_MIDDLE_RAD: f64 = 0.25;
const SWIVEL_HALF_RANGE_RAD: f64 = 0.85;
/// Cost of a swivel beyond the comfortable range, per square radian. Designed.
const SWIVEL_STOP_COST: f64 = 2.0;
/// Swivel that brings an elbow out of the trunk, radians for a depth of all of its half axes.
/// Designed: two passes settle it.
const SWIVEL_PER_DEPTH_RAD: f64 = 2.2;
/// Thickness of the elbow around its joint, metres. Designed.
const ELBOW_RADIUS_M: f64 = 0.04;

/// Half width and half depth of the trunk for a stature of 1.7 m, metres; measured at
/// the chest of an average adult, clothed.
pub const TRUNK_HALF_AXES_M: [f64; 2] = [0.17, 0.13];

/// The target of an arm.
#[derive(Clone, Copy, Debug)]
pub struct ArmGoal {
    /// Place of the wrist, world, metres.
    pub wrist_in_world: DVec3,
    /// Hand rotation ([`crate::palm`]); `None` leaves the wrist relaxed.
    pub hand_in_world: Option<DQuat>,
    /// Extra rise of the shoulder, radians: breath and shrugs.
    pub shrug_rad: f64,
}

/// Local rotations of one arm's bones and how well they meet the goal.
#[derive(Clone, Copy, Debug)]
pub struct ArmSolution {
    /// Rotation of the scapula bone.
    pub scapula: DQuat,
    /// Rotation of the shoulder.
    pub shoulder: DQuat,
    /// Rotation of the elbow: flexion only.
    pub elbow: DQuat,
    /// Rotation of the wrist; its twist about x is the forearm's pronation.
    pub wrist: DQuat,
    /// Elbow, world, metres.
    pub elbow_in_world: DVec3,
    /// Distance between the wrist and its goal, metres.
    pub error_m: f64,
    /// Angle between the hand and its goal, radians; 0 without a wanted rotation.
    pub hand_error_rad: f64,
    /// Whether the wrist position lies in the workspace: the error is then below 1e-9 m, or
    /// up to 2 mm in the last hundredth of the reach, where the elbow eases out.
    pub reached: bool,
}

impl ArmSolution {
    /// Writes the rotations into a pose.
    pub fn apply(&self, side: Side, pose: &mut Pose) {
        let [scapula, shoulder, elbow, wrist] = ARM_BONES[side.index()];
        pose.set(scapula, self.scapula);
        pose.set(shoulder, self.shoulder);
        pose.set(elbow, self.elbow);
        pose.set(wrist, self.wrist);
    }
}

/// Scapula, shoulder, elbow and wrist of the left and right side.
pub const ARM_BONES: [[Bone; 4]; 2] = [
    [Bone::LScapula, Bone::LShoulder, Bone::LElbow, Bone::LWrist],
    [Bone::RScapula, Bone::RShoulder, Bone::RElbow, Bone::RWrist],
];

/// One arm of a figure: everything about it that does not change with the pose.
#[derive(Clone, Debug)]
pub struct ArmRig {
    side: Side,
    chain: TwoBone,
    scapula_in_thorax: DVec3,
    shoulder_in_scapula: DVec3,
    thorax_zero: DQuat,
    scapula_zero: DQuat,
    shoulder_zero: DQuat,
    elbow_zero: DQuat,
    wrist_zero: DQuat,
    /// World from wrist in the zero pose.
    wrist_zero_in_world: DQuat,
    thorax_zero_in_world: DAffine3,
    /// Shoulder in the zero pose, world, metres.
    shoulder_in_world: DVec3,
    trunk_half_axes_m: [f64; 2],
}

impl ArmRig {
    /// Measures both arms of a skeleton, left and right; shared by all that move them.
    #[must_use]
    pub fn both(skeleton: &Skeleton) -> [Arc<Self>; 2] {
        Side::BOTH.map(|side| Arc::new(Self::new(skeleton, side)))
    }

    /// The side that the arm is on.
    #[must_use]
    pub fn side(&self) -> Side {
        self.side
    }

    /// Measures one arm of a skeleton.
    #[must_use]
    pub fn new(skeleton: &Skeleton, side: Side) -> Self {
        let [scapula, shoulder, elbow, wrist] = ARM_BONES[side.index()].map(Bone::index);
        let joints = skeleton.joints();
        let zero = Pose::zero();
        let scale = skeleton.stature_m() / 1.7;
        Self {
            side,
            chain: TwoBone::new(
                joints[elbow].translation_in_parent,
                joints[wrist].translation_in_parent,
                joints[elbow].zero_rotation,
                DVec3::Z,
                ELBOW_MAX_DEG.to_radians(),
            ),
            scapula_in_thorax: joints[scapula].translation_in_parent,
            shoulder_in_scapula: joints[shoulder].translation_in_parent,
            thorax_zero: rotation_of(&world_from_bone(skeleton, &zero, Bone::Thoracic)),
            scapula_zero: joints[scapula].zero_rotation,
            shoulder_zero: joints[shoulder].zero_rotation,
            elbow_zero: joints[elbow].zero_rotation,
            wrist_zero: joints[wrist].zero_rotation,
            wrist_zero_in_world: rotation_of(&world_from_bone(skeleton, &zero, Bone::ALL[wrist])),
            thorax_zero_in_world: world_from_bone(skeleton, &zero, Bone::Thoracic),
            shoulder_in_world: world_from_bone(skeleton, &zero, Bone::ALL[shoulder]).translation,
            trunk_half_axes_m: TRUNK_HALF_AXES_M.map(|a| a * scale),
        }
    }

    /// Upper arm and forearm stretched, metres.
    #[must_use]
    pub fn reach_m(&self) -> f64 {
        self.chain.reach_m()
    }

    /// Shoulder joint of the zero pose, world, metres.
    #[must_use]
    pub fn shoulder_in_world(&self) -> DVec3 {
        self.shoulder_in_world
    }

    /// World from thorax in the zero pose.
    #[must_use]
    pub fn world_from_thorax_zero(&self) -> DAffine3 {
        self.thorax_zero_in_world
    }

    /// Solves for a goal with the thorax where it is.
    #[must_use]
    pub fn solve(&self, world_from_thorax: &DAffine3, goal: &ArmGoal) -> ArmSolution {
        let thorax = rotation_of(world_from_thorax);
        let world_from_body = thorax * self.thorax_zero.inverse();

        let scapula = self.scapula_for(world_from_thorax, goal.wrist_in_world, goal.shrug_rad);
        let scapula_in_world = thorax * self.scapula_zero * scapula;
        let shoulder_at = world_from_thorax.transform_point3(self.scapula_in_thorax)
            + scapula_in_world * self.shoulder_in_scapula;

        let wanted = goal.wrist_in_world - shoulder_at;
        let distance = wanted.magnitude();
        let direction = wanted
            .try_normalized()
            .unwrap_or(world_from_body * DVec3::NEG_Y);
        let flexion = self.chain.flexion_for(self.softened(distance));
        let error_m = (self.chain.distance_m(flexion) - distance).abs();

        let arm = Posture {
            rig: self,
            shoulder_at,
            world_from_body,
            direction,
            flexion,
        };
        let swivel = self.swivel_for(&arm, goal.hand_in_world);
        let shoulder_in_world = arm.shoulder_in_world(swivel);
        let elbow = self.chain.flexed(flexion);
        let before_wrist = shoulder_in_world * self.elbow_zero * elbow * self.wrist_zero;
        let (wrist, hand_error_rad) = match goal.hand_in_world {
            None => (DQuat::IDENTITY, 0.0),
            Some(hand) => {
                let local = before_wrist.inverse() * (hand * self.wrist_zero_in_world);
                let limited = wrist::limited(self.side, local);
                (limited, limited.angle_between(local))
            }
        };
        ArmSolution {
            scapula,
            shoulder: ((scapula_in_world * self.shoulder_zero).inverse() * shoulder_in_world)
                .normalized(),
            elbow,
            wrist,
            elbow_in_world: arm.elbow_in_world(swivel),
            error_m,
            hand_error_rad,
            reached: distance <= self.reach_m() && error_m < SOFT_SHARE * self.reach_m(),
        }
    }

    /// `wrist_in_world`, or, where that is far out of reach, the nearest place that is only
    /// a little out of reach (3 %, more than the trunk sways) with the thorax of the zero
    /// pose: hands then slow down for it instead of running into the end of the arm.
    #[must_use]
    pub fn within_reach(&self, wrist_in_world: DVec3) -> DVec3 {
        let thorax = self.thorax_zero_in_world;
        let scapula = self.scapula_for(&thorax, wrist_in_world, 0.0);
        let shoulder_at = self.shoulder_at(&thorax, scapula);
        let to = wrist_in_world - shoulder_at;
        let most = 1.03 * self.reach_m();
        if to.magnitude() <= most {
            wrist_in_world
        } else {
            shoulder_at + to.clamp_length_max(most)
        }
    }

    /// A distance eased towards the reach: a stretching elbow would otherwise snap, since
    /// its angle changes ever faster up to the end of the reach.
    fn softened(&self, distance_m: f64) -> f64 {
        let rest = SOFT_SHARE * self.reach_m();
        let over = distance_m - (self.reach_m() - rest);
        if over <= 0.0 {
            distance_m
        } else {
            distance_m - over + rest * (1.0 - ops::exp(-over / rest))
        }
    }

    /// Hand rotation of a relaxed wrist at this place, with the thorax of the zero pose:
    /// what a keyframe without a palm gets.
    #[must_use]
    pub fn relaxed_hand(&self, wrist_in_world: DVec3) -> DQuat {
        self.hand_from_angles(wrist_in_world, &WristAngles::relaxed(self.side))
    }

    /// A hand rotation at a place as wrist angles of a natural arm, thorax in the zero pose.
    #[must_use]
    pub fn angles_of_hand(&self, wrist_in_world: DVec3, hand_in_world: DQuat) -> WristAngles {
        let forearm = self.natural_forearm(wrist_in_world);
        let local = forearm.inverse() * (hand_in_world * self.wrist_zero_in_world);
        WristAngles::of(self.side, local)
    }

    /// The inverse of [`ArmRig::angles_of_hand`].
    #[must_use]
    pub fn hand_from_angles(&self, wrist_in_world: DVec3, angles: &WristAngles) -> DQuat {
        let local = angles.rotation(self.side);
        let forearm = self.natural_forearm(wrist_in_world);
        (forearm * local * self.wrist_zero_in_world.inverse()).normalized()
    }

    /// World from wrist with an unturned wrist and the natural swivel.
    fn natural_forearm(&self, wrist_in_world: DVec3) -> DQuat {
        let goal = ArmGoal {
            wrist_in_world,
            hand_in_world: None,
            shrug_rad: 0.0,
        };
        let thorax = self.thorax_zero_in_world;
        let s = self.solve(&thorax, &goal);
        let scapula = rotation_of(&thorax) * self.scapula_zero * s.scapula;
        scapula * self.shoulder_zero * s.shoulder * self.elbow_zero * s.elbow * self.wrist_zero
    }

    /// The shoulder joint with the thorax and the scapula turned so, world, metres.
    #[must_use]
    pub fn shoulder_at(&self, world_from_thorax: &DAffine3, scapula: DQuat) -> DVec3 {
        world_from_thorax.transform_point3(
            self.scapula_in_thorax + self.scapula_zero * (scapula * self.shoulder_in_scapula),
        )
    }

    /// World from the scapula bone turned so, its rotation.
    #[must_use]
    pub fn scapula_in_world(&self, thorax: DQuat, scapula: DQuat) -> DQuat {
        thorax * self.scapula_zero * scapula
    }

    /// Rotation of the scapula bone for a wrist: the girdle rises and reaches with the arm,
    /// and by a shrug, radians.
    #[must_use]
    pub fn scapula_for(
        &self,
        world_from_thorax: &DAffine3,
        wrist_in_world: DVec3,
        shrug_rad: f64,
    ) -> DQuat {
        let base = self.shoulder_at(world_from_thorax, DQuat::IDENTITY);
        let world_from_body = rotation_of(world_from_thorax) * self.thorax_zero.inverse();
        let to = world_from_body.inverse() * (wrist_in_world - base) / self.reach_m();
        let length = to.magnitude();
        let direction = to / length.max(1e-9);
        let sign = self.side.sign();
        let stretched = share_of_range(length, SCAPULA_RISE_REACH);
        let rise = SCAPULA_RISE_RAD
            * smooth((direction.y + SCAPULA_RISE_FROM) / SCAPULA_RISE_RANGE)
            * stretched;
        let ahead = PROTRACTION_AHEAD * direction.z - PROTRACTION_ACROSS * sign * direction.x;
        let protract =
            SCAPULA_PROTRACTION_RAD * ahead * share_of_range(length, SCAPULA_PROTRACTION_REACH);
        // Local y points to the front and z down (left) or up (right); see the frames of
        // `raconteur_body::skeleton`.
        DQuat::from_rotation_z(protract) * DQuat::from_rotation_y(sign * (rise + shrug_rad))
    }

    /// Angle by which the elbow is lifted from its natural direction: some steps down
    /// [`Posture::strain`] from the natural swivel. A fixed number of smooth steps from a
    /// fixed start is a smooth function of the goal, where the exact minimum could jump.
    fn swivel_for(&self, arm: &Posture<'_>, hand_in_world: Option<DQuat>) -> f64 {
        const STEPS: usize = 8;
        const PROBE_RAD: f64 = 0.05;
        // Half the inverse of the greatest curvature of the strain: steps never overshoot.
        const GAIN: f64 = 0.11;
        let mut swivel = 0.0;
        if let Some(hand) = hand_in_world {
            for _ in 0..STEPS {
                let [low, high] = [-PROBE_RAD, PROBE_RAD].map(|d| arm.strain(swivel + d, hand));
                swivel -= GAIN * (high - low) / (2.0 * PROBE_RAD);
            }
        }
        // An elbow inside the trunk is lifted out.
        for _ in 0..2 {
            swivel += SWIVEL_PER_DEPTH_RAD * self.elbow_depth(arm.elbow_in_body(swivel));
        }
        swivel
    }

    /// How deep an elbow (body axes from the thorax's zero place, metres) lies in the
    /// trunk, as a share of its half axes; 0 outside.
    fn elbow_depth(&self, elbow: DVec3) -> f64 {
        let [half_width, half_depth] = self.trunk_half_axes_m;
        let x = elbow.x / (half_width + ELBOW_RADIUS_M);
        let z = elbow.z / (half_depth + ELBOW_RADIUS_M);
        let over = 1.0 - ops::hypot(x, z);
        // Eased, so that an elbow that meets the trunk slides and does not bounce.
        if over <= 0.0 {
            0.0
        } else if over < ELBOW_EDGE {
            over * over / (2.0 * ELBOW_EDGE)
        } else {
            over - 0.5 * ELBOW_EDGE
        }
    }
}

/// The joints of an arm that place its wrist, for interpolation by joint.
#[derive(Clone, Copy, Debug)]
pub struct ArmPosture {
    /// Rotation of the scapula bone.
    scapula: DQuat,
    /// Rotation of the shoulder.
    shoulder: DQuat,
    /// Flexion of the elbow, radians.
    flexion_rad: f64,
}

impl ArmPosture {
    /// The posture a share of the way to another; shares beyond 0..1 go on beyond the ends.
    #[must_use]
    pub fn lerp(&self, to: &Self, s: f64) -> Self {
        Self {
            scapula: self.scapula.slerp(to.scapula, s).normalized(),
            shoulder: self.shoulder.slerp(to.shoulder, s).normalized(),
            flexion_rad: self.flexion_rad + (to.flexion_rad - self.flexion_rad) * s,
        }
    }
}

impl ArmRig {
    /// The natural posture for a wrist, with the thorax of the zero pose.
    #[must_use]
    pub fn posture(&self, wrist_in_world: DVec3) -> ArmPosture {
        let goal = ArmGoal {
            wrist_in_world,
            hand_in_world: None,
            shrug_rad: 0.0,
        };
        let solution = self.solve(&self.thorax_zero_in_world, &goal);
        ArmPosture {
            scapula: solution.scapula,
            shoulder: solution.shoulder,
            // The hinge of the elbow is its z axis.
            flexion_rad: 2.0 * ops::atan2(solution.elbow.z, solution.elbow.w),
        }
    }

    /// The hand rotation of a solution: what was wanted, as far as the wrist could.
    #[must_use]
    pub fn hand_of(&self, world_from_thorax: &DAffine3, s: &ArmSolution) -> DQuat {
        let scapula = rotation_of(world_from_thorax) * self.scapula_zero * s.scapula;
        let forearm = scapula * self.shoulder_zero * s.shoulder * self.elbow_zero * s.elbow;
        let hand = forearm * self.wrist_zero * s.wrist * self.wrist_zero_in_world.inverse();
        hand.normalized()
    }

    /// Where a posture puts the wrist, with the thorax of the zero pose, world, metres.
    #[must_use]
    pub fn wrist_of(&self, posture: &ArmPosture) -> DVec3 {
        let thorax = &self.thorax_zero_in_world;
        let scapula = rotation_of(thorax) * self.scapula_zero * posture.scapula;
        let shoulder = scapula * self.shoulder_zero * posture.shoulder;
        thorax.transform_point3(self.scapula_in_thorax)
            + scapula * self.shoulder_in_scapula
            + shoulder * self.chain.end_in_upper(posture.flexion_rad)
    }
}

/// 0 up to the start of a range and 1 after it, smooth in between; `range` is start and length.
fn share_of_range(value: f64, [start, length]: [f64; 2]) -> f64 {
    smooth((value - start) / length)
}

/// Direction of the elbow from the line between shoulder and wrist that is natural for a
/// wrist in a direction (unit) from the shoulder, both in body axes; not unit.
#[must_use]
pub fn natural_elbow(side: Side, direction_in_body: DVec3) -> DVec3 {
    let mirrored = |v: DVec3| DVec3::new(v.x * side.sign(), v.y, v.z);
    let ease = mirrored(HAND_AT_EASE).normalized();
    DQuat::from_rotation_arc(ease, direction_in_body) * mirrored(ELBOW_AT_EASE)
}

/// An arm with its target direction and flexion; only the swivel is open.
struct Posture<'a> {
    rig: &'a ArmRig,
    shoulder_at: DVec3,
    world_from_body: DQuat,
    direction: DVec3,
    flexion: f64,
}

impl Posture<'_> {
    /// Direction of the elbow from the line between shoulder and wrist, world.
    fn pole(&self, swivel_rad: f64) -> DVec3 {
        let sign = self.rig.side.sign();
        let direction_in_body = self.world_from_body.inverse() * self.direction;
        let carried = natural_elbow(self.rig.side, direction_in_body);
        let lifted = DQuat::from_axis_angle(direction_in_body, sign * swivel_rad) * carried;
        self.world_from_body * lifted
    }

    fn shoulder_in_world(&self, swivel_rad: f64) -> DQuat {
        self.rig
            .chain
            .aim(self.flexion, self.direction, self.pole(swivel_rad))
    }

    fn elbow_in_world(&self, swivel_rad: f64) -> DVec3 {
        self.shoulder_at + self.shoulder_in_world(swivel_rad) * self.rig.chain.hinge()
    }

    /// What a swivel costs: strain of the wrist, and distance from the natural elbow.
    fn strain(&self, swivel_rad: f64, hand_in_world: DQuat) -> f64 {
        let rig = self.rig;
        let before = self.shoulder_in_world(swivel_rad)
            * rig.elbow_zero
            * rig.chain.flexed(self.flexion)
            * rig.wrist_zero;
        let wrist = wrist::strain(
            rig.side,
            before.inverse() * (hand_in_world * rig.wrist_zero_in_world),
        );
        // Far lifts are worth less and less: a stop, rounded.
        let stop = ((swivel_rad - SWIVEL_MIDDLE_RAD).abs() - SWIVEL_HALF_RANGE_RAD).max(0.0);
        wrist + SWIVEL_COST * swivel_rad * swivel_rad + SWIVEL_STOP_COST * stop * stop
    }

    /// Elbow relative to the trunk's axis, in body axes.
    fn elbow_in_body(&self, swivel_rad: f64) -> DVec3 {
        let from_shoulder = self.elbow_in_world(swivel_rad) - self.shoulder_at;
        // The trunk's axis runs through the shoulders' midpoint.
        self.world_from_body.inverse() * from_shoulder
            + DVec3::new(self.rig.shoulder_in_world.x, 0.0, 0.0)
    }
}

#[cfg(test)]
mod tests;
