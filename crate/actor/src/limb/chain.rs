//! Limb: its joints on the bones of a figure.
//!
//! GEVH table 3.1 in the axes of this module: in the base, x is down, y left and z front. Joint 1
//! turns about z (abduction), joints 2 and 3 about the sideways axis (flexion of shoulder and
//! elbow), joint 4 about the forearm, joints 5 and 6 about the two axes across the wrist. The
//! seventh turns the upper bone about itself. Bones of real figures do not lie exactly on the
//! table's axes; the offsets are stored, so that the skeleton's joint is at the solved position.

use core::f64::consts::{FRAC_PI_2, PI};

use raconteur_base::{DAffine3, DMat3, DQuat, DVec3, Length, Side, ops};
use raconteur_body::{Bone, Pose, Skeleton};

use super::limits::{self, Limit, Sex};
use super::two_bone::TwoBone;
use super::{ARM_BONES, Joints, LEG_BONES, Limb, RigidFrame};
use crate::kinematics::{rotation_of, world_from_bone};

/// Index of the seventh joint, the axial rotation of the upper bone, in [`Joints`].
pub const ROLL: usize = 6;
/// Joints of wrist or ankle.
pub(crate) const END: core::ops::Range<usize> = 3..ROLL;

/// Base frame of a limb at one time, figure axes; joint angles are measured from it.
#[derive(Clone, Copy, Debug)]
pub struct LimbBase {
    /// The first joint, metres.
    pub origin: DVec3,
    /// Axes of the base: those of the trunk, not of the girdle.
    pub rotation: DQuat,
    /// Rotation of the bone that the first bone hangs on.
    pub parent: DQuat,
}

/// Result of forward kinematics of a limb: local rotations of its three bones and the frame of its
/// end.
#[derive(Clone, Copy, Debug)]
pub struct PosedLimb {
    /// Local rotations of the upper, lower and end bone.
    pub rotations: [DQuat; 3],
    /// Frame of the end, figure axes.
    pub frame: RigidFrame,
}

/// Measures of one limb (arm or leg) of a figure that do not depend on the pose; converts between
/// joint angles, bone rotations and targets.
#[derive(Clone, Debug)]
pub struct LimbRig {
    /// Upper, lower and end bone.
    pub bones: [Bone; 3],
    /// +1 on the left, −1 on the right.
    pub(super) sign: f64,
    pub(super) is_arm: bool,
    pub(super) chain: TwoBone,
    pub(super) limits: [Limit; 7],
    trunk: Bone,
    trunk_zero: DQuat,
    origin_in_trunk: DVec3,
    pub(super) upper_zero: DQuat,
    /// The table's second frame (x along the upper bone, z its hinge) from the upper bone.
    pub(super) link_from_upper: DQuat,
    /// Target frame from end bone.
    pub(super) target_from_end: DQuat,
    /// Lower bone from target frame while joints 4 to 6 are zero.
    pub(super) lower_from_target: DQuat,
    /// Target frame in the zero pose: world from target.
    target_zero: DQuat,
    end_zero: DQuat,
}

/// Returns world from the base's axes for an upright body.
fn base_axes() -> DQuat {
    DQuat::from_rotation_z(-FRAC_PI_2)
}

impl LimbRig {
    /// Measures an arm or a leg of a skeleton.
    #[must_use]
    pub fn new(skeleton: &Skeleton, side: Side, is_arm: bool, sex: Sex) -> Self {
        let sign = side.sign();
        let zero = Pose::zero();
        let in_world = |bone: Bone| rotation_of(&world_from_bone(skeleton, &zero, bone));
        let (limb, trunk, bones) = if is_arm {
            let [_, shoulder, elbow, wrist] = ARM_BONES[side.index()];
            let limb = [Limb::LeftArm, Limb::RightArm][side.index()];
            (limb, Bone::Thoracic, [shoulder, elbow, wrist])
        } else {
            let limb = [Limb::LeftLeg, Limb::RightLeg][side.index()];
            (limb, Bone::Sacroiliac, LEG_BONES[side.index()])
        };
        let limits = limits::limits(limb, sex);
        let [upper, lower, end] = bones.map(|b| &skeleton.joints()[b.index()]);
        // A positive turn bends the elbow forwards, and about the figure's left the knee
        // backwards.
        let axis = if is_arm {
            DVec3::Z
        } else {
            in_world(bones[1]).inverse() * DVec3::X
        };
        let chain = TwoBone::new(
            lower.translation_in_parent,
            end.translation_in_parent,
            lower.zero_rotation,
            axis,
            limits[2].max_rad,
        );
        // The zero pose has arms stretched out sideways and standing legs.
        let lifted = if is_arm { sign * FRAC_PI_2 } else { 0.0 };
        let target_zero = base_axes() * DQuat::from_rotation_z(lifted);
        let link_zero = target_zero * DQuat::from_rotation_x(FRAC_PI_2);
        let target_from_end = target_zero.inverse() * in_world(bones[2]);
        Self {
            bones,
            sign,
            is_arm,
            chain,
            limits,
            trunk,
            trunk_zero: in_world(trunk),
            origin_in_trunk: upper.translation_in_parent,
            upper_zero: upper.zero_rotation,
            link_from_upper: link_zero.inverse() * in_world(bones[0]),
            target_from_end,
            lower_from_target: end.zero_rotation * target_from_end.inverse(),
            target_zero,
            end_zero: end.zero_rotation,
        }
    }

