//! Folder of a bundle: the files of earlier bakes and of this one.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context as _, Result};
use raconteur_speech::bundle::{AudioFile, Bundle, FileDigest, Utterance, Voice};
use sha2::Digest as _;

use super::{bundle_text, encode};
use crate::files::disk::{self, Disk};
use crate::files::{input, inside, media};

/// State of an utterance's audio files in an earlier bake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sound {
    /// Each file matches the bundle.
    Whole,
    /// The files exist, but the bundle does not describe their contents.
    Untold,
    /// A file is missing, or has other contents.
    Wrong,
}

struct StoredUtterance {
    utterance: Utterance,
    sound: Sound,
}

/// Folder of a bundle, with the utterances of an earlier bake that can be reused.
///
/// The name of an audio file is derived from its contents, so audio files never change. A bake adds
/// new files next to those of the old bundle, then replaces `speech.json`, and then removes unused
/// audio files. An interruption at any time leaves either the old bundle or the new one.
pub struct Store<'d> {
    folder: PathBuf,
    disk: &'d dyn Disk,
    text: Vec<u8>,
    voices: Vec<Voice>,
    old: BTreeMap<u64, StoredUtterance>,
}

/// Maximum size of `speech.json`, bytes.
const MAX_TEXT: u64 = 256 << 20;

/// Maximum total size of a bundle's audio that is compared with its description, bytes: a month of
/// speech.
const MAX_SOUND: u64 = 16 << 30;

fn hexadecimal(digest: &[u8]) -> String {
    use core::fmt::Write as _;
    let mut out = String::with_capacity(64);
    for byte in digest {
        let _ = write!(out, "{byte:02x}");
    }
    out
}

fn digest(bytes: &[u8]) -> FileDigest {
    FileDigest {
        bytes: bytes.len() as u64,
        sha256: hexadecimal(&sha2::Sha256::digest(bytes)),
    }
}

/// Audio files of a folder, each read once even if a bundle names it repeatedly. A bundle comes
/// from strangers: its description of a file is verified, never trusted.
struct Sounds<'f> {
    folder: &'f Path,
    /// Contents of files, by their paths with links resolved.
    read: BTreeMap<PathBuf, Option<FileDigest>>,
    /// Bytes that may still be read.
    left: u64,
}

impl<'f> Sounds<'f> {
    fn from_folder(folder: &'f Path) -> Self {
        Self {
            folder,
            read: BTreeMap::new(),
            left: MAX_SOUND,
        }
    }

    /// Returns the state of the file at the path of a sound.
    fn inspect(&mut self, audio: &AudioFile) -> Sound {
        let found = inside::find(self.folder, &audio.file).ok().flatten();
        match (found, &audio.digest) {
            (None, _) => Sound::Wrong,
            (Some(_), None) => Sound::Untold,
            (Some(path), Some(told)) => match self.digest_of(path, told.bytes) {
                Some(holds) if holds == *told => Sound::Whole,
                _ => Sound::Wrong,
            },
        }
    }

    /// Returns the digest of a file; `None` if it cannot match: a file of another size is not read.
    fn digest_of(&mut self, path: PathBuf, told_bytes: u64) -> Option<FileDigest> {
        if let Some(known) = self.read.get(&path) {
            return known.clone();
        }
        let bytes = fs::metadata(&path).ok()?.len();
        if bytes != told_bytes || bytes > media::MAX_BYTES.min(self.left) {
            return None;
        }
        self.left -= bytes;
        let holds = digest_of_file(&path, bytes).ok();
        self.read.insert(path, holds.clone());
        holds
    }
}

/// Returns the digest of a file of this size, read in chunks.
fn digest_of_file(path: &Path, bytes: u64) -> Result<FileDigest> {
    let mut digest = sha2::Sha256::new();
    let read = io::copy(&mut input::open(path, bytes)?, &mut digest)?;
    Ok(FileDigest {
        bytes: read,
        sha256: hexadecimal(&digest.finalize()),
    })
}

