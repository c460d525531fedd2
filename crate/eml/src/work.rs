//! Counter of the work on a document in tests; a clock would mostly measure the machine.

/// Counts steps: bytes scanned, comparisons, entries created.
#[cfg(not(test))]
#[inline(always)]
pub(crate) fn step(_count: usize) {}

#[cfg(test)]
pub(crate) use counted::step;

#[cfg(test)]
mod counted {
    use std::cell::Cell;

    thread_local! {
        static STEPS: Cell<usize> = const { Cell::new(0) };
    }

    pub(crate) fn step(count: usize) {
        STEPS.set(STEPS.get() + count);
    }

    /// Returns the steps that `work` takes.
    pub(super) fn steps_of(work: impl FnOnce()) -> usize {
        let before = STEPS.get();
        work();
        STEPS.get() - before
    }
}

#[cfg(test)]
#[path = "../tests/holds/edits.rs"]
mod edits;

#[cfg(test)]
#[path = "../tests/script/mod.rs"]
mod script;

#[cfg(test)]
mod tests {
    use super::counted::steps_of;
    use super::edits::{apply, edit};
    use super::script::script;
    use crate::{EstimatedDurations, Limits, Timeline, parse_bytes};
    use proptest::prelude::*;

    /// Returns the number of work steps for parsing, checking and resolving a document, for tests.
    fn steps(source: &[u8]) -> usize {
        steps_of(|| {
            let parsed = parse_bytes(source, &Limits::default());
            let _ = Timeline::resolve(&parsed.document, &EstimatedDurations);
        })
    }

    #[test]
    fn work_grows_with_the_script_and_no_faster() {
        let [small, large] = [100, 10_000].map(|clauses| steps(script(clauses).as_bytes()));
        let ratio = large as f64 / small as f64;
        // Only the names' logarithm may exceed the hundredfold.
        assert!((90.0..130.0).contains(&ratio), "{ratio}");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(500))]

        #[test]
        fn no_mutation_makes_ten_times_the_work(edits in prop::collection::vec(edit(), 1..12)) {
            let original = script(200).into_bytes();
            let mut mutated = original.clone();
            edits.iter().for_each(|edit| apply(&mut mutated, edit));
            prop_assert!(steps(&mutated) <= 10 * steps(&original), "{edits:?}");
        }
    }
}