    /// Returns the base of the manipulator for a trunk pose and, for an arm, a girdle pose
    /// (rotation of the scapula bone and position of the shoulder joint, figure axes).
    #[must_use]
    pub fn base(&self, trunk: &DAffine3, girdle: Option<(DQuat, DVec3)>) -> LimbBase {
        let turned = rotation_of(trunk);
        let (parent, origin) =
            girdle.unwrap_or((turned, trunk.transform_point3(self.origin_in_trunk)));
        LimbBase {
            origin,
            rotation: turned * self.trunk_zero.inverse() * base_axes(),
            parent,
        }
    }

    /// Returns the transform from the trunk bone that carries the limb to figure axes in a pose.
    #[must_use]
    pub fn trunk(&self, skeleton: &Skeleton, pose: &Pose) -> DAffine3 {
        world_from_bone(skeleton, pose, self.trunk)
    }

    /// Returns the limits of the seven joint angles.
    #[must_use]
    pub fn limits(&self) -> &[Limit; 7] {
        &self.limits
    }

    /// Returns the shortest and longest distance between base and end of the limb, metres;
    /// `within_limits` respects the joint limits.
    #[must_use]
    pub fn distances_m(&self, within_limits: bool) -> [f64; 2] {
        self.chain.distances_m(within_limits)
    }

    /// Returns the signs that convert the table's joints to [`Joints`], which mirror each other.
    fn signs(&self) -> [f64; 7] {
        let s = self.sign;
        if self.is_arm {
            [s, 1.0, 1.0, s, 1.0, -s, s]
        } else {
            [s, 1.0, 1.0, s, -1.0, s, s]
        }
    }

    /// Returns the rotation of the upper bone's link for joint angles 1, 2 and 7, base frame.
    pub(crate) fn link(&self, joints: &Joints) -> DQuat {
        let s = self.signs();
        DQuat::from_rotation_z(s[0] * joints[0])
            * DQuat::from_rotation_x(FRAC_PI_2)
            * DQuat::from_rotation_z(joints[1])
            * DQuat::from_rotation_x(s[ROLL] * joints[ROLL])
    }

    /// Returns the rotation of wrist or ankle for joint angles 4, 5 and 6, in the axes of the
    /// target frame.
    pub(super) fn turn(&self, joints: &Joints) -> DQuat {
        let s = self.signs();
        DQuat::from_rotation_x(s[3] * joints[3])
            * DQuat::from_rotation_y(-s[4] * joints[4])
            * DQuat::from_rotation_z(s[5] * joints[5])
    }

    /// Returns the largest turn of a bone between two sets of joints, radians.
    pub(crate) fn turned(&self, from: &Joints, to: &Joints) -> f64 {
        let upper = self.link(from).angle_between(self.link(to));
        let end = self.turn(from).angle_between(self.turn(to));
        let bend = ops::wrap_angle(from[2] - to[2]).abs();
        upper.max(end).max(bend)
    }

    /// Computes the forward kinematics: bone rotations and end frame for joint angles.
    #[must_use]
    pub fn posed(&self, joints: &Joints, base: &LimbBase) -> PosedLimb {
        let upper = base.rotation * self.link(joints) * self.link_from_upper;
        let lower_local = self.chain.flexed(joints[2]);
        let lower = upper * self.chain.zero() * lower_local;
        let turn = self.turn(joints);
        PosedLimb {
            rotations: [
                ((base.parent * self.upper_zero).inverse() * upper).normalized(),
                lower_local,
                (self.target_from_end.inverse() * turn * self.target_from_end).normalized(),
            ],
            frame: RigidFrame {
                position: base.origin + upper * self.chain.end_in_upper(joints[2]),
                rotation: (lower * self.lower_from_target * turn).normalized(),
            },
        }
    }

    /// Returns the orientation of a target, figure axes, that rotates the end by `turn` from its
    /// zero pose.
    pub(super) fn target_rotation(&self, turn: DQuat) -> DQuat {
        turn * self.target_zero
    }

    /// Returns the rotation of the end from the zero pose, figure axes, from local rotations of the
    /// bones on their parent bone.
    pub(super) fn end_turn(&self, parent: DQuat, [upper, lower, end]: [DQuat; 3]) -> DQuat {
        let lower = parent * self.upper_zero * upper * self.chain.zero() * lower;
        self.turn_on(lower, end)
    }

    /// Returns the rotation of the end from its zero pose, figure axes, for the rotation of the
    /// lower bone and the local rotation `end`.
    pub(super) fn turn_on(&self, lower: DQuat, end: DQuat) -> DQuat {
        let end_in_figure = lower * self.end_zero * end;
        end_in_figure * (self.target_zero * self.target_from_end).inverse()
    }

