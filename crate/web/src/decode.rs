//! Decoding of a script's bytes, before an engine is available to read it.

use raconteur_player::eml::{LineIndex, decode};
use serde::Serialize;
use wasm_bindgen::prelude::*;

use crate::message::Diagnostic;
use crate::player::plain;

/// A script that was fetched.
#[derive(Serialize)]
struct DecodedScript {
    text: String,
    /// Diagnostic for bytes that are not UTF-8, which the parser cannot detect; `None` if there are
    /// none.
    #[serde(skip_serializing_if = "Option::is_none")]
    problem: Option<Diagnostic>,
}

/// Returns the text of a script's bytes, with their encoding problem: `{text, problem}`.
#[wasm_bindgen(js_name = decodeScript)]
pub fn decode_script(bytes: Vec<u8>) -> Result<JsValue, JsError> {
    let decoded = decode(bytes);
    let problem = decoded
        .problem
        .map(|d| Diagnostic::new(d, &LineIndex::new(&decoded.text)));
    plain(&DecodedScript {
        text: decoded.text,
        problem,
    })
}
