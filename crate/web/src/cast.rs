//! Performer selected by a story, before a figure is loaded.

use raconteur_player::performer_of;
use wasm_bindgen::prelude::*;

use crate::message::Performer;
use crate::player::plain;

/// Returns the figure, voice and language that a text chooses, as a `Performer`.
#[wasm_bindgen(js_name = performerOf)]
pub fn performer(eml: &str) -> Result<JsValue, JsError> {
    plain(&Performer::from_performer(Some(&performer_of(eml))))
}
