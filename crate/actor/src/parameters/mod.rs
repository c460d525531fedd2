//! Control parameters that a story moves by name (GEVH 3.2.4): muscles, parameters without a
//! muscle, visemes and emotions; set, driven through phases, or animated.

mod clip;
mod control;
mod curve;
mod name;
mod script;
mod track;

pub use clip::ParameterClip;
pub use control::{FACE_CONTROLS, FaceControl};
pub use curve::{Curve, SET_SECS, STEP_SECS};
pub use name::{Parameter, ParameterTarget, VISEMES};
pub use script::{Adsr, ParameterCommand, ParameterScript, PlaybackStyle};
pub use track::ParameterTrack;
