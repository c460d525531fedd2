//! Simulations that follow the clock.
//!
//! A simulation has a state, but the frame of a time must not depend on the path of the clock. Time
//! is therefore split into segments. The state in a segment follows from its inputs since a fixed
//! time before it, where it starts at rest; the difference from the preceding state has decayed
//! when the segment starts. While one segment plays, the warm-up of the next is simulated; a seek
//! simulates at most a segment with both warm-ups.

use core::mem::swap;

/// Division of time into segments for a simulation, in steps: segment length and warm-up before it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SegmentGrid {
    /// Steps of a segment.
    pub(crate) segment: i64,
    /// Steps of the warm-up before it.
    pub(crate) warm_up: i64,
    /// Scheduling of the warm-up.
    pub(crate) pace: WarmUpPolicy,
}

/// Schedule for the warm-up of the next segment: spread evenly, or in step with the present one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WarmUpPolicy {
    /// Evenly over this one.
    Even,
    /// At its own time, so both are at one step.
    Together,
}

/// Simulation with a state that starts at rest and advances in fixed steps.
pub(crate) trait Simulation<S> {
    /// Initialises it at rest at a step.
    fn rest(&mut self, state: &mut S, step: i64);
    /// Advances it by one step, to `step`.
    fn step(&mut self, state: &mut S, step: i64);
}

/// A state at a step of a segment.
struct SegmentState<S> {
    state: S,
    segment: i64,
    step: i64,
}

/// A segment that no time has.
const NEVER: i64 = i64::MIN;

impl<S> SegmentState<S> {
    fn begin(&mut self, cut: SegmentGrid, segment: i64, simulation: &mut dyn Simulation<S>) {
        self.segment = segment;
        self.step = segment * cut.segment - cut.warm_up;
        simulation.rest(&mut self.state, self.step);
    }

    fn advance(&mut self, to: i64, simulation: &mut dyn Simulation<S>) {
        while self.step < to {
            self.step += 1;
            simulation.step(&mut self.state, self.step);
        }
    }
}

/// States of a simulation in the present segment and, warming up, in the next one; they make the
/// result independent of seeking.
pub(crate) struct Segments<S> {
    cut: SegmentGrid,
    now: SegmentState<S>,
    next: SegmentState<S>,
}

impl<S: Clone> Segments<S> {
    pub(crate) fn new(cut: SegmentGrid, state: S) -> Self {
        let run = |state| SegmentState {
            state,
            segment: NEVER,
            step: 0,
        };
        Self {
            cut,
            next: run(state.clone()),
            now: run(state),
        }
    }

    /// Clears the simulated states, because their drivers have changed.
    pub(crate) fn forget(&mut self) {
        self.now.segment = NEVER;
        self.next.segment = NEVER;
    }

    /// Returns the state at the last requested step.
    pub(crate) fn state(&self) -> &S {
        &self.now.state
    }

    /// Returns the present state (mutable) and that of the next segment.
    pub(crate) fn states_mut(&mut self) -> (&mut S, &S) {
        (&mut self.now.state, &self.next.state)
    }

    /// Advances the state to a step.
    pub(crate) fn advance_to(&mut self, step: i64, simulation: &mut dyn Simulation<S>) {
        let cut = self.cut;
        let segment = step.div_euclid(cut.segment);
        if self.now.segment != segment && self.next.segment == segment {
            swap(&mut self.now, &mut self.next);
        }
        if self.now.segment != segment || self.now.step > step {
            self.now.begin(cut, segment, simulation);
        }
        self.now.advance(step, simulation);
        let begins = (segment + 1) * cut.segment - cut.warm_up;
        let ahead = match cut.pace {
            WarmUpPolicy::Even => {
                begins + (step - segment * cut.segment) * cut.warm_up / cut.segment
            }
            WarmUpPolicy::Together => step,
        };
        if ahead < begins {
            return;
        }
        if self.next.segment != segment + 1 || self.next.step > ahead {
            self.next.begin(cut, segment + 1, simulation);
        }
        self.next.advance(ahead, simulation);
    }
}
