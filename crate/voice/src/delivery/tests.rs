//! Delivery of planned texts.

use super::*;
use crate::content::{Content, Segment};
use crate::plan::{PARAGRAPH_PAUSE_SECS, SENTENCE_PAUSE_SECS, plan};
use crate::text::Lexicon;

fn told(text: &str, tension: Option<f64>) -> Plan {
    let content = Content {
        segments: vec![Segment::Text(text.to_owned())],
    };
    let mut plan = plan(&content, "en-US", "kokoro", &Lexicon::default()).unwrap();
    deliver(&mut plan, tension);
    plan
}

/// Sentences of the same length that are all different.
fn sentences(count: usize) -> String {
    const WORDS: [&str; 12] = [
        "rabbit", "garden", "goat", "river", "soup", "door", "ant", "hill", "house", "road", "ox",
        "wood",
    ];
    (0..count)
        .map(|i| {
            let word = |k: usize| WORDS[(i / 12_usize.pow(k as u32)) % 12];
            format!(
                "The {} and the {} saw the {}, and they went home again. ",
                word(0),
                word(1),
                word(2)
            )
        })
        .collect()
}

#[test]
fn pauses_have_the_spread_of_peoples_and_the_same_text_has_the_same() {
    let plan = told(&sentences(400), Some(CALM));
    assert_eq!(plan, told(&sentences(400), Some(CALM)));
    let logs = |secs: Vec<f64>| {
        let logs: Vec<f64> = secs.iter().map(|s| ops::ln(*s)).collect();
        let mean = logs.iter().sum::<f64>() / logs.len() as f64;
        let variance =
            logs.iter().map(|l| (l - mean) * (l - mean)).sum::<f64>() / logs.len() as f64;
        (ops::exp(mean), variance.sqrt())
    };
    let (median, spread) = logs(plan.sentences.iter().map(|s| s.pause_secs).collect());
    assert!((median / SENTENCE_PAUSE_SECS - 1.0).abs() < 0.1, "{median}");
    assert!((spread - SPREAD).abs() < 0.05, "{spread}");
    for planned in &plan.sentences {
        assert!(
            (PAUSE_SECS.0..=PAUSE_SECS.1).contains(&planned.pause_secs),
            "the pause is between the shortest and longest one"
        );
        let rests = planned.rests.iter().filter(|s| **s > 0.0);
        assert!(
            rests.clone().count() > 0 && rests.clone().all(|s| *s >= PAUSE_SECS.0),
            "rests exist and last at least the shortest pause"
        );
    }
}

#[test]
fn tense_stories_are_faster_and_pause_less() {
    let text = sentences(60);
    let mean = |tension: f64| {
        let plan = told(&text, Some(tension));
        let count = plan.sentences.len() as f64;
        let of = |value: fn(&Planned) -> f64| plan.sentences.iter().map(value).sum::<f64>() / count;
        (of(|s| s.sentence.pace), of(|s| s.pause_secs))
    };
    let (calm, tense) = (mean(0.1), mean(0.9));
    assert!(tense.0 / calm.0 > 1.2, "{calm:?} {tense:?}");
    assert!(tense.1 / calm.1 < 0.7, "{calm:?} {tense:?}");
}

#[test]
fn paragraphs_turns_and_authors_pauses() {
    let mut content = Content {
        segments: vec![
            Segment::Text("One two three.".to_owned()),
            Segment::Division(crate::content::Division::Paragraph),
            Segment::Text("Four five six.".to_owned()),
            Segment::Break {
                msec: 50,
                boundary: None,
            },
        ],
    };
    let delivered = |content: &Content| {
        let mut plan = plan(content, "en-US", "kokoro", &Lexicon::default()).unwrap();
        deliver(&mut plan, Some(CALM));
        plan
    };
    let plan = delivered(&content);
    let drawn = plan.sentences[0].pause_secs / PARAGRAPH_PAUSE_SECS;
    content.segments[1] = Segment::Division(crate::content::Division::Sentence);
    let sentence = delivered(&content).sentences[0].pause_secs / SENTENCE_PAUSE_SECS;
    assert!(
        (drawn - sentence).abs() < 1e-9,
        "the draw is the same: {drawn} {sentence}"
    );
    assert_eq!(plan.sentences[1].pause_secs, 0.05, "the author's stays");
    // The pause before direct speech is longer.
    let plain = told("He was sad. Why so.", Some(CALM)).sentences[0].pause_secs;
    let turn = told("He was sad. \u{201c}Why so.\u{201d}", Some(CALM)).sentences[0].pause_secs;
    assert!((turn / plain - TURN).abs() < 1e-9, "{plain} {turn}");
}

#[test]
fn direct_speech_has_a_style_of_its_own_and_authors_win() {
    for (text, spoken) in [
        (
            "He said: \u{201c}Go away now.\u{201d} And left.",
            "Go away now.",
        ),
        ("Er sagte: \u{201e}Geh weg.\u{201c} Und ging.", "Geh weg."),
        ("She \"cried out loud\" there.", "cried out loud"),
        ("Nobody's here, it's late.", ""),
    ] {
        let plan = told(text, None);
        let tokens = plan.sentences.iter().flat_map(|s| &s.sentence.tokens);
        let (mut quoted, mut own) = (Vec::new(), Vec::new());
        for token in tokens {
            let raised = plan.styles[token.style].pitch_middle.factor > 1.0;
            let to = if raised { &mut quoted } else { &mut own };
            to.push(token.text.as_str());
        }
        let expected: Vec<&str> = spoken
            .split(' ')
            .map(|w| w.trim_matches('.'))
            .filter(|w| !w.is_empty())
            .collect();
        assert_eq!(quoted, expected, "{text}");
        assert!(!own.is_empty(), "some words are not direct speech");
    }
    let mut style = Style::default();
    style.pitch_middle = style.pitch_middle.with(Setting::Value(300.0));
    let spoken = spoken_by_another(&style);
    assert_eq!(spoken.pitch_middle, style.pitch_middle);
    assert!(spoken.rate.factor > 1.0, "the direct speech is faster");
}
