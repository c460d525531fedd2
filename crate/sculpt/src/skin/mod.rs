//! Surface of the skin: one atlas for head and hands, with a colour map, a normal map and heights
//! of expressive wrinkles, made from pigments, blood, age and lines rather than painted.

mod bake;
mod expression_lines;
mod face;
mod face_lines;
mod hand;
mod hand_lines;
mod marks;
mod params;
pub mod pigment;
#[cfg(test)]
mod tests;
mod tissue;
pub mod tone;

pub(crate) use bake::bake;
pub use params::SkinParams;
