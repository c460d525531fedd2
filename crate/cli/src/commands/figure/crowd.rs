//! `raconteur figure crowd`.

use std::io::Write as _;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result};
use clap::Args;
use raconteur_sculpt::head::Binding;
use raconteur_sculpt::model::{Detail, Model, Traits};
use raconteur_sculpt::{build_face, examples, people};

use super::bind::MODEL;
use crate::commands::story_check::{self, FaceReport, StoryCheck};
use crate::story::StoryFiles;
use crate::{Outcome, parallel, terminal};

/// Let random people from the body model perform a story, and report visible faults of their faces.
#[derive(Args)]
pub(super) struct Crowd {
    /// Script, or folder that contains a story.eml.
    story: PathBuf,
    /// Number of people.
    #[arg(long, default_value_t = 20)]
    count: u64,
    /// Number of the first of them.
    #[arg(long, default_value_t = 0)]
    first: u64,
    /// Another seed is another crowd.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The body model's data, where `npm run model` puts it.
    #[arg(long, default_value = MODEL)]
    model: PathBuf,
}

/// Data shared by all people.
struct CrowdStage {
    model: Model,
    details: Vec<Detail>,
    binding: Binding,
    text: String,
    bundle: Option<Vec<u8>>,
    seed: u64,
}

/// Findings about one person.
struct CrowdFinding {
    told: FaceReport,
    evaluation: Duration,
}

impl Crowd {
    pub(super) fn run(&self) -> Result<Outcome> {
        let model = Model::open(&self.model)?;
        let files = StoryFiles::read(&self.story)?;
        let stage = CrowdStage {
            details: model.details()?,
            binding: Binding::new(model.faces()),
            model,
            text: files.text.clone(),
            bundle: files.bundle(),
            seed: self.seed,
        };
        let all = parallel::map(self.first..self.first + self.count, |index| {
            let found = stage.examine(index)?;
            let mut out = terminal::out();
            for wrong in &found.told.wrong {
                writeln!(out, "{wrong}")?;
            }
            Ok(found)
        })?;
        summary(&all)?;
        let is_fine = all.iter().all(|found| found.told.wrong.is_empty());
        Ok(if is_fine {
            Outcome::Fine
        } else {
            Outcome::Errors
        })
    }
}

impl CrowdStage {
    fn examine(&self, index: u64) -> Result<CrowdFinding> {
        let traits = Traits::random(&self.details, self.seed, index);
        let shape = self.model.shape(&traits)?;
        // Again, with its targets read.
        let began = Instant::now();
        let bound = self.binding.bind(&self.model.shape(&traits)?);
        let evaluation = began.elapsed();
        drop(shape);
        let a = traits.ancestry;
        let whole = (a.african + a.asian + a.european) / 100.0;
        let who = format!(
            "{index}: {} of {:.0}, African {:.0} %, Asian {:.0} %, European {:.0} %",
            if traits.sex > 0.5 { "woman" } else { "man" },
            traits.age_years,
            a.african / whole,
            a.asian / whole,
            a.european / whole,
        );
        let like = people::preset("sofia").context("a figure to start from")?;
        let built = build_face(&examples::params_of(&like, traits, bound));
        let told = StoryCheck {
            text: &self.text,
            bundle: self.bundle.as_deref(),
        }
        .by(&who, built.figure, &built.annotations);
        Ok(CrowdFinding { told, evaluation })
    }
}

fn summary(all: &[CrowdFinding]) -> Result<()> {
    let told: Vec<&FaceReport> = all.iter().map(|found| &found.told).collect();
    story_check::summary(&told)?;
    let total: Duration = all.iter().map(|f| f.evaluation).sum();
    let mean = total.as_secs_f64() * 1e3 / all.len().max(1) as f64;
    writeln!(terminal::out(), "  evaluation of a head, mean {mean:.1} ms")?;
    Ok(())
}
