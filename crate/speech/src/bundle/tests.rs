use super::*;

const SAMPLE: &str = r#"{"format": "raconteur-speech", "version": 2,
 "voices": [{"engine": "test 1", "voice": "v", "language": "en-US", "phone_set": "radio", "mouth": "Y uw o: ao x", "more": 1}],
 "utterances": [{"key": "00000000000000ff", "content": "0123456789abcdef", "voice": 0, "text": "Hi, you 7",
  "audio": [{"file": "u0.opus", "mime": "audio/ogg"}],
  "words": [[0, 3, 1, 2], [4, 3, 4, 2], [8, 1, 6, 0]],
  "phones": "pau hh ay pau y uw", "msecs": [100, 100, 200, 100, 100, 400],
  "syllables": [["H*", 1, 2, 1], ["", 4, 2, 0]],
  "phrases": [["L-L%", 3]], "sentences": [["?", 3]],
  "emotions": [["joy", 0, 300, 1000, 17.3, 42.2, 12.5]],
  "f0": "AGQ", "intensity": "yMg"}]}"#;

fn read(json: &str) -> Result<Bundle, BundleError> {
    Bundle::from_json(json.as_bytes())
}

fn fault(json: &str) -> String {
    read(json).unwrap_err().to_string()
}

#[test]
fn times_come_from_the_phones() {
    let bundle = read(SAMPLE).unwrap();
    let u = &bundle.utterances[bundle.find(255).unwrap()];
    assert_eq!(u.duration_secs, 1.0);
    let words: Vec<_> = u
        .words
        .iter()
        .map(|w| (w.text.as_str(), w.start_secs, w.end_secs))
        .collect();
    assert_eq!(
        words,
        [("Hi,", 0.1, 0.4), ("you", 0.5, 1.0), ("7", 1.0, 1.0)]
    );
    let of_words: Vec<_> = u.phones.iter().map(|p| p.word).collect();
    assert_eq!(of_words, [None, Some(0), Some(0), None, Some(1), Some(1)]);
    let voice = &bundle.voices[u.voice];
    let rows = ["Y", "o:", "hh", "snd"].map(|symbol| voice.phone_row(symbol).expect("a row"));
    assert_eq!(
        rows.map(|row| row.targets().name),
        ["uw", "ao", "hh", "pau"]
    );
}

#[test]
fn what_only_bakers_ask_for_is_read() {
    let bundle = read(SAMPLE).unwrap();
    let u = &bundle.utterances[0];
    assert_eq!(u.text_starts, [0, 4, 8]);
    assert_eq!(u.content, 0x0123_4567_89ab_cdef);
    assert_eq!(bundle.voices[0].engine, "test 1");
    // Older bundles have neither.
    assert_eq!((u.source, &u.audio[0].digest), (None, &None));
}

#[test]
fn what_a_sound_holds_is_told_wholly_or_not_at_all() {
    let told = |members: &str| {
        SAMPLE.replace(
            "\"mime\": \"audio/ogg\"",
            &["\"mime\": \"audio/ogg\", ", members].concat(),
        )
    };
    let sha256 = "0123456789abcdef".repeat(4);
    let whole = told(&format!("\"bytes\": 7, \"sha256\": \"{sha256}\"")).replace(
        "\"voice\": 0",
        "\"source\": \"00000000000000fe\", \"voice\": 0",
    );
    let u = &read(&whole).unwrap().utterances[0];
    assert_eq!(u.source, Some(254));
    assert_eq!(
        u.audio[0].digest,
        Some(FileDigest {
            bytes: 7,
            sha256: sha256.clone()
        })
    );
    for bad in [
        "\"bytes\": 7".to_owned(),
        format!("\"sha256\": \"{sha256}\""),
        format!("\"bytes\": -1, \"sha256\": \"{sha256}\""),
        format!("\"bytes\": 7, \"sha256\": \"{}\"", &sha256[1..]),
        format!("\"bytes\": 7, \"sha256\": \"{}\"", sha256.to_uppercase()),
    ] {
        assert!(read(&told(&bad)).is_err(), "{bad}");
    }
}

#[test]
fn melody_is_read() {
    let bundle = read(SAMPLE).unwrap();
    let u = &bundle.utterances[0];
    assert_eq!(
        (u.accents[0].syllable, u.accents[0].label.as_str()),
        (0, "H*")
    );
    assert_eq!((u.syllables[1].first_phone, u.syllables[1].stress), (4, 0));
    assert_eq!(u.phrases[0].tone, "L-L%");
    assert_eq!(u.sentences[0].kind, SentenceKind::Question);
    assert_eq!((u.emotions[0].apex_secs, u.emotions[0].power), (0.3, 12.5));
    assert_eq!(
        (u.f0.as_slice(), u.intensity.as_slice()),
        (&[0, 100][..], &[200, 200][..])
    );
}

