//! Solver of the equations between the starts and ends of clauses.
//!
//! Every clause has two unknowns, its start and its end. The solver finds them depth first with its
//! own stack, so that a chain of a hundred thousand names is no problem; an unknown that is already
//! being solved indicates a cycle.

use std::ops::{Index, IndexMut};

use super::names::ClauseIndex;
use crate::diagnostic::Sink;
use crate::suggest::{nearest, quoted};
use crate::work::step;
use crate::{
    Clause, ClauseId, ClauseKind, Diagnostic, Document, Durations, SortedMap, VoiceTiming,
};

/// Names that are looked at in all to find those that may have been meant: it bounds
/// the work on a document with many unknown names.
const MAX_LOOKS: usize = 5_000;

/// Maximum number of names listed in a message about a chain of references.
const MAX_CHAIN: usize = 32;

/// Times beyond this, about 31 years, result from overflowing sums.
const MAX_TIME_SECS: f64 = 1e9;

/// Solved start and end times of clauses: the first iteration of each, without delay.
pub(super) struct Times {
    /// Times in seconds, NaN if there is none.
    values: UnknownMap<f64>,
}

impl Times {
    /// Returns the start time of a clause.
    pub(super) fn start(&self, clause: ClauseId) -> Option<f64> {
        Some(self.values[Unknown::Start(clause)]).filter(|t| !t.is_nan())
    }

    /// Returns the end time of a clause that has a start.
    pub(super) fn end(&self, clause: ClauseId) -> f64 {
        self.values[Unknown::End(clause)]
    }
}

/// A time to solve for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Unknown {
    Start(ClauseId),
    End(ClauseId),
}

impl Unknown {
    /// Returns the unknowns (start and end) of clauses 0 to `clause_count - 1`, in document order.
    fn all(clause_count: usize) -> impl Iterator<Item = Self> {
        // A document has fewer than 2³¹ clauses.
        (0..clause_count as u32).flat_map(|i| {
            let id = ClauseId(i);
            [Self::Start(id), Self::End(id)]
        })
    }

    fn clause(self) -> ClauseId {
        match self {
            Self::Start(id) | Self::End(id) => id,
        }
    }
}

/// A value for each unknown. The two of a clause are adjacent, since they are mostly used together.
struct UnknownMap<T>(Vec<[T; 2]>);

impl<T: Copy> UnknownMap<T> {
    fn new(value: T, clause_count: usize) -> Self {
        Self(vec![[value; 2]; clause_count])
    }
}

impl<T> Index<Unknown> for UnknownMap<T> {
    type Output = T;

    fn index(&self, unknown: Unknown) -> &T {
        match unknown {
            Unknown::Start(id) => &self.0[id.index()][0],
            Unknown::End(id) => &self.0[id.index()][1],
        }
    }
}

impl<T> IndexMut<Unknown> for UnknownMap<T> {
    fn index_mut(&mut self, unknown: Unknown) -> &mut T {
        match unknown {
            Unknown::Start(id) => &mut self.0[id.index()][0],
            Unknown::End(id) => &mut self.0[id.index()][1],
        }
    }
}

/// Solves for all clauses.
pub(super) fn solve(
    document: &Document,
    durations: &dyn Durations,
    found: &ClauseIndex,
    counts: &[u32],
    sink: &mut Sink,
) -> Times {
    let n = document.clauses.len();
    let mut solver = Solver {
        document,
        durations,
        voices: &found.voices,
        counts,
        sink,
        terms: Vec::new(),
        first_term: vec![0; n],
        before: vec![None; n],
        state: UnknownMap::new(State::New, n),
        values: UnknownMap::new(f64::NAN, n),
        refused: vec![false; n],
        unresolved: Vec::new(),
        depth: UnknownMap::new(0, n),
        suspects: Vec::new(),
    };
    solver.look_up_names(found);
    solver.link_sequences(&found.groups);
    let mut stack = Vec::new();
    for unknown in Unknown::all(n) {
        if !solver.is_ready(unknown) {
            solver.find(unknown, &mut stack);
        } else if solver.state[unknown] == State::New {
            solver.settle(unknown);
        }
    }
    Times {
        values: solver.values,
    }
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    New,
    Open,
    Done,
}

