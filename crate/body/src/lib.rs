//! The performer: the figure's skeleton, skin, face and hands, read from glTF.
//!
//! Scope: the 54 bones of GEVH appendix A with their frames, forward kinematics with helper joints,
//! hand shapes, swinging chains, the figure's meshes and morph targets, reading from and writing to
//! glTF binary.
//! Out of scope: figure generation (`sculpt`), avatar import (`avatar`), motion (`actor`) and
//! rendering (`render`).
//!
//! Frames: right-handed, metres, radians; +x is the character's left, +y up, +z front.

pub mod figure;
mod gltf;
mod hair_colour;
pub mod hand_shape;
pub mod pose;
pub mod skeleton;
pub mod springs;
pub mod surface;

/// Facial tissue: a muscle-based model of the face.
pub use raconteur_tissue as face;

pub use crate::gltf::{annotation, read, write};
pub use figure::{Figure, Material, MaterialKind, Mesh, Morph};
pub use hair_colour::HairColour;
pub use hand_shape::HandShape;
pub use pose::Pose;
pub use skeleton::{Bone, Drive, Joint, Skeleton};
pub use springs::Springs;