#[test]
fn words_are_found_by_time_and_gaps_are_silent() {
    let bundle = read(SAMPLE).unwrap();
    let u = &bundle.utterances[0];
    assert_eq!(u.word_at(0.05), None);
    assert_eq!(u.word_at(0.1), Some(0));
    assert_eq!(u.word_at(0.45), None);
    assert_eq!(u.word_at(0.8), Some(1));
    assert_eq!(u.phone_at(0.25), Some(2));
}

#[test]
fn what_cannot_be_is_refused() {
    for (from, to, why) in [
        ("u0.opus", "../u.opus", "is not a plain file name"),
        ("u0.opus", "/etc/passwd", "is not a plain file name"),
        ("u0.opus", ".hidden", "is not a plain file name"),
        ("u0.opus", "", "is not a plain file name"),
        (
            "[4, 3, 4, 2]",
            "[4, 3, 4, 3]",
            "has phones that are not there",
        ),
        (
            "[4, 3, 4, 2]",
            "[4, 3, 3, 2]",
            "has a phone that is not its own",
        ),
        (
            "[4, 3, 4, 2]",
            "[4, 3, 2, 1]",
            "has a phone that is not its own",
        ),
        ("[4, 3, 4, 2]", "[4, 30, 4, 2]", "is not in the text"),
        ("[4, 3, 4, 2]", "[4, 3, 4]", "an array of length 4"),
        (
            "[0, 3, 1, 2], [4, 3, 4, 2]",
            "[0, 3, 4, 2], [4, 3, 1, 2]",
            "begins before",
        ),
        ("00ff", "0ff", "16 hexadecimal digits"),
        ("100, 400]", "100]", "more phones than lengths"),
        ("100, 400]", "100, 400, 1]", "more lengths than phones"),
        ("100, 400]", "100, -4]", "expected u32"),
        ("\"voice\": 0", "\"voice\": 1", "its voice is not there"),
        (
            "\"version\": 2",
            "\"version\": 1",
            "reads raconteur-speech version 2",
        ),
    ] {
        assert!(SAMPLE.contains(from), "{from}");
        let said = fault(&SAMPLE.replace(from, to));
        assert!(said.contains(why), "{to}: {said}");
    }
}

#[test]
fn a_melody_that_cannot_be_is_refused() {
    for (from, to, why) in [
        (
            "[\"\", 4, 2, 0]",
            "[\"\", 4, 3, 0]",
            "a syllable has phones",
        ),
        ("[\"\", 4, 2, 0]", "[\"\", 4.5, 1, 0]", "expected usize"),
        ("[\"\", 4, 2, 0]", "[4, 3, 0]", "expected a string"),
        ("[\"L-L%\", 3]", "[\"L-L%\", 4]", "a phrase has words"),
        ("[\"?\", 3]", "[\"?\", 9]", "a sentence has words"),
        ("0, 300, 1000", "0, 300, 2000", "an emotion is out"),
        ("\"AGQ\"", "\"A Q\"", "is not base64"),
    ] {
        assert!(SAMPLE.contains(from), "{from}");
        let said = fault(&SAMPLE.replace(from, to));
        assert!(said.contains(why), "{to}: {said}");
    }
}

#[test]
fn a_fault_of_the_json_names_what_is_wrong_and_where() {
    assert_eq!(
        fault("not json"),
        "the speech bundle cannot be read: expected ident at line 1 column 2"
    );
    assert_eq!(
        fault("{\"format\": \"raconteur-speech\",\n \"version\": \"1\"}"),
        "the speech bundle cannot be read: invalid type: string \"1\", expected u32 at line 2 column 15"
    );
    assert_eq!(
        fault(&SAMPLE.replace("\"mime\"", "\"kind\"")),
        "the speech bundle cannot be read: missing field `mime` at line 4 column 52"
    );
}

proptest::proptest! {
    /// Checks, for phones of any length, that they are rejected or the utterance is no longer than
    /// a day.
    #[test]
    fn lengths_are_bounded(
        msec in proptest::prop_oneof![0..1_300_000_u32, proptest::prelude::any::<u32>()],
        copies in 1_usize..400,
    ) {
        let phones = vec!["ay"; copies].join(" ");
        let lengths = vec![msec.to_string(); copies].join(", ");
        let json = format!(
            r#"{{"format": "raconteur-speech", "version": 2,
            "voices": [{{"engine": "e", "voice": "v", "language": "en", "phone_set": "radio"}}],
            "utterances": [{{"key": "00000000000000ff", "content": "00000000000000ff", "voice": 0,
            "text": "", "audio": [], "words": [], "phones": "{phones}", "msecs": [{lengths}]}}]}}"#
        );
        let fits = msec <= 600_000 && msec as usize * copies <= 86_400_000;
        match read(&json) {
            Ok(bundle) => {
                proptest::prop_assert!(fits && bundle.utterances[0].duration_secs <= 86_400.0);
            }
            Err(error) => {
                let told = error.to_string();
                proptest::prop_assert!(!fits && told.contains(" ms"), "{told}");
            }
        }
    }
}
