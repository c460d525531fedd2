//! Markup of a document as data: a flat tree of elements and text, with resolved references. The
//! meaning of elements is unknown here.

mod references;
mod tree;

pub(crate) use references::{bare_ampersand, character, resolve};
pub(crate) use tree::{Attribute, Node, NodeKind, Tree};
