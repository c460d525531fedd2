//! `raconteur faces rate`: attributes for impressions, learned from people's ratings (F&H 3.2.2).

mod learn;
#[cfg(test)]
mod sample;
mod sheet;

use std::path::Path;

use anyhow::Result;
use clap::{Args, Subcommand};
use raconteur_faces::FaceModel;

use crate::{Outcome, terminal};

/// Have faces rated by people, and learn attributes from the ratings.
#[derive(Args)]
pub(super) struct Rate {
    #[command(subcommand)]
    action: Action,
}

#[derive(Subcommand)]
enum Action {
    Sheet(sheet::Sheet),
    Learn(learn::Learn),
}

impl Rate {
    pub(super) fn run(&self) -> Result<Outcome> {
        let mut out = terminal::out();
        match &self.action {
            Action::Sheet(c) => c.run(&super::sheet::for_raters, &mut out),
            Action::Learn(c) => c.run(&mut out),
        }
    }
}

/// Reads a pack written by `faces learn`.
fn read(pack: &Path) -> Result<FaceModel> {
    super::pack::read(pack)
}
