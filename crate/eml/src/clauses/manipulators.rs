//! Limb manipulators (GEVH 3.3, D.3.19 to D.3.26). Positions are in skeleton units: x to the
//! speaker's left, y up, z to the back; angles in degrees.

use super::functions::FunctionArgs;
use crate::record::{Record, Visit, record, words};

words! {
    /// A limb, or the head, as a manipulator.
    Manipulator {
        /// Arm from the left shoulder to the wrist.
        LeftArm = "leftArm",
        /// Arm from the right shoulder to the wrist.
        RightArm = "rightArm",
        /// Leg from the left hip to the ankle.
        LeftLeg = "leftLeg",
        /// Leg from the right hip to the ankle.
        RightLeg = "rightLeg",
        /// The neck and the head.
        Head = "head",
    }
}

impl Manipulator {
    /// Returns the number of its joint angles (GEVH 3.3.1).
    #[must_use]
    pub fn joints(self) -> usize {
        if self == Self::Head { 5 } else { 6 }
    }
}

record! {
    /// Configures a manipulator; `None` keeps a setting (GEVH D.3.19).
    ConfigureManipulator = "body-configure-manipulator" {
        /// Manipulator to configure.
        manipulator: Manipulator = "manipulator",
        /// Enables control of its limb.
        is_on: Option<bool> = "isOn",
        /// Enables the limits of its joints.
        joint_limits_active: Option<bool> = "jointLimitsActive",
        /// Preferred joint angles, degrees (extension); an empty list removes the preference.
        preferred_deg: Option<Vec<f64>> = "preferred",
    }
}

record! {
    /// Moves spine and shoulder girdle to a posture (extension); angles in degrees.
    Posture = "posture" {
        /// Lean of the trunk to the front.
        lean_deg: f64 = "lean",
        /// Tilt of the trunk to its left.
        tilt_deg: f64 = "tilt",
        /// Turn of the trunk to its left.
        turn_deg: f64 = "turn",
        /// Elevation of the left shoulder.
        left_shoulder_deg: f64 = "leftShoulder",
        /// Elevation of the right shoulder.
        right_shoulder_deg: f64 = "rightShoulder",
        /// Duration of the movement, seconds.
        duration_secs: f64 = "duration",
    }
}

/// Maximum magnitude of positions, angles and velocities of manipulators, in their own units: keeps
/// rounding errors harmless.
pub const MAX_COORDINATE: f64 = 1e5;

/// The names of the joint attributes.
pub(crate) const JOINTS: [&str; 6] = ["j1", "j2", "j3", "j4", "j5", "j6"];

/// Clause that sets joint angles of a limb (GEVH D.3.20).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ForwardKinematics {
    /// Limb, or the head, whose joints are set.
    pub manipulator: Manipulator,
    /// Number of joints declared in the document; none: the number of angles given.
    pub joint_count: Option<u32>,
    /// Angle of each joint in degrees; none: unchanged.
    pub joints_deg: [Option<f64>; 6],
    /// True to turn the joints smoothly; false to set them instantly (extension).
    pub is_smooth: bool,
}

/// Minimum duration of a smooth joint turn, seconds, and the angle, degrees, from which it takes
/// longer. Designed: the quickest turn that looks unhurried.
const QUICK_SECS: f64 = 0.5;
const QUICK_DEG: f64 = 90.0;

impl ForwardKinematics {
    /// Returns the effective angle of each joint, degrees, without joints beyond those of the
    /// manipulator or the document; none: unchanged.
    #[must_use]
    pub fn counted_deg(&self) -> [Option<f64>; 6] {
        let said = self.joint_count.map_or(usize::MAX, |count| count as usize);
        let count = said.min(self.manipulator.joints());
        let mut joints = self.joints_deg;
        for joint in joints.iter_mut().skip(count) {
            *joint = None;
        }
        joints
    }

    /// Returns the duration, seconds. It depends on the written angles only, since the pose of the
    /// limb is unknown before the story is timed.
    #[must_use]
    pub fn length_secs(&self) -> f64 {
        if !self.is_smooth {
            return 0.0;
        }
        let angles = self.counted_deg().into_iter().flatten();
        let widest = angles.fold(QUICK_DEG, |most, deg| most.max(deg.abs()));
        QUICK_SECS * widest.min(MAX_COORDINATE) / QUICK_DEG
    }
}

impl Record for ForwardKinematics {
    fn element(&self) -> &'static str {
        "body-non-deterministic-fk"
    }

    fn visit(&mut self, visitor: &mut dyn Visit) {
        visitor.field("manipulator", &mut self.manipulator);
        visitor.field("nJoints", &mut self.joint_count);
        for (name, joint) in JOINTS.into_iter().zip(&mut self.joints_deg) {
            visitor.field(name, joint);
        }
        visitor.field("smooth", &mut self.is_smooth);
    }
}

