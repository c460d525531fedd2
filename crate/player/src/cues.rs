//! What a page is told while a story plays: words, clauses and the story's own events.

use raconteur_base::order::sort_by_number;
use raconteur_eml::{ClauseId, ClauseKind};
use raconteur_speech::AudioFile;

use crate::Script;

/// A moment that listeners may want to know of.
#[derive(Clone, Debug, PartialEq)]
pub struct Cue {
    /// Story time, seconds.
    pub time_secs: f64,
    /// What happens.
    pub kind: CueKind,
}

/// What happens at a cue.
#[derive(Clone, Debug, PartialEq)]
pub enum CueKind {
    /// A word begins.
    Word {
        /// Index into the player's utterances.
        utterance: usize,
        /// Index of the word in it.
        word: usize,
    },
    /// A clause begins.
    ClauseStart {
        /// The name of its element.
        element: &'static str,
        /// Its `timeId`.
        id: Option<String>,
    },
    /// A clause ends.
    ClauseEnd {
        /// The name of its element.
        element: &'static str,
        /// Its `timeId`.
        id: Option<String>,
    },
    /// The script's `event` element.
    StoryEvent {
        /// Its type.
        kind: Option<String>,
        /// Its text; text, never markup.
        payload: String,
    },
}

/// One spoken text at its time.
#[derive(Clone, Debug, PartialEq)]
pub struct UtteranceCue {
    /// Story time at which it starts, seconds.
    pub start_secs: f64,
    /// Its length, seconds.
    pub duration_secs: f64,
    /// Its sound, in order of preference, relative to the story's `voice` folder; empty
    /// when it was not baked.
    pub audio: Vec<AudioFile>,
    /// Its words, for captions.
    pub words: Vec<WordCue>,
    /// Whether the times are guessed because it was not baked.
    pub estimated: bool,
    /// Its place in the document.
    pub clause: ClauseId,
}

/// One word at its time.
#[derive(Clone, Debug, PartialEq)]
pub struct WordCue {
    /// As written, punctuation attached.
    pub text: String,
    /// Story time, seconds.
    pub start_secs: f64,
    /// Story time, seconds.
    pub end_secs: f64,
    /// Whether the script emphasises it.
    pub emphasized: bool,
}

/// Every utterance of a script in order of time.
#[must_use]
pub(crate) fn utterances(script: &Script) -> Vec<UtteranceCue> {
    script
        .timeline
        .clauses
        .iter()
        .filter_map(|timed| {
            let ClauseKind::VoiceText(voice) = &script.document.clause(timed.clause).kind else {
                return None;
            };
            let timing = script.timeline.voices.get(&timed.clause)?;
            let words = voice
                .words()
                .into_iter()
                .zip(&timing.words)
                .map(|(word, time)| WordCue {
                    text: word.text,
                    start_secs: timed.start_secs + time.start_secs,
                    end_secs: timed.start_secs + time.end_secs,
                    emphasized: word.emphasized,
                })
                .collect();
            Some(UtteranceCue {
                start_secs: timed.start_secs,
                duration_secs: timing.duration_secs,
                audio: script
                    .utterance(voice)
                    .map(|u| u.audio.clone())
                    .unwrap_or_default(),
                words,
                estimated: timing.estimated,
                clause: timed.clause,
            })
        })
        .collect()
}

/// Every cue of a script, by time; at the same time ends come before starts, but for
/// clauses of no length, which start before they end.
#[must_use]
pub(crate) fn cues(script: &Script, utterances: &[UtteranceCue]) -> Vec<Cue> {
    let mut ranked: Vec<(u8, Cue)> = Vec::new();
    let mut push = |rank: u8, time_secs: f64, kind: CueKind| {
        ranked.push((rank, Cue { time_secs, kind }));
    };
    for timed in &script.timeline.clauses {
        let (element, id) = (timed.element, timed.id.as_ref().map(ToString::to_string));
        push(
            1,
            timed.start_secs,
            CueKind::ClauseStart {
                element,
                id: id.clone(),
            },
        );
        if let ClauseKind::Event { kind, payload } = &script.document.clause(timed.clause).kind {
            let event = CueKind::StoryEvent {
                kind: kind.as_ref().map(ToString::to_string),
                payload: payload.to_string(),
            };
            push(2, timed.start_secs, event);
        }
        let end_rank = if timed.end_secs > timed.start_secs {
            0
        } else {
            3
        };
        push(end_rank, timed.end_secs, CueKind::ClauseEnd { element, id });
    }
    for (utterance, cue) in utterances.iter().enumerate() {
        for (word, w) in cue.words.iter().enumerate() {
            push(2, w.start_secs, CueKind::Word { utterance, word });
        }
    }
    // Stable sorts, the least important first.
    sort_by_number(&mut ranked, |(rank, _)| f64::from(*rank));
    sort_by_number(&mut ranked, |(_, cue)| cue.time_secs);
    ranked.into_iter().map(|(_, cue)| cue).collect()
}
