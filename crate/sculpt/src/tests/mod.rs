//! Tests of whole figures, and the figures used by other tests.

mod deform;
pub(crate) mod soundness;
