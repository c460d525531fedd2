//! The words and types of emotions in the pages are those of the crates. `UPDATE=1` writes them
//! again.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use raconteur_speech::emotion::WORDS;
use raconteur_stage::emotion::{EMOTIONS, Valence};

/// `web/pages/emotions.json`: each word with activation, evaluation and power, and the names of
/// the good and of the bad types.
fn of_the_crates() -> String {
    let mut text = "{\n  \"words\": [\n".to_owned();
    for (i, (word, [activation, evaluation, power])) in WORDS.iter().enumerate() {
        let comma = if i + 1 < WORDS.len() { "," } else { "" };
        writeln!(
            text,
            "    {{ \"word\": \"{word}\", \"activation\": {activation}, \"evaluation\": {evaluation}, \"power\": {power} }}{comma}"
        )
        .expect("a string takes text");
    }
    let names = |valence: Valence| {
        let of_it = EMOTIONS.iter().filter(|e| e.valence == valence);
        let quoted: Vec<String> = of_it.map(|e| format!("\"{}\"", e.name)).collect();
        quoted.join(", ")
    };
    let (good, bad) = (names(Valence::Positive), names(Valence::Negative));
    write!(
        text,
        "  ],\n  \"good\": [{good}],\n  \"bad\": [{bad}]\n}}\n"
    )
    .expect("a string takes text");
    text
}

#[test]
fn the_pages_know_the_emotions_of_the_crates() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../web/pages/emotions.json");
    let text = of_the_crates();
    if std::env::var_os("UPDATE").is_some() {
        fs::write(&path, &text).expect("the file is written");
    }
    let found = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        found == text,
        "web/pages/emotions.json is stale: UPDATE=1 cargo test -p raconteur-player --test emotions"
    );
}
