//! Bakes speech: turns what a story says into a bundle of sound, words, phones and melody,
//! with speech engines, ahead of any performance.
//!
//! `what is said → plan (sentences and pauses) → engine → styles and emotions → one sound with
//! times → Ogg Opus and MP3 → speech.json`. Every step but the engines and the two encoders
//! is a function over plain data. The same story gives the same bundle, byte for byte, with
//! the same programs installed.

mod bundle_text;
mod cast;
mod encode;
pub(crate) mod engine;
pub(crate) mod measure;
pub(crate) mod picture;
pub(crate) mod program;
mod sounds;
mod speak;
mod store;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use anyhow::{Context as _, Result, anyhow, bail, ensure};
use raconteur_player::speech::bundle::{Bundle, Utterance, Voice};
use raconteur_player::speech::content::Content;
use raconteur_player::speech::hear::{Heard, hear};
use raconteur_player::speech::markup::{self, Problem, plain, sable, ssml};
use raconteur_player::speech::phones;
use raconteur_player::speech::signal::loudness::integrated_lufs;
use raconteur_player::speech::text::Lexicon;
use raconteur_player::{Said, Source};

use crate::input;
pub(crate) use cast::Cast;
use cast::Role;
use speak::{Casting, Work};
use store::{Digest, Store};

/// Raise it when the sound or the times of the same text change, so that every story is
/// baked afresh.
const REVISION: u32 = 4;

/// How to bake.
pub(crate) struct BakeOptions {
    /// Who speaks.
    pub(crate) cast: Cast,
    /// Pace of everything; 1 is the voice's own.
    pub(crate) pace: f64,
    /// What the author says of words.
    pub(crate) lexicon: Lexicon,
    /// Its text, which has a say in what is up to date.
    pub(crate) lexicon_text: String,
    /// How many utterances are made at a time.
    pub(crate) jobs: usize,
    /// Only tell whether the bundle is up to date.
    pub(crate) check: bool,
}

/// The pace of a storyteller, 150 to 170 words a minute, where voices have some 180.
pub(crate) const STORY_PACE: f64 = 0.88;

/// What [`bake`] did.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct BakeReport {
    /// Utterances in the bundle; two that say the same count once.
    pub(crate) utterances: usize,
    /// What was spoken anew, or with `check` would have to be; the others were up to date.
    pub(crate) synthesised: Vec<String>,
    /// Files that were to be said and are not there; what needs them is left out.
    pub(crate) absent: Vec<PathBuf>,
    /// What was heard in them.
    pub(crate) sound: Sound,
    /// Sound files of earlier bakes that nothing uses any more and that were removed.
    pub(crate) removed: usize,
    /// All utterances together, seconds.
    pub(crate) duration_secs: f64,
    /// Bytes of Ogg Opus.
    pub(crate) opus_bytes: u64,
    /// Bytes of MP3.
    pub(crate) mp3_bytes: u64,
    /// Bytes of the bundle's text.
    pub(crate) text_bytes: u64,
}

/// What was heard in utterances that were spoken anew.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Sound {
    /// Against what they tell.
    pub(crate) heard: Heard,
    /// The softest and the loudest of them, LUFS; none of silence.
    pub(crate) lufs: Option<(f64, f64)>,
}

impl Sound {
    fn add(&mut self, heard: &Heard, lufs: Option<f64>) {
        self.heard.add(heard);
        if let Some(lufs) = lufs {
            let (least, most) = self.lufs.unwrap_or((lufs, lufs));
            self.lufs = Some((least.min(lufs), most.max(lufs)));
        }
    }
}

/// An utterance as it was made.
struct Made {
    utterance: Utterance,
    heard: Heard,
    lufs: Option<f64>,
}

/// An utterance that is wanted.
struct Wanted<'a> {
    key: u64,
    /// Stands for everything that goes into its sound.
    digest: u64,
    /// Its place among what the story says, from 0.
    place: usize,
    content: Content,
    said: &'a Said,
    role: Role,
    casting: Casting,
    sounds: Vec<PathBuf>,
}

