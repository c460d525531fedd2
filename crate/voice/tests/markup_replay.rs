//! Replay of the marked-up text fuzz target's corpus: every document is rejected, or written in
//! both languages and read again with the same words.

use std::fs;
use std::path::Path;

use raconteur_voice::content::Content;
use raconteur_voice::markup::{plain, sable, ssml};
use raconteur_voice::resolve::resolve;

/// Returns every word as spoken.
fn words(content: &Content) -> Vec<String> {
    let resolved = resolve(content, "festival");
    let words = resolved.styled_words();
    words.iter().map(|word| format!("{word:?}")).collect()
}

#[test]
fn saved_documents_are_refused_or_survive_writing() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/saved/speech_markup");
    let mut paths: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    assert!(paths.len() >= 10, "only {} inputs", paths.len());
    let mut read = 0;
    for path in paths {
        let bytes = fs::read(&path).unwrap();
        let Ok(text) = std::str::from_utf8(&bytes) else {
            continue;
        };
        let mut contents = vec![plain::read(text)];
        contents.extend(sable::read(text).ok().map(|(content, _)| content));
        contents.extend(ssml::read(text).ok().map(|(content, _)| content));
        read += contents.len() - 1;
        for content in contents {
            let (of_sable, _) = sable::read(&sable::write(&content)).unwrap();
            let (of_ssml, _) = ssml::read(&ssml::write(&content, "en")).unwrap();
            assert_eq!(words(&of_sable), words(&content), "{}", path.display());
            assert_eq!(words(&of_ssml), words(&content), "{}", path.display());
        }
    }
    assert!(read >= 10, "only {read} readings");
}
