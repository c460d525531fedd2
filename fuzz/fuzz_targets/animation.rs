//! Text as an animation of the body or of control parameters.
#![no_main]

#[path = "../../crate/actor/tests/holds/mod.rs"]
mod holds;

libfuzzer_sys::fuzz_target!(|text: &str| holds::animation(text));
