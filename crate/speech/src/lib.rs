//! Speech that was computed ahead: bundles of audio with words, phones and melody, phone sets
//! and what a mouth does for each phone; words for emotions. Behind `bake`: what is to be
//! said and how, and the means to make its sound: markup, text, signal, alignments of other
//! programs.
//!
//! Does not: run speech engines (the command line does) or move a face (`actor`).

pub mod bundle;
pub mod emotion;
pub mod phones;

pub use bundle::{AudioFile, Bundle, BundleError, Phone, Utterance, Word};
