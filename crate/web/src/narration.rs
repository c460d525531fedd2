//! Plain text as scripts, for pages: the text between the tags, typed text, and streamed words.

use raconteur_player::eml::narration::{self, NarrationOptions};
use serde::Serialize;
use wasm_bindgen::prelude::*;

use crate::player::plain;

/// A text in clauses.
#[derive(Serialize)]
struct ClauseSplit<'t> {
    clauses: Vec<&'t str>,
    rest: &'t str,
}

/// A fragment, and the emotion at its end.
#[derive(Serialize)]
struct NarratedFragment {
    fragment: String,
    emotion: String,
}

/// Returns the script that narrates a text in a language (BCP 47), up to a number of characters,
/// phrase by phrase or not; undefined if it has no word.
#[wasm_bindgen]
#[must_use]
pub fn narrate(text: &str, language: &str, phrased: bool, max_chars: usize) -> Option<String> {
    let options = NarrationOptions {
        language,
        is_phrased: phrased,
        max_chars,
    };
    narration::narrate(text, &options)
}

/// Returns `{fragment, emotion}`: the fragment that continues the narration after a text that ended
/// with the emotion `felt`, and its own final emotion; undefined if it has no word.
#[wasm_bindgen(js_name = continueNarration)]
pub fn continue_narration(text: &str, language: &str, felt: &str) -> Result<JsValue, JsError> {
    match narration::continue_narration(text, language, felt) {
        Some(narration::NarratedFragment { fragment, emotion }) => {
            plain(&NarratedFragment { fragment, emotion })
        }
        None => Ok(JsValue::UNDEFINED),
    }
}

/// Returns `{clauses, rest}`: the clauses of a text that arrives in pieces, and the remainder that
/// may continue; with `whole` the text is complete.
#[wasm_bindgen(js_name = splitClauses)]
pub fn split_clauses(text: &str, language: &str, whole: bool) -> Result<JsValue, JsError> {
    let narration::ClauseSplit { clauses, rest } = narration::split_clauses(text, language, whole);
    plain(&ClauseSplit { clauses, rest })
}
