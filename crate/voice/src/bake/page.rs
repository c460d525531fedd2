//! Speech for a page, on demand: the text of a story, without files, programs and encoders. The
//! audio is the baker's, as WAV.

use std::collections::BTreeSet;
use std::path::Path;

use anyhow::Result;
use raconteur_speech::bundle::{AudioFile, Bundle};

use super::encode::wave_of;
use super::engine::Pending;
use super::planned::{self, short};
use super::{BakeOptions, bundle_text, bundled, speak};
use crate::content::Content;
use crate::text::TOKEN_CHARS;
use crate::{Source, SpeechRequest};

/// Maximum number of words per bake, about twenty minutes: the audio is held in memory.
const MAX_WORDS: usize = 3000;

/// A longer word is spelled by some engines: each of its letters counts as a word, characters.
const LONG_WORD: usize = TOKEN_CHARS;

/// Returns the number of words in a content, for [`MAX_WORDS`].
fn words_of(content: &Content) -> usize {
    let weights = content.words().into_iter().map(|word| {
        let length = word.chars().count();
        if length > LONG_WORD { length } else { 1 }
    });
    weights.sum()
}

/// Incremental bake (speech synthesis ahead of time) in a web page, one utterance per call.
pub struct PageBake {
    requests: Vec<SpeechRequest>,
    next: usize,
    seen: BTreeSet<u64>,
    words: usize,
    bundle: Bundle,
    /// Names of new sounds, as the bundle calls them, and the bytes of the WAV.
    sounds: Vec<(String, Vec<u8>)>,
    /// Messages about utterances that could not be spoken.
    problems: Vec<String>,
}

impl PageBake {
    /// Creates a bake of the parts of a story that `known`, its existing bundle, does not contain.
    /// Files are omitted.
    pub fn new(requests: Vec<SpeechRequest>, known: Option<Bundle>) -> Self {
        let bundle = known.unwrap_or_default();
        Self {
            requests,
            next: 0,
            seen: bundle.utterances.iter().map(|u| u.key).collect(),
            words: 0,
            bundle,
            sounds: Vec::new(),
            problems: Vec::new(),
        }
    }

    /// Speaks the next utterance; returns false if there are no more. An engine error is recorded for
    /// `take_problems`, and the bake continues. If the engine is [`Pending`], the next call tries the
    /// same utterance again.
    ///
    /// # Errors
    /// Returns an error if no bundle can be created from the spoken text.
    pub fn step(&mut self, options: &BakeOptions) -> Result<bool> {
        while let Some(request) = self.requests.get(self.next) {
            let Source::Content(content) = &request.source else {
                self.next += 1;
                continue;
            };
            if content.words().is_empty() || self.seen.contains(&request.key) {
                self.next += 1;
                continue;
            }
            let words = words_of(content);
            if self.words + words > MAX_WORDS {
                self.problems.push(format!(
                    "more than {MAX_WORDS} words are not spoken on demand; bake the story"
                ));
                self.next = self.requests.len();
                return Ok(false);
            }
            match speak_one(request, content, self.next, options) {
                Ok(one) => {
                    let text = short(&content.plain_text());
                    let told = one.warnings.iter().map(|w| format!("{text:?}: {w}"));
                    self.problems.extend(told);
                    self.sounds.push((one.file, one.wave));
                    join(&mut self.bundle, one.bundle);
                }
                Err(error) if error.is::<Pending>() => return Ok(true),
                Err(error) => {
                    let text = short(&content.plain_text());
                    self.problems.push(format!("{text:?}: {error:#}"));
                }
            }
            self.seen.insert(request.key);
            self.words += words;
            self.next += 1;
            return Ok(true);
        }
        Ok(false)
    }

    /// Returns the text of the bundle, `speech.json`, with the known and the newly spoken
    /// utterances.
    pub fn bundle(&self) -> String {
        bundle_text::write(&self.bundle)
    }

    /// Returns the audio files synthesised since the last call: name and WAV bytes.
    pub fn take_sounds(&mut self) -> Vec<(String, Vec<u8>)> {
        std::mem::take(&mut self.sounds)
    }

    /// Returns the problems found since the last call.
    pub fn take_problems(&mut self) -> Vec<String> {
        std::mem::take(&mut self.problems)
    }
}