impl<'d> Store<'d> {
    /// Reads the current bundle. An unreadable bundle, or one of another version, counts as empty:
    /// everything is baked again.
    pub fn open(folder: PathBuf, disk: &'d dyn Disk) -> Self {
        let path = inside::find(&folder, SPEECH).ok().flatten();
        let text = path.and_then(|path| input::bytes(&path, MAX_TEXT).ok());
        let text = text.unwrap_or_default();
        let bundle = Bundle::from_json(&text).unwrap_or_default();
        let mut sounds = Sounds::from_folder(&folder);
        let mut sound = |u: &Utterance| {
            let all: Vec<Sound> = u.audio.iter().map(|a| sounds.inspect(a)).collect();
            match () {
                () if all.is_empty() || all.contains(&Sound::Wrong) => Sound::Wrong,
                () if all.contains(&Sound::Untold) => Sound::Untold,
                () => Sound::Whole,
            }
        };
        let kept = |utterance: Arc<Utterance>| {
            let utterance = Arc::unwrap_or_clone(utterance);
            let sound = sound(&utterance);
            (utterance.key, StoredUtterance { utterance, sound })
        };
        let old = bundle.utterances.into_iter().map(kept).collect();
        Self {
            folder,
            disk,
            text,
            voices: bundle.voices,
            old,
        }
    }

    fn complete(&self, key: u64) -> Option<&Utterance> {
        let kept = self.old.get(&key).filter(|k| k.sound == Sound::Whole);
        kept.map(|k| &k.utterance)
    }

    /// Returns true if an utterance exists with exactly this input.
    pub fn has(&self, key: u64, digest: u64) -> bool {
        self.complete(key).is_some_and(|u| u.content == digest)
    }

    /// Returns true if an utterance exists from the same story, by any engine.
    pub fn has_source(&self, key: u64, source: u64) -> bool {
        self.complete(key).is_some_and(|u| u.source == Some(source))
    }

    /// Returns an utterance of the earlier bake by its key; `None` if it is missing or its audio is
    /// incomplete.
    pub fn get(&self, key: u64) -> Option<Utterance> {
        self.complete(key).cloned()
    }

    /// Returns the voice of an utterance of the earlier bake.
    pub fn voice(&self, key: u64) -> Option<&Voice> {
        self.voices.get(self.complete(key)?.voice)
    }

    /// Returns the state of an utterance's audio in the earlier bake; `None` for an unknown key.
    pub fn sound(&self, key: u64) -> Option<Sound> {
        self.old.get(&key).map(|k| k.sound)
    }

    /// Returns the number of utterances of the earlier bake not among these.
    pub fn count_others(&self, keys: impl Iterator<Item = u64>) -> usize {
        let keys: BTreeSet<u64> = keys.collect();
        self.old.keys().filter(|key| !keys.contains(key)).count()
    }

    /// Adopts the sounds of an utterance with exactly this input whose files the bundle did not
    /// describe, under names that do, if all match the utterance.
    ///
    /// # Errors
    /// Returns an error if the files cannot be read or written.
    pub fn adopt(
        &mut self,
        key: u64,
        digest: u64,
        is_sound_of: &dyn Fn(&Utterance, &Path) -> bool,
    ) -> Result<()> {
        let found = self.old.get(&key).filter(|k| k.sound == Sound::Untold);
        let Some(kept) = found.filter(|k| k.utterance.content == digest) else {
            return Ok(());
        };
        let mut utterance = kept.utterance.clone();
        for audio in &mut utterance.audio {
            let Some(path) = inside::find(&self.folder, &audio.file)? else {
                return Ok(());
            };
            if !is_sound_of(&kept.utterance, &path) {
                return Ok(());
            }
            let bytes = input::bytes(&path, media::MAX_BYTES)?;
            let ending = Path::new(&audio.file).extension().unwrap_or_default();
            let mime = audio.mime.clone();
            *audio = self.add(&bytes, &ending.to_string_lossy(), &mime)?;
        }
        let sound = Sound::Whole;
        self.old.insert(key, StoredUtterance { utterance, sound });
        Ok(())
    }

