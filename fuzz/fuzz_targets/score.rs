//! Text as a score of music: notes, without the sound of them.
#![no_main]

/// The library of the command line would bring a renderer, instrumented, so the modules are taken as
/// they lie there.
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
