//! Shipped faces.

use raconteur_faces::{Editor, FaceModel};

/// An editor of the shapes of the shipped pack.
pub(crate) fn editor() -> Editor {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../assets/faces/people.faces"
    );
    let bytes = std::fs::read(path).expect("the pack");
    Editor::new(FaceModel::from_bytes(&bytes).expect("a pack")).expect("a mesh")
}
