//! Utterance at its time in a story.

use std::sync::Arc;

use crate::Utterance;

/// Utterance with its start time in a story. Times in the utterance count from its start; this type
/// converts them to story time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TimedUtterance {
    /// Story time of its first sample, seconds.
    pub start_secs: f64,
    /// The utterance, with times from its start.
    pub utterance: Arc<Utterance>,
}

impl TimedUtterance {
    /// Returns the story time at which the utterance ends, seconds.
    #[must_use]
    pub fn end_secs(&self) -> f64 {
        self.start_secs + self.utterance.duration_secs
    }

    /// Converts an offset from the start of the utterance to story time, seconds.
    #[must_use]
    pub fn story_secs(&self, offset_secs: f64) -> f64 {
        self.start_secs + offset_secs
    }

    /// Converts a story time to an offset from the start of the utterance, seconds.
    #[must_use]
    pub fn offset_secs(&self, story_secs: f64) -> f64 {
        story_secs - self.start_secs
    }
}
