//! Speech baking: converts the speech of a story to a bundle of audio, words, phones and pitch
//! contour, with speech engines, before any performance.
//!
//! `content → plan (sentences and pauses) → engine → styles and emotions → one sound with times →
//! Ogg Opus and MP3 → speech.json`. Every step except the engines and the two encoders is a
//! function over plain data. The same story gives the same bundle, byte for byte, with the same
//! programs installed.

mod adopt;
mod bundle_text;
mod cast;
mod digest;
mod encode;
pub mod engine;
mod lock;
pub mod measure;
pub mod page;
pub mod picture;
mod planned;
pub mod program;
mod sounds;
mod speak;
mod store;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

use crate::SpeechRequest;
use crate::measured_speech::{MeasuredSpeech, measure_speech};
use crate::signal::loudness::integrated_lufs;
use crate::text::Lexicon;
use anyhow::{Context as _, Result, bail, ensure};
use raconteur_speech::bundle::{Bundle, Utterance, Voice};
use raconteur_speech::phones;

pub use cast::Cast;
use cast::Role;
use engine::Recorded;
pub use engine::Remark;
use lock::Lock;
use planned::{PlannedUtterance, short};
use program::{FFMPEG, MissingPrograms, OPUSENC};
use speak::RenderInput;
pub use store::{Sound as SoundFile, Store};

use crate::files::disk::SystemDisk;
use crate::files::inside;

/// Bake revision. Increase it when the audio or the times of the same text change, so that every
/// story is baked again.
const REVISION: u32 = 5;

/// Options for synthesising the speech of a story ahead of time with [`bake`].
pub struct BakeOptions {
    /// Voices of the story and their engines.
    pub cast: Cast,
    /// Pace of everything; 1 is the voice's own.
    pub pace: f64,
    /// The author's pronunciation lexicon.
    pub lexicon: Lexicon,
    /// Text of the lexicon, which determines if a sound is up to date.
    pub lexicon_text: String,
    /// Number of utterances baked in parallel.
    pub jobs: usize,
    /// Only checks if the bundle is up to date.
    pub check: bool,
}

/// The pace of a storyteller, 150 to 170 words a minute, where voices have some 180.
pub const STORY_PACE: f64 = 0.88;

/// Report of [`bake`]: the number, size and duration of the synthesised utterances, and problems.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BakeReport {
    /// Number of utterances in the bundle; identical ones count once.
    pub utterances: usize,
    /// Newly spoken utterances, or with `check` those that are out of date.
    pub synthesised: Vec<String>,
    /// Missing files with spoken content; utterances that need them are omitted.
    pub absent: Vec<PathBuf>,
    /// Measurements of their audio.
    pub sound: AudioMeasurements,
    /// Remarks about their recordings, each with the spoken text.
    pub remarks: Vec<(String, Remark)>,
    /// Number of removed audio files of earlier bakes that are no longer used.
    pub removed: usize,
    /// Total duration of all utterances, seconds.
    pub duration_secs: f64,
    /// Bytes of Ogg Opus.
    pub opus_bytes: u64,
    /// Total size of the MP3 files, bytes.
    pub mp3_bytes: u64,
    /// Bytes of the bundle's text.
    pub text_bytes: u64,
    /// Missing programs, if only the texts were compared and not the engines' output.
    pub compared_without: Option<MissingPrograms>,
}

impl BakeReport {
    /// Counts of a bundle.
    fn count(&mut self, bundle: &Bundle) {
        self.text_bytes = bundle_text::write(bundle).len() as u64;
        for utterance in &bundle.utterances {
            self.duration_secs += utterance.duration_secs;
            for audio in &utterance.audio {
                let bytes = audio.digest.as_ref().map_or(0, |h| h.bytes);
                match audio.mime.as_str() {
                    "audio/mpeg" => self.mp3_bytes += bytes,
                    _ => self.opus_bytes += bytes,
                }
            }
        }
    }
}

/// Measurements of newly synthesised audio: agreement with its labels, and loudness.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AudioMeasurements {
    /// Measured audio compared with the labels.
    pub heard: MeasuredSpeech,
    /// Lowest and highest loudness, LUFS; `None` for silence.
    pub lufs: Option<(f64, f64)>,
}

impl AudioMeasurements {
    fn add(&mut self, heard: &MeasuredSpeech, lufs: Option<f64>) {
        self.heard.add(heard);
        if let Some(lufs) = lufs {
            let (least, most) = self.lufs.unwrap_or((lufs, lufs));
            self.lufs = Some((least.min(lufs), most.max(lufs)));
        }
    }
}

/// An utterance as it was made.
struct BakedUtterance {
    utterance: Utterance,
    heard: MeasuredSpeech,
    lufs: Option<f64>,
    remarks: Vec<Remark>,
}

