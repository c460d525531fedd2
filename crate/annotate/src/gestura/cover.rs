//! Search for an interval that contains another one.

use super::Interval;

/// Intervals, of which any may contain a time span.
pub(crate) struct Cover {
    /// By their starts; each ends with the latest of those that begin no later.
    reach: Vec<Interval>,
}

impl Cover {
    /// Collects intervals.
    pub(crate) fn new(intervals: impl Iterator<Item = Interval>) -> Self {
        let mut reach: Vec<Interval> = intervals.collect();
        reach.sort_by(|a, b| a.start_secs.total_cmp(&b.start_secs));
        let mut end_secs = f64::NEG_INFINITY;
        for interval in &mut reach {
            end_secs = end_secs.max(interval.end_secs);
            interval.end_secs = end_secs;
        }
        Self { reach }
    }

    /// Returns true if one of the intervals contains another one, up to a tolerance in seconds.
    pub(crate) fn contains(&self, inner: Interval, tolerance_secs: f64) -> bool {
        let latest_secs = inner.start_secs + tolerance_secs;
        let early = self.reach.partition_point(|i| i.start_secs <= latest_secs);
        let outer = early.checked_sub(1).map(|last| self.reach[last]);
        outer.is_some_and(|outer| inner.end_secs <= outer.end_secs + tolerance_secs)
    }
}
