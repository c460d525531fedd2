//! Gestures: what a script asks of each hand, and the motion between.
//!
//! A script gives strokes: keys of wrist position, hand rotation and hand shape at exact
//! times. [`ArmPlan`] adds what people do around them (Kendon's phases, GEVH appendix C):
//! preparation, holds, flowing from one stroke into the next, partial and full
//! retraction, and rest.

mod fingers;
mod plan;
mod rest;
mod space;

use raconteur_base::{DQuat, DVec3};
use raconteur_body::hand_shape::HandAngles;

pub use plan::{ArmPlan, HandState, HandTarget};
pub use rest::{Rest, RestHand};
pub use space::{BodySpace, part_hands};

/// What one hand is asked for at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandKey {
    /// Story time, seconds.
    pub time_secs: f64,
    /// Place of the wrist, world, metres. `None` leaves it on its way to the next key that
    /// has one, or keeps it when there is none.
    pub wrist_in_world: Option<DVec3>,
    /// Hand rotation ([`crate::palm`]). `None` likewise; the hand is relaxed when no key
    /// has turned it.
    pub hand_in_world: Option<DQuat>,
    /// Finger angles. `None` likewise.
    pub shape: Option<HandAngles>,
}

/// A stretch of keys that belong together, usually one gesture phase or one clause.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GestureStroke {
    /// Beginning, story time, seconds: the hand has arrived at the first key by its own
    /// time, whatever this says.
    pub start_secs: f64,
    /// End, story time, seconds: the last key is held at least until here.
    pub end_secs: f64,
    /// Keys by time; others are sorted.
    pub keys: Vec<HandKey>,
}

/// A stretch of story time, seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Beginning.
    pub start_secs: f64,
    /// End; may be infinite.
    pub end_secs: f64,
}

/// All that a script asks of one arm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ArmScript {
    /// Strokes in any order.
    pub strokes: Vec<GestureStroke>,
    /// When gestures are switched on. Empty means always.
    pub on: Vec<Span>,
}
