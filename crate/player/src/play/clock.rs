//! Progress of a performance and of its delivered cues.

/// Playback clock of a performance: current time and the time up to which cues were delivered.
/// Times are story time, seconds.
pub(crate) struct Clock {
    /// Cues up to this time have passed.
    passed_secs: f64,
    /// Cues up to this time have been delivered.
    delivered_until_secs: f64,
    /// The clock may pass the end.
    open_ended: bool,
    /// Latest time that an open-ended clock has reached.
    open_until_secs: f64,
}

impl Clock {
    /// Creates a clock before the start.
    pub(crate) fn new() -> Self {
        Self {
            passed_secs: -1.0,
            delivered_until_secs: -1.0,
            open_ended: false,
            open_until_secs: 0.0,
        }
    }

    /// Returns the elapsed time; negative before the start.
    pub(crate) fn passed_secs(&self) -> f64 {
        self.passed_secs
    }

    /// Returns the time up to which cues have been delivered, story time, seconds.
    pub(crate) fn reported_secs(&self) -> f64 {
        self.delivered_until_secs
    }

    /// Returns the latest time that an open-ended performance has reached.
    pub(crate) fn open_until_secs(&self) -> f64 {
        self.open_until_secs
    }

    /// Sets whether the clock may pass the end.
    pub(crate) fn set_open_ended(&mut self, open_ended: bool) {
        self.open_ended = open_ended;
    }

    /// Advances the clock; a time in the past has no effect.
    pub(crate) fn advance(&mut self, time_secs: f64) {
        if time_secs > self.passed_secs {
            self.passed_secs = time_secs;
        }
        if self.open_ended && time_secs.is_finite() {
            self.open_until_secs = self.open_until_secs.max(time_secs);
        }
    }

    /// Moves to just before a time. Returns the interval whose cues are not delivered, from
    /// after its first time up to and including its second.
    pub(crate) fn seek(&mut self, time_secs: f64) -> (f64, f64) {
        let to_secs = if time_secs.is_finite() {
            time_secs.next_down()
        } else {
            -1.0
        };
        self.passed_secs = to_secs;
        let from_secs = std::mem::replace(&mut self.delivered_until_secs, to_secs);
        (from_secs, to_secs)
    }

    /// Returns the interval of the cues to deliver, from after its first time up to and including
    /// its second.
    pub(crate) fn deliver(&mut self) -> (f64, f64) {
        let from_secs = std::mem::replace(&mut self.delivered_until_secs, self.passed_secs);
        (from_secs, self.passed_secs)
    }

    /// Returns the displayed time: clamped to the performance unless it is open-ended; its start
    /// for a time that is not a number.
    pub(crate) fn shown_secs(&self, time_secs: f64, end_secs: f64) -> f64 {
        if time_secs.is_nan() {
            return 0.0;
        }
        let open = self.open_ended && time_secs.is_finite();
        let end_secs = if open { time_secs } else { end_secs };
        time_secs.min(end_secs).max(0.0)
    }
}
