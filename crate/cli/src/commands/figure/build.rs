//! `raconteur figure build`.

use std::io::Write as _;
use std::path::PathBuf;
use std::time::Duration;

use anyhow::{Result, bail};
use clap::Args;
use indicatif::ProgressBar;
use raconteur_body::write;

use super::{bind, params};
use crate::{Outcome, terminal};
use raconteur_voice::files::disk::replace;

/// Generate a figure and write it as glTF binary.
#[derive(Args)]
pub(super) struct Build {
    /// The name of a figure of the library.
    #[arg(required_unless_present = "params", conflicts_with = "params")]
    name: Option<String>,
    /// A description in JSON; see `figure params`.
    #[arg(long)]
    params: Option<PathBuf>,
    /// The body model's data, where `npm run model` puts it; read for a head that is in no figure of the
    /// library.
    #[arg(long, default_value = bind::MODEL)]
    model: PathBuf,
    /// Output file.
    #[arg(short, long)]
    output: PathBuf,
}

impl Build {
    pub(super) fn run(&self) -> Result<Outcome> {
        let params = match (&self.name, &self.params) {
            (Some(name), _) => params::preset(name)?,
            (None, Some(path)) => params::read(path, &self.model)?,
            (None, None) => bail!("a name or --params is required"),
        };
        let bar = ProgressBar::new_spinner().with_message(format!("building {}", params.name));
        bar.enable_steady_tick(Duration::from_millis(120));
        let built = raconteur_sculpt::build(&params);
        let figure = &built.figure;
        let glb = write::to_packed_glb(figure, &built.annotations);
        bar.finish_and_clear();
        replace(&self.output, &glb)?;
        let triangles: usize = figure.meshes.iter().map(|m| m.indices.len() / 3).sum();
        writeln!(
            terminal::out(),
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
