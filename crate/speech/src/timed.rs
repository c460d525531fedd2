//! Utterance at its time in a story.

use std::sync::Arc;

use crate::Utterance;

/// An utterance with its start time in a story. Times in the utterance count from its start; only
/// this type converts them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TimedUtterance {
    /// Story time of its first sample, seconds.
    pub start_secs: f64,
    /// The utterance, with times from its start.
    pub utterance: Arc<Utterance>,
}

impl TimedUtterance {
    /// Story time at which it ends, seconds.
    #[must_use]
    pub fn end_secs(&self) -> f64 {
        self.start_secs + self.utterance.duration_secs
    }

    /// The story time of an offset from its start, seconds.
    #[must_use]
    pub fn story_secs(&self, offset_secs: f64) -> f64 {
        self.start_secs + offset_secs
    }

    /// The offset of a story time from its start, seconds.
    #[must_use]
    pub fn offset_secs(&self, story_secs: f64) -> f64 {
        story_secs - self.start_secs
    }
}
