//! `raconteur new`.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};
use clap::Args;
use include_dir::{Dir, DirEntry};

use crate::assets::{FIRST_COURSE, FIRST_STORY};
use crate::{Outcome, terminal};

/// Make the folder of a new story, one that plays: a greeting with a gesture, and its voice.
#[derive(Args)]
pub(crate) struct New {
    /// The folder, which must not be there yet.
    name: PathBuf,
    /// Create a course instead: a story with one question of each kind.
    #[arg(long)]
    course: bool,
}

impl New {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let folder = &self.name;
        if folder.symlink_metadata().is_ok() {
            bail!("{} is there already", folder.display());
        }
        write(
            if self.course {
                &FIRST_COURSE
            } else {
                &FIRST_STORY
            },
            folder,
        )?;
        let shown = folder.display();
        writeln!(
            terminal::out(),
            "{shown}/story.eml is a story that plays. Look at it, change it, give it its voice:\n\
             \n  raconteur render {shown} --video {shown}.mp4\
             \n  raconteur check {shown}\
             \n  raconteur bake {shown}\n"
        )?;
        if self.course {
            writeln!(
                terminal::out(),
                "Pack it for a learning management system:\n\n  raconteur export {shown} --scorm12 --output {shown}.zip\n"
            )?;
        }
        Ok(Outcome::Fine)
    }
}

/// Writes the contents of an embedded folder.
fn write(from: &Dir<'_>, to: &Path) -> Result<()> {
    let told = |path: &Path| format!("cannot write {}", path.display());
    fs::create_dir_all(to).with_context(|| told(to))?;
    for entry in from.entries() {
        let name = entry.path().file_name().unwrap_or_default();
        let path = to.join(name);
        match entry {
            DirEntry::Dir(folder) => write(folder, &path)?,
            DirEntry::File(file) => {
                fs::write(&path, file.contents()).with_context(|| told(&path))?;
            }
        }
    }
    Ok(())
}
