//! What a page is told while a story plays: words, clauses and the story's own events.

use raconteur_base::order::sort_by_number;
use raconteur_eml::{Clause, ClauseId, ClauseKind, Markup, Piece, VoiceText};
use raconteur_speech::TimedUtterance;

use crate::Script;
use crate::live::times;
use crate::lower::utterance;

/// A moment that listeners may want to know of.
#[derive(Clone, Debug, PartialEq)]
pub struct Cue {
    /// Story time, seconds.
    pub time_secs: f64,
    /// Which fragment of a live performance it belongs to; none: the story itself.
    pub fragment: Option<u32>,
    /// What happens.
    pub kind: CueKind,
}

/// What happens at a cue.
#[derive(Clone, Debug, PartialEq)]
pub enum CueKind {
    /// A word begins.
    Word {
        /// Index of the utterance: [`crate::Player::utterance`].
        utterance: usize,
        /// Index of the word in it.
        word: usize,
    },
    /// A phone begins.
    Phone {
        /// Index of the utterance.
        utterance: usize,
        /// Index of the phone in it.
        phone: usize,
    },
    /// An utterance begins.
    UtteranceStart {
        /// Its index.
        utterance: usize,
    },
    /// An utterance ends.
    UtteranceEnd {
        /// Its index.
        utterance: usize,
    },
    /// A named moment comes.
    Mark {
        /// Its name, from a `timeId` or a `tm`.
        name: String,
    },
    /// A clause begins.
    ClauseStart(ClauseRef),
    /// A clause ends.
    ClauseEnd(ClauseRef),
    /// A clause of a live performance was passed over by a seek and will not be told.
    ClauseSkipped(ClauseRef),
    /// The script's `event` element.
    StoryEvent {
        /// Its type.
        kind: Option<String>,
        /// Its text; text, never markup.
        payload: String,
    },
}

/// What identifies a clause to listeners.
#[derive(Clone, Debug, PartialEq)]
pub struct ClauseRef {
    /// Its place among the clauses of its script or fragment, from 0 in document order.
    pub clause: ClauseId,
    /// The name of its element.
    pub element: &'static str,
    /// Its `timeId`.
    pub id: Option<String>,
}

impl ClauseRef {
    pub(crate) fn of(id: ClauseId, clause: &Clause) -> Self {
        Self {
            clause: id,
            element: clause.kind.name(),
            id: clause.time_id.as_ref().map(ToString::to_string),
        }
    }
}

/// An utterance of a script at its time, and what the page needs to have it heard.
#[derive(Clone, Debug, PartialEq)]
pub struct UtteranceCue {
    /// What is said, words as the script writes them, and when; without sound when it was not
    /// baked.
    pub timed: TimedUtterance,
    /// Whether the times are guessed because it was not baked.
    pub estimated: bool,
    /// BCP 47 tag of its language: of the voice that was baked, or of the markup that all of
    /// it stands in; none where only the page knows.
    pub language: Option<String>,
    /// The voice that the script names for it alone or by `voice-change`; none where it is the
    /// story's own.
    pub voice: Option<String>,
    /// The phone set of its voice, for example `radio`.
    pub phone_set: String,
    /// Its place in the document.
    pub clause: ClauseId,
}

/// Every utterance of a script in order of time.
#[must_use]
pub(crate) fn utterances(script: &Script) -> Vec<UtteranceCue> {
    script
        .timeline
        .clauses
        .iter()
        .filter_map(|timed| {
            let voice = script.document.clause(timed.clause).kind.spoken()?;
            let timing = script.timeline.voices.get(&timed.clause)?;
            Some(UtteranceCue {
                timed: TimedUtterance {
                    start_secs: timed.start_secs,
                    utterance: utterance::of(&voice, timing, script.utterance(timed.clause)),
                },
                estimated: timing.estimated,
                language: script
                    .language(timed.clause)
                    .or_else(|| marked_language(&voice))
                    .map(str::to_owned),
                voice: script.named_voice(timed.clause).map(str::to_owned),
                phone_set: script.phone_set(timed.clause).to_owned(),
                clause: timed.clause,
            })
        })
        .collect()
}

/// The language of the markup that opens before the first word.
fn marked_language(voice: &VoiceText) -> Option<&str> {
    let opens = |piece: &Piece| match piece {
        Piece::Text { text, .. } => text.trim().is_empty(),
        _ => true,
    };
    let mut before = voice.pieces.iter().take_while(|piece| opens(piece));
    before.find_map(|piece| match piece {
        Piece::Start { markup, .. } => match &**markup {
            Markup::Language(language) => Some(&*language.id),
            _ => None,
        },
        _ => None,
    })
}

/// Every cue of a script, by time; at the same time ends come before starts, but for
/// clauses of no length, which start before they end. `first_utterance` is the index of the
/// script's first utterance.
#[must_use]
pub(crate) fn cues(
    script: &Script,
    utterances: &[UtteranceCue],
    first_utterance: usize,
    fragment: Option<u32>,
) -> Vec<Cue> {
    let mut ranked: Vec<(u8, Cue)> = Vec::new();
    let mut push = |rank: u8, time_secs: f64, kind: CueKind| {
        let cue = Cue {
            time_secs,
            fragment,
            kind,
        };
        ranked.push((rank, cue));
    };
    for timed in &script.timeline.clauses {
        let clause = script.document.clause(timed.clause);
        if times::is_anchor(clause) {
            continue;
        }
        let named = ClauseRef::of(timed.clause, clause);
        push(1, timed.start_secs, CueKind::ClauseStart(named.clone()));
        if let ClauseKind::Event { kind, payload } = &clause.kind {
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
        push(end_rank, timed.end_secs, CueKind::ClauseEnd(named));
    }
    for (index, cue) in utterances.iter().enumerate() {
        let utterance = first_utterance + index;
        let timed = &cue.timed;
        let said = &*timed.utterance;
        push(2, timed.start_secs, CueKind::UtteranceStart { utterance });
        let end_rank = if said.duration_secs > 0.0 { 0 } else { 3 };
        push(
            end_rank,
            timed.end_secs(),
            CueKind::UtteranceEnd { utterance },
        );
        for (word, w) in said.words.iter().enumerate() {
            let at = timed.story_secs(w.start_secs);
            push(2, at, CueKind::Word { utterance, word });
        }
        if let ClauseKind::VoiceText(voice) = &script.document.clause(cue.clause).kind {
            let words = voice.words();
            for piece in &voice.pieces {
                let Piece::Marker { mark, span } = piece else {
                    continue;
                };
                let before = words.partition_point(|w| w.span.start < span.start);
                // The moment of the next word, or the end.
                let next = said.words.get(before);
                let at = next.map_or(timed.end_secs(), |w| timed.story_secs(w.start_secs));
                push(2, at, CueKind::Mark { name: mark.clone() });
            }
        }
        if cue.estimated {
            continue;
        }
        for (phone, p) in said.phones.iter().enumerate() {
            let at = timed.story_secs(p.start_secs);
            push(2, at, CueKind::Phone { utterance, phone });
        }
    }
    for (name, &at) in script.timeline.marks.iter() {
        if !times::is_anchor_name(name) {
            push(
                2,
                at,
                CueKind::Mark {
                    name: name.to_string(),
                },
            );
        }
    }
    // Stable sorts, the least important first.
    sort_by_number(&mut ranked, |(rank, _)| f64::from(*rank));
    sort_by_number(&mut ranked, |(_, cue)| cue.time_secs);
    ranked.into_iter().map(|(_, cue)| cue).collect()
}
