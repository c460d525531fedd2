//! ANVIL: round trips of random transcriptions, ANVIL's own rules, encodings, and malformed files.

use proptest::prelude::*;
use raconteur_annotate::gestura::{Level, Transcription};
use raconteur_annotate::{anvil, encoding, read_transcription, xml};
use raconteur_eml::{Diagnostic, Severity, Span};

/// A small annotation with every track.
const SMALL: &str = include_str!("files/small.anvil");

fn without_places(mut transcription: Transcription) -> Transcription {
    let nowhere = Span::default();
    transcription
        .words
        .iter_mut()
        .for_each(|word| word.span = nowhere);
    transcription
        .utterances
        .iter_mut()
        .for_each(|utterance| utterance.span = nowhere);
    transcription
        .levels
        .iter_mut()
        .for_each(|level| level.span = nowhere);
    transcription
        .gestures
        .iter_mut()
        .for_each(|gesture| gesture.span = nowhere);
    transcription
        .prosody
        .iter_mut()
        .for_each(|prosody| prosody.span = nowhere);
    transcription
        .staging
        .iter_mut()
        .for_each(|event| event.span = nowhere);
    for layer in &mut transcription.layers {
        layer
            .phases
            .iter_mut()
            .for_each(|phase| phase.span = nowhere);
        layer
            .phrases
            .iter_mut()
            .for_each(|phrase| phrase.span = nowhere);
    }
    transcription
}

fn specification() -> anvil::Specification {
    let mut problems = Vec::new();
    let root = xml::parse(anvil::GESTURA, &mut problems).expect("the specification");
    assert_eq!(problems, [], "the specification is well-formed");
    anvil::Specification::read(&root)
}

fn read(text: &str) -> (anvil::Annotation, Vec<Diagnostic>) {
    let mut problems = Vec::new();
    let root = xml::parse(text, &mut problems).expect("an element");
    (anvil::read(&root, &mut problems), problems)
}

proptest! {
    #[test]
    fn transcriptions_are_read_as_they_were_written(transcription in crate::random::transcription()) {
        let text = anvil::write(&anvil::from_transcription(&transcription));
        let (annotation, mut problems) = read(&text);
        let again = anvil::to_transcription(&annotation, &mut problems);
        let errors: Vec<_> = problems.iter().filter(|p| p.code != "gestura::no-track").collect();
        prop_assert!(errors.is_empty(), "{:?}\n{}", errors, text);
        prop_assert_eq!(without_places(again), transcription);
        // The files follow ANVIL's rules and the specification that they name.
        let broken = anvil::check(&annotation, &specification());
        prop_assert!(broken.is_empty(), "{:?}\n{}", broken, text);
        prop_assert_eq!(anvil::write(&annotation), text);
    }
}

#[test]
fn a_small_file_is_read_without_a_complaint() {
    let read = read_transcription(SMALL.as_bytes(), None);
    assert_eq!(read.diagnostics, []);
    let transcription = &read.transcription;
    assert_eq!(transcription.words.len(), 4);
    assert_eq!(transcription.levels[0].level, Level::Narrative);
    assert_eq!(transcription.layers[0].phrases[0].phases, 0..=2);
    assert_eq!(transcription.coder.as_deref(), Some("demo"));
}

#[test]
fn every_encoding_of_anvil_is_read() {
    let units = |big: bool| {
        let unit = move |u: u16| {
            if big {
                u.to_be_bytes()
            } else {
                u.to_le_bytes()
            }
        };
        let text = format!("\u{feff}{}", SMALL.replace("UTF-8", "UTF-16"));
        text.encode_utf16().flat_map(unit).collect::<Vec<u8>>()
    };
    let latin = SMALL.replace("UTF-8", "ISO-8859-1");
    let latin: Vec<u8> = latin
        .chars()
        .map(|c| u8::try_from(c).expect("Latin-1"))
        .collect();
    let expected = read_transcription(SMALL.as_bytes(), None).transcription;
    for bytes in [
        units(false),
        units(true),
        latin,
        format!("\u{feff}{SMALL}").into_bytes(),
    ] {
        let found = read_transcription(&bytes, None);
        assert_eq!(found.diagnostics, []);
        assert_eq!(
            without_places(found.transcription),
            without_places(expected.clone())
        );
    }
}

#[test]
fn span_singleton_and_subdivision_tracks_have_the_times_of_their_parents() {
    let text = "<annotation><body>\
        <track name='words' type='primary'><el index='0' start='1' end='2'/><el index='1' start='2' \
        end='3'/><el index='2' start='3' end='4'/></track>\
        <track name='spans' type='span' ref='words'><el index='0' start='1' end='2'/></track>\
        <track name='gestures' type='singleton' ref='spans'><el index='0' ref='0'><attribute \
        name='type'>emblem</attribute></el></track>\
        <track name='gesticulation.phases.layer1' type='subdivision' ref='words'><el index='0' \
        start='1.2' end='1.5'><attribute name='phase'>stroke</attribute></el></track>\
        </body></annotation>";
    let (annotation, mut problems) = read(text);
    let transcription = anvil::to_transcription(&annotation, &mut problems);
    assert_eq!(problems, []);
    let gesture = transcription.gestures[0].interval;
    assert_eq!((gesture.start_secs, gesture.end_secs), (2.0, 4.0));
    let phase = transcription.layers[0].phases[0].interval;
    assert_eq!((phase.start_secs, phase.end_secs), (1.2, 1.5));
}

