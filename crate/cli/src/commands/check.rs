//! `raconteur check`.

use std::io::{self, Write as _};
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use crate::report;
use crate::story::StoryFiles;
use crate::{Format, Outcome};

/// Report problems in stories.
#[derive(Args)]
pub(crate) struct Check {
    /// Scripts, or folders that hold a story.eml.
    #[arg(required = true)]
    files: Vec<PathBuf>,
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
            let script = files.script();
            let name = files.script.display().to_string();
            if report::outcome(&script.diagnostics) == Outcome::Errors {
                worst = Outcome::Errors;
            }
            match self.format {
                Format::Text => report::print(&name, &files.text, &script.diagnostics)?,
                Format::Json => {
                    for entry in report::entries(&name, &files.text, &script.diagnostics) {
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
}
