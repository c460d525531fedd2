//! `raconteur figure fit`.

use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::PathBuf;

use anyhow::{Context as _, Result, bail};
use clap::Args;
use raconteur_sculpt::head::{Measure, fit_measures};
use raconteur_sculpt::model::{Model, Traits};
use raconteur_voice::files::{disk::replace, input};

use super::bind::{MAX_FILE_BYTES, MODEL};
use crate::{Outcome, terminal};

/// Fit a person's measures to the population's, or to given ones.
#[derive(Args)]
pub(super) struct Fit {
    /// The person's traits, in JSON.
    traits: PathBuf,
    /// Target measures: an object with names of measures (listed by `figure measure`), each with
    /// its standard deviations from the mean. Without it every measure is set to the mean for sex
    /// and age.
    #[arg(long)]
    measures: Option<PathBuf>,
    /// The body model's data, where `npm run model` puts it.
    #[arg(long, default_value = MODEL)]
    model: PathBuf,
    /// Output file for the person.
    #[arg(short, long)]
    output: PathBuf,
}

impl Fit {
    pub(super) fn run(&self) -> Result<Outcome> {
        let text = input::text(&self.traits, MAX_FILE_BYTES).context("the traits")?;
        let traits: Traits =
            serde_json::from_str(&text).with_context(|| self.traits.display().to_string())?;
        let wanted = self.targets()?;
        let (fitted, aims) = fit_measures(&Model::open(&self.model)?, &traits, &wanted)?;
        let mut json = terminal::json_lines(&fitted)?;
        json.push('\n');
        replace(&self.output, json.as_bytes())?;
        let mut out = terminal::out();
        writeln!(
            out,
            "{:26} {:>7} {:>7} {:>7}",
            "deviations", "before", "after", "wanted"
        )?;
        for aim in &aims {
            writeln!(
                out,
                "{:26} {:+7.2} {:+7.2} {:+7.2}",
                aim.measure.name(),
                aim.before,
                aim.after,
                aim.target
            )?;
        }
        writeln!(out, "{}", self.output.display())?;
        Ok(Outcome::Fine)
    }

    fn targets(&self) -> Result<BTreeMap<Measure, f64>> {
        let Some(path) = &self.measures else {
            return Ok(Measure::all().map(|m| (m, 0.0)).collect());
        };
        let text = input::text(path, MAX_FILE_BYTES).context("the measures")?;
        let named: BTreeMap<String, f64> =
            serde_json::from_str(&text).with_context(|| path.display().to_string())?;
        let mut wanted = BTreeMap::new();
        for (name, value) in named {
            let Some(measure) = Measure::from_name(&name) else {
                bail!("{}: there are no statistics of {name:?}", path.display());
            };
            if !(-4.0..=4.0).contains(&value) {
                bail!(
                    "{}: {name}: {value} is not within 4 deviations",
                    path.display()
                );
            }
            wanted.insert(measure, value);
        }
        Ok(wanted)
    }
}
