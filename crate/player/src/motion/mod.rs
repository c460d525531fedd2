//! Measures of a story's body motion, compared with people's.
//!
//! [`measure`] evaluates a [`Player`] at 60 Hz without rendering and measures trunk, head, hands
//! and feet. Each [`Measure`] includes the value of a lively performer ([`people`]).
//!
//! Trunk, head and hands are measured in the figure's own frame: moves of the whole figure by the
//! script do not count. Feet are measured in the world, because they stand on its ground. Positions
//! and rotations pass a zero-phase low pass of 7 Hz, movements of the hands one of 4 Hz, as those
//! of the performer did. Where the script cuts a limb to other joints, motion is measured before
//! and after the cut.

mod feet;
mod hands;
pub mod people;
mod recording;
mod rests;
mod signal;
mod trunk;
mod two_hands;

use std::ops::RangeInclusive;

use crate::Player;
use recording::Recording;

/// Sampling rate, Hz.
pub const RATE_HZ: f64 = 60.0;

/// One measure of a story's motion, with the values of people.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    /// Measured quantity, for example `chest-yaw-sd`.
    pub name: String,
    /// Unit of all values, for example `°`; empty for ratios and counts.
    pub unit: &'static str,
    /// Value of the story; `None` if it has nothing to measure, for example no steps.
    pub value: Option<f64>,
    /// Value of a lively performer ([`people`]); `None` if unknown.
    pub lively: Option<f64>,
    /// Value of calm conversation: half of the lively one. `None` for quantities that do not scale,
    /// such as durations and shares.
    pub calm: Option<f64>,
}

impl Measure {
    /// Creates a measure without values of people.
    fn new(name: impl Into<String>, unit: &'static str, value: Option<f64>) -> Self {
        Self {
            name: name.into(),
            unit,
            value,
            lively: None,
            calm: None,
        }
    }

    /// Adds the performer's value of a quantity that is about half as large in conversation.
    fn with_amount(mut self, lively: f64) -> Self {
        self.lively = Some(lively);
        self.calm = Some(people::CALM_SHARE * lively);
        self
    }

    /// Adds the performer's value of a quantity that does not scale with liveliness.
    fn with_typical(mut self, lively: f64) -> Self {
        self.lively = Some(lively);
        self
    }
}

/// Measures of one interval of a story.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionReport {
    /// Time of the first sample, story time, seconds.
    pub from_secs: f64,
    /// Time of the last sample, story time, seconds.
    pub to_secs: f64,
    /// All measures, always the same ones in the same order.
    pub measures: Vec<Measure>,
}

impl MotionReport {
    /// Returns the value of the measure with this name; `None` if there is no such measure or the
    /// story has nothing to measure.
    #[must_use]
    pub fn value(&self, name: &str) -> Option<f64> {
        self.measures.iter().find(|m| m.name == name)?.value
    }
}

/// Measures the motion of a whole story.
#[must_use]
pub fn measure(player: &mut Player) -> MotionReport {
    let end = player.end_secs();
    measure_between(player, 0.0..=end)
}

/// Measures the motion in an interval of a story, story time, seconds.
#[must_use]
pub fn measure_between(player: &mut Player, secs: RangeInclusive<f64>) -> MotionReport {
    let recording = Recording::new(player, &secs);
    let mut measures = trunk::measures(&recording);
    measures.extend(feet::measures(&recording));
    measures.extend(hands::measures(&recording));
    measures.extend(two_hands::measures(player, &recording));
    measures.extend(rests::measures(player, &recording));
    MotionReport {
        from_secs: recording.time_secs(0),
        to_secs: recording.time_secs(recording.len().saturating_sub(1)),
        measures,
    }
}