/// A resolved marker in an expression.
struct Term {
    clause: ClauseId,
    offset_secs: f64,
    sign: f64,
}

struct Solver<'d, 's> {
    document: &'d Document,
    durations: &'d dyn Durations,
    voices: &'d SortedMap<ClauseId, VoiceTiming>,
    counts: &'d [u32],
    sink: &'s mut Sink,
    /// The terms of all clauses, those of one clause together, as many as it names when it
    /// is not refused.
    terms: Vec<Term>,
    /// Index of the first term of each clause.
    first_term: Vec<u32>,
    /// Previous clause in the same seq, for each clause.
    before: Vec<Option<ClauseId>>,
    state: UnknownMap<State>,
    values: UnknownMap<f64>,
    /// Clauses whose expression has been found faulty and reported.
    refused: Vec<bool>,
    /// Clauses that depend on an undefined name, with its index among their names; by clause.
    unresolved: Vec<(ClauseId, usize)>,
    /// Stack index of an open unknown.
    depth: UnknownMap<u32>,
    /// Clauses on the stack whose start names markers, with their stack index.
    suspects: Vec<(ClauseId, usize)>,
}

impl Solver<'_, '_> {
    fn look_up_names(
        &mut self,
        ClauseIndex {
            names, absolute, ..
        }: &ClauseIndex,
    ) {
        let mut looks = MAX_LOOKS;
        for &id in absolute {
            let clause = self.document.clause(id);
            // Each name occupies bytes of a source of fewer than 2³².
            self.first_term[id.index()] = self.terms.len() as u32;
            for (place, term) in clause.start.names.iter().enumerate() {
                match names.find(&term.name) {
                    Some(moment) => self.terms.push(Term {
                        clause: moment.clause,
                        offset_secs: moment.offset_secs,
                        sign: if term.negative { -1.0 } else { 1.0 },
                    }),
                    None => {
                        if !std::mem::replace(&mut self.refused[id.index()], true) {
                            self.unresolved.push((id, place));
                        }
                        let message = format!(
                            "{} is not defined; this `{}` is left out",
                            quoted(&term.name),
                            clause.kind.name()
                        );
                        let near = nearest(&term.name, names.iter().take(looks));
                        looks = looks.saturating_sub(names.len());
                        let hint = match near {
                            Some(near) => format!("did you mean `{near}`?"),
                            None => "names are defined by `timeId` and `tm`".to_owned(),
                        };
                        self.sink.push(
                            Diagnostic::error("eml::unknown-name", term.span, message).hint(hint),
                        );
                    }
                }
            }
        }
    }

    fn link_sequences(&mut self, groups: &[ClauseId]) {
        for &id in groups {
            let kind = &self.document.clause(id).kind;
            if let Some(group) = kind.group().filter(|_| kind.is_sequence()) {
                for pair in group.children.windows(2) {
                    self.before[pair[1].index()] = Some(pair[0]);
                }
            }
        }
    }

    /// Returns true if all dependencies of an unknown are known, the usual case in document order.
    fn is_ready(&self, unknown: Unknown) -> bool {
        let known = |needed| self.state[needed] == State::Done;
        if let Unknown::End(id) = unknown {
            // The end of a started clause without children needs nothing more.
            let start = Unknown::Start(id);
            if known(start) && self.counts[id.index()] == 0 && !self.values[start].is_nan() {
                step(1);
                return true;
            }
        }
        known(unknown) || (0..).map_while(|i| self.needs(unknown, i)).all(known)
    }

    fn settle(&mut self, unknown: Unknown) {
        self.values[unknown] = self.value(unknown);
        self.state[unknown] = State::Done;
    }

    fn find(&mut self, unknown: Unknown, stack: &mut Vec<(Unknown, usize)>) {
        self.open(unknown, stack);
        while let Some((current, next)) = stack.last_mut() {
            let current = *current;
            let Some(needed) = self.needs(current, *next) else {
                self.settle(current);
                stack.pop();
                let left = stack.len();
                self.suspects.pop_if(|&mut (_, depth)| depth == left);
                continue;
            };
            *next += 1;
            match self.state[needed] {
                State::New => self.open(needed, stack),
                State::Open => self.refuse_cycle(self.depth[needed] as usize),
                State::Done => {}
            }
        }
    }

