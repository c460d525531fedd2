//! Evaluates the plans at a time.

mod clock;
pub(crate) mod event;
mod fibres;
mod layers;
mod picture;
pub(crate) mod player;
mod rehearsal;
mod score;
mod segments;
mod soft;
mod sway;
