//! `raconteur figure register`.

use std::io::Write as _;
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use raconteur_sculpt::head::register;
use raconteur_sculpt::model::Model;
use raconteur_voice::files::disk::replace;

use super::bind::MODEL;
use crate::{Outcome, terminal};

/// Register the generated head on the body model's again, as input of the generator.
#[derive(Args)]
pub(super) struct Register {
    /// The body model's data, where `npm run model` puts it.
    #[arg(long, default_value = MODEL)]
    model: PathBuf,
    /// Output table, such as `crate/sculpt/src/head/binding.tsv`.
    #[arg(short, long)]
    output: PathBuf,
}

impl Register {
    pub(super) fn run(&self) -> Result<Outcome> {
        let found = register(&Model::open(&self.model)?)?;
        replace(&self.output, found.table.as_bytes())?;
        let [mean, most] = found.moved_mm;
        writeln!(
            terminal::out(),
            "{}: {} places found, {} kept, moved by {mean:.2} mm in the mean, {most:.2} mm at most",
            self.output.display(),
            found.found_points,
            found.used_points
        )?;
        Ok(Outcome::Fine)
    }
}
