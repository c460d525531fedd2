//! Edges between crates, and the locations of platform crates.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use toml::Table;

/// Crate, and the workspace crates it may use. ARCHITECTURE.md explains the table.
const ALLOWED: [(&str, &[&str]); 19] = [
    ("base", &[]),
    ("eml", &["base"]),
    ("speech", &["base"]),
    ("spoken", &["eml", "speech"]),
    ("tissue", &["base"]),
    ("body", &["base", "tissue"]),
    ("reshape", &["base", "body"]),
    ("faces", &["base"]),
    ("actor", &["base", "speech", "body", "tissue"]),
    ("stage", &["base", "body"]),
    ("render", &["stage", "body", "base"]),
    (
        "player",
        &[
            "base", "eml", "speech", "spoken", "tissue", "body", "reshape", "faces", "actor",
            "stage",
        ],
    ),
    ("web", &["player", "faces", "render"]),
    ("voice", &["base", "speech", "eml", "spoken"]),
    ("say", &["base", "speech", "eml", "voice"]),
    ("sculpt", &["base", "body", "tissue", "faces"]),
    ("avatar", &["base", "body", "reshape", "tissue"]),
    ("annotate", &["base", "eml"]),
    (
        "cli",
        &[
            "base", "eml", "speech", "tissue", "body", "reshape", "faces", "actor", "stage",
            "render", "player", "voice", "sculpt", "avatar", "annotate",
        ],
    ),
];

/// Crates that touch a platform, and where they may be named.
const PLATFORM: [(&str, &[&str]); 5] = [
    ("wgpu", &["render"]),
    ("web-sys", &["render", "web"]),
    ("js-sys", &["render", "web", "say", "avatar"]),
    (
        "wasm-bindgen",
        &["render", "web", "annotate", "avatar", "faces", "say"],
    ),
    ("wasm-bindgen-futures", &["render", "web"]),
];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Dependencies of one crate by manifest section, target sections included.
fn dependencies(name: &str) -> BTreeMap<String, Vec<String>> {
    let path = root().join("crate").join(name).join("Cargo.toml");
    let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let manifest: Table = text
        .parse()
        .unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut visit = |table: &Table| {
        for section in ["dependencies", "build-dependencies", "dev-dependencies"] {
            if let Some(d) = table.get(section).and_then(|d| d.as_table()) {
                found
                    .entry(section.to_owned())
                    .or_default()
                    .extend(d.keys().cloned());
            }
        }
    };
    visit(&manifest);
    if let Some(targets) = manifest.get("target").and_then(|t| t.as_table()) {
        targets
            .values()
            .filter_map(|t| t.as_table())
            .for_each(&mut visit);
    }
    found
}

#[test]
fn every_crate_of_the_table_exists_and_no_other() {
    let mut folders: Vec<String> = fs::read_dir(root().join("crate"))
        .expect("the crate folder")
        .filter_map(Result::ok)
        .filter(|e| e.path().is_dir())
        .map(|e| e.file_name().to_string_lossy().into_owned())
        .collect();
    folders.sort();
    let mut expected: Vec<_> = ALLOWED.iter().map(|(n, _)| (*n).to_owned()).collect();
    expected.sort();
    assert_eq!(folders, expected);
}

#[test]
fn crates_use_only_what_the_table_allows() {
    for (name, allowed) in ALLOWED {
        for (section, used) in dependencies(name) {
            for dependency in used {
                if let Some(other) = dependency.strip_prefix("raconteur-") {
                    // Tests of every crate query it for the extent of their run.
                    if other == "tier" && section == "dev-dependencies" {
                        continue;
                    }
                    assert!(
                        allowed.contains(&other),
                        "crate {name} must not use {other} ({section}); the table in ARCHITECTURE.md"
                    );
                }
            }
        }
    }
}

#[test]
fn platform_crates_stay_at_the_edge() {
    for (name, _) in ALLOWED {
        for (section, used) in dependencies(name) {
            for (platform, homes) in PLATFORM {
                assert!(
                    !used.iter().any(|u| u == platform) || homes.contains(&name),
                    "{platform} must not appear in crate {name} ({section})"
                );
            }
        }
    }
}
