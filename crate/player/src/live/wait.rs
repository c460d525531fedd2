//! When a fragment may begin: its hands have to get there, and nobody speaks into another's words.

use raconteur_actor::Actor;
use raconteur_base::Side;
use raconteur_base::order::sort_by_number;

use crate::lower::cues::UtteranceCue;
use crate::lower::plan::ScriptPlan;

/// From the end of what was being said to what has waited for it, seconds: a short breath.
const BREATH_SECS: f64 = 0.15;
/// Speech that overlaps by less follows on; sums of times are no more exact than this. Seconds.
const TOUCH_SECS: f64 = 1e-6;

/// By how much a fragment is delayed so that its hands are there in time, seconds. Speech
/// waits for them, for both are one utterance (GEVH D.2: a lead-in delays the whole).
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

/// From when on the hands of a fragment can be at the place of a stroke, seconds: its first stroke
/// comes as much later as its hands are delayed.
pub(super) fn hands_from(plan: &ScriptPlan, run_up_secs: f64) -> f64 {
    let strokes = plan.strokes.iter().flatten();
    let first = strokes.map(|stroke| stroke.start_secs).reduce(f64::min);
    first.map_or(f64::NEG_INFINITY, |first| first + run_up_secs)
}

/// The shortest delay, and no less than `least_secs`, with which `own` speech falls together with
/// none of the others. What one fragment says at once by itself stays so.
pub(super) fn turn<'a>(
    own: &[UtteranceCue],
    others: impl Iterator<Item = &'a UtteranceCue>,
    least_secs: f64,
) -> f64 {
    let others: Vec<(f64, f64)> = others.filter_map(span).collect();
    // Between which delays an utterance would be spoken into another.
    let mut taken: Vec<(f64, f64)> = own
        .iter()
        .filter_map(span)
        .flat_map(|(start, end)| others.iter().map(move |o| (o.0 - end, o.1 - start)))
        .filter(|(_, until)| *until > least_secs)
        .collect();
    sort_by_number(&mut taken, |(from, _)| *from);
    // What was passed stays passed: a delay only grows, and so do the beginnings.
    taken.iter().fold(least_secs, |delay, &(from, until)| {
        if from + TOUCH_SECS < delay && delay < until - TOUCH_SECS {
            until + BREATH_SECS
        } else {
            delay
        }
    })
}

/// When an utterance is heard; none for one that takes no time.
fn span(cue: &UtteranceCue) -> Option<(f64, f64)> {
    let (start, end) = (cue.timed.start_secs, cue.timed.end_secs());
    (end > start).then_some((start, end))
}
