//! `raconteur faces`: the morphable model of faces (F&H 3.2).

mod check;
mod convert;
mod crossing;
mod edits;
mod examples;
mod fair;
mod learn;
mod make;
mod pack;
mod put_on;
mod rate;
mod sheet;

use anyhow::Result;
use clap::{Args, Subcommand};

use crate::Outcome;

/// Learn faces from examples, and make new ones.
#[derive(Args)]
pub(crate) struct Faces {
    #[command(subcommand)]
    action: Action,
}

#[derive(Subcommand)]
enum Action {
    Check(check::Check),
    Convert(convert::Convert),
    Examples(examples::List),
    Learn(learn::Learn),
    Make(make::Make),
    Rate(rate::Rate),
    Sheet(sheet::Sheet),
}

impl Faces {
    pub(crate) fn run(&self) -> Result<Outcome> {
        match &self.action {
            Action::Check(c) => c.run(),
            Action::Convert(c) => c.run(),
            Action::Examples(c) => c.run(),
            Action::Learn(c) => c.run(),
            Action::Make(c) => c.run(),
            Action::Rate(c) => c.run(),
            Action::Sheet(c) => c.run(),
        }
    }
}
