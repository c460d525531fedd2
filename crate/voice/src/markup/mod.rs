//! Marked-up text in and out: SABLE, SSML 1.1 and plain text become [`crate::content::Content`] and
//! back. No DTD is processed, nothing is fetched, and every size is bounded.

pub(crate) mod build;
pub(crate) mod divisions;
pub mod levels;
pub mod plain;
pub mod sable;
pub mod ssml;
pub(crate) mod write;
pub(crate) mod xml;

#[cfg(test)]
mod round_trip;

/// The longest document, bytes.
pub const MAX_DOCUMENT_BYTES: usize = 4 << 20;

/// How many markups may be inside each other.
pub const MAX_DEPTH: usize = 100;

/// The namespace of what SABLE and SSML cannot say: an attribute of its own for an exact
/// value, an element for an emotion or an engine.
pub const NAMESPACE: &str = "urn:raconteur:ssml:1";

/// Something in a document that could not be taken as it stands.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{line}:{column}: {message}")]
pub struct Problem {
    /// From 1.
    pub line: usize,
    /// In characters, from 1.
    pub column: usize,
    /// What is wrong and what became of it.
    pub message: String,
}
