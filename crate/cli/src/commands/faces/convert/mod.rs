//! `raconteur faces convert`: third-party morphable models, each on its own topology.

mod arrays;
mod ict;
mod meshes;
mod obj;
#[cfg(test)]
mod tests;

use std::fs;
use std::io::Write as _;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, ensure};
use clap::Args;
use raconteur_faces::{AgeModel, DependentNumbers, FaceModel, FaceSpace, MAX_BYTES, Segments};
use raconteur_voice::files::disk::replace;

use crate::{Outcome, terminal};

/// Convert a third-party morphable model to a pack, on that model's own vertices.
#[derive(Args)]
pub(super) struct Convert {
    /// The model: ICT-FaceKit's folder `FaceXModel`; or a folder with `mean.npy`, `modes.npy` and
    /// `deviations.npy`, and `mesh.obj` for its triangles; or a folder of meshes (`*.obj`) that
    /// correspond.
    folder: PathBuf,
    /// The pack.
    #[arg(short, long)]
    output: PathBuf,
    /// Maximum number of modes; all by default.
    #[arg(long)]
    modes: Option<NonZeroUsize>,
}

/// A model has no more vertices.
const MAX_VERTICES: usize = 200_000;
/// A model has no more modes, nor examples.
const MAX_MODES: usize = 400;
/// A file of a model is not larger, bytes.
const MAX_FILE_BYTES: u64 = 512 << 20;
/// Maximum distance of a coordinate from 0, in the units of the file, for sufficient single
/// precision.
const MAX_COORDINATE: f64 = 1e6;
/// Explained share of the variance below which a warning is shown.
const EXPLAINED: f64 = 0.99;

impl Convert {
    pub(super) fn run(&self) -> Result<Outcome> {
        let found = read(&self.folder)?;
        let kind = found.kind;
        let (model, explained) = found.model(self.modes)?;
        let bytes = pack(&model, MAX_BYTES)?;
        replace(&self.output, &bytes)?;
        writeln!(
            terminal::out(),
            "{}: {kind}, {} vertices, {} triangles, {} modes that explain {:.2} % of the variance, \
             {} examples, {} bytes",
            self.output.display(),
            model.shape.length() / 3,
            model.triangles.len(),
            model.shape.dimensions(),
            100.0 * explained,
            model.examples.len(),
            bytes.len()
        )?;
        if explained < EXPLAINED {
            terminal::report(format_args!(
                "warning: the modes that are kept explain {:.2} % of the variance; `--modes` keeps more",
                100.0 * explained
            ));
        }
        Ok(Outcome::Fine)
    }
}

/// Contents of a model folder, in metres.
#[derive(Debug)]
struct SourceModel {
    /// Type of the model.
    kind: &'static str,
    /// Shape space of the model with all of its modes.
    shape: FaceSpace,
    /// The faces that it was learned from, where it was.
    examples: Vec<Vec<f64>>,
    /// Triangles; empty if the folder has none.
    triangles: Vec<[u32; 3]>,
}

impl SourceModel {
    /// Returns the model with its first modes, and the share of the variance that they explain.
    fn model(self, most: Option<NonZeroUsize>) -> Result<(FaceModel, f64)> {
        let all = variance(&self.shape);
        // A pack has no more.
        let most = most.map_or(raconteur_faces::MAX_MODES, NonZeroUsize::get);
        let shape = self.shape.truncated(most.min(raconteur_faces::MAX_MODES));
        let explained = variance(&shape) / all;
        let own = self.examples.iter().map(|face| shape.coefficients(face));
        let model = FaceModel {
            reference: Vec::new(),
            life: AgeModel::default(),
            examples: own.collect::<Result<_, _>>()?,
            // Neither a cage nor organs of ours follow it.
            cage: DependentNumbers::default(),
            organs: DependentNumbers::default(),
            people: Vec::new(),
            landmarks: Vec::new(),
            texture: None,
            triangles: self.triangles,
            segments: Segments::default(),
            attributes: Vec::new(),
            shape,
        };
        Ok((model, explained))
    }
}

/// Returns the total variance of a space over all of its modes.
fn variance(shape: &FaceSpace) -> f64 {
    shape.deviations().iter().map(|d| d * d).sum()
}

/// Reads a folder of any of the kinds.
fn read(folder: &Path) -> Result<SourceModel> {
    let holds = |name: &&str| folder.join(name).exists();
    let found = if ict::NAMES.iter().any(holds) {
        ict::read(folder)?
    } else if arrays::NAMES.iter().any(holds) {
        arrays::read(folder)?
    } else {
        meshes::read(folder)?
    };
    ensure!(
        found.shape.dimensions() > 0,
        "{}: its faces do not differ",
        folder.display()
    );
    Ok(found)
}

/// Returns the pack of a model, verified by reading it back, with at most `most` bytes.
fn pack(model: &FaceModel, most: usize) -> Result<Vec<u8>> {
    let bytes = model.to_bytes()?;
    ensure!(
        bytes.len() <= most,
        "the pack would have {} bytes, and at most {most} are read; `--modes` keeps fewer modes",
        bytes.len()
    );
    FaceModel::from_bytes(&bytes).context("the pack could not be read again")?;
    Ok(bytes)
}

/// Returns the files in a folder, sorted by name.
fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let named = || format!("cannot read {}", folder.display());
    let entries = fs::read_dir(folder).with_context(named)?;
    let paths = entries.map(|entry| entry.map(|e| e.path()));
    let mut all: Vec<PathBuf> = paths.collect::<Result<_, _>>().with_context(named)?;
    all.sort();
    Ok(all)
}
