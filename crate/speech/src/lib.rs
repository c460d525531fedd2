//! Precomputed speech: bundles of audio with words, phones and pitch contour, phone sets and the
//! mouth shape of each phone; words for emotions.
//!
//! Out of scope: speech synthesis (`voice`) and face motion (`actor`).

pub mod bundle;
pub mod emotion;
pub mod phones;
mod timed;

pub use bundle::{AudioFile, Bundle, BundleError, Phone, Utterance, Word};
pub use timed::TimedUtterance;
