//! Figures as glTF 2.0 binary: reading, writing, and what lies in a file beside meshes and joints.
//! Nothing else of the crate knows how a file holds a figure.

pub mod annotation;
mod fields;
pub mod read;
mod springs;
pub mod write;
