//! Package contents by their path in the package.

use std::collections::BTreeMap;
use std::io::{Cursor, Write as _};
use std::path::Path;

use anyhow::{Context as _, Result};
use raconteur_player::Player;
use raconteur_speech::Bundle;
use raconteur_voice::files::{disk, input, inside};
use serde::Deserialize;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::player_folder;
use crate::assets;
use crate::story::{StoryFiles, USUAL_FIGURE};

/// Names the files of a built page that a course needs.
pub(super) const LIST: &str = "course.json";

/// The largest file of a package, bytes.
const MAX_FILE_BYTES: u64 = 512 << 20;

/// The list, as the build of the page writes it.
#[derive(Deserialize)]
struct Built {
    /// The script of the page and all that it fetches.
    player: Vec<String>,
    /// Files needed only by stories spoken in the page.
    speech: Vec<String>,
}

/// Files of a package under construction, by their paths in it.
pub(super) struct Parts {
    files: BTreeMap<String, Vec<u8>>,
    /// Files added for speech synthesis in the page, with their folder.
    speech: Vec<String>,
    built: std::path::PathBuf,
}

impl Parts {
    /// Creates the package with the files of a built player.
    pub(super) fn of_player(named: Option<&Path>) -> Result<Self> {
        let built = player_folder(named)?;
        let list = input::text(&built.join(LIST), input::MAX_TEXT_BYTES)?;
        let Built { player, speech } = serde_json::from_str(&list)
            .with_context(|| format!("the list {LIST} of the player"))?;
        let mut parts = Self {
            files: BTreeMap::new(),
            speech,
            built,
        };
        parts.add_built(&player)?;
        Ok(parts)
    }

    fn add_built(&mut self, files: &[String]) -> Result<()> {
        for file in files {
            let bytes = read_from(&self.built, file)?
                .with_context(|| format!("the player's build lacks {file}"))?;
            self.add(&format!("player/{file}"), bytes);
        }
        Ok(())
    }

    /// Adds a story with its voice, its own animations, pictures and music, and the library files
    /// that it uses, to this folder of the package. Returns the address of the script there.
    pub(super) fn add_story(
        &mut self,
        files: &StoryFiles,
        player: &Player,
        to: &str,
    ) -> Result<String> {
        let folder = files.folder();
        let script = files
            .script
            .file_name()
            .unwrap_or_default()
            .to_string_lossy();
        let story = format!("{to}/{script}");
        self.add(&story, files.text.clone().into_bytes());
        let mut own = Vec::new();
        if let Some(json) = files.bundle() {
            let bundle = Bundle::from_json(&json).context("the speech bundle")?;
            let sounds = bundle.utterances.iter().flat_map(|u| &u.audio);
            own.extend(sounds.map(|sound| format!("voice/{}", sound.file)));
            self.add(&format!("{to}/voice/speech.json"), json);
        }
        for name in player.needed_animations() {
            if name.contains(['/', '.']) {
                own.push(name.split('#').next().unwrap_or_default().to_owned());
            }
        }
        for (name, bytes) in assets::animations() {
            self.add(&format!("library/animations/{name}"), bytes.to_vec());
        }
        for cue in player.music() {
            if cue.library {
                self.add_music(&cue.file)?;
            } else {
                own.push(cue.file);
            }
        }
        let document = raconteur_eml::parse(&files.text).document;
        own.extend(document.pictures().map(|(path, _)| path.to_owned()));
        for path in own {
            // Missing files are already reported as problems of the story.
            if let Some(bytes) = read_from(folder, &path)? {
                self.add(&format!("{to}/{path}"), bytes);
            }
        }
        if player
            .utterances()
            .iter()
            .any(|u| u.timed.utterance.audio.is_empty())
        {
            let speech = std::mem::take(&mut self.speech);
            self.add_built(&speech)?;
        }
        Ok(story)
    }

    /// Adds a piece of music from the library, in both encodings that browsers need.
    fn add_music(&mut self, file: &str) -> Result<()> {
        for path in [file.to_owned(), file.replace(".opus", ".mp3")] {
            if let Ok(bytes) = assets::read(&format!("music/{path}")) {
                self.add(&format!("library/music/{path}"), bytes.into_owned());
            } else if path == file {
                anyhow::bail!("no {path} in the library; name its folder with --assets");
            }
        }
        Ok(())
    }

    /// Adds the performing figure: one of the library, or a file next to the story, which is copied
    /// to this folder.
    pub(super) fn add_figure(
        &mut self,
        files: &StoryFiles,
        name: Option<&str>,
        to: &str,
    ) -> Result<()> {
        let name = name.unwrap_or(USUAL_FIGURE);
        if let Some(bytes) = Path::new(name)
            .extension()
            .map_or(Ok(None), |_| read_from(files.folder(), name))?
        {
            self.add(&format!("{to}/{name}"), bytes);
        }
        // A figure of the library is there in any case: it performs where the other cannot.
        let usual = if Path::new(name).extension().is_some() {
            USUAL_FIGURE
        } else {
            name
        };
        let read = assets::read(&format!("figures/{usual}.glb"));
        let (usual, bytes) = match read {
            Ok(bytes) => (usual, bytes),
            Err(_) => (
                USUAL_FIGURE,
                assets::read(&format!("figures/{USUAL_FIGURE}.glb"))?,
            ),
        };
        self.add(&format!("library/figures/{usual}.glb"), bytes.into_owned());
        Ok(())
    }

    /// Adds a file at a path of the package.
    pub(super) fn add(&mut self, path: &str, bytes: Vec<u8>) {
        self.files.insert(plain(path), bytes);
    }

    /// Returns the paths of all files, sorted.
    pub(super) fn paths(&self) -> Vec<String> {
        self.files.keys().cloned().collect()
    }

    /// Writes the package: the same bytes for the same files. A partial file is removed on failure.
    pub(super) fn write(&self, to: &Path) -> Result<()> {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .last_modified_time(zip::DateTime::default());
        for (path, bytes) in &self.files {
            zip.start_file(path.as_str(), options)?;
            zip.write_all(bytes)?;
        }
        disk::replace(to, zip.finish()?.get_ref())
    }
}

/// Normalises a path as in addresses: without redundant steps.
fn plain(path: &str) -> String {
    let steps = path.split('/').filter(|step| !matches!(*step, "" | "."));
    steps.collect::<Vec<_>>().join("/")
}

/// Reads a file in a folder, by its path there; `None` if it does not exist.
fn read_from(folder: &Path, path: &str) -> Result<Option<Vec<u8>>> {
    let found = inside::find(folder, path)?;
    found
        .map(|found| input::bytes(&found, MAX_FILE_BYTES))
        .transpose()
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn paths_have_no_steps_that_go_nowhere() {
        assert_eq!(plain("story/./moves//a.json"), "story/moves/a.json");
    }
}
