//! Conversion of text to its markup tree; malformed parts are corrected or marked.

mod attributes;
mod builder;

pub(crate) use builder::build;

#[cfg(test)]
mod tests;
