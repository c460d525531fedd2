//! Conversion of a story's text to frames.
//!
//! Scope: reading a script with its speech bundle ([`Script`]), lowering the timeline to plans of
//! the actor, and evaluating the [`stage::Frame`] of any time ([`Player`]); captions, cues and
//! digests; performing clauses that arrive while the story plays ([`live`]).
//! Out of scope: rendering, audio playback, file access and a clock: time is an argument.
//!
//! With `eml`, this is the only crate that knows EML. It re-exports its dependencies for the
//! browser bindings, which depend on no other of them.

pub mod live;
mod lower;
pub mod motion;
mod options;
mod play;
pub mod sweep;

pub use lower::cues::{ClauseRef, Cue, CueKind, UtteranceCue};
pub use lower::flow::{WayCue, WayKind};
pub use lower::music::MusicCue;
pub use lower::questions::{AnswerCue, FeedbackCue, OptionCue, PictureCue, QuestionCue};
pub use lower::script::{LoadStage, Script, performer_of};
pub use lower::units::Units;
pub use options::{LanguageTag, Options};
pub use play::event::{AcceptedClause, Event};
pub use play::player::readings::EnvironmentExpression;
pub use play::player::{LoadedPlayer, Manipulator, Player, StoryInput};
pub use raconteur_actor as actor;
pub use raconteur_actor::Library;
pub use raconteur_actor::nonverbal::{Manner, PlanBasis};
pub use raconteur_base as base;
pub use raconteur_body as body;
pub use raconteur_eml as eml;
pub use raconteur_reshape as reshape;
pub use raconteur_speech as speech;
pub use raconteur_stage as stage;
