//! Evaluation of the plans at a time.

mod actor_builder;
mod clock;
mod crossfade;
pub(crate) mod event;
mod fibres;
pub(crate) mod player;
mod script_set;
mod segments;
mod shot_director;
mod soft;
mod swinging_parts;
