//! Intervals of story time.

/// Interval of story time, seconds; for example one in which gestures are enabled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeSpan {
    /// Start of the interval.
    pub start_secs: f64,
    /// End; may be infinite.
    pub end_secs: f64,
}
