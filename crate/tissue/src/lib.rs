//! The face as a machine: what moves it, and how its meshes follow (F&H sections 3.1.1 and
//! 3.1.2).
//!
//! Does: the controls of a face, its muscles, the mass-spring network of its skin with what it
//! may not pass through, and the file of all that.
//! Does not: fit it to a head (`body`) or decide what the face does (`actor`).
//!
//! A crate of its own, which everyone meets as `body::face`, because it alone is compiled for
//! speed where the rest is compiled for size, and where the rest is compiled to be tried.
//!
//! Frames: right-handed, metres, radians; +x is the character's left, +y up, +z front.

#[cfg(test)]
mod antagonists;
mod binding;
mod contact;
mod controls;
mod cord;
pub mod file;
mod junction;
mod lanes;
mod layout;
mod muscle;
mod muscles;
mod network;
mod smoothing;
mod springs;
mod table;
pub mod tissue;

pub use binding::Binding;
pub use contact::PenetrationDepths;
pub use controls::{FaceControls, Jaw};
pub use muscle::{ANTAGONISTS, APART, ARKIT, Anatomy, CLOSES_JAW, MUSCLES, Muscle};
pub use network::Network;
pub use raconteur_base::NodeState;
pub use tissue::Tissue;
