//! Tracks from parts.

use super::*;
use crate::content::{Content, Segment as SpeechRequest};
use crate::plan::plan;
use crate::spoken::{Segment, SpokenSyllable};
use crate::text::Lexicon;
use raconteur_speech::bundle::db_of_code;

const RATE_HZ: f64 = 16_000.0;

fn planned(segments: Vec<SpeechRequest>) -> Plan {
    plan(&Content { segments }, "en", "test", &Lexicon::default()).unwrap()
}

fn text(text: &str) -> SpeechRequest {
    SpeechRequest::Text(text.to_owned())
}

fn pause(msec: u32) -> SpeechRequest {
    SpeechRequest::Break {
        msec,
        boundary: None,
    }
}

/// Speech is a tone, silence 0; `phones` are symbol, length and token.
fn part(phones: &[(&str, f64, Option<usize>)]) -> SpokenSentence {
    let mut spoken = Spoken {
        rate_hz: RATE_HZ,
        phone_set: "radio".to_owned(),
        ..Spoken::default()
    };
    let mut end_secs = 0.0;
    for (i, (symbol, secs, token)) in phones.iter().enumerate() {
        end_secs += secs;
        while (spoken.samples.len() as f64) < (end_secs * RATE_HZ).round() {
            let at = spoken.samples.len() as f64 / RATE_HZ;
            let loud = if *symbol == SILENCE { 0.0 } else { 0.2 };
            spoken.samples.push(loud * ops::sin(at * 900.0));
        }
        spoken.segments.push(Segment {
            symbol: (*symbol).to_owned(),
            end_secs,
            token: *token,
        });
        if token.is_some() {
            spoken.syllables.push(SpokenSyllable {
                first: i,
                count: 1,
                stress: 1,
                accent: "H*".to_owned(),
            });
        }
    }
    SpokenSentence {
        spoken,
        pauses: 1.0,
        moved_pauses: Vec::new(),
    }
}

fn show(track: &Speech) -> String {
    let phone = |p: &Phone| format!("{} {:.3}", p.symbol, p.end_secs);
    let phones: Vec<String> = track.utterance.phones.iter().map(phone).collect();
    phones.join(", ")
}

#[test]
fn lead_tail_and_the_pause_between_sentences_are_ours() {
    let plan = planned(vec![text("Oh. Ah.")]);
    let one = || {
        part(&[
            ("pau", 0.2, None),
            ("ow", 0.3, Some(0)),
            ("pau", 0.25, None),
        ])
    };
    let track = assemble(&plan, &[one(), one()], &[], &[], RATE_HZ);
    assert_eq!(
        show(&track),
        "pau 0.120, ow 0.420, pau 1.020, ow 1.320, pau 1.470"
    );
    let u = &track.utterance;
    assert_eq!((u.duration_secs, track.samples.len()), (1.47, 23_520));
    let words: Vec<_> = u
        .words
        .iter()
        .map(|w| (w.text.as_str(), w.start_secs, w.end_secs))
        .collect();
    assert_eq!(words, [("Oh.", 0.12, 0.42), ("Ah.", 1.02, 1.32)]);
    assert_eq!(u.text, "Oh. Ah.");
    assert_eq!(u.text_starts, [0, 4]);
    assert_eq!((u.syllables[1].first_phone, u.accents[1].syllable), (3, 1));
    assert_eq!((u.sentences.len(), u.phrases.len()), (2, 2));
    assert_eq!(u.f0.len(), 148);
}

#[test]
fn breaks_have_their_length_inside_between_and_around() {
    let plan = planned(vec![
        pause(100),
        text("Oh"),
        pause(500),
        text("ah."),
        pause(1000),
        text("Eh"),
        pause(200),
    ]);
    let first = [
        ("pau", 0.2, None),
        ("ow", 0.3, Some(0)),
        ("pau", 0.11, None),
        ("aa", 0.2, Some(1)),
        ("pau", 0.2, None),
    ];
    let second = [("pau", 0.2, None), ("eh", 0.3, Some(0)), ("pau", 0.2, None)];
    let track = assemble(&plan, &[part(&first), part(&second)], &[], &[], RATE_HZ);
    assert_eq!(
        show(&track),
        "pau 0.220, ow 0.520, pau 1.020, aa 1.220, pau 2.220, eh 2.520, pau 2.870"
    );
}

