//! Replay of the fuzz targets' corpora.

use std::fs;
use std::path::Path;

use raconteur_annotate::gsl::{Feature, Palm, Position, Shape, parse};
use raconteur_annotate::{Anchoring, anvil, import, read_transcription, xml};

fn inputs(target: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../fuzz/saved")
        .join(target);
    let entries = fs::read_dir(&folder).expect("a folder of inputs");
    let read = entries.map(|entry| fs::read(entry.expect("an entry").path()).expect("an input"));
    let inputs: Vec<Vec<u8>> = read.collect();
    assert!(!inputs.is_empty(), "{target} has inputs");
    inputs
}

#[test]
fn transcriptions() {
    for bytes in inputs("transcription") {
        let read = read_transcription(&bytes, None);
        for problem in &read.diagnostics {
            assert!(problem.span.end as usize <= read.text.len(), "{problem:?}");
        }
        let text = anvil::write(&anvil::from_transcription(&read.transcription));
        assert!(
            xml::parse(&text, &mut Vec::new()).is_some(),
            "{text} is read again"
        );
        for anchoring in [Anchoring::Words, Anchoring::Seconds] {
            let eml = raconteur_eml::write(&import(&bytes, None, anchoring).document);
            let told = raconteur_eml::parse(&eml).diagnostics;
            assert!(
                told.iter().all(|d| d.code == "eml::empty-body"),
                "{told:?}\n{eml}"
            );
        }
    }
}

#[test]
fn gsl_texts() {
    fn holds<F: Feature + std::fmt::Debug>(text: &str) {
        match parse::<F>(text) {
            Ok(value) => assert_eq!(parse::<F>(&value.to_string()), Ok(value), "{text}"),
            Err(error) => assert!(
                text.get(error.start..error.end).is_some(),
                "{text}: {error}"
            ),
        }
    }
    for bytes in inputs("gsl") {
        let text = String::from_utf8(bytes).expect("text");
        holds::<Shape>(&text);
        holds::<Palm>(&text);
        holds::<Position>(&text);
    }
}
