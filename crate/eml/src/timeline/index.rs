//! Index of started clauses that have not ended.

use std::ops::Range;

/// Number of clauses per leaf; a linear scan of them is cheaper than more tree levels.
const BLOCK: usize = 8;

/// Index that finds clauses still active at a time: a binary tree of latest ends over blocks of
/// clauses by start. Stored as an array, node `i` has the children `2i` and `2i + 1`; the leaves
/// come last.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct EndIndex {
    latest: Vec<f64>,
    leaves: usize,
}

/// Upper bound of the tree's height for any list that fits in memory; a search keeps at most one
/// pending node per level.
const HEIGHT: usize = 64;

impl EndIndex {
    /// Indexes `items` by their ends.
    pub(super) fn new<T>(items: &[T], end: impl Fn(&T) -> f64) -> Self {
        let blocks = items.chunks(BLOCK);
        let leaves = blocks.len().next_power_of_two();
        let mut latest = vec![f64::NEG_INFINITY; 2 * leaves];
        for (slot, block) in latest[leaves..].iter_mut().zip(blocks) {
            *slot = block.iter().map(&end).fold(f64::NEG_INFINITY, f64::max);
        }
        for i in (1..leaves).rev() {
            latest[i] = latest[2 * i].max(latest[2 * i + 1]);
        }
        Self { latest, leaves }
    }

    /// Returns the indices of the `items` that end after `t`, ascending; `items` are the indexed
    /// items or a prefix of them.
    pub(super) fn after<'a, T, E: Fn(&T) -> f64>(
        &'a self,
        items: &'a [T],
        end: E,
        t: f64,
    ) -> After<'a, T, E> {
        let mut search = After {
            index: self,
            items,
            end,
            t,
            block: 0..0,
            waiting: [0; HEIGHT],
            depth: 0,
        };
        if !self.latest.is_empty() {
            search.push(1);
        }
        search
    }
}

/// Iterator returned by [`EndIndex::after`].
pub(super) struct After<'a, T, E> {
    index: &'a EndIndex,
    items: &'a [T],
    end: E,
    t: f64,
    /// The rest of the current block.
    block: Range<usize>,
    waiting: [usize; HEIGHT],
    depth: usize,
}

impl<T, E> After<'_, T, E> {
    fn push(&mut self, node: usize) {
        if self.index.latest[node] > self.t {
            self.waiting[self.depth] = node;
            self.depth += 1;
        }
    }
}

impl<T, E: Fn(&T) -> f64> Iterator for After<'_, T, E> {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        loop {
            for i in self.block.by_ref() {
                if (self.end)(&self.items[i]) > self.t {
                    return Some(i);
                }
            }
            self.depth = self.depth.checked_sub(1)?;
            let node = self.waiting[self.depth];
            if node < self.index.leaves {
                self.push(2 * node + 1);
                self.push(2 * node);
                continue;
            }
            let first = (node - self.index.leaves) * BLOCK;
            if first >= self.items.len() {
                // Leaves come in order, so all pending ones come later.
                self.depth = 0;
                return None;
            }
            self.block = first..(first + BLOCK).min(self.items.len());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_search_finds_what_a_scan_finds(
            ends in prop::collection::vec(0.0..10.0_f64, 0..100),
            count in 0_usize..110,
            t in 0.0..10.0_f64,
        ) {
            let index = EndIndex::new(&ends, |&end| end);
            let started = &ends[..ends.len().min(count)];
            let found: Vec<usize> = index.after(started, |&end| end, t).collect();
            let scanned: Vec<usize> = (0..started.len()).filter(|&i| ends[i] > t).collect();
            prop_assert_eq!(found, scanned);
        }
    }
}
