//! The reference page, the schema and the description for editors match the table, and every
//! example plays without errors. `UPDATE=1` writes them again.

use raconteur_eml::reference::{CODES, json, markdown, relax_ng, whole_example};
use raconteur_eml::schema::ELEMENTS;
use raconteur_eml::{EstimatedDurations, Timeline, parse};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

#[test]
fn the_documents_are_up_to_date() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    for (name, text) in [
        ("eml.md", markdown()),
        ("eml.json", json()),
        ("eml.rng", relax_ng()),
    ] {
        let path = folder.join(name);
        if std::env::var_os("UPDATE").is_some() {
            fs::write(&path, &text).expect("the document is written");
        }
        let found = fs::read_to_string(&path).unwrap_or_default();
        assert!(
            found == text,
            "docs/{name} is stale: UPDATE=1 cargo test -p raconteur-eml --test reference"
        );
    }
}

#[test]
fn every_entry_explains_itself() {
    for element in ELEMENTS {
        let name = element.name;
        assert!(
            !element.doc.is_empty() && !element.source.is_empty(),
            "{name}"
        );
        for attribute in element.all_attributes() {
            assert!(!attribute.doc.is_empty(), "{name} {}", attribute.name);
        }
        let sections = format!("### {}{name}\n", if element.extension { "r:" } else { "" });
        let in_parent = format!("### {name} in ");
        let page = markdown();
        assert!(
            page.contains(&sections) || page.contains(&in_parent),
            "{name}"
        );
    }
}

#[test]
fn every_example_uses_its_element_and_plays_without_fault() {
    for element in ELEMENTS {
        let example = element.example;
        let prefix = if element.extension { "r:" } else { "" };
        assert!(
            example.contains(&format!("<{prefix}{}", element.name)),
            "{}",
            element.name
        );
        let parsed = parse(&whole_example(example));
        assert_eq!(parsed.diagnostics, [], "{example}");
        let resolved = Timeline::resolve(&parsed.document, &EstimatedDurations);
        assert_eq!(resolved.diagnostics, [], "{example}");
    }
}

#[test]
fn every_code_is_explained() {
    let explained: BTreeSet<String> = CODES.iter().map(|(code, _)| (*code).to_owned()).collect();
    assert_eq!(explained.len(), CODES.len());
    assert!(CODES.is_sorted(), "the diagnostic codes are sorted");
    let mut used = BTreeSet::new();
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    collect(&source, &mut used);
    assert_eq!(used, explained);
}

/// The codes in the sources, but for those that only name codes.
fn collect(folder: &Path, used: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            collect(&path, used);
            continue;
        }
        if path.ends_with("reference/codes.rs") {
            continue;
        }
        let text = fs::read_to_string(&path).expect("a source");
        // Tests may make up codes.
        let text = text.split("#[cfg(test)]\nmod tests").next().unwrap_or("");
        for part in text.split("\"eml::").skip(1) {
            let code = part.split('"').next().unwrap_or("");
            used.insert(format!("eml::{code}"));
        }
    }
}
