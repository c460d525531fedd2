//! Evaluates the plans at a time.

pub(crate) mod event;
mod fibres;
mod layers;
pub(crate) mod player;
mod soft;
