//! Replay of the fuzz targets' corpora and of earlier findings.

mod holds;

use std::fs;
use std::path::Path;

/// The files of a folder of the repository, by name.
fn files(folder: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(folder);
    let mut paths: Vec<_> = fs::read_dir(&folder)
        .expect("a folder of inputs")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| {
            path.extension()
                .is_none_or(|e| e != "timeline" && e != "md")
        })
        .collect();
    paths.sort();
    assert!(!paths.is_empty(), "{} is empty", folder.display());
    paths
        .iter()
        .map(|path| fs::read(path).expect("an input"))
        .collect()
}

#[test]
fn documents() {
    for input in files("tests/suite/eml")
        .iter()
        .chain(&files("fuzz/saved/eml_document"))
    {
        holds::document(input);
    }
}

#[test]
fn fragments() {
    for input in files("tests/suite/eml")
        .iter()
        .chain(&files("fuzz/saved/eml_fragment"))
    {
        holds::fragment(input);
    }
}

#[test]
fn times() {
    for input in files("fuzz/saved/eml_time") {
        holds::time(&input);
    }
}
