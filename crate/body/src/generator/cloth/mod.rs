//! Clothes: shells offset from the body's cage, draped in the rest pose against the body's
//! field, with swept bands that give every visible edge thickness.

pub mod band;
pub mod drape;
pub mod finish;
pub mod shoe;
pub mod sweater;
pub mod trousers;

use raconteur_base::curve::smooth;

/// 0 at `from`, 1 at `to` (in either order), smooth between and held outside.
pub(super) fn fade(x: f64, from: f64, to: f64) -> f64 {
    smooth((x - from) / (to - from))
}