    /// Returns the local rotation of the end bone that gives it the orientation of a target;
    /// `lower` is the rotation of the lower bone (figure axes).
    pub(super) fn end_for(&self, lower: DQuat, target: DQuat) -> DQuat {
        (lower * self.end_zero).inverse() * (target * self.target_from_end)
    }

    /// Returns the amount by which joints 4 to 6 exceed their limits for a local rotation of the
    /// end bone, by the nearer of the two solutions; radians, 0 within.
    #[must_use]
    pub fn end_beyond_limits_rad(&self, rotation: DQuat) -> f64 {
        let turn = self.target_from_end * rotation * self.target_from_end.inverse();
        let ways = self.turn_angles(turn).map(|angles| {
            let over = angles.iter().zip(&self.limits[3..ROLL]).map(|(a, limit)| {
                let angle = limit.wrapped(*a);
                (angle - angle.clamp(limit.min_rad, limit.max_rad)).abs()
            });
            over.fold(0.0, f64::max)
        });
        ways[0].min(ways[1])
    }

    /// Returns the position of elbow or knee for a local rotation of the upper bone, figure axes,
    /// metres.
    #[must_use]
    pub fn hinge_at(&self, rotation: DQuat, base: &LimbBase) -> DVec3 {
        base.origin + base.parent * self.upper_zero * rotation * self.chain.hinge()
    }

    /// Returns both solutions for joint angles 1, 2 and 7 that give the rotation `link` of the
    /// upper bone, radians.
    pub(super) fn shoulder_angles(&self, link: DQuat) -> [[f64; 3]; 2] {
        let axes = DMat3::from_quat(link);
        let d = axes.x_axis;
        let level = (d.x * d.x + d.y * d.y).sqrt();
        // Along the first axis, joint 1 and the last joint turn about the same axis; the last joint
        // takes the whole turn.
        let (c, s) = if level > 1e-9 {
            (d.x / level, d.y / level)
        } else {
            (1.0, 0.0)
        };
        let first = if level > 1e-9 {
            ops::atan2(d.y, d.x)
        } else {
            0.0
        };
        let second = ops::atan2(d.z, level);
        let across = DVec3::new(s, -c, 0.0);
        let along = DVec3::new(-c * d.z, -s * d.z, level);
        let roll = ops::atan2(axes.y_axis.dot(across), axes.y_axis.dot(along));
        let sign = self.sign;
        let out = |first: f64, second: f64, roll: f64| {
            [
                sign * ops::wrap_angle(first),
                second,
                sign * ops::wrap_angle(roll),
            ]
        };
        [
            out(first, second, roll),
            out(first + PI, ops::wrap_angle(PI - second), roll + PI),
        ]
    }

    /// Returns both solutions for joint angles 4, 5 and 6 that give the rotation `turn` of wrist or
    /// ankle, radians.
    pub(super) fn turn_angles(&self, turn: DQuat) -> [[f64; 3]; 2] {
        let m = DMat3::from_quat(turn);
        let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
        let level = (x.x * x.x + y.x * y.x).sqrt();
        let b = ops::atan2(z.x, level);
        // If joints 4 and 6 turn about one axis, joint 6 takes the whole turn.
        let (a, c) = if level > 1e-9 {
            (ops::atan2(-z.y, z.z), ops::atan2(-y.x, x.x))
        } else {
            (0.0, ops::atan2(x.y, y.y))
        };
        let s = self.signs();
        let out = |a: f64, b: f64, c: f64| {
            [
                s[3] * ops::wrap_angle(a),
                -s[4] * ops::wrap_angle(b),
                s[5] * ops::wrap_angle(c),
            ]
        };
        [out(a, b, c), out(a + PI, PI - b, c + PI)]
    }

    /// Returns the axis of each joint and a point on it, figure axes; the Jacobian for inverse
    /// velocity uses them.
    pub(crate) fn axes(&self, joints: &Joints, base: &LimbBase) -> [(DVec3, DVec3); 7] {
        let s = self.signs();
        let lifted = base.rotation * DQuat::from_rotation_z(s[0] * joints[0]);
        let link = base.rotation * self.link(joints);
        let upper = link * self.link_from_upper;
        let lower = upper * self.chain.zero() * self.chain.flexed(joints[2]);
        let elbow = base.origin + upper * self.chain.hinge();
        let wrist = base.origin + upper * self.chain.end_in_upper(joints[2]);
        let fore = lower * self.lower_from_target;
        let twisted = fore * DQuat::from_rotation_x(s[3] * joints[3]);
        let bent = twisted * DQuat::from_rotation_y(-s[4] * joints[4]);
        [
            (base.rotation * DVec3::Z * s[0], base.origin),
            (lifted * DVec3::NEG_Y, base.origin),
            (upper * self.chain.axis_in_upper(), elbow),
            (fore * DVec3::X * s[3], wrist),
            (twisted * DVec3::NEG_Y * s[4], wrist),
            (bent * DVec3::Z * s[5], wrist),
            (link * DVec3::X * s[ROLL], base.origin),
        ]
    }
}
