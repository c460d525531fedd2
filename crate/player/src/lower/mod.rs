//! From a document and its times to plans: what each element asks of the figure, the camera, the
//! light and the listeners, as data of the actor and the stage. Nothing here knows a moment.

pub(crate) mod animations;
pub(crate) mod cast;
pub(crate) mod cues;
pub(crate) mod emotions;
pub(crate) mod feelings;
pub(crate) mod geometry;
pub(crate) mod gestures;
pub(crate) mod manipulators;
pub(crate) mod music;
pub(crate) mod needs;
pub(crate) mod parameters;
pub(crate) mod part;
pub(crate) mod script;
pub(crate) mod units;
mod utterance;
pub(crate) mod views;
pub(crate) mod voice;
