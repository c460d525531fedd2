//! Bytes as a mind's input to `raconteur serve` by TCP: its greeting and its fragments.
#![no_main]

#[path = "../../crate/cli/src/serve/framing.rs"]
mod framing;
#[allow(dead_code, reason = "the line is written by the server")]
#[path = "../../crate/cli/src/serve/greeting.rs"]
mod greeting;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    framing::holds(bytes);
    greeting::holds(bytes);
});
