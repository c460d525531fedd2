//! Robotic manipulators: limbs and head driven by targets and joint angles (GEVH section 3.3).
//!
//! [`crate::limb`] brings a limb to a target; this module applies it to commands: [`path`] contains
//! the functions of time, [`jacobian`] inverse velocity, [`head`] the joints of neck and skull;
//! [`Manipulators`] performs a script of commands as a function of time.
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
mod motion;
pub mod path;
mod perform;
mod root;
mod scan;
mod scene;
mod smoothing;
mod solve;
mod track;

use raconteur_base::curve::lerp;
use raconteur_base::{DAffine3, DVec3};

use crate::limb::{Joints, Limb, RigidFrame};

pub use path::{Path, PathShape, Placement};
pub use perform::Manipulators;
pub use smoothing::MAX_RAD_PER_S;

/// Motion or setting that a script commands for a limb, for example to joint angles, to a frame, or
/// along a path.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Turns the manipulator and its limits on or off; `None` keeps a setting.
    Configure {
        /// Enables control; off returns the limb to gestures, animations and idle motion.
        is_on: Option<bool>,
        /// Enables joint limits. Default: on.
        limits: Option<bool>,
        /// Angles of the first joints, radians, that solutions are preferred near: the user's
        /// preference of GEVH 3.3.2.1. An empty list leaves the choice to the limb again.
        preferred: Option<Vec<f64>>,
    },
    /// Turns joints to angles (GEVH D.3.20).
    Joints {
        /// Radians; joints without an angle stay.
        angles: [Option<f64>; 6],
        /// Duration, seconds; 0 sets the angles instantly.
        secs: f64,
    },
    /// Moves to a target frame by interpolating the joint angles (GEVH D.3.21).
    JointInterpolation {
        /// Destination, figure axes.
        to: RigidFrame,
        /// Speed of the joints.
        pace: JointSpeed,
    },
    /// Moves to a target frame on a straight line with the shortest rotation (GEVH D.3.22).
    FrameInterpolation {
        /// Destination, figure axes.
        to: RigidFrame,
        /// Seconds.
        secs: f64,
    },
    /// Along a function of time (GEVH D.3.23).
    Function(Box<Path>),
    /// Moves to a target frame by inverse velocity, with the Jacobian (GEVH D.3.24).
    JacobianTarget(RigidFrame),
    /// Moves at velocities by inverse velocity until the next command (GEVH D.3.24).
    JacobianVelocity {
        /// Metres a second, figure axes.
        linear: DVec3,
        /// Radians a second, figure axes.
        angular: DVec3,
    },
    /// Stops where it is (GEVH D.3.25).
    Stop,
    /// Holds the target in the world while the body moves, or releases it (GEVH D.3.26).
    Lock(bool),
}

/// Speed of an interpolation between joint angles, as a duration (seconds) or an angular speed
/// (rad/s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointSpeed {
    /// Total duration in seconds.
    Secs(f64),
    /// Speed of the joint with the longest path, radians per second.
    RadPerSec(f64),
}

/// Command to a limb: a motion and the story time at which it starts.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// Start of the motion, story time, seconds.
    pub time_secs: f64,
    /// Limb (or the head) that performs the motion.
    pub limb: Limb,
    /// Motion of the limb.
    pub motion: Motion,
}

/// Motion of the whole figure along a path, with its start time (GEVH D.1.6).
#[derive(Clone, Debug, PartialEq)]
pub struct RootMotion {
    /// Start of the motion, story time, seconds.
    pub time_secs: f64,
    /// Path of the floor point under the figure, world, and its turn.
    pub path: Path,
}

/// All commands to the manipulators of one figure, in any order; of simultaneous commands the last
/// one counts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ManipulatorScript {
    /// Commands to limbs and head.
    pub commands: Vec<Command>,
    /// Motions of the figure.
    pub moves: Vec<RootMotion>,
}

impl ManipulatorScript {
    /// Returns figure axes from world as a function of time; `None` if the figure never moves.
    #[must_use]
    pub fn figure_from_world(&self) -> Option<impl Fn(f64) -> DAffine3> {
        let root = root::RootTrack::new(&self.moves);
        (!self.moves.is_empty()).then_some(move |time_secs| {
            let moved = root.sample(time_secs).unwrap_or(DAffine3::IDENTITY);
            moved.inverse()
        })
    }
}

/// Interpolates joints by a share, angle by angle.
fn between(from: &Joints, to: &Joints, share: f64) -> Joints {
    let mut joints = *from;
    for (a, b) in joints.iter_mut().zip(to) {
        *a = lerp(*a, *b, share);
    }
    joints
}