/// Makes or refreshes the bundle of the story in `folder` so that it holds all that is `said`.
/// `library` finds files of the asset library; `progress` hears how many utterances are done,
/// of how many, and what was said last.
///
/// # Errors
/// When a program is missing (the message names its Debian package), when it fails, or
/// when the folder cannot be written.
pub(crate) fn bake(
    said: &[Said],
    folder: &Path,
    options: &BakeOptions,
    library: &dyn Fn(&str) -> Result<PathBuf>,
    progress: &(dyn Fn(usize, usize, &str) + Sync),
) -> Result<BakeReport> {
    ensure!(
        (0.5..=2.0).contains(&options.pace),
        "a pace of {} is outside 0.5 to 2",
        options.pace
    );
    let store = Store::open(folder.join("voice"));
    let mut seen = BTreeSet::new();
    let mut wanted = Vec::new();
    let mut absent = Vec::new();
    for (place, said) in said.iter().enumerate() {
        // Two clauses that say the same share an utterance; the first keeps its place.
        if seen.insert(said.key) {
            match content(said, folder, library)? {
                Ok(content) => wanted.push(want(said, content, place, folder, options)?),
                Err(file) => absent.push(file),
            }
        }
    }
    // A dance without a word has no voice.
    wanted.retain(|w| !w.content.words().is_empty() || !w.sounds.is_empty());
    let stale: Vec<bool> = wanted.iter().map(|w| !store.has(w.key, w.digest)).collect();
    let texts = wanted.iter().zip(&stale).filter(|(_, stale)| **stale);
    let mut report = BakeReport {
        utterances: wanted.len(),
        synthesised: texts.map(|(w, _)| w.content.plain_text()).collect(),
        absent,
        ..BakeReport::default()
    };
    let left_over = store.others(wanted.iter().map(|w| w.key));
    if options.check {
        report.removed = left_over;
        return Ok(report);
    }
    if wanted.is_empty() {
        report.removed = store.clear()?;
        return Ok(report);
    }
    store.prepare()?;
    let made = make(&wanted, &stale, options, &store, progress)?;
    let mut bundle = Bundle::default();
    for (wanted, made) in wanted.iter().zip(made) {
        let voice = Voice {
            engine: options.cast.version(&wanted.role)?.to_owned(),
            voice: wanted.role.voice.name.clone(),
            language: wanted.role.voice.language.clone(),
            phone_set: wanted.role.voice.phone_set.clone(),
            mouth: Vec::new(),
        };
        let mut utterance = match made {
            Some(made) => {
                report.sound.add(&made.heard, made.lufs);
                made.utterance
            }
            None => store
                .get(wanted.key)
                .context("an utterance has gone while it was needed")?,
        };
        utterance.voice = match bundle.voices.iter().position(|v| *v == voice) {
            Some(known) => known,
            None => {
                bundle.voices.push(voice);
                bundle.voices.len() - 1
            }
        };
        report.duration_secs += utterance.duration_secs;
        bundle.utterances.push(utterance);
    }
    for index in 0..bundle.voices.len() {
        let mouth = mouth(&bundle, index);
        bundle.voices[index].mouth = mouth;
    }
    report.text_bytes = store.write(&bundle)?;
    report.removed = store.remove_unused(&bundle)?;
    for audio in bundle.utterances.iter().flat_map(|u| &u.audio) {
        let bytes = store.size(&audio.file)?;
        match audio.mime.as_str() {
            "audio/mpeg" => report.mp3_bytes += bytes,
            _ => report.opus_bytes += bytes,
        }
    }
    Ok(report)
}

/// By which rows of the player's table the symbols of a voice move the lips, where they are
/// called otherwise. What nobody knows is left to the player, who shows a schwa.
fn mouth(bundle: &Bundle, voice: usize) -> Vec<(String, String)> {
    let phone_set = &bundle.voices[voice].phone_set;
    let spoken = bundle.utterances.iter().filter(|u| u.voice == voice);
    let symbols: BTreeSet<&str> = spoken
        .flat_map(|u| &u.phones)
        .map(|p| p.symbol.as_str())
        .collect();
    let row = |symbol: &str| Some(phones::find(phone_set, symbol)?.name);
    symbols
        .into_iter()
        .filter_map(|symbol| Some((symbol, row(symbol)?)))
        .filter(|(symbol, row)| symbol != row)
        .map(|(symbol, row)| (symbol.to_owned(), row.to_owned()))
        .collect()
}

/// What is to be said, or the path of the file beside the story that should say it: its
/// absence does not keep the rest from being told, as whoever has the text may bring it later.
fn content(
    said: &Said,
    folder: &Path,
    library: &dyn Fn(&str) -> Result<PathBuf>,
) -> Result<Result<Content, PathBuf>> {
    Ok(Ok(match &said.source {
        Source::Content(content) => content.clone(),
        Source::Sable(text) => sable_document("the document in the script", text)?,
        Source::File {
            path,
            sable,
            library: from_library,
        } => {
            // The library, and for files beside the story that folder as well.
            let file = if *from_library && !folder.join(path).is_file() {
                library(path)?
            } else {
                folder.join(path)
            };
            if !file.exists() {
                return Ok(Err(file));
            }
            let text = input::text(&file, markup::LONGEST as u64).context("what is to be said")?;
            if *sable {
                sable_document(path, &text)?
            } else if path.ends_with(".ssml") {
                document(path, ssml::read(&text))?
            } else {
                plain::read(&text)
            }
        }
    }))
}

