//! Golden images, rendered natively without a screen. `UPDATE=1` renders them again.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Mean difference of a channel, of 255. Between Mesa's software driver and SwiftShader the
/// same scene differs by 0.04 to 1.2; the bound leaves room for a driver, not for a change.
const MEAN: f64 = 1.5;
/// Share of pixels that may differ by more than 24 of 255 in a channel: edges that another
/// driver resolves differently.
const BAD_SHARE: f64 = 0.01;

fn golden(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../../tests/golden")
        .join(name)
}

fn read(path: &Path) -> (Vec<u8>, u32, u32) {
    let file = File::open(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut reader = png::Decoder::new(BufReader::new(file))
        .read_info()
        .expect("a PNG");
    let mut pixels = vec![
        0;
        reader
            .output_buffer_size()
            .expect("a size that fits in memory")
    ];
    let info = reader.next_frame(&mut pixels).expect("pixels");
    (pixels, info.width, info.height)
}

fn compare(story: &str, at: &str, shot: &str, name: &str) {
    let script = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../assets/stories")
        .join(story);
    let drawn = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let out = Command::new(env!("CARGO_BIN_EXE_raconteur"))
        .arg("render")
        .arg(script)
        .args(["--at", at, "--shot", shot, "--size", "320x200", "-o"])
        .arg(&drawn)
        .output()
        .expect("the program runs");
    assert!(
        out.status.success(),
        "{}",
        String::from_utf8_lossy(&out.stderr)
    );
    if std::env::var_os("UPDATE").is_some() {
        std::fs::copy(&drawn, golden(name)).expect("the golden is written");
        return;
    }
    let ((a, aw, ah), (b, bw, bh)) = (read(&drawn), read(&golden(name)));
    assert_eq!(
        (aw, ah, a.len()),
        (bw, bh, b.len()),
        "{name} has another size"
    );
    let differences: Vec<u8> = a.iter().zip(&b).map(|(x, y)| x.abs_diff(*y)).collect();
    let mean = differences.iter().map(|d| f64::from(*d)).sum::<f64>() / differences.len() as f64;
    let bad = differences
        .chunks(4)
        .filter(|p| p.iter().any(|d| *d > 24))
        .count();
    let share = bad as f64 / (differences.len() / 4) as f64;
    assert!(
        mean <= MEAN && share <= BAD_SHARE,
        "{name}: mean difference {mean:.2}, {:.2} % bad pixels; drawn: {}",
        share * 100.0,
        drawn.display()
    );
}

#[test]
fn the_greeting_looks_as_it_did() {
    compare("hello-world", "1.3", "medium", "hello-world.png");
}

#[test]
fn a_face_in_mid_word_looks_as_it_did() {
    compare("white-rabbit", "20", "close", "white-rabbit-close.png");
}
