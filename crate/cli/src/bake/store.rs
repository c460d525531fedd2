//! The folder of a bundle: what an earlier bake left there, and what this one puts there.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;

use anyhow::{Context as _, Result};
use raconteur_player::speech::bundle::{AudioFile, Bundle, Utterance};

use super::{bundle_text, encode};

/// FNV-1a, 64 bits.
pub(crate) struct Digest(u64);

impl Digest {
    pub(crate) fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    pub(crate) fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 ^= u64::from(*byte);
            self.0 = self.0.wrapping_mul(0x0100_0000_01b3);
        }
    }

    pub(crate) fn number(&mut self, number: u64) {
        self.bytes(&number.to_le_bytes());
    }

    /// A text and that it ends.
    pub(crate) fn text(&mut self, text: &str) {
        self.bytes(text.as_bytes());
        self.bytes(&[0xff]);
    }

    pub(crate) fn value(&self) -> u64 {
        self.0
    }
}

/// The folder, and the utterances of an earlier bake whose sound is there.
pub(crate) struct Store {
    folder: PathBuf,
    old: BTreeMap<u64, Utterance>,
}

impl Store {
    /// Reads what is there. A bundle that cannot be read, or of another version, holds
    /// nothing: everything is baked again.
    pub(crate) fn open(folder: PathBuf) -> Self {
        let json = fs::read(folder.join("speech.json")).unwrap_or_default();
        let bundle = Bundle::from_json(&json).unwrap_or_default();
        let whole = |u: &Utterance| {
            !u.audio.is_empty() && u.audio.iter().all(|a| folder.join(&a.file).is_file())
        };
        let old = bundle
            .utterances
            .into_iter()
            .filter(whole)
            .map(|u| (u.key, u))
            .collect();
        Self { folder, old }
    }

    /// Whether an utterance is there, made of just this.
    pub(crate) fn has(&self, key: u64, digest: u64) -> bool {
        self.old.get(&key).is_some_and(|u| u.content == digest)
    }

    /// An utterance of the earlier bake.
    pub(crate) fn get(&self, key: u64) -> Option<Utterance> {
        self.old.get(&key).cloned()
    }

    /// How many utterances of the earlier bake are none of these.
    pub(crate) fn others(&self, keys: impl Iterator<Item = u64>) -> usize {
        let keys: BTreeSet<u64> = keys.collect();
        self.old.keys().filter(|key| !keys.contains(key)).count()
    }

    /// Makes the folder.
    pub(crate) fn prepare(&self) -> Result<()> {
        fs::create_dir_all(&self.folder)
            .with_context(|| format!("making {}", self.folder.display()))
    }

    /// Writes the sound of an utterance in all encodings.
    pub(crate) fn encode(&self, key: u64, samples: &[f64], rate_hz: f64) -> Result<Vec<AudioFile>> {
        let stem = format!("{key:016x}");
        let files = encode::encode(samples, rate_hz.round() as u32, &stem, &self.folder)?;
        let named = |(file, mime): (String, &'static str)| AudioFile {
            file,
            mime: mime.to_owned(),
        };
        Ok(files.into_iter().map(named).collect())
    }

    /// Writes the bundle's text, unless it is there already, so that bakes do not disturb
    /// build tools. Returns its length.
    pub(crate) fn write(&self, bundle: &Bundle) -> Result<u64> {
        let path = self.folder.join("speech.json");
        let text = bundle_text::write(bundle);
        if fs::read(&path).ok().as_deref() != Some(text.as_bytes()) {
            fs::write(&path, &text).with_context(|| format!("writing {}", path.display()))?;
        }
        Ok(text.len() as u64)
    }

    /// Bytes of a file.
    pub(crate) fn size(&self, file: &str) -> Result<u64> {
        Ok(fs::metadata(self.folder.join(file))?.len())
    }

    /// Removes everything that a bake made, and the folder if that empties it.
    pub(crate) fn clear(&self) -> Result<usize> {
        if !self.folder.join("speech.json").is_file() {
            return Ok(0);
        }
        let removed = self.remove_unused(&Bundle::default())?;
        fs::remove_file(self.folder.join("speech.json"))?;
        // Somebody else's files stay, and their folder with them.
        let _ = fs::remove_dir(&self.folder);
        Ok(removed)
    }

    /// Removes sound files that a bake made and that the bundle no longer names. Only names
    /// that a bake gives (a key and a known ending) are touched.
    pub(crate) fn remove_unused(&self, bundle: &Bundle) -> Result<usize> {
        let mut removed = 0;
        for entry in fs::read_dir(&self.folder)? {
            let entry = entry?;
            let name = entry.file_name();
            let Some(name) = name.to_str() else { continue };
            let ours = name.split_once('.').is_some_and(|(stem, ending)| {
                stem.len() == 16
                    && stem.bytes().all(|b| b.is_ascii_hexdigit())
                    && encode::ENDINGS.contains(&ending)
            });
            let used = bundle
                .utterances
                .iter()
                .flat_map(|u| &u.audio)
                .any(|a| a.file == name);
            if ours && !used {
                fs::remove_file(entry.path())
                    .with_context(|| format!("removing {}", entry.path().display()))?;
                removed += 1;
            }
        }
        Ok(removed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_player::speech::bundle::Voice;

    fn utterance(key: u64, content: u64, file: &str) -> Utterance {
        Utterance {
            key,
            content,
            audio: vec![AudioFile {
                file: file.to_owned(),
                mime: "a".to_owned(),
            }],
            ..Utterance::default()
        }
    }

    #[test]
    fn only_unused_files_that_a_bake_made_are_removed() {
        let dir = tempfile::tempdir().unwrap();
        for name in [
            "0123456789abcdef.opus",
            "00000000000000aa.mp3",
            "drum.mp3",
            "notes.txt",
        ] {
            fs::write(dir.path().join(name), "x").unwrap();
        }
        let bundle = Bundle {
            voices: Vec::new(),
            utterances: vec![utterance(0xaa, 0, "00000000000000aa.mp3")],
        };
        let store = Store::open(dir.path().to_owned());
        assert_eq!(store.remove_unused(&bundle).unwrap(), 1);
        assert!(!dir.path().join("0123456789abcdef.opus").exists());
        assert!(dir.path().join("00000000000000aa.mp3").exists());
        assert!(dir.path().join("drum.mp3").exists());
    }

    #[test]
    fn an_utterance_is_kept_while_its_sound_is_there_and_it_is_made_of_the_same() {
        let dir = tempfile::tempdir().unwrap();
        let bundle = Bundle {
            voices: vec![Voice::default()],
            utterances: vec![utterance(1, 2, "k.opus")],
        };
        let store = Store::open(dir.path().to_owned());
        store.write(&bundle).unwrap();
        let open = || Store::open(dir.path().to_owned());
        assert!(!open().has(1, 2), "its sound is missing");
        fs::write(dir.path().join("k.opus"), "x").unwrap();
        assert!(open().has(1, 2));
        assert!(!open().has(1, 3) && !open().has(2, 2));
        assert_eq!(open().others([1].into_iter()), 0);
        assert_eq!(open().others([2].into_iter()), 1);
        fs::write(dir.path().join("speech.json"), "{").unwrap();
        assert!(!open().has(1, 2));
    }
}
