//! ICT-FaceKit's light model (Li et al. 2020, arXiv:2004.03458; MIT): its folder `FaceXModel` has
//! the average face and a mesh for each principal component, all of the same vertices. A face is
//! the average plus multiples of the differences of the others from it, with standard deviation 1.
//! Its expressions are omitted.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, ensure};
use raconteur_faces::FaceSpace;

use super::obj::{self, Mesh};
use super::{MAX_MODES, SourceModel, files};
use crate::terminal;

/// The average face.
const NEUTRAL: &str = "generic_neutral_mesh.obj";
/// Files that identify such a folder.
pub(super) const NAMES: [&str; 2] = [NEUTRAL, "identity000.obj"];
/// Metres per unit of the model, which is the centimetre.
const METRES: f64 = 0.01;
/// Number of components in the light model.
const USUAL: usize = 100;

/// Reads the folder.
pub(super) fn read(folder: &Path) -> Result<SourceModel> {
    let paths = identities(folder)?;
    let neutral = folder.join(NEUTRAL);
    let Mesh { numbers, triangles } = obj::read(&neutral)?;
    let others = obj::like(&neutral, numbers.len(), &paths)?;
    let difference = |face: &Vec<f64>| -> Vec<f64> {
        let pairs = face.iter().zip(&numbers);
        pairs.map(|(x, mean)| METRES * (x - mean)).collect()
    };
    let basis: Vec<Vec<f64>> = others.iter().map(difference).collect();
    let mean = numbers.iter().map(|x| METRES * x).collect();
    if basis.len() < USUAL {
        terminal::report(format_args!(
            "warning: {}: {} of the {USUAL} identities of ICT-FaceKit are there",
            folder.display(),
            basis.len()
        ));
    }
    Ok(SourceModel {
        kind: "ICT-FaceKit",
        shape: FaceSpace::of_basis(mean, &basis).with_context(|| folder.display().to_string())?,
        examples: Vec::new(),
        triangles,
    })
}

/// Returns the meshes of the components in order, without gaps.
fn identities(folder: &Path) -> Result<Vec<PathBuf>> {
    let all = files(folder)?;
    let count = all.iter().filter(|path| is_identity(path)).count();
    ensure!(
        count <= MAX_MODES,
        "{}: it has {count} identities, and at most {MAX_MODES} are read",
        folder.display()
    );
    let path = |index: usize| folder.join(format!("identity{index:03}.obj"));
    let wanted: Vec<PathBuf> = (0..count.max(1)).map(path).collect();
    for path in &wanted {
        ensure!(path.exists(), "{} is missing", path.display());
    }
    Ok(wanted)
}

fn is_identity(path: &Path) -> bool {
    let name = path.file_name().and_then(OsStr::to_str);
    let number = name.and_then(|name| name.strip_prefix("identity")?.strip_suffix(".obj"));
    number.is_some_and(|n| n.len() == 3 && n.bytes().all(|b| b.is_ascii_digit()))
}
