//! Text to the tree of its markup, with whatever is malformed mended or marked.

mod attributes;
mod builder;

pub(crate) use builder::build;

#[cfg(test)]
mod tests;
