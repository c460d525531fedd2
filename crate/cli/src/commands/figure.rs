//! `raconteur figure`.

use std::fs;
use std::io::{self, Write as _};
use std::path::PathBuf;

use anyhow::{Context as _, Result};
use clap::{Args, Subcommand};
use raconteur_player::body::generator::{self, people, write};

use crate::Outcome;

/// Make figures.
#[derive(Args)]
pub(crate) struct Figure {
    #[command(subcommand)]
    action: Action,
}

#[derive(Subcommand)]
enum Action {
    /// Generate a figure by name and write it as glTF binary.
    Build {
        /// Its name.
        name: String,
        /// Where to write it.
        #[arg(short, long)]
        output: PathBuf,
    },
}

impl Figure {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let mut out = io::stdout().lock();
        match &self.action {
            Action::Build { name, output } => {
                let params = people::preset(name)
                    .with_context(|| format!("there is no figure named {name}"))?;
                let figure = generator::build(&params).figure;
                let glb = write::to_glb(&figure);
                // Written beside and renamed, so that a failure leaves the old file whole.
                let part = output.with_extension("glb.part");
                fs::write(&part, &glb)
                    .and_then(|()| fs::rename(&part, output))
                    .with_context(|| format!("cannot write {}", output.display()))?;
                let triangles: usize = figure.meshes.iter().map(|m| m.indices.len() / 3).sum();
                writeln!(
                    out,
                    "{}: {} bytes, {} meshes, {triangles} triangles, {} joints, {} morphs",
                    output.display(),
                    glb.len(),
                    figure.meshes.len(),
                    figure.skeleton.joints().len(),
                    figure.morph_names.len(),
                )?;
                Ok(Outcome::Fine)
            }
        }
    }
}
