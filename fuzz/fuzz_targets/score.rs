//! Text as a score of music: notes, without audio.
#![no_main]

/// Modules of the composer, included directly: the command-line library would also bring in an
/// instrumented renderer.
#[allow(dead_code, reason = "the sound of notes is not made here")]
#[path = "../../crate/cli/src/compose"]
mod compose {
    mod drum;
    mod harmony;
    pub(crate) mod instrument;
    pub(crate) mod note;
    pub(crate) mod score;
    pub(crate) mod signal;
}

libfuzzer_sys::fuzz_target!(|text: &str| compose::score::holds(text));
