//! Other people's avatars, in a wasm module of their own: most pages never load it.

use raconteur_player::body::import::{self, Diagnostic};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// An avatar as a figure file.
#[wasm_bindgen]
pub struct Converted {
    glb: Vec<u8>,
    diagnostics: Vec<Diagnostic>,
}

/// What of an avatar could not be kept.
#[derive(Serialize)]
struct Note<'a> {
    code: &'a str,
    message: &'a str,
    hint: &'a str,
}

#[wasm_bindgen]
impl Converted {
    /// The bytes of the figure, which `Player.load` takes; empty the second time.
    pub fn take_glb(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.glb)
    }

    /// What could not be kept: a list of `{ code, message, hint }`.
    pub fn diagnostics(&self) -> Result<JsValue, JsError> {
        let notes: Vec<Note<'_>> = self
            .diagnostics
            .iter()
            .map(|d| Note {
                code: d.code,
                message: &d.message,
                hint: d.hint,
            })
            .collect();
        Ok(serde_wasm_bindgen::to_value(&notes)?)
    }
}

/// Turns a glTF, GLB or VRM file into a figure; one of ours is written as it is. `name` names
/// the figure. The exception's message names the fault.
#[wasm_bindgen]
pub fn convert(name: &str, bytes: &[u8]) -> Result<Converted, JsError> {
    let (glb, diagnostics) = import::convert(name, bytes)?;
    Ok(Converted { glb, diagnostics })
}
