//! Who speaks: the engines that are needed, the voices that they have, and which of them a
//! sentence is for.

use std::collections::BTreeMap;
use std::sync::Mutex;

use anyhow::{Context as _, Result, anyhow};
use raconteur_player::speech::content::{Gender, Speaker};
use raconteur_player::speech::language;

use super::engine::{self, Engine, EngineOptions, VoiceInfo};

/// A voice and the engine that has it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Role {
    /// The engine's name.
    pub(crate) engine: String,
    /// The voice.
    pub(crate) voice: VoiceInfo,
}

/// Engines that have been asked for once are kept: asking them takes time.
pub(crate) struct Cast {
    options: EngineOptions,
    known: Mutex<BTreeMap<String, &'static Known>>,
    /// The story's own voice.
    pub(crate) lead: Role,
    /// The story's own language, a tag of BCP 47; none: that of the voice.
    pub(crate) language: Option<String>,
}

struct Known {
    engine: Box<dyn Engine>,
    version: String,
    voices: Vec<VoiceInfo>,
}

impl Cast {
    /// A cast whose lead speaks with a voice of an engine; without a name, with the first that
    /// the engine has.
    ///
    /// # Errors
    /// When the engine is not installed or has no such voice.
    pub(crate) fn new(engine: &str, voice: Option<&str>, options: EngineOptions) -> Result<Self> {
        let mut cast = Self {
            options,
            known: Mutex::new(BTreeMap::new()),
            lead: Role {
                engine: engine.to_owned(),
                voice: VoiceInfo::default(),
            },
            language: None,
        };
        cast.lead.voice = match voice {
            Some(voice) => cast.voice(engine, voice)?,
            None => {
                let known = cast.known(engine)?;
                // Recordings have no voices, and one that stands for all of them.
                let first = known.voices.first().cloned();
                let any = || known.engine.voice("recorded").ok().flatten();
                first
                    .or_else(any)
                    .with_context(|| format!("{engine} has no voice"))?
            }
        };
        Ok(cast)
    }

    /// What names no other language is said in this one, a tag of BCP 47; by another voice
    /// where the lead's does not speak it.
    ///
    /// # Errors
    /// When no voice speaks it.
    pub(crate) fn speak_in(&mut self, tag: String) -> Result<()> {
        self.lead = self.role(&self.lead, &Speaker::default(), &tag)?;
        self.language = Some(tag);
        Ok(())
    }

    fn known(&self, name: &str) -> Result<&'static Known> {
        let mut known = self
            .known
            .lock()
            .map_err(|_| anyhow!("another thread failed"))?;
        if let Some(one) = known.get(name) {
            return Ok(one);
        }
        let engine = engine::by_name(name, &self.options)?;
        let one = Known {
            version: engine.version()?,
            voices: engine.voices()?,
            engine,
        };
        // A handful of engines live as long as the program; so threads need not share a lock.
        let one: &'static Known = Box::leak(Box::new(one));
        known.insert(name.to_owned(), one);
        Ok(one)
    }

    /// A voice by its name.
    fn voice(&self, engine: &str, name: &str) -> Result<VoiceInfo> {
        let known = self.known(engine)?;
        if let Some(voice) = known.voices.iter().find(|v| v.name == name) {
            return Ok(voice.clone());
        }
        known.engine.voice(name)?.with_context(|| {
            let names: Vec<&str> = known.voices.iter().map(|v| v.name.as_str()).collect();
            let some = names[..names.len().min(12)].join(", ");
            format!(
                "{engine} has no voice {name}; it has {some}; {}",
                engine::hint_among(name, &names)
            )
        })
    }

    /// The engine of a role.
    ///
    /// # Errors
    /// When it is not installed.
    pub(crate) fn engine(&self, role: &Role) -> Result<&'static dyn Engine> {
        Ok(self.known(&role.engine)?.engine.as_ref())
    }

    /// The version of a role's engine.
    ///
    /// # Errors
    /// When it is not installed.
    pub(crate) fn version(&self, role: &Role) -> Result<&'static str> {
        Ok(&self.known(&role.engine)?.version)
    }

    /// The voice that a script names, `VOICE` or `ENGINE:VOICE`.
    ///
    /// # Errors
    /// When there is none of that name; the message says what to do.
    pub(crate) fn named(&self, name: &str) -> Result<Role> {
        let (engine, voice) = engine::find_voice(name).with_context(|| {
            format!("no engine has a voice {name}; {}", engine::voice_hint(name))
        })?;
        Ok(Role {
            voice: self.voice(&engine, &voice)?,
            engine,
        })
    }

    /// Who speaks a sentence: the named speaker, else `usual`, unless the sentence is in
    /// another language than that voice's or asks for another sex; then a voice that fits.
    ///
    /// # Errors
    /// When an engine that is needed is not installed.
    pub(crate) fn role(&self, usual: &Role, speaker: &Speaker, tag: &str) -> Result<Role> {
        let mut role = match &speaker.name {
            Some(name) => self.named(name)?,
            None => usual.clone(),
        };
        let speaks =
            |voice: &VoiceInfo| language::primary(&voice.language) == language::primary(tag);
        let fits = |voice: &VoiceInfo| {
            speaker.gender.is_none() || voice.gender.is_none() || voice.gender == speaker.gender
        };
        if speaker.name.is_none() && !fits(&role.voice) {
            let voices = &self.known(&role.engine)?.voices;
            if let Some(other) = voices.iter().find(|v| speaks(v) && fits(v)) {
                role.voice = other.clone();
            }
        }
        if !speaks(&role.voice) {
            // espeak-ng speaks nearly everything.
            let gender = speaker.gender.or(role.voice.gender);
            let variant = match gender {
                Some(Gender::Female) => "+f2",
                _ => "",
            };
            role = self
                .named(&format!("espeak-ng:{tag}{variant}"))
                .or_else(|_| {
                    let primary = language::primary(tag);
                    self.named(&format!("espeak-ng:{primary}{variant}"))
                })?;
        }
        Ok(role)
    }

    /// All voices of an engine.
    ///
    /// # Errors
    /// When it is not installed.
    pub(crate) fn voices_of(engine: &str, options: &EngineOptions) -> Result<Vec<VoiceInfo>> {
        engine::by_name(engine, options)?.voices()
    }
}