/// Target of a limb's end: position in skeleton units and orientation in degrees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Target {
    /// Position in skeleton units.
    pub position: [f64; 3],
    /// Yaw, pitch and roll in degrees.
    pub angles_deg: [f64; 3],
}

/// Shows the numbers of a vector.
fn visit_all(visitor: &mut dyn Visit, names: [&'static str; 3], numbers: &mut [f64; 3]) {
    for (name, number) in names.into_iter().zip(numbers) {
        visitor.field(name, number);
    }
}

impl Target {
    fn visit(&mut self, visitor: &mut dyn Visit) {
        visit_all(visitor, ["posX", "posY", "posZ"], &mut self.position);
        visit_all(visitor, ["yaw", "pitch", "roll"], &mut self.angles_deg);
    }
}

/// Clause that moves the end of a limb to a target by interpolating the joint angles (GEVH D.3.21).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointInterpolation {
    /// Limb, or the head, that the clause moves.
    pub manipulator: Manipulator,
    /// Duration in seconds. Takes precedence when both are given.
    pub static_time_secs: Option<f64>,
    /// Turn rate of the joints, radians per second.
    pub static_velocity_rad_per_s: Option<f64>,
    /// Destination of the limb's end.
    pub target: Target,
}

impl Record for JointInterpolation {
    fn element(&self) -> &'static str {
        "body-non-deterministic-joint-interpolation"
    }

    fn visit(&mut self, visitor: &mut dyn Visit) {
        visitor.field("manipulator", &mut self.manipulator);
        visitor.field("staticTime", &mut self.static_time_secs);
        visitor.field("staticVelocity", &mut self.static_velocity_rad_per_s);
        self.target.visit(visitor);
    }
}

/// Clause that moves the end of a limb to a target in a straight line (GEVH D.3.22).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameInterpolation {
    /// Limb, or the head, that the clause moves.
    pub manipulator: Manipulator,
    /// Duration of the motion, seconds.
    pub period_secs: f64,
    /// Destination of the limb's end.
    pub target: Target,
}

impl Record for FrameInterpolation {
    fn element(&self) -> &'static str {
        "body-non-deterministic-frame-interpolation"
    }

    fn visit(&mut self, visitor: &mut dyn Visit) {
        visitor.field("manipulator", &mut self.manipulator);
        visitor.field("timePeriod", &mut self.period_secs);
        self.target.visit(visitor);
    }
}

record! {
    /// Moves the end of a limb along a function (GEVH D.3.23).
    ManipulatorFunction = "body-non-deterministic-function" {
        /// Limb to move.
        manipulator: Manipulator = "manipulator",
        /// Name of the function, such as `segment`.
        function: String = "functionName",
        /// True if it repeats after its period.
        is_looping: bool = "isLooping",
    }
    children {
        /// Arguments of the function along which the limb moves.
        args: Option<FunctionArgs>
    }
}

/// Clause that moves the end of a limb by inverse velocity, towards a target or with a given
/// velocity (GEVH D.3.24).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Jacobian {
    /// Limb, or the head, that the clause moves.
    pub manipulator: Manipulator,
    /// True to move to the target; false to move at the velocities.
    pub is_static_target: bool,
    /// Destination of the limb's end.
    pub target: Target,
    /// Velocity in units a second.
    pub velocity: [f64; 3],
    /// Angular velocity in degrees a second.
    pub angular_velocity_deg: [f64; 3],
}

impl Record for Jacobian {
    fn element(&self) -> &'static str {
        "body-non-deterministic-jacobian"
    }

    fn visit(&mut self, visitor: &mut dyn Visit) {
        visitor.field("manipulator", &mut self.manipulator);
        visitor.field("isStaticTarget", &mut self.is_static_target);
        self.target.visit(visitor);
        visit_all(
            visitor,
            ["cartesianX", "cartesianY", "cartesianZ"],
            &mut self.velocity,
        );
        visit_all(
            visitor,
            ["angularX", "angularY", "angularZ"],
            &mut self.angular_velocity_deg,
        );
    }
}

record! {
    /// Stops a manipulator (GEVH D.3.25).
    Stop = "body-non-deterministic-stop" {
        /// Manipulator to set.
        manipulator: Manipulator = "manipulator",
    }
}

record! {
    /// Locks the end of a limb in place, or releases it (GEVH D.3.26).
    Lock = "body-non-deterministic-lock" {
        /// Manipulator to lock.
        manipulator: Manipulator = "manipulator",
        /// True to lock it; false to release it.
        is_lock: bool = "isLock",
    }
}
