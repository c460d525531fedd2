//! Dependency cycles among the files of a crate. Two files that need each other are one idea in two
//! places, or two ideas that need a third below them.
//!
//! A module and its children may depend on each other: that edge is counted only from the parent.
//! Tests are excluded, and a re-exported name (`pub use`) counts for its source file.

use std::collections::{BTreeMap, BTreeSet};

use crate::modules::{Module, Modules, Names, crates, home};

/// Returns the dependencies between modules.
fn edges(modules: &Modules) -> BTreeMap<Names, BTreeSet<Names>> {
    let of = |at: &Names, module: &Module| {
        let homes = module.used.iter().filter_map(|p| home(modules, p, 8));
        homes.filter(|to| !at.starts_with(to)).collect()
    };
    modules
        .iter()
        .map(|(at, m)| (at.clone(), of(at, m)))
        .collect()
}

/// Returns the groups of modules, or of other named items, with circular dependencies (Tarjan's
/// algorithm would be faster; there are a few hundred files).
pub(crate) fn circles(edges: &BTreeMap<Names, BTreeSet<Names>>) -> Vec<Vec<Names>> {
    let reach = |from: &Names| {
        let (mut seen, mut open) = (BTreeSet::new(), vec![from.clone()]);
        while let Some(at) = open.pop() {
            for to in &edges[&at] {
                if seen.insert(to.clone()) {
                    open.push(to.clone());
                }
            }
        }
        seen
    };
    let reached: BTreeMap<&Names, BTreeSet<Names>> =
        edges.keys().map(|at| (at, reach(at))).collect();
    let mut groups = BTreeSet::new();
    for (at, to) in &reached {
        if to.contains(*at) {
            let group: Vec<Names> = to
                .iter()
                .filter(|other| reached[other].contains(*at))
                .cloned()
                .collect();
            groups.insert(group);
        }
    }
    groups.into_iter().collect()
}

#[test]
fn no_files_of_a_crate_need_each_other() {
    let (folder, all) = crates();
    let mut found = Vec::new();
    for (_, modules) in all {
        let edges = edges(&modules);
        for group in circles(&edges) {
            let mut text = String::new();
            for at in &group {
                let to: Vec<String> = edges[at]
                    .iter()
                    .filter(|to| group.contains(to))
                    .map(|to| to.join("::"))
                    .collect();
                let file = modules[at]
                    .file
                    .strip_prefix(&folder)
                    .expect("a file below");
                text += &format!("  {} -> {}\n", file.display(), to.join(", "));
            }
            found.push(text);
        }
    }
    assert!(
        found.is_empty(),
        "{} circles:\n{}",
        found.len(),
        found.join("\n")
    );
}