/// Creates or updates the bundle of the story in `folder` so that it contains everything in `said`.
/// `library` finds files of the asset library; `progress` receives the number of finished
/// utterances, the total, and the last spoken text.
///
/// If everything is up to date, nothing is changed and no program is needed. Otherwise the folder
/// is locked, and the old bundle stays intact until the new one is complete.
///
/// # Errors
/// Returns an error if programs are missing (the message names all of them, with their Debian
/// packages), if a program fails, if another bake is running, or if the folder cannot be written.
pub fn bake(
    said: &[SpeechRequest],
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
    let voice = folder.join("voice");
    inside::check_folder(folder, &voice)?;
    let (wanted, absent) = planned::all(said, folder, options, library)?;
    let mut report = BakeReport {
        utterances: wanted.len(),
        absent,
        ..BakeReport::default()
    };
    let store = Store::open(voice.clone(), &SystemDisk);
    let left_over = store.count_others(wanted.iter().map(|w| w.key));
    let missing = without(&options.cast);
    let stale: Vec<&PlannedUtterance<'_>> = wanted
        .iter()
        .filter(|w| match &missing {
            Some(_) => !is_of_this_story(&store, w, &options.cast),
            None => !store.has(w.key, w.digest),
        })
        .collect();
    report.synthesised = stale.iter().map(|w| w.content.plain_text()).collect();
    if options.check || missing.is_some() && stale.is_empty() && left_over == 0 {
        report.removed = left_over;
        report.compared_without = missing;
        return Ok(report);
    }
    let settled = missing.is_none() && stale.is_empty();
    let mut missing = options.cast.missing();
    if !settled {
        missing.add(&MissingPrograms::not_found(&[&OPUSENC, &FFMPEG]));
    }
    missing.into_result()?;
    if settled && !wanted.is_empty() {
        let bundle = bundle_of(&wanted, &store, Vec::new(), options)?;
        if store.is(&bundle)? {
            report.count(&bundle);
            return Ok(report);
        }
    }
    if wanted.is_empty() && !voice.is_dir() {
        return Ok(report);
    }
    let _lock = Lock::acquire(&voice)?;
    // Another bake may have ended since.
    renew(
        &wanted,
        Store::open(voice, &SystemDisk),
        options,
        progress,
        report,
    )
}

/// Returns the missing programs if only the texts can be compared: engines named by the story, or
/// the default one if none was chosen.
fn without(cast: &Cast) -> Option<MissingPrograms> {
    let mut missing = cast.missing();
    if let Some(usual) = &cast.instead_of {
        missing.add(usual);
    }
    (!missing.is_empty()).then_some(missing)
}

/// Returns true if an utterance was made from the same story, by the chosen engine and voice, as
/// far as is known without starting them.
fn is_of_this_story(store: &Store<'_>, wanted: &PlannedUtterance<'_>, cast: &Cast) -> bool {
    let spoken = |chosen: &Role| {
        store.voice(wanted.key).is_some_and(|voice| {
            voice.engine.split(' ').next() == Some(chosen.engine.as_str())
                && (chosen.voice.name.is_empty() || chosen.voice.name == voice.voice)
        })
    };
    store.has_source(wanted.key, wanted.source)
        && (wanted.request.voice.is_some() || cast.chosen.as_ref().is_none_or(spoken))
}

