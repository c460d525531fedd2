//! Markup to a flat tree of elements and text, with whatever is malformed mended or
//! marked.

mod attributes;
mod builder;
mod references;
mod tree;

pub(crate) use builder::build;
pub(crate) use references::resolve;
pub(crate) use tree::{Attribute, Node, NodeKind, Tree};

#[cfg(test)]
mod tests;
