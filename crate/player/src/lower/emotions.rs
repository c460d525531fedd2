//! Conversion of emotions of the script and of its utterances to spans of the actor.

use raconteur_actor::{Affect, EmotionSpan, emotion};
use raconteur_base::order::sort_by_number;
use raconteur_eml::{ClauseId, ClauseKind, Emoticon, Emotion, EmotionSpace};
use raconteur_speech::TimedUtterance;
use raconteur_speech::bundle::Emotion as Spoken;
use raconteur_speech::emotion::EmotionPoint;
use raconteur_spoken::{PLAIN_POTENTIAL, place_of, word_of};

use crate::lower::cues::UtteranceCue;
use crate::lower::expressed_emotion::ExpressedEmotion;
use crate::lower::script::Script;

/// Onset time of an emotion, seconds. Designed: a genuine onset, not a posed one.
const ATTACK_SECS: f64 = 0.6;
/// Decay time of a speech emotion without a successor, seconds. Designed.
const DECAY_SECS: f64 = 4.0;
/// Fade time when another emotion or `neutral` follows, seconds. Designed.
const CHANGE_SECS: f64 = 0.8;
/// Time for which the emotion of a final emoticon is sustained in the pause after the text,
/// seconds. Designed: most expressions last half a second to four (Frank, Ekman & Friesen 1993,
/// doi:10.1037/0022-3514.64.1.83).
const PAUSE_SECS: f64 = 2.0;

/// An emotion of the script at its time.
struct ElicitedEmotion<'s> {
    clause: ClauseId,
    emotion: &'s Emotion,
    start_secs: f64,
    until_secs: f64,
}

/// Returns every emotion of a script: elicited ones, sustained for their duration and while speech
/// in them continues, until another one follows; and those of emoticons and markup in speech (F&H
/// section 4.3.5). Emoticons are read from the text, so their effect does not depend on baking; the
/// markup of files and of SABLE is only in their bundle.
pub(crate) fn spans(script: &Script, utterances: &[UtteranceCue]) -> Vec<ExpressedEmotion> {
    let mut elicited = elicited(script);
    for utterance in utterances {
        let end_secs = utterance.timed.end_secs();
        if let Some(i) = spoken_in(&elicited, utterance) {
            elicited[i].until_secs = elicited[i].until_secs.max(end_secs);
        }
    }
    let mut starts: Vec<f64> = elicited.iter().map(|one| one.start_secs).collect();
    sort_by_number(&mut starts, |start| *start);
    let mut spans = Vec::new();
    for one in &elicited {
        // Emotions that start simultaneously are blended; a later one replaces them.
        let next = starts.partition_point(|start| *start <= one.start_secs);
        let (mut until_secs, mut end_secs) =
            (one.until_secs, one.until_secs + one.emotion.decay_secs);
        if let Some(next) = starts.get(next) {
            until_secs = until_secs.min(*next);
            end_secs = end_secs.min(next + CHANGE_SECS);
        }
        let Some(affect) = affect(one.emotion) else {
            continue;
        };
        spans.push(ExpressedEmotion {
            span: EmotionSpan {
                start_secs: one.start_secs,
                apex_secs: one.start_secs + ATTACK_SECS,
                until_secs,
                end_secs,
                affect,
                intensity: one.emotion.intensity() / PLAIN_POTENTIAL,
            },
            potential: one.emotion.potential,
        });
    }
    starts.extend(utterances.iter().map(|u| u.timed.start_secs));
    sort_by_number(&mut starts, |start| *start);
    for utterance in utterances {
        let text = script.document.clause(utterance.clause).kind.spoken_text();
        if let Some(text) = text.filter(|text| !text.pieces.is_empty()) {
            let found = text.emoticons().into_iter();
            spans.extend(
                found.filter_map(|one| written(&one, &utterance.timed, &starts).map(plain)),
            );
            continue;
        }
        let elicited = spoken_in(&elicited, utterance).and_then(|i| word_of(elicited[i].emotion));
        let timed = &utterance.timed;
        let emotions = timed.utterance.emotions.iter();
        spans.extend(emotions.filter_map(|e| utterance_emotion(e, timed, elicited).map(plain)));
    }
    spans
}

