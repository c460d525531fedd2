//! Expansion of repetitions and chronological order of all clauses.

use super::index::EndIndex;
use super::solve::Times;
use super::{TimedClause, Timeline};
use crate::diagnostic::Sink;
use crate::work::step;
use crate::{ClauseId, Diagnostic, Document, Limits};

/// Returns the number of repetitions of each group, bounded by the maximum number of clauses in the
/// timeline: groups beyond it play once. Clauses other than groups have 0. Computed without
/// expansion.
pub(super) fn bounded_counts(
    document: &Document,
    groups: &[ClauseId],
    limits: &Limits,
    sink: &mut Sink,
) -> Vec<u32> {
    let most = (limits.timed_clauses as u64).max(document.clauses.len() as u64);
    let mut used = document.clauses.len() as u64;
    let mut counts = vec![0_u32; document.clauses.len()];
    // The entries that each group makes when it plays; any other clause makes one.
    let mut entries = vec![1_u64; groups.len()];
    // Children come after their group, so in reverse order they are ready before it.
    for (place, id) in groups.iter().enumerate().rev() {
        let Some(group) = document.clause(*id).kind.group() else {
            continue;
        };
        let entries_of = |child: &ClauseId| match counts[child.index()] {
            0 => 1,
            _ => groups.binary_search(child).map_or(1, |at| entries[at]),
        };
        let inside: u64 = group.children.iter().map(entries_of).sum();
        let more = inside.saturating_mul(u64::from(group.repetition_count) - 1);
        let count = if more > most - used {
            let message = format!(
                "{} repetitions of {inside} clauses are more than the {most} that a script may \
                 have; they play once",
                group.repetition_count
            );
            sink.push(Diagnostic::error(
                "eml::too-many-repetitions",
                group.repetition_span,
                message,
            ));
            1
        } else {
            used += more;
            group.repetition_count
        };
        counts[id.index()] = count;
        entries[place] = 1 + inside * u64::from(count);
    }
    counts
}

/// Lists every clause at its time, each iteration of a group separately.
pub(super) fn expand(document: &Document, times: &Times, counts: &[u32]) -> Timeline {
    let mut list = List {
        document,
        times,
        counts,
        clauses: Vec::with_capacity(document.clauses.len()),
        earliest: 0.0,
    };
    for &root in &document.roots {
        list.add(
            root,
            &Iteration {
                shift: 0.0,
                cut: f64::INFINITY,
                container: None,
                iteration: 0,
            },
        );
    }
    let mut clauses = list.clauses;
    // Not `-earliest`, which is −0 when nothing is early.
    let lead_in_secs = 0.0 - list.earliest;
    let mut duration_secs: f64 = 0.0;
    for clause in &mut clauses {
        clause.start_secs += lead_in_secs;
        clause.end_secs += lead_in_secs;
        duration_secs = duration_secs.max(clause.end_secs);
    }
    // A script is written in the order of its times, or nearly so.
    if let Some(order) = raconteur_base::order::order_by_number(&clauses, |c| c.start_secs) {
        let mut place_of = vec![0_u32; order.len()];
        for (place, &index) in (0..).zip(&order) {
            place_of[index] = place;
        }
        for clause in &mut clauses {
            clause.container = clause.container.map(|index| place_of[index as usize]);
        }
        raconteur_base::order::arrange(&mut clauses, order);
    }
    let ends = EndIndex::new(&clauses, |c| c.end_secs);
    Timeline {
        duration_secs,
        lead_in_secs,
        clauses,
        ends,
        ..Timeline::default()
    }
}

struct List<'d> {
    document: &'d Document,
    times: &'d Times,
    counts: &'d [u32],
    clauses: Vec<TimedClause>,
    /// The first start, at most 0.
    earliest: f64,
}

/// Repetition in which a clause plays.
struct Iteration {
    /// Seconds after the first iteration.
    shift: f64,
    /// Time at which the iteration is cut off.
    cut: f64,
    container: Option<u32>,
    iteration: u32,
}

impl List<'_> {
    /// Adds a clause and its members. Groups recurse; parsing limits the depth.
    fn add(&mut self, id: ClauseId, place: &Iteration) {
        step(1);
        let Some(start) = self.times.start(id) else {
            return;
        };
        let start_secs = start + place.shift;
        if start_secs >= place.cut {
            return;
        }
        self.earliest = self.earliest.min(start_secs);
        let end = self.times.end(id);
        // The limits of bytes and of clauses leave no more than fit.
        let index = u32::try_from(self.clauses.len()).ok();
        self.clauses.push(TimedClause {
            start_secs,
            end_secs: (end + place.shift).min(place.cut),
            clause: id,
            container: place.container,
            iteration: place.iteration,
        });
        let count = self.counts[id.index()];
        if count == 0 {
            return;
        }
        let Some(group) = self.document.clause(id).kind.group() else {
            return;
        };
        if group.children.is_empty() {
            // Nothing would bound the iterations of an empty group.
            return;
        }
        let length = (end - start) / f64::from(count);
        for iteration in 0..count {
            let later = length * f64::from(iteration);
            if start_secs + later >= place.cut {
                break;
            }
            let cut = match group.iteration_secs {
                Some(secs) => place.cut.min(start_secs + later + secs),
                None => place.cut,
            };
            let shift = place.shift + later;
            let inner = Iteration {
                shift,
                cut,
                container: index,
                iteration,
            };
            for &child in &group.children {
                self.add(child, &inner);
            }
        }
    }
}
