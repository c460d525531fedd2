//! `raconteur faces examples`, and the making of examples for the other commands.

use std::io::Write as _;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use anyhow::{Context as _, Result};
use clap::Args;
use indicatif::ProgressBar;
use raconteur_sculpt::examples::{Example, Examples};
use raconteur_sculpt::model::Model;
use raconteur_sculpt::people;

use crate::commands::figure::bind::MODEL;
use crate::{Outcome, terminal};

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
        let next = AtomicU64::new(0);
        let made: Mutex<Vec<(u64, Example)>> = Mutex::default();
        let bar = ProgressBar::new(self.count);
        let work = || -> Result<()> {
            loop {
                let index = next.fetch_add(1, Ordering::Relaxed);
                if index >= self.count {
                    return Ok(());
                }
                let example = crowd.make(index)?;
                bar.inc(1);
                let mut made = made.lock().unwrap_or_else(PoisonError::into_inner);
                made.push((index, example));
            }
        };
        thread::scope(|scope| {
            let threads = thread::available_parallelism().map_or(1, usize::from);
            let started: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
            started.into_iter().try_for_each(|t| {
                t.join()
                    .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
            })
        })?;
        bar.finish_and_clear();
        let mut made = made.into_inner().unwrap_or_else(PoisonError::into_inner);
        made.sort_by_key(|(index, _)| *index);
        Ok(made.into_iter().map(|(_, example)| example).collect())
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