/// Returns an emotion of speech, with events as strong as its intensity.
fn plain(span: EmotionSpan) -> ExpressedEmotion {
    ExpressedEmotion {
        span,
        potential: span.intensity * PLAIN_POTENTIAL,
    }
}

/// Returns the affect of a scripted emotion; `None` for neutral.
fn affect(emotion: &Emotion) -> Option<Affect> {
    Some(Affect {
        place: place_of(emotion)?,
        word: word_of(emotion),
        space: match emotion.space {
            EmotionSpace::Sphere => emotion::EmotionSpace::Sphere,
            EmotionSpace::Disc => emotion::EmotionSpace::Disc,
        },
    })
}

/// Returns the emotion of an emoticon over its phrases, at full strength at its position. At the
/// end of a text it lasts until the next utterance or emotion. `starts` holds their start times,
/// ascending.
fn written(one: &Emoticon, said: &TimedUtterance, starts: &[f64]) -> Option<EmotionSpan> {
    let affect = Affect::named(one.name)?;
    let span = |word: usize| {
        let word = said.utterance.words.get(word)?;
        Some([word.start_secs, word.end_secs].map(|secs| said.story_secs(secs)))
    };
    let start_secs = span(one.first_word).map_or(said.start_secs, |[start, _]| start);
    let (apex_secs, until_secs, end_secs) = match (span(one.before), span(one.last_word)) {
        (Some([start, _]), Some([_, end])) => (start, start, end),
        (_, last) => {
            let apex_secs = last.map_or(start_secs + ATTACK_SECS, |[_, end]| end);
            let next = starts.partition_point(|start| *start <= said.start_secs);
            let next_secs = starts.get(next).map_or(f64::INFINITY, |s| s.max(apex_secs));
            let until_secs = next_secs.min(apex_secs + PAUSE_SECS);
            let end_secs = (until_secs + DECAY_SECS).min(next_secs + CHANGE_SECS);
            (apex_secs, until_secs, end_secs)
        }
    };
    Some(EmotionSpan {
        start_secs,
        apex_secs,
        until_secs,
        end_secs,
        affect,
        intensity: 1.0,
    })
}

/// Returns an emotion baked into an utterance. `elicited` is the word of the emotion that the
/// script elicits for all of it: that one is baked from the first word on, and already has its own
/// span.
fn utterance_emotion(
    emotion: &Spoken,
    timed: &TimedUtterance,
    elicited: Option<&str>,
) -> Option<EmotionSpan> {
    if elicited == Some(&*emotion.name) && emotion.apex_secs <= emotion.start_secs {
        return None;
    }
    let place = EmotionPoint {
        activation: emotion.activation,
        evaluation: emotion.evaluation,
        power: emotion.power,
    };
    // A word at another point than in the table counts as a point.
    let named = Affect::named(&emotion.name).filter(|named| named.place == place);
    Some(EmotionSpan {
        start_secs: timed.story_secs(emotion.start_secs),
        apex_secs: timed.story_secs(emotion.apex_secs),
        until_secs: timed.story_secs(emotion.apex_secs),
        end_secs: timed.story_secs(emotion.end_secs),
        affect: named.unwrap_or(Affect::from_point(place)),
        intensity: 1.0,
    })
}

