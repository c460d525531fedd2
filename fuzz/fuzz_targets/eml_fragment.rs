//! Bytes as what a mind sends during a performance.
#![no_main]

#[path = "../../crate/eml/tests/holds/mod.rs"]
mod holds;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| holds::fragment(bytes));
