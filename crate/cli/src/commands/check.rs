//! `raconteur check`.

use std::io::{self, Write as _};
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use raconteur_player::eml::Diagnostic;
use raconteur_player::stage::Shot;

use crate::report;
use crate::story::StoryFiles;
use crate::{Format, Outcome};

/// Report problems in stories.
#[derive(Args)]
pub(crate) struct Check {
    /// Scripts, or folders that hold a story.eml.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// The figure whose reach is checked: a name, or the path of a .glb file. Without this,
    /// the one that the story chooses, else sofia, where they are found.
    #[arg(long)]
    figure: Option<String>,
    /// How to report.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

impl Check {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let mut out = io::stdout().lock();
        let mut worst = Outcome::Fine;
        let mut json = Vec::new();
        for path in &self.files {
            let files = StoryFiles::read(path)?;
            let diagnostics = self.diagnostics(&files)?;
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
            writeln!(out, "{}", serde_json::to_string_pretty(&json)?)?;
        }
        Ok(worst)
    }

    fn diagnostics(&self, files: &StoryFiles) -> Result<Vec<Diagnostic>> {
        match files.player(self.figure.as_deref(), Shot::Medium) {
            Ok(loaded) => Ok(loaded.diagnostics),
            Err(error) if self.figure.is_some() => Err(error),
            Err(_) => {
                eprintln!(
                    "raconteur: no figure at hand, so nobody's reach is checked; name one with --figure"
                );
                Ok(files.script().diagnostics)
            }
        }
    }
}
