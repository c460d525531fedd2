//! Sample documents of SABLE and SSML, each with its expected speech: `tests/markup`.
//!
//! A line of `NAME.expected` is a word with its style's differences from the voice's own (`*` is a
//! factor, a number before it a value), something between words, or `!` and a problem. `UPDATE=1`
//! rewrites the files.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use raconteur_speech::emotion::EmotionPoint;
use raconteur_voice::content::{Boundary, Content, Division};
use raconteur_voice::markup::{Problem, levels, sable, ssml};
use raconteur_voice::resolve::{Item, Resolved, resolve};
use raconteur_voice::style::{Amount, Style};

/// Written with few digits: sums of factors have long tails.
fn short(x: f64) -> String {
    let text = format!("{x:.12}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn amount(out: &mut String, name: &str, amount: Amount) {
    if !amount.is_default() {
        let value = amount.value.map(short).unwrap_or_default();
        write!(out, " {name}={value}*{}", short(amount.factor)).unwrap();
    }
}

fn style_text(style: &Style) -> String {
    let own = Style::default();
    let mut out = String::new();
    if style.emphasis != own.emphasis {
        write!(out, " emphasis={}", short(style.emphasis)).unwrap();
    }
    amount(&mut out, "base", style.pitch_base);
    amount(&mut out, "middle", style.pitch_middle);
    amount(&mut out, "range", style.pitch_range);
    amount(&mut out, "rate", style.rate);
    if style.volume != own.volume {
        write!(out, " volume={}", short(style.volume)).unwrap();
    }
    let mut word = |name: &str, value: Option<String>| {
        if let Some(value) = value {
            write!(out, " {name}={value}").unwrap();
        }
    };
    word("as", style.say_as.as_ref().map(|kind| format!("{kind:?}")));
    word("ipa", style.ipa.clone());
    word("instead", style.instead.clone());
    word("language", style.language.clone());
    word("gender", style.speaker.gender.map(|g| format!("{g:?}")));
    word("age", style.speaker.age.map(|a| format!("{a:?}")));
    word("speaker", style.speaker.name.clone());
    let emotion = style.emotion.as_ref();
    word(
        "emotion",
        emotion.map(|(name, point)| emotion_text(name, point)),
    );
    out
}

/// Its name, then activation, evaluation and power.
fn emotion_text(name: &str, point: &EmotionPoint) -> String {
    let EmotionPoint {
        activation,
        evaluation,
        power,
    } = point;
    format!("{name}({activation} {evaluation} {power})")
}

fn item_text(item: &Item, resolved: &Resolved) -> String {
    match item {
        Item::Word {
            text,
            style,
            together,
            ..
        } => {
            let one = if together.is_some() { " together" } else { "" };
            format!("{text}{}{one}", style_text(&resolved.styles[*style]))
        }
        Item::Punctuation(text) => format!("punctuation {text}"),
        Item::Emoticon(word) => format!("emoticon {word}"),
        Item::Break { msec, boundary } => {
            let sign = boundary.map_or("", |b: Boundary| levels::boundary_sign(b));
            format!("break {msec} {sign}").trim_end().to_owned()
        }
        Item::Division(Division::Sentence) => "division sentence".to_owned(),
        Item::Division(Division::Paragraph) => "division paragraph".to_owned(),
        Item::Audio {
            src,
            background,
            level,
        } => {
            let mode = if *background {
                "background"
            } else {
                "insertion"
            };
            format!("audio {src} {mode} {}", short(*level))
        }
        Item::Mark(name) => format!("mark {name}"),
    }
}

fn spoken_words(content: &Content) -> String {
    let resolved = resolve(content, "festival");
    let lines = resolved
        .items
        .iter()
        .map(|i| item_text(i, &resolved) + "\n");
    lines.collect()
}

type Read = fn(&str) -> Result<(Content, Vec<Problem>), Problem>;

fn reader(path: &Path) -> Option<Read> {
    match path.extension()?.to_str()? {
        "sable" => Some(sable::read),
        "ssml" => Some(ssml::read),
        _ => None,
    }
}

#[test]
fn documents_say_what_is_expected_and_survive_writing() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/markup");
    let mut paths: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    let mut count = 0;
    for path in paths {
        let Some(read) = reader(&path) else {
            continue;
        };
        count += 1;
        let name = path.display();
        let source = fs::read_to_string(&path).unwrap();
        let (content, problems) = read(&source).unwrap_or_else(|p| panic!("{name}:{p}"));
        let said = spoken_words(&content);
        let told: String = problems.iter().map(|p| format!("! {p}\n")).collect();
        let beside = path.with_extension("expected");
        if std::env::var_os("UPDATE").is_some() {
            fs::write(&beside, said.clone() + &told).unwrap();
        }
        let expected = fs::read_to_string(&beside).unwrap();
        assert_eq!(said.clone() + &told, expected, "{name}");
        for (language, written) in [
            ("SABLE", sable::read(&sable::write(&content))),
            ("SSML", ssml::read(&ssml::write(&content, "en"))),
        ] {
            let (again, problems) = written.unwrap_or_else(|p| panic!("{name}: {p}"));
            assert_eq!(spoken_words(&again), said, "{name} by {language}");
            assert_eq!(problems, [], "{name} by {language}");
        }
        // Line ends and a byte order mark change nothing.
        let windows = format!("\u{feff}{}", source.replace('\n', "\r\n"));
        assert_eq!(spoken_words(&read(&windows).unwrap().0), said, "{name}");
    }
    assert!(count >= 5, "{count} documents");
}