/// Casts and plans one utterance.
fn want<'a>(
    said: &'a Said,
    content: Content,
    place: usize,
    folder: &Path,
    options: &BakeOptions,
) -> Result<Wanted<'a>> {
    let role = match &said.voice {
        Some(name) => options.cast.named(name)?,
        None => options.cast.lead.clone(),
    };
    let work = Work {
        content: &content,
        role: &role,
        emotion: said.emotion.as_ref(),
        pace: options.pace,
    };
    let casting = speak::cast(&work, &options.cast, &options.lexicon)
        .with_context(|| format!("planning {:?}", short(&content.plain_text())))?;
    let mut sounds = Vec::new();
    let mut digest = Digest::new();
    digest.number(u64::from(REVISION));
    digest.text(&format!("{} {:?}", options.pace, said.emotion));
    digest.text(&options.lexicon_text);
    digest.text(&format!("{:?}", casting.plan));
    for role in [&role].into_iter().chain(&casting.roles) {
        digest.text(options.cast.version(role)?);
        digest.text(&role.voice.name);
        digest.text(&options.cast.engine(role)?.state(said.key, place)?);
    }
    for sound in &casting.plan.sounds {
        let path = sounds::find(folder, &sound.src)?;
        digest.bytes(&fs::read(&path)?);
        sounds.push(path);
    }
    Ok(Wanted {
        key: said.key,
        digest: digest.value(),
        place,
        content,
        said,
        role,
        casting,
        sounds,
    })
}

fn sable_document(name: &str, text: &str) -> Result<Content> {
    document(name, sable::read(text))
}

/// What was read of a document; its problems are told.
fn document(name: &str, read: Result<(Content, Vec<Problem>), Problem>) -> Result<Content> {
    let (content, problems) = read.map_err(|p| anyhow!("{name}: {p}"))?;
    for problem in problems {
        eprintln!("{name}: {problem}");
    }
    Ok(content)
}

/// The begin of a text, for messages.
fn short(text: &str) -> String {
    text.chars().take(60).collect()
}

/// Makes what is stale, several utterances at a time; `None` for what is up to date.
fn make(
    wanted: &[Wanted<'_>],
    stale: &[bool],
    options: &BakeOptions,
    store: &Store,
    progress: &(dyn Fn(usize, usize, &str) + Sync),
) -> Result<Vec<Option<Made>>> {
    let todo: Vec<usize> = (0..wanted.len()).filter(|i| stale[*i]).collect();
    let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let made: Mutex<Vec<(usize, Result<Made>)>> = Mutex::new(Vec::new());
    let lock = || made.lock().unwrap_or_else(PoisonError::into_inner);
    progress(wanted.len() - todo.len(), wanted.len(), "");
    thread::scope(|scope| {
        for _ in 0..options.jobs.clamp(1, todo.len().max(1)) {
            scope.spawn(|| {
                while let Some(&i) = todo.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let text = wanted[i].content.plain_text();
                    let result = utterance(&wanted[i], options, store)
                        .with_context(|| format!("speaking {:?}", short(&text)));
                    let failed = result.is_err();
                    lock().push((i, result));
                    if failed {
                        // The others stop as soon as they have done what they are at.
                        next.store(todo.len(), Ordering::Relaxed);
                    }
                    let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                    progress(wanted.len() - todo.len() + done, wanted.len(), &text);
                }
            });
        }
    });
    let mut out: Vec<Option<Made>> = wanted.iter().map(|_| None).collect();
    let mut made = made.into_inner().unwrap_or_else(PoisonError::into_inner);
    made.sort_by_key(|(i, _)| *i);
    for (i, result) in made {
        out[i] = Some(result?);
    }
    if todo.iter().any(|i| out[*i].is_none()) {
        bail!("a thread ended before its work");
    }
    Ok(out)
}

/// Speaks one utterance and writes its sound.
fn utterance(wanted: &Wanted<'_>, options: &BakeOptions, store: &Store) -> Result<Made> {
    let work = Work {
        content: &wanted.content,
        role: &wanted.role,
        emotion: wanted.said.emotion.as_ref(),
        pace: options.pace,
    };
    let engine = options.cast.engine(&wanted.role)?;
    let recordings = |rate_hz: f64| {
        let read = wanted.sounds.iter().map(|path| sounds::read(path, rate_hz));
        read.collect::<Result<Vec<_>>>()
    };
    let track = match engine.recorded(wanted.key, wanted.place, &wanted.casting.plan)? {
        Some(spoken) => speak::recorded(&wanted.casting.plan, spoken, wanted.said.emotion.as_ref()),
        None => speak::speak(&work, &wanted.casting, &options.cast, &recordings)?,
    };
    let mut utterance = track.utterance;
    utterance.key = wanted.key;
    utterance.content = wanted.digest;
    utterance.audio = store.encode(wanted.key, &track.samples, track.rate_hz)?;
    let phone_set = &wanted.role.voice.phone_set;
    Ok(Made {
        heard: hear(&utterance, phone_set, &track.samples, track.rate_hz),
        lufs: integrated_lufs(&[&track.samples], track.rate_hz),
        utterance,
    })
}
