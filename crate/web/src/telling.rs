//! Plain text as scripts, for pages: what stands between the tags, what somebody types, and words
//! that come piece by piece.

use raconteur_player::eml::telling::{self, Telling};
use serde::Serialize;
use wasm_bindgen::prelude::*;

use crate::player::plain;

/// A text in clauses.
#[derive(Serialize)]
struct Cut<'t> {
    clauses: Vec<&'t str>,
    rest: &'t str,
}

/// A fragment, and what is felt at its end.
#[derive(Serialize)]
struct ToldOn {
    fragment: String,
    feels: String,
}

/// The script that tells a text in a language (BCP 47), up to so many characters, phrase by phrase
/// or not; undefined where it has no word.
#[wasm_bindgen]
#[must_use]
pub fn told(text: &str, language: &str, phrased: bool, most: usize) -> Option<String> {
    let telling = Telling {
        language,
        is_phrased: phrased,
        most,
    };
    telling::told(text, &telling)
}

/// `{fragment, feels}`: the fragment that goes on telling after a text that has left the feeling
/// `felt`, and the one that this leaves; undefined where it has no word.
#[wasm_bindgen(js_name = toldOn)]
pub fn told_on(text: &str, language: &str, felt: &str) -> Result<JsValue, JsError> {
    match telling::told_on(text, language, felt) {
        Some(telling::ToldOn { fragment, feels }) => plain(&ToldOn { fragment, feels }),
        None => Ok(JsValue::UNDEFINED),
    }
}

/// `{clauses, rest}`: the clauses of a text that comes piece by piece, and what may go on; with
/// `whole` nothing more comes.
#[wasm_bindgen(js_name = cutText)]
pub fn cut_text(text: &str, language: &str, whole: bool) -> Result<JsValue, JsError> {
    let telling::Cut { clauses, rest } = telling::cut(text, language, whole);
    plain(&Cut { clauses, rest })
}
