//! From a story's text to frames.
//!
//! Does: reads a script with its speech bundle ([`Script`]), lowers the timeline to plans of
//! the actor, and evaluates the [`stage::Frame`] of any time ([`Player`]); captions, cues and
//! digests; performs clauses that come while the story plays ([`live`]).
//! Does not: draw, play sound, read files or keep a clock: time is an argument.
//!
//! With `eml`, this is the only crate that knows EML. It hands its neighbours on, so that
//! the browser bindings and the command line need no further edge.

mod animations;
mod cues;
mod emotions;
mod event;
mod feelings;
mod fibres;
mod geometry;
mod gestures;
mod layers;
pub mod live;
mod manipulators;
mod motion;
mod music;
mod parameters;
mod part;
mod performer;
mod script;
mod soft;
pub mod sweep;
mod units;
mod unperformed;
mod views;
mod voice;

pub use cues::{ClauseRef, Cue, CueKind, UtteranceCue, WordCue};
pub use event::{Accepted, Event};
pub use music::MusicCue;
pub use performer::{Loaded, Manipulator, Options, Player, StoryInput};
pub use raconteur_actor as actor;
pub use raconteur_actor::Library;
pub use raconteur_actor::nonverbal::{Manner, Way};
pub use raconteur_base as base;
pub use raconteur_body as body;
pub use raconteur_eml as eml;
pub use raconteur_speech as speech;
pub use raconteur_stage as stage;
pub use script::{Reading, Script, asks_for_more, performer_of};
pub use units::Units;
#[cfg(feature = "bake")]
pub use voice::{Said, Source, content_of};
