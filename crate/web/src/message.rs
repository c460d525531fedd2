//! What crosses to JavaScript: plain objects, named as `web/element/types.ts` names them.

use raconteur_player::eml::{self, LineIndex};
use raconteur_player::{Cue, CueKind, UtteranceCue};
use serde::Serialize;

/// A story that was read.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Story {
    /// Length, seconds.
    pub duration_secs: f64,
    /// What is said, by time.
    pub utterances: Vec<Utterance>,
    /// Problems of the text, by place.
    pub diagnostics: Vec<Diagnostic>,
}

/// A problem of the story's text.
#[derive(Debug, Serialize)]
pub struct Diagnostic {
    code: &'static str,
    severity: &'static str,
    message: String,
    hints: Vec<String>,
    start: Place,
    end: Place,
}

/// A place in the story's text; all from 1.
#[derive(Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
struct Place {
    line: u32,
    /// In characters.
    column: u32,
    /// In UTF-16 units, as JavaScript counts.
    column_utf16: u32,
}

/// Something said.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Utterance {
    start_secs: f64,
    duration_secs: f64,
    audio: Vec<AudioFile>,
    words: Vec<Word>,
    estimated: bool,
}

#[derive(Debug, Serialize)]
struct AudioFile {
    file: String,
    mime: String,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Word {
    text: String,
    start_secs: f64,
    end_secs: f64,
    emphasized: bool,
}

/// Something that happens while the story plays.
#[derive(Debug, PartialEq, Serialize)]
#[serde(
    tag = "kind",
    rename_all = "lowercase",
    rename_all_fields = "camelCase"
)]
pub enum Event {
    /// A word begins.
    Word {
        /// Story time, seconds.
        time_secs: f64,
        /// Index of the utterance.
        utterance: usize,
        /// Index of the word in it.
        word: usize,
    },
    /// A clause begins or ends.
    Clause {
        /// Story time, seconds.
        time_secs: f64,
        /// `start` or `end`.
        phase: &'static str,
        /// The name of its element.
        element: &'static str,
        /// Its `timeId`.
        #[serde(skip_serializing_if = "Option::is_none")]
        id: Option<String>,
    },
    /// The script's own event.
    StoryEvent {
        /// Story time, seconds.
        time_secs: f64,
        /// Its type.
        #[serde(rename = "type", skip_serializing_if = "Option::is_none")]
        kind: Option<String>,
        /// Its text.
        payload: String,
    },
}

impl Story {
    /// The story that a player has read from `source`.
    #[must_use]
    pub fn new(
        source: &str,
        duration_secs: f64,
        utterances: &[UtteranceCue],
        diagnostics: Vec<eml::Diagnostic>,
    ) -> Self {
        let lines = LineIndex::new(source);
        Self {
            duration_secs,
            utterances: utterances.iter().map(Utterance::new).collect(),
            diagnostics: diagnostics
                .into_iter()
                .map(|d| Diagnostic::new(d, &lines))
                .collect(),
        }
    }
}

impl Diagnostic {
    fn new(diagnostic: eml::Diagnostic, lines: &LineIndex<'_>) -> Self {
        let place = |offset| {
            let characters = lines.position(offset);
            Place {
                line: characters.line,
                column: characters.column,
                column_utf16: lines.position_utf16(offset).column,
            }
        };
        Self {
            code: diagnostic.code,
            severity: diagnostic.severity.name(),
            start: place(diagnostic.span.start),
            end: place(diagnostic.span.end),
            message: diagnostic.message,
            hints: diagnostic.hints,
        }
    }
}

impl Utterance {
    fn new(cue: &UtteranceCue) -> Self {
        let audio = |a: &raconteur_player::speech::AudioFile| AudioFile {
            file: a.file.clone(),
            mime: a.mime.clone(),
        };
        let word = |w: &raconteur_player::WordCue| Word {
            text: w.text.clone(),
            start_secs: w.start_secs,
            end_secs: w.end_secs,
            emphasized: w.emphasized,
        };
        Self {
            start_secs: cue.start_secs,
            duration_secs: cue.duration_secs,
            audio: cue.audio.iter().map(audio).collect(),
            words: cue.words.iter().map(word).collect(),
            estimated: cue.estimated,
        }
    }
}

impl From<&Cue> for Event {
    fn from(cue: &Cue) -> Self {
        let time_secs = cue.time_secs;
        let clause = |phase, element, id: &Option<String>| Self::Clause {
            time_secs,
            phase,
            element,
            id: id.clone(),
        };
        match &cue.kind {
            &CueKind::Word { utterance, word } => Self::Word {
                time_secs,
                utterance,
                word,
            },
            CueKind::ClauseStart { element, id } => clause("start", element, id),
            CueKind::ClauseEnd { element, id } => clause("end", element, id),
            CueKind::StoryEvent { kind, payload } => Self::StoryEvent {
                time_secs,
                kind: kind.clone(),
                payload: payload.clone(),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn places_count_characters_and_utf16_units() {
        let source = "<eml>\n<x y='😀' bad/>";
        let at = u32::try_from(source.find("bad").unwrap()).unwrap();
        let diagnostic = eml::Diagnostic::error("eml::test", eml::Span::new(at, at + 3), "No.");
        let story = Story::new(source, 1.5, &[], vec![diagnostic.hint("Try.")]);
        assert_eq!(
            serde_json::to_value(story).unwrap(),
            json!({
                "durationSecs": 1.5,
                "utterances": [],
                "diagnostics": [{
                    "code": "eml::test",
                    "severity": "error",
                    "message": "No.",
                    "hints": ["Try."],
                    "start": { "line": 2, "column": 10, "columnUtf16": 11 },
                    "end": { "line": 2, "column": 13, "columnUtf16": 14 },
                }],
            })
        );
    }

    #[test]
    fn cues_become_events_as_the_element_names_them() {
        let event = |kind| {
            serde_json::to_value(Event::from(&Cue {
                time_secs: 2.0,
                kind,
            }))
            .unwrap()
        };
        assert_eq!(
            event(CueKind::Word {
                utterance: 1,
                word: 3
            }),
            json!({ "kind": "word", "timeSecs": 2.0, "utterance": 1, "word": 3 })
        );
        assert_eq!(
            event(CueKind::ClauseEnd {
                element: "gesture-key",
                id: Some("a".to_owned())
            }),
            json!({ "kind": "clause", "timeSecs": 2.0, "phase": "end", "element": "gesture-key", "id": "a" })
        );
        assert_eq!(
            event(CueKind::StoryEvent {
                kind: None,
                payload: "<b>".to_owned()
            }),
            json!({ "kind": "storyevent", "timeSecs": 2.0, "payload": "<b>" })
        );
    }
}
