//! The face as a machine: what moves it, and how its meshes follow (F&H sections 3.1.1 and
//! 3.1.2).

mod binding;
mod controls;
mod muscle;

pub use binding::{Binding, NodeState};
pub use controls::{FaceControls, Jaw};
pub use muscle::{MUSCLES, Muscle};
