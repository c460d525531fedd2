//! Motion of the figure: functions of absolute time over plain plans.
//!
//! Scope: animation players with their clips, inverse kinematics of limbs, limbs and head as
//! manipulators, palm orientation, gesture plans with preparation, hold and retraction, idle life
//! (breath, sway), accompaniment of speech (gaze, blinks, brows, nods), lip synchronisation,
//! emotion, control parameters, and the conversion of face controls to jaw, lids and morph weights.
//! [`Actor`] evaluates them all into a pose.
//! Out of scope: EML, rendering, audio playback, and state between evaluations: seeking to a time
//! and playing to it give the same pose.
//!
//! Frames: right-handed, metres, radians, seconds; +x is the character's left, +y up, +z front. A
//! *hand rotation* turns the hand of the zero pose (arms stretched out sideways, palms down) to its
//! orientation, in world axes; see [`palm`].

mod actor;
pub mod animation;
pub mod articulation;
mod body_posture;
mod discourse;
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
mod posture;
mod superposition;
mod time_span;

pub use actor::{Actor, EvaluationReport};
pub use animation::{Library, PlayerScript, Players};
pub use body_posture::PostureCommand;
pub use discourse::{Discourse, Mention, RoleSpan, TensionKey};
pub use emotion::{Affect, EmotionSpan, EmotionTrack};
pub use face::FaceRig;
pub use gesture::{ArmScript, GestureStroke, HandKey};
pub use limb::{ArmGoal, ArmRig, ArmSolution, Build};
pub use lips::{LipTrack, MouthTargets};
pub use manipulator::{ManipulatorScript, Manipulators};
pub use nonverbal::{Manner, NonVerbal};
pub use parameters::{ParameterScript, ParameterTrack};
pub use performance::Performance;
pub use time_span::TimeSpan;
