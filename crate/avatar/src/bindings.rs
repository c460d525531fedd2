//! Functions exported to web pages. The wasm file is separate from the player's, because most pages
//! never load it.

use raconteur_body::figure::Image;
use raconteur_reshape::{Look, NewFace, NewOrgans};
use serde::Serialize;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::prelude::*;

use crate::FaceFile;

/// An avatar as a figure file; `Converted` in `web/element/face/avatar.ts`.
#[derive(Serialize)]
struct Converted {
    glb: Bytes,
    diagnostics: Vec<Diagnostic>,
}

/// Feature of an avatar lost in conversion; `Diagnostic` in `web/element/base/types.ts`.
#[derive(Serialize)]
struct Diagnostic {
    code: &'static str,
    severity: &'static str,
    message: String,
    hints: Vec<&'static str>,
}

/// Bytes that become a `Uint8Array`.
struct Bytes(Vec<u8>);

impl Serialize for Bytes {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_bytes(&self.0)
    }
}

/// Converts an animation of a glTF, GLB or VRM file to the text of a clip: the animation of this
/// name, or the first for an empty name. The exception's message describes the error.
#[wasm_bindgen(js_name = convertAnimation)]
pub fn convert_animation(name: &str, bytes: &[u8]) -> Result<String, JsError> {
    Ok(crate::convert_animation(name, bytes)?)
}

/// Converts a glTF, GLB or VRM file into a figure that `Player.load` accepts; a Raconteur figure is
/// returned unchanged. `name` names the figure. The exception's message describes the fault.
#[wasm_bindgen]
pub fn convert(name: &str, bytes: &[u8]) -> Result<JsValue, JsError> {
    let (glb, diagnostics) = crate::convert(name, bytes)?;
    let converted = Converted {
        glb: Bytes(glb),
        diagnostics: diagnostics
            .into_iter()
            .map(|d| Diagnostic {
                code: d.code,
                severity: "warning",
                message: d.message,
                hints: if d.hint.is_empty() {
                    Vec::new()
                } else {
                    vec![d.hint]
                },
            })
            .collect(),
    };
    Ok(converted.serialize(&Serializer::new())?)
}

/// Exports a figure with a face from a face model as a figure file. `skin`, `organs`, `factors` and
/// `look` are those of `Player.setFace`; `lenders` and `files` are the names and files of figures
/// that provide hair; `painted` is the JPEG or PNG that replaces the skin texture. The exception's
/// message describes the fault.
#[wasm_bindgen(js_name = faceFile)]
#[allow(
    clippy::too_many_arguments,
    clippy::needless_pass_by_value,
    reason = "what JavaScript hands over, where lists arrive as owned only"
)]
pub fn face_file(
    name: &str,
    glb: &[u8],
    skin: &[f64],
    organs: &[f64],
    factors: &[f64],
    look: JsValue,
    lenders: Vec<String>,
    files: Vec<js_sys::Uint8Array>,
    painted: Option<Vec<u8>>,
) -> Result<Vec<u8>, JsError> {
    let organs = NewOrgans::from_numbers(organs)
        .ok_or_else(|| JsError::new("the organs of the head need nine finite numbers"))?;
    let look = if look.is_undefined() {
        Look::default()
    } else {
        serde_wasm_bindgen::from_value(look)?
    };
    let is_png = |bytes: &[u8]| bytes.starts_with(b"\x89PNG");
    let skin_picture = painted.map(|bytes| Image {
        mime_type: if is_png(&bytes) {
            "image/png"
        } else {
            "image/jpeg"
        }
        .to_owned(),
        bytes,
    });
    let files = files.iter().map(js_sys::Uint8Array::to_vec);
    Ok(crate::face_file(FaceFile {
        name,
        glb,
        face: NewFace::from_numbers(skin, factors, organs),
        look: &look,
        lenders: lenders.into_iter().zip(files).collect(),
        skin: skin_picture,
    })?)
}

/// Installs the panic handler when the wasm module is instantiated.
#[wasm_bindgen(start)]
pub fn start() {
    raconteur_base::panic::keep_messages();
}

/// Returns the message and source location of the panic that ended this instance; `None` for any
/// other trap.
#[wasm_bindgen(js_name = panicMessage)]
#[must_use]
pub fn panic_message() -> Option<String> {
    raconteur_base::panic::last_message()
}
