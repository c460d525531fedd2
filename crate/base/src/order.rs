//! Sorting by a number, compiled once.
//!
//! Each use of the standard library's stable sort with another type adds about 4 KB to the
//! wasm file; twenty of them were a tenth of it.

/// Sorts pairs of key and position; total order, so that NaN has a place as well.
#[inline(never)]
fn sort_pairs(pairs: &mut [(f64, usize)]) {
    pairs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
}

/// Sorts by a number, stably: equal items keep their order. O(n log n).
pub fn sort_by_number<T>(items: &mut [T], number: impl Fn(&T) -> f64) {
    let mut order: Vec<(f64, usize)> = items
        .iter()
        .enumerate()
        .map(|(i, item)| (number(item), i))
        .collect();
    sort_pairs(&mut order);
    // Item `order[i].1` belongs at `i`. Earlier swaps may have moved it; follow them.
    for i in 0..items.len() {
        let mut from = order[i].1;
        while from < i {
            from = order[from].1;
        }
        order[i].1 = from;
        items.swap(i, from);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise;

    #[test]
    fn it_sorts_as_the_standard_library_does() {
        for n in 0..60 {
            for seed in 0..20 {
                let items: Vec<(f64, i64)> = (0..n)
                    .map(|i| ((noise::unit(seed, 1, i) * 8.0).floor(), i))
                    .collect();
                let mut ours = items.clone();
                let mut theirs = items;
                sort_by_number(&mut ours, |x| x.0);
                theirs.sort_by(|a, b| a.0.total_cmp(&b.0));
                assert_eq!(ours, theirs);
            }
        }
    }
}
