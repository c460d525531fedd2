//! Robotic manipulators: limbs and head led by targets and joint angles (GEVH section 3.3).
//!
//! A limb has the six joints of GEVH table 3.1 and a seventh that the thesis leaves out, the
//! turn of the upper bone about itself, which lets the elbow or knee swivel while the end
//! keeps its place. [`rig`] knows the joints of one limb, [`solve`] finds all of them for a
//! target, [`swivel`] chooses where the elbow goes, [`limits`] holds appendix B, [`path`] the
//! functions of time, [`jacobian`] inverse velocity; [`Manipulators`] performs a script of
//! commands as a function of time.
//!
//! # Frames
//! *Figure axes* are the world's (metres, x left, y up, z front) carried along by `vh-move`.
//! A *target frame* has x along the hand or foot away from the body; of a hanging arm and a
//! standing leg it is x down, y left, z front, on both sides of the body. The head's is
//! x left, y up, z front when it is upright.

mod aim;
mod aimed;
mod compile;
mod follow;
pub mod head;
pub mod jacobian;
mod lean;
pub mod limits;
mod meet;
pub mod path;
mod perform;
pub mod rig;
mod root;
mod scan;
mod scene;
pub mod solve;
mod steady;
pub mod swivel;
mod track;

use raconteur_base::curve::lerp;
use raconteur_base::{DAffine3, DQuat, DVec3, Length, Side};

pub use limits::{Limit, Sex};
pub use path::{Path, Placement, Shape};
pub use perform::Manipulators;
pub use rig::LimbRig;
pub use solve::Solutions;
pub use steady::MOST_RAD_PER_S;

/// What a manipulator moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limb {
    /// From the left shoulder to the wrist.
    LeftArm,
    /// From the right shoulder to the wrist.
    RightArm,
    /// From the left hip to the ankle.
    LeftLeg,
    /// From the right hip to the ankle.
    RightLeg,
    /// Neck and skull.
    Head,
}

impl Limb {
    /// Every limb, in the order of [`Limb::index`].
    pub const ALL: [Self; 5] = [
        Self::LeftArm,
        Self::RightArm,
        Self::LeftLeg,
        Self::RightLeg,
        Self::Head,
    ];

    /// 0 to 4.
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }

    /// The side, and whether it is an arm; none for the head.
    #[must_use]
    pub fn side(self) -> Option<(Side, bool)> {
        match self {
            Self::LeftArm => Some((Side::Left, true)),
            Self::RightArm => Some((Side::Right, true)),
            Self::LeftLeg => Some((Side::Left, false)),
            Self::RightLeg => Some((Side::Right, false)),
            Self::Head => None,
        }
    }
}

/// Joint angles, radians. Of a limb the six of GEVH table 3.1 and, last, the turn of the
/// upper bone about itself; of the head five, the rest 0. Zero is the neutral pose: arms
/// hanging with the palms to the thighs, legs standing, head upright. Equal angles on both
/// sides mirror each other. Signs: see [`limits::limits`].
pub type Joints = [f64; 7];

/// A place and an orientation, figure axes or a manipulator's base axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Metres.
    pub position: DVec3,
    /// Rotation of the target frame.
    pub rotation: DQuat,
}

impl Frame {
    /// On the straight way to another frame: line and shortest turn.
    #[must_use]
    pub fn toward(&self, to: &Self, share: f64) -> Self {
        Self {
            position: self.position.lerp(to.position, share),
            rotation: self.rotation.slerp(to.rotation, share).normalized(),
        }
    }

    /// The frame moved by a rigid motion.
    #[must_use]
    pub fn moved(&self, motion: &DAffine3) -> Self {
        Self {
            position: motion.transform_point3(self.position),
            rotation: (crate::kinematics::rotation_of(motion) * self.rotation).normalized(),
        }
    }
}

/// A limb's motion.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Turns the manipulator on or off, and its limits; `None` keeps a setting.
    Configure {
        /// Off gives the limb back to gestures, animations and idle life.
        is_on: Option<bool>,
        /// Whether joints stay within their limits. They do by default.
        limits: Option<bool>,
        /// Angles of the first joints, radians, that solutions are preferred near: the user's
        /// preference of GEVH 3.3.2.1. An empty list leaves the choice to the limb again.
        preferred: Option<Vec<f64>>,
    },
    /// Turns joints to angles (GEVH D.3.20).
    Joints {
        /// Radians; joints without an angle stay.
        angles: [Option<f64>; 6],
        /// How long it takes, seconds; 0 cuts to the angles, from one moment to the next.
        secs: f64,
    },
    /// To a frame by the joints (GEVH D.3.21).
    JointInterpolation {
        /// Where to, figure axes.
        to: Frame,
        /// How long it takes.
        pace: Pace,
    },
    /// To a frame on a straight line with the shortest turn (GEVH D.3.22).
    FrameInterpolation {
        /// Where to, figure axes.
        to: Frame,
        /// Seconds.
        secs: f64,
    },
    /// Along a function of time (GEVH D.3.23).
    Function(Box<Path>),
    /// To a frame by inverse velocity (GEVH D.3.24).
    JacobianTarget(Frame),
    /// At velocities by inverse velocity until another command comes (GEVH D.3.24).
    JacobianVelocity {
        /// Metres a second, figure axes.
        linear: DVec3,
        /// Radians a second, figure axes.
        angular: DVec3,
    },
    /// Stops where it is (GEVH D.3.25).
    Stop,
    /// Holds the target in the world while the body moves, or lets go (GEVH D.3.26).
    Lock(bool),
}

/// How fast joints go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// All of it in so many seconds.
    Secs(f64),
    /// The joint with the longest way at so many radians a second.
    RadPerSec(f64),
}

/// A motion at its time.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// Story time, seconds.
    pub time_secs: f64,
    /// What moves.
    pub limb: Limb,
    /// How.
    pub motion: Motion,
}

/// A motion of the whole figure at its time (GEVH D.1.6).
#[derive(Clone, Debug, PartialEq)]
pub struct Move {
    /// Story time, seconds.
    pub time_secs: f64,
    /// Where the point of the floor under the figure goes, world, and how it turns.
    pub path: Path,
}

/// All commands to the manipulators of one figure, in any order; of commands at
/// one time the last one counts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ManipulatorScript {
    /// Motions of limbs.
    pub commands: Vec<Command>,
    /// Motions of the figure.
    pub moves: Vec<Move>,
}

impl ManipulatorScript {
    /// Figure axes from world as a function of time; none where the figure never moves.
    #[must_use]
    pub fn figure_from_world(&self) -> Option<impl Fn(f64) -> DAffine3> {
        let root = root::RootTrack::new(&self.moves);
        (!self.moves.is_empty()).then_some(move |time_secs| {
            let moved = root.at(time_secs).unwrap_or(DAffine3::IDENTITY);
            moved.inverse()
        })
    }
}

/// Joints a share of the way to others, angle by angle.
fn between(from: &Joints, to: &Joints, share: f64) -> Joints {
    let mut joints = *from;
    for (a, b) in joints.iter_mut().zip(to) {
        *a = lerp(*a, *b, share);
    }
    joints
}
