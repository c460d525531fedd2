//! The square picture that the skin of head and hands shares: how surfaces are laid flat in it, and which
//! of them lies under each texel.

mod raster;
mod unwrap;

pub(crate) use raster::{Hit, Raster, SIZE, fill};
pub(crate) use unwrap::{conformal, even_out, harmonic, unfold};
