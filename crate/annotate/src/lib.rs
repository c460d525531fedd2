//! Transcriptions of gesture and behaviour in other formats: the Gesture Scripting Language
//! ([`gsl`]), the Gesture Recording Algorithm ([`gestura`]) and files of ANVIL ([`anvil`]) and
//! ELAN ([`elan`]), and their conversion to EML ([`to_eml`]). Scripts in the Behavior Markup
//! Language and in the Signing Gesture Markup Language become EML as well ([`import()`]).
//!
//! [`plain`] is the data of pages, which load this crate as a wasm file of its own.
//!
//! Problems of a file are diagnostics with spans in its decoded text; reading never fails. Times are
//! in seconds of the recording.

pub mod anvil;
#[cfg(target_arch = "wasm32")]
pub mod bindings;
mod bml;
pub mod elan;
pub mod encoding;
pub mod gestura;
pub mod gsl;
mod import;
mod names;
mod orientation;
pub mod plain;
mod script;
mod sigml;
mod to_eml;
pub mod xml;

pub use import::{Format, Imported, Read, import, read_transcription};
pub use to_eml::{Anchoring, fit_pauses, to_eml};
