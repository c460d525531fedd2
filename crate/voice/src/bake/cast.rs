//! Cast of a script: the required engines, their voices, and the voice of each sentence.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::content::{Gender, Speaker};
use crate::language;
use anyhow::{Context as _, Result, anyhow, bail};

use super::engine::{self, Engine, EngineOptions, MissingEngine, VoiceInfo};
use super::program::MissingPrograms;

/// Voice of a role and the name of the engine that provides it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Role {
    /// Name of the engine.
    pub engine: String,
    /// Description of the voice.
    pub voice: VoiceInfo,
}

/// Voices of a story and their engines. Engines are cached after their first use, because starting
/// them takes time. Missing ones are recorded, so that all of them can be reported together.
pub struct Cast {
    options: EngineOptions,
    known: Mutex<Engines>,
    missing: Mutex<MissingPrograms>,
    /// The story's own voice.
    pub primary: Role,
    /// Explicitly chosen engine, and voice if one was chosen.
    pub chosen: Option<Role>,
    /// Missing programs of the default engine, if another one leads because none was chosen.
    pub instead_of: Option<MissingPrograms>,
    /// Language of the story, a BCP 47 tag; `None`: that of the voice.
    pub language: Option<String>,
    /// True if only one engine exists, as on a web page.
    is_alone: bool,
}

struct KnownVoice {
    engine: Box<dyn Engine>,
    version: String,
    voices: Vec<VoiceInfo>,
}

type Engines = BTreeMap<String, &'static KnownVoice>;

/// Adds an engine to the cache. The few engines live as long as the program, so threads need not
/// share a lock.
fn cache(engines: &mut Engines, name: &str, one: KnownVoice) -> &'static KnownVoice {
    let one: &'static KnownVoice = Box::leak(Box::new(one));
    engines.insert(name.to_owned(), one);
    one
}

/// Engine packaged by operating systems: the one suggested if no engine is installed.
const PACKAGED: &str = "festival";

/// Returns the default engine, a voice if it is not the engine's first, and the missing programs of
/// better engines.
fn usual(voice: Option<&str>) -> (String, Option<String>, Option<MissingPrograms>) {
    let mut lacks: Option<MissingPrograms> = None;
    for (engine, voices) in engine::local() {
        match voices {
            Ok(voices) if voice.is_none() => {
                let american = |v: &&VoiceInfo| v.language.eq_ignore_ascii_case("en-US");
                // Kokoro's and Festival's first voices are the ones that they are set to.
                let chosen = !["kokoro", "festival"].contains(engine);
                let first = voices.iter().find(american).or(voices.first());
                let first = first.filter(|_| chosen).map(|v| v.name.clone());
                return ((*engine).to_owned(), first, lacks);
            }
            Ok(_) => break,
            Err(one) => lacks.get_or_insert_default().add(one),
        }
    }
    let named = voice.and_then(engine::find_voice).map(|(engine, _)| engine);
    match named {
        Some(engine) => (engine, None, lacks),
        None => {
            let local = engine::local().iter();
            let there = local
                .filter(|(_, voices)| voices.is_ok())
                .map(|(n, _)| *n)
                .next();
            (there.unwrap_or(PACKAGED).to_owned(), None, None)
        }
    }
}

/// Returns the default voice of an engine: a text without a language counts as English, for which
/// the first voice is used, or else an American one.
fn usual_of(voices: &[VoiceInfo]) -> Option<&VoiceInfo> {
    let english = |v: &&VoiceInfo| language::primary(&v.language) == "en";
    let american = |v: &&VoiceInfo| v.language.eq_ignore_ascii_case("en-US");
    let first = voices.first()?;
    if english(&first) {
        return Some(first);
    }
    let of = |test: &dyn Fn(&&VoiceInfo) -> bool| voices.iter().find(test);
    of(&american).or_else(|| of(&english)).or(Some(first))
}

/// Returns the first voice of a language tag; if no voice has the exact tag, the first voice of its
/// language.
fn speaking<'v>(voices: &'v [VoiceInfo], tag: &str) -> Option<&'v VoiceInfo> {
    let same = voices.iter().find(|v| v.language.eq_ignore_ascii_case(tag));
    let primary = language::primary(tag);
    same.or_else(|| {
        voices
            .iter()
            .find(|v| language::primary(&v.language) == primary)
    })
}

impl KnownVoice {
    fn ask(name: &str, options: &EngineOptions) -> Result<Self> {
        let engine = engine::by_name(name, options)?;
        Ok(Self {
            version: engine.version()?,
            voices: engine.voices()?,
            engine,
        })
    }
}

