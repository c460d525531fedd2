//! Cues: times at which a page is notified while a story plays.

use raconteur_base::order::sort_by_number;
use raconteur_eml::{Clause, ClauseId, ClauseKind, Markup, TextSegment, TimedClause, VoiceText};
use raconteur_speech::TimedUtterance;

use crate::Script;
use crate::lower::anchor::{is_anchor, is_anchor_name};
use crate::lower::utterance;

/// Event at a story time, such as the start of a word, that listeners are notified of.
#[derive(Clone, Debug, PartialEq)]
pub struct Cue {
    /// Time of the event, story time, seconds.
    pub time_secs: f64,
    /// Fragment of a live performance that it belongs to; `None` for the story itself.
    pub fragment: Option<u32>,
    /// Kind of the event, with its data.
    pub kind: CueKind,
}

/// Kind of event that a [`Cue`] reports, for example the start of a word or clause.
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
        /// Index of the utterance.
        utterance: usize,
    },
    /// An utterance ends.
    UtteranceEnd {
        /// Index of the utterance.
        utterance: usize,
    },
    /// A marker is reached.
    Mark {
        /// Name of the marker, from a `timeId` or a `tm`.
        name: String,
    },
    /// A clause begins.
    ClauseStart(ClauseRef),
    /// A clause ends.
    ClauseEnd(ClauseRef),
    /// A clause of a live performance was passed over by a seek and is not performed.
    ClauseSkipped(ClauseRef),
    /// The script's `event` element.
    StoryEvent {
        /// Type of the event clause.
        kind: Option<String>,
        /// Payload of the event; plain text, never markup.
        payload: String,
    },
}

/// Identification of a clause for listeners: index, element name and `timeId`.
#[derive(Clone, Debug, PartialEq)]
pub struct ClauseRef {
    /// Index of the clause in its script or fragment, from 0 in document order.
    pub clause: ClauseId,
    /// The name of its element.
    pub element: &'static str,
    /// `timeId` of the clause; `None` if it has none.
    pub id: Option<String>,
}

impl ClauseRef {
    pub(crate) fn from_clause(id: ClauseId, clause: &Clause) -> Self {
        Self {
            clause: id,
            element: clause.kind.name(),
            id: clause.time_id.as_ref().map(ToString::to_string),
        }
    }
}

/// Utterance of a script with its time and the data that the page needs to play it.
#[derive(Clone, Debug, PartialEq)]
pub struct UtteranceCue {
    /// The utterance, with words as the script writes them; without sound when it was not baked.
    pub timed: TimedUtterance,
    /// True if the times are estimated because it was not baked.
    pub estimated: bool,
    /// BCP 47 tag of its language: of the baked voice, or of the markup around all of it; `None`
    /// leaves it to the page.
    pub language: Option<String>,
    /// Voice that the script names for it directly or by `voice-change`; `None` for the story's
    /// own.
    pub voice: Option<String>,
    /// The phone set of its voice, for example `radio`.
    pub phone_set: String,
    /// Clause of the utterance in the document.
    pub clause: ClauseId,
}

/// Returns all utterances of a script, sorted by time.
#[must_use]
pub(crate) fn utterances(script: &Script) -> Vec<UtteranceCue> {
    script
        .timeline
        .clauses
        .iter()
        .filter_map(|timed| {
            let voice = script.document.clause(timed.clause).kind.spoken_text()?;
            let timing = script.timeline.voices.get(&timed.clause)?;
            let baked = script.utterance(timed.clause);
            let marked = marked_language(&voice);
            let mimed = marked.or_else(|| script.usual_language());
            Some(UtteranceCue {
                timed: TimedUtterance {
                    start_secs: timed.start_secs,
                    utterance: utterance::utterance_of(&voice, timing, baked, mimed),
                },
                estimated: timing.estimated,
                language: script.language(timed.clause).or(marked).map(str::to_owned),
                voice: script.named_voice(timed.clause).map(str::to_owned),
                phone_set: script.phone_set(timed.clause).to_owned(),
                clause: timed.clause,
            })
        })
        .collect()
}

/// Returns the language of markup that opens before the first word; `None` if there is none.
fn marked_language(voice: &VoiceText) -> Option<&str> {
    let opens = |piece: &TextSegment| match piece {
        TextSegment::Text { text, .. } => text.trim().is_empty(),
        _ => true,
    };
    let mut before = voice.pieces.iter().take_while(|piece| opens(piece));
    before.find_map(|piece| match piece {
        TextSegment::Start { markup, .. } => match &**markup {
            Markup::Language(language) => Some(&*language.id),
            _ => None,
        },
        _ => None,
    })
}

