//! Deterministic expression (GEVH 3.2): animation players that combine keyframes.
//!
//! A [`Clip`] describes the joint motion over its own time, for any figure. [`PlayerScript`]
//! defines the players, the animations on the stacks of their tracks and the weights of the tracks.
//! [`Players`] prepares both for one figure and evaluates any time. Evaluations keep no state: the
//! time in a clip is the integral of its track's speed, which is piecewise linear.
//!
//! Joints without animation stay with idle life and gestures, which are the layers below; gestures
//! are above where they move an arm.

mod bound;
mod clip;
pub mod curve;
mod groups;
mod joints;
mod keyframes;
mod layering;
mod library;
mod piecewise_linear;
mod playback;
mod players;
mod schedule;
mod script;

pub use clip::Clip;
pub use groups::{BODY_GROUPS, BoneSet, body_group};
pub use keyframes::read_clip;
pub use library::{Library, stem};
pub use playback::Playback;
pub use players::{AnimatedPose, Players};
pub use schedule::AT_ONCE_SECS;
pub use script::{
    CommandProblem, CommandProblemKind, Operation, PlayerCommand, PlayerKind, PlayerScript,
    Property, TrackRef, Tracks,
};
