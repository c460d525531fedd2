//! Precomputed speech: from the speech content of a story to a bundle of audio, words, phones and
//! pitch contour for the player.
//!
//! Scope: spoken text, markup (SABLE, SSML), prosody of styles and emotions, signal processing,
//! alignments of other programs, speech engines, and [`bake`], which runs them.
//! Out of scope: playback; no runtime crate depends on this crate.

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
