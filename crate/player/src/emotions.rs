//! From emotions of the script and of what is said to spans of the actor.

use raconteur_actor::EmotionSpan;
use raconteur_base::order::sort_by_number;
use raconteur_eml::{ClauseId, ClauseKind, Emotion, EmotionKind};
use raconteur_speech::bundle::Emotion as Spoken;
use raconteur_speech::emotion::{Place, place};

use crate::cues::UtteranceCue;
use crate::script::Script;
use crate::voice::PLAIN_POTENTIAL;

/// How long an emotion takes to come, seconds. Designed: an onset that is felt, not posed.
const ATTACK_SECS: f64 = 0.6;
/// How long it takes to go when nothing follows, seconds. Designed.
const DECAY_SECS: f64 = 4.0;
/// How long it takes to go when another one or `neutral` comes, seconds. Designed.
const CHANGE_SECS: f64 = 0.8;

/// An emotion of the script at its time.
struct Elicited<'s> {
    clause: ClauseId,
    emotion: &'s Emotion,
    start_secs: f64,
    until_secs: f64,
}

/// Every emotion of a script: those that it elicits, kept up for their duration and while
/// something is said in them, until another one comes; and those that markup and emoticons
/// give to what is said (F&H section 4.3.5).
pub(crate) fn spans(script: &Script, utterances: &[UtteranceCue]) -> Vec<EmotionSpan> {
    let mut elicited = elicited(script);
    for utterance in utterances {
        let end_secs = utterance.start_secs + utterance.duration_secs;
        if let Some(i) = spoken_in(&elicited, utterance) {
            elicited[i].until_secs = elicited[i].until_secs.max(end_secs);
        }
    }
    let mut starts: Vec<f64> = elicited.iter().map(|one| one.start_secs).collect();
    sort_by_number(&mut starts, |start| *start);
    let mut spans = Vec::new();
    for one in &elicited {
        // Several that begin together are felt together; a later one takes over.
        let next = starts.partition_point(|start| *start <= one.start_secs);
        let (mut until_secs, mut end_secs) = (one.until_secs, one.until_secs + DECAY_SECS);
        if let Some(next) = starts.get(next) {
            until_secs = until_secs.min(*next);
            end_secs = end_secs.min(next + CHANGE_SECS);
        }
        let Some(place) = place(one.emotion.kind.word()) else {
            continue;
        };
        spans.push(EmotionSpan {
            start_secs: one.start_secs,
            apex_secs: one.start_secs + ATTACK_SECS,
            until_secs,
            end_secs,
            place,
            intensity: one.emotion.potential / PLAIN_POTENTIAL,
        });
    }
    for utterance in utterances {
        let elicited = spoken_in(&elicited, utterance).map(|i| elicited[i].emotion.kind.word());
        if let Some(own) = script.utterance(utterance.clause) {
            let emotions = own.emotions.iter();
            let felt = emotions.filter_map(|e| spoken(e, utterance.start_secs, elicited));
            spans.extend(felt);
        }
    }
    spans
}

/// An emotion that is baked into an utterance of a begin, story seconds. `elicited` is the
/// word of the one that the script elicits for all of it: that one is baked as there from the
/// first word on, and is a span of its own already.
fn spoken(emotion: &Spoken, start_secs: f64, elicited: Option<&str>) -> Option<EmotionSpan> {
    if elicited == Some(&*emotion.name) && emotion.apex_secs <= emotion.start_secs {
        return None;
    }
    Some(EmotionSpan {
        start_secs: start_secs + emotion.start_secs,
        apex_secs: start_secs + emotion.apex_secs,
        until_secs: start_secs + emotion.apex_secs,
        end_secs: start_secs + emotion.end_secs,
        place: Place {
            activation: emotion.activation,
            evaluation: emotion.evaluation,
            power: emotion.power,
        },
        intensity: 1.0,
    })
}

/// The emotions that a script elicits, `neutral` among them, by their clauses and of one
/// clause by start.
fn elicited(script: &Script) -> Vec<Elicited<'_>> {
    let clauses = script.timeline.clauses.iter();
    let found = clauses.filter_map(|timed| {
        let ClauseKind::Emotion(emotion) = &script.document.clause(timed.clause).kind else {
            return None;
        };
        Some(Elicited {
            clause: timed.clause,
            emotion,
            start_secs: timed.start_secs,
            until_secs: timed.start_secs + ATTACK_SECS + emotion.duration_secs,
        })
    });
    let mut elicited: Vec<Elicited<'_>> = found.collect();
    sort_by_number(&mut elicited, |one| one.clause.index() as f64);
    elicited
}

/// The emotion in which something is said: as for the voice, the last one before it in the
/// document, as it came last.
fn spoken_in(elicited: &[Elicited<'_>], utterance: &UtteranceCue) -> Option<usize> {
    let before = elicited.partition_point(|one| one.clause < utterance.clause);
    let last = elicited[..before].last()?.clause;
    let first = elicited.partition_point(|one| one.clause < last);
    let begun = elicited[first..before].partition_point(|o| o.start_secs <= utterance.start_secs);
    let i = first + begun.checked_sub(1)?;
    (elicited[i].emotion.kind != EmotionKind::Neutral).then_some(i)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cues::utterances;

    /// Spans as words with their times in hundredths of a second.
    fn of(body: &str) -> Vec<(f64, [f64; 4], f64)> {
        let eml = format!("<eml xmlns:r='urn:raconteur:eml:1'><body>{body}</body></eml>");
        let script = Script::read(&eml, None);
        let spans = spans(&script, &utterances(&script));
        let hundredths = |secs: f64| (100.0 * secs).round();
        spans
            .into_iter()
            .map(|s| {
                let times = [s.start_secs, s.apex_secs, s.until_secs, s.end_secs];
                (s.place.activation, times.map(hundredths), s.intensity)
            })
            .collect()
    }

    #[test]
    fn an_emotion_comes_stays_and_goes() {
        assert_eq!(
            of("<r:emotion time='1' type='joy'/>"),
            [(17.3, [100.0, 160.0, 160.0, 560.0], 1.0)]
        );
        assert_eq!(
            of("<r:emotion time='1' type='fear' duration='3' potential='2.5'/>"),
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
            of(two),
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
        let span = spoken(&emoticon, 10.0, Some("joy")).expect("a span");
        let times = [
            span.start_secs,
            span.apex_secs,
            span.until_secs,
            span.end_secs,
        ];
        assert_eq!(times, [10.2, 10.9, 10.9, 12.0]);
        assert_eq!(Some(span.place), place("joy"));
        let throughout = Spoken {
            apex_secs: 0.2,
            ..emoticon
        };
        assert_eq!(spoken(&throughout, 10.0, Some("joy")), None);
        assert!(spoken(&throughout, 10.0, Some("fear")).is_some());
        assert!(spoken(&throughout, 10.0, None).is_some());
    }

    #[test]
    fn it_stays_while_something_is_said_in_it() {
        let body = "<r:emotion time='0' type='joy'/>\
                    <voice-text time='1'>one two three four five six seven</voice-text>";
        let spans = of(body);
        let script = Script::read(
            "<eml><body><voice-text time='1'>one two three four five six seven</voice-text>\
             </body></eml>",
            None,
        );
        let said = utterances(&script)[0].duration_secs;
        assert_eq!(spans[0].1[2], (100.0 * (1.0 + said)).round());
        // What stands before it in the document is not said in it.
        let before = "<voice-text time='1'>one two three four five six seven</voice-text>\
                      <r:emotion time='0' type='joy'/>";
        assert_eq!(of(before)[0].1[2], 60.0);
    }
}
