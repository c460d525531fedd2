//! Clothes: sheets offset from the body's cage, folded and draped in the rest pose against the
//! body's field, sewn, with swept bands that give every visible edge thickness.

pub mod band;
pub mod collar;
pub mod cut;
pub mod drape;
mod dressed;
pub mod finish;
pub mod fold;
mod gathers;
pub mod neck;
mod outfit;
pub mod seam;
pub mod sheet;
mod shirt;
pub mod shoe;
pub mod strip;
#[cfg(test)]
mod tests;
pub mod top;
pub mod trousers;
mod wardrobe;
pub mod wearer;

use raconteur_base::curve::smooth;

pub use dressed::Dressed;
pub use neck::Neck;
pub use outfit::dress;
pub use wardrobe::{Cardigan, Hoodie, Legs, Outfit, Sweater};
pub use wearer::Wearer;

/// Returns 0 at `from`, 1 at `to` (in either order), smooth between and constant outside.
pub(super) fn fade(x: f64, from: f64, to: f64) -> f64 {
    smooth((x - from) / (to - from))
}
