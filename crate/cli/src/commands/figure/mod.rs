//! `raconteur figure`.

mod bind;
mod build;
mod export;
mod measure;
mod obj;
mod params;
mod sheet;

use anyhow::Result;
use clap::{Args, Subcommand};

use crate::Outcome;

/// Make figures and look at them.
#[derive(Args)]
pub(crate) struct Figure {
    #[command(subcommand)]
    action: Action,
}

#[derive(Subcommand)]
enum Action {
    Bind(bind::Bind),
    Build(build::Build),
    Params(params::Params),
    Sheet(sheet::Sheet),
    Export(export::Export),
    Measure(measure::Measure),
}

impl Figure {
    pub(crate) fn run(&self) -> Result<Outcome> {
        match &self.action {
            Action::Bind(c) => c.run(),
            Action::Build(c) => c.run(),
            Action::Params(c) => c.run(),
            Action::Sheet(c) => c.run(),
            Action::Export(c) => c.run(),
            Action::Measure(c) => c.run(),
        }
    }
}