/// Returns every cue of a script, by time; at the same time ends come before starts, except for
/// clauses of zero length, which start before they end. `first_utterance` is the index of the
/// script's first utterance.
#[must_use]
pub(crate) fn cues(
    script: &Script,
    utterances: &[UtteranceCue],
    first_utterance: usize,
    fragment: Option<u32>,
) -> Vec<Cue> {
    let mut cues = RankedCues {
        fragment,
        cues: Vec::new(),
    };
    for timed in &script.timeline.clauses {
        let clause = script.document.clause(timed.clause);
        if !is_anchor(clause) {
            cues.add_clause(timed, clause);
        }
    }
    for (utterance, cue) in (first_utterance..).zip(utterances) {
        cues.add_utterance(utterance, cue);
        if let ClauseKind::VoiceText(voice) = &script.document.clause(cue.clause).kind {
            cues.add_markers(voice, &cue.timed);
        }
        if !cue.estimated {
            cues.add_phones(utterance, &cue.timed);
        }
    }
    for (name, &at) in script.timeline.marks.iter() {
        if !is_anchor_name(name) {
            let name = name.to_string();
            cues.add(Rank::Moment, at, CueKind::Mark { name });
        }
    }
    cues.by_time()
}

/// Order of simultaneous cues.
#[derive(Clone, Copy)]
enum Rank {
    End,
    ClauseStart,
    Moment,
    /// The end of a clause of zero length.
    EmptyEnd,
}

impl Rank {
    fn of_end(is_empty: bool) -> Self {
        if is_empty { Self::EmptyEnd } else { Self::End }
    }
}

/// Cues while they are collected.
struct RankedCues {
    fragment: Option<u32>,
    cues: Vec<(Rank, Cue)>,
}

impl RankedCues {
    fn add(&mut self, rank: Rank, time_secs: f64, kind: CueKind) {
        let cue = Cue {
            time_secs,
            fragment: self.fragment,
            kind,
        };
        self.cues.push((rank, cue));
    }

    fn add_clause(&mut self, timed: &TimedClause, clause: &Clause) {
        let named = ClauseRef::from_clause(timed.clause, clause);
        let start = CueKind::ClauseStart(named.clone());
        self.add(Rank::ClauseStart, timed.start_secs, start);
        if let ClauseKind::Event { kind, payload } = &clause.kind {
            let event = CueKind::StoryEvent {
                kind: kind.as_ref().map(ToString::to_string),
                payload: payload.to_string(),
            };
            self.add(Rank::Moment, timed.start_secs, event);
        }
        let lasts = timed.end_secs > timed.start_secs;
        let end = CueKind::ClauseEnd(named);
        self.add(Rank::of_end(!lasts), timed.end_secs, end);
    }

    /// Adds the cues for start, end and words of an utterance.
    fn add_utterance(&mut self, utterance: usize, cue: &UtteranceCue) {
        let timed = &cue.timed;
        let start = CueKind::UtteranceStart { utterance };
        self.add(Rank::Moment, timed.start_secs, start);
        let lasts = timed.utterance.duration_secs > 0.0;
        let end = CueKind::UtteranceEnd { utterance };
        self.add(Rank::of_end(!lasts), timed.end_secs(), end);
        for (word, w) in timed.utterance.words.iter().enumerate() {
            let at = timed.story_secs(w.start_secs);
            self.add(Rank::Moment, at, CueKind::Word { utterance, word });
        }
    }

    /// Adds the cues for the markers of a text, each at the start of the next word, or at the end.
    fn add_markers(&mut self, voice: &VoiceText, timed: &TimedUtterance) {
        let words = voice.words();
        for piece in &voice.pieces {
            let TextSegment::Marker { mark, span } = piece else {
                continue;
            };
            let before = words.partition_point(|w| w.span.start < span.start);
            let next = timed.utterance.words.get(before);
            let at = next.map_or(timed.end_secs(), |w| timed.story_secs(w.start_secs));
            let name = mark.clone();
            self.add(Rank::Moment, at, CueKind::Mark { name });
        }
    }

    fn add_phones(&mut self, utterance: usize, timed: &TimedUtterance) {
        for (phone, p) in timed.utterance.phones.iter().enumerate() {
            let at = timed.story_secs(p.start_secs);
            self.add(Rank::Moment, at, CueKind::Phone { utterance, phone });
        }
    }

    fn by_time(mut self) -> Vec<Cue> {
        // Stable sorts, the least important first.
        self.cues.sort_by_key(|(rank, _)| *rank as u8);
        sort_by_number(&mut self.cues, |(_, cue)| cue.time_secs);
        self.cues.into_iter().map(|(_, cue)| cue).collect()
    }
}
