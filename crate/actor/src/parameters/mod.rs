//! Control parameters that a story moves by name (GEVH 3.2.4): muscles, what no muscle moves,
//! visemes and emotions; set, led through phases, or animated.

mod clip;
mod curve;
mod dial;
mod name;
mod script;
mod track;

pub use clip::ParameterClip;
pub use curve::{Curve, SET_SECS, STEP_SECS};
pub use dial::{DIALS, Dial};
pub use name::{Asks, Parameter, VISEMES};
pub use script::{Adsr, ParameterCommand, ParameterScript, Style};
pub use track::ParameterTrack;
