//! Start time of a fragment: its hands must arrive in time, and utterances must not overlap.

use raconteur_actor::Actor;
use raconteur_base::Side;
use raconteur_base::order::sort_by_number;

use crate::lower::cues::UtteranceCue;
use crate::lower::plan::ScriptPlan;

/// Pause between previous speech and speech that waited for it, seconds: a short breath.
const BREATH_SECS: f64 = 0.15;
/// Speech that overlaps by less follows on; sums of times are no more exact than this. Seconds.
const TOUCH_SECS: f64 = 1e-6;

/// Returns the delay of a fragment that brings its hands in place in time, seconds. Its speech is
/// delayed too, since both are one utterance (GEVH D.2: a lead-in delays the whole).
pub(super) fn run_up(plan: &ScriptPlan, actor: &Actor, base_secs: f64) -> f64 {
    let mut delay: f64 = 0.0;
    for side in Side::BOTH {
        for stroke in &plan.strokes[side.index()] {
            let Some(first) = stroke.keys.first() else {
                continue;
            };
            let needed = actor.plan(side).time_to(base_secs, first.wrist_in_world);
            delay = delay.max(base_secs + needed - first.time_secs);
        }
    }
    delay
}

/// Returns the earliest time at which the hands of a fragment can start a stroke, seconds: its
/// first stroke is delayed by as much as its hands.
pub(super) fn hands_from(plan: &ScriptPlan, run_up_secs: f64) -> f64 {
    let strokes = plan.strokes.iter().flatten();
    let first = strokes.map(|stroke| stroke.start_secs).reduce(f64::min);
    first.map_or(f64::NEG_INFINITY, |first| first + run_up_secs)
}

/// Returns the shortest delay, at least `least_secs`, with which `own` speech overlaps none of the
/// others. Overlaps within one fragment remain.
pub(super) fn turn<'a>(
    own: &[UtteranceCue],
    others: impl Iterator<Item = &'a UtteranceCue>,
    least_secs: f64,
) -> f64 {
    let others: Vec<(f64, f64)> = others.filter_map(span).collect();
    // The delays at which an utterance would overlap another.
    let mut taken: Vec<(f64, f64)> = own
        .iter()
        .filter_map(span)
        .flat_map(|(start, end)| others.iter().map(move |o| (o.0 - end, o.1 - start)))
        .filter(|(_, until)| *until > least_secs)
        .collect();
    sort_by_number(&mut taken, |(from, _)| *from);
    // Delays and start times only grow, so a passed interval stays passed.
    taken.iter().fold(least_secs, |delay, &(from, until)| {
        if from + TOUCH_SECS < delay && delay < until - TOUCH_SECS {
            until + BREATH_SECS
        } else {
            delay
        }
    })
}

/// Returns the audible interval of an utterance; `None` if it has no duration.
fn span(cue: &UtteranceCue) -> Option<(f64, f64)> {
    let (start, end) = (cue.timed.start_secs, cue.timed.end_secs());
    (end > start).then_some((start, end))
}