impl Cast {
    /// Creates a cast whose lead speaks with a voice of an engine. The default voice is the
    /// engine's first English one, otherwise its first; the default engine is Festival or, if that
    /// is not installed, the first that is.
    ///
    /// # Errors
    /// Returns an error if the engine has no such voice, or needs an option.
    pub fn new(engine: Option<&str>, voice: Option<&str>, options: EngineOptions) -> Result<Self> {
        let (name, usual, instead_of) = match engine {
            Some(engine) => (engine.to_owned(), None, None),
            None => usual(voice),
        };
        let mut cast = Self {
            options,
            known: Mutex::new(BTreeMap::new()),
            missing: Mutex::default(),
            primary: Role {
                engine: name.clone(),
                voice: VoiceInfo::default(),
            },
            chosen: engine.or(voice).map(|_| Role {
                engine: name.clone(),
                voice: VoiceInfo {
                    name: voice.unwrap_or_default().to_owned(),
                    ..VoiceInfo::default()
                },
            }),
            instead_of,
            language: None,
            is_alone: false,
        };
        // An engine that lacks an option is an error, one that is not installed is not.
        engine::by_name(&name, &cast.options)?;
        cast.primary.voice = match voice.map(str::to_owned).or(usual) {
            Some(voice) => cast.voice(&name, &voice)?,
            None => {
                let known = cast.known(&name)?;
                if known.version.is_empty() {
                    cast.primary.voice = known.engine.voice("")?.unwrap_or_default();
                    return Ok(cast);
                }
                // Recordings have no voices; one placeholder represents all of them.
                let first = usual_of(&known.voices).cloned();
                let any = || known.engine.voice("recorded").ok().flatten();
                first
                    .or_else(any)
                    .with_context(|| format!("{name} has no voice"))?
            }
        };
        Ok(cast)
    }

    /// Creates a cast with a single engine named `name`, whose lead speaks with a voice of it.
    ///
    /// # Errors
    /// Returns an error if the engine is not available or has no such voice.
    pub fn with_engine(name: &str, engine: Box<dyn Engine>, voice: &str) -> Result<Self> {
        let cast = Self {
            options: EngineOptions::default(),
            known: Mutex::new(BTreeMap::new()),
            missing: Mutex::default(),
            primary: Role::default(),
            chosen: None,
            instead_of: None,
            language: None,
            is_alone: true,
        };
        let known = KnownVoice {
            version: engine.version()?,
            voices: engine.voices()?,
            engine,
        };
        cache(&mut *cast.engines()?, name, known);
        Ok(Self {
            primary: Role {
                voice: cast.voice(name, voice)?,
                engine: name.to_owned(),
            },
            ..cast
        })
    }

