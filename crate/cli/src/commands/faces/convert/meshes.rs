//! Corresponding meshes: examples for learning a space, in metres.

use std::path::Path;

use anyhow::{Context as _, Result, ensure};
use raconteur_faces::FaceSpace;

use super::obj::{self, Mesh};
use super::{MAX_MODES, SourceModel, arrays, files, ict};

/// Reads the folder's meshes, in the order of their names.
pub(super) fn read(folder: &Path) -> Result<SourceModel> {
    let named = || folder.display().to_string();
    let mut paths = files(folder)?;
    paths.retain(|path| {
        let ending = path.extension();
        ending.is_some_and(|ending| ending.eq_ignore_ascii_case("obj"))
    });
    ensure!(
        !paths.is_empty(),
        "{}: it contains no model: neither {}, nor {}, nor other meshes (*.obj)",
        folder.display(),
        ict::NAMES[0],
        arrays::NAMES.join(", ")
    );
    ensure!(
        paths.len() <= MAX_MODES,
        "{}: it holds {} meshes, and at most {MAX_MODES} are read",
        folder.display(),
        paths.len()
    );
    let (first, others) = paths.split_first().with_context(named)?;
    let Mesh { numbers, triangles } = obj::read(first)?;
    let rest = obj::like(first, numbers.len(), others)?;
    let examples: Vec<Vec<f64>> = std::iter::once(numbers).chain(rest).collect();
    Ok(SourceModel {
        kind: "meshes",
        shape: FaceSpace::learn(&examples).with_context(named)?,
        examples,
        triangles,
    })
}
