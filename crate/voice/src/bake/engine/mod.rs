//! Speech engines behind one trait: each converts sentences to audio with the times of its phones.
//!
//! Scope: running engines, passing untrusted texts to them, and converting their output to one
//! structure, corrected by each engine's measured lag.
//! Out of scope: pitch, loudness, the length of pauses and, except for the speech rate that an
//! engine sets itself, the rate. Engines speak plainly; the baker changes the audio afterwards.

mod absent;
mod aligned;
pub mod espeak;
#[cfg_attr(
    target_arch = "wasm32",
    allow(dead_code, reason = "no engine is available there")
)]
mod espeak_events;
#[cfg_attr(target_arch = "wasm32", path = "espeak_nowhere.rs")]
mod espeak_library;
mod festival;
pub mod flite;
#[cfg_attr(target_arch = "wasm32", path = "http_nowhere.rs")]
mod http;
pub mod kokoro;
#[cfg_attr(target_arch = "wasm32", path = "kokoro_nowhere.rs")]
mod kokoro_network;
mod labels;
mod loudness;
mod mary;
mod matching;
mod recording;
mod registry;
mod scheme;
pub mod server;
mod wave;

pub use absent::MissingEngine;
#[cfg(not(target_arch = "wasm32"))]
pub use kokoro_network::add_folder;
pub use registry::{ENGINES, Machine, by_name, hosted};

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use anyhow::Result;

pub use crate::content::Gender;
use crate::plan::Plan;
use crate::spoken::{Sentence, Spoken, Token};
use raconteur_eml::nearest;
use raconteur_speech::bundle::SentenceKind;

use super::program::MissingPrograms;
use registry::LOCAL_ENGINES;

/// Maximum number of characters that an engine reads of a token; the baker splits longer ones.
const MAX_CHARACTERS: usize = 40;

/// Description of a voice that an engine provides.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VoiceInfo {
    /// Name of the voice in its engine.
    pub name: String,
    /// BCP 47 language tag of the voice.
    pub language: String,
    /// Sex, if the engine specifies it.
    pub gender: Option<Gender>,
    /// Phone set of the voice, one of [`raconteur_speech::phones::PHONE_SETS`].
    pub phone_set: String,
    /// Sample rate in hertz; 0 if it is unknown before the first synthesis.
    pub rate_hz: f64,
    /// Short description of the synthesis method.
    pub what: String,
}

/// Remark about a recording that deviates from the script, with a suggested fix.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// Code for programs: `phones-unknown` and so on; see `docs/voices.md`.
    pub code: &'static str,
    /// Recording and the problem with it.
    pub message: String,
    /// Suggested fix for the author.
    pub hint: &'static str,
}

/// Recording of an utterance with its alignment, used instead of synthesised speech.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recorded {
    /// Audio of the recording and the times of its phones.
    pub spoken: Spoken,
    /// Remarks on repairs and guesses made while reading the recording.
    pub remarks: Vec<Remark>,
}

/// Speech synthesis engine: lists its voices and speaks sentences with phone times.
pub trait Engine: Sync {
    /// Returns name and version of the engine, for example `festival 2.5.0`.
    ///
    /// # Errors
    /// Returns an error if the engine is not installed; the message names the missing software.
    fn version(&self) -> Result<String>;

    /// Returns the available voices.
    ///
    /// # Errors
    /// Returns the same errors as [`Engine::version`].
    fn voices(&self) -> Result<Vec<VoiceInfo>>;

    /// Speaks the sentences of one utterance: one [`Spoken`] for each. The same sentences give the
    /// same audio, whatever other voices are active concurrently.
    ///
    /// # Errors
    /// Returns an error if the engine or the voice is not installed, or if the output is invalid.
    fn speak(&self, voice: &str, sentences: &[Sentence]) -> Result<Vec<Spoken>>;

    /// Returns true if the engine applies the speech rate of a sentence itself; otherwise the baker
    /// changes the audio.
    fn keeps_pace(&self) -> bool {
        false
    }

    /// Returns the share of an emotion's vocal effect applied to the audio, 0 to 1.
    fn feeling(&self) -> f64 {
        1.0
    }

    /// Returns the voice of this name, including one that [`Engine::voices`] does not list.
    ///
    /// # Errors
    /// Returns the same errors as [`Engine::version`].
    fn voice(&self, name: &str) -> Result<Option<VoiceInfo>> {
        Ok(self.voices()?.into_iter().find(|v| v.name == name))
    }

    /// Returns the recording of a whole utterance, for engines that do not speak, by its key or its
    /// position in the story, from 0. The result counts the tokens of all sentences in order.
    /// `None` if there is no recording.
    ///
    /// # Errors
    /// Returns an error if there is a recording that cannot be read or contains other words.
    fn recorded(&self, key: u64, place: usize, plan: &Plan) -> Result<Option<Recorded>> {
        let _ = (key, place, plan);
        Ok(None)
    }

    /// Returns a short text that identifies everything else on which [`Engine::recorded`] depends;
    /// empty for engines that speak.
    ///
    /// # Errors
    /// Returns an error if a recording cannot be read.
    fn state(&self, key: u64, place: usize) -> Result<String> {
        let _ = (key, place);
        Ok(String::new())
    }
}

/// Error returned while an engine is still loading; the caller retries later.
#[derive(Clone, Copy, Debug, thiserror::Error)]
#[error("the voice is not ready yet")]
pub struct Pending;

