//! Gestures: the scripted keys of each hand and the motion between them.
//!
//! A script specifies strokes: keys of wrist position, hand rotation and hand shape at exact times,
//! each with the speed profile of its path. [`ArmPlan`] adds the other gesture phases (Kendon's
//! phases, GEVH appendix C): preparation, holds, coarticulation between strokes, partial and full
//! retraction, and rest. Phases named by a script take precedence.
//!
//! Wrist, hand rotation and fingers have separate timings: a turning palm does not stop the arm.

pub(crate) mod amplitude;
mod beats;
pub mod contact;
pub(crate) mod deixis;
mod fingers;
mod pace;
mod path;
mod phrase;
mod plan;
mod planner;
mod rest;
pub(crate) mod rest_choice;
mod rest_posture;
mod rest_schedule;
pub(crate) mod second_hand;
pub(crate) mod smoothing;
mod tempo;
mod tracks;

use raconteur_base::profile::Profile;
use raconteur_base::{DAffine3, DQuat, DVec3, Side};
use raconteur_body::hand_shape::HandAngles;

pub use plan::{ArmPlan, HandState, HandTarget};
pub use planner::PlannedKey;
pub use rest::{RestPostures, RestingHand};
pub use rest_posture::{RestPosture, RestSpot};
pub use rest_schedule::RestSchedule;

use crate::time_span::TimeSpan;

/// Key of a gesture: wrist position, hand rotation and hand shape of one hand at one time; an
/// absent feature is not constrained.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HandKey {
    /// Time of the key, story time, seconds.
    pub time_secs: f64,
    /// Position of the wrist, world, metres. `None` leaves it on its path to the next key that has
    /// one, or keeps it when there is none.
    pub wrist_in_world: Option<DVec3>,
    /// True if the position is fixed in the world even when the figure walks; otherwise it moves
    /// with the figure.
    pub stays_in_world: bool,
    /// Hand rotation ([`crate::palm`]). `None` likewise; the hand is relaxed if no key has turned
    /// it.
    pub hand_in_world: Option<DQuat>,
    /// Finger angles. `None` likewise.
    pub shape: Option<HandAngles>,
    /// Motion of the wrist to this key from the previous one in its stroke.
    pub wrist_course: Transition,
    /// Turn of the hand to this key from the previous one in its stroke.
    pub hand_course: Transition,
    /// Motion of the fingers to this key from the previous one in its stroke; the space does not
    /// matter, since fingers are always interpolated by joint.
    pub shape_course: Transition,
}

/// Transition of a hand feature to a key: motion profile and interpolation space (GEVH 3.5.1).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Transition {
    /// Velocity profile. `None` leaves pace and path to the planner: minimum jerk along a slightly
    /// curved path through keys that lie on the path.
    pub profile: Option<Profile>,
    /// Interpolated quantity. `None` interpolates positions, and for rotations the more natural
    /// quantity.
    pub space: Option<InterpolationSpace>,
}

/// Space in which a hand is interpolated between two keys: positions, or joint angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InterpolationSpace {
    /// Positions and orientations in the world: a straight path.
    Cartesian,
    /// Joint angles: the wrist swings as shoulder and elbow turn, the hand turns as the wrist
    /// bends.
    Joint,
}

/// Phase of a gesture (GEVH 3.5.2, appendix C.3.5).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GesturePhase {
    /// The meaningful phase. The planner adds the phases before and after.
    #[default]
    Stroke,
    /// The movement to the start of the stroke, beginning at the start of the phase.
    Preparation,
    /// A hold before or after the stroke: the hand stays, or follows the keys, until the end of the
    /// phase.
    Hold,
    /// The return to rest, within the phase.
    Retraction,
    /// A return that ends half-way, within the phase.
    PartialRetraction,
}

/// Group of hand keys that belong together, usually one gesture phase or one clause.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GestureStroke {
    /// Gesture phase to which the keys belong.
    pub phase: GesturePhase,
    /// True if the phase is transcribed: keys keep their places and times exactly, and are not
    /// varied by the tension of the story or by the hand.
    pub is_transcribed: bool,
    /// Beginning, story time, seconds. In a stroke the hand has arrived at the first key by that
    /// key's own time, whatever this value; in other phases it departs at this time.
    pub start_secs: f64,
    /// End, story time, seconds: the last key is held at least until this time.
    pub end_secs: f64,
    /// Keys, sorted by time on use. Phases other than strokes need none.
    pub keys: Vec<HandKey>,
    /// Velocity profile of the whole stroke, overriding the profiles of its keys: key times become
    /// places along this profile. `None` leaves them unchanged.
    pub pace: Option<Profile>,
}

/// Settings of the arm motion of a figure at rest: random seed, amount and dominant hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IdleSettings {
    /// Seed of all that is left to chance.
    pub seed: u64,
    /// Liveliness, 0 (still) to 1.
    pub amount: f64,
    /// The dominant hand: it lies in front of the other when both rest, and leaves first. A
    /// left-hander is the mirror image of a right-hander.
    pub dominant: Side,
}

/// Gesture script of one arm: its strokes, and the intervals in which gestures are enabled.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ArmScript {
    /// Strokes in any order.
    pub strokes: Vec<GestureStroke>,
    /// Intervals in which gestures are switched on. Empty means always.
    pub on: Vec<TimeSpan>,
}

impl ArmScript {
    /// Returns the script in the axes of a moving figure, with world places as seen at the time of
    /// their key. `figure_from_world` gives the figure's transform at a time.
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
