//! Shipped faces: a crowd of them resembles the population, and no skin passes through skin.

use std::path::PathBuf;
use std::process::Command;

use raconteur_tier::sized;

#[test]
fn the_shipped_pack_passes_its_check() {
    let pack = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../assets/faces/people.faces");
    let out = Command::new(env!("CARGO_BIN_EXE_raconteur"))
        .args(["faces", "check"])
        .arg(pack)
        .args([
            "--count",
            sized("300", "1000"),
            "--look",
            sized("12", "200"),
        ])
        .output()
        .expect("the program runs");
    let told = String::from_utf8_lossy(&out.stdout);
    assert!(out.status.success(), "{told}");
    assert!(told.contains("0 of"), "{told}");
}
