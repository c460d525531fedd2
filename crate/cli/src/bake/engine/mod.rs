//! Speech engines behind one trait: each is given sentences and gives sound with the times
//! of its phones.
//!
//! Does: run engines, hand them texts that come from strangers, and bring what they print
//! into one shape, corrected by each engine's measured lag.
//! Does not: change rate, pitch, loudness or the length of pauses. Engines speak plainly; the
//! baker does that afterwards in the sound.

mod espeak;
mod espeak_library;
mod festival;
mod flite;
mod ipa;
mod labels;
mod matching;
mod scheme;
mod wave;

use anyhow::{Result, bail};

use raconteur_player::speech::bundle::SentenceKind;
pub(crate) use raconteur_player::speech::content::Gender;
use raconteur_player::speech::plan::Plan;
use raconteur_player::speech::spoken::{Sentence, Spoken, Token};

/// Most tokens that a token's text may have in characters; the baker parts longer ones.
const MOST_CHARACTERS: usize = 40;

/// A voice that an engine has.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct VoiceInfo {
    /// As its engine knows it.
    pub(crate) name: String,
    /// BCP 47 tag.
    pub(crate) language: String,
    /// Where the engine tells.
    pub(crate) gender: Option<Gender>,
    /// One of [`raconteur_player::speech::phones::PHONE_SETS`].
    pub(crate) phone_set: String,
    /// Samples a second; 0 where it is only known once the voice has spoken.
    pub(crate) rate_hz: f64,
    /// How it is made, in a few words.
    pub(crate) what: String,
}

/// Speaks.
pub(crate) trait Engine: Sync {
    /// Its name and version, for example `festival 2.5.0`.
    ///
    /// # Errors
    /// When it is not installed; the message says what to install.
    fn version(&self) -> Result<String>;

    /// What it can speak with.
    ///
    /// # Errors
    /// As [`Engine::version`].
    fn voices(&self) -> Result<Vec<VoiceInfo>>;

    /// Speaks the sentences of one utterance: one [`Spoken`] for each. The same sentences
    /// become the same sound, whoever else speaks at the same time.
    ///
    /// # Errors
    /// When the engine or the voice is not installed, or when what comes back makes no sense.
    fn speak(&self, voice: &str, sentences: &[Sentence]) -> Result<Vec<Spoken>>;

    /// A voice that [`Engine::voices`] does not list, for engines that can vary theirs.
    ///
    /// # Errors
    /// As [`Engine::version`].
    fn voice(&self, name: &str) -> Result<Option<VoiceInfo>> {
        let _ = name;
        Ok(None)
    }

    /// An utterance that was recorded, found by its key or its place in the story: the sound of
    /// all of its sentences. `None` for engines that speak.
    ///
    /// # Errors
    /// When it is not there, or not of what is to be said.
    fn recorded(&self, key: u64, place: usize, plan: &Plan) -> Result<Option<Spoken>> {
        let _ = (key, place, plan);
        Ok(None)
    }

    /// What stands for the files that an utterance is taken from.
    ///
    /// # Errors
    /// As [`Engine::recorded`].
    fn state(&self, key: u64, place: usize) -> Result<String> {
        let _ = (key, place);
        Ok(String::new())
    }
}

/// Where engines find what they need.
#[derive(Clone, Debug, Default)]
pub(crate) struct EngineOptions {
    /// Address of a MaryTTS server.
    pub(crate) server: String,
    /// Folder of recordings.
    pub(crate) recordings: Option<std::path::PathBuf>,
}

/// Which engine has a voice of this name; `ENGINE:VOICE` says it.
pub(crate) fn find_voice(name: &str) -> Option<(String, String)> {
    if let Some((engine, voice)) = name.split_once(':') {
        return ENGINES
            .contains(&engine)
            .then(|| (engine.to_owned(), voice.to_owned()));
    }
    ENGINES.iter().find_map(|engine| {
        let voices = by_name(engine, &EngineOptions::default())
            .ok()?
            .voices()
            .ok()?;
        voices
            .iter()
            .any(|v| v.name == name)
            .then(|| ((*engine).to_owned(), name.to_owned()))
    })
}

/// The samples of a WAV file, one channel, and how many there are in a second.
///
/// # Errors
/// When it is none.
pub(crate) fn read_wave(path: &std::path::Path) -> Result<(Vec<f64>, f64)> {
    let wave = wave::read(path)?;
    Ok((wave.samples, wave.rate_hz))
}

/// The names that [`by_name`] knows.
pub(crate) const ENGINES: [&str; 3] = ["festival", "flite", "espeak-ng"];

/// The engine of a name.
///
/// # Errors
/// When there is none.
pub(crate) fn by_name(name: &str, _options: &EngineOptions) -> Result<Box<dyn Engine>> {
    Ok(match name {
        "festival" => Box::new(festival::Festival),
        "flite" => Box::new(flite::Flite),
        "espeak-ng" => Box::new(espeak::Espeak),
        _ => bail!("no engine {name:?}; there are {}", ENGINES.join(", ")),
    })
}

/// The punctuation from which the engine's phrasing and melody are made.
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
        // A pause is a phrase break; the phrasing model hears those as commas.
        _ if token.pause => ",",
        _ => "",
    };
    meant.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

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
