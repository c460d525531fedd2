//! Hair: strand cards that follow a combing field over the head.
//!
//! Each card is a strip of two columns along a guide curve. Curves start on the scalp,
//! run along the skin at the height of their layer and give way to gravity; the renderer
//! draws the strands on the cards from the texture coordinates.

mod bob;
mod card;
mod skin;

pub use bob::{BobParams, bob};
