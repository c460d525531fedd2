//! Speech made ahead of time: from what a story says to a bundle of sound, words, phones and
//! melody that a player reads.
//!
//! Does: text as it is spoken, markup (SABLE, SSML), prosody of styles and emotions, signal
//! processing, alignments of other programs, speech engines, and [`bake`], which runs them.
//! Does not: play anything; nothing that plays depends on this crate.

pub mod align;
pub mod assemble;
pub mod bake;
mod borders;
pub mod compare;
pub mod content;
mod delivery;
pub mod emotion;
pub mod files;
mod ipa;
pub mod language;
pub mod manner;
pub mod markup;
pub mod measured_speech;
pub mod plan;
pub mod prosody;
pub mod realise;
pub mod request;
pub mod resolve;
pub mod signal;
pub mod spoken;
pub mod style;
pub mod text;

pub use request::{Source, SpeechRequest, content_of, speech_requests};
