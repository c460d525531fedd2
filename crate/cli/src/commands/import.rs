//! `raconteur import`.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result};
use clap::{Args, ValueEnum};
use raconteur_annotate::elan::Mapping;
use raconteur_annotate::{Anchoring, anvil};
use raconteur_eml::{Diagnostic, decode};
use raconteur_player::Script;
use raconteur_voice::files::{disk, input};

use crate::story::MAX_BUNDLE_BYTES;
use crate::{Outcome, report, terminal};

/// Maximum length of a file, bytes.
pub(super) const MAX_BYTES: u64 = 16 << 20;

/// Convert a transcription of gestures into a story.
///
/// Reads annotation files of ANVIL with the tracks of GestuRA, and of ELAN. Problems, and how
/// missing parts were filled in, are reported with their place in the file.
#[derive(Args)]
pub(crate) struct Import {
    /// Annotation file.
    file: PathBuf,
    /// The script to write, or, with the ending .anvil, the annotation. Without this, the script
    /// goes to standard output.
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Reference of the times of gestures. Without this, words if the output has a speech bundle
    /// next to it, else seconds.
    #[arg(long, value_enum)]
    anchor: Option<Anchor>,
    /// File that maps the tiers of ELAN to the tracks of GestuRA. Without this, they are guessed.
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
}

/// Reference of the times of gestures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Anchor {
    /// Marks at the words on which the strokes fall.
    Words,
    /// Seconds of the recording.
    Seconds,
}

impl Import {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let bytes = input::bytes(&self.file, MAX_BYTES).context("the annotation")?;
        let (mapping, unread) = mapping(self.map.as_deref())?;
        let mapping = mapping.as_ref();
        let is_annotation = |path: &PathBuf| path.extension().is_some_and(|e| e == "anvil");
        let (text, diagnostics, written) = if self.output.as_ref().is_some_and(is_annotation) {
            let read = raconteur_annotate::read_transcription(&bytes, mapping);
            let annotation = anvil::from_transcription(&read.transcription);
            (read.text, read.diagnostics, anvil::write(&annotation))
        } else {
            let bundle = self.bundle()?;
            let anchoring = self.anchoring(bundle.is_some());
            let mut imported = raconteur_annotate::import(&bytes, mapping, anchoring);
            let mut eml = raconteur_eml::write(&imported.document);
            if let Some(bundle) = bundle {
                let voices = Script::read(&eml, Some(&bundle)).timeline.voices;
                let baked = |clause| voices.get(&clause).filter(|v| !v.estimated).cloned();
                raconteur_annotate::fit_pauses(&mut imported.document, baked);
                eml = raconteur_eml::write(&imported.document);
            }
            (imported.text, imported.diagnostics, eml)
        };
        report::print(&self.file.display().to_string(), &text, &diagnostics)?;
        match &self.output {
            Some(path) => disk::replace(path, written.as_bytes())?,
            None => terminal::out().write_all(written.as_bytes())?,
        }
        let worst = if unread {
            Outcome::Errors
        } else {
            Outcome::Fine
        };
        Ok(match report::outcome(&diagnostics) {
            Outcome::Fine => worst,
            errors @ Outcome::Errors => errors,
        })
    }

    /// Returns the speech bundle next to the output, if there is one.
    fn bundle(&self) -> Result<Option<Vec<u8>>> {
        let folder = self.output.as_deref().and_then(Path::parent);
        let path = folder.map(|folder| folder.join("voice/speech.json"));
        let path = path.filter(|path| path.is_file());
        let read = path.map(|path| input::bytes(&path, MAX_BUNDLE_BYTES));
        read.transpose().context("the speech bundle")
    }

    fn anchoring(&self, has_bundle: bool) -> Anchoring {
        match self.anchor {
            Some(Anchor::Words) => Anchoring::Words,
            Some(Anchor::Seconds) => Anchoring::Seconds,
            None if has_bundle => Anchoring::Words,
            None => Anchoring::Seconds,
        }
    }
}

/// Reads a mapping file, and reports its problems. The flag is true if it has any.
pub(crate) fn mapping(path: Option<&Path>) -> Result<(Option<Mapping>, bool)> {
    let Some(path) = path else {
        return Ok((None, false));
    };
    let decoded = decode(input::bytes(path, MAX_BYTES).context("the mapping")?);
    let mut problems: Vec<Diagnostic> = decoded.problem.into_iter().collect();
    let mapping = Mapping::read(&decoded.text, &mut problems);
    report::print(&path.display().to_string(), &decoded.text, &problems)?;
    Ok((Some(mapping), !problems.is_empty()))
}
