//! Asset library: figures, animations and music that stories share.
//!
//! The figures and animations, which every story needs, are embedded in the program, so that it
//! works in any location. The folder named by `--assets` takes precedence; all other assets are in
//! that folder, or in `assets` next to the program.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use anyhow::{Context as _, Result, ensure};
use include_dir::{Dir, include_dir};

use raconteur_voice::bake::engine::add_folder;
use raconteur_voice::files::{input, inside};

static FIGURES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/../../assets/figures");
static ANIMATIONS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/../../assets/animations");
/// The story that `raconteur new` makes, with its voice.
pub(crate) static FIRST_STORY: Dir<'_> =
    include_dir!("$CARGO_MANIFEST_DIR/../../assets/stories/hello-world");

/// Story template of `raconteur new --course`, with its voice and a picture drawn for it.
pub(crate) static FIRST_COURSE: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/course");

/// The largest file that is read, bytes.
const MAX_FILE_BYTES: u64 = 512 << 20;

/// The folder that `--assets` names.
static FOLDER: OnceLock<PathBuf> = OnceLock::new();

/// Gives this folder precedence over all others.
///
/// # Errors
/// Returns an error if the path is not a folder.
pub(crate) fn prepend_folder(folder: PathBuf) -> Result<()> {
    ensure!(
        folder.is_dir(),
        "--assets needs a folder, and {} is not one",
        folder.display()
    );
    FOLDER.get_or_init(|| folder);
    Ok(())
}

/// Returns the library folder on disk: the one given by `--assets`, otherwise `assets` next to the
/// program, or above cargo's `target` folder. It is never a folder near a story, which may come
/// from strangers, nor near the working folder, which may be the story's.
fn folder() -> Option<PathBuf> {
    if let Some(named) = FOLDER.get() {
        return Some(named.clone());
    }
    let program = std::env::current_exe().ok()?;
    let is_target = |folder: &&Path| folder.file_name().is_some_and(|name| name == "target");
    let built_in = program.ancestors().find(is_target).and_then(Path::parent);
    let near = [program.parent(), built_in].into_iter().flatten();
    near.map(|near| near.join("assets"))
        .find(|folder| folder.is_dir())
}

/// Makes the natural voice of the library available, if there is one.
pub(crate) fn offer_voices() {
    if let Some(folder) = folder() {
        add_folder(folder.join("voices/kokoro"));
    }
}

/// Returns the path of a library file on disk.
///
/// # Errors
/// Returns an error if the file does not exist, or its path leaves the library.
pub(crate) fn find(path: &str) -> Result<PathBuf> {
    let found = match folder() {
        Some(folder) => inside::find(&folder, path)?,
        None => None,
    };
    found.with_context(|| format!("no {path} in the library; name its folder with --assets"))
}

/// Reads a file of the library: from the folder given by `--assets`, otherwise from the program,
/// otherwise from next to the program.
///
/// # Errors
/// Returns an error if none of these contains the file, or it cannot be read.
pub(crate) fn read(path: &str) -> Result<Cow<'static, [u8]>> {
    let held = match path.split_once('/') {
        Some(("figures", file)) => FIGURES.get_file(file),
        Some(("animations", file)) => ANIMATIONS.get_file(file),
        _ => None,
    };
    let named = FOLDER.get().map(|_| find(path));
    match (named, held) {
        (Some(Ok(file)), _) => Ok(input::bytes(&file, MAX_FILE_BYTES)?.into()),
        (_, Some(held)) => Ok(held.contents().into()),
        (_, None) => Ok(input::bytes(&find(path)?, MAX_FILE_BYTES)?.into()),
    }
}

/// Returns the animations embedded in the program, by file name; each has a few kilobytes.
pub(crate) fn animations() -> impl Iterator<Item = (String, &'static [u8])> {
    ANIMATIONS.files().filter_map(|file| {
        let name = file
            .path()
            .to_str()
            .filter(|name| name.ends_with(".json"))?;
        Some((name.to_owned(), file.contents()))
    })
}

/// Returns the page built by `npm run build` next to the library.
pub(crate) fn built_page() -> Option<PathBuf> {
    let built = folder()?.parent()?.join("dist");
    built.is_dir().then_some(built)
}

/// Returns the names of all figures of the library: those embedded in the program and those in its
/// folder.
pub(crate) fn figure_names() -> BTreeSet<String> {
    let listed = folder().and_then(|folder| std::fs::read_dir(folder.join("figures")).ok());
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
        for file in ["figures/sofia.glb", "animations/stand.json"] {
            let (folder, name) = file.split_once('/').unwrap();
            let held = if folder == "figures" {
                &FIGURES
            } else {
                &ANIMATIONS
            };
            assert_eq!(
                &*read(file).unwrap(),
                held.get_file(name).unwrap().contents()
            );
        }
        for outside in ["../Cargo.toml", "/etc/passwd", "figures/../../Cargo.toml"] {
            assert!(read(outside).is_err(), "{outside}");
        }
        let told = read("figures/nobody.glb").unwrap_err().to_string();
        assert!(told.contains("--assets"), "{told}");
    }
}
