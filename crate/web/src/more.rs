//! What only some stories need: fragments that come while a story plays, animations that the page
//! fetches, and music.
//!
//! All of it is reached through this module alone, and only where its code has joined this
//! instance: `web/tools/split.mjs` cuts there. Its functions are never inlined, or the code
//! would come along.

use raconteur_player::Player as Performer;
use raconteur_player::eml::Diagnostic;
use wasm_bindgen::prelude::*;

use crate::message::{Performance, Piece, Story, Utterance};
use crate::player::plain;

/// Performs a fragment; a `Performance`.
#[inline(never)]
pub(crate) fn perform(
    performer: &mut Performer,
    mind: u32,
    fragment: &str,
    now_secs: f64,
) -> Result<JsValue, JsError> {
    // It may have joined since the story was read.
    performer.set_motion(true);
    let performed = performer.perform(mind, fragment, now_secs);
    plain(&Performance {
        events: performed.events(fragment, now_secs),
        utterances: performed.utterances.iter().map(Utterance::new).collect(),
        first_utterance: performed.first_utterance,
        end_secs: performer.end_secs(),
    })
}

/// The names of animations that are to be provided.
#[inline(never)]
pub(crate) fn wanted(performer: &Performer) -> Vec<String> {
    performer.wanted_animations()
}

/// Hands a performer animations by name, an empty text for what was not found; what is wrong
/// with them.
#[inline(never)]
pub(crate) fn provide(
    performer: &mut Performer,
    names: &[String],
    texts: &[String],
) -> Vec<Diagnostic> {
    let clips: Vec<(&str, Option<&str>)> = names
        .iter()
        .zip(texts)
        .map(|(name, text)| (name.as_str(), Some(text.as_str()).filter(|t| !t.is_empty())))
        .collect();
    performer.provide_animations(&clips)
}

/// As [`provide`]; the story of this text as it is then, with what is wrong with these
/// animations alone.
#[inline(never)]
pub(crate) fn retell(
    performer: &mut Performer,
    eml: &str,
    names: &[String],
    texts: &[String],
) -> Result<JsValue, JsError> {
    let problems = provide(performer, names, texts);
    plain(&Story::new(
        eml,
        performer.duration_secs(),
        performer.utterances(),
        performer.choice(),
        problems,
    ))
}

/// The music under what is performed; `Piece`s.
#[inline(never)]
pub(crate) fn music(performer: &Performer) -> Result<JsValue, JsError> {
    let music = performer.music().into_iter();
    plain(&music.map(Piece::from).collect::<Vec<_>>())
}
