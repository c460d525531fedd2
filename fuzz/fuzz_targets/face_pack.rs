//! Bytes as the parts of a face pack.
#![no_main]

use raconteur_faces::{Editor, FaceModel, FaceSpace, Follower, Segments};

/// A model of one vertex without anything else.
fn small() -> FaceModel {
    FaceModel {
        shape: FaceSpace::from_parts(vec![0.0; 3], Vec::new(), Vec::new()).expect("a space"),
        cage: Follower::default(),
        organs: Follower::default(),
        triangles: Vec::new(),
        segments: Segments::default(),
        landmarks: Vec::new(),
        attributes: Vec::new(),
        examples: Vec::new(),
        people: Vec::new(),
        texture: None,
    }
}

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    // The names of the parts are no riddle.
    let shape = [b"RFACES\x02S", bytes].concat();
    let texture = [b"RFACES\x02T", bytes].concat();
    for bytes in [bytes, &shape] {
        if let Ok(model) = FaceModel::from_bytes(bytes) {
            let again = model.to_bytes().expect("what was read can be written");
            FaceModel::from_bytes(&again).expect("what we write we can read");
            if let Ok(editor) = Editor::new(model) {
                let face = editor.random(1);
                assert_eq!(face.shape.len(), editor.model().shape.length());
            }
        }
    }
    let mut model = small();
    if model.add_texture(&texture).is_ok() {
        let again = model.texture.expect("it was read").to_bytes();
        assert!(again.is_ok(), "what was read can be written");
    }
});
