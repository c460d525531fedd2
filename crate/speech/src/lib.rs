//! Speech that was computed ahead: bundles of audio with words, phones and melody, phone sets
//! and what a mouth does for each phone; words for emotions. Behind `bake`: what is to be
//! said and how, and the means to make its sound: markup, text, signal, alignments of other
//! programs.
//!
//! Does not: run speech engines (the command line does) or move a face (`actor`).

#[cfg(feature = "bake")]
pub mod align;
#[cfg(feature = "bake")]
pub mod assemble;
pub mod bundle;
#[cfg(feature = "bake")]
pub mod compare;
#[cfg(feature = "bake")]
pub mod content;
pub mod emotion;
#[cfg(feature = "bake")]
pub mod feel;
#[cfg(feature = "bake")]
pub mod hear;
#[cfg(feature = "bake")]
pub mod language;
#[cfg(feature = "bake")]
pub mod manner;
#[cfg(feature = "bake")]
pub mod markup;
pub mod phones;
#[cfg(feature = "bake")]
pub mod plan;
#[cfg(feature = "bake")]
pub mod realise;
#[cfg(feature = "bake")]
pub mod resolve;
#[cfg(feature = "bake")]
pub mod signal;
#[cfg(feature = "bake")]
pub mod spoken;
#[cfg(feature = "bake")]
pub mod style;
#[cfg(feature = "bake")]
pub mod text;

pub use bundle::{AudioFile, Bundle, BundleError, Phone, Utterance, Word};
