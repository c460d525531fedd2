//! Replay of packs found by fuzzing: each is read or rejected, and a read pack can be written and
//! read again.

use std::fs;
use std::path::Path;

use raconteur_faces::FaceModel;

#[test]
fn packs_that_fuzzing_found() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/saved/face_pack");
    let mut count = 0;
    for entry in fs::read_dir(folder).expect("a folder") {
        let bytes = fs::read(entry.expect("an entry").path()).expect("a file");
        let shape = [b"RFACES\x02S", bytes.as_slice()].concat();
        for bytes in [bytes, shape] {
            if let Ok(model) = FaceModel::from_bytes(&bytes) {
                let again = model.to_bytes().expect("what was read can be written");
                FaceModel::from_bytes(&again).expect("what was written can be read");
            }
        }
        count += 1;
    }
    assert!(count > 0, "the corpus has at least one pack");
}
