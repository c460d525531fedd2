//! Finds what has not ended among what has started.

/// A binary tree of latest ends over the clauses by start, laid out as an array:
/// node `i` has the children `2i` and `2i + 1`, the leaves come last.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct EndIndex {
    latest: Vec<f64>,
    leaves: usize,
}

/// The tree of any list that fits in memory is lower than this; a search keeps at most
/// one waiting node a level.
const HEIGHT: usize = 64;

impl EndIndex {
    pub(super) fn new(ends: impl ExactSizeIterator<Item = f64>) -> Self {
        let leaves = ends.len().next_power_of_two();
        let mut latest = vec![f64::NEG_INFINITY; 2 * leaves];
        for (slot, end) in latest[leaves..].iter_mut().zip(ends) {
            *slot = end;
        }
        for i in (1..leaves).rev() {
            latest[i] = latest[2 * i].max(latest[2 * i + 1]);
        }
        Self { latest, leaves }
    }

    /// The indices below `count` that end after `t`, ascending.
    pub(super) fn after(&self, count: usize, t: f64) -> After<'_> {
        let mut search = After {
            index: self,
            count,
            t,
            waiting: [0; HEIGHT],
            depth: 0,
        };
        if !self.latest.is_empty() {
            search.push(1);
        }
        search
    }
}

/// See [`EndIndex::after`].
pub(super) struct After<'a> {
    index: &'a EndIndex,
    count: usize,
    t: f64,
    waiting: [usize; HEIGHT],
    depth: usize,
}

impl After<'_> {
    fn push(&mut self, node: usize) {
        if self.index.latest[node] > self.t {
            self.waiting[self.depth] = node;
            self.depth += 1;
        }
    }
}

impl Iterator for After<'_> {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        while self.depth > 0 {
            self.depth -= 1;
            let node = self.waiting[self.depth];
            if node >= self.index.leaves {
                let leaf = node - self.index.leaves;
                if leaf < self.count {
                    return Some(leaf);
                }
                // Leaves come in order, so all that still wait come later.
                self.depth = 0;
                return None;
            }
            self.push(2 * node + 1);
            self.push(2 * node);
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_search_finds_what_a_scan_finds(
            ends in prop::collection::vec(0.0..10.0_f64, 0..40),
            count in 0_usize..50,
            t in 0.0..10.0_f64,
        ) {
            let index = EndIndex::new(ends.iter().copied());
            let found: Vec<usize> = index.after(count, t).collect();
            let scanned: Vec<usize> =
                (0..ends.len().min(count)).filter(|&i| ends[i] > t).collect();
            prop_assert_eq!(found, scanned);
        }
    }
}
