//! Bundle text: JSON that a person can read and a version control system can compare, one block per
//! utterance, one line per list.

use core::fmt::Write as _;

use raconteur_speech::bundle::{Bundle, SentenceKind, Utterance, VERSION, Voice, to_base64};
use serde_json::Value;

/// Writes a bundle; [`Bundle::from_json`] reads it again.
pub(super) fn write(bundle: &Bundle) -> String {
    let mut out = format!("{{\n  \"format\": \"raconteur-speech\",\n  \"version\": {VERSION},\n");
    let voices: Vec<String> = bundle.voices.iter().map(voice).collect();
    let utterances: Vec<String> = bundle.utterances.iter().map(|u| utterance(u)).collect();
    let _ = writeln!(out, "  \"voices\": [{}\n  ],", voices.join(","));
    let _ = writeln!(out, "  \"utterances\": [{}\n  ]\n}}", utterances.join(","));
    out
}

fn text(text: &str) -> String {
    Value::from(text).to_string()
}

fn voice(voice: &Voice) -> String {
    format!(
        "\n    {{\"engine\": {}, \"voice\": {}, \"language\": {}, \"phone_set\": {}{}}}",
        text(&voice.engine),
        text(&voice.voice),
        text(&voice.language),
        text(&voice.phone_set),
        mouth(voice)
    )
}

/// Returns the JSON member with the mouth's rows, if any has another name.
fn mouth(voice: &Voice) -> String {
    let pairs: Vec<String> = voice
        .mouth
        .iter()
        .map(|(symbol, row)| format!("{symbol} {row}"))
        .collect();
    if pairs.is_empty() {
        String::new()
    } else {
        format!(", \"mouth\": {}", text(&pairs.join(" ")))
    }
}

/// Converts seconds to whole milliseconds.
fn msec(secs: f64) -> u64 {
    (secs * 1000.0).round().max(0.0) as u64
}

fn list(items: impl Iterator<Item = String>) -> String {
    format!("[{}]", items.collect::<Vec<_>>().join(", "))
}

fn utterance(u: &Utterance) -> String {
    let phones: Vec<&str> = u.phones.iter().map(|p| p.symbol.as_str()).collect();
    let lengths = u
        .phones
        .iter()
        .map(|p| (msec(p.end_secs) - msec(p.start_secs)).to_string());
    let fields = [
        ("key", format!("\"{:016x}\"", u.key)),
        ("content", format!("\"{:016x}\"", u.content)),
        (
            "source",
            u.source.map_or(String::new(), |s| format!("\"{s:016x}\"")),
        ),
        ("voice", u.voice.to_string()),
        ("text", text(&u.text)),
        ("audio", audio(u)),
        ("words", words(u)),
        ("phones", text(&phones.join(" "))),
        ("msecs", list(lengths)),
        ("syllables", syllables(u)),
        ("phrases", phrases(u)),
        ("sentences", sentences(u)),
        ("emotions", emotions(u)),
        ("f0", text(&to_base64(&u.f0))),
        ("intensity", text(&to_base64(&u.intensity))),
    ];
    let lines: Vec<String> = fields
        .iter()
        .filter(|(name, value)| !(value.is_empty() || *name == "emotions" && value == "[]"))
        .map(|(name, value)| format!("      \"{name}\": {value}"))
        .collect();
    format!("\n    {{\n{}\n    }}", lines.join(",\n"))
}

fn audio(u: &Utterance) -> String {
    list(u.audio.iter().map(|a| {
        let holds = a.digest.as_ref().map_or(String::new(), |h| {
            format!(", \"bytes\": {}, \"sha256\": {}", h.bytes, text(&h.sha256))
        });
        format!(
            "{{\"file\": {}, \"mime\": {}{holds}}}",
            text(&a.file),
            text(&a.mime)
        )
    }))
}

fn words(u: &Utterance) -> String {
    list(u.words.iter().enumerate().map(|(i, word)| {
        let of = |p: &raconteur_speech::Phone| p.word == Some(i);
        let first = u.phones.iter().position(of);
        let last = u.phones.iter().rposition(of);
        let (first, count) = first
            .zip(last)
            .map_or((0, 0), |(first, last)| (first, last + 1 - first));
        let start = u.text_starts.get(i).copied().unwrap_or(0);
        format!("[{start}, {}, {first}, {count}]", word.text.len())
    }))
}