    fn engines(&self) -> Result<MutexGuard<'_, Engines>> {
        let engines = self.known.lock();
        engines.map_err(|_| anyhow!("another thread failed"))
    }

    /// Sets the default language, a BCP 47 tag. If the lead's voice does not speak it, another
    /// voice is used: of the same engine if the voice was not chosen explicitly.
    ///
    /// # Errors
    /// Returns an error if no voice speaks the language.
    pub fn speak_in(&mut self, tag: String) -> Result<()> {
        let chosen = self.chosen.as_ref();
        let is_free = chosen.is_none_or(|role| role.voice.name.is_empty());
        let other = language::primary(&self.primary.voice.language) != language::primary(&tag);
        if is_free
            && other
            && let Some(own) = speaking(&self.known(&self.primary.engine)?.voices, &tag)
        {
            self.primary.voice = own.clone();
        }
        self.primary = self
            .role(&self.primary, &Speaker::default(), &tag)
            .with_context(|| format!("no voice here speaks the story's language, {tag}"))?;
        self.language = Some(tag);
        Ok(())
    }

    /// Returns the missing programs requested so far.
    pub fn missing(&self) -> MissingPrograms {
        let missing = self.missing.lock();
        missing.unwrap_or_else(PoisonError::into_inner).clone()
    }

    fn note(&self, missing: &MissingPrograms) {
        let all = self.missing.lock();
        all.unwrap_or_else(PoisonError::into_inner).add(missing);
    }

    fn known(&self, name: &str) -> Result<&'static KnownVoice> {
        // The lock is held until the engine has answered, so that no engine is started twice.
        let mut known = self.engines()?;
        if let Some(one) = known.get(name) {
            return Ok(one);
        }
        let one = KnownVoice::ask(name, &self.options).unwrap_or_else(|error| {
            let missing = MissingPrograms::from_error(&error);
            self.note(&missing);
            KnownVoice {
                version: String::new(),
                voices: Vec::new(),
                engine: Box::new(MissingEngine {
                    missing,
                    by_language: name == "espeak-ng",
                }),
            }
        });
        Ok(cache(&mut known, name, one))
    }

    /// Returns the voice of an engine with a name.
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

    /// Returns the engine of a role.
    ///
    /// # Errors
    /// Returns an error if the engine is not installed.
    pub fn engine(&self, role: &Role) -> Result<&'static dyn Engine> {
        Ok(self.known(&role.engine)?.engine.as_ref())
    }

    /// Returns the version of a role's engine.
    ///
    /// # Errors
    /// Returns an error if the engine is not installed.
    pub fn version(&self, role: &Role) -> Result<&'static str> {
        Ok(&self.known(&role.engine)?.version)
    }

    /// Returns the voice that a script names, as `VOICE` or `ENGINE:VOICE`.
    ///
    /// # Errors
    /// Returns an error if there is no voice with this name; the message describes how to fix it.
    pub fn named(&self, name: &str) -> Result<Role> {
        // The story's own engine first; in a page there is no other.
        let own = self.known(&self.primary.engine)?;
        if let Some(voice) = own.voices.iter().find(|v| v.name == name) {
            return Ok(Role {
                engine: self.primary.engine.clone(),
                voice: voice.clone(),
            });
        }
        let Some((engine, voice)) = engine::find_voice(name) else {
            // It may be a voice of one that is not installed.
            let mut missing = MissingPrograms::default();
            let local = engine::local().iter();
            let absent = local
                .filter(|(engine, _)| *engine != "kokoro" || engine::kokoro::is_name(name))
                .filter_map(|(_, v)| v.as_ref().err());
            absent.for_each(|one| missing.add(one));
            if self.is_alone || missing.is_empty() || name.contains(':') {
                bail!("no engine has a voice {name}; {}", engine::voice_hint(name));
            }
            missing.add(&MissingPrograms::from_error(&anyhow!(
                "no engine that is here has a voice {name}"
            )));
            self.note(&missing);
            return Ok(Role {
                engine: self.primary.engine.clone(),
                voice: VoiceInfo {
                    name: name.to_owned(),
                    ..self.primary.voice.clone()
                },
            });
        };
        Ok(Role {
            voice: self.voice(&engine, &voice)?,
            engine,
        })
    }

    /// Returns the role that speaks a sentence: the named speaker, otherwise `usual`, unless the
    /// sentence has another language than that voice or requests another sex; then a matching
    /// voice.
    ///
    /// # Errors
    /// Returns an error if a required engine is not installed.
    pub fn role(&self, usual: &Role, speaker: &Speaker, tag: &str) -> Result<Role> {
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
            // espeak-ng speaks nearly every language.
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

    /// Returns true if an available voice speaks a language, a BCP 47 tag: that of `usual`, or one
    /// of those considered by [`Cast::role`].
    pub fn speaks(&self, usual: &Role, tag: &str) -> bool {
        let primary = language::primary(tag);
        let speaks = |voice: &VoiceInfo| language::primary(&voice.language) == primary;
        let others = engine::local()
            .iter()
            .filter(|(name, _)| *name == "espeak-ng");
        speaks(&usual.voice)
            || !self.is_alone
                && others
                    .flat_map(|(_, voices)| voices.iter().flatten())
                    .any(speaks)
    }

    /// Returns all voices of an engine.
    ///
    /// # Errors
    /// Returns an error if the engine is not installed.
    pub fn voices_of(engine: &str, options: &EngineOptions) -> Result<Vec<VoiceInfo>> {
        engine::by_name(engine, options)?.voices()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spoken::{Sentence, Spoken};

    /// An engine of voices that are called by their languages.
    struct Voices(&'static [&'static str]);

    impl Engine for Voices {
        fn version(&self) -> Result<String> {
            Ok("voices 1".to_owned())
        }

        fn voices(&self) -> Result<Vec<VoiceInfo>> {
            Ok(voices(self.0))
        }

        fn speak(&self, _voice: &str, _sentences: &[Sentence]) -> Result<Vec<Spoken>> {
            Ok(Vec::new())
        }
    }

    fn voices(languages: &[&str]) -> Vec<VoiceInfo> {
        let of = |language: &&str| VoiceInfo {
            name: language.to_lowercase(),
            language: (*language).to_owned(),
            ..VoiceInfo::default()
        };
        languages.iter().map(of).collect()
    }

    #[test]
    fn a_text_without_a_language_is_english() {
        for (languages, expected) in [
            (&["af", "en-GB", "en-US", "zu"][..], Some("en-US")),
            (&["af", "en-GB"], Some("en-GB")),
            (&["en-GB", "en-US"], Some("en-GB")),
            (&["af", "zu"], Some("af")),
            (&[], None),
        ] {
            let voices = voices(languages);
            let usual = usual_of(&voices).map(|v| v.language.as_str());
            assert_eq!(usual, expected, "{languages:?}");
        }
    }

    #[test]
    fn the_language_of_a_story_has_a_voice_of_the_engine() {
        let own = Voices(&["en-US", "de", "pt-PT", "pt-BR"]);
        let mut cast = Cast::with_engine("own", Box::new(own), "en-us").unwrap();
        for (tag, expected) in [("de-AT", "de"), ("pt-BR", "pt-br"), ("en", "en-us")] {
            cast.primary.voice = voices(&["en-US"]).remove(0);
            cast.speak_in(tag.to_owned()).unwrap();
            assert_eq!(cast.primary.voice.name, expected, "{tag}");
        }
    }
}
