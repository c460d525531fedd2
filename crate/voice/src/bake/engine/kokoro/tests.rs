//! Kokoro with a network that lasts one frame for every letter.

use super::*;
use crate::spoken::Token;
use raconteur_speech::bundle::SentenceKind;

struct Plain;

impl Host for Plain {
    fn voices(&self) -> Result<Vec<String>> {
        let names = ["af_heart", "bm_george", "zf_xiaobei", "x"];
        Ok(names.map(str::to_owned).to_vec())
    }

    fn word(&self, word: &str) -> Result<Option<(String, Option<String>)>> {
        let (usual, last) = match word {
            "the" => ("ði", None),
            "bird" => ("bˈɜɹd", None),
            "apple" => ("ˈæpᵊl", None),
            "wish" => ("wˈɪʃ", None),
            "by" => ("bI", Some("bˈI")),
            "letter" => ("lˈɛɾəɹ", None),
            _ => return Ok(None),
        };
        Ok(Some((usual.to_owned(), last.map(str::to_owned))))
    }

    fn ipa(&self, _language: &str, _text: &str) -> Result<String> {
        Ok("az ˈaɾəmæz i ʊz baɾˈõjz".to_owned())
    }

    fn guess(&self, word: &str) -> Result<String> {
        Ok(if word == "zorkelim" {
            "z ao r k ax l ih m"
        } else {
            ""
        }
        .to_owned())
    }

    fn infer(&self, _voice: &str, letters: &str, _pace: f64) -> Result<Output> {
        let count = letters.chars().count();
        assert!(
            count <= MAX_LETTERS,
            "the number of letters is within the limit"
        );
        let frames = std::iter::once(4.0)
            .chain(std::iter::repeat_n(2.0, count))
            .chain([4.0]);
        let frames: Vec<f32> = frames.collect();
        let total: f32 = frames.iter().sum();
        Ok(Output {
            samples: vec![0.1; (total * 600.0) as usize],
            frames,
        })
    }
}

fn sentence(words: &[&str]) -> Sentence {
    let tokens = words.iter().map(|w| {
        let text = w.trim_end_matches(['.', ',', '?']);
        Token {
            text: text.to_owned(),
            punctuation: w[text.len()..].to_owned(),
            emphasis: 0.5,
            ..Token::default()
        }
    });
    Sentence {
        tokens: tokens.collect(),
        kind: SentenceKind::Statement,
        ..Sentence::default()
    }
}

fn letters(words: &[&str]) -> String {
    let text = Text::from_sentence(&sentence(words), TONGUES[0], &Plain).unwrap();
    text.marks.iter().map(|m| m.letter).collect()
}

#[test]
fn words_are_of_the_dictionaries_with_endings_weak_forms_or_guessed() {
    assert_eq!(letters(&["The", "bird"]), "ðə bˈɜɹd.");
    assert_eq!(letters(&["the", "apple,", "by"]), "ði ˈæpᵊl, bˈI.");
    assert_eq!(
        letters(&["by", "bird's", "wishes", "wished"]),
        "bI bˈɜɹdz wˈɪʃᵻz wˈɪʃt."
    );
    assert_eq!(letters(&["wishing", "Bird-apple?"]), "wˈɪʃɪŋ bˈɜɹdˈæpᵊl?");
    assert_eq!(letters(&["Zorkelim"]), "");
    assert_eq!(letters(&["zorkelim"]), "zˈɔɹkəlɪm.");
}

#[test]
fn an_authors_pronunciation_is_spoken() {
    let mut sentence = sentence(&["bird"]);
    sentence.tokens[0].ipa = Some("təˈmɑːtoʊ".to_owned());
    let text = Text::from_sentence(&sentence, TONGUES[0], &Plain).unwrap();
    let letters: String = text.marks.iter().map(|m| m.letter).collect();
    assert_eq!(letters, "təmˈɑtO.");
}

