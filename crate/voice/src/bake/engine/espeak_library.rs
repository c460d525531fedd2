//! libespeak-ng, loaded at run time: only its events specify the start of each phone and each word,
//! which the program `espeak-ng` does not print.
//!
//! Layouts and numbers are those of `speak_lib.h` of espeak-ng 1.51 and 1.52 (API revision 12,
//! unchanged since revision 7 of 2011).
#![allow(
    unsafe_code,
    reason = "calls a library of C that is loaded at run time"
)]

use core::cell::RefCell;
use core::ffi::{CStr, c_char, c_int, c_short, c_uint, c_void};
use std::ffi::CString;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock, PoisonError};

use anyhow::{Context as _, Result, ensure};
use libloading::Library;

use super::super::program::MissingPrograms;
use super::espeak::{Event, EventKind, Host, Synthesis};

/// Possible file names of the library.
const NAMES: [&str; 5] = [
    "libespeak-ng.so.1",
    "libespeak-ng.so",
    "libespeak-ng.1.dylib",
    "libespeak-ng.dylib",
    "libespeak-ng.dll",
];

const AUDIO_OUTPUT_SYNCHRONOUS: c_int = 2;
const INITIALIZE_PHONEME_EVENTS: c_int = 1;
const INITIALIZE_DONT_EXIT: c_int = 0x8000;
const POS_CHARACTER: c_int = 1;
const CHARS_UTF8: c_uint = 1;
const PHONEMES: c_uint = 0x100;

/// Mnemonics, with [`SEPARATOR`] between them.
const PHONEME_MODE: c_int = (SEPARATOR as c_int) << 8;
/// Byte that separates mnemonics; no mnemonic contains it.
const SEPARATOR: u8 = 1;

/// Maximum number of clauses in one text.
const MAX_CLAUSES: usize = 1_000;

const EVENT_LIST_TERMINATED: c_int = 0;
const EVENT_WORD: c_int = 1;
const EVENT_END: c_int = 5;
const EVENT_PHONEME: c_int = 7;

/// Maximum number of samples for one text: ten minutes at 22,050 Hz.
const MAX_SAMPLES: usize = 600 * 22_050;

/// `espeak_EVENT`.
#[repr(C)]
struct RawEvent {
    kind: c_int,
    unique_identifier: c_uint,
    text_position: c_int,
    length: c_int,
    audio_position: c_int,
    sample: c_int,
    user_data: *mut c_void,
    /// A union of a number, a pointer and these characters.
    id: Id,
}

#[repr(C)]
union Id {
    name: *const c_char,
    string: [u8; 8],
}

type Callback = extern "C" fn(*mut c_short, c_int, *mut RawEvent) -> c_int;
type Initialize = unsafe extern "C" fn(c_int, c_int, *const c_char, c_int) -> c_int;
type SetSynthCallback = unsafe extern "C" fn(Callback);
type SetVoiceByName = unsafe extern "C" fn(*const c_char) -> c_int;
type Synth = unsafe extern "C" fn(
    *const c_void,
    usize,
    c_uint,
    c_int,
    c_uint,
    c_uint,
    *mut c_uint,
    *mut c_void,
) -> c_int;
type TextToPhonemes = unsafe extern "C" fn(*mut *const c_void, c_int, c_int) -> *const c_char;
type Terminate = unsafe extern "C" fn() -> c_int;
type Info = unsafe extern "C" fn(*mut *const c_char) -> *const c_char;

unsafe extern "C" {
    /// Seeds the random numbers of the C library.
    fn srand(seed: c_uint);
}

/// Lock for the library, which keeps its state in global variables: one call at a time.
static ALONE: Mutex<()> = Mutex::new(());

thread_local! {
    /// Output of the callback; the library calls it on the calling thread.
    static SAID: RefCell<Synthesis> = RefCell::new(Synthesis::default());
}

/// Initialised library. It keeps state between texts (of noise, flutter, buffer position), so the
/// same text sounds different the second time. It is therefore reloaded for every text, and
/// terminated exactly once: after a second initialisation, termination waits forever for its own
/// thread (*seen* with 1.51).
struct Espeak {
    rate_hz: u32,
    initialize: Initialize,
    set_callback: SetSynthCallback,
    set_voice: SetVoiceByName,
    synth: Synth,
    to_phonemes: TextToPhonemes,
    terminate: Terminate,
    info: Info,
    /// Library that owns the functions; dropped after them.
    _library: Library,
}

