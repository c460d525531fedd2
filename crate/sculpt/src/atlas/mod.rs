//! Texture atlas shared by the skin of head and hands: flattening of surfaces, and the surface at
//! each texel.

mod raster;
mod unwrap;

pub(crate) use raster::{Hit, Raster, SIZE, fill};
pub(crate) use unwrap::{conformal, even_out, harmonic, unfold};
