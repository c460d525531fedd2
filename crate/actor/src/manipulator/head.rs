//! Head manipulator with five joints: two of the neck place the skull, three of the skull turn it
//! (GEVH section 3.3.2.2).

use core::f64::consts::PI;

use raconteur_base::{DAffine3, DMat3, DQuat, DVec3, Length, ops};
use raconteur_body::{Bone, Pose, Skeleton};

use crate::kinematics::{rotation_of, world_from_bone};
use crate::limb::chain::{LimbBase, PosedLimb};
use crate::limb::limits::{self, Limit, Sex};
use crate::limb::solve::Solutions;
use crate::limb::{Joints, Limb, RigidFrame};

/// Neck and skull of a figure as a manipulator with five joints. The base has the body's axes: x
/// left, y up, z front.
#[derive(Clone, Debug)]
pub struct HeadRig {
    limits: [Limit; 7],
    thorax_zero: DQuat,
    neck_in_thorax: DVec3,
    /// The skull's joint from the neck's, body axes, upright, metres.
    skull_from_neck: DVec3,
    neck_zero: DQuat,
    /// Body axes from neck and from skull in the zero pose.
    body_from_neck: DQuat,
    body_from_skull: DQuat,
}

/// The bones that the head's joints turn.
pub(super) const HEAD_BONES: [Bone; 2] = [Bone::Cervical, Bone::Skull];

impl HeadRig {
    /// Measures neck and skull of a skeleton.
    #[must_use]
    pub fn new(skeleton: &Skeleton, sex: Sex) -> Self {
        let zero = Pose::zero();
        let [neck, skull] = HEAD_BONES.map(|b| world_from_bone(skeleton, &zero, b));
        let joint = &skeleton.joints()[Bone::Cervical.index()];
        Self {
            limits: limits::limits(Limb::Head, sex),
            thorax_zero: rotation_of(&world_from_bone(skeleton, &zero, Bone::Thoracic)),
            neck_in_thorax: joint.translation_in_parent,
            skull_from_neck: skull.translation - neck.translation,
            neck_zero: joint.zero_rotation,
            body_from_neck: rotation_of(&neck),
            body_from_skull: rotation_of(&skull),
        }
    }

    /// Returns the limits of the joint angles, radians.
    #[must_use]
    pub fn limits(&self) -> &[Limit; 7] {
        &self.limits
    }

    /// Returns the base of the manipulator on a thorax, figure axes.
    #[must_use]
    pub fn base(&self, thorax: &DAffine3) -> LimbBase {
        let parent = rotation_of(thorax);
        LimbBase {
            origin: thorax.transform_point3(self.neck_in_thorax),
            rotation: parent * self.thorax_zero.inverse(),
            parent,
        }
    }

    fn neck_turn(joints: &Joints) -> DQuat {
        DQuat::from_rotation_z(-joints[0]) * DQuat::from_rotation_x(joints[1])
    }

    fn skull_turn(joints: &Joints) -> DQuat {
        DQuat::from_rotation_y(joints[2])
            * DQuat::from_rotation_x(joints[3])
            * DQuat::from_rotation_z(-joints[4])
    }

    /// Returns the largest turn of a bone between two sets of joints, radians.
    pub(super) fn turned(&self, from: &Joints, to: &Joints) -> f64 {
        let neck = Self::neck_turn(from).angle_between(Self::neck_turn(to));
        neck.max(Self::skull_turn(from).angle_between(Self::skull_turn(to)))
    }

    /// Computes forward kinematics: local rotations of neck and skull, and the frame of the skull.
    #[must_use]
    pub fn posed(&self, joints: &Joints, base: &LimbBase) -> PosedLimb {
        let neck = Self::neck_turn(joints);
        let turn = Self::skull_turn(joints);
        let neck_in_figure = base.rotation * neck * self.body_from_neck;
        let local = self.body_from_skull.inverse() * turn * self.body_from_skull;
        PosedLimb {
            rotations: [
                ((base.parent * self.neck_zero).inverse() * neck_in_figure).normalized(),
                local.normalized(),
                DQuat::IDENTITY,
            ],
            frame: RigidFrame {
                position: base.origin + base.rotation * neck * self.skull_from_neck,
                rotation: (base.rotation * neck * turn).normalized(),
            },
        }
    }

    /// Returns the joint angles of bones posed by [`HeadRig::posed`]; for other rotations the
    /// nearest: the neck has no twist here.
    #[must_use]
    pub fn joints_of(&self, rotations: [DQuat; 2], base: &LimbBase) -> Solutions {
        let neck = base.parent * self.neck_zero * rotations[0] * self.body_from_neck.inverse();
        let skull = neck * self.body_from_skull * rotations[1] * self.body_from_skull.inverse();
        let target = RigidFrame {
            position: base.origin + neck * self.skull_from_neck,
            rotation: skull,
        };
        self.solutions(&target, base, false)
    }

