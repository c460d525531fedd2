//! Text as a document of SABLE and of SSML: the result is written in both languages and read again,
//! and every word has the same style.
#![no_main]

use raconteur_voice::content::{Content, Division};
use raconteur_voice::markup::{plain, sable, ssml};
use raconteur_voice::resolve::{Item, resolve};

/// Returns the spoken text with each word's style. Consecutive divisions count as one.
fn heard(content: &Content) -> Vec<String> {
    let resolved = resolve(content, "festival");
    let mut heard: Vec<String> = Vec::new();
    let mut division = None;
    for item in &resolved.items {
        if let Item::Division(this) = item {
            division = match division {
                Some(Division::Paragraph) => division,
                _ => Some(*this),
            };
            continue;
        }
        if let Some(division) = division.take() {
            heard.push(format!("{division:?}"));
        }
        heard.push(match item {
            Item::Word {
                text,
                style,
                together,
            } => format!(
                "{text} {:?} {}",
                resolved.styles[*style],
                together.is_some()
            ),
            item => format!("{item:?}"),
        });
    }
    heard.extend(division.map(|d| format!("{d:?}")));
    heard
}

libfuzzer_sys::fuzz_target!(|text: &str| {
    let mut contents = vec![plain::read(text)];
    contents.extend(sable::read(text).ok().map(|(content, _)| content));
    contents.extend(ssml::read(text).ok().map(|(content, _)| content));
    for content in contents {
        let heard_first = heard(&content);
        let words: Vec<String> = content.words();
        assert_eq!(resolve(&content, "").words().count(), words.len());
        for (written, is_sable) in [
            (sable::write(&content), true),
            (ssml::write(&content, "en"), false),
        ] {
            let again = if is_sable {
                sable::read(&written)
            } else {
                ssml::read(&written)
            };
            let (again, _) = again.unwrap_or_else(|p| panic!("{p}: {written}"));
            assert_eq!(heard(&again), heard_first, "{written}");
        }
    }
});
