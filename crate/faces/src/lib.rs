//! Faces as vectors: the shapes that can be reached by mixing corresponding meshes.
//!
//! Does: a linear face space over meshes that share one topology (F&H 5.2, after Blanz
//! and Vetter 1999, doi:10.1145/311535.311556): mean, orthonormal modes, from shape to
//! coefficients and back.
//! Does not: yet know attributes, constraints, segments or pictures.

mod space;

pub use space::{FaceSpace, FaceSpaceError};
