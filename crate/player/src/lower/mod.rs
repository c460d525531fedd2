//! Conversion of a document and its times to plans: the effect of each element on the figure, the
//! camera, the music and the listeners, as data of the actor and the stage. Nothing here is
//! evaluated at a time.

pub(crate) mod anchor;
pub(crate) mod animations;
pub(crate) mod cast;
pub(crate) mod clips;
pub(crate) mod control_source;
pub(crate) mod cues;
pub(crate) mod discourse;
pub(crate) mod emotions;
pub(crate) mod expressed_emotion;
pub(crate) mod face;
pub(crate) mod flow;
pub(crate) mod gestures;
pub(crate) mod lamps;
pub(crate) mod manipulators;
pub(crate) mod moods;
pub(crate) mod music;
pub(crate) mod music_stem;
pub(crate) mod palms;
pub(crate) mod parameters;
pub(crate) mod plan;
mod postures;
pub(crate) mod questions;
pub(crate) mod reach;
pub(crate) mod repertoire;
pub(crate) mod requirements;
pub(crate) mod script;
pub(crate) mod shots;
mod spelling;
pub(crate) mod units;
mod utterance;
pub(crate) mod visibility;
pub(crate) mod voice;