impl Espeak {
    fn load() -> Result<Self> {
        let library = NAMES
            .iter()
            // SAFETY: loading runs the library's initialisers, as any program linked to it does.
            .find_map(|name| unsafe { Library::new(name) }.ok())
            .ok_or_else(|| MissingPrograms::one("libespeak-ng", "libespeak-ng1 espeak-ng-data"))?;
        let told = "libespeak-ng is not as it should be";
        // SAFETY: the types are those that `speak_lib.h` declares for these names, and the
        // library lives as long as the functions.
        let mut espeak = unsafe {
            Self {
                rate_hz: 0,
                initialize: *library
                    .get::<Initialize>(b"espeak_Initialize\0")
                    .context(told)?,
                set_callback: *library
                    .get::<SetSynthCallback>(b"espeak_SetSynthCallback\0")
                    .context(told)?,
                set_voice: *library
                    .get::<SetVoiceByName>(b"espeak_SetVoiceByName\0")
                    .context(told)?,
                synth: *library.get::<Synth>(b"espeak_Synth\0").context(told)?,
                to_phonemes: *library
                    .get::<TextToPhonemes>(b"espeak_TextToPhonemes\0")
                    .context(told)?,
                terminate: *library
                    .get::<Terminate>(b"espeak_Terminate\0")
                    .context(told)?,
                info: *library.get::<Info>(b"espeak_Info\0").context(told)?,
                _library: library,
            }
        };
        espeak.rate_hz = espeak.start()?;
        Ok(espeak)
    }

    /// Initialises the library and returns its rate.
    fn start(&self) -> Result<u32> {
        // SAFETY: a null path is the usual one; the options are those of the header.
        let rate_hz = unsafe {
            (self.initialize)(
                AUDIO_OUTPUT_SYNCHRONOUS,
                0,
                core::ptr::null(),
                INITIALIZE_PHONEME_EVENTS | INITIALIZE_DONT_EXIT,
            )
        };
        u32::try_from(rate_hz)
            .ok()
            .filter(|r| *r > 0)
            .ok_or_else(|| {
                MissingPrograms::one("the data of libespeak-ng", "espeak-ng-data").into()
            })
    }

    /// Returns the version of the library and its data folder.
    fn about(&self) -> (String, PathBuf) {
        let mut path: *const c_char = core::ptr::null();
        // SAFETY: both results are strings of the library that end in 0, or null.
        let (version, path) = unsafe { (text((self.info)(&mut path)), text(path)) };
        (version, PathBuf::from(path))
    }
}

/// Returns a copy of a C string; empty for a null pointer.
///
/// # Safety
/// `pointer` must be null or point to a string that ends with a zero byte.
unsafe fn text(pointer: *const c_char) -> String {
    if pointer.is_null() {
        return String::new();
    }
    // SAFETY: as the caller promises.
    unsafe { CStr::from_ptr(pointer) }
        .to_string_lossy()
        .into_owned()
}

/// Receives audio and events. Returns 1 to stop.
extern "C" fn take(wave: *mut c_short, count: c_int, events: *mut RawEvent) -> c_int {
    let stop = 1;
    SAID.with(|said| {
        let Ok(mut said) = said.try_borrow_mut() else {
            return stop;
        };
        if !wave.is_null()
            && let Ok(count) = usize::try_from(count)
        {
            if said.samples.len() + count > MAX_SAMPLES {
                return stop;
            }
            // SAFETY: the library provides `count` samples at `wave`.
            said.samples
                .extend_from_slice(unsafe { core::slice::from_raw_parts(wave, count) });
        }
        let mut at = events;
        while !at.is_null() {
            // SAFETY: the list continues until an event of kind 0.
            let event = unsafe { &*at };
            let what = match event.kind {
                EVENT_LIST_TERMINATED => break,
                EVENT_WORD => Some(EventKind::Word(
                    usize::try_from(event.text_position).unwrap_or(0),
                )),
                EVENT_PHONEME => {
                    // SAFETY: phoneme events contain the characters, and any bytes are valid.
                    let bytes = unsafe { event.id.string };
                    let end = bytes.iter().position(|b| *b == 0).unwrap_or(bytes.len());
                    let name = String::from_utf8_lossy(&bytes[..end]);
                    // Since 1.52 with a mark of stress.
                    Some(EventKind::Phone(
                        name.trim().trim_start_matches(['\'', ',']).to_owned(),
                    ))
                }
                EVENT_END => Some(EventKind::End),
                _ => None,
            };
            said.events.extend(what.map(|what| Event {
                sample: usize::try_from(event.sample).unwrap_or(0),
                what,
            }));
            // SAFETY: this event was not the last.
            at = unsafe { at.add(1) };
        }
        0
    })
}

impl Drop for Espeak {
    fn drop(&mut self) {
        // SAFETY: it was initialised once, and nothing else uses it.
        unsafe { (self.terminate)() };
    }
}

