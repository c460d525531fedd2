//! `raconteur figure`.

pub(super) mod bind;
mod build;
mod crowd;
mod export;
mod fit;
mod hair;
mod measure;
mod obj;
mod params;
mod register;
mod rig;
mod sheet;

use anyhow::Result;
use clap::{Args, Subcommand};

use crate::Outcome;

/// Make and inspect figures.
#[derive(Args)]
pub(crate) struct Figure {
    #[command(subcommand)]
    action: Action,
}

#[derive(Subcommand)]
enum Action {
    Bind(bind::Bind),
    Build(build::Build),
    Crowd(crowd::Crowd),
    Params(params::Params),
    Register(register::Register),
    Rig(rig::Rig),
    Sheet(sheet::Sheet),
    Export(export::Export),
    Fit(fit::Fit),
    Hair(hair::Hair),
    Measure(measure::Measure),
}

impl Figure {
    pub(crate) fn run(&self) -> Result<Outcome> {
        match &self.action {
            Action::Bind(c) => c.run(),
            Action::Build(c) => c.run(),
            Action::Crowd(c) => c.run(),
            Action::Params(c) => c.run(),
            Action::Register(c) => c.run(),
            Action::Rig(c) => c.run(),
            Action::Sheet(c) => c.run(),
            Action::Export(c) => c.run(),
            Action::Fit(c) => c.run(),
            Action::Hair(c) => c.run(),
            Action::Measure(c) => c.run(),
        }
    }
}
