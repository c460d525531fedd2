//! How the figure moves: everything here is a function of absolute time over plain plans.
//!
//! Does: animation players with their clips, inverse kinematics of limbs, limbs and head as
//! manipulators, palm orientation, gesture plans with preparation, hold
//! and retraction, idle life (breath, sway), what accompanies speech (gaze, blinks, brows,
//! nods), lip synchronisation, emotion, control parameters, and from the controls of a face
//! its jaw, lids and morph weights; [`Actor`] evaluates them all into a pose.
//! Does not: know EML, draw, play sound, or keep state between evaluations: seeking to a
//! time and playing to it give the same pose.
//!
//! Frames: right-handed, metres, radians, seconds; +x is the character's left, +y up,
//! +z front. A *hand rotation* turns the hand of the zero pose (arms stretched out
//! sideways, palms down) into its place, in world axes; see [`palm`].

mod actor;
pub mod animation;
pub mod articulation;
pub mod emotion;
pub mod face;
mod facial_behaviour;
pub mod gesture;
pub mod idle;
pub mod kinematics;
pub mod limb;
pub mod lips;
pub mod manipulator;
mod members;
pub mod nonverbal;
pub mod palm;
pub mod parameters;
mod performance;

pub use actor::{Actor, EvaluationReport};
pub use animation::{Library, PlayerScript, Players};
pub use emotion::{Affect, EmotionSpan, EmotionTrack};
pub use face::FaceRig;
pub use gesture::{ArmScript, GestureStroke, HandKey, TimeSpan};
pub use limb::{ArmGoal, ArmRig, ArmSolution, Build};
pub use lips::{LipTrack, MouthTargets};
pub use manipulator::{ManipulatorScript, Manipulators};
pub use nonverbal::{Manner, NonVerbal};
pub use parameters::{ParameterScript, ParameterTrack};
pub use performance::Performance;
