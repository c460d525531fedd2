//! Bytes as a whole EML script: read, checked, resolved and queried.
#![no_main]

#[path = "../../crate/eml/tests/holds/mod.rs"]
mod holds;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| holds::document(bytes));
