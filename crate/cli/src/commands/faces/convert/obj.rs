//! Meshes in Wavefront OBJ. Vertices keep the order of their file, which makes them correspond;
//! readers that lay out meshes for rendering, such as `tobj`, renumber them.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, ensure};
use raconteur_base::DVec3;
use raconteur_sculpt::scan::Scan;
use raconteur_voice::files::input;

use super::{MAX_COORDINATE, MAX_FILE_BYTES, MAX_VERTICES};
use crate::parallel;

/// Mesh read from a Wavefront OBJ file, in the units of the file.
#[derive(Debug)]
pub(super) struct Mesh {
    /// x, y and z of each vertex.
    pub(super) numbers: Vec<f64>,
    /// Triangles; polygons are split into fans about their first corner.
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Reads a mesh.
pub(super) fn read(path: &Path) -> Result<Mesh> {
    let text = input::text(path, MAX_FILE_BYTES)?;
    parse(&text).with_context(|| path.display().to_string())
}

fn parse(text: &str) -> Result<Mesh> {
    let scan = Scan::read(text)
        .context("a vertex has three finite numbers, a face up to 64 corners that count from 1")?;
    let count = scan.points.len();
    ensure!(count > 0, "it has no vertices");
    ensure!(
        count <= MAX_VERTICES,
        "it has {count} vertices, and at most {MAX_VERTICES} are read"
    );
    let is_face = |line: &&str| line.split_ascii_whitespace().next() == Some("f");
    let faces = text.lines().filter(is_face).count();
    ensure!(
        scan.faces.len() == faces,
        "{} of its {faces} faces have fewer than three corners, or a vertex that there is not",
        faces - scan.faces.len()
    );
    let numbers: Vec<f64> = scan.points.iter().flat_map(DVec3::to_array).collect();
    ensure!(
        numbers.iter().all(|x| x.abs() <= MAX_COORDINATE),
        "a coordinate is beyond {MAX_COORDINATE}"
    );
    Ok(Mesh {
        numbers,
        triangles: scan.faces.iter().flat_map(|face| fan(face)).collect(),
    })
}

/// Splits a polygon into a fan of triangles about its first corner.
fn fan(face: &[u32]) -> Vec<[u32; 3]> {
    let Some((&first, others)) = face.split_first() else {
        return Vec::new();
    };
    let pairs = others.windows(2);
    pairs.map(|pair| [first, pair[0], pair[1]]).collect()
}

/// Reads the vertex coordinates of meshes in parallel; an error if one does not have `length`
/// numbers, as the first mesh has.
pub(super) fn like(first: &Path, length: usize, paths: &[PathBuf]) -> Result<Vec<Vec<f64>>> {
    parallel::map(0..paths.len() as u64, |index| {
        let path = &paths[index as usize];
        let mesh = read(path)?;
        ensure!(
            mesh.numbers.len() == length,
            "{}: it has {} vertices, and {} has {}",
            path.display(),
            mesh.numbers.len() / 3,
            first.display(),
            length / 3
        );
        Ok(mesh.numbers)
    })
}
