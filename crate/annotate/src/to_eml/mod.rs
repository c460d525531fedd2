//! Transcriptions as EML scripts (GEVH 3.5.3): words become speech, phases gesture-keys, and gestures
//! of other classes keyframe animations.
//!
//! A source's own rest differs from the performer's. So a preparation departs from wherever the hand
//! is, and a retraction returns to the performer's rest: positions at the very start of the one and
//! at the very end of the other are not performed.

mod anchors;
mod animations;
mod elements;
mod hands;
mod pauses;
mod phase;
mod phrases;
mod prosody;
mod seams;
mod speech;

use raconteur_eml::{ClauseKind, Diagnostic, Document};

use crate::gestura::{Transcription, Vocabulary};
use crate::script::Builder;
use anchors::Anchors;
pub use pauses::fit_pauses;

/// Reference of the times of gestures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Anchoring {
    /// Marks at the words on which the strokes fall, so that gestures stay with their words in
    /// another voice.
    #[default]
    Words,
    /// Seconds of the recording.
    Seconds,
}

/// Converts a transcription to a script. What is informal or missing is reported, each with how it
/// was filled in. Words are anchors only if there are any.
#[must_use]
pub fn to_eml(transcription: &Transcription, anchoring: Anchoring) -> (Document, Vec<Diagnostic>) {
    let mut builder = Builder::default();
    let mut anchors = Anchors::new(transcription, anchoring);
    let plan = phrases::plan(transcription, &mut builder.problems);
    seams::check(&plan, &mut builder.problems);
    // Anchors are chosen first, since the spoken text contains their marks.
    for phrase in &plan {
        anchors.choose(phrase.stroke_secs());
    }
    for gesture in animations::performed(transcription) {
        anchors.choose(gesture.interval.start_secs);
    }
    for level in &transcription.levels {
        if let Some(start_secs) = level_start(transcription, level) {
            anchors.choose(start_secs);
        }
    }
    for event in &transcription.staging {
        anchors.choose(event.interval.start_secs);
    }
    elements::settings(
        &transcription.settings,
        &mut builder.document,
        &mut builder.problems,
    );
    speech::write(&mut builder, transcription, &anchors);
    for level in &transcription.levels {
        if let Some(start_secs) = level_start(transcription, level) {
            let event = ClauseKind::Event {
                kind: Some("discourse-level".into()),
                payload: level.level.word().into(),
            };
            builder.push(anchors.time(start_secs, start_secs), event);
        }
    }
    staging(&mut builder, transcription, &anchors);
    animations::write(&mut builder, transcription, &anchors);
    phrases::write(&mut builder, &plan, &anchors);
    (builder.document, builder.problems)
}

fn level_start(transcription: &Transcription, level: &crate::gestura::LevelSpan) -> Option<f64> {
    let utterance = transcription.utterances.get(*level.utterances.start())?;
    Some(transcription.utterance_interval(utterance)?.start_secs)
}

/// Adds the events on stage.
fn staging(builder: &mut Builder, transcription: &Transcription, anchors: &Anchors) {
    for event in &transcription.staging {
        let clause = elements::clause(
            &event.element,
            &event.attributes,
            event.interval.length_secs(),
            event.span,
            &mut builder.problems,
        );
        if let Some(kind) = clause {
            let start_secs = event.interval.start_secs;
            builder.push(anchors.time(start_secs, start_secs), kind);
        }
    }
}