    /// Projects a position of the skull's joint (from the base, metres) onto the sphere about the
    /// neck, and returns true if it moved.
    #[must_use]
    pub fn projected(&self, from_base: DVec3) -> (DVec3, bool) {
        let radius = self.skull_from_neck.magnitude();
        let direction = from_base.try_normalized().unwrap_or(DVec3::Y);
        let moved = (from_base.magnitude() - radius).abs() > 1e-9;
        (direction * radius, moved)
    }

    /// Clamps a target to the range of the neck by the weight of the limits (`limited`, 0..1),
    /// preserving its orientation: the skull compensates for the neck, and stays still while the
    /// neck is stopped.
    #[must_use]
    pub(super) fn clamp_target(
        &self,
        target: &RigidFrame,
        base: &LimbBase,
        limited: f64,
    ) -> RigidFrame {
        let (near, _) = self.projected(target.position - base.origin);
        let on_sphere = RigidFrame {
            position: base.origin + near,
            ..*target
        };
        let found = self.solutions(&on_sphere, base, true);
        found.as_slice().first().map_or(on_sphere, |joints| {
            let kept = limits::clamp_joints(&self.limits, limited, joints);
            RigidFrame {
                position: self.posed(&kept, base).frame.position,
                ..*target
            }
        })
    }

    /// Returns all four solutions, or the one that no limit excludes, with the neck upright. The
    /// target lies on the sphere about the neck; where the neck cannot point, the nearest is taken.
    #[must_use]
    pub fn solutions(&self, target: &RigidFrame, base: &LimbBase, natural_only: bool) -> Solutions {
        let mut found = Solutions::default();
        let p = base.rotation.inverse() * (target.position - base.origin);
        let arm = self.skull_from_neck;
        let level = (arm.y * arm.y + arm.z * arm.z).sqrt().max(1e-9);
        let lean = ops::asin_clamped(p.z / level);
        let own = ops::atan2(arm.z, arm.y);
        let ways = if natural_only { 1 } else { 2 };
        for raised in [lean, PI - lean].into_iter().take(ways) {
            let up = level * ops::cos(raised);
            let tilt = ops::atan2(up, arm.x) - ops::atan2(p.y, p.x);
            let mut joints = Joints::default();
            joints[0] = ops::wrap_angle(tilt);
            joints[1] = ops::wrap_angle(raised - own);
            let neck = base.rotation * Self::neck_turn(&joints);
            let skull = turn_angles(neck.inverse() * target.rotation);
            for skull in skull.into_iter().take(ways) {
                joints[2..5].copy_from_slice(&skull);
                found.push(joints);
            }
        }
        found
    }

    /// Returns the axis of each joint of neck and skull and a point on it, figure axes; the
    /// Jacobian for inverse velocity uses them.
    pub(super) fn axes(&self, joints: &Joints, base: &LimbBase) -> [(DVec3, DVec3); 7] {
        let tilted = base.rotation * DQuat::from_rotation_z(-joints[0]);
        let neck = base.rotation * Self::neck_turn(joints);
        let skull = base.origin + neck * self.skull_from_neck;
        let turned = neck * DQuat::from_rotation_y(joints[2]);
        let nodded = turned * DQuat::from_rotation_x(joints[3]);
        let none = (DVec3::ZERO, skull);
        [
            (base.rotation * DVec3::NEG_Z, base.origin),
            (tilted * DVec3::X, base.origin),
            (neck * DVec3::Y, skull),
            (turned * DVec3::X, skull),
            (nodded * DVec3::NEG_Z, skull),
            none,
            none,
        ]
    }
}

/// Returns both solutions for turn, nod and tilt of a skull rotation, radians.
fn turn_angles(turn: DQuat) -> [[f64; 3]; 2] {
    let m = DMat3::from_quat(turn);
    let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
    let level = (z.x * z.x + z.z * z.z).sqrt();
    let nod = ops::atan2(-z.y, level);
    // In a vertical gaze, turn and tilt share one axis; the tilt takes the whole rotation.
    let (a, c) = if level > 1e-9 {
        (ops::atan2(z.x, z.z), ops::atan2(x.y, y.y))
    } else {
        (0.0, ops::atan2(-y.x, x.x))
    };
    let wrap = ops::wrap_angle;
    [
        [wrap(a), nod, -wrap(c)],
        [wrap(a + PI), wrap(PI - nod), -wrap(c + PI)],
    ]
}
