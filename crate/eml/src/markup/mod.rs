//! The markup of a document as data: a flat tree of elements and text, and what references in it
//! stand for. What elements mean is not known here.

mod references;
mod tree;

pub(crate) use references::{bare_ampersand, character, resolve};
pub(crate) use tree::{Attribute, Node, NodeKind, Tree};
