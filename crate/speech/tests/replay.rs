//! Replay of the speech bundle fuzz target's corpus: every input is rejected or can be queried, and
//! none panics.

use std::fs;
use std::path::Path;

use raconteur_speech::Bundle;

#[test]
fn saved_inputs_are_refused_or_answer() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/saved/speech_bundle");
    let mut paths: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    assert!(paths.len() >= 10, "only {} inputs", paths.len());
    for path in paths {
        let Ok(bundle) = Bundle::from_json(&fs::read(path).unwrap()) else {
            continue;
        };
        for utterance in &bundle.utterances {
            for t in [-1.0, 0.0, 0.5, utterance.duration_secs, f64::MAX] {
                let word = utterance.word_at(t);
                assert!(
                    word.is_none_or(|i| i < utterance.words.len()),
                    "the word index refers to a word"
                );
                let phone = utterance.phone_at(t);
                assert!(
                    phone.is_none_or(|i| i < utterance.phones.len()),
                    "the phone index refers to a phone"
                );
            }
        }
    }
}
