//! Notifications of listeners as plain objects: the element's events in a page, and the lines that
//! a mind reads.

use raconteur_eml::{Diagnostic, LineIndex, Severity};
use serde::Serialize;

use crate::live::{FragmentOutcome, LiveClause};
use crate::lower::cues::{ClauseRef, Cue, CueKind, UtteranceCue};

/// Event during the playback of a story.
#[derive(Clone, Debug, PartialEq, Serialize)]
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
        /// Live fragment that it belongs to; `None`: the story's own.
        #[serde(skip_serializing_if = "Option::is_none")]
        fragment: Option<u32>,
        /// Index of the utterance.
        utterance: usize,
        /// Index of the word in it.
        word: usize,
        /// Word as written, with punctuation.
        text: String,
        /// End, story time, seconds.
        end_secs: f64,
    },
    /// A phone begins.
    Phone {
        /// Story time, seconds.
        time_secs: f64,
        /// Live fragment that it belongs to; `None`: the story's own.
        #[serde(skip_serializing_if = "Option::is_none")]
        fragment: Option<u32>,
        /// Index of the utterance.
        utterance: usize,
        /// Symbol of the phone in the phone set of the voice.
        symbol: String,
        /// The name of that set.
        phone_set: String,
        /// End, story time, seconds.
        end_secs: f64,
    },
    /// An utterance begins or ends.
    Utterance {
        /// Story time, seconds.
        time_secs: f64,
        /// Live fragment that it belongs to; `None`: the story's own.
        #[serde(skip_serializing_if = "Option::is_none")]
        fragment: Option<u32>,
        /// `start` or `end`.
        phase: &'static str,
        /// Index of the utterance.
        utterance: usize,
        /// The text, as written.
        text: String,
        /// Start, story time, seconds.
        start_secs: f64,
        /// End, story time, seconds.
        end_secs: f64,
    },
    /// A marker is reached.
    Mark {
        /// Story time, seconds.
        time_secs: f64,
        /// Live fragment that it belongs to; `None`: the story's own.
        #[serde(skip_serializing_if = "Option::is_none")]
        fragment: Option<u32>,
        /// Name of the marker.
        name: String,
    },
    /// A clause begins or ends.
    Clause {
        /// Story time, seconds.
        time_secs: f64,
        /// Live fragment that it belongs to; `None`: the story's own.
        #[serde(skip_serializing_if = "Option::is_none")]
        fragment: Option<u32>,
        /// `start` or `end`.
        phase: &'static str,
        /// Index of the clause in its script or fragment, from 0.
        clause: u32,
        /// The name of its element.
        element: &'static str,
        /// `timeId` of the clause; `None` if it has none.
        #[serde(skip_serializing_if = "Option::is_none")]
        id: Option<String>,
    },
    /// The script's own event.
    StoryEvent {
        /// Story time, seconds.
        time_secs: f64,
        /// Live fragment that it belongs to; `None`: the story's own.
        #[serde(skip_serializing_if = "Option::is_none")]
        fragment: Option<u32>,
        /// Type of the event clause.
        #[serde(rename = "type", skip_serializing_if = "Option::is_none")]
        kind: Option<String>,
        /// Payload of the event, plain text.
        payload: String,
    },
    /// A fragment joins the performance.
    Accepted {
        /// Story time, seconds.
        time_secs: f64,
        /// Number of the fragment.
        fragment: u32,
        /// The `name` of its `eml` element.
        #[serde(skip_serializing_if = "Option::is_none")]
        name: Option<String>,
        /// Accepted clauses, by start.
        clauses: Vec<AcceptedClause>,
    },
    /// A clause or a whole fragment will not be performed.
    Failed {
        /// Story time, seconds.
        time_secs: f64,
        /// Number of the fragment.
        fragment: u32,
        /// Diagnostic code: `eml::unknown-name`, `live::busy` and so on.
        code: &'static str,
        /// Message in one sentence.
        message: String,
        /// Hints for a fix.
        #[serde(skip_serializing_if = "Vec::is_empty")]
        hints: Vec<String>,
        /// Line in the fragment, from 1; absent when it has no location.
        #[serde(skip_serializing_if = "Option::is_none")]
        line: Option<u32>,
        /// Column in characters, from 1.
        #[serde(skip_serializing_if = "Option::is_none")]
        column: Option<u32>,
        /// The clause that was skipped, from 0; absent when it is not about an accepted one.
        #[serde(skip_serializing_if = "Option::is_none")]
        clause: Option<u32>,
    },
    /// Part of a fragment may be performed otherwise than intended.
    Warning {
        /// Story time, seconds.
        time_secs: f64,
        /// Number of the fragment.
        fragment: u32,
        /// Diagnostic code.
        code: &'static str,
        /// Message in one sentence.
        message: String,
        /// Hints for a fix.
        #[serde(skip_serializing_if = "Vec::is_empty")]
        hints: Vec<String>,
        /// Line in the fragment, from 1.
        line: u32,
        /// Column in characters, from 1.
        column: u32,
    },
}

/// Clause of a live fragment that was accepted for performance, with its times.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct AcceptedClause {
    /// Index of the clause in the fragment, from 0.
    pub clause: u32,
    /// The name of its element.
    pub element: &'static str,
    /// `timeId` of the clause; `None` if it has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<String>,
    /// Start of the clause, story time, seconds.
    pub start_secs: f64,
    /// End of the clause, story time, seconds.
    pub end_secs: f64,
}

