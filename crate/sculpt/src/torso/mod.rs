//! The body below the head: joints, implicit field, and the cage wrapped on it.

pub mod cage;
pub mod field;
mod section;
pub mod shape;
pub mod shell;
#[cfg(test)]
mod tests;
pub mod weights;

pub use cage::Cage;
pub use field::{Field, Regions};
pub use shape::{BodyParams, CM, Joints};
pub use shell::Shell;