    /// Pushes an unknown and its first dependency onto the stack.
    fn open(&mut self, unknown: Unknown, stack: &mut Vec<(Unknown, usize)>) {
        self.state[unknown] = State::Open;
        // A document has fewer than 2³¹ clauses, and each unknown is open once.
        self.depth[unknown] = stack.len() as u32;
        if let Unknown::Start(id) = unknown
            && self.document.clause(id).start.is_absolute()
        {
            self.suspects.push((id, stack.len()));
        }
        stack.push((unknown, 0));
    }

    /// Returns the `i`th unknown that must be solved before `unknown`; `None` if there are no more.
    fn needs(&self, unknown: Unknown, i: usize) -> Option<Unknown> {
        step(1);
        let id = unknown.clause();
        let clause = self.document.clause(id);
        if matches!(unknown, Unknown::Start(_)) {
            if self.refused[id.index()] {
                return None;
            }
            if clause.start.is_absolute() {
                return self
                    .terms_of(id)
                    .get(i)
                    .map(|term| Unknown::Start(term.clause));
            }
            return if i == 0 { self.base(id, clause) } else { None };
        }
        if i == 0 {
            return Some(Unknown::Start(id));
        }
        if self.values[Unknown::Start(id)].is_nan() {
            let in_seq = i == 1 && self.in_seq(clause);
            return if in_seq { self.base(id, clause) } else { None };
        }
        match clause.kind.group() {
            Some(group) if group.iteration_secs.is_none() => {
                group.children.get(i - 1).map(|&child| Unknown::End(child))
            }
            _ => None,
        }
    }

    /// Returns the reference of a plain number; `None` in the body.
    fn base(&self, id: ClauseId, clause: &Clause) -> Option<Unknown> {
        match (self.before[id.index()], clause.parent) {
            (Some(before), _) => Some(Unknown::End(before)),
            (None, parent) => parent.map(Unknown::Start),
        }
    }

    /// Returns the value of an unknown (start or end of a clause, seconds); all that it depends on
    /// must be solved.
    fn value(&mut self, unknown: Unknown) -> f64 {
        match unknown {
            Unknown::Start(id) => self.start_value(id),
            Unknown::End(id) => self.end_value(id, self.document.clause(id)),
        }
    }

    fn start_value(&mut self, id: ClauseId) -> f64 {
        let clause = self.document.clause(id);
        if self.refused[id.index()] {
            return f64::NAN;
        }
        let mut secs = clause.start.offset_secs;
        if clause.start.is_absolute() {
            for term in self.terms_of(id) {
                secs += term.sign * (self.values[Unknown::Start(term.clause)] + term.offset_secs);
            }
        } else if let Some(base) = self.base(id, clause) {
            secs += self.values[base];
        }
        if secs.is_nan() {
            // A clause in a group without a time is removed with the group, without a report.
            if clause.start.is_absolute() {
                let message = format!(
                    "this `{}` is left out because its time depends on an undefined time: {}",
                    clause.kind.name(),
                    self.chain(id)
                );
                self.sink.push(Diagnostic::error(
                    "eml::no-time",
                    clause.start.span,
                    message,
                ));
            }
        } else if secs.abs() > MAX_TIME_SECS {
            let message = format!("the time would be {secs:.0} s; the clause is left out");
            self.sink.push(Diagnostic::error(
                "eml::bad-time",
                clause.start.span,
                message,
            ));
            return f64::NAN;
        }
        secs
    }

