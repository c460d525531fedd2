//! Duration factors with spans of fixed duration.

use super::TimeMap;

/// Time over which a factor counts as constant, in seconds.
pub(super) const CELL_SECS: f64 = 0.001;

/// Distance from a rigid span over which its stretch is distributed first, in seconds (chosen:
/// about a phone to either side).
const REACH_SECS: f64 = 0.1;

/// Bounds of a local factor of duration.
pub(super) const FACTORS: (f64, f64) = (0.2, 5.0);

/// Returns the time map for a sound of `length_secs`: local factors from `factor`, called in the
/// middle of each cell and clamped to [`FACTORS`] (NaN counts as 1), but 1 within the rigid spans
/// (start and end in seconds), whose stretch is distributed over nearby cells in proportion to
/// their length, and farther out if those cannot take it.
pub(super) fn time_map(
    length_secs: f64,
    factor: &dyn Fn(f64) -> f64,
    rigid: &[(f64, f64)],
) -> TimeMap {
    let count = (length_secs / CELL_SECS).ceil() as usize;
    let lengths = |i: usize| (length_secs - i as f64 * CELL_SECS).min(CELL_SECS);
    let mut factors: Vec<f64> = (0..count)
        .map(|i| {
            let asked = factor((i as f64 + 0.5) * CELL_SECS);
            if asked.is_nan() {
                1.0
            } else {
                asked.clamp(FACTORS.0, FACTORS.1)
            }
        })
        .collect();
    let mut stiff = vec![false; count];
    for &(start, end) in rigid {
        for cell in cells(start, end, count) {
            stiff[cell] = true;
        }
    }
    let mut at = 0;
    while at < count {
        if !stiff[at] {
            at += 1;
            continue;
        }
        let end = (at..count).find(|&i| !stiff[i]).unwrap_or(count);
        let mut owed: f64 = (at..end).map(|i| (factors[i] - 1.0) * lengths(i)).sum();
        factors[at..end].fill(1.0);
        let mut reach = (REACH_SECS / CELL_SECS) as usize;
        while owed.abs() > 1e-9 {
            let near = at.saturating_sub(reach)..(end + reach).min(count);
            let takes_all = near.len() == count;
            owed -= spread(&mut factors, &stiff, near, owed, &lengths);
            // The rest of the requested change is lost if all of the audio is rigid or at a bound.
            if takes_all {
                break;
            }
            reach *= 2;
        }
        at = end;
    }
    TimeMap::from_stretches(factors.iter().enumerate().map(|(i, &f)| (lengths(i), f)))
}

/// Distributes seconds over the soft cells of a range in proportion to their current length;
/// returns the number of seconds placed.
fn spread(
    factors: &mut [f64],
    stiff: &[bool],
    range: std::ops::Range<usize>,
    owed: f64,
    lengths: &impl Fn(usize) -> f64,
) -> f64 {
    let soft = |i: &usize| !stiff[*i];
    let there: f64 = range
        .clone()
        .filter(soft)
        .map(|i| factors[i] * lengths(i))
        .sum();
    if there <= 0.0 {
        return 0.0;
    }
    let mut placed = 0.0;
    for i in range.filter(soft) {
        let now = (factors[i] * (1.0 + owed / there)).clamp(FACTORS.0, FACTORS.1);
        placed += (now - factors[i]) * lengths(i);
        factors[i] = now;
    }
    placed
}

/// Returns the range of cells that a time span touches.
fn cells(start_secs: f64, end_secs: f64, count: usize) -> std::ops::Range<usize> {
    let first = ((start_secs / CELL_SECS).floor().max(0.0) as usize).min(count);
    let past = ((end_secs / CELL_SECS).ceil().max(0.0) as usize).min(count);
    first..past.max(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rigid_spans_keep_their_length_and_the_whole_is_as_asked() {
        for factor in [0.5, 0.8, 1.0, 1.6, 3.0] {
            let map = time_map(1.0, &|_| factor, &[(0.3, 0.32), (0.5, 0.53)]);
            assert!((map.after(1.0) - factor).abs() < 1e-9, "{factor}");
            assert!(
                (map.after(0.32) - map.after(0.3) - 0.02).abs() < 1e-9,
                "the first rigid span keeps its length"
            );
            assert!(
                (map.after(0.53) - map.after(0.5) - 0.03).abs() < 1e-9,
                "the second rigid span keeps its length"
            );
            // Far from the spans the factor is as requested.
            assert!(
                (map.after(0.15) - 0.15 * factor).abs() < 1e-9,
                "the time before the span is scaled"
            );
        }
    }

    #[test]
    fn what_cannot_be_had_is_left() {
        let map = time_map(0.2, &|_| 2.0, &[(-1.0, 9.0)]);
        assert!(
            (map.after(0.2) - 0.2).abs() < 1e-9,
            "fully rigid audio keeps its duration"
        );
        let map = time_map(0.2, &|_| 99.0, &[]);
        assert!(
            (map.after(0.2) - 1.0).abs() < 1e-9,
            "the duration factor is limited to 5"
        );
        let map = time_map(0.0105, &|_| f64::NAN, &[(f64::NAN, 0.004)]);
        assert!(
            (map.after(0.0105) - 0.0105).abs() < 1e-12,
            "invalid factors and spans change nothing"
        );
    }
}
