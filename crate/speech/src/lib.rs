//! Speech that was computed ahead: bundles of audio with words, phones and melody, phone sets
//! and what a mouth does for each phone; words for emotions.
//!
//! Does not: make speech (`voice` does) or move a face (`actor`).

pub mod bundle;
pub mod emotion;
pub mod phones;
mod timed;

pub use bundle::{AudioFile, Bundle, BundleError, Phone, Utterance, Word};
pub use timed::TimedUtterance;
