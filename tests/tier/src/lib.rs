//! Extent of a test run. `npm test` is the gate and runs samples; `npm run test:long` sets the
//! variable `TEST_LONG` and runs everything. `docs/testing.md` describes the extent.

use std::env;

/// The figures of `assets/figures`.
pub const FIGURES: [&str; 6] = ["sofia", "papous", "nuno", "amara", "kenji", "lia"];

/// Returns true if all tests run: `TEST_LONG` is set.
#[must_use]
pub fn is_long() -> bool {
    env::var_os("TEST_LONG").is_some()
}

/// A count of cases: `gate` of them in the gate, `long` where everything runs.
#[must_use]
pub fn sized<T>(gate: T, long: T) -> T {
    if is_long() { long } else { gate }
}

/// Returns the share `turn` (from 0) of `things` among `turns`, every `turns`-th of them, so that
/// the shares together are complete; all of them if all tests run.
#[must_use]
pub fn share<T: Clone>(things: &[T], turn: usize, turns: usize) -> Vec<T> {
    if is_long() {
        return things.to_vec();
    }
    things.iter().skip(turn).step_by(turns).cloned().collect()
}

#[cfg(test)]
mod tests {
    use super::{is_long, share};

    #[test]
    fn shares_are_the_whole_together() {
        let all: Vec<usize> = (0..11).collect();
        let shares = (0..3).map(|turn| share(&all, turn, 3));
        if is_long() {
            assert!(
                shares.into_iter().all(|s| s == all),
                "each share is everything in the long tier"
            );
            return;
        }
        let mut together: Vec<usize> = shares.flatten().collect();
        together.sort_unstable();
        assert_eq!(together, all);
    }
}
