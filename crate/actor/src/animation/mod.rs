//! Deterministic expression (GEVH 3.2): animation players that combine keyframes.
//!
//! A [`Clip`] says how joints move over its own time, on any figure. [`PlayerScript`] says
//! which players there are, what lies on the stacks of their tracks, and how tracks are
//! weighed; [`Players`] makes both ready for one figure and evaluates any time. Nothing is
//! kept between evaluations: the time at which a clip is, is the integral of its track's
//! speed, which is piecewise linear.
//!
//! What no animation moves stays with idle life and gestures, which lie below; gestures lie
//! above where they move an arm.

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
