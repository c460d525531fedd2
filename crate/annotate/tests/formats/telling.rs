//! Prosody, events on stage and settings of a telling.

use raconteur_annotate::{Anchoring, import};

/// An annotation of some words with tracks of prosody and of the stage.
fn script(more: &str) -> (String, Vec<&'static str>) {
    let words = ["“Who", "is", "there?”", "said", "the", "goat."];
    let mut text = String::from(
        "<annotation><head><info key='environment.set' type='String'>fireside</info><info \
         key='performer.figure' type='String'>papous</info></head><body><track name='words'>",
    );
    for (index, word) in words.iter().enumerate() {
        let token: String = word.chars().filter(|c| c.is_alphanumeric()).collect();
        text.push_str(&format!(
            "<el index='{index}' start='{index}' end='{index}.5'><attribute \
             name='token'>{token}</attribute></el>"
        ));
    }
    text.push_str(&format!(
        "</track><track name='utterances' type='span' ref='words'><el index='0' start='0' \
         end='5'><attribute name='text'>{}</attribute></el></track>{more}</body></annotation>",
        words.join(" ")
    ));
    let imported = import(text.as_bytes(), None, Anchoring::Words);
    let told = imported
        .diagnostics
        .iter()
        .map(|problem| problem.code)
        .collect();
    (raconteur_eml::write(&imported.document), told)
}

fn element(track: &str, kind: &str, span: &str, attributes: &[(&str, &str)]) -> String {
    let attributes = attributes.iter();
    let attributes: String = attributes
        .map(|(name, value)| format!("<attribute name='{name}'>{value}</attribute>"))
        .collect();
    format!("<track name='{track}' {kind}><el index='0' {span}>{attributes}</el></track>")
}

const OVER_WORDS: &str = "type='span' ref='words'";

#[test]
fn speakers_speak_their_words_with_the_quotes() {
    let speaker = element(
        "prosody.speaker",
        OVER_WORDS,
        "start='0' end='2'",
        &[("name", "kokoro:af_bella")],
    );
    let emph = element("prosody.emph", OVER_WORDS, "start='2' end='2'", &[]);
    let pause = element(
        "prosody.break",
        OVER_WORDS,
        "start='3' end='3'",
        &[("msec", "250")],
    );
    let (eml, told) = script(&(speaker + &emph + &pause));
    assert_eq!(told, [""; 0], "{eml}");
    let expected = "<r:speaker name='kokoro:af_bella'>“Who is <emph>there?”</emph></r:speaker> \
                    <break msec='250'/>said the goat.";
    assert!(eml.contains(expected), "{eml}");
    assert!(eml.contains("<r:environment set='fireside'/>"), "{eml}");
    assert!(eml.contains("<r:performer figure='papous'/>"), "{eml}");
}

#[test]
fn events_on_stage_hang_on_their_words() {
    let emotion = element(
        "staging.emotion",
        "type='primary'",
        "start='2.9' end='5'",
        &[("type", "anger"), ("potential", "4")],
    );
    let (eml, told) = script(&emotion);
    assert_eq!(told, [""; 0], "{eml}");
    let expected = "<r:emotion time='w3-0.1' type='anger' potential='4' duration='2.1'/>";
    assert!(eml.contains(expected), "{eml}");
}

#[test]
fn what_eml_does_not_know_is_told() {
    let unknown = element(
        "staging.fireworks",
        "type='primary'",
        "start='1' end='2'",
        &[],
    );
    assert_eq!(script(&unknown).1, ["gestura::element"]);
    let value = element(
        "staging.emotion",
        "type='primary'",
        "start='1' end='2'",
        &[("type", "joy"), ("potential", "99")],
    );
    assert_eq!(script(&value).1, ["eml::out-of-range"]);
    let clause = element("prosody.camera", OVER_WORDS, "start='1' end='2'", &[]);
    assert_eq!(script(&clause).1, ["gestura::element"]);
    // Names and values do not become markup.
    let markup = element(
        "staging.event",
        "type='primary'",
        "start='1' end='2'",
        &[("type", "x\"/&gt;&lt;null time=\"9"), ("a b=", "c")],
    );
    let (eml, _) = script(&markup);
    assert_eq!(eml.matches("<null").count(), 0, "{eml}");
}

#[test]
fn gestures_of_other_classes_are_animations() {
    let wave = element(
        "gestures",
        "type='primary'",
        "start='4.1' end='5'",
        &[("type", "emblem"), ("animation", "wave")],
    );
    let (eml, told) = script(&wave);
    assert_eq!(told, [""; 0], "{eml}");
    assert_eq!(raconteur_eml::parse(&eml).diagnostics, [], "{eml}");
    let expected = "<body-deterministic-primitive time='w4+0.1' primitive='push' \
                    player='transcribed' animationSetName='wave'>";
    assert!(eml.contains(expected), "{eml}");
    let unnamed = element(
        "gestures",
        "type='primary'",
        "start='4.1' end='5'",
        &[("type", "sign")],
    );
    assert_eq!(script(&unnamed).1, ["gestura::no-animation"]);
}

#[test]
fn a_form_of_the_resting_hand_is_told_and_replaced() {
    let stroke = element(
        "gesticulation.phases.layer1",
        "type='primary'",
        "start='1' end='2'",
        &[
            ("phase", "stroke"),
            ("motion", "LH=[8;12;13]"),
            ("hand-shapes", "24"),
        ],
    );
    let phrase = element(
        "gesticulation.phrases.layer1",
        "type='span' ref='gesticulation.phases.layer1'",
        "start='0' end='0'",
        &[("phrase", "iconic"), ("handedness", "RH")],
    );
    let (eml, told) = script(&(stroke + &phrase));
    for code in ["gestura::hands", "gestura::no-position"] {
        assert!(told.contains(&code), "{code}: {told:?}");
    }
    assert!(!eml.contains("hand='left'"), "{eml}");
}

#[test]
fn noises_are_neither_spoken_nor_counted() {
    let text = "<annotation><body><track name='words'><el start='0' end='1'><attribute \
                name='token'>[laughs]</attribute></el><el start='1' end='2'><attribute \
                name='token'>goat</attribute></el></track></body></annotation>";
    let read = raconteur_annotate::read_transcription(text.as_bytes(), None);
    let counted = raconteur_annotate::gestura::Statistics::new(&read.transcription).words;
    assert_eq!(counted, 1);
    let eml = raconteur_eml::write(&import(text.as_bytes(), None, Anchoring::Words).document);
    assert!(eml.contains("goat") && !eml.contains("laughs"), "{eml}");
}
