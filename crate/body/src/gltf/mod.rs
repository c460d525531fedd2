//! Figures as glTF 2.0 binary: reading, writing, and the content of a file apart from meshes and
//! joints. Only this module knows the file representation of a figure.

pub mod annotation;
mod fields;
pub mod read;
mod springs;
pub mod write;