/// Returns the emotions that a script elicits, including `neutral`, by clause and then by start.
fn elicited(script: &Script) -> Vec<ElicitedEmotion<'_>> {
    let clauses = script.timeline.clauses.iter();
    let found = clauses.filter_map(|timed| {
        let ClauseKind::Emotion(emotion) = &script.document.clause(timed.clause).kind else {
            return None;
        };
        Some(ElicitedEmotion {
            clause: timed.clause,
            emotion,
            start_secs: timed.start_secs,
            until_secs: timed.start_secs + ATTACK_SECS + emotion.duration_secs,
        })
    });
    let mut elicited: Vec<ElicitedEmotion<'_>> = found.collect();
    sort_by_number(&mut elicited, |one| one.clause.index() as f64);
    elicited
}

/// Returns the emotion in force during an utterance: as for the voice, the last one before it in
/// the document, with its latest occurrence.
fn spoken_in(elicited: &[ElicitedEmotion<'_>], utterance: &UtteranceCue) -> Option<usize> {
    let before = elicited.partition_point(|one| one.clause < utterance.clause);
    let last = elicited[..before].last()?.clause;
    let first = elicited.partition_point(|one| one.clause < last);
    let begun =
        elicited[first..before].partition_point(|o| o.start_secs <= utterance.timed.start_secs);
    let i = first + begun.checked_sub(1)?;
    place_of(elicited[i].emotion).map(|_| i)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lower::cues::utterances;

    /// Spans as words with their times in hundredths of a second.
    fn lowered_emotions(body: &str) -> Vec<(f64, [f64; 4], f64)> {
        let eml = format!("<eml xmlns:r='urn:raconteur:eml:1'><body>{body}</body></eml>");
        let script = Script::read(&eml, None);
        let spans = spans(&script, &utterances(&script));
        let hundredths = |secs: f64| (100.0 * secs).round();
        spans
            .into_iter()
            .map(|ExpressedEmotion { span: s, .. }| {
                let times = [s.start_secs, s.apex_secs, s.until_secs, s.end_secs];
                (
                    s.affect.place.activation,
                    times.map(hundredths),
                    s.intensity,
                )
            })
            .collect()
    }

    #[test]
    fn an_emotion_comes_stays_and_goes() {
        assert_eq!(
            lowered_emotions("<r:emotion time='1' type='joy'/>"),
            [(17.3, [100.0, 160.0, 160.0, 560.0], 1.0)]
        );
        assert_eq!(
            lowered_emotions("<r:emotion time='1' type='fear' duration='3' potential='2.5'/>"),
            [(14.8, [100.0, 160.0, 460.0, 860.0], 0.5)]
        );
    }

    #[test]
    fn a_later_one_takes_over_and_neutral_ends_all() {
        let two = "<r:emotion time='1' type='joy' duration='9'/>\
                   <r:emotion time='1' type='pride' duration='1'/>\
                   <r:emotion time='4' type='anger' duration='9'/>\
                   <r:emotion time='6' type='neutral'/>";
        assert_eq!(
            lowered_emotions(two),
            [
                (17.3, [100.0, 160.0, 400.0, 480.0], 1.0),
                (30.0, [100.0, 160.0, 260.0, 480.0], 1.0),
                (34.0, [400.0, 460.0, 600.0, 680.0], 1.0),
            ]
        );
    }

    #[test]
    fn emoticons_are_full_where_they_stand_and_what_is_elicited_is_not_felt_twice() {
        let emoticon = Spoken {
            name: "joy".to_owned(),
            start_secs: 0.2,
            apex_secs: 0.9,
            end_secs: 2.0,
            activation: 17.3,
            evaluation: 42.2,
            power: 12.5,
        };
        let timed = TimedUtterance {
            start_secs: 10.0,
            ..TimedUtterance::default()
        };
        let span = utterance_emotion(&emoticon, &timed, Some("joy")).expect("a span");
        let times = [
            span.start_secs,
            span.apex_secs,
            span.until_secs,
            span.end_secs,
        ];
        assert_eq!(times, [10.2, 10.9, 10.9, 12.0]);
        assert_eq!(Some(span.affect), Affect::named("joy"));
        let throughout = Spoken {
            apex_secs: 0.2,
            ..emoticon
        };
        assert_eq!(utterance_emotion(&throughout, &timed, Some("joy")), None);
        assert!(
            utterance_emotion(&throughout, &timed, Some("fear")).is_some(),
            "an emotion other than the elicited one is expressed"
        );
        assert!(
            utterance_emotion(&throughout, &timed, None).is_some(),
            "an emotion without elicitation is expressed"
        );
    }

    #[test]
    fn it_stays_while_something_is_said_in_it() {
        let body = "<r:emotion time='0' type='joy'/>\
                    <voice-text time='1'>one two three four five six seven</voice-text>";
        let spans = lowered_emotions(body);
        let script = Script::read(
            "<eml><body><voice-text time='1'>one two three four five six seven</voice-text>\
             </body></eml>",
            None,
        );
        let said = utterances(&script)[0].timed.utterance.duration_secs;
        assert_eq!(spans[0].1[2], (100.0 * (1.0 + said)).round());
        // Emoticons before the word in the document are not spoken with it.
        let before = "<voice-text time='1'>one two three four five six seven</voice-text>\
                      <r:emotion time='0' type='joy'/>";
        assert_eq!(lowered_emotions(before)[0].1[2], 60.0);
    }

    /// Returns the 64-bit FNV-1a key of an utterance without voice and emotion, for tests.
    fn key(text: &str) -> u64 {
        let bytes = [b"\x01\xff", text.as_bytes()].concat();
        let add = |hash: u64, b: &u8| (hash ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3);
        bytes.iter().fold(0xcbf2_9ce4_8422_2325, add)
    }

    /// Returns a bundle with these words, one second each.
    fn bundle(text: &str, words: &[String]) -> String {
        let said = words.join(" ");
        let mut at = 0;
        let rows: Vec<String> = (0..words.len())
            .map(|i| {
                let length = words[i].chars().count();
                let row = format!("[{at}, {length}, {i}, 1]");
                at += length + 1;
                row
            })
            .collect();
        format!(
            r#"{{"format": "raconteur-speech", "version": 2, "voices": [{{"engine": "test 1",
            "voice": "v", "language": "en-GB", "phone_set": "mrpa"}}], "utterances": [{{"key":
            "{key:016x}", "content": "{key:016x}", "voice": 0, "text": {said:?}, "audio": [{{"file":
            "a.opus", "mime": "audio/ogg"}}], "words": [{rows}], "phones": "{phones}", "msecs":
            [{msecs}]}}]}}"#,
            key = key(text),
            rows = rows.join(", "),
            phones = vec!["aa"; words.len()].join(" "),
            msecs = vec!["1000"; words.len()].join(", "),
        )
    }

    /// Spans of emoticons by the words with which they begin, are full and end.
    fn by_words(script: &Script) -> Vec<(Option<&'static str>, [Option<usize>; 3])> {
        let said = utterances(script);
        let timed = &said[0].timed;
        let words = &timed.utterance.words;
        let is_at = |offset: f64, secs: f64| (timed.story_secs(offset) - secs).abs() < 1e-9;
        let at = |secs: f64| words.iter().position(|w| is_at(w.start_secs, secs));
        let until = |secs: f64| words.iter().position(|w| is_at(w.end_secs, secs));
        let found = spans(script, &said).into_iter();
        found
            .map(|ExpressedEmotion { span: s, .. }| {
                let times = [at(s.start_secs), at(s.apex_secs), until(s.end_secs)];
                (s.affect.word, times)
            })
            .collect()
    }

    #[test]
    fn emoticons_do_the_same_baked_or_not() {
        const PIECES: [&str; 20] = [
            "one", "two", "three,", "Four.", "five!", ":-)", ":-(", ";)", ":D", ":o", ":-|", "😀",
            "Hi😢", "😱", "a:o", "8:0", "-", "six;", ":-).", "seven",
        ];
        let mut felt = 0;
        for seed in 0..400 {
            let unit = |i: i64| raconteur_base::noise::unit(seed, 1, i);
            let pick = |i| PIECES[(unit(i) * PIECES.len() as f64) as usize % PIECES.len()];
            let text = (0..10).map(pick).collect::<Vec<_>>().join(" ");
            let eml = format!("<eml><body><voice-text time='0'>{text}</voice-text></body></eml>");
            let plain = Script::read(&eml, None);
            let said = utterances(&plain);
            let words: Vec<String> = said[0]
                .timed
                .utterance
                .words
                .iter()
                .map(|w| w.text.clone())
                .collect();
            assert!(said[0].estimated, "{text}");
            if words.is_empty() {
                continue;
            }
            let baked = Script::read(&eml, Some(bundle(&text, &words).as_bytes()));
            assert!(
                !utterances(&baked)[0].estimated,
                "{text}: {:?}",
                baked.diagnostics
            );
            assert_eq!(by_words(&plain), by_words(&baked), "{text}");
            felt += by_words(&plain).len();
        }
        assert!(felt > 1000, "{felt}");
    }

    #[test]
    fn the_last_emoticon_lasts_through_its_pause() {
        let spans = |body: &str| {
            let eml = format!("<eml xmlns:r='urn:raconteur:eml:1'><body>{body}</body></eml>");
            let script = Script::read(&eml, None);
            let said = utterances(&script);
            let end = said[0].timed.end_secs();
            let spans = spans(&script, &said).into_iter().map(|felt| felt.span);
            (spans.collect::<Vec<_>>(), end)
        };
        let (alone, end) = spans("<voice-text time='1'>Good day :-)</voice-text>");
        assert_eq!(alone[0].affect, Affect::named("joy").expect("a word"));
        let secs = [alone[0].apex_secs, alone[0].until_secs, alone[0].end_secs];
        assert_eq!(secs, [end, end + PAUSE_SECS, end + PAUSE_SECS + DECAY_SECS]);
        for next in [
            "<voice-text time='3'>And you</voice-text>",
            "<r:emotion time='3' type='fear'/>",
        ] {
            let (two, end) = spans(&format!(
                "<voice-text time='1'>Good day :-)</voice-text>{next}"
            ));
            let joy = two.iter().find(|s| s.affect.word == Some("joy"));
            let joy = joy.expect("the emoticon");
            assert_eq!((joy.apex_secs, joy.until_secs), (end, 3.0), "{next}");
            assert_eq!(joy.end_secs, 3.0 + CHANGE_SECS);
        }
        let (no_words, _) = spans("<voice-text time='1'>;-)</voice-text>");
        assert_eq!(no_words[0].apex_secs, 1.0 + ATTACK_SECS);
    }

    #[test]
    fn an_emotion_is_a_place_as_well() {
        let read = |attributes: &str| {
            let eml = format!(
                "<eml xmlns:r='urn:raconteur:eml:1'><body><r:emotion time='0' {attributes}/></body></eml>"
            );
            let script = Script::read(&eml, None);
            spans(&script, &[]).first().map(|s| s.span.affect)
        };
        let of = |affect: Option<Affect>| {
            affect.map(|a| {
                (
                    a.place.activation,
                    a.place.evaluation,
                    a.place.power,
                    a.word,
                )
            })
        };
        assert_eq!(
            of(read("activation='30' power='-5'")),
            Some((30.0, 0.0, -5.0, None))
        );
        assert_eq!(
            of(read("type='joy' power='50'")),
            Some((17.3, 42.2, 50.0, None))
        );
        assert_eq!(
            of(read("type='kidding'")),
            Some((20.0, 30.0, 15.0, Some("kidding")))
        );
        assert_eq!(
            read("type='pride' space='disc'").map(|a| a.space),
            Some(emotion::EmotionSpace::Disc)
        );
        assert_eq!(of(read("type='neutral'")), None);
        assert_eq!(of(read("evaluation='0'")), None);
    }
}