/// Runs an action with exclusive access to the library.
fn with<T>(act: impl FnOnce(&Espeak) -> Result<T>) -> Result<T> {
    let guard = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let espeak = Espeak::load()?;
    // SAFETY: any seed is valid. The library takes its noise from the C library.
    unsafe { srand(1) };
    let done = act(&espeak);
    drop(espeak);
    drop(guard);
    done
}

/// Host that runs the espeak-ng library installed on this machine.
pub(super) struct Installed;

impl Host for Installed {
    fn version(&self) -> Result<String> {
        Ok(about()?.0)
    }

    fn files(&self, folder: &str) -> Result<Vec<String>> {
        let (_, data) = about()?;
        let mut out = Vec::new();
        // A language without relatives is a file next to the families.
        for entry in names(&data.join(folder))? {
            let path = data.join(folder).join(&entry);
            if path.is_dir() {
                let files = names(&path)?;
                out.extend(files.into_iter().map(|file| format!("{entry}/{file}")));
            } else {
                out.push(entry);
            }
        }
        Ok(out)
    }

    fn text(&self, path: &str) -> Result<String> {
        let (_, data) = about()?;
        Ok(fs::read_to_string(data.join(path)).unwrap_or_default())
    }

    /// Speaks texts, with a new instance of the library for each, so that the result does not
    /// depend on their order.
    fn speak(&self, voice: &str, texts: &[String]) -> Result<Vec<Synthesis>> {
        let name = CString::new(voice).context("the name of the voice")?;
        let mut out = Vec::with_capacity(texts.len());
        for text in texts {
            let text = CString::new(text.as_str()).context("the text")?;
            out.push(with(|espeak| speak_one(espeak, &name, &text))?);
        }
        Ok(out)
    }
}

/// Returns the entries of a folder, sorted.
fn names(folder: &Path) -> Result<Vec<String>> {
    let entries = fs::read_dir(folder)
        .with_context(|| format!("reading the voices of espeak-ng in {}", folder.display()))?;
    let mut out = Vec::new();
    for entry in entries {
        out.extend(entry?.file_name().to_str().map(str::to_owned));
    }
    out.sort();
    Ok(out)
}

/// Returns the library's version and its data folder.
fn about() -> Result<(String, PathBuf)> {
    static ABOUT: OnceLock<(String, PathBuf)> = OnceLock::new();
    if let Some(about) = ABOUT.get() {
        return Ok(about.clone());
    }
    let about = with(|espeak| Ok(espeak.about()))?;
    Ok(ABOUT.get_or_init(|| about).clone())
}

fn speak_one(espeak: &Espeak, voice: &CStr, text: &CStr) -> Result<Synthesis> {
    SAID.with(|said| said.replace(Synthesis::default()));
    // SAFETY: the strings end in 0 and live until the calls return; the size includes the 0; the
    // callback is a function. Mode "synchronous" completes all work before it returns.
    let (found, done, marked) = unsafe {
        (espeak.set_callback)(take);
        let found = (espeak.set_voice)(voice.as_ptr());
        let done = if found == 0 {
            (espeak.synth)(
                text.as_ptr().cast(),
                text.count_bytes() + 1,
                0,
                POS_CHARACTER,
                0,
                CHARS_UTF8 | PHONEMES,
                core::ptr::null_mut(),
                core::ptr::null_mut(),
            )
        } else {
            0
        };
        let marked = if found == 0 {
            marked(espeak, text)
        } else {
            Vec::new()
        };
        (found, done, marked)
    };
    ensure!(found == 0, "espeak-ng has no voice {voice:?}");
    ensure!(done == 0, "espeak-ng failed with {done}");
    let mut said = SAID.with(RefCell::take);
    said.rate_hz = espeak.rate_hz;
    said.marked = marked;
    Ok(said)
}

/// Translates a text, clause by clause.
///
/// # Safety
/// The library must be initialised and have a voice, and nothing else may use it at the same time.
unsafe fn marked(espeak: &Espeak, text: &CStr) -> Vec<String> {
    let mut rest: *const c_void = text.as_ptr().cast();
    let mut out = Vec::new();
    for _ in 0..MAX_CLAUSES {
        if rest.is_null() {
            break;
        }
        // SAFETY: `rest` points into the text, where the library moves it, until it is null; the
        // returned string belongs to the library until the next call, and is copied immediately.
        let clause = unsafe {
            self::text((espeak.to_phonemes)(
                &mut rest,
                CHARS_UTF8 as c_int,
                PHONEME_MODE,
            ))
        };
        let parted = clause.split([char::from(SEPARATOR), ' ', '\n']);
        out.extend(parted.filter(|p| !p.is_empty()).map(str::to_owned));
    }
    out
}
