//! Rules of GestuRA in annotations, and what is made of files that have less than all tracks.

use raconteur_annotate::{Anchoring, import, read_transcription};

/// Returns an annotation of tracks, each with its name, its other attributes and its elements.
fn annotation(tracks: &[(&str, &str, &str)]) -> String {
    let tracks = tracks
        .iter()
        .map(|(name, kind, elements)| format!("<track name='{name}' {kind}>{elements}</track>"));
    let tracks: String = tracks.collect();
    format!("<annotation><body>{tracks}</body></annotation>")
}

fn element(times: &str, attributes: &[(&str, &str)]) -> String {
    let attributes = attributes.iter();
    let attributes: String = attributes
        .map(|(name, value)| format!("<attribute name='{name}'>{value}</attribute>"))
        .collect();
    format!("<el {times}>{attributes}</el>")
}

/// Returns phases, each with its times, kind and motion.
fn phases(all: &[(&str, &str, &str)]) -> String {
    let phases = all
        .iter()
        .enumerate()
        .map(|(index, (times, kind, motion))| {
            let (start, end) = times.split_once(' ').expect("two times");
            let times = format!("index='{index}' start='{start}' end='{end}'");
            element(&times, &[("phase", kind), ("motion", motion)])
        });
    phases.collect()
}

const LAYER: &str = "gesticulation.phases.layer1";
const PHRASES: &str = "gesticulation.phrases.layer1";
const OF_LAYER: &str = "type='span' ref='gesticulation.phases.layer1'";

fn checked(text: &str) -> Vec<&'static str> {
    let read = read_transcription(text.as_bytes(), None);
    read.diagnostics.iter().map(|d| d.code).collect()
}

fn script(text: &str) -> (String, Vec<&'static str>) {
    let imported = import(text.as_bytes(), None, Anchoring::Words);
    let told = imported.diagnostics.iter().map(|d| d.code).collect();
    (raconteur_eml::write(&imported.document), told)
}

#[test]
fn a_hand_in_two_places_at_one_time_is_told() {
    let told = |second: &str, hold: bool| {
        let mut all = vec![
            ("1 1.5", "preparation", ""),
            ("1.5 2", "stroke", "[[-9;12;12];[-14;20;10]]"),
        ];
        if hold {
            all.push(("2 2.5", "post-stroke hold", ""));
            all.push(("2.5 3", "stroke", second));
        } else {
            all.push(("2 2.5", "stroke", second));
        }
        let last = if hold {
            "start='3' end='3'"
        } else {
            "start='2' end='2'"
        };
        let first = if hold {
            "start='0' end='2'"
        } else {
            "start='0' end='1'"
        };
        let hands = [("handedness", "RH"), ("phrase", "beat")];
        let phrases = element(first, &hands) + &element(last, &hands);
        let text = annotation(&[
            (LAYER, "type='primary'", &phases(&all)),
            (PHRASES, OF_LAYER, &phrases),
        ]);
        script(&text).1.contains(&"gestura::two-places")
    };
    for hold in [false, true] {
        assert!(
            told("[[-7;6;11];[-9;12;12]]", hold),
            "two places, hold: {hold}"
        );
        assert!(
            !told("[[-14;20;10];[-9;12;12]]", hold),
            "one place, hold: {hold}"
        );
    }
}

#[test]
fn a_preparation_leads_to_the_stroke_through_a_hold() {
    let all = phases(&[
        ("1 1.5", "preparation", ""),
        ("1.5 2", "pre-stroke hold", ""),
        ("2 2.5", "stroke", "[[-9;12;12];[-13;18;11]]"),
    ]);
    let phrase = element(
        "start='0' end='2'",
        &[("handedness", "RH"), ("phrase", "beat")],
    );
    let tracks = [
        (LAYER, "type='primary'", all.as_str()),
        (PHRASES, OF_LAYER, phrase.as_str()),
    ];
    let (eml, _) = script(&annotation(&tracks));
    let preparation = eml.split("<gesture-key").nth(1).expect("a preparation");
    assert!(preparation.contains("x='-9' y='12' z='-12'"), "{eml}");
}

