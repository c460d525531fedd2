//! `raconteur check`.

use std::io::Write as _;
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use raconteur_eml::{Diagnostic, Span, thinned};
use raconteur_stage::Shot;

use crate::report;
use crate::story::StoryFiles;
use crate::{Format, Outcome, terminal};
use raconteur_voice::bake::{SoundFile, Store};
use raconteur_voice::files::disk::SystemDisk;
use raconteur_voice::files::inside;

/// Report problems in stories.
#[derive(Args)]
pub(crate) struct Check {
    /// Scripts, or folders that contain a story.eml.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// The figure whose reach is checked: a name, or the path of a .glb file. Without this,
    /// the one that the story chooses, else sofia.
    #[arg(long)]
    figure: Option<String>,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

impl Check {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let mut out = terminal::out();
        let mut worst = Outcome::Fine;
        let mut json = Vec::new();
        for path in &self.files {
            let files = StoryFiles::read(path)?;
            let mut diagnostics = self.diagnostics(&files)?;
            diagnostics.extend(wrong_sounds(&files));
            let diagnostics = thinned(diagnostics);
            let name = files.script.display().to_string();
            if report::outcome(&diagnostics) == Outcome::Errors {
                worst = Outcome::Errors;
            }
            match self.format {
                Format::Text => report::print(&name, &files.text, &diagnostics)?,
                Format::Json => {
                    for entry in report::entries(&name, &files.text, &diagnostics) {
                        json.push(serde_json::to_value(entry)?);
                    }
                }
            }
        }
        if self.format == Format::Json {
            writeln!(out, "{}", terminal::json_lines(&json)?)?;
        }
        Ok(worst)
    }

    fn diagnostics(&self, files: &StoryFiles) -> Result<Vec<Diagnostic>> {
        Ok(files
            .player(self.figure.as_deref(), Shot::Storyteller)?
            .diagnostics)
    }
}

/// Returns diagnostics for spoken utterances of the bundle whose audio differs from the baked one.
fn wrong_sounds(files: &StoryFiles) -> Vec<Diagnostic> {
    let (voice, document) = (files.voice(), files.script().document);
    if let Err(error) = inside::check_folder(files.folder(), &voice) {
        let hint = "put the folder itself there";
        let message = format!("the voice is not read: {error:#}");
        return vec![Diagnostic::error("voice::outside", Span::new(0, 0), message).hint(hint)];
    }
    let store = Store::open(voice, &SystemDisk);
    let said = raconteur_voice::speech_requests(&document);
    let wrong = said
        .iter()
        .filter(|said| store.sound(said.key) == Some(SoundFile::Wrong));
    wrong
        .map(|said| {
            Diagnostic::error(
                "voice::wrong-sound",
                said.span,
                "the audio of this is missing or differs from the bundle's",
            )
            .hint("bake the story again: raconteur bake")
        })
        .collect()
}