#[test]
fn frames_become_phones_of_words_with_stress() {
    let text =
        Text::from_sentence(&sentence(&["the", "letter,", "bird"]), TONGUES[0], &Plain).unwrap();
    let letters: String = text.marks.iter().map(|m| m.letter).collect();
    let out = Plain.infer("af_heart", &letters, 1.0).unwrap();
    let said = [to_spoken(&text.marks, TONGUES[0], &out).unwrap()];
    let told: Vec<_> = said[0]
        .segments
        .iter()
        .map(|s| {
            (
                s.symbol.as_str(),
                (s.end_secs * 1e3).round() as i64,
                s.token,
            )
        })
        .collect();
    // Frames of 25 ms, 85 ms early; the r ends its vowel, stress counts to it.
    assert_eq!(
        told,
        [
            ("pau", 15, None),
            ("dh", 65, Some(0)),
            ("ax", 165, Some(0)),
            ("l", 215, Some(1)),
            ("eh", 315, Some(1)),
            ("dx", 365, Some(1)),
            ("er", 465, Some(1)),
            ("pau", 565, None),
            ("b", 615, Some(2)),
            ("er", 765, Some(2)),
            ("d", 815, Some(2)),
            ("pau", 1050, None),
        ]
    );
    let stress: Vec<u8> = said[0].syllables.iter().map(|s| s.stress).collect();
    assert_eq!(stress, [0, 1, 0, 1]);
    assert_eq!(said[0].breaks, [(1, String::new()), (2, String::new())]);
}

#[test]
fn long_sentences_are_spoken_in_parts() {
    let words: Vec<&str> = std::iter::repeat_n("bird,", 200).collect();
    let said = Kokoro(Plain)
        .speak("af_heart", &[sentence(&words)])
        .unwrap();
    let spoken = &said[0];
    assert_eq!(
        spoken.segments.iter().filter(|s| s.symbol == "er").count(),
        200
    );
    let sound_secs = spoken.samples.len() as f64 / RATE_HZ;
    assert!(
        spoken
            .segments
            .windows(2)
            .all(|p| p[0].end_secs < p[1].end_secs),
        "the segments are in chronological order"
    );
    assert!(
        (spoken.segments[spoken.segments.len() - 1].end_secs - sound_secs).abs() < 1e-6,
        "the last segment ends with the audio"
    );
    for syllable in &spoken.syllables {
        let first = &spoken.segments[syllable.first];
        assert!(!first.is_silent(), "the first segment is not silent");
    }
}

#[test]
fn voices_tell_language_and_sex_by_their_names() {
    let voices = Kokoro(Plain).voices().unwrap();
    let told: Vec<_> = voices
        .iter()
        .map(|v| (v.name.as_str(), v.language.as_str(), v.gender))
        .collect();
    assert_eq!(
        told,
        [
            ("af_heart", "en-US", Some(Gender::Female)),
            ("bm_george", "en-GB", Some(Gender::Male)),
        ]
    );
}

#[test]
fn a_network_that_tells_nonsense_is_an_error() {
    let marks = [Mark {
        letter: 'ə',
        token: Some(0),
    }];
    for frames in [vec![], vec![1.0, 1.0], vec![0.0; 3], vec![f32::NAN; 3]] {
        let out = Output {
            samples: vec![0.0; 600],
            frames,
        };
        assert!(
            to_spoken(&marks, TONGUES[0], &out).is_err(),
            "nonsense from the network is rejected"
        );
    }
}

#[test]
fn words_of_other_languages_have_the_phones_of_espeak() {
    let sentence = sentence(&["As", "armas", "e", "os", "barões"]);
    let portuguese = SpokenLanguage::from_voice("pf_dora").unwrap();
    let text = Text::from_sentence(&sentence, portuguese, &Plain).unwrap();
    let letters: String = text.marks.iter().map(|m| m.letter).collect();
    assert_eq!(letters, "az ˈaɾəmæz i ʊz baɾˈo\u{303}jz.");
    let out = Plain.infer("pf_dora", &letters, 1.0).unwrap();
    let said = to_spoken(&text.marks, portuguese, &out).unwrap();
    let of_last: Vec<&str> = said
        .segments
        .iter()
        .filter(|s| s.token == Some(4))
        .map(|s| s.symbol.as_str())
        .collect();
    assert_eq!(of_last, ["b", "a", "*", "o~", "j", "z"]);
    // One that writes another number of words is read word for word.
    let short = Sentence {
        tokens: sentence.tokens[..1].to_vec(),
        ..sentence
    };
    let text = Text::from_sentence(&short, portuguese, &Plain).unwrap();
    assert!(text.marks.len() > 10, "{:?}", text.marks);
}