#[test]
fn phrases_belong_to_the_layer_to_which_they_refer() {
    let stroke = phases(&[("1 2", "stroke", "[[9;12;12];[13;18;11]]")]);
    let phrase = element(
        "start='0' end='0'",
        &[("handedness", "LH"), ("phrase", "beat")],
    );
    let text = annotation(&[
        (LAYER, "type='primary'", &stroke),
        ("gesticulation.phrases.other", OF_LAYER, &phrase),
    ]);
    assert_eq!(checked(&text), [""; 0]);
    assert!(
        script(&text).0.contains("handedness='left'"),
        "the left hand"
    );
}

#[test]
fn utterances_without_words_are_spoken() {
    let told = element("start='1' end='3'", &[("text", "Once upon a time.")]);
    let text = annotation(&[("utterances", "type='primary'", &told)]);
    let read = read_transcription(text.as_bytes(), None);
    let words: Vec<(&str, f64)> = read
        .transcription
        .words
        .iter()
        .map(|word| (word.token.as_str(), word.interval.end_secs))
        .collect();
    let letters = 2.0 / 14.0;
    let ends = [4.0, 8.0, 9.0, 14.0].map(|count| 1.0 + count * letters);
    for ((word, end), (token, secs)) in words
        .iter()
        .zip(["Once", "upon", "a", "time."].into_iter().zip(ends))
    {
        assert_eq!(*word, token);
        assert!(
            (end - secs).abs() < 1e-9,
            "{word} ends at {end}, not {secs}"
        );
    }
    assert_eq!(words.len(), 4);
    let (eml, codes) = script(&text);
    assert_eq!(codes, ["gestura::no-words"], "{eml}");
    assert!(eml.contains("Once upon a time."), "{eml}");
    let many = text.replace("Once upon a time.", &"a ".repeat(200_000));
    let read = read_transcription(many.as_bytes(), None);
    assert_eq!(read.transcription.words.len(), 100_000);
    assert_eq!(read.diagnostics[0].code, "gestura::too-large");
}

#[test]
fn what_contradicts_the_passes_is_told() {
    let gesture = |times: &str| element(times, &[("type", "gesticulation")]);
    let check = |gestures: &str, all: &[(&str, &str, &str)], more: &[(&str, &str)]| {
        let last = format!("start='0' end='{}'", all.len() - 1);
        let phrase = element(&last, &[&[("phrase", "beat")], more].concat());
        checked(&annotation(&[
            ("gestures", "type='primary'", gestures),
            (LAYER, "type='primary'", &phases(all)),
            (PHRASES, OF_LAYER, &phrase),
        ]))
    };
    let whole = gesture("index='0' start='0' end='4'");
    let stroke = ("1 2", "stroke", "[[-9;12;12];[-13;18;11]]");
    let right = [("handedness", "RH")];
    assert_eq!(check(&whole, &[stroke], &right), [""; 0]);
    let two = whole.clone() + &gesture("index='1' start='5' end='6'");
    assert_eq!(check(&two, &[stroke], &right), ["gestura::strokes"]);
    let symmetric = [("handedness", "RH"), ("symmetry", "true")];
    assert_eq!(check(&whole, &[stroke], &symmetric), ["gestura::hands"]);
    let moved = ("2 3", "post-stroke hold", "[[-13;18;11];[-15;2;5]]");
    assert_eq!(check(&whole, &[stroke, moved], &right), ["gestura::hold"]);
    let back = ("2 3", "partial-retraction", "");
    assert_eq!(
        check(&whole, &[stroke, back], &right),
        ["gestura::phase-order"]
    );
}

#[test]
fn remarks_of_the_coder_are_told_as_not_read() {
    let told =
        "<el start='1' end='2'><attribute name='token'>Once</attribute><comment>ah</comment></el>";
    let text = annotation(&[("words", "type='primary'", told)]);
    assert_eq!(checked(&text), ["anvil::remarks"]);
}
