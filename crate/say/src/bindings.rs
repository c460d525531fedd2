//! What a worker of a page calls.

use std::cell::RefCell;

use anyhow::{Result, anyhow};
use js_sys::{Array, Function, Reflect, Uint8Array};
use raconteur_voice::bake::engine::flite::{Host, Output, SOUND};
use serde::Serialize;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::prelude::*;

thread_local! {
    /// What runs flite; a worker has one thread.
    static RUN: RefCell<Option<Function>> = const { RefCell::new(None) };
}

/// flite in the worker.
struct Worker;

impl Host for Worker {
    /// Calls `run(arguments, files, sound)` of `web/speech/flite-worker.ts`.
    fn run(&self, arguments: &[&str], files: &[(&str, &str)], sound: bool) -> Result<Output> {
        let run = RUN.with_borrow(Clone::clone);
        let run = run.ok_or_else(|| anyhow!("flite is not there"))?;
        let arguments: Array = arguments.iter().map(|a| JsValue::from_str(a)).collect();
        let pair = |(name, text): &(&str, &str)| -> JsValue {
            let both: Array = [name, text].iter().map(|s| JsValue::from_str(s)).collect();
            both.into()
        };
        let files: Array = files.iter().map(pair).collect();
        let sound = if sound {
            JsValue::from_str(SOUND)
        } else {
            JsValue::UNDEFINED
        };
        let fault = |value: JsValue| anyhow!("flite: {}", text_of(&value));
        let out = run
            .call3(&JsValue::NULL, &arguments, &files, &sound)
            .map_err(fault)?;
        let member = |name: &str| Reflect::get(&out, &JsValue::from_str(name)).map_err(fault);
        let wave = member("wave")?;
        Ok(Output {
            printed: member("printed")?.as_string().unwrap_or_default(),
            wave: if wave.is_undefined() {
                Vec::new()
            } else {
                Uint8Array::new(&wave).to_vec()
            },
        })
    }
}

/// What an exception says.
fn text_of(value: &JsValue) -> String {
    let message = Reflect::get(value, &JsValue::from_str("message")).ok();
    let message = message
        .and_then(|m| m.as_string())
        .or_else(|| value.as_string());
    message.unwrap_or_else(|| "failed".to_owned())
}

/// What was said; `Said` in `web/speech/source.ts`.
#[derive(Serialize)]
struct Said {
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

/// Speaks in a page.
#[wasm_bindgen]
pub struct Speaker(crate::Speaker);

#[wasm_bindgen]
impl Speaker {
    /// One who speaks with a voice of flite; `run` runs it. The exception's message names the fault.
    #[wasm_bindgen(constructor)]
    pub fn new(run: Function, voice: &str) -> Result<Speaker, JsError> {
        RUN.set(Some(run));
        Ok(Self(crate::Speaker::new(Worker, voice).map_err(told)?))
    }

    /// Speaks what a script or a list of clauses says and `known`, the text of its bundle, does
    /// not hold. The exception's message names the fault.
    pub fn speak(
        &self,
        eml: &str,
        fragment: bool,
        known: Option<String>,
    ) -> Result<JsValue, JsError> {
        let said = self
            .0
            .speak(eml, fragment, known.as_deref())
            .map_err(told)?;
        let sounds = said
            .sounds
            .into_iter()
            .map(|(file, wave)| (file, Bytes(wave)));
        let said = Said {
            bundle: said.bundle,
            sounds: sounds.collect(),
            problems: said.problems,
        };
        Ok(said.serialize(&Serializer::new())?)
    }
}

fn told(error: anyhow::Error) -> JsError {
    JsError::new(&format!("{error:#}"))
}

/// Runs when an instance is made.
#[wasm_bindgen(start)]
pub fn start() {
    raconteur_base::panic::keep_messages();
}

/// What the panic said that ended this instance, and where in the source; none where it was
/// another trap.
#[wasm_bindgen(js_name = panicMessage)]
#[must_use]
pub fn panic_message() -> Option<String> {
    raconteur_base::panic::last_message()
}
