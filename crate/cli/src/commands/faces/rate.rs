//! `raconteur faces rate`: attributes that are impressions, learned from people's ratings (F&H 3.2.2).

mod learn;
#[cfg(test)]
mod sample;
mod sheet;

use std::path::Path;

use anyhow::{Context as _, Result};
use clap::{Args, Subcommand};
use raconteur_faces::{FaceModel, MOST_BYTES};
use raconteur_voice::files::input;

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
            // What draws pictures of faces goes in here.
            Action::Sheet(c) => c.run(None, &mut out),
            Action::Learn(c) => c.run(&mut out),
        }
    }
}

/// A pack that `faces learn` wrote.
fn read(pack: &Path) -> Result<FaceModel> {
    let bytes = input::bytes(pack, MOST_BYTES as u64).context("the pack")?;
    Ok(FaceModel::from_bytes(&bytes)?)
}
