//! `raconteur figure build`.

use std::io::{self, Write as _};
use std::path::PathBuf;

use anyhow::{Context as _, Result};
use clap::Args;
use raconteur_player::body::generator::{self, people, write};

use super::file::replace;
use crate::Outcome;

/// Generate a figure by name and write it as glTF binary.
#[derive(Args)]
pub(super) struct Build {
    /// Its name.
    name: String,
    /// Where to write it.
    #[arg(short, long)]
    output: PathBuf,
}

impl Build {
    pub(super) fn run(&self) -> Result<Outcome> {
        let params = people::preset(&self.name)
            .with_context(|| format!("there is no figure named {}", self.name))?;
        let built = generator::build(&params);
        let figure = &built.figure;
        let glb = write::to_annotated_glb(figure, &built.annotations);
        replace(&self.output, &glb)?;
        let triangles: usize = figure.meshes.iter().map(|m| m.indices.len() / 3).sum();
        writeln!(
            io::stdout().lock(),
            "{}: {} bytes, {} meshes, {triangles} triangles, {} joints, {} morphs",
            self.output.display(),
            glb.len(),
            figure.meshes.len(),
            figure.skeleton.joints().len(),
            figure.morph_names.len(),
        )?;
        Ok(Outcome::Fine)
    }
}
