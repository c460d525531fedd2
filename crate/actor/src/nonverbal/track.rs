//! Keyed values over time with smooth steps between the keys: the output of all plans.

use raconteur_base::curve::{lerp, smooth};

/// A value at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Key {
    at_secs: f64,
    value: f64,
}

/// Keyed quantity over time that all expression plans result in. Between keys the value follows a
/// cubic with zero slope at both; outside them it is constant.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Track {
    keys: Vec<Key>,
}

impl Track {
    /// Returns the value at a time, seconds; 0 for a track without keys. O(log n).
    pub(super) fn sample(&self, time_secs: f64) -> f64 {
        let next = self.keys.partition_point(|k| k.at_secs <= time_secs);
        let before = next.checked_sub(1).map(|i| self.keys[i]);
        match (before, self.keys.get(next)) {
            (Some(a), Some(b)) => {
                let share = (time_secs - a.at_secs) / (b.at_secs - a.at_secs);
                lerp(a.value, b.value, smooth(share))
            }
            (Some(only), None) => only.value,
            (None, Some(first)) => first.value,
            (None, None) => 0.0,
        }
    }

    /// Returns the value at the last key; 0 without keys.
    pub(super) fn last(&self) -> f64 {
        self.keys.last().map_or(0.0, |k| k.value)
    }

    /// Returns the time of the last key; minus infinity without one.
    pub(super) fn end_secs(&self) -> f64 {
        self.keys.last().map_or(f64::NEG_INFINITY, |k| k.at_secs)
    }

    /// Adds a key; one that is not later than the last is left out.
    pub(super) fn push(&mut self, at_secs: f64, value: f64) {
        if at_secs > self.end_secs() && at_secs.is_finite() && value.is_finite() {
            self.keys.push(Key { at_secs, value });
        }
    }

    /// Moves from the last value to another within a time, as soon as the previous move is over. A
    /// move that would be delayed by more than its own length replaces the target of the previous
    /// one.
    pub(super) fn move_to(&mut self, from_secs: f64, length_secs: f64, value: f64) {
        let begun = self.end_secs();
        if begun > from_secs + length_secs {
            if let Some(last) = self.keys.last_mut() {
                last.value = value;
            }
            return;
        }
        let from_secs = from_secs.max(begun);
        self.push(from_secs, self.last());
        self.push(from_secs + length_secs, value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_hold_outside_and_step_smoothly_between() {
        let mut track = Track::default();
        assert_eq!(track.sample(1.0), 0.0);
        track.push(1.0, 2.0);
        track.push(1.0, 9.0);
        track.push(f64::NAN, 9.0);
        track.push(2.0, 4.0);
        assert_eq!(
            [0.0, 1.0, 1.5, 2.0, 9.0].map(|t| track.sample(t)),
            [2.0, 2.0, 3.0, 4.0, 4.0]
        );
        assert!(
            track.sample(1.01) - 2.0 < 1e-3,
            "the step is smooth at its start"
        );
    }

    #[test]
    fn a_move_waits_for_the_one_before_or_replaces_its_aim() {
        let mut track = Track::default();
        track.move_to(0.0, 1.0, 1.0);
        track.move_to(0.5, 1.0, 0.5);
        assert_eq!([0.0, 1.0, 2.0].map(|t| track.sample(t)), [0.0, 1.0, 0.5]);
        track.move_to(0.6, 1.0, 0.7);
        assert_eq!(track.sample(2.0), 0.7);
        assert_eq!(track.end_secs(), 2.0);
    }
}