/// Problem codes of the small file with a replacement.
fn codes(from: &str, to: &str) -> Vec<&'static str> {
    assert!(SMALL.contains(from), "{from} is in the file");
    let read = read_transcription(SMALL.replacen(from, to, 1).as_bytes(), None);
    for problem in &read.diagnostics {
        assert!(
            !problem.span.slice(&read.text).is_empty(),
            "{problem:?} has a place"
        );
    }
    read.diagnostics
        .iter()
        .map(|problem| problem.code)
        .collect()
}

#[test]
fn faults_are_told_at_their_place() {
    assert_eq!(
        codes("[[0;[-6;12;11]];[100%", "[[0;[-6;12;11]];[200%"),
        ["gsl::offset"]
    );
    assert_eq!(codes(">narrative<", ">story<"), ["gestura::value"]);
    assert_eq!(codes(">stroke<", ">strike<")[0], "gestura::value");
    assert_eq!(codes(">metaphoric<", ">beat<"), [""; 0]);
    assert_eq!(
        codes("confidence-level\">4", "confidence-level\">5"),
        ["gestura::value"]
    );
    assert_eq!(
        codes("start=\"0\" end=\"3\"", "start=\"0\" end=\"9\"")[0],
        "gestura::outside-parent"
    );
    assert_eq!(
        codes("start=\"0.95\"", "start=\"late\"")[0],
        "anvil::number"
    );
    assert_eq!(codes("end=\"1.60\"", "end=\"0.60\"")[0], "anvil::order");
    assert_eq!(
        codes("[[-9;2;6];[-6;12;11]]", "a slow rise"),
        ["gestura::informal"]
    );
}

#[test]
fn a_subdivision_lies_in_an_element_of_its_parent() {
    let text = |start: &str| {
        format!(
            "<annotation><body><track name='gestures' type='primary'><el index='0' start='1' \
             end='4'><attribute name='type'>gesticulation</attribute></el><el index='1' start='2' \
             end='2.5'><attribute name='type'>gesticulation</attribute></el></track><track \
             name='gesticulation.phases.layer1' type='subdivision' ref='gestures'><el index='0' \
             start='{start}' end='3'><attribute name='phase'>stroke</attribute></el></track></body>\
             </annotation>"
        )
    };
    let outside = |start: &str| {
        let read = read_transcription(text(start).as_bytes(), None);
        let outside = read.diagnostics.iter();
        outside
            .filter(|d| d.code == "gestura::outside-parent")
            .count()
    };
    assert_eq!(["2.6", "1", "0.9"].map(outside), [0, 0, 1]);
}

#[test]
fn a_phase_has_a_length() {
    let read = |end: &str| {
        let text = format!(
            "<annotation><body><track name='gesticulation.phases.layer1' type='primary'><el \
             start='1' end='{end}'><attribute name='phase'>stroke</attribute></el></track></body>\
             </annotation>"
        );
        let problems = read_transcription(text.as_bytes(), None).diagnostics;
        problems.iter().any(|d| d.code == "gestura::no-length")
    };
    assert_eq!(["1", "1.2"].map(read), [true, false]);
}

/// Copies of a file with a part removed or replaced.
fn malformed(text: &str) -> Vec<String> {
    let step = text.len() / 160;
    let starts = (0..text.len())
        .step_by(step)
        .filter(|&at| text.is_char_boundary(at));
    let mut out = Vec::new();
    for at in starts {
        let end = (at + 7..).find(|&end| end >= text.len() || text.is_char_boundary(end));
        let rest = text.get(end.unwrap_or(text.len())..).unwrap_or("");
        out.push(text[..at].to_owned());
        for insert in ["", "<", "&", "\"", "]", "é\0", "</el>", "<el>"] {
            out.push(format!("{}{insert}{rest}", &text[..at]));
        }
    }
    out
}

#[test]
fn malformed_files_lose_no_more_than_they_must_and_say_where() {
    let mut told = 0;
    for text in malformed(SMALL) {
        let read = read_transcription(text.as_bytes(), None);
        let errors = read
            .diagnostics
            .iter()
            .filter(|d| d.severity == Severity::Error);
        for error in errors {
            let index = raconteur_eml::LineIndex::new(&read.text);
            let place = index.position(error.span.start);
            assert!(place.line >= 1 && place.column >= 1, "{error:?}");
            assert!(
                error.span.end as usize <= read.text.len(),
                "{error:?} in {text}"
            );
            told += 1;
        }
    }
    assert!(told > 300, "only {told} errors were told");
}

#[test]
fn cycles_of_references_end() {
    let text = "<annotation><body><track name='words' type='span' ref='gestures'><el start='0' \
                end='0'/></track><track name='gestures' type='span' ref='words'><el start='0' \
                end='0'/></track></body></annotation>";
    let (annotation, mut problems) = read(text);
    let transcription = anvil::to_transcription(&annotation, &mut problems);
    assert_eq!(transcription.words.len(), 0);
    assert_eq!(problems[0].code, "gestura::outside-parent");
    assert!(
        anvil::write(&annotation).contains("words"),
        "a cycle is written, too"
    );
}

proptest! {
    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = encoding::decode(&bytes);
        let _ = read_transcription(&bytes, None);
    }
}
