//! Corpus of the lexicon fuzz target, and generated texts.

mod holds;

use std::fs;
use std::path::Path;

use proptest::prelude::*;

#[test]
fn saved_lexicons_are_refused_or_spoken() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/saved/lexicon");
    let mut paths: Vec<_> = fs::read_dir(folder)
        .expect("a folder of lexicons")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.sort();
    assert!(paths.len() >= 2, "only {} inputs", paths.len());
    for path in paths {
        let bytes = fs::read(path).expect("an input");
        holds::lexicon(&String::from_utf8_lossy(&bytes));
    }
}

proptest! {
    #[test]
    fn lines_are_refused_or_spoken(lines in prop::collection::vec(
        prop_oneof![
            "[a-zé]{0,5} ?= ?/?[a-zəː]{0,5}/?",
            "\\[[a-z*]{0,3}\\]",
            "#?[ -~é\u{301}]{0,20}",
        ],
        0..12,
    )) {
        holds::lexicon(&lines.join("\n"));
    }
}
