//! `raconteur figure rig`.

use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::PathBuf;

use anyhow::{Context as _, Result, bail};
use clap::Args;
use raconteur_base::DVec3;
use raconteur_body::write;
use raconteur_sculpt::rigging::{Landmarks, rig};
use raconteur_sculpt::scan::Scan;
use raconteur_voice::files::{disk::replace, input};
use serde::Deserialize;

use super::bind::MAX_FILE_BYTES;
use super::params;
use crate::{Outcome, terminal};

/// The largest mesh that is read, bytes.
const MAX_MESH_BYTES: u64 = 256 << 20;

/// Rig your own head with the generated muscles, tissue, jaw, mouth and eyes.
#[derive(Args)]
pub(super) struct Rig {
    /// The head: a Wavefront OBJ of its skin, lids and lips open lines, without eyes and teeth.
    mesh: PathBuf,
    /// Landmarks: an object of names, each with a vertex, counted from 1 as in the mesh, or with a
    /// position [x, y, z].
    #[arg(long)]
    landmarks: PathBuf,
    /// Figure of the library that provides skeleton, mouth and eyes.
    #[arg(long, default_value = crate::story::USUAL_FIGURE)]
    like: String,
    /// Output file for the figure.
    #[arg(short, long)]
    output: PathBuf,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum NamedFile {
    Vertex(usize),
    Place([f64; 3]),
}

impl Rig {
    pub(super) fn run(&self) -> Result<Outcome> {
        let mesh = input::text(&self.mesh, MAX_MESH_BYTES).context("the mesh")?;
        let scan = Scan::read(&mesh).with_context(|| self.mesh.display().to_string())?;
        let landmarks = self.landmarks(&scan)?;
        let mut params = params::preset(&self.like)?;
        if let Some(stem) = self.output.file_stem() {
            params.name = stem.to_string_lossy().into_owned();
        }
        let built = rig(&scan, &landmarks, &params)
            .with_context(|| self.landmarks.display().to_string())?;
        replace(
            &self.output,
            &write::to_packed_glb(&built.figure, &built.annotations),
        )?;
        let bound = built
            .figure
            .meshes
            .iter()
            .filter_map(|m| m.binding.as_ref());
        let count: usize = bound.map(|b| b.vertices.len()).sum();
        writeln!(
            terminal::out(),
            "{}: {} landmarks, {count} vertices follow the tissue",
            self.output.display(),
            landmarks.len(),
        )?;
        Ok(Outcome::Fine)
    }

    fn landmarks(&self, scan: &Scan) -> Result<Landmarks> {
        let path = self.landmarks.display();
        let text = input::text(&self.landmarks, MAX_FILE_BYTES).context("the landmarks")?;
        let named: BTreeMap<String, NamedFile> =
            serde_json::from_str(&text).with_context(|| path.to_string())?;
        let mut all = Landmarks::new();
        for (name, place) in named {
            let at = match place {
                NamedFile::Place([x, y, z]) => Some(DVec3::new(x, y, z)),
                NamedFile::Vertex(v) => v.checked_sub(1).and_then(|i| scan.points.get(i)).copied(),
            };
            let Some(at) = at.filter(|p| p.is_finite()) else {
                bail!("{path}: {name} is not a vertex of the mesh");
            };
            all.insert(name, at);
        }
        Ok(all)
    }
}
