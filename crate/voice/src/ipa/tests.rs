//! Pronunciations in the phone sets.

use super::*;

fn told(ipa: &str, set: Set) -> String {
    let syllables = syllables(ipa, set).unwrap();
    let told: Vec<String> = syllables
        .iter()
        .map(|s| {
            format!(
                "{}{}",
                s.phones.join(" "),
                ["", "1", "2"][usize::from(s.stress)]
            )
        })
        .collect();
    told.join(".")
}

#[test]
fn pronunciations_become_syllables_of_each_set() {
    for (ipa, set, expected) in [
        ("təˈmɑːtoʊ", Set::Radio, "t ax.m aa1.t ow"),
        ("təˈmɑːtəʊ", Set::Mrpa, "t @.m aa1.t ou"),
        ("ˈbʌtɚ", Set::Radio, "b ah1.t er"),
        ("ˈbɒtl̩", Set::Espeak, "b 01.t @ l"),
        ("ˈɛkstrə", Set::Radio, "eh k1.s t r ax"),
        ("ˈsɪŋɪŋ", Set::Radio, "s ih ng1.ih ng"),
        ("ˈhæm.stɚ", Set::Espeak, "h a m1.s t 3"),
        ("ˌʌndɚˈstænd", Set::Radio, "ah n2.d er.s t ae n d1"),
        ("t͡ʃɜːt͡ʃ", Set::Radio, "ch er ch"),
        ("ˈʃøːnə", Set::EspeakDe, "S Y:1.n @"),
        ("pfɛʁt", Set::EspeakDe, "pF E r t"),
        ("koɾɐˈsɐ̃w̃", Set::EspeakPt, "k o.* &.s &~U~1"),
        ("ˈmãʃ", Set::EspeakPt, "m &~ S1"),
        ("ˈʒẽtɨ", Set::EspeakPt, "Z e~1.t y"),
        ("põ.mũ.fĩ", Set::EspeakPt, "p o~.m u~.f i~"),
        ("/ˈga:tən/", Set::Sampa, "g a:1.t @ n"),
    ] {
        assert_eq!(told(ipa, set), expected, "{ipa}");
    }
}

#[test]
fn phones_of_an_engine_are_parted_into_syllables() {
    for (word, set, expected) in [
        ("b ah t er f l ay", Set::Radio, &[0, 2, 4][..]),
        ("s", Set::Radio, &[0]),
        ("", Set::Radio, &[0]),
        ("E k s t r @", Set::Espeak, &[0, 2]),
        ("S t aI n Y: n @", Set::EspeakDe, &[0, 3, 5]),
        ("zork e@ l", Set::Espeak, &[0]),
    ] {
        let phones = word.split_ascii_whitespace();
        assert_eq!(starts(phones, set), expected, "{word}");
    }
}

#[test]
fn phones_of_aligners_become_those_of_sampa() {
    for (label, expected) in [
        ("ɑ", "A:"),
        ("ɑː", "A:"),
        ("ej", "eI"),
        ("ow", "@U"),
        ("ʉː", "u:"),
        ("tʃ", "tS"),
        ("tʰ", "t"),
        ("t̪", "t"),
        ("ɾ̃", "4"),
        ("ɝ", "3:"),
        ("c", "k"),
        ("n̩", "@ n"),
        ("ŋ̍", "@ N"),
        ("ɐ̃", "6~"),
        ("j̃", "j"),
        ("a˥˩", "a"),
        ("ˈiː", "i:"),
        ("ɕ", "S"),
    ] {
        let told = in_sampa(label).map(|names| names.join(" "));
        assert_eq!(told.as_deref(), Some(expected), "{label}");
    }
    for none in ["", "AA1", "sil", "spn!", "ʘ", "a.b", "tS"] {
        assert!(!is_phone(none), "{none}");
    }
    assert!(
        is_phone("ɔj") && !is_phone("aa") && !is_phone("spn"),
        "the IPA phone is distinguished from other notations"
    );
    let all = TABLE
        .iter()
        .filter_map(|row| Some((row.ipa, in_sampa(row.ipa)?)));
    let names = all.flat_map(|(ipa, names)| names.into_iter().map(move |n| (ipa, n)));
    let unknown: Vec<_> = names
        .filter(|(_, n)| phones::find("sampa", n).is_none())
        .collect();
    assert_eq!(unknown, []);
}

#[test]
fn what_is_no_pronunciation_is_refused() {
    for bad in ["", "ʃː", "hello7", "\") (quit) (\"", "[[a]] b{", "ə\u{0}"] {
        assert!(syllables(bad, Set::Radio).is_err(), "{bad}");
    }
    assert!(
        syllables(&"a".repeat(201), Set::Radio).is_err(),
        "a pronunciation of 201 letters is rejected"
    );
    assert!(
        syllables(&"a\u{329}".repeat(100), Set::Radio).is_ok(),
        "a pronunciation of 100 syllables is accepted"
    );
}

#[test]
fn every_name_of_an_english_phone_is_known_to_the_mouth() {
    for row in &TABLE {
        for (set, name) in [
            (Set::Radio, "radio"),
            (Set::Mrpa, "mrpa"),
            (Set::Espeak, "espeak"),
        ] {
            for phone in row.names[set as usize].split_ascii_whitespace() {
                let known = phones::find(name, phone).is_some();
                // Only espeak-ng has these in English, for words of other languages.
                let foreign = set == Set::Espeak && ["x", "A~", "O~", "I2"].contains(&phone);
                assert!(known || foreign, "{name} {phone}");
            }
        }
    }
}

#[test]
fn letters_that_last_become_phones_with_as_many_of_them() {
    let spans = |letters: &str, set| {
        let letters: Vec<char> = letters.chars().collect();
        spans(&letters, set)
    };
    assert_eq!(
        spans("baɾˈo\u{303}js", Set::EspeakPt),
        [
            (1, 0, "b"),
            (1, 0, "a"),
            (1, 0, "*"),
            (3, 1, "o~"),
            (1, 0, "j"),
            (1, 0, "s")
        ]
    );
    // A letter for two phones, a mark without a following phone, and a letter without a phone.
    assert_eq!(spans("pIˈ", Set::EspeakPt), [(1, 0, "p"), (2, 0, "aI")]);
    assert_eq!(spans("→a→", Set::Sampa), [(3, 0, "a")]);
    assert_eq!(spans("ˈˌ", Set::Sampa), []);
}
