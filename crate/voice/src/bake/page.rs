//! Speech for a page, while somebody waits: what a story says in its own text, without files,
//! programs and encoders. The sound is the baker's, as WAV.

use std::collections::BTreeSet;
use std::path::Path;

use anyhow::Result;
use raconteur_speech::bundle::{AudioFile, Bundle, Utterance};

use super::encode::wave_of;
use super::want::{self, Wanted, short};
use super::{BakeOptions, bundle_text, bundled, speak};
use crate::content::Content;
use crate::{Source, SpeechRequest};

/// Most words that are said at a time, some twenty minutes: sound is held in memory.
const MOST_WORDS: usize = 3000;

/// What was said.
#[derive(Clone, Debug, Default)]
pub struct Said {
    /// The text of the bundle, `speech.json`.
    pub bundle: String,
    /// Names of its sounds, as the bundle calls them, and the bytes of the WAV.
    pub sounds: Vec<(String, Vec<u8>)>,
    /// Why something could not be said, in sentences.
    pub problems: Vec<String>,
}

/// Speaks what a story says and what `known`, the bundle that it has, does not hold. Files are
/// left out. What an engine refuses is told in the problems; the rest is said.
///
/// # Errors
/// When no bundle can be made of what was said.
pub fn say(said: &[SpeechRequest], known: Option<Bundle>, options: &BakeOptions) -> Result<Said> {
    let mut out = Said::default();
    let known = known.unwrap_or_default();
    let mut seen: BTreeSet<u64> = known.utterances.iter().map(|u| u.key).collect();
    let mut made = Vec::new();
    let mut words = 0;
    for (place, request) in said.iter().enumerate() {
        let Source::Content(content) = &request.source else {
            continue;
        };
        if content.words().is_empty() || !seen.insert(request.key) {
            continue;
        }
        words += content.words().len();
        if words > MOST_WORDS {
            out.problems.push(format!(
                "more than {MOST_WORDS} words are not said while somebody waits; bake the story"
            ));
            break;
        }
        match say_one(request, content, place, options) {
            Ok((wanted, utterance, wave)) => {
                let file = &utterance.audio[0].file;
                out.sounds.push((file.clone(), wave));
                made.push((wanted, utterance));
            }
            Err(error) => {
                let text = short(&content.plain_text());
                out.problems.push(format!("{text:?}: {error:#}"));
            }
        }
    }
    let all = made.iter().map(|(wanted, u)| Ok((wanted, u.clone())));
    let bundle = merged(known, bundled(all, &options.cast)?);
    out.bundle = bundle_text::write(&bundle);
    Ok(out)
}

/// One utterance, planned and spoken, and its WAV.
fn say_one<'a>(
    request: &'a SpeechRequest,
    content: &Content,
    place: usize,
    options: &BakeOptions,
) -> Result<(Wanted<'a>, Utterance, Vec<u8>)> {
    let wanted = want::want(request, content.clone(), place, Path::new(""), options)?;
    let work = speak::Work {
        content: &wanted.content,
        role: &wanted.role,
        emotion: request.emotion.as_ref(),
        pace: options.pace,
    };
    let none = |_: f64| Ok(Vec::new());
    let track = speak::speak(&work, &wanted.casting, &options.cast, &none)?;
    let mut utterance = track.utterance;
    utterance.key = wanted.key;
    utterance.content = wanted.digest;
    utterance.audio = vec![AudioFile {
        file: format!("{:016x}.wav", wanted.digest),
        mime: "audio/wav".to_owned(),
        holds: None,
    }];
    let wave = wave_of(&track.samples, track.rate_hz.round() as u32)?;
    Ok((wanted, utterance, wave))
}

