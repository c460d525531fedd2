//! Mechanics of the face: its actuation, and the motion of its meshes (F&H sections 3.1.1 and
//! 3.1.2).
//!
//! Scope: the controls of a face, its muscles, the mass-spring network of its skin with its
//! obstacles, and the file of all that.
//! Out of scope: fitting to a head (`body`) and the behaviour of the face (`actor`).
//!
//! This is a separate crate, used as `body::face`, because it alone is compiled for speed when the
//! rest is compiled for size, and also in debug builds.
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
