//! Gestures: what a script asks of each hand, and the motion between.
//!
//! A script gives strokes: keys of wrist position, hand rotation and hand shape at exact
//! times, each with the profile of the way to it. [`ArmPlan`] adds what people do around them
//! (Kendon's phases, GEVH appendix C): preparation, holds, flowing from one stroke into the
//! next, partial and full retraction, and rest. A script that names its phases has its own way
//! with them.
//!
//! Wrist, hand rotation and fingers keep clocks of their own: a palm that turns does not stop
//! the arm that carries it.

pub mod contact;
mod fingers;
mod pace;
mod path;
mod phrase;
mod plan;
mod planner;
mod rest;
pub(crate) mod smoothing;
mod tracks;

use raconteur_base::profile::Profile;
use raconteur_base::{DAffine3, DQuat, DVec3, Side};
use raconteur_body::hand_shape::HandAngles;

pub use plan::{ArmPlan, HandState, HandTarget};
pub use planner::PlannedKey;
pub use rest::{RestPostures, RestingHand};

/// The features of one hand at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HandKey {
    /// Story time, seconds.
    pub time_secs: f64,
    /// Place of the wrist, world, metres. `None` leaves it on its way to the next key that
    /// has one, or keeps it when there is none.
    pub wrist_in_world: Option<DVec3>,
    /// Whether the place is the world's, whatever way the figure has gone: otherwise it goes
    /// with the figure.
    pub stays_in_world: bool,
    /// Hand rotation ([`crate::palm`]). `None` likewise; the hand is relaxed when no key
    /// has turned it.
    pub hand_in_world: Option<DQuat>,
    /// Finger angles. `None` likewise.
    pub shape: Option<HandAngles>,
    /// How the wrist moves to this key from the one before in its stroke.
    pub wrist_course: Transition,
    /// How the hand turns to this key from the one before in its stroke.
    pub hand_course: Transition,
    /// How the fingers move to this key from the one before in its stroke; the space does not
    /// matter, since fingers are always interpolated by joint.
    pub shape_course: Transition,
}

/// How a feature moves to a key (GEVH 3.5.1).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Transition {
    /// The pace. `None` leaves pace and path to the planner: minimum jerk along a slightly
    /// curved path, passing through keys that lie on the way.
    pub profile: Option<Profile>,
    /// The interpolated quantity. `None`: positions; of rotations what is more natural.
    pub space: Option<InterpolationSpace>,
}

/// The quantity that is interpolated between two keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InterpolationSpace {
    /// Positions and orientations in the world: a straight way.
    Cartesian,
    /// Joint angles: the wrist swings as shoulder and elbow turn, the hand turns as the wrist
    /// bends.
    Joint,
}

/// A part of a gesture (GEVH 3.5.2, appendix C.3.5).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GesturePhase {
    /// What carries the meaning. The planner sees to what goes before and after.
    #[default]
    Stroke,
    /// The way to where the stroke starts: it begins when the phase does.
    Preparation,
    /// A hold before or after the stroke: the hand stays, or does what the keys say, until the
    /// end of the phase.
    Hold,
    /// The way back to rest, in the time of the phase.
    Retraction,
    /// A way back that ends half-way, in the time of the phase.
    PartialRetraction,
}

/// A stretch of keys that belong together, usually one gesture phase or one clause.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GestureStroke {
    /// What part of a gesture it is.
    pub phase: GesturePhase,
    /// Beginning, story time, seconds. In a stroke the hand has arrived at the first key by
    /// its own time, whatever this says; in other phases it sets out now.
    pub start_secs: f64,
    /// End, story time, seconds: the last key is held at least until here.
    pub end_secs: f64,
    /// Keys by time; others are sorted. Phases other than strokes need none.
    pub keys: Vec<HandKey>,
    /// The pace of the whole stretch, over the profiles of its keys: times of keys are places
    /// on this course. `None` leaves them where they are.
    pub pace: Option<Profile>,
}

/// A stretch of story time, seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeSpan {
    /// Beginning.
    pub start_secs: f64,
    /// End; may be infinite.
    pub end_secs: f64,
}

/// How a figure moves its arms by default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IdleSettings {
    /// Seed of all that is left to chance.
    pub seed: u64,
    /// Liveliness, 0 (still) to 1.
    pub amount: f64,
    /// The dominant hand: it lies before the other where both rest, and leaves first. A
    /// left-hander is the mirror image of a right-hander.
    pub dominant: Side,
}

/// All that a script asks of one arm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ArmScript {
    /// Strokes in any order.
    pub strokes: Vec<GestureStroke>,
    /// When gestures are switched on. Empty means always.
    pub on: Vec<TimeSpan>,
}

impl ArmScript {
    /// The script in the axes of a figure that goes about: places of the world as it sees them
    /// at the time of their key. `figure_from_world` is where it is then.
    #[must_use]
    pub fn from_viewpoint(&self, figure_from_world: impl Fn(f64) -> DAffine3) -> Self {
        let mut script = self.clone();
        let strokes = script.strokes.iter_mut();
        for key in strokes.flat_map(|s| &mut s.keys) {
            if let Some(wrist) = &mut key.wrist_in_world
                && key.stays_in_world
            {
                *wrist = figure_from_world(key.time_secs).transform_point3(*wrist);
            }
        }
        script
    }
}
