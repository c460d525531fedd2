//! Pack for tests.

use std::fs;
use std::path::{Path, PathBuf};

use raconteur_base::noise;
use raconteur_faces::{AgeModel, DependentNumbers, FaceModel, FaceSpace, Segment, Segments};

/// Writes a test pack of 40 faces with 12 numbers each into a folder.
pub(super) fn pack(folder: &Path) -> PathBuf {
    let face = |face: u64| -> Vec<f64> { (0..12).map(|i| noise::signed(3, face, i)).collect() };
    let faces: Vec<Vec<f64>> = (0..40).map(face).collect();
    let shape = FaceSpace::learn(&faces).expect("corresponding");
    let own = faces.iter().map(|f| shape.coefficients(f));
    let examples: Vec<Vec<f64>> = own.collect::<Result<_, _>>().expect("corresponding");
    let whole = Segment {
        name: "face".to_owned(),
        parent: None,
        runs: vec![[0, 4]],
    };
    let model = FaceModel {
        reference: Vec::new(),
        life: AgeModel::default(),
        cage: DependentNumbers::learn(&shape, &examples, &faces),
        organs: DependentNumbers::default(),
        people: Vec::new(),
        landmarks: Vec::new(),
        texture: None,
        triangles: vec![[0, 1, 2]],
        segments: Segments::new(vec![whole], 4).expect("a hierarchy"),
        attributes: Vec::new(),
        examples,
        shape,
    };
    let path = folder.join("pack");
    fs::write(&path, model.to_bytes().expect("it fits")).expect("written");
    path
}

/// Returns the value visible to raters: the first number of a face, from −1 to 1.
pub(super) fn visible_value(face: usize) -> f64 {
    noise::signed(3, face as u64, 0)
}
