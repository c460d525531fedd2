//! Transcriptions as plain data.

use raconteur_annotate::gestura::Transcription;
use raconteur_annotate::plain::{PlainTranscription, field_of, is_at, items};
use raconteur_annotate::{anvil, read_transcription};

const SMALL: &[u8] = include_bytes!("files/small.anvil");
/// Annotation with prosody, events on stage and settings.
const TOLD: &[u8] =
    include_bytes!("../../../../assets/stories/papous/the-white-rabbit/annotation.anvil");
const EXAMPLE: &[u8] = include_bytes!("../../../../web/pages/transcribe/example.anvil");

/// Returns a transcription without its places, which plain data does not keep.
fn as_anvil(transcription: &Transcription) -> String {
    anvil::write(&anvil::from_transcription(transcription))
}

#[test]
fn data_and_back_are_the_same_transcription() {
    for bytes in [SMALL, TOLD, EXAMPLE] {
        let read = read_transcription(bytes, None).transcription;
        let plain = PlainTranscription::from(&read);
        let (back, problems) = plain.transcription().expect("the data is whole");
        let are_notes = problems.iter().all(|p| p.code == "gestura::informal");
        assert!(are_notes, "every form is GSL, or a note: {problems:?}");
        assert_eq!(as_anvil(&back), as_anvil(&read), "the same annotations");
        let forms = |transcription: &Transcription| -> Vec<_> {
            let layers = transcription.layers.iter();
            layers
                .flat_map(|layer| layer.phases.iter().map(|phase| phase.form.clone()))
                .collect()
        };
        assert_eq!(forms(&back), forms(&read), "the same values of GSL");
        assert_eq!(PlainTranscription::from(&back), plain, "the same data");
    }
}

#[test]
fn the_example_of_the_page_has_no_problems() {
    let read = read_transcription(EXAMPLE, None);
    assert!(read.diagnostics.is_empty(), "{:?}", read.diagnostics);
    let hands = |side: &str| String::from_utf8_lossy(EXAMPLE).contains(side);
    assert!(hands(">RH<") && hands(">LH<") && hands(">BH<"), "all hands");
}

#[test]
fn a_problem_of_a_form_names_its_annotation_and_field() {
    let text = String::from_utf8_lossy(SMALL).replace("[[-9;2;6];[-6;12;11]]", "[[-9;2;6]");
    let read = read_transcription(text.as_bytes(), None).transcription;
    let plain = PlainTranscription::from(&read);
    let (back, problems) = plain.transcription().expect("the data is whole");
    let [problem] = problems.as_slice() else {
        panic!("one problem, not {problems:?}");
    };
    assert_eq!(problem.code, "gsl::not-closed", "{problem:?}");
    assert_eq!(field_of(problem.span), Some("motion"), "{problem:?}");
    let all = items(&back);
    let found = all.iter().find(|(span, _)| is_at(problem.span, *span));
    let (_, item) = found.expect("the annotation");
    assert_eq!((&*item.track, item.index), ("phases.0", 0), "{item:?}");
    assert_eq!(problem.related.len(), 1, "the range in the field");
}

#[test]
fn data_that_no_transcription_has_is_refused() {
    let whole = PlainTranscription::from(&read_transcription(SMALL, None).transcription);
    let json = serde_json::to_string(&whole).expect("data");
    for (from, to, message) in [
        ("\"metaphoric\"", "\"big\"", "`big` is not one of iconic"),
        ("\"last\":3", "\"last\":4", "0 to 4 is not a run of 4"),
    ] {
        let broken = json.replacen(from, to, 1);
        let plain: PlainTranscription = serde_json::from_str(&broken).expect("data");
        let told = plain.transcription().expect_err("a refusal");
        assert!(told.contains(message), "{told}");
    }
}