/// Options required by some engines: the address of a server, the folder of recordings.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct EngineOptions {
    /// Address of a MARY server, `host:port`; empty if there is none.
    pub server: String,
    /// Folder of recordings; `None` if there is none.
    pub recordings: Option<PathBuf>,
}

/// Reads a WAV of any width and rate: mono samples, −1 to 1, and samples a second.
///
/// # Errors
/// Returns an error if the file does not exist or is not a complete WAV file.
pub fn read_wave(path: &Path) -> Result<(Vec<f64>, f64)> {
    let wave = wave::read(path)?;
    Ok((wave.samples, wave.rate_hz))
}

/// Engine on this machine: its name, and its voices or the missing programs.
type Local = (&'static str, Result<Vec<VoiceInfo>, MissingPrograms>);

/// Returns the engines of this machine with their voices, in order of preference. They are queried
/// once.
pub fn local() -> &'static [Local] {
    static LOCAL: OnceLock<[Local; LOCAL_ENGINES.len()]> = OnceLock::new();
    LOCAL.get_or_init(|| {
        let options = EngineOptions::default();
        LOCAL_ENGINES.map(|name| {
            let voices = by_name(name, &options).and_then(|engine| engine.voices());
            (
                name,
                voices.map_err(|error| MissingPrograms::from_error(&error)),
            )
        })
    })
}

/// Returns a hint for a voice that no engine has.
pub fn voice_hint(name: &str) -> String {
    if let Some((engine, _)) = name.split_once(':')
        && !ENGINES.contains(&engine)
    {
        return hint_among(engine, &ENGINES);
    }
    let all = local()
        .iter()
        .filter_map(|(_, voices)| voices.as_ref().ok());
    let names: Vec<&str> = all.flatten().map(|v| v.name.as_str()).collect();
    hint_among(name, &names)
}

/// Returns a hint for an unknown name: the most similar known name, if any, and the command that
/// lists all names.
pub fn hint_among(name: &str, known: &[&str]) -> String {
    let list = "see raconteur bake --list-voices";
    match nearest(name, known.iter().copied()) {
        Some(near) => format!("did you mean {near}? ({list})"),
        None => list.to_owned(),
    }
}

/// Returns the engine with a voice of this name, and the engine's name for the voice.
/// `ENGINE:VOICE` names both. Otherwise the engines installed on this machine are queried, in the
/// order of [`ENGINES`]; `None` if none has the voice.
pub fn find_voice(name: &str) -> Option<(String, String)> {
    if let Some((engine, voice)) = name.split_once(':') {
        let engine = ENGINES.into_iter().find(|e| *e == engine)?;
        return Some((engine.to_owned(), voice.to_owned()));
    }
    local().iter().find_map(|(engine, voices)| {
        // Variants of espeak-ng: `de+f3`.
        let base = match name.split_once('+') {
            Some((base, _)) if *engine == "espeak-ng" => base,
            _ => name,
        };
        let has = voices.iter().flatten().any(|v| v.name == base);
        has.then(|| ((*engine).to_owned(), name.to_owned()))
    })
}

/// Returns the punctuation after a token, from which the engine derives phrasing and intonation.
pub(super) fn punctuation(token: &Token, ends: Option<SentenceKind>) -> String {
    let written: String = token
        .punctuation
        .chars()
        .filter(|c| ",.;:!?".contains(*c))
        .take(3)
        .collect();
    if !written.is_empty() {
        return written;
    }
    let meant = match ends {
        Some(SentenceKind::Question) => "?",
        Some(SentenceKind::Exclamation) => "!",
        Some(SentenceKind::Continuation) => ",",
        // A pause is a phrase break; the phrasing model treats those as commas.
        _ if token.pause => ",",
        _ => "",
    };
    meant.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn engines_have_names_and_some_need_options() {
        let options = EngineOptions::default();
        for name in ["kokoro", "festival", "flite", "espeak-ng"] {
            assert!(by_name(name, &options).is_ok(), "{name}");
        }
        for name in ["marytts", "recordings", "sapi", ""] {
            assert!(by_name(name, &options).is_err(), "{name}");
        }
        let options = EngineOptions {
            server: "localhost:59125".to_owned(),
            recordings: Some(PathBuf::from("voices")),
        };
        assert!(
            ENGINES.iter().all(|name| by_name(name, &options).is_ok()),
            "every engine accepts the options"
        );
    }

    #[test]
    fn a_voice_may_name_its_engine() {
        let found = |name| find_voice(name).map(|(e, v)| format!("{e} {v}"));
        assert_eq!(found("espeak-ng:de+f2").as_deref(), Some("espeak-ng de+f2"));
        assert_eq!(found("marytts:cmu-slt").as_deref(), Some("marytts cmu-slt"));
        assert_eq!(found("sapi:Anna"), None);
        assert_eq!(found("no_such_diphone"), None);
    }

    #[test]
    fn what_is_not_written_is_heard_from_the_kind_of_sentence() {
        use SentenceKind::{Continuation, Exclamation, Question, Statement};
        let token = |punctuation: &str, pause| Token {
            punctuation: punctuation.to_owned(),
            pause,
            ..Token::default()
        };
        for (written, pause, kind, heard) in [
            ("", false, None, ""),
            ("", true, None, ","),
            ("", true, Some(Statement), ","),
            ("", false, Some(Question), "?"),
            ("", false, Some(Exclamation), "!"),
            ("", false, Some(Continuation), ","),
            (".", true, Some(Question), "."),
            ("?\"!", false, None, "?!"),
        ] {
            assert_eq!(punctuation(&token(written, pause), kind), heard);
        }
    }
}
