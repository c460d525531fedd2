//! Speech that was computed ahead: bundles of audio with words and phones, phone sets
//! and what a mouth does for each phone.
//!
//! Does: read and check a speech bundle, find an utterance, tell phones and words by
//! time; the phone table with visual targets and dominance.
//! Does not: synthesise (the command line bakes) or move a face (`actor`).

#[cfg(feature = "bake")]
pub mod align;
pub mod bundle;
pub mod content;
pub mod phones;
#[cfg(feature = "bake")]
pub mod signal;
#[cfg(feature = "bake")]
pub mod text;

pub use bundle::{AudioFile, Bundle, BundleError, Phone, Utterance, Word};
pub use content::{Content, Segment};
