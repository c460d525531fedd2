//! Filters, derivatives and distributions of sampled values.

use std::f64::consts::{LN_2, TAU};
use std::ops::{Add, Mul, Range, Sub};

use raconteur_base::{ops, order};

use super::RATE_HZ;

/// Values that filters and derivatives take: numbers, vectors, rotations.
pub(super) trait Sampled:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self>
{
}

impl<T> Sampled for T where T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T> {}

/// Returns values filtered by a zero-phase Gaussian low pass with half the power at `cutoff_hz`,
/// each run of samples on its own. The ends of a run are continued point-symmetrically.
pub(super) fn low_passed<T: Sampled>(
    values: &[T],
    runs: &[Range<usize>],
    cutoff_hz: f64,
) -> Vec<T> {
    let sigma = RATE_HZ * LN_2.sqrt() / (TAU * cutoff_hz);
    let half_width = (4.0 * sigma).ceil() as usize;
    let weights: Vec<f64> = (0..=half_width)
        .map(|k| ops::exp(-0.5 * (k as f64 / sigma) * (k as f64 / sigma)))
        .collect();
    let total = 2.0 * weights.iter().sum::<f64>() - weights[0];
    let mut filtered = values.to_vec();
    for run in runs {
        let run_values = &values[run.clone()];
        let Some(last) = run_values.len().checked_sub(1) else {
            continue;
        };
        for (i, out) in filtered[run.clone()].iter_mut().enumerate() {
            let mut sum = run_values[i] * weights[0];
            for (k, weight) in weights.iter().enumerate().skip(1) {
                let before = i.checked_sub(k).map_or_else(
                    || run_values[0] * 2.0 - run_values[(k - i).min(last)],
                    |at| run_values[at],
                );
                let after = if i + k <= last {
                    run_values[i + k]
                } else {
                    run_values[last] * 2.0 - run_values[(2 * last).saturating_sub(i + k)]
                };
                sum = sum + (before + after) * *weight;
            }
            *out = sum * total.recip();
        }
    }
    filtered
}

/// Returns the change per second of each sample: central differences, one-sided at the ends of a
/// run. A run of one sample does not change.
pub(super) fn rates<T: Sampled>(values: &[T], runs: &[Range<usize>]) -> Vec<T> {
    let mut rates = values.to_vec();
    for run in runs.iter().filter(|run| !run.is_empty()) {
        for i in run.clone() {
            let (from, to) = (i.max(run.start + 1) - 1, (i + 1).min(run.end - 1));
            let steps = (to - from).max(1) as f64;
            rates[i] = (values[to] - values[from]) * (RATE_HZ / steps);
        }
    }
    rates
}

/// Returns the change per second of the change per second of the inner samples of all runs.
pub(super) fn second_rates<T: Sampled>(values: &[T], runs: &[Range<usize>]) -> Vec<T> {
    let inner = runs.iter().flat_map(|run| values[run.clone()].windows(3));
    let second = |w: &[T]| (w[0] - w[1] * 2.0 + w[2]) * (RATE_HZ * RATE_HZ);
    inner.map(second).collect()
}

/// Returns the standard deviation of values; `None` without values.
pub(super) fn deviation(values: impl Iterator<Item = f64> + Clone) -> Option<f64> {
    let mean = mean(values.clone())?;
    let square = self::mean(values.map(|x| (x - mean) * (x - mean)))?;
    Some(square.sqrt())
}

/// Returns the mean of values; `None` without values.
fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, n), x| (sum + x, n + 1.0));
    (count > 0.0).then(|| sum / count)
}

/// Values in ascending order.
pub(super) struct Distribution(Vec<f64>);

impl Distribution {
    /// Sorts values.
    pub(super) fn new(values: impl Iterator<Item = f64>) -> Self {
        let mut values: Vec<f64> = values.collect();
        order::sort_by_number(&mut values, |x| *x);
        Self(values)
    }

    /// Returns the number of values.
    pub(super) fn count(&self) -> f64 {
        self.0.len() as f64
    }

    /// Returns the mean; `None` without values.
    pub(super) fn mean(&self) -> Option<f64> {
        mean(self.0.iter().copied())
    }

    /// Returns the value below which a share of all values is, interpolated linearly; `None`
    /// without values.
    pub(super) fn quantile(&self, share: f64) -> Option<f64> {
        let place = share * self.0.len().checked_sub(1)? as f64;
        let below = self.0.get(place.floor() as usize)?;
        let above = self.0.get(place.ceil() as usize)?;
        Some(below + (above - below) * place.fract())
    }

    /// Returns the median; `None` without values.
    pub(super) fn median(&self) -> Option<f64> {
        self.quantile(0.5)
    }

    /// Returns the largest value; `None` without values.
    pub(super) fn max(&self) -> Option<f64> {
        self.0.last().copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(hz: f64, samples: usize) -> Vec<f64> {
        let angle = |i: usize| TAU * hz * i as f64 / RATE_HZ;
        (0..samples).map(|i| ops::sin(angle(i))).collect()
    }

    #[test]
    fn a_low_pass_halves_the_power_at_its_cutoff_without_a_phase() {
        let all = 0..600;
        let all = std::slice::from_ref(&all);
        for (hz, gain) in [(0.5, 0.998), (7.0, 0.707), (20.0, 0.06)] {
            let (given, passed) = (wave(hz, 600), low_passed(&wave(hz, 600), all, 7.0));
            for i in 100..500 {
                let off = (passed[i] - gain * given[i]).abs();
                assert!(off < 0.01, "{hz} Hz, sample {i}: {off}");
            }
        }
    }

    #[test]
    fn a_low_pass_keeps_a_uniform_motion_up_to_the_ends_of_runs() {
        let runs = [0..3, 3..40, 40..41];
        let jump = |i: usize| if i < 3 { 0.0 } else { 100.0 };
        let values: Vec<f64> = (0..41).map(|i| 0.1 * i as f64 + jump(i)).collect();
        let passed = low_passed(&values, &runs, 7.0);
        for i in 3..41 {
            let off = (passed[i] - values[i]).abs();
            assert!(off < 1e-9, "sample {i}: {off}");
        }
        let rates = rates(&values, &runs);
        for (i, rate) in rates.iter().enumerate() {
            let expected = if i == 40 { 0.0 } else { 6.0 };
            assert!((rate - expected).abs() < 1e-9, "sample {i}: {rate}");
        }
        assert_eq!(second_rates(&values, &runs).len(), 36);
    }

    #[test]
    fn quantiles_are_interpolated() {
        let values = Distribution::new([4.0, 1.0, 3.0, 2.0].into_iter());
        assert_eq!(values.median(), Some(2.5));
        assert_eq!(values.quantile(1.0), Some(4.0));
        assert_eq!((values.mean(), values.max()), (Some(2.5), Some(4.0)));
        assert_eq!(Distribution::new(std::iter::empty()).median(), None);
        assert_eq!(deviation([1.0, 3.0].into_iter()), Some(1.0));
    }
}
