//! Matching of two phone sequences of the same words.

use anyhow::{Result, ensure};

/// Maximum number of compared pairs: two sequences of 4,000.
const MAX_PAIRS: usize = 16_000_000;

/// Cost of a phone that only one sequence has; twice that is more than two that differ.
const GAP: u32 = 3;

/// Matches each of `heard` with one of `known`, by the cheapest alignment (Needleman and Wunsch
/// 1970, doi:10.1016/0022-2836(70)90057-4). `cost` of a pair is 0 if both are equal and at most 5;
/// a pair costs no more than omitting both.
///
/// # Errors
/// Returns an error if both are so long that the alignment would need more than about 16 MB.
pub(super) fn matched<A, B>(
    known: &[A],
    heard: &[B],
    cost: impl Fn(&A, &B) -> u32,
) -> Result<Vec<Option<usize>>> {
    let width = known.len() + 1;
    let pairs = width.saturating_mul(heard.len() + 1);
    ensure!(pairs <= MAX_PAIRS, "{pairs} pairs of phones to compare");
    // The step that reached each position: 0 a pair, 1 from the left, 2 from above.
    let mut steps = vec![1_u8; pairs];
    let mut above: Vec<u32> = (0..width).map(|i| i as u32 * GAP).collect();
    for (j, h) in heard.iter().enumerate() {
        let mut row = Vec::with_capacity(width);
        row.push((j as u32 + 1) * GAP);
        steps[(j + 1) * width] = 2;
        for (i, k) in known.iter().enumerate() {
            let (pair, left, up) = (above[i] + cost(k, h), row[i] + GAP, above[i + 1] + GAP);
            let best = pair.min(left).min(up);
            let step = if best == pair {
                0
            } else {
                1 + u8::from(best != left)
            };
            steps[(j + 1) * width + i + 1] = step;
            row.push(best);
        }
        above = row;
    }
    let mut out = vec![None; heard.len()];
    let (mut i, mut j) = (known.len(), heard.len());
    while j > 0 {
        match steps[j * width + i] {
            0 => {
                (i, j) = (i - 1, j - 1);
                out[j] = Some(i);
            }
            1 => i -= 1,
            _ => j -= 1,
        }
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(known: &str, heard: &str) -> Vec<Option<usize>> {
        let known: Vec<char> = known.chars().collect();
        let heard: Vec<char> = heard.chars().collect();
        matched(&known, &heard, |a, b| 5 * u32::from(a != b)).unwrap()
    }

    #[test]
    fn what_is_the_same_is_matched_and_what_is_new_is_not() {
        assert_eq!(told("abc", "abc"), [Some(0), Some(1), Some(2)]);
        assert_eq!(told("abc", "ac"), [Some(0), Some(2)]);
        assert_eq!(told("ac", "abc"), [Some(0), None, Some(1)]);
        assert_eq!(told("axc", "abc"), [Some(0), Some(1), Some(2)]);
        assert_eq!(told("", "ab"), [None, None]);
        assert_eq!(told("ab", ""), []);
    }

    #[test]
    fn what_would_take_too_much_is_refused() {
        let long = vec![0_u8; 5_000];
        assert!(
            matched(&long, &long, |_, _| 0).is_err(),
            "matching beyond the limit is rejected"
        );
    }
}
