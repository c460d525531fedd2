//! The face as a machine: what moves it, and how its meshes follow (F&H sections 3.1.1 and
//! 3.1.2).

mod binding;
mod contact;
mod controls;
pub mod file;
mod muscle;
mod muscles;
mod network;
mod springs;
pub mod tissue;

pub use binding::Binding;
pub use contact::Depths;
pub use controls::{FaceControls, Jaw};
pub use muscle::{MUSCLES, Muscle};
pub use network::Network;
pub use raconteur_base::NodeState;
pub use tissue::Tissue;
