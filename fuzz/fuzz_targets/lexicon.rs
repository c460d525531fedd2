//! Text as a lexicon of pronunciations.
#![no_main]

#[path = "../../crate/voice/tests/holds/mod.rs"]
mod holds;

libfuzzer_sys::fuzz_target!(|text: &str| holds::lexicon(text));