/// A bundle with the utterances of another behind its own.
fn merged(mut known: Bundle, new: Bundle) -> Bundle {
    let first = known.voices.len();
    known.voices.extend(new.voices);
    for utterance in new.utterances {
        let mut own = (*utterance).clone();
        own.voice += first;
        known.utterances.push(own.into());
    }
    known
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bake::engine::flite::{Flite, Host, Output};
    use crate::bake::{Cast, STORY_PACE};
    use crate::said;
    use crate::text::Lexicon;

    /// Says "cat" for every word, and fails on "bad".
    struct Cat;

    impl Host for Cat {
        fn run(&self, arguments: &[&str], files: &[(&str, &str)], sound: bool) -> Result<Output> {
            let text = files.first().map_or("", |f| f.1);
            anyhow::ensure!(!text.contains("bad"), "no such word");
            let words = text.split_whitespace().count();
            let printed = match arguments {
                ["--version"] => "flite-2.2-test".to_owned(),
                ["-lv"] => "Voices available: slt".to_owned(),
                _ if sound => {
                    let phones = ["k", "ae", "t"].repeat(words);
                    let ends = (1..).map(|i| f64::from(i) * 0.1);
                    let all = phones.iter().zip(ends);
                    all.map(|(p, end)| format!("{p}:{end:.3} ")).collect()
                }
                _ => "pau k ae t pau\n".repeat(words),
            };
            let wave = wave_of(&vec![0.1; 4800 * words], 16_000)?;
            Ok(Output {
                printed,
                wave: if sound { wave } else { Vec::new() },
            })
        }
    }

    fn options() -> BakeOptions {
        BakeOptions {
            cast: Cast::of("flite", Box::new(Flite(Cat)), "slt").unwrap(),
            pace: STORY_PACE,
            lexicon: Lexicon::default(),
            lexicon_text: String::new(),
            jobs: 1,
            check: false,
        }
    }

    fn requests(eml: &str) -> Vec<SpeechRequest> {
        said(&raconteur_eml::parse(eml).document)
    }

    const TWO: &str = "<eml><body><voice-text time='0'>One two.</voice-text>\
        <voice-text time='9'>Three.</voice-text></body></eml>";

    #[test]
    fn what_is_said_has_its_phones_and_sound_and_is_not_said_twice() {
        let options = options();
        let first = say(&requests(TWO), None, &options).unwrap();
        assert!(first.problems.is_empty(), "{:?}", first.problems);
        let bundle = Bundle::from_json(first.bundle.as_bytes()).unwrap();
        assert_eq!(bundle.utterances.len(), 2);
        for (utterance, (file, wave)) in bundle.utterances.iter().zip(&first.sounds) {
            assert_eq!(&utterance.audio[0].file, file);
            let sounds = utterance.phones.iter().filter(|p| p.symbol != "pau");
            assert_eq!(sounds.count(), 3 * utterance.words.len());
            let reader = hound::WavReader::new(&wave[..]).unwrap();
            let secs = f64::from(reader.duration()) / f64::from(reader.spec().sample_rate);
            assert!((secs - utterance.duration_secs).abs() < 0.01);
        }
        let more = TWO.replace("</body>", "<voice-text time='20'>Four.</voice-text></body>");
        let second = say(&requests(&more), Some(bundle.clone()), &options).unwrap();
        assert_eq!(second.sounds.len(), 1);
        let both = Bundle::from_json(second.bundle.as_bytes()).unwrap();
        assert_eq!(both.utterances.len(), 3);
        assert_eq!(both.utterances[..2], bundle.utterances[..]);
    }

    #[test]
    fn what_cannot_be_said_is_told_and_the_rest_is_said() {
        let eml = TWO.replace("One two.", "A bad one.");
        let out = say(&requests(&eml), None, &options()).unwrap();
        assert_eq!(out.sounds.len(), 1);
        assert!(
            out.problems[0].contains("no such word"),
            "{:?}",
            out.problems
        );
        let file =
            "<eml><body><voice-say time='0' type='text' content='/etc/passwd'/></body></eml>";
        let out = say(&requests(file), None, &options()).unwrap();
        assert!(out.sounds.is_empty());
    }
    #[test]
    fn long_texts_are_told_and_not_said() {
        let long = "word ".repeat(MOST_WORDS + 1);
        let out = say(&requests(&TWO.replace("Three", &long)), None, &options()).unwrap();
        assert_eq!(out.sounds.len(), 1);
        assert!(out.problems[0].contains("bake"), "{:?}", out.problems);
    }
}
