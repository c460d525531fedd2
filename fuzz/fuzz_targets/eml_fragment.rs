//! Bytes as a mind's fragments during a performance.
#![no_main]

#[path = "../../crate/eml/tests/holds/mod.rs"]
mod holds;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| holds::fragment(bytes));
