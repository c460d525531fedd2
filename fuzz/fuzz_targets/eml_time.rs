//! Bytes as a time expression, between defined and undefined names.
#![no_main]

#[path = "../../crate/eml/tests/holds/mod.rs"]
mod holds;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| holds::time(bytes));
