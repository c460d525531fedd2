//! Plans of texts, shown as one line per sentence.

use super::*;
use crate::content::{Markup, Segment};

fn text(t: &str) -> Segment {
    Segment::Text(t.to_owned())
}

fn pause(msec: u32) -> Segment {
    Segment::Break {
        msec,
        boundary: None,
    }
}

fn planned(segments: Vec<Segment>) -> Plan {
    plan(&Content { segments }, "en-US", "test", &Lexicon::default()).unwrap()
}

fn show(plan: &Plan) -> Vec<String> {
    let token = |(t, pause): (&Token, &Option<f64>)| {
        let pause = pause.map_or(String::new(), |p| format!("<{p}>"));
        format!("{}:{}{}{pause}", t.word, t.text, t.punctuation)
    };
    let sentence = |s: &Planned| {
        let tokens = s.sentence.tokens.iter().zip(&s.pauses).map(token);
        tokens.collect::<Vec<_>>().join(" ")
    };
    plan.sentences.iter().map(sentence).collect()
}

#[test]
fn sentences_end_where_a_reader_hears_an_end() {
    let cases: [(&str, &[&str]); 6] = [
        ("Hello world!", &["0:Hello 1:world!"]),
        ("He ran. She sat.", &["0:He 1:ran.", "2:She 3:sat."]),
        (
            "\u{201c}Stop!\u{201d} said the goat.",
            &["0:Stop! 1:said 2:the 3:goat."],
        ),
        ("so \u{2013} it's late", &["0:so, 1:it's 2:late"]),
        ("One ;-) two.", &["0:One 1:two."]),
        ("...", &[]),
    ];
    for (input, expected) in cases {
        assert_eq!(show(&planned(vec![text(input)])), expected, "{input}");
    }
}

#[test]
fn breaks_belong_to_the_word_before_and_add_up() {
    let p = planned(vec![
        pause(250),
        text("One"),
        pause(100),
        pause(25),
        text("two."),
        pause(600),
        text("Three"),
    ]);
    assert_eq!(p.lead_pause_secs, 0.25);
    assert_eq!(show(&p), ["0:One<0.125> 1:two.<0.6>", "2:Three"]);
    assert!(
        p.sentences[0].sentence.tokens[0].pause,
        "the break belongs to the preceding token"
    );
    assert_eq!(p.sentences[0].pause_secs, 0.6);
    assert_eq!(p.sentences[1].pause_secs, SENTENCE_PAUSE_SECS);
    let p = planned(vec![
        text("One"),
        Segment::Division(Division::Sentence),
        Segment::Division(Division::Paragraph),
        text("two"),
    ]);
    assert_eq!(p.sentences[0].pause_secs, PARAGRAPH_PAUSE_SECS);
}

#[test]
fn a_break_may_ask_for_the_melody_of_an_end() {
    let p = planned(vec![
        text("You came"),
        Segment::Break {
            msec: 100,
            boundary: Some(Boundary::Question),
        },
        text("and left"),
    ]);
    assert_eq!(show(&p), ["0:You 1:came?<0.1>", "2:and 3:left"]);
    assert_eq!(p.sentences[0].sentence.kind, SentenceKind::Question);
    assert_eq!(p.sentences[0].pause_secs, 0.1);
}

#[test]
fn what_is_spelled_has_its_own_signs_and_no_others() {
    let literal = || Segment::Open(Markup::SayAs(SayAs::Literal));
    for (inside, behind, expected) in [
        (
            "W3C",
            ", please.",
            "1:double 1:you 1:three 1:see, 2:please.",
        ),
        ("a.", " b", "1:eigh 1:dot 2:b"),
        ("hi", "!", "1:eytch 1:eye!"),
    ] {
        let p = planned(vec![
            text("Spell "),
            literal(),
            text(inside),
            Segment::Close,
            text(behind),
        ]);
        assert_eq!(
            show(&p),
            [format!("0:Spell {expected}")],
            "{inside}{behind}"
        );
    }
}

#[test]
fn signs_on_their_own_are_said_and_shown() {
    let p = planned(vec![text("Fox & Cub pay 5 % more. What is 2 + 2 = 4?")]);
    assert_eq!(
        p.words,
        [
            "Fox &", "Cub", "pay", "5 %", "more.", "What", "is", "2 +", "2 =", "4?"
        ]
    );
    assert_eq!(
        show(&p),
        [
            "0:Fox 0:and 1:Cub 2:pay 3:five 3:percent 4:more.",
            "5:What 6:is 7:two 7:plus 8:two 8:equals 9:four?"
        ]
    );
}

#[test]
fn words_in_another_script_are_of_its_language() {
    let p = planned(vec![text("He wrote \u{5e9}\u{5dc}\u{5d5}\u{5dd} on it.")]);
    let languages: Vec<&str> = p
        .sentences
        .iter()
        .map(|s| s.sentence.language.as_str())
        .collect();
    assert_eq!(languages, ["en-US", "he", "en-US"]);
}

#[test]
fn another_language_or_speaker_is_a_sentence_of_its_own() {
    let p = planned(vec![
        text("He said"),
        Segment::Open(Markup::Language("German".to_owned())),
        text(" guten Tag"),
        Segment::Close,
        text(" to me."),
    ]);
    assert_eq!(show(&p), ["0:He 1:said", "2:guten 3:Tag", "4:to 5:me."]);
    assert_eq!(p.sentences[1].sentence.language, "de");
    assert!(
        p.sentences[0].continues && !p.sentences[2].continues,
        "the first part continues and the last one does not"
    );
}

#[test]
fn pronunciations_stand_for_what_is_in_them() {
    let p = planned(vec![
        text("nine "),
        Segment::Open(Markup::Pronunciation {
            ipa: None,
            sub: Some("lyves".to_owned()),
            origin: None,
        }),
        text("lives,"),
        Segment::Close,
        text(" the "),
        Segment::Open(Markup::Pronunciation {
            ipa: Some("t\u{259}\u{2c8}m\u{251}\u{2d0}to\u{28a}".to_owned()),
            sub: None,
            origin: None,
        }),
        text("red tomato."),
        Segment::Close,
    ]);
    assert_eq!(show(&p), ["0:nine 1:lyves, 2:the 3:red."]);
    assert!(
        p.sentences[0].sentence.tokens[3].ipa.is_some(),
        "the token has the pronunciation"
    );
    assert_eq!(p.words, ["nine", "lives,", "the", "red", "tomato."]);
}

#[test]
fn a_text_without_full_stops_is_parted_and_an_hour_of_silence_refused() {
    let p = planned(vec![text(&"and ".repeat(1000))]);
    assert!(
        p.sentences.len() == 10 && p.words.len() == 1000,
        "the long text is split into 10 sentences"
    );
    let content = Content {
        segments: vec![text("Hm"), pause(3_600_000)],
    };
    let refused = plan(&content, "en", "test", &Lexicon::default());
    assert_eq!(refused, Err(PlanError::TooMuchSilence(3600.0)));
}
