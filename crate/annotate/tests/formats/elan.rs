//! ELAN: a file written by pympi, one with slots without times and a vocabulary, mappings, and
//! malformed files.

use raconteur_annotate::elan::{self, Elan, Mapping};
use raconteur_annotate::gestura::{Dimension, PhaseKind, Transcription};
use raconteur_annotate::{read_transcription, xml};
use raconteur_eml::{Diagnostic, Severity};

/// Written by pympi 1.71 from values of our own.
const PYMPI: &str = include_str!("files/pympi.eaf");
/// EAF 3.0: a vocabulary, slots without times, a chain of subdivisions.
const THREE: &str = include_str!("files/three.eaf");

fn read(text: &str) -> (Elan, Vec<Diagnostic>) {
    let mut problems = Vec::new();
    let root = xml::parse(text, &mut problems).expect("an element");
    (elan::read(&root, &mut problems), problems)
}

fn tokens(transcription: &Transcription) -> Vec<(&str, i64, i64)> {
    let ms = |secs: f64| (secs * 1000.0).round() as i64;
    let words = transcription.words.iter();
    words
        .map(|word| {
            (
                word.token.as_str(),
                ms(word.interval.start_secs),
                ms(word.interval.end_secs),
            )
        })
        .collect()
}

#[test]
fn a_file_of_pympi_is_read_by_a_guess() {
    let read = read_transcription(PYMPI.as_bytes(), None);
    let codes: Vec<_> = read
        .diagnostics
        .iter()
        .map(|problem| problem.code)
        .collect();
    assert_eq!(codes, ["elan::guess"], "{:?}", read.diagnostics);
    let transcription = &read.transcription;
    assert_eq!(
        tokens(transcription)[..5],
        [
            ("Once", 400, 700),
            ("upon", 700, 1000),
            ("a", 1000, 1300),
            ("time", 1300, 1600),
            ("a", 2000, 2367),
        ]
    );
    assert_eq!(transcription.utterances[1].words, 4..=6);
    let layer = &transcription.layers[0];
    let kinds: Vec<PhaseKind> = layer.phases.iter().map(|phase| phase.kind).collect();
    use PhaseKind::{PostStrokeHold, PreStrokeHold, Preparation, Retraction, Stroke};
    assert_eq!(
        kinds,
        [
            Preparation,
            Stroke,
            PostStrokeHold,
            Retraction,
            Preparation,
            PreStrokeHold,
            Stroke,
            Retraction
        ]
    );
    assert_eq!(layer.phrases[1].phases, 4..=7);
    assert_eq!(layer.phrases[1].dimension, Some(Dimension::Iconic));
    let shapes = layer.phases[6].form.hand_shapes.as_ref().expect("a shape");
    assert_eq!(shapes.text, "[58;14]");
    assert_eq!(transcription.media, ["./rabbit.mp4"]);
}

#[test]
fn slots_without_times_and_chains_share_the_time_evenly() {
    let (elan, problems) = read(THREE);
    assert_eq!(problems, []);
    let tier = |name: &str| {
        let tier = elan
            .tiers
            .iter()
            .find(|tier| tier.name == name)
            .expect("the tier");
        let ms = |secs: f64| (secs * 1000.0).round() as i64;
        let all = tier.annotations.iter();
        all.map(|a| {
            (
                a.value.value.as_str(),
                ms(a.interval.start_secs),
                ms(a.interval.end_secs),
            )
        })
        .collect::<Vec<_>>()
    };
    assert_eq!(
        tier("tokens"),
        [("one", 0, 400), ("two", 400, 800), ("three", 800, 1200)]
    );
    // In the order of the chain, which is not that of the file.
    assert_eq!(tier("syllables"), [("a", 400, 600), ("b", 600, 800)]);
    assert_eq!(tier("gloss"), [("B", 600, 800)]);
    // A value that only the vocabulary holds.
    assert_eq!(tier("phase"), [("stroke", 100, 900)]);
}

#[test]
fn a_mapping_names_tiers_and_values() {
    let mut problems = Vec::new();
    let mapping = Mapping::read(
        "\u{feff}# ours\nwords = tokens\ngesticulation.phases.right = phase\n\
         gesticulation.phases.right.motion = gloss\nvalue stroke = hold #1\n",
        &mut problems,
    );
    assert_eq!(problems, []);
    let read = read_transcription(THREE.as_bytes(), Some(&mapping));
    assert_eq!(tokens(&read.transcription).len(), 3);
    assert_eq!(read.transcription.layers[0].name, "right");
    // The value is mapped to a word that GestuRA does not have.
    let told = read.diagnostics.iter().find(|d| d.code == "gestura::value");
    assert!(told.is_some(), "{:?}", read.diagnostics);
    let text = "words = tokens\nwords = nothing\nbroken\n";
    let mapping = Mapping::read(text, &mut problems);
    let places = problems.iter().map(|p| (p.code, p.span.slice(text)));
    assert_eq!(
        places.collect::<Vec<_>>(),
        [
            ("elan::mapping", "words = nothing"),
            ("elan::mapping", "broken")
        ]
    );
    let read = read_transcription(THREE.as_bytes(), Some(&mapping));
    assert_eq!(read.diagnostics[0].code, "elan::no-tier");
    assert!(
        read.diagnostics[0].hints[0].contains("`tokens`"),
        "the hint names the tiers"
    );
}

#[test]
fn a_cycle_of_references_ends() {
    let text = "<ANNOTATION_DOCUMENT><TIME_ORDER/><TIER TIER_ID='a'><ANNOTATION><REF_ANNOTATION \
                ANNOTATION_ID='x' ANNOTATION_REF='y' PREVIOUS_ANNOTATION='y'/></ANNOTATION>\
                <ANNOTATION><REF_ANNOTATION ANNOTATION_ID='y' ANNOTATION_REF='x' \
                PREVIOUS_ANNOTATION='x'/></ANNOTATION></TIER></ANNOTATION_DOCUMENT>";
    let (elan, problems) = read(text);
    assert_eq!(elan.tiers[0].annotations, []);
    assert!(
        problems.iter().all(|p| p.code == "elan::no-time"),
        "{problems:?}"
    );
}

#[test]
fn malformed_files_say_where() {
    let mut told = 0;
    let step = PYMPI.len() / 120;
    for at in (0..PYMPI.len()).step_by(step) {
        for (insert, skip) in [("", PYMPI.len()), ("", 9), ("<", 1), ("\"", 1), ("x", 3)] {
            let rest = PYMPI
                .get((at + skip).min(PYMPI.len())..)
                .unwrap_or_default();
            let text = format!("{}{insert}{rest}", &PYMPI[..at]);
            let read = read_transcription(text.as_bytes(), None);
            for error in read
                .diagnostics
                .iter()
                .filter(|d| d.severity == Severity::Error)
            {
                assert!(error.span.end as usize <= read.text.len(), "{error:?}");
                told += 1;
            }
        }
    }
    assert!(told > 300, "only {told} errors were told");
}