/// Planned and spoken utterance.
struct PendingUtterance {
    bundle: Bundle,
    /// The name and the bytes of its WAV.
    file: String,
    wave: Vec<u8>,
    /// Warnings about deviations from the author's request.
    warnings: Vec<String>,
}

fn speak_one(
    request: &SpeechRequest,
    content: &Content,
    place: usize,
    options: &BakeOptions,
) -> Result<PendingUtterance> {
    let wanted = planned::plan_utterance(request, content.clone(), place, Path::new(""), options)?;
    let work = speak::RenderInput {
        content: &wanted.content,
        role: &wanted.role,
        emotion: request.emotion.as_ref(),
        tension: request.tension,
        pace: options.pace,
    };
    let none = |_: f64| Ok(Vec::new());
    let track = speak::speak(&work, &wanted.casting, &options.cast, &none)?;
    let file = format!("{:016x}.wav", wanted.digest);
    let mut utterance = track.utterance;
    utterance.key = wanted.key;
    utterance.content = wanted.digest;
    utterance.audio = vec![AudioFile {
        file: file.clone(),
        mime: "audio/wav".to_owned(),
        digest: None,
    }];
    let wave = wave_of(&track.samples, track.rate_hz.round() as u32)?;
    let bundle = bundled(std::iter::once(Ok((&wanted, utterance))), &options.cast)?;
    Ok(PendingUtterance {
        bundle,
        file,
        wave,
        warnings: wanted.casting.warnings,
    })
}

