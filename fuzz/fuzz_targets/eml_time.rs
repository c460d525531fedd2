//! Bytes as a time expression, between names that are defined and names that are not.
#![no_main]

#[path = "../../crate/eml/tests/holds/mod.rs"]
mod holds;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| holds::time(bytes));
