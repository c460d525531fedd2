//! Functions exported to a page's worker.

use js_sys::Object;
use raconteur_voice::bake::page;
use serde::Serialize;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::prelude::*;

use crate::hosts;

/// Spoken audio; `SpokenAudio` in `web/speech/source.ts`.
#[derive(Serialize)]
struct SpokenAudio {
    bundle: String,
    sounds: Vec<(String, Bytes)>,
    problems: Vec<String>,
}

/// Bytes that become a `Uint8Array`.
struct Bytes(Vec<u8>);

impl Serialize for Bytes {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_bytes(&self.0)
    }
}

/// Speech synthesiser with one voice, for web pages.
#[wasm_bindgen]
pub struct Speaker(crate::Speaker);

#[wasm_bindgen]
impl Speaker {
    /// Creates a speaker with a voice of an engine, which `host` runs. The exception's message
    /// describes the fault.
    #[wasm_bindgen(constructor)]
    pub fn new(engine: &str, host: Object, voice: &str) -> Result<Speaker, JsError> {
        let run = hosts::engine(engine, host).map_err(js_error)?;
        Ok(Self(
            crate::Speaker::new(engine, run, voice).map_err(js_error)?,
        ))
    }

    /// Begins to speak the parts of a script or a list of clauses missing in `known`, the text of
    /// its bundle. The exception's message describes the fault.
    pub fn begin(
        &self,
        eml: &str,
        fragment: bool,
        known: Option<String>,
    ) -> Result<PendingSpeech, JsError> {
        let saying = self.0.begin(eml, fragment, known.as_deref());
        Ok(PendingSpeech(saying.map_err(js_error)?))
    }

    /// Speaks the next utterance, or lets the host prepare for it; returns false if there is none.
    /// The exception's message describes the fault.
    pub fn step(&self, saying: &mut PendingSpeech) -> Result<bool, JsError> {
        self.0.step(&mut saying.0).map_err(js_error)
    }
}

/// Synthesis of a script's speech in progress, advanced one utterance at a time by the page.
#[wasm_bindgen]
pub struct PendingSpeech(page::PageBake);

#[wasm_bindgen]
impl PendingSpeech {
    /// Returns the speech up to now, with the new audio and problems.
    pub fn take(&mut self) -> Result<JsValue, JsError> {
        let sounds = self.0.take_sounds().into_iter();
        let said = SpokenAudio {
            bundle: self.0.bundle(),
            sounds: sounds.map(|(file, wave)| (file, Bytes(wave))).collect(),
            problems: self.0.take_problems(),
        };
        Ok(said.serialize(&Serializer::new())?)
    }
}

fn js_error(error: anyhow::Error) -> JsError {
    JsError::new(&format!("{error:#}"))
}

/// Installs the panic handler when the wasm module is instantiated.
#[wasm_bindgen(start)]
pub fn start() {
    raconteur_base::panic::keep_messages();
}

/// Returns the message and source location of the panic that ended this instance; `None` for
/// another trap.
#[wasm_bindgen(js_name = panicMessage)]
#[must_use]
pub fn panic_message() -> Option<String> {
    raconteur_base::panic::last_message()
}
