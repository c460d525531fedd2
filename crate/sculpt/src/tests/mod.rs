//! Tests of whole figures, and the figures that other tests look at.

mod deform;
pub(crate) mod soundness;
