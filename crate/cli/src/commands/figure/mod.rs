//! `raconteur figure`.

mod build;
mod file;
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
    Build(build::Build),
    Sheet(sheet::Sheet),
}

impl Figure {
    pub(crate) fn run(&self) -> Result<Outcome> {
        match &self.action {
            Action::Build(c) => c.run(),
            Action::Sheet(c) => c.run(),
        }
    }
}