    fn end_value(&self, id: ClauseId, clause: &Clause) -> f64 {
        let start = self.values[Unknown::Start(id)];
        if start.is_nan() {
            // In a seq, the following clauses continue as if this clause were absent.
            let base = self.base(id, clause).filter(|_| self.in_seq(clause));
            return base.map_or(f64::NAN, |base| self.values[base]);
        }
        let length = match &clause.kind {
            kind if let Some(group) = kind.group() => {
                let one = group.iteration_secs.unwrap_or_else(|| {
                    let ends = group.children.iter().map(|&c| self.values[Unknown::End(c)]);
                    // `max` passes over the NaN of a child that is left out.
                    ends.fold(start, f64::max) - start
                });
                one * f64::from(self.counts[id.index()])
            }
            // The next clause does not wait for an asynchronous one.
            ClauseKind::VoiceSay(say) if !say.is_waited_for() => 0.0,
            ClauseKind::VoiceText(_) | ClauseKind::VoiceSay(_) => {
                self.voices.get(&id).map_or(0.0, |v| v.duration_secs)
            }
            ClauseKind::DeterministicPrimitive(primitive) => {
                primitive.length_secs(|name| self.durations.animation(name))
            }
            ClauseKind::AnimateControlParameter(animate) => {
                animate.length_secs(|name| self.durations.animation(name))
            }
            kind => kind.own_length_secs(),
        };
        start + length
    }

    /// Reports the cycle of the unknowns on the stack from `depth` on, and rejects the expressions
    /// that close it. Plain numbers are never at fault: their references form a tree. Each suspect
    /// is rejected once, so all cycles together cost linear time.
    fn refuse_cycle(&mut self, depth: usize) {
        let from = self.suspects.partition_point(|&(_, d)| d < depth);
        let faulty: Vec<ClauseId> = self.suspects.drain(from..).map(|(id, _)| id).collect();
        let Some(&first) = faulty.first() else { return };
        let label = |&id: &ClauseId| {
            let clause = self.document.clause(id);
            match &clause.time_id {
                Some(name) => quoted(name),
                None => format!("`{}`", clause.kind.name()),
            }
        };
        // Of a cycle of thousands of names the message lists the first.
        let mut chain: Vec<String> = faulty.iter().take(MAX_CHAIN).map(label).collect();
        if faulty.len() > chain.len() {
            chain.push("…".to_owned());
        }
        chain.push(label(&first));
        let clause = self.document.clause(first);
        let names: Vec<String> = clause.start.names.iter().map(|n| quoted(&n.name)).collect();
        let message = if faulty.len() == 1 {
            let (element, names) = (clause.kind.name(), names.join(", "));
            format!("the time of this `{element}` depends on itself through {names}")
        } else {
            format!("these times depend on each other: {}", chain.join(" -> "))
        };
        let mut diagnostic = Diagnostic::error("eml::time-cycle", clause.start.span, message);
        for &other in faulty.iter().take(MAX_CHAIN).skip(1) {
            let clause = self.document.clause(other);
            diagnostic = diagnostic.related(
                clause.start.span,
                format!("{} is part of the cycle", label(&other)),
            );
        }
        self.sink
            .push(diagnostic.hint("the clauses named here are left out"));
        for id in faulty {
            self.refused[id.index()] = true;
        }
    }

    /// Returns the chain of names from a clause without a time to the undefined one.
    fn chain(&self, from: ClauseId) -> String {
        let mut steps: Vec<String> = Vec::new();
        let mut at = Some(from).filter(|_| !self.sink.is_full_of("eml::no-time"));
        while let Some(id) = at {
            let clause = self.document.clause(id);
            if let Ok(found) = self.unresolved.binary_search_by_key(&id, |&(id, _)| id) {
                let place = self.unresolved[found].1;
                steps.push(quoted(&clause.start.names[place].name));
                break;
            }
            if steps.len() == MAX_CHAIN {
                steps.push("…".to_owned());
                break;
            }
            at = if self.refused[id.index()] {
                // A cycle has its own report.
                None
            } else if clause.start.is_absolute() {
                let mut named = clause.start.names.iter().zip(self.terms_of(id));
                let missing =
                    named.find(|(_, term)| self.values[Unknown::Start(term.clause)].is_nan());
                missing.map(|(name, term)| {
                    steps.push(quoted(&name.name));
                    term.clause
                })
            } else {
                clause.parent
            };
        }
        steps.join(" -> ")
    }

    fn in_seq(&self, clause: &Clause) -> bool {
        clause
            .parent
            .is_some_and(|p| self.document.clause(p).kind.is_sequence())
    }

    fn terms_of(&self, id: ClauseId) -> &[Term] {
        let count = self.document.clause(id).start.names.len();
        let terms = &self.terms[self.first_term[id.index()] as usize..];
        terms.get(..count).unwrap_or(terms)
    }
}
