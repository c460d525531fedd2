//! Kokoro on this machine: the network, run by ONNX Runtime, and the dictionaries, from the folder
//! filled by `npm run voice`.
//!
//! Each run has one thread, so that the audio does not depend on the number of threads; several
//! texts are spoken simultaneously. ONNX Runtime selects its kernels by the processor's
//! instructions, so the last bits of a sample may differ between machines.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use anyhow::{Context as _, Result, anyhow, ensure};
use ort::environment::Environment;
use ort::session::Session;
use ort::value::Tensor;
use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::super::program::{MissingPrograms, Program};
use super::flite::{self, Host as _};
use super::kokoro::{Host, Output};
use super::labels::is_silence;

/// ONNX Runtime, as `web/tools/voice.mjs` calls it.
const RUNTIME: &str = if cfg!(target_os = "macos") {
    "native/libonnxruntime.dylib"
} else if cfg!(windows) {
    "native/onnxruntime.dll"
} else {
    "native/libonnxruntime.so"
};
const MODEL: &str = "model.onnx";
const VOICES: &str = "voices.json";
/// The better dictionary first.
const DICTIONARIES: [&str; 2] = ["us_gold.json", "us_silver.json"];
/// The output that `npm run voice` adds to the model.
const FRAMES: &str = "/encoder/Clip_output_0";
/// Reads languages that the dictionaries are not of; its licence is that of a program that is run.
const ESPEAK: Program = Program {
    name: "espeak-ng",
    package: "espeak-ng",
};
/// Numbers of a style.
const STYLE: usize = 256;

/// Folder that may contain Kokoro.
static FOLDER: OnceLock<PathBuf> = OnceLock::new();

/// Registers a folder to search for Kokoro; the first one registered is used.
pub fn add_folder(folder: PathBuf) {
    FOLDER.get_or_init(|| folder);
}

/// Letters of a word, with variants for some words by part of speech, and at the end of a phrase
/// (`None`).
#[derive(Deserialize)]
#[serde(untagged)]
enum Entry {
    Plain(String),
    By(HashMap<String, Option<String>>),
}

type Dictionary = HashMap<String, Option<Entry>>;

/// Data loaded for synthesis.
struct Speaker {
    tokens: HashMap<char, i64>,
    dictionaries: Vec<Dictionary>,
    environment: Environment,
}

/// Host that runs Kokoro from a folder on this machine.
#[derive(Default)]
pub(super) struct Installed {
    speaker: OnceLock<Speaker>,
    opening: Mutex<()>,
    /// Styles of each voice, by number of tokens.
    styles: Mutex<HashMap<String, Arc<[f32]>>>,
    /// Idle sessions of the neural network.
    sessions: Mutex<Vec<Session>>,
}

/// Returns the folder of a complete installation.
fn folder() -> Result<&'static Path> {
    let folder = FOLDER.get().filter(|folder| {
        let parts = [VOICES, MODEL, RUNTIME];
        parts.iter().all(|part| folder.join(part).is_file())
    });
    let folder = folder.ok_or_else(|| {
        MissingPrograms::without_package(
            "Kokoro's voice is not here; `npm run voice` fetches it".to_owned(),
        )
    })?;
    Ok(folder)
}

fn json<T: DeserializeOwned>(name: &str) -> Result<T> {
    let path = folder()?.join(name);
    let bytes = fs::read(&path).with_context(|| format!("reading {}", path.display()))?;
    serde_json::from_slice(&bytes).with_context(|| format!("reading {}", path.display()))
}

/// Converts an error that is not `Sync`.
fn sync_error(error: impl core::fmt::Display) -> anyhow::Error {
    anyhow!("ONNX Runtime: {error}")
}

impl Speaker {
    fn open() -> Result<Self> {
        #[derive(Deserialize)]
        struct Letters {
            vocab: HashMap<char, i64>,
        }
        let Letters { vocab } = json("vocab.json")?;
        let dictionaries = DICTIONARIES.into_iter().map(json);
        let runtime = ort::init_from(folder()?.join(RUNTIME)).map_err(sync_error)?;
        Ok(Self {
            tokens: vocab,
            dictionaries: dictionaries.collect::<Result<_>>()?,
            environment: runtime.with_telemetry(false).build().map_err(sync_error)?,
        })
    }

    fn session(&self) -> Result<Session> {
        let builder = Session::builder(&self.environment).map_err(sync_error)?;
        let builder = builder.with_intra_threads(1).map_err(sync_error)?;
        let mut builder = builder.with_inter_threads(1).map_err(sync_error)?;
        builder
            .commit_from_file(folder()?.join(MODEL))
            .map_err(sync_error)
    }
}

