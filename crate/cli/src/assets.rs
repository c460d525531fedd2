//! The asset library: figures, animations and music that stories share.
//!
//! It lies in the folder that `--assets` names, or else in a folder `assets` of those above the
//! story, above the working folder or above the program. What every story needs, the figures
//! and the animations, is in the program as well, so that it works wherever it is.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use anyhow::{Result, bail, ensure};
use include_dir::{Dir, include_dir};

use raconteur_voice::files::{input, inside};

static FIGURES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/../../assets/figures");
static ANIMATIONS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/../../assets/animations");
/// The story that `raconteur new` makes, with its voice.
pub(crate) static FIRST_STORY: Dir<'_> =
    include_dir!("$CARGO_MANIFEST_DIR/../../assets/stories/hello-world");

/// The largest file that is read, bytes.
const LARGEST: u64 = 512 << 20;

/// What `--assets` names.
static FOLDER: OnceLock<PathBuf> = OnceLock::new();

/// Looks into this folder before all others.
///
/// # Errors
/// When it is none.
pub(crate) fn look_into(folder: PathBuf) -> Result<()> {
    ensure!(
        folder.is_dir(),
        "--assets takes a folder, and {} is none",
        folder.display()
    );
    FOLDER.get_or_init(|| folder);
    Ok(())
}

/// A file of the library on disk.
///
/// # Errors
/// When it is not there, or its path leaves the library.
pub(crate) fn find(path: &str, story: &Path) -> Result<PathBuf> {
    let near = story.canonicalize().unwrap_or_else(|_| story.to_owned());
    let here = std::env::current_dir().unwrap_or_default();
    let program = std::env::current_exe().unwrap_or_default();
    let above = [near.as_path(), &here, &program];
    let above = above.into_iter().flat_map(Path::ancestors);
    let folders = FOLDER.get().cloned().into_iter();
    for folder in folders.chain(above.map(|folder| folder.join("assets"))) {
        if let Some(found) = inside::find(&folder, path)? {
            return Ok(found);
        }
    }
    bail!("no {path} in an assets folder; name one with --assets")
}

/// What a file of the library holds: on disk, or in the program.
///
/// # Errors
/// When it is in neither, or cannot be read.
pub(crate) fn read(path: &str, story: &Path) -> Result<Cow<'static, [u8]>> {
    match find(path, story) {
        Ok(file) => Ok(input::bytes(&file, LARGEST)?.into()),
        Err(error) => {
            let inside = match path.split_once('/') {
                Some(("figures", file)) => FIGURES.get_file(file),
                Some(("animations", file)) => ANIMATIONS.get_file(file),
                _ => None,
            };
            inside.map(|file| file.contents().into()).ok_or(error)
        }
    }
}

/// The names of the library's figures: those in the program, and those on disk near a story.
pub(crate) fn figure_names(story: &Path) -> BTreeSet<String> {
    let on_disk = find("figures/sofia.glb", story).ok();
    let listed = on_disk.and_then(|file| std::fs::read_dir(file.parent()?).ok());
    let listed = listed.into_iter().flatten().flatten().map(|f| f.path());
    let held = FIGURES.files().map(|file| file.path().to_owned());
    let models = held
        .chain(listed)
        .filter(|p| p.extension().is_some_and(|e| e == "glb"));
    models
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_program_holds_what_every_story_needs() {
        let nowhere = Path::new("/nowhere/story.eml");
        for file in ["figures/sofia.glb", "animations/stand.json"] {
            let (folder, name) = file.split_once('/').unwrap();
            let held = if folder == "figures" {
                &FIGURES
            } else {
                &ANIMATIONS
            };
            assert_eq!(
                &*read(file, nowhere).unwrap(),
                held.get_file(name).unwrap().contents()
            );
        }
        for outside in ["../Cargo.toml", "/etc/passwd", "figures/../../Cargo.toml"] {
            assert!(read(outside, nowhere).is_err(), "{outside}");
        }
        let told = read("figures/nobody.glb", nowhere).unwrap_err().to_string();
        assert!(told.contains("--assets"), "{told}");
    }
}
