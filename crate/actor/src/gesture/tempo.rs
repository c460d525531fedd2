//! Tempo of the hands over a story: with its tension, free movements get faster and holds longer.

use raconteur_base::curve::lerp;

use crate::discourse::Discourse;

/// Speed of free movements at tension 0 and 1; the mean is 1 at tension 0.5. Designed after
/// Rühlemann 2024 (doi:10.3389/fpsyg.2024.1477263): force and holds grow to the climax of a story.
const SPEED_BY_TENSION: [f64; 2] = [0.82, 1.18];
/// Length of holds at tension 0 and 1, likewise.
const HOLD_BY_TENSION: [f64; 2] = [0.7, 1.3];

/// Speed of free movements and length of holds, from the tension of a story.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tempo<'a> {
    pub(super) discourse: &'a Discourse,
}

impl Tempo<'_> {
    /// Returns the speed of free movements at a time; 1 in ordinary telling.
    pub(super) fn speed_at(self, time_secs: f64) -> f64 {
        let [least, most] = SPEED_BY_TENSION;
        lerp(least, most, self.discourse.tension_at(time_secs))
    }

    /// Returns the length of holds at a time; 1 in ordinary telling.
    pub(super) fn hold_at(self, time_secs: f64) -> f64 {
        let [least, most] = HOLD_BY_TENSION;
        lerp(least, most, self.discourse.tension_at(time_secs))
    }
}