/// Rebuilds the bundle in a locked folder.
fn renew(
    wanted: &[PlannedUtterance<'_>],
    mut store: Store<'_>,
    options: &BakeOptions,
    progress: &(dyn Fn(usize, usize, &str) + Sync),
    mut report: BakeReport,
) -> Result<BakeReport> {
    if wanted.is_empty() {
        report.removed = store.clear()?;
        return Ok(report);
    }
    for one in wanted {
        store
            .adopt(one.key, one.digest, &adopt::is_sound_of)
            .with_context(|| format!("keeping {:?}", short(&one.content.plain_text())))?;
    }
    let stale: Vec<bool> = wanted.iter().map(|w| !store.has(w.key, w.digest)).collect();
    let texts = wanted.iter().zip(&stale).filter(|(_, stale)| **stale);
    report.synthesised = texts.map(|(w, _)| w.content.plain_text()).collect();
    let made = make(wanted, &stale, options, &store, progress)?;
    for (made, wanted) in made.iter().zip(wanted) {
        let Some(made) = made else { continue };
        report.sound.add(&made.heard, made.lufs);
        let text = short(&wanted.content.plain_text());
        let told = made.remarks.iter().map(|r| (text.clone(), r.clone()));
        report.remarks.extend(told);
    }
    let made = made.into_iter().map(|m| m.map(|m| m.utterance)).collect();
    let bundle = bundle_of(wanted, &store, made, options)?;
    store.write(&bundle)?;
    report.removed = store.remove_unused(&bundle)?;
    report.count(&bundle);
    Ok(report)
}

/// Returns the bundle of the new utterances, with the stored ones where nothing was made.
fn bundle_of(
    wanted: &[PlannedUtterance<'_>],
    store: &Store<'_>,
    made: Vec<Option<Utterance>>,
    options: &BakeOptions,
) -> Result<Bundle> {
    let made = made.into_iter().chain(core::iter::repeat(None));
    let all = wanted.iter().zip(made).map(|(wanted, made)| {
        let gone = "an utterance has gone while it was needed";
        let utterance = made.or_else(|| store.get(wanted.key)).context(gone)?;
        Ok((wanted, utterance))
    });
    bundled(all, &options.cast)
}

/// Collects utterances in a bundle.
fn bundled<'a>(
    all: impl Iterator<Item = Result<(&'a PlannedUtterance<'a>, Utterance)>>,
    cast: &Cast,
) -> Result<Bundle> {
    let mut bundle = Bundle::default();
    for one in all {
        let (wanted, mut utterance) = one?;
        let voice = Voice {
            engine: cast.version(&wanted.role)?.to_owned(),
            voice: wanted.role.voice.name.clone(),
            language: wanted.role.voice.language.clone(),
            phone_set: wanted.role.voice.phone_set.clone(),
            mouth: Vec::new(),
        };
        utterance.source = Some(wanted.source);
        utterance.voice = match bundle.voices.iter().position(|v| *v == voice) {
            Some(known) => known,
            None => {
                bundle.voices.push(voice);
                bundle.voices.len() - 1
            }
        };
        bundle.utterances.push(Arc::new(utterance));
    }
    for index in 0..bundle.voices.len() {
        let mouth = mouth(&bundle, index);
        bundle.voices[index].mouth = mouth;
    }
    Ok(bundle)
}

/// Returns the symbols of a voice that have other names in the player's phone table, with their
/// rows. Unknown phones are omitted; the player shows a schwa for them.
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

/// Makes stale utterances in parallel; returns `None` for those up to date.
fn make(
    wanted: &[PlannedUtterance<'_>],
    stale: &[bool],
    options: &BakeOptions,
    store: &Store<'_>,
    progress: &(dyn Fn(usize, usize, &str) + Sync),
) -> Result<Vec<Option<BakedUtterance>>> {
    let todo: Vec<usize> = (0..wanted.len()).filter(|i| stale[*i]).collect();
    let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let made: Mutex<Vec<(usize, Result<BakedUtterance>)>> = Mutex::new(Vec::new());
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
                        // The other threads stop after their current item.
                        next.store(todo.len(), Ordering::Relaxed);
                    }
                    let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                    progress(wanted.len() - todo.len() + done, wanted.len(), &text);
                }
            });
        }
    });
    let mut out: Vec<Option<BakedUtterance>> = wanted.iter().map(|_| None).collect();
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

/// Speaks one utterance and writes its audio.
fn utterance(
    wanted: &PlannedUtterance<'_>,
    options: &BakeOptions,
    store: &Store<'_>,
) -> Result<BakedUtterance> {
    let work = RenderInput {
        content: &wanted.content,
        role: &wanted.role,
        emotion: wanted.request.emotion.as_ref(),
        tension: wanted.request.tension,
        pace: options.pace,
    };
    let engine = options.cast.engine(&wanted.role)?;
    let recordings = |rate_hz: f64| {
        let read = wanted.sounds.iter().map(|path| sounds::read(path, rate_hz));
        read.collect::<Result<Vec<_>>>()
    };
    let plan = &wanted.casting.plan;
    let (track, remarks) = match engine.recorded(wanted.key, wanted.place, plan)? {
        Some(Recorded { spoken, remarks }) => {
            let track = speak::recorded(plan, spoken, wanted.request.emotion.as_ref());
            (track, remarks)
        }
        None => {
            let track = speak::speak(&work, &wanted.casting, &options.cast, &recordings)?;
            (track, Vec::new())
        }
    };
    let mut utterance = track.utterance;
    utterance.key = wanted.key;
    utterance.content = wanted.digest;
    utterance.source = Some(wanted.source);
    let encodings = encode::encode(&track.samples, track.rate_hz.round() as u32)?;
    utterance.audio = encodings
        .iter()
        .zip(encode::FORMATS)
        .map(|(bytes, (ending, mime))| store.add(bytes, ending, mime))
        .collect::<Result<_>>()?;
    let phone_set = &wanted.role.voice.phone_set;
    Ok(BakedUtterance {
        heard: measure_speech(&utterance, phone_set, &track.samples, track.rate_hz),
        lufs: integrated_lufs(&[&track.samples], track.rate_hz),
        utterance,
        remarks,
    })
}
