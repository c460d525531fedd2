//! Sorting by a number, compiled once.
//!
//! Each use of the standard library's stable sort with another type adds about 4 KB to the wasm
//! file; twenty uses were a tenth of it.

use std::cmp::Ordering;

/// Moves an item may make on average before a list counts as not nearly sorted.
const NEARLY: usize = 8;

/// Sorts pairs of key and position in total order, so NaN is ordered as well. Linear when little is
/// out of order.
#[inline(never)]
fn sort_pairs(pairs: &mut [(f64, usize)]) {
    let order = |a: &(f64, usize), b: &(f64, usize)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
    let mut moves_left = NEARLY * pairs.len();
    for i in 1..pairs.len() {
        let pair = pairs[i];
        let mut at = i;
        while at > 0 && order(&pairs[at - 1], &pair) == Ordering::Greater {
            pairs[at] = pairs[at - 1];
            at -= 1;
        }
        pairs[at] = pair;
        let moves = i - at;
        if moves > moves_left {
            pairs.sort_unstable_by(order);
            return;
        }
        moves_left -= moves;
    }
}

/// Returns the indices of items in the order of a number, with equal items in their original order;
/// `None` when already in order. Nearly sorted items cost linear time, others O(n log n).
pub fn order_by_number<T>(items: &[T], number: impl Fn(&T) -> f64) -> Option<Vec<usize>> {
    let in_order = |a: &T, b: &T| number(a).total_cmp(&number(b)) != Ordering::Greater;
    if items.is_sorted_by(in_order) {
        return None;
    }
    let mut order: Vec<(f64, usize)> = items
        .iter()
        .enumerate()
        .map(|(i, item)| (number(item), i))
        .collect();
    sort_pairs(&mut order);
    Some(order.into_iter().map(|(_, i)| i).collect())
}

/// Puts the item at `order[i]` to `i`, for all `i`. O(n).
pub fn arrange<T>(items: &mut [T], mut order: Vec<usize>) {
    for i in 0..items.len() {
        // Earlier swaps may have moved the item; follow them.
        let mut from = order[i];
        while from < i {
            from = order[from];
        }
        order[i] = from;
        items.swap(i, from);
    }
}

/// Sorts by a number, stably: equal items keep their order. O(n log n).
pub fn sort_by_number<T>(items: &mut [T], number: impl Fn(&T) -> f64) {
    if let Some(order) = order_by_number(items, number) {
        arrange(items, order);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise;

    #[test]
    fn it_sorts_as_the_standard_library_does() {
        for n in (0..60).chain([2000]) {
            for seed in 0..20 {
                let items: Vec<(f64, i64)> = (0..n)
                    .map(|i| ((noise::unit(seed, 1, i) * 8.0).floor(), i))
                    .collect();
                let mut ours = items.clone();
                let mut theirs = items;
                sort_by_number(&mut ours, |x| x.0);
                theirs.sort_by(|a, b| a.0.total_cmp(&b.0));
                assert_eq!(ours, theirs);
                assert!(
                    order_by_number(&ours, |x| x.0).is_none(),
                    "the sort by number reports no problem"
                );
            }
        }
    }
}
