//! `raconteur import`.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result};
use clap::{Args, ValueEnum};
use raconteur_annotate::Anchoring;

use crate::{Outcome, report, terminal};

/// Convert a transcription of gestures into a story.
///
/// Reads annotation files of ANVIL with the tracks of GestuRA. Problems, and how missing parts were
/// filled in, are reported with their place in the file.
#[derive(Args)]
pub(crate) struct Import {
    /// Annotation file.
    file: PathBuf,
    /// The script to write. Without this, it goes to standard output.
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// What the times of gestures refer to. Without this, words if the output has a speech bundle
    /// next to it, else seconds.
    #[arg(long, value_enum)]
    anchor: Option<Anchor>,
}

/// What the times of gestures refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Anchor {
    /// Marks at the words on which the strokes fall.
    Words,
    /// Seconds of the recording.
    Seconds,
}

impl Import {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let told = |path: &Path| path.display().to_string();
        let bytes =
            fs::read(&self.file).with_context(|| format!("reading {}", told(&self.file)))?;
        let imported = raconteur_annotate::import(&bytes, self.anchoring());
        report::print(&told(&self.file), &imported.text, &imported.diagnostics)?;
        let eml = raconteur_eml::write(&imported.document);
        match &self.output {
            Some(path) => {
                fs::write(path, eml).with_context(|| format!("writing {}", told(path)))?;
            }
            None => terminal::out().write_all(eml.as_bytes())?,
        }
        Ok(report::outcome(&imported.diagnostics))
    }

    fn anchoring(&self) -> Anchoring {
        let has_bundle = || {
            let folder = self.output.as_deref().and_then(Path::parent);
            folder.is_some_and(|folder| folder.join("voice/speech.json").is_file())
        };
        match self.anchor {
            Some(Anchor::Words) => Anchoring::Words,
            Some(Anchor::Seconds) => Anchoring::Seconds,
            None if has_bundle() => Anchoring::Words,
            None => Anchoring::Seconds,
        }
    }
}