#[test]
fn a_pause_is_made_where_the_engine_makes_none() {
    let plan = planned(vec![text("Oh"), pause(300), text("ah.")]);
    let joined = [("ow", 0.3, Some(0)), ("aa", 0.2, Some(1))];
    let track = assemble(&plan, &[part(&joined)], &[], &[], RATE_HZ);
    assert_eq!(
        show(&track),
        "pau 0.120, ow 0.420, pau 0.720, aa 0.920, pau 1.070"
    );
}

#[test]
fn recordings_are_inserted_or_lie_softly_under_the_speech() {
    let audio = |background| SpeechRequest::Audio {
        src: "a.wav".to_owned(),
        background,
        level: 0.5,
    };
    let spoken = [
        ("ow", 0.5, Some(0)),
        ("pau", 0.8, None),
        ("aa", 0.5, Some(1)),
    ];
    let recording = |secs: f64| Recording {
        samples: (0..(secs * RATE_HZ) as usize)
            .map(|i| 0.1 * ops::sin(i as f64 * 0.9))
            .collect(),
    };
    let plan = planned(vec![text("Oh"), audio(false), text("ah.")]);
    let track = assemble(&plan, &[part(&spoken)], &[recording(0.4)], &[], RATE_HZ);
    assert!(show(&track).contains("snd"), "{}", show(&track));
    let length = 0.12 + 0.5 + 0.8 + 0.4 + 0.5 + TAIL_SECS;
    assert!(
        (track.utterance.duration_secs - length).abs() < 0.002,
        "the duration includes the recording"
    );

    // Under the speech: the same length, and louder in pauses of speech.
    let plan = planned(vec![audio(true), text("Oh ah.")]);
    let alone = planned(vec![text("Oh ah.")]);
    let track = assemble(&plan, &[part(&spoken)], &[recording(5.0)], &[], RATE_HZ);
    let plain = assemble(&alone, &[part(&spoken)], &[], &[], RATE_HZ);
    assert_eq!(show(&track), show(&plain));
    let pairs = track.samples.iter().zip(&plain.samples);
    let under: Vec<f64> = pairs.map(|(a, b)| a - b).collect();
    let level = |from: f64, to: f64| {
        crate::signal::rms(&under[(from * RATE_HZ) as usize..(to * RATE_HZ) as usize])
    };
    let (speaking, still) = (level(0.3, 0.5), level(0.95, 1.1));
    assert!(
        still > 2.0 * speaking && speaking > 0.0,
        "{still} {speaking}"
    );
    assert!(still < 0.05, "no louder than it is asked for: {still}");
}

#[test]
fn peaks_are_rounded_off_and_pauses_are_still() {
    let plan = planned(vec![text("Oh"), pause(600), text("ah.")]);
    let mut loud = part(&[("ow", 0.5, Some(0)), ("aa", 0.5, Some(1))]);
    loud.spoken.samples.iter_mut().for_each(|s| *s *= 10.0);
    let track = assemble(&plan, &[loud], &[], &[], RATE_HZ);
    let peak = track.samples.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
    assert!((KNEE..=PEAK).contains(&peak), "{peak}");
    let pause_frame = db_of_code(track.utterance.intensity[92]);
    assert!(pause_frame < -90.0, "{pause_frame}");
}

#[test]
fn nothing_to_say_is_a_short_silence() {
    let track = assemble(&Plan::default(), &[], &[], &[], RATE_HZ);
    assert_eq!(track.utterance.words, []);
    assert!(
        track.utterance.duration_secs > 0.0,
        "the silence has a duration"
    );
}