impl Installed {
    fn speaker(&self) -> Result<&Speaker> {
        if let Some(speaker) = self.speaker.get() {
            return Ok(speaker);
        }
        // A program may have one environment: the other threads wait for the thread that opens it.
        let _open = self.opening.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(speaker) = self.speaker.get() {
            return Ok(speaker);
        }
        let read = Speaker::open()?;
        Ok(self.speaker.get_or_init(|| read))
    }

    /// Returns the style vectors of a voice, concatenated.
    fn styles(&self, voice: &str) -> Result<Arc<[f32]>> {
        let mut known = self.styles.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(styles) = known.get(voice) {
            return Ok(Arc::clone(styles));
        }
        ensure!(
            self.voices()?.iter().any(|v| v == voice),
            "Kokoro has no voice {voice}"
        );
        let path = folder()?.join(format!("{voice}.bin"));
        let bytes = fs::read(&path).with_context(|| format!("reading {}", path.display()))?;
        let (numbers, rest) = bytes.as_chunks::<4>();
        ensure!(
            rest.is_empty() && !numbers.is_empty() && numbers.len().is_multiple_of(STYLE),
            "{} is not a voice",
            path.display()
        );
        let styles: Arc<[f32]> = numbers.iter().map(|n| f32::from_le_bytes(*n)).collect();
        known.insert(voice.to_owned(), Arc::clone(&styles));
        Ok(styles)
    }

    fn run(
        &self,
        session: &mut Session,
        tokens: Vec<i64>,
        style: &[f32],
        pace: f64,
    ) -> Result<Output> {
        let tokens = Tensor::from_array(([1, tokens.len()], tokens)).map_err(sync_error)?;
        let style = Tensor::from_array(([1, STYLE], style.to_vec())).map_err(sync_error)?;
        let speed = Tensor::from_array(([1_usize], vec![pace as f32])).map_err(sync_error)?;
        let inputs = ort::inputs!["tokens" => tokens, "style" => style, "speed" => speed];
        let outputs = session.run(inputs).map_err(sync_error)?;
        let numbers = |name: &str| -> Result<Vec<f32>> {
            let output = outputs.get(name).with_context(|| {
                format!(
                    "the model has no output {name}: it is not the one that `npm run voice` fetches"
                )
            })?;
            let (_, numbers) = output.try_extract_tensor::<f32>().map_err(sync_error)?;
            Ok(numbers.to_vec())
        };
        Ok(Output {
            samples: numbers("audio")?,
            frames: numbers(FRAMES)?,
        })
    }
}

impl Host for Installed {
    fn voices(&self) -> Result<Vec<String>> {
        json(VOICES)
    }

    fn word(&self, word: &str) -> Result<Option<(String, Option<String>)>> {
        let dictionaries = self.speaker()?.dictionaries.iter();
        Ok(dictionaries
            .flat_map(|d| d.get(word)?.as_ref())
            .find_map(|entry| match entry {
                Entry::Plain(letters) => Some((letters.clone(), None)),
                Entry::By(parts) => {
                    let of = |part: &str| parts.get(part).cloned().flatten();
                    Some((of("DEFAULT")?, of("None")))
                }
            }))
    }

    fn ipa(&self, language: &str, text: &str) -> Result<String> {
        let mut command = ESPEAK.command();
        command.args(["-q", "--ipa", "-v", language, "--", text]);
        ESPEAK.run(command)
    }

    fn guess(&self, word: &str) -> Result<String> {
        let said = flite::Installed.run(
            &["-voice", "slt", "-t", word, "-ps", "-o", "none"],
            &[],
            false,
        )?;
        let phones = said.printed.split_whitespace();
        Ok(phones
            .filter(|p| !is_silence(p))
            .collect::<Vec<_>>()
            .join(" "))
    }

    fn infer(&self, voice: &str, letters: &str, pace: f64) -> Result<Output> {
        let speaker = self.speaker()?;
        let tokens = letters.chars().map(|letter| {
            let token = speaker.tokens.get(&letter);
            token
                .copied()
                .with_context(|| format!("Kokoro has no letter {letter}"))
        });
        let tokens: Vec<i64> = tokens.collect::<Result<_>>()?;
        let styles = self.styles(voice)?;
        let row = tokens.len().min(styles.len() / STYLE - 1) * STYLE;
        // A pad before and after.
        let padded = [&[0], tokens.as_slice(), &[0]].concat();
        let free = self
            .sessions
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .pop();
        let mut session = match free {
            Some(session) => session,
            None => speaker.session()?,
        };
        let output = self.run(&mut session, padded, &styles[row..row + STYLE], pace);
        self.sessions
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .push(session);
        output
    }
}
