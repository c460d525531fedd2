//! Timeline: every clause at absolute seconds.

mod expand;
mod flow;
mod index;
mod names;
mod solve;

use crate::diagnostic::Sink;
use crate::{ClauseId, Diagnostic, Document, Durations, Limits, Name, SortedMap, VoiceTiming};
use index::EndIndex;
use names::Names;

/// Resolved timeline with the diagnostics of its times.
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// Timeline; clauses without a time are left out.
    pub timeline: Timeline,
    /// Diagnostics of unresolvable or suspicious times.
    pub diagnostics: Vec<Diagnostic>,
}

/// Absolute times of all clauses of a document, seconds from the start of the script.
///
/// # Examples
///
/// ```
/// use raconteur_eml::{EstimatedDurations, Timeline, parse};
///
/// let parsed = parse("<eml><body><voice-text time='1'>Hello world!</voice-text></body></eml>");
/// assert_eq!(parsed.diagnostics, [], "the script is valid");
/// let resolved = Timeline::resolve(&parsed.document, &EstimatedDurations::default());
/// assert_eq!(resolved.timeline.clauses[0].start_secs, 1.0);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Timeline {
    /// Length of the script.
    pub duration_secs: f64,
    /// Delay of the whole timeline, seconds, so nothing starts before 0.
    pub lead_in_secs: f64,
    /// The clauses by start, ties in document order.
    pub clauses: Vec<TimedClause>,
    /// Named markers; those inside a repetition refer to its first iteration.
    pub marks: SortedMap<Name, f64>,
    /// Timings of each clause's speech, counted from its start.
    pub voices: SortedMap<ClauseId, VoiceTiming>,
    ends: EndIndex,
}

/// Clause with its resolved start and end. A clause in a repetition appears once per iteration; all
/// other data are in the document.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedClause {
    /// Start time, at least 0.
    pub start_secs: f64,
    /// End time, at least its start.
    pub end_secs: f64,
    /// The clause in the document.
    pub clause: ClauseId,
    /// Index in [`Timeline::clauses`] of the seq or par it plays in.
    pub container: Option<u32>,
    /// Iteration of that group, from 0.
    pub iteration: u32,
}

impl Timeline {
    /// Resolves every time of a document. Clauses whose time cannot be resolved are
    /// reported and left out with everything in them.
    ///
    /// A plain number counts from the start of the script; in a par from the start of the par; in a
    /// seq from the end of the previous clause. An expression that names a time counts from the
    /// start of the script, regardless of its position. Each repetition of a group is a copy of the
    /// first, shifted in time. If a clause would start before 0, everything is delayed (GEVH D.2,
    /// fig. 3.13).
    #[must_use]
    pub fn resolve(document: &Document, durations: &dyn Durations) -> Resolved {
        Self::resolve_with(document, durations, &Limits::default())
    }

    /// Resolves a timeline with other limits on repetitions and diagnostics, see
    /// [`Timeline::resolve`].
    #[must_use]
    pub fn resolve_with(
        document: &Document,
        durations: &dyn Durations,
        limits: &Limits,
    ) -> Resolved {
        let mut sink = Sink::new(limits.diagnostics);
        let found = Names::collect(document, durations, &mut sink);
        let counts = expand::bounded_counts(document, &found.groups, limits, &mut sink);
        let times = solve::solve(document, durations, &found, &counts, &mut sink);
        let mut timeline = expand::expand(document, &times, &counts);
        let lead_in_secs = timeline.lead_in_secs;
        timeline.marks = found.names.map(|moment| {
            let start = times.start(moment.clause)?;
            Some(start + moment.offset_secs + lead_in_secs)
        });
        timeline.voices = found.voices;
        flow::check(document, &timeline, &mut sink);
        if found.asynchronous {
            timeline.with_heard_ends();
        }
        Resolved {
            timeline,
            diagnostics: sink.finish(),
        }
    }

    /// Extends the timeline to the end of all asynchronous speech.
    fn with_heard_ends(&mut self) {
        for timed in &self.clauses {
            let said = self.voices.get(&timed.clause);
            let end_secs = timed.start_secs + said.map_or(0.0, |v| v.duration_secs);
            self.duration_secs = self.duration_secs.max(end_secs);
        }
    }

    /// Returns the clauses active at a time (`start <= t < end`) with their indices, by start.
    /// Clauses without duration are never active. O(log n) each, without allocation.
    pub fn active_at(&self, t_secs: f64) -> impl Iterator<Item = (usize, &TimedClause)> {
        let started = self.clauses.partition_point(|c| c.start_secs <= t_secs);
        self.ends
            .after(&self.clauses[..started], |c| c.end_secs, t_secs)
            .map(|i| (i, &self.clauses[i]))
    }

    /// Returns the clauses that start at or after `from_secs` and before `to_secs`. O(log n).
    #[must_use]
    pub fn between(&self, from_secs: f64, to_secs: f64) -> &[TimedClause] {
        let from = self.clauses.partition_point(|c| c.start_secs < from_secs);
        let to = self.clauses.partition_point(|c| c.start_secs < to_secs);
        &self.clauses[from..to.max(from)]
    }
}
