//! Bytes as a pack of faces.
#![no_main]

use raconteur_faces::FaceModel;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    // The name of the format is no riddle.
    let named = [b"RFACES\0\x01", bytes].concat();
    for bytes in [bytes, &named] {
        if let Ok(model) = FaceModel::from_bytes(bytes) {
            let face = vec![1.0; model.shape.dimensions()];
            assert_eq!(model.shape.face(&face).len(), model.shape.length());
            let again = model.to_bytes().expect("what was read can be written");
            FaceModel::from_bytes(&again).expect("what we write we can read");
        }
    }
});
