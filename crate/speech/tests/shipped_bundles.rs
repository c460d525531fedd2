//! Bundles shipped with the stories: complete, consistent with their stories, and with audio of the
//! specified duration. The test needs no speech engine.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use quick_xml::Reader;
use quick_xml::events::Event;
use raconteur_speech::bundle::FRAME_SECS;
use raconteur_speech::bundle::{SILENCE, SOUND};
use raconteur_speech::{Bundle, Utterance};

/// Lengths may differ by the rounding of the file's own clock.
const LENGTH_TOLERANCE_SECS: f64 = 0.002;

/// Folders of stories below a folder.
fn below(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.join("story.eml").is_file() {
            found.push(path);
        } else if path.is_dir() {
            below(&path, found);
        }
    }
}

fn stories() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/stories");
    let mut stories = Vec::new();
    below(&folder, &mut stories);
    stories.sort();
    // A dance to music without speech has no voice.
    let (spoken, silent): (Vec<PathBuf>, Vec<PathBuf>) = stories
        .into_iter()
        .partition(|story| !spoken_words(story).is_empty());
    assert!(spoken.len() >= 3, "{spoken:?}");
    for story in silent {
        assert!(!story.join("voice").exists(), "{}", story.display());
    }
    spoken
}

fn bundle(story: &Path) -> Bundle {
    let path = story.join("voice/speech.json");
    Bundle::from_json(&fs::read(&path).unwrap())
        .unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Returns the words of each voice-text, as shown to a reader of the story.
fn spoken_words(story: &Path) -> Vec<Vec<String>> {
    let source = fs::read_to_string(story.join("story.eml")).unwrap();
    let mut reader = Reader::from_str(&source);
    let (mut texts, mut open) = (Vec::new(), None::<String>);
    loop {
        match reader.read_event().unwrap() {
            Event::Eof => return texts,
            Event::Start(e) if e.name().as_ref() == "voice-text" => open = Some(String::new()),
            Event::End(e) if e.name().as_ref() == "voice-text" => {
                let text = open.take().unwrap();
                let mut words: Vec<String> = Vec::new();
                let is_emoticon = |token: &&str| token.starts_with([':', ';']) && token.len() > 1;
                for token in text.split_whitespace().filter(|t| !is_emoticon(t)) {
                    // Isolated signs are shown with the preceding word.
                    match words
                        .last_mut()
                        .filter(|_| !token.contains(char::is_alphanumeric))
                    {
                        Some(word) => *word += &format!(" {token}"),
                        None => words.push(token.to_owned()),
                    }
                }
                texts.push(words);
            }
            // Sentences and breaks part words; marks and emphasis do not.
            Event::Start(e) if e.name().as_ref() == "div" => {
                open.iter_mut().for_each(|t| t.push(' '));
            }
            Event::Empty(e) if e.name().as_ref() == "break" => {
                open.iter_mut().for_each(|t| t.push(' '));
            }
            Event::Text(e) => open.iter_mut().for_each(|t| t.push_str(&e)),
            _ => {}
        }
    }
}

fn words(utterance: &Utterance) -> Vec<String> {
    utterance.words.iter().map(|w| w.text.clone()).collect()
}

/// Returns the length of an Ogg Opus file: the position of the last page, less the samples that a
/// player skips (RFC 7845, sections 4 and 5.1), at 48 kHz.
fn opus_secs(bytes: &[u8]) -> f64 {
    let (mut at, mut last, mut skip) = (0, 0_u64, None);
    while at + 27 <= bytes.len() {
        assert_eq!(&bytes[at..at + 4], b"OggS");
        last = u64::from_le_bytes(bytes[at + 6..at + 14].try_into().unwrap());
        let lacing = usize::from(bytes[at + 26]);
        let body = at + 27 + lacing;
        if skip.is_none() {
            assert_eq!(&bytes[body..body + 8], b"OpusHead");
            assert_eq!(bytes[body + 9], 1, "one channel");
            skip = Some(u64::from(u16::from_le_bytes([
                bytes[body + 10],
                bytes[body + 11],
            ])));
        }
        at = body
            + bytes[at + 27..body]
                .iter()
                .map(|l| usize::from(*l))
                .sum::<usize>();
    }
    assert_eq!(at, bytes.len(), "the file ends inside a page");
    (last - skip.unwrap()) as f64 / 48_000.0
}

/// Returns the length of a mono MPEG-1 layer III file from its Xing or Info header: frames, less
/// the delay and padding that the LAME extension tells players to drop. A file without them would
/// play late.
fn mp3_secs(bytes: &[u8]) -> f64 {
    assert_eq!(bytes[0], 0xff);
    assert_eq!(bytes[1] & 0xfe, 0xfa, "MPEG-1 layer III");
    let rate = [44_100.0, 48_000.0, 32_000.0][usize::from(bytes[2] >> 2 & 3)];
    assert_eq!(bytes[3] >> 6, 3, "one channel");
    // Mono: preceded by 4 bytes of header and 17 of side information.
    let info = &bytes[21..];
    assert!(
        &info[..4] == b"Xing" || &info[..4] == b"Info",
        "the file has a Xing or Info header"
    );
    assert_eq!(info[7], 0x0f, "frames, bytes, table and quality are there");
    let frames = u32::from_be_bytes(info[8..12].try_into().unwrap());
    let lame = &info[120..];
    assert!(
        &lame[..4] == b"LAME" || &lame[..4] == b"Lavf" || &lame[..4] == b"Lavc",
        "the file has the tag of an encoder"
    );
    let delay = u32::from(lame[21]) << 4 | u32::from(lame[22]) >> 4;
    let padding = u32::from(lame[22] & 15) << 8 | u32::from(lame[23]);
    assert!(delay > 0, "a gapless header");
    f64::from(frames * 1152 - delay - padding) / rate
}

#[test]
fn every_voice_text_has_its_utterance_and_none_is_left_over() {
    for story in stories() {
        let said = spoken_words(&story);
        let bundle = bundle(&story);
        for text in &said {
            assert!(
                bundle.utterances.iter().any(|u| words(u) == *text),
                "{story:?}: {text:?}"
            );
        }
        let keys: BTreeSet<_> = bundle.utterances.iter().map(|u| &u.key).collect();
        assert_eq!(
            keys.len(),
            bundle.utterances.len(),
            "{story:?}: a key twice"
        );
    }
}

#[test]
fn phones_tile_the_utterance_and_words_are_made_of_phones() {
    for story in stories() {
        for utterance in bundle(&story).utterances {
            let text = &utterance.text;
            let mut end_secs = 0.0;
            for phone in &utterance.phones {
                assert_eq!(phone.start_secs, end_secs, "{text}");
                assert!(
                    phone.end_secs > phone.start_secs,
                    "{text}: an empty {}",
                    phone.symbol
                );
                let silent = [SILENCE, SOUND].contains(&phone.symbol.as_str());
                assert_eq!(phone.word.is_none(), silent, "{text}");
                end_secs = phone.end_secs;
            }
            assert_eq!(end_secs, utterance.duration_secs, "{text}");
            for edge in [utterance.phones.first(), utterance.phones.last()] {
                assert_eq!(
                    edge.unwrap().symbol,
                    "pau",
                    "{text} begins or ends in speech"
                );
            }
            for (i, word) in utterance.words.iter().enumerate() {
                let mut of_word = utterance.phones.iter().filter(|p| p.word == Some(i));
                let Some(first) = of_word.next() else {
                    panic!("{text}: {} has no sound", word.text);
                };
                let last = of_word.next_back().unwrap_or(first);
                assert_eq!(
                    (word.start_secs, word.end_secs),
                    (first.start_secs, last.end_secs),
                    "{text}"
                );
            }
        }
    }
}

#[test]
fn sound_files_are_there_last_as_long_as_they_should_and_no_other_is() {
    for story in stories() {
        let bundle = bundle(&story);
        let mut files = BTreeSet::from(["speech.json".to_owned()]);
        for utterance in &bundle.utterances {
            let mimes: Vec<&str> = utterance.audio.iter().map(|a| a.mime.as_str()).collect();
            assert_eq!(
                mimes,
                ["audio/ogg; codecs=opus", "audio/mpeg"],
                "{}",
                utterance.text
            );
            for (audio, measure) in utterance.audio.iter().zip([opus_secs, mp3_secs]) {
                let secs = measure(&fs::read(story.join("voice").join(&audio.file)).unwrap());
                assert!(
                    (secs - utterance.duration_secs).abs() < LENGTH_TOLERANCE_SECS,
                    "{} lasts {secs} s, not {} s",
                    audio.file,
                    utterance.duration_secs
                );
                files.insert(audio.file.clone());
            }
        }
        let found: BTreeSet<String> = fs::read_dir(story.join("voice"))
            .unwrap()
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        assert_eq!(found, files);
    }
}

#[test]
fn every_utterance_tells_its_melody_syllables_phrases_and_sentences() {
    for story in stories() {
        let bundle = bundle(&story);
        for utterance in &bundle.utterances {
            let text = &utterance.text;
            let frames = (utterance.duration_secs / FRAME_SECS).floor() as usize + 1;
            assert_eq!(utterance.f0.len(), frames, "{text}");
            assert_eq!(utterance.intensity.len(), frames, "{text}");
            let words = utterance.words.len();
            let of_phrases: usize = utterance.phrases.iter().map(|p| p.words).sum();
            let of_sentences: usize = utterance.sentences.iter().map(|s| s.words).sum();
            assert_eq!((of_phrases, of_sentences), (words, words), "{text}");
            let voice = &bundle.voices[utterance.voice];
            for syllable in &utterance.syllables {
                let phones = syllable.first_phone..syllable.first_phone + syllable.phones;
                let voiced = utterance.phones[phones].iter().all(|p| p.word.is_some());
                assert!(voiced, "{text}: a syllable of silence");
            }
            for phone in utterance.phones.iter().filter(|p| p.word.is_some()) {
                let row = voice.phone_row(&phone.symbol);
                assert_eq!(row, Some(phone.row), "{text}: {}", phone.symbol);
            }
        }
    }
}

#[test]
fn a_story_is_told_at_a_storytellers_pace() {
    for story in stories() {
        let bundle = bundle(&story);
        let words: usize = bundle.utterances.iter().map(|u| u.words.len()).sum();
        let secs: f64 = bundle.utterances.iter().map(|u| u.duration_secs).sum();
        // Two words are no measure of pace.
        if words > 20 {
            let a_minute = words as f64 / secs * 60.0;
            // Verse rests at the ends of its lines.
            let verse = story.components().any(|c| c.as_os_str() == "virtual-poets");
            let pace = if verse { 90.0..185.0 } else { 130.0..185.0 };
            assert!(
                pace.contains(&a_minute),
                "{story:?}: {a_minute:.0} words a minute"
            );
        }
    }
}