impl Event {
    /// Returns the event of a cue; `None` if its utterance was removed. `utterance_at` finds
    /// utterances by their indices.
    pub(crate) fn new<'u>(
        cue: &Cue,
        utterance_at: impl Fn(usize) -> Option<&'u UtteranceCue>,
    ) -> Option<Self> {
        let (time_secs, fragment) = (cue.time_secs, cue.fragment);
        let clause = |phase, named: &ClauseRef| Self::Clause {
            time_secs,
            fragment,
            phase,
            clause: named.clause.0,
            element: named.element,
            id: named.id.clone(),
        };
        let utterance = |phase, utterance| {
            let said = &utterance_at(utterance)?.timed;
            let words: Vec<&str> = said.utterance.words.iter().map(|w| &*w.text).collect();
            Some(Self::Utterance {
                time_secs,
                fragment,
                phase,
                utterance,
                text: words.join(" "),
                start_secs: said.start_secs,
                end_secs: said.end_secs(),
            })
        };
        Some(match &cue.kind {
            &CueKind::Word { utterance, word } => {
                let timed = &utterance_at(utterance)?.timed;
                let said = timed.utterance.words.get(word)?;
                Self::Word {
                    time_secs,
                    fragment,
                    utterance,
                    word,
                    text: said.text.clone(),
                    end_secs: timed.story_secs(said.end_secs),
                }
            }
            &CueKind::Phone { utterance, phone } => {
                let said = utterance_at(utterance)?;
                let heard = said.timed.utterance.phones.get(phone)?;
                Self::Phone {
                    time_secs,
                    fragment,
                    utterance,
                    symbol: heard.symbol.clone(),
                    phone_set: said.phone_set.clone(),
                    end_secs: said.timed.story_secs(heard.end_secs),
                }
            }
            &CueKind::UtteranceStart { utterance: index } => utterance("start", index)?,
            &CueKind::UtteranceEnd { utterance: index } => utterance("end", index)?,
            CueKind::Mark { name } => Self::Mark {
                time_secs,
                fragment,
                name: name.clone(),
            },
            CueKind::ClauseStart(named) => clause("start", named),
            CueKind::ClauseEnd(named) => clause("end", named),
            CueKind::ClauseSkipped(named) => Self::Failed {
                time_secs,
                fragment: fragment.unwrap_or_default(),
                code: "live::skipped",
                message: format!("a seek has passed over this {}", named.element),
                hints: Vec::new(),
                line: None,
                column: None,
                clause: Some(named.clause.0),
            },
            CueKind::StoryEvent { kind, payload } => Self::StoryEvent {
                time_secs,
                fragment,
                kind: kind.clone(),
                payload: payload.clone(),
            },
        })
    }
}

impl FragmentOutcome {
    /// Returns the immediate events of a fragment, for its sender. `text` is the fragment,
    /// `now_secs` the story time.
    #[must_use]
    pub fn events(&self, text: &str, now_secs: f64) -> Vec<Event> {
        let lines = LineIndex::new(text);
        let (time_secs, fragment) = (now_secs, self.fragment);
        let mut events: Vec<Event> = Vec::new();
        if !self.clauses.is_empty() || self.interrupts {
            events.push(Event::Accepted {
                time_secs,
                fragment,
                name: self.name.clone(),
                clauses: self.clauses.iter().map(AcceptedClause::new).collect(),
            });
        }
        events.extend(self.diagnostics.iter().map(|diagnostic| {
            let Diagnostic {
                code,
                severity,
                span,
                message,
                hints,
                ..
            } = diagnostic.clone();
            let at = lines.position(span.start);
            match severity {
                Severity::Error => Event::Failed {
                    time_secs,
                    fragment,
                    code,
                    message,
                    hints,
                    line: Some(at.line),
                    column: Some(at.column),
                    clause: None,
                },
                Severity::Warning => Event::Warning {
                    time_secs,
                    fragment,
                    code,
                    message,
                    hints,
                    line: at.line,
                    column: at.column,
                },
            }
        }));
        events
    }
}

impl AcceptedClause {
    fn new(accepted: &LiveClause) -> Self {
        Self {
            clause: accepted.clause.clause.0,
            element: accepted.clause.element,
            id: accepted.clause.id.clone(),
            start_secs: accepted.start_secs,
            end_secs: accepted.end_secs,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn events_are_named_as_the_element_names_them() {
        let ended = Event::Clause {
            time_secs: 2.0,
            fragment: None,
            phase: "end",
            clause: 4,
            element: "gesture-key",
            id: Some("a".to_owned()),
        };
        let json = |event| serde_json::to_value(event).unwrap_or_default();
        assert_eq!(
            json(ended),
            json!({ "kind": "clause", "timeSecs": 2.0, "phase": "end", "clause": 4,
                    "element": "gesture-key", "id": "a" })
        );
        let told = Event::StoryEvent {
            time_secs: 2.0,
            fragment: Some(3),
            kind: None,
            payload: "<b>".to_owned(),
        };
        assert_eq!(
            json(told),
            json!({ "kind": "storyevent", "timeSecs": 2.0, "fragment": 3, "payload": "<b>" })
        );
    }
}
