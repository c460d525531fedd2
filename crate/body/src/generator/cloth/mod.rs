//! Clothes: sheets set off from the body's cage, folded and draped in the rest pose
//! against the body's field, sewn, with swept bands that give every visible edge thickness.

pub mod band;
pub mod collar;
pub mod drape;
pub mod finish;
pub mod fold;
mod outfit;
pub mod seam;
pub mod sheet;
pub mod shoe;
pub mod strip;
#[cfg(test)]
mod tests;
pub mod top;
pub mod trousers;
pub mod wearer;

use raconteur_base::curve::smooth;

pub use outfit::{Cardigan, Dressed, Hoodie, Legs, Outfit, Sweater, dress};
pub use wearer::Wearer;

/// 0 at `from`, 1 at `to` (in either order), smooth between and held outside.
pub(super) fn fade(x: f64, from: f64, to: f64) -> f64 {
    smooth((x - from) / (to - from))
}
