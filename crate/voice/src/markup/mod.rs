//! Conversion of marked-up text: SABLE, SSML 1.1 and plain text to [`crate::content::Content`] and
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

/// Maximum length of a markup document, bytes.
pub const MAX_DOCUMENT_BYTES: usize = 4 << 20;

/// Maximum nesting depth of markup.
pub const MAX_DEPTH: usize = 100;

/// Namespace for features that SABLE and SSML lack: attributes for exact values, elements for an
/// emotion or an engine.
pub const NAMESPACE: &str = "urn:raconteur:ssml:1";

/// Problem in a markup document, with its position and the handling.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{line}:{column}: {message}")]
pub struct Problem {
    /// Line number, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// Description of the problem and its handling.
    pub message: String,
}
