//! Speech engines of the worker, in JavaScript objects.

use std::cell::RefCell;

use anyhow::{Result, anyhow, bail};
use js_sys::{Array, Float32Array, Function, Int16Array, Object, Reflect, Uint8Array};
use raconteur_voice::bake::engine::espeak::{self, Event, EventKind, Synthesis, TracedText};
use raconteur_voice::bake::engine::flite::{self, Output, SOUND};
use raconteur_voice::bake::engine::kokoro;
use raconteur_voice::bake::engine::server::{self, Server};
use raconteur_voice::bake::engine::{Engine, Machine, Pending, hosted};
use wasm_bindgen::prelude::*;

thread_local! {
    /// EventKind runs the engine; a worker has one thread and one engine.
    static HOST: RefCell<Option<Object>> = const { RefCell::new(None) };
}

/// Returns the speech engine of a name, run by `host`: a class of `web/speech` or of a package.
pub(crate) fn engine(name: &str, host: Object) -> Result<Box<dyn Engine>> {
    HOST.set(Some(host));
    if let Some(engine) = hosted(name, &Worker) {
        return Ok(engine);
    }
    Ok(match name {
        "server" => Box::new(Server(Worker)),
        _ => bail!("no engine {name:?} speaks in a page"),
    })
}

/// The engine in the worker.
struct Worker;

impl Machine for Worker {
    fn kokoro(&self) -> impl kokoro::Host + 'static {
        Self
    }

    fn flite(&self) -> impl flite::Host + 'static {
        Self
    }

    fn espeak(&self) -> impl espeak::Host + 'static {
        Self
    }
}

/// Calls a function of the host.
fn call(name: &str, arguments: &[JsValue]) -> Result<JsValue> {
    let host = HOST.with_borrow(Clone::clone);
    let host = host.ok_or_else(|| anyhow!("the engine is not there"))?;
    let function: Function = member(&host, name)?
        .dyn_into()
        .map_err(|_| anyhow!("the engine has no {name}"))?;
    let arguments: Array = arguments.iter().collect();
    function.apply(&host, &arguments).map_err(fault)
}

fn member(of: &JsValue, name: &str) -> Result<JsValue> {
    Reflect::get(of, &JsValue::from_str(name)).map_err(fault)
}

fn fault(value: JsValue) -> anyhow::Error {
    let message = Reflect::get(&value, &JsValue::from_str("message")).ok();
    let message = message
        .and_then(|m| m.as_string())
        .or_else(|| value.as_string());
    anyhow!(
        "{}",
        message.unwrap_or_else(|| "the engine failed".to_owned())
    )
}

fn strings(all: &[&str]) -> Array {
    all.iter().map(|s| JsValue::from_str(s)).collect()
}

impl flite::Host for Worker {
    fn run(&self, arguments: &[&str], files: &[(&str, &str)], sound: bool) -> Result<Output> {
        let files: Array = files
            .iter()
            .map(|(name, text)| JsValue::from(strings(&[name, text])))
            .collect();
        let sound = if sound {
            JsValue::from_str(SOUND)
        } else {
            JsValue::UNDEFINED
        };
        let out = call("run", &[strings(arguments).into(), files.into(), sound])?;
        let wave = member(&out, "wave")?;
        Ok(Output {
            printed: member(&out, "printed")?.as_string().unwrap_or_default(),
            wave: if wave.is_undefined() {
                Vec::new()
            } else {
                Uint8Array::new(&wave).to_vec()
            },
        })
    }
}

impl espeak::Host for Worker {
    fn version(&self) -> Result<String> {
        Ok(call("version", &[])?.as_string().unwrap_or_default())
    }

    fn files(&self, folder: &str) -> Result<Vec<String>> {
        Ok(texts(&call("files", &[JsValue::from_str(folder)])?).collect())
    }

    fn text(&self, path: &str) -> Result<String> {
        let text = call("text", &[JsValue::from_str(path)])?;
        Ok(text.as_string().unwrap_or_default())
    }

    fn speak(&self, voice: &str, texts: &[String]) -> Result<Vec<Synthesis>> {
        texts
            .iter()
            .map(|text| {
                let said = call("say", &[JsValue::from_str(voice), JsValue::from_str(text)])?;
                espeak::named(traced(&said)?, voice)
            })
            .collect()
    }
}

/// Calls a function of the host, which returns nothing while it prepares.
fn answer(name: &str, arguments: &[JsValue]) -> Result<JsValue> {
    let answer = call(name, arguments)?;
    if answer.is_undefined() {
        return Err(Pending.into());
    }
    Ok(answer)
}

fn texts(of: &JsValue) -> impl Iterator<Item = String> + use<> {
    Array::from(of)
        .iter()
        .filter_map(|text| text.as_string())
        .collect::<Vec<_>>()
        .into_iter()
}

impl kokoro::Host for Worker {
    fn voices(&self) -> Result<Vec<String>> {
        Ok(texts(&call("voices", &[])?).collect())
    }

    fn word(&self, word: &str) -> Result<Option<(String, Option<String>)>> {
        let mut letters = texts(&call("word", &[JsValue::from_str(word)])?);
        Ok(letters.next().map(|usual| (usual, letters.next())))
    }

    fn ipa(&self, _language: &str, _text: &str) -> Result<String> {
        bail!("in a page Kokoro speaks English alone")
    }

    fn guess(&self, word: &str) -> Result<String> {
        let phones = answer("guess", &[JsValue::from_str(word)])?;
        Ok(phones.as_string().unwrap_or_default())
    }

    fn infer(&self, voice: &str, letters: &str, pace: f64) -> Result<kokoro::Output> {
        let said = [
            JsValue::from_str(voice),
            JsValue::from_str(letters),
            JsValue::from_f64(pace),
        ];
        let out = answer("infer", &said)?;
        Ok(kokoro::Output {
            samples: Float32Array::new(&member(&out, "samples")?).to_vec(),
            frames: Float32Array::new(&member(&out, "frames")?).to_vec(),
        })
    }
}

impl server::Host for Worker {
    fn voices(&self) -> Result<String> {
        Ok(call("voices", &[])?.as_string().unwrap_or_default())
    }

    fn ask(&self, request: &str) -> Result<server::Answer> {
        let out = answer("ask", &[JsValue::from_str(request)])?;
        Ok(server::Answer {
            sound: Uint8Array::new(&member(&out, "sound")?).to_vec(),
            times: member(&out, "times")?.as_string().unwrap_or_default(),
        })
    }
}

/// Converts the events that espeak-ng reported for a text.
fn traced(said: &JsValue) -> Result<TracedText> {
    let events = Array::from(&member(said, "events")?);
    let number = |value: JsValue| value.as_f64().unwrap_or_default() as usize;
    let mut out = TracedText {
        samples: Int16Array::new(&member(said, "samples")?).to_vec(),
        rate_hz: number(member(said, "rateHz")?) as u32,
        events: Vec::new(),
        marked: member(said, "marked")?.as_string().unwrap_or_default(),
    };
    for event in events.iter() {
        let kind = member(&event, "kind")?.as_string().unwrap_or_default();
        let what = match kind.as_str() {
            "word" => EventKind::Word(number(member(&event, "position")?)),
            "phone" => EventKind::Phone(member(&event, "symbol")?.as_string().unwrap_or_default()),
            _ => EventKind::End,
        };
        let sample = number(member(&event, "sample")?);
        out.events.push(Event { sample, what });
    }
    Ok(out)
}
