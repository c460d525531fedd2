//! Dependency cycles among the folders of a crate: a folder can be read, moved and removed with its
//! dependencies.
//!
//! A unit of a crate's root is a folder with all its content, at any depth, or a file next to
//! `lib.rs`; `x.rs` belongs to the folder `x`. Within a folder, its own folders are compared among
//! each other in the same way. A folder's loose files belong to the folder, and a folder and its
//! subfolders may depend on each other: `mod.rs` re-exports names of its children, and children use
//! `super`. The root of the crate is not a folder, because it may re-export everything.
//!
//! Uses are detected as for cycles of files, but a re-exported name counts as a use, too: a folder
//! that re-exports another's names depends on it. Tests are excluded.

use std::collections::{BTreeMap, BTreeSet};

use crate::cycles::circles;
use crate::modules::{Modules, Names, crates, home};

/// Folder, folder that it uses, and the uses that make the edge.
type Edges = BTreeMap<Names, BTreeMap<Names, BTreeSet<String>>>;

/// Returns the two sibling folders between which a use of one module by another occurs; `None` if
/// one contains the other or a loose file is involved.
fn between(modules: &Modules, from: &Names, to: &Names) -> Option<(Names, Names)> {
    let shared = from.iter().zip(to).take_while(|(a, b)| a == b).count();
    let (from, to) = (from.get(..=shared)?, to.get(..=shared)?);
    let is_folder = |at: &[String]| {
        modules
            .keys()
            .any(|m| m.len() > at.len() && m.starts_with(at))
    };
    (shared == 0 || is_folder(from) && is_folder(to)).then(|| (from.to_vec(), to.to_vec()))
}

fn edges(modules: &Modules) -> Edges {
    let mut edges = Edges::new();
    for (at, module) in modules {
        for path in module.used.iter().chain(module.handed_on.values()) {
            let Some(home) = home(modules, path, 8) else {
                continue;
            };
            if let Some((from, to)) = between(modules, at, &home) {
                edges.entry(to.clone()).or_default();
                let uses = edges.entry(from).or_default().entry(to).or_default();
                uses.insert(format!(
                    "{}: use {}",
                    module.file.display(),
                    path.join("::")
                ));
            }
        }
    }
    edges
}

/// Each circle with the uses that make it.
fn told(modules: &Modules) -> Vec<String> {
    let edges = edges(modules);
    let bare = edges
        .iter()
        .map(|(from, to)| (from.clone(), to.keys().cloned().collect()))
        .collect();
    let tell = |group: Vec<Names>| {
        let mut text = String::new();
        for from in &group {
            for (to, uses) in edges[from].iter().filter(|(to, _)| group.contains(to)) {
                text += &format!("  {} -> {}\n", from.join("/"), to.join("/"));
                for line in uses {
                    text += &format!("    {line}\n");
                }
            }
        }
        text
    };
    circles(&bare).into_iter().map(tell).collect()
}

#[test]
fn no_folders_of_a_crate_need_each_other() {
    let (folder, all) = crates();
    let mut found = Vec::new();
    for (name, modules) in all {
        let circles = told(&modules);
        found.extend(circles.iter().map(|circle| format!("{name}:\n{circle}")));
    }
    let text = found.join("\n");
    let text = text.replace(&format!("{}/", folder.display()), "");
    assert!(found.is_empty(), "{} circles:\n{text}", found.len());
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::told;
    use crate::modules::{Modules, Names, parse};

    /// A tree of modules, by their paths and texts.
    fn tree(files: &[(&str, &str)]) -> Modules {
        let read = |(path, text): &(&str, &str)| {
            let at: Names = path
                .split('/')
                .filter(|n| !n.is_empty())
                .map(String::from)
                .collect();
            let file = format!("{path}.rs");
            (at.clone(), parse(Path::new(&file), text, &at).0)
        };
        files.iter().map(read).collect()
    }

    #[test]
    fn a_circle_is_named_with_its_uses() {
        let circles = told(&tree(&[
            ("", "mod face; mod voice; mod clock;"),
            ("face", "pub mod lips; pub struct Face;"),
            ("face/lips", "use crate::voice::pitch::Pitch;"),
            ("voice", "mod pitch; mod breath;"),
            ("voice/pitch", "pub struct Pitch(crate::clock::Secs);"),
            ("voice/breath", "use crate::face::Face;"),
            ("clock", "pub struct Secs;"),
        ]));
        assert_eq!(
            circles,
            [
                "  face -> voice\n    face/lips.rs: use voice::pitch::Pitch\n  \
              voice -> face\n    voice/breath.rs: use face::Face\n"
            ]
        );
    }

    #[test]
    fn a_circle_within_a_folder_and_one_of_handed_on_names_are_found() {
        let nested = tree(&[
            ("", "mod face;"),
            ("face", "mod lips; mod lids;"),
            ("face/lips", "mod upper;"),
            ("face/lips/upper", "use super::super::lids::Lid;"),
            ("face/lids", "mod lash; pub struct Lid;"),
            ("face/lids/lash", "use crate::face::lips::Lip;"),
        ]);
        assert_eq!(told(&nested).len(), 1);
        let handed_on = tree(&[
            ("", "mod face; mod voice;"),
            ("face", "pub use crate::voice::Voice; pub struct Face;"),
            ("voice", "use crate::face::Face; pub struct Voice;"),
        ]);
        assert_eq!(told(&handed_on).len(), 1);
    }

    #[test]
    fn parents_children_roots_and_tests_are_no_circle() {
        let circles = told(&tree(&[
            (
                "",
                "mod face; pub use face::Face; mod voice; pub struct Error;",
            ),
            ("face", "mod lips; pub use lips::Lip; pub struct Face;"),
            (
                "face/lips",
                "mod upper; use super::Face; pub struct Lip(crate::Error);",
            ),
            ("face/lips/upper", "use super::super::lids;"),
            ("face/lids", "use super::lips::Lip;"),
            (
                "voice",
                "use crate::Face; #[cfg(test)] mod tests { use crate::face::lips; }",
            ),
            (
                "face/tests",
                "#[cfg(test)] fn says() { crate::voice::say(); }",
            ),
        ]));
        assert_eq!(circles, Vec::<String>::new());
    }
}
