//! Bytes as a figure: a generated GLB, or any glTF, GLB or VRM.
#![no_main]

use raconteur_body::annotation::annotations;
use raconteur_avatar::{convert, open_figure};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let _ = annotations(bytes);
    if let Ok(imported) = open_figure("fuzz", bytes) {
        assert!(imported.figure.inverse_bind.iter().all(|m| m.is_finite()));
        let (own, _) = convert("fuzz", bytes).expect("what can be opened can be converted");
        open_figure("fuzz", &own).expect("what we write we can read");
    }
});