    /// Writes a sound to the folder, under a name derived from its contents.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    pub fn add(&self, bytes: &[u8], ending: &str, mime: &str) -> Result<AudioFile> {
        let holds = digest(bytes);
        let audio = AudioFile {
            file: format!("{}.{ending}", &holds.sha256[..NAME_DIGITS]),
            mime: mime.to_owned(),
            digest: Some(holds),
        };
        // The file may be truncated: a disk that lost its power keeps names without content.
        if Sounds::from_folder(&self.folder).inspect(&audio) != Sound::Whole {
            disk::replace_on(self.disk, &self.folder.join(&audio.file), bytes)?;
        }
        Ok(audio)
    }

    /// Returns true if the folder contains exactly this bundle and no other output of a bake.
    ///
    /// # Errors
    /// Returns an error if the folder cannot be read.
    pub fn is(&self, bundle: &Bundle) -> Result<bool> {
        let text = bundle_text::write(bundle);
        Ok(self.text == text.as_bytes() && self.unused(bundle)?.is_empty())
    }

    /// Writes the bundle's text, unless it is unchanged, so that bakes do not trigger build tools.
    /// All its sounds must be in the folder.
    ///
    /// # Errors
    /// Returns an error if the text cannot be written.
    pub fn write(&self, bundle: &Bundle) -> Result<()> {
        let text = bundle_text::write(bundle);
        if self.text == text.as_bytes() {
            return Ok(());
        }
        disk::replace_on(self.disk, &self.folder.join(SPEECH), text.as_bytes())
    }

    /// Removes all output of a bake; the text first, so that it never names missing sounds.
    ///
    /// # Errors
    /// Returns an error if a file cannot be removed.
    pub fn clear(&self) -> Result<usize> {
        let path = self.folder.join(SPEECH);
        if fs::symlink_metadata(&path).is_ok() {
            let told = || format!("removing {}", path.display());
            self.disk.remove(&path).with_context(told)?;
            self.disk.sync_folder(&self.folder).with_context(told)?;
        }
        self.remove_unused(&Bundle::default())
    }

    /// Removes audio files of a bake that the bundle no longer names, and leftovers of interrupted
    /// bakes. Only names generated by a bake are affected. Returns the number of removed sounds.
    ///
    /// # Errors
    /// Returns an error if a file cannot be removed.
    pub fn remove_unused(&self, bundle: &Bundle) -> Result<usize> {
        let unused = self.unused(bundle)?;
        for name in &unused {
            let path = self.folder.join(name);
            self.disk
                .remove(&path)
                .with_context(|| format!("removing {}", path.display()))?;
        }
        Ok(unused.iter().filter(|name| is_sound(name)).count())
    }

    /// Returns the names of files generated by a bake that this bundle does not name.
    fn unused(&self, bundle: &Bundle) -> Result<Vec<String>> {
        let used: BTreeSet<&str> = bundle
            .utterances
            .iter()
            .flat_map(|u| &u.audio)
            .map(|a| a.file.as_str())
            .collect();
        let told = || format!("reading {}", self.folder.display());
        let entries = match fs::read_dir(&self.folder) {
            Ok(entries) => entries,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(error).with_context(told),
        };
        let mut names = Vec::new();
        for entry in entries {
            let name = entry.with_context(told)?.file_name();
            let Some(name) = name.to_str() else { continue };
            if !used.contains(name) && (is_sound(name) || disk::is_part(name)) {
                names.push(name.to_owned());
            }
        }
        names.sort();
        Ok(names)
    }
}

/// The bundle's text.
const SPEECH: &str = "speech.json";

/// Digits of a sound's SHA-256 in its name: 128 bits.
const NAME_DIGITS: usize = 32;

/// Returns true if a file name is that of an audio file written by a bake. Earlier bakes named
/// files after the 16 digits of their key.
fn is_sound(name: &str) -> bool {
    name.split_once('.').is_some_and(|(stem, ending)| {
        [16, NAME_DIGITS].contains(&stem.len())
            && stem.bytes().all(|b| b.is_ascii_hexdigit())
            && encode::FORMATS.iter().any(|(known, _)| *known == ending)
    })
}

#[cfg(test)]
mod tests;
