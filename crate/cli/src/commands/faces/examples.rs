//! `raconteur faces examples`, and the making of examples for the other commands.

use std::io::Write as _;
use std::path::PathBuf;

use anyhow::{Context as _, Result};
use clap::Args;
use indicatif::ProgressBar;
use raconteur_sculpt::examples::{Example, Examples};
use raconteur_sculpt::model::Model;
use raconteur_sculpt::people;

use crate::commands::figure::bind::MODEL;
use crate::{Outcome, parallel, terminal};

/// Which heads are drawn.
#[derive(Args)]
pub(super) struct Crowd {
    /// How many heads.
    #[arg(long, default_value_t = 300)]
    count: u64,
    /// Another seed is another crowd.
    #[arg(long, default_value_t = 1)]
    pub(super) seed: u64,
    /// The body model's data, where `npm run model` puts it.
    #[arg(long, default_value = MODEL)]
    model: PathBuf,
}

impl Crowd {
    /// The heads in order, made on all processors, with a bar that shows how far it is.
    pub(super) fn make(&self) -> Result<Vec<Example>> {
        let model = Model::open(&self.model)?;
        let like = people::preset("sofia").context("a figure to start from")?;
        let crowd = Examples::new(&model, like, self.seed)?;
        let bar = ProgressBar::new(self.count);
        let made = parallel::each(0..self.count, |index| {
            let example = crowd.make(index)?;
            bar.inc(1);
            Ok(example)
        })?;
        bar.finish_and_clear();
        Ok(made)
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
            let traits = &example.traits;
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
