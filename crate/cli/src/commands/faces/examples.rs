//! `raconteur faces examples`, and the generation of examples for the other commands.

use std::io::Write as _;
use std::path::PathBuf;

use anyhow::{Context as _, Result};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use raconteur_sculpt::examples::{Example, Examples};
use raconteur_sculpt::model::Model;
use raconteur_sculpt::{FigureParams, people};

use crate::commands::figure::bind::MODEL;
use crate::{Outcome, parallel, terminal};

/// Selection of random heads: their number, seed and body model.
#[derive(Args)]
pub(super) struct Crowd {
    /// Number of heads.
    #[arg(long, default_value_t = 1000)]
    count: u64,
    /// Another seed is another crowd.
    #[arg(long, default_value_t = 1)]
    pub(super) seed: u64,
    /// The body model's data, where `npm run model` puts it.
    #[arg(long, default_value = MODEL)]
    model: PathBuf,
}

impl Crowd {
    /// Returns the heads in order, generated on all processors, with a progress bar.
    pub(super) fn make(&self) -> Result<Vec<Example>> {
        let model = self.model()?;
        let crowd = Examples::new(&model, Self::like()?, self.seed)?;
        let drafts = self.map_with_progress("people", |index| Ok(crowd.draft(index)?))?;
        let drafts = crowd.fitted_to_population(drafts);
        self.map_with_progress("heads", |index| {
            let draft = drafts.get(index as usize).context("a person")?;
            Ok(crowd.make(draft.clone()))
        })
    }

    /// Maps numbers in parallel with a progress bar.
    fn map_with_progress<T: Send>(
        &self,
        what: &'static str,
        make: impl Fn(u64) -> Result<T> + Sync,
    ) -> Result<Vec<T>> {
        let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}, {eta} left")?;
        let bar = ProgressBar::new(self.count)
            .with_style(style)
            .with_message(what);
        let made = parallel::map(0..self.count, |index| {
            let one = make(index)?;
            bar.inc(1);
            Ok(one)
        })?;
        bar.finish_and_clear();
        Ok(made)
    }

    /// Opens the body model from which the heads are generated.
    pub(super) fn model(&self) -> Result<Model> {
        Ok(Model::open(&self.model)?)
    }

    /// Returns the base figure.
    pub(super) fn like() -> Result<FigureParams> {
        people::preset("sofia").context("a figure to start from")
    }
}

/// List the heads that a face space is learned from, with their measures, as a table.
#[derive(Args)]
pub(super) struct List {
    #[command(flatten)]
    crowd: Crowd,
}

impl List {
    pub(super) fn run(&self) -> Result<Outcome> {
        let all = self.crowd.make()?;
        let mut out = terminal::out();
        let names = all
            .first()
            .map(|e| e.measures.as_slice())
            .unwrap_or_default();
        write!(out, "index\tsex\tage_years\teuropean\tasian\tafrican")?;
        for (name, _) in names {
            write!(out, "\t{name}_mm")?;
        }
        writeln!(out)?;
        for (index, example) in all.iter().enumerate() {
            let traits = &example.draft.traits;
            let [european, asian, african] = example.ancestry();
            write!(
                out,
                "{index}\t{:.2}\t{:.0}\t{european:.2}\t{asian:.2}\t{african:.2}",
                traits.sex, traits.age_years
            )?;
            for (_, mm) in &example.measures {
                write!(out, "\t{mm:.1}")?;
            }
            writeln!(out)?;
        }
        Ok(Outcome::Fine)
    }
}
