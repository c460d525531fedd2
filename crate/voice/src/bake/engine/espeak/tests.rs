//! Parsing of espeak-ng's output.

use super::*;
use crate::content::Gender;
use crate::spoken::Token;
use raconteur_speech::bundle::SentenceKind;

fn sentence(words: &[&str]) -> Sentence {
    let tokens = words.iter().map(|w| Token {
        text: (*w).to_owned(),
        ..Token::default()
    });
    Sentence {
        tokens: tokens.collect(),
        kind: SentenceKind::Question,
        ..Sentence::default()
    }
}

fn events(told: &[(usize, &str)]) -> Vec<Event> {
    let of = |(sample, what): &(usize, &str)| Event {
        sample: *sample,
        what: match what.strip_prefix('#') {
            Some("end") => EventKind::End,
            Some(position) => EventKind::Word(position.parse().unwrap()),
            None => EventKind::Phone((*what).to_owned()),
        },
    };
    told.iter().map(of).collect()
}

#[test]
fn events_become_phones_of_tokens() {
    let text = Text::from_sentence(&sentence(&["It's", "-", "25"]), Set::Espeak).unwrap();
    assert_eq!(text.written, "It's 25? ");
    assert_eq!(text.starts, [(0, 0), (5, 2)]);
    let said = Synthesis {
        samples: vec![500; 2000],
        rate_hz: 1000,
        events: events(&[
            (0, "#1"),
            (0, "I"),
            (100, "t"),
            (200, "#6"),
            (250, "t"),
            (300, "(en)"),
            (310, "E"),
            (610, "n"),
            (610, "t"),
            (700, "_:"),
            (800, "_"),
            (800, "#end"),
        ]),
        marked: ["'I", "t", "t", "'E", "n", "t"].map(str::to_owned).to_vec(),
    };
    let mut labels = text.labels(&said);
    syllables(&mut labels, &said.marked, Set::Espeak).unwrap();
    let told: Vec<_> = labels
        .phones
        .iter()
        .map(|p| {
            (
                p.symbol.as_str(),
                (p.end_secs * 1e3).round() as usize,
                p.token,
            )
        })
        .collect();
    assert_eq!(
        told,
        [
            ("I", 100, Some(0)),
            ("t", 200, Some(0)),
            ("t", 310, Some(2)),
            ("E", 510, Some(2)),
            ("n", 610, Some(2)),
            ("t", 700, Some(2)),
            ("_:", 800, None),
            ("_", 2000, None),
        ]
    );
    assert_eq!(labels.syllables, [(1, String::new()), (1, String::new())]);
    assert_eq!(labels.breaks, [(2, String::new())]);
}

#[test]
fn texts_cannot_become_phones_or_commands() {
    for nasty in ["[[f@]]", "<speak>", "a_b|c", "x\u{0}\n"] {
        let text = Text::from_sentence(&sentence(&[nasty]), Set::Espeak).unwrap();
        assert!(
            !text
                .written
                .contains(['[', ']', '<', '>', '_', '|', '\0', '\n']),
            "{nasty}"
        );
    }
    assert_eq!(readable("na\u{ef}ve"), "na\u{ef}ve");
    assert_eq!(readable("it\u{2019}s"), "it's");
    assert_eq!(readable("\u{2014}"), "");
}

#[test]
fn pronunciations_are_mnemonics_with_stress_before_vowels() {
    assert_eq!(
        mnemonics("t\u{259}\u{2c8}m\u{251}\u{2d0}to\u{28a}", Set::Espeak).unwrap(),
        "[[t|@|m|'A:|t|oU|]]"
    );
    assert!(
        mnemonics("]] x", Set::Espeak).is_err(),
        "invalid phones are rejected"
    );
}

/// Host with one variant that produces no audio.
struct SilentHost;

impl Host for SilentHost {
    fn version(&self) -> Result<String> {
        Ok(String::new())
    }

    fn files(&self, folder: &str) -> Result<Vec<String>> {
        let all = if folder == "lang" { "gmw/de" } else { "f2" };
        Ok(vec![all.to_owned()])
    }

    fn text(&self, path: &str) -> Result<String> {
        let german = "name German\nlanguage de\n";
        Ok(match path {
            "lang/gmw/de" => german,
            _ => "gender female\n",
        }
        .to_owned())
    }

    fn speak(&self, _voice: &str, texts: &[String]) -> Result<Vec<Synthesis>> {
        Ok(vec![Synthesis::default(); texts.len()])
    }
}

#[test]
fn voices_are_languages_with_variants_that_exist() {
    assert_eq!(voices::known("de", &SilentHost).unwrap(), "de");
    assert_eq!(voices::known("en-us+f2", &SilentHost).unwrap(), "en-us");
    for bad in ["", "+f2", "de+f9", "../x", "de+../f2", "a b", "de+f2+f2"] {
        assert!(voices::known(bad, &SilentHost).is_err(), "{bad}");
    }
    let of = |name: &str| Espeak(SilentHost).voice(name).unwrap().map(|v| v.gender);
    assert_eq!(of("de"), Some(Some(Gender::Male)));
    assert_eq!(of("de-DE+f2"), Some(Some(Gender::Female)));
    assert_eq!(of("pt"), None);
}

#[test]
fn a_file_tells_of_its_voice() {
    let about = "name English (America)\nlanguage en-us 2\nlanguage en 3\ngender female 30\n";
    let voice = voices::voice_of("en-US", about).unwrap();
    assert_eq!(
        (voice.name.as_str(), voice.language.as_str(), voice.gender),
        ("en-us", "en-US", Some(Gender::Female))
    );
    assert!(
        voices::voice_of("x", "maintainer nobody").is_none(),
        "a file without a voice is skipped"
    );
    assert_eq!(voices::file_of("en-GB"), "en");
    assert_eq!(voices::file_of("en-US"), "en-us");
    assert_eq!(voices::tag("zh-latn-pinyin"), "zh-latn-pinyin");
}