fn syllables(u: &Utterance) -> String {
    list(u.syllables.iter().enumerate().map(|(i, s)| {
        let accent = u.accents.iter().find(|a| a.syllable == i);
        let label = text(accent.map_or("", |a| a.label.as_str()));
        format!("[{label}, {}, {}, {}]", s.first_phone, s.phones, s.stress)
    }))
}

fn phrases(u: &Utterance) -> String {
    list(
        u.phrases
            .iter()
            .map(|p| format!("[{}, {}]", text(&p.tone), p.words)),
    )
}

fn sentences(u: &Utterance) -> String {
    list(u.sentences.iter().map(|s| {
        let mark = SentenceKind::MARKS.iter().find(|(kind, _)| *kind == s.kind);
        let mark = text(mark.map_or(".", |(_, mark)| mark));
        format!("[{mark}, {}]", s.words)
    }))
}

fn emotions(u: &Utterance) -> String {
    list(u.emotions.iter().map(|e| {
        format!(
            "[{}, {}, {}, {}, {}, {}, {}]",
            text(&e.name),
            msec(e.start_secs),
            msec(e.apex_secs),
            msec(e.end_secs),
            e.activation,
            e.evaluation,
            e.power
        )
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    use raconteur_speech::bundle::{
        Accent, AudioFile, Emotion, FileDigest, Phone, Phrase, Sentence, Syllable, Word,
    };

    /// Returns an utterance with a value in every field.
    fn utterance() -> Utterance {
        let word = |text: &str, start_secs, end_secs| Word {
            text: text.to_owned(),
            start_secs,
            end_secs,
            emphasized: false,
        };
        Utterance {
            key: 0x0123_4567_89ab_cdef,
            content: 7,
            source: Some(u64::MAX),
            voice: 1,
            text: "\u{201c}Hi\u{201d} \\ \"you\"".to_owned(),
            duration_secs: 1.234,
            audio: vec![AudioFile {
                file: "a.opus".to_owned(),
                mime: "audio/ogg; codecs=opus".to_owned(),
                digest: Some(FileDigest {
                    bytes: 1 << 40,
                    sha256: "0a".repeat(32),
                }),
            }],
            words: vec![
                word("\u{201c}Hi\u{201d}", 0.1, 0.3),
                word("\"you\"", 0.3, 1.2),
            ],
            text_starts: vec![0, 11],
            phones: vec![
                Phone::new("pau", 0.0, 0.1, None),
                Phone::new("ay", 0.1, 0.3, Some(0)),
                Phone::new("y", 0.3, 0.4, Some(1)),
                Phone::new("uw", 0.4, 1.2, Some(1)),
                Phone::new("pau", 1.2, 1.234, None),
            ],
            syllables: vec![
                Syllable {
                    first_phone: 1,
                    phones: 1,
                    stress: 1,
                },
                Syllable {
                    first_phone: 2,
                    phones: 2,
                    stress: 0,
                },
            ],
            accents: vec![Accent {
                syllable: 1,
                label: "L+H*".to_owned(),
            }],
            phrases: vec![Phrase {
                first_word: 0,
                words: 2,
                tone: "L-L%".to_owned(),
            }],
            sentences: vec![Sentence {
                first_word: 0,
                words: 2,
                kind: SentenceKind::Question,
            }],
            emotions: vec![Emotion {
                name: "joy".to_owned(),
                start_secs: 0.1,
                apex_secs: 0.3,
                end_secs: 1.2,
                activation: 17.3,
                evaluation: -42.25,
                power: 0.0,
            }],
            f0: vec![0, 1, 255],
            intensity: vec![3, 2],
        }
    }

    #[test]
    fn what_is_written_is_read_again() {
        let utterance = utterance();
        let voice = |engine: &str| Voice {
            engine: engine.to_owned(),
            voice: "v".to_owned(),
            language: "en-US".to_owned(),
            phone_set: "radio".to_owned(),
            mouth: vec![("i:".to_owned(), "iy".to_owned())],
        };
        let mut untold = utterance.clone();
        untold.source = None;
        untold.audio[0].digest = None;
        for utterances in [vec![], vec![utterance.clone()], vec![utterance, untold]] {
            let utterances = utterances.into_iter().map(Arc::new).collect();
            let bundle = Bundle {
                voices: vec![voice("e"), voice("f")],
                utterances,
            };
            let text = write(&bundle);
            assert_eq!(
                Bundle::from_json(text.as_bytes()).unwrap(),
                bundle,
                "{text}"
            );
        }
    }
}
