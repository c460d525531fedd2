//! Length and content of source files.

use std::fs;
use std::path::{Path, PathBuf};

/// Maximum number of lines of a file, beyond which it contains a second idea; generated tables are
/// exempt and say so on their first line.
const MAX_LINES: usize = 500;

/// Folders that are made, not written.
const MADE: [&str; 7] = [
    "target",
    "node_modules",
    "dist",
    "pkg",
    ".git",
    "test-results",
    "playwright-report",
];

fn sources(folder: &Path, into: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for path in entries.filter_map(Result::ok).map(|e| e.path()) {
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        if path.is_dir() {
            if !MADE.contains(&name.as_str()) && !name.starts_with('.') {
                sources(&path, into);
            }
        } else if [".rs", ".ts", ".wgsl", ".mjs", ".css", ".html", ".md"]
            .iter()
            .any(|e| name.ends_with(e))
        {
            into.push(path);
        }
    }
}

pub(crate) fn all() -> Vec<(PathBuf, String)> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut paths = Vec::new();
    sources(&root, &mut paths);
    assert!(
        paths.len() > 50,
        "the walk found only {} files",
        paths.len()
    );
    paths
        .into_iter()
        .filter_map(|p| fs::read_to_string(&p).ok().map(|t| (p, t)))
        .collect()
}

#[test]
fn files_hold_one_idea() {
    for (path, text) in all() {
        let is_code = path.extension().is_none_or(|e| e != "md");
        let first = text.lines().next().unwrap_or_default().to_lowercase();
        let lines = text.lines().count();
        assert!(
            !is_code || lines <= MAX_LINES || first.contains("generated"),
            "{} has {lines} lines",
            path.display()
        );
    }
}

#[test]
fn nothing_is_left_undone_or_switched_off() {
    // Each mark is written in two halves so that this file does not match itself.
    let marks = [
        ["to", "do!("],
        ["unimple", "mented!("],
        ["TO", "DO"],
        ["FIX", "ME"],
        ["#[ig", "nore"],
        [".sk", "ip("],
        [".on", "ly("],
    ]
    .map(|h| h.concat());
    for (path, text) in all() {
        // Iterators have a method of the same name as the test runner's switch.
        let rust = path.extension().is_some_and(|e| e == "rs");
        for mark in &marks {
            if rust && mark.starts_with('.') {
                continue;
            }
            assert!(
                !text.contains(mark.as_str()),
                "{} contains {mark}",
                path.display()
            );
        }
    }
}

#[test]
fn no_path_of_a_machine_is_in_the_tree() {
    let marks = [["/wo", "rk/"], ["/ro", "ot/"], ["/ho", "me/"]].map(|h| h.concat());
    for (path, text) in all() {
        for mark in &marks {
            assert!(
                !text.contains(mark.as_str()),
                "{} contains {mark}",
                path.display()
            );
        }
    }
}
