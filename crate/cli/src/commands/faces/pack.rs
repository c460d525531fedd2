//! Face packs on disk.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result};
use raconteur_faces::{FaceModel, MAX_BYTES};
use raconteur_voice::files::input;

/// Returns the path of a pack's textures from its file of shapes.
pub(super) fn texture_beside(shapes: &Path) -> PathBuf {
    shapes.with_extension("skins")
}

/// Reads a pack, with its textures if they are next to it.
pub(super) fn read(shapes: &Path) -> Result<FaceModel> {
    let bytes = input::bytes(shapes, MAX_BYTES as u64).context("the pack")?;
    let mut model = FaceModel::from_bytes(&bytes)?;
    let beside = texture_beside(shapes);
    if beside.exists() {
        let bytes = input::bytes(&beside, MAX_BYTES as u64).context("the pack's textures")?;
        model.add_texture(&bytes)?;
    }
    Ok(model)
}