/// Puts the utterances of another bundle behind a bundle's own. A voice is listed once.
fn join(known: &mut Bundle, new: Bundle) {
    let places: Vec<usize> = new
        .voices
        .into_iter()
        .map(|voice| {
            let there = known.voices.iter().position(|v| *v == voice);
            there.unwrap_or_else(|| {
                known.voices.push(voice);
                known.voices.len() - 1
            })
        })
        .collect();
    for utterance in new.utterances {
        let mut own = (*utterance).clone();
        own.voice = places.get(own.voice).copied().unwrap_or_default();
        known.utterances.push(own.into());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bake::engine::flite::{Flite, Host, Output};
    use crate::bake::{Cast, STORY_PACE};
    use crate::speech_requests;
    use crate::text::Lexicon;

    thread_local! {
        /// True if "Later" can be spoken.
        static READY: std::cell::Cell<bool> = const { std::cell::Cell::new(false) };
    }

    /// Test engine that says "cat" for every word, and fails on "bad".
    struct Cat;

    impl Host for Cat {
        fn run(&self, arguments: &[&str], files: &[(&str, &str)], sound: bool) -> Result<Output> {
            let text = files.first().map_or("", |f| f.1);
            anyhow::ensure!(!text.contains("bad"), "no such word");
            if text.contains("Later") && !READY.get() {
                return Err(Pending.into());
            }
            let words = text.split_whitespace().count();
            let printed = match arguments {
                ["--version"] => "flite-2.2-test".to_owned(),
                ["-lv"] => "Voices available: slt rms".to_owned(),
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
            cast: Cast::with_engine("flite", Box::new(Flite(Cat)), "slt").unwrap(),
            pace: STORY_PACE,
            lexicon: Lexicon::default(),
            lexicon_text: String::new(),
            jobs: 1,
            check: false,
        }
    }

    type Sounds = Vec<(String, Vec<u8>)>;

    /// Speaks a script: returns the bundle, the sounds and the problems.
    fn say(eml: &str, known: Option<Bundle>) -> (Bundle, Sounds, Vec<String>) {
        let options = options();
        let mut saying = PageBake::new(speech_requests(&raconteur_eml::parse(eml).document), known);
        while saying.step(&options).unwrap() {}
        let bundle = Bundle::from_json(saying.bundle().as_bytes()).unwrap();
        (bundle, saying.take_sounds(), saying.take_problems())
    }

    const TWO: &str = "<eml><body><voice-text time='0'>One two.</voice-text>\
        <voice-text time='9'>Three.</voice-text></body></eml>";

    #[test]
    fn what_is_said_has_its_phones_and_sound_and_is_not_said_twice() {
        let (bundle, sounds, problems) = say(TWO, None);
        assert!(problems.is_empty(), "{problems:?}");
        assert_eq!(bundle.utterances.len(), 2);
        for (utterance, (file, wave)) in bundle.utterances.iter().zip(&sounds) {
            assert_eq!(&utterance.audio[0].file, file);
            let phones = utterance.phones.iter().filter(|p| p.symbol != "pau");
            assert_eq!(phones.count(), 3 * utterance.words.len());
            let reader = hound::WavReader::new(&wave[..]).unwrap();
            let secs = f64::from(reader.duration()) / f64::from(reader.spec().sample_rate);
            assert!(
                (secs - utterance.duration_secs).abs() < 0.01,
                "the audio has the length of its utterance"
            );
        }
        let more = TWO.replace("</body>", "<voice-text time='20'>Four.</voice-text></body>");
        let (both, sounds, _) = say(&more, Some(bundle.clone()));
        assert_eq!(sounds.len(), 1);
        assert_eq!(both.utterances.len(), 3);
        assert_eq!(both.utterances[..2], bundle.utterances[..]);
        assert_eq!(both.voices, bundle.voices);
    }

    #[test]
    fn a_speaker_that_the_script_names_is_one_of_the_pages_voices() {
        let two = TWO
            .replace("<eml>", "<eml xmlns:r='urn:raconteur:eml:1'>")
            .replace("Three.", "<r:speaker name='rms'>Three.</r:speaker>");
        let (_, sounds, problems) = say(&two, None);
        assert!(problems.is_empty(), "{problems:?}");
        assert_eq!(sounds.len(), 2);
        // A missing voice is reported, and another speaks.
        let (_, sounds, problems) = say(&two.replace("'rms'", "'nobody'"), None);
        assert_eq!((sounds.len(), problems.len()), (2, 1));
        assert!(problems[0].contains("speaks instead"), "{problems:?}");
    }

    #[test]
    fn a_script_that_no_voice_reads_is_told_and_shown() {
        let two = TWO.replace("One two.", "One \u{5e9}\u{5dc}\u{5d5}\u{5dd} two.");
        let (bundle, sounds, problems) = say(&two, None);
        assert_eq!((sounds.len(), problems.len()), (2, 1), "{problems:?}");
        assert!(problems[0].contains("Hebrew letters"), "{problems:?}");
        let words: Vec<&str> = bundle.utterances[0]
            .words
            .iter()
            .map(|w| w.text.as_str())
            .collect();
        assert_eq!(words, ["One", "\u{5e9}\u{5dc}\u{5d5}\u{5dd}", "two."]);
    }

    #[test]
    fn what_cannot_be_said_is_told_and_the_rest_is_said() {
        let (_, sounds, problems) = say(&TWO.replace("One two.", "A bad one."), None);
        assert_eq!(sounds.len(), 1);
        assert!(problems[0].contains("no such word"), "{problems:?}");
        let file =
            "<eml><body><voice-say time='0' type='text' content='/etc/passwd'/></body></eml>";
        assert!(
            say(file, None).1.is_empty(),
            "rejected content speaks nothing"
        );
    }

    #[test]
    fn what_an_engine_gets_ready_for_is_said_when_it_is_ready() {
        let options = options();
        let late = TWO.replace("One two.", "Later.");
        let mut saying =
            PageBake::new(speech_requests(&raconteur_eml::parse(&late).document), None);
        for _ in 0..3 {
            assert!(
                saying.step(&options).unwrap(),
                "the engine is not ready yet"
            );
        }
        assert!(saying.take_sounds().is_empty(), "no audio is ready yet");
        READY.set(true);
        while saying.step(&options).unwrap() {}
        assert_eq!(saying.take_sounds().len(), 2);
        assert!(
            saying.take_problems().is_empty(),
            "no problem is reported yet"
        );
    }

    #[test]
    fn long_texts_are_told_and_not_said() {
        for long in ["word ".repeat(MAX_WORDS + 1), "x".repeat(MAX_WORDS + 1)] {
            let (_, sounds, problems) = say(&TWO.replace("Three", &long), None);
            assert_eq!(sounds.len(), 1);
            assert!(problems[0].contains("bake"), "{problems:?}");
        }
    }
}
