//! Saved inputs of the animation fuzz target, the shipped animations, and truncated copies of
//! those.

mod holds;

use std::fs;
use std::path::Path;

#[test]
fn texts_are_refused_or_play() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut paths: Vec<_> = ["fuzz/saved/animation", "assets/animations"]
        .iter()
        .flat_map(|folder| fs::read_dir(root.join(folder)).expect("a folder of texts"))
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_none_or(|e| e == "json"))
        .collect();
    paths.sort();
    assert!(paths.len() >= 30, "only {} texts", paths.len());
    for path in paths {
        let text = fs::read_to_string(path).expect("a text");
        holds::animation(&text);
        for cut in (0..text.len()).step_by(97) {
            holds::animation(text.get(..cut).unwrap_or_default());
        }
    }
}