#[test]
fn what_is_no_document_is_refused_with_its_place() {
    let place = |result: Result<(Content, Vec<Problem>), Problem>| {
        let problem = result.unwrap_err();
        (problem.line, problem.column)
    };
    for (text, at) in [
        ("<SABLE>\n <EMPH>a</RATE></SABLE>", (2, 9)),
        ("<SABLE>\n\u{e9}\u{e9}&nbsp;</SABLE>", (2, 3)),
        (
            "<!DOCTYPE SABLE [<!ENTITY a 'b'>]><SABLE>&a;</SABLE>",
            (1, 1),
        ),
        ("<SABLE>a", (1, 9)),
        ("a</SABLE>", (1, 2)),
        ("a\n<EMPH LEVEL=x>", (2, 1)),
        ("a <EMPH LEVEL='1' LEVEL='2'/>", (1, 3)),
        ("&#0;", (1, 1)),
    ] {
        assert_eq!(place(sable::read(text)), at, "{text}");
    }
    assert_eq!(place(ssml::read("<speak>\n<S>a</s></speak>")), (2, 5));
}

#[test]
fn sizes_are_bounded() {
    let nested = |n: usize| format!("{}a{}", "<EMPH>".repeat(n), "</EMPH>".repeat(n));
    assert!(
        sable::read(&nested(100)).is_ok(),
        "100 nested elements are accepted"
    );
    let problem = sable::read(&nested(101)).unwrap_err();
    assert_eq!((problem.line, problem.column), (1, 601));
    let deep = |n: usize| format!("{}a{}", "<x>".repeat(n), "</x>".repeat(n));
    assert!(
        sable::read(&deep(300)).is_ok() && sable::read(&deep(500)).is_err(),
        "the limit of unknown elements is between 300 and 500"
    );
    assert!(
        sable::read(&"a".repeat(raconteur_voice::markup::MAX_DOCUMENT_BYTES)).is_ok(),
        "a document of the maximum size is accepted"
    );
    assert!(
        sable::read(&"a".repeat(raconteur_voice::markup::MAX_DOCUMENT_BYTES + 1)).is_err(),
        "a document beyond the maximum size is rejected"
    );
    assert!(
        ssml::read(&"<break/>".repeat(60_000)).is_err(),
        "60000 breaks are rejected"
    );
    let long = format!("<PRON SUB='{}'>a</PRON>", "b".repeat(2000));
    let (content, problems) = sable::read(&long).unwrap();
    assert_eq!((content.words(), problems.len()), (vec!["a".to_owned()], 2));
    let (_, problems) = sable::read(&"<x/>".repeat(1000)).unwrap();
    assert_eq!(problems.len(), 100);
}

#[test]
fn what_stands_for_a_recording_is_said_where_there_is_none() {
    let text =
        "<speak>Listen. <audio src='bell.mp3'>A bell rang.</audio> <audio src='a.wav'/></speak>";
    let (content, problems) = ssml::read_beside(text, &|_| false).unwrap();
    assert_eq!(content.words().join(" "), "Listen. A bell rang.");
    assert_eq!(problems.len(), 1, "{problems:?}");
    assert!(
        problems[0].to_string().contains("bell.mp3"),
        "the problem names the missing recording"
    );
    let (content, problems) = ssml::read_beside(text, &|_| true).unwrap();
    assert_eq!(content.words(), ["Listen."]);
    assert!(
        problems.is_empty(),
        "an existing recording causes no problem"
    );
}
