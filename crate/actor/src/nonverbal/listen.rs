//! Gaze of a listener: at the speaker, with small steps over the face and short looks aside. It is
//! a function of time alone, because silence has no end.

use raconteur_base::curve::{minimum_jerk, smooth};
use raconteur_base::noise;

use crate::idle::stream;

/// Mean time between looks aside, and their mean length, seconds (Lee, Badler and Badler 2002,
/// doi:10.1145/566654.566629: listeners look at the speaker for 237.5 frames at 30 frames per
/// second on average, and aside for 13).
const STRETCH_SECS: f64 = 250.5 / 30.0;
const ASIDE_SECS: f64 = 13.0 / 30.0;
/// Interval of one fixation while looking at a face, seconds. Designed.
const FIXATION_SECS: f64 = 0.9;
/// Offsets on a face, radians. Designed: from eye to eye to mouth.
const ON_FACE_RAD: f64 = 0.013;
/// Time of a small and of a larger saccade, seconds (Lee et al. 2002: 25 ms and 2.4 ms a
/// degree).
const STEP_SECS: f64 = 0.03;
const SACCADE_SECS: f64 = 0.055;
/// Time in which a listener becomes a speaker and back, seconds. Designed.
const CHANGE_SECS: f64 = 0.25;

/// Gaze of a figure while it listens or is silent: small steps over the other's face and short
/// looks aside.
#[derive(Clone, Debug)]
pub(super) struct ListenerGaze {
    /// Spans in which the speaker's own plan rules, by time.
    turns: Vec<[f64; 2]>,
    seed: u64,
    amount: f64,
}

impl ListenerGaze {
    pub(super) fn new(turns: Vec<[f64; 2]>, amount: f64, seed: u64) -> Self {
        Self {
            turns,
            seed,
            amount,
        }
    }

    /// Returns the deviation of the gaze from the other person at a time: yaw (left) and pitch
    /// (down), radians.
    pub(super) fn aversion(&self, time_secs: f64) -> [f64; 2] {
        let far_secs = self.to_turn(time_secs, time_secs);
        if far_secs <= 0.0 {
            return [0.0; 2];
        }
        let share = smooth(far_secs / CHANGE_SECS);
        let [micro, aside] = [self.fixation(time_secs), self.aside(time_secs)];
        [0, 1].map(|k| self.amount * (share * micro[k] + aside[k]))
    }

    /// Returns the time between a span and the nearest turn; 0 if they overlap.
    fn to_turn(&self, start_secs: f64, end_secs: f64) -> f64 {
        let after = self.turns.partition_point(|turn| turn[0] <= end_secs);
        let before = after
            .checked_sub(1)
            .map_or(f64::INFINITY, |i| start_secs - self.turns[i][1]);
        let behind = self
            .turns
            .get(after)
            .map_or(f64::INFINITY, |turn| turn[0] - end_secs);
        before.min(behind).max(0.0)
    }

    /// Returns the look aside of this interval, unless a turn is near.
    fn aside(&self, time_secs: f64) -> [f64; 2] {
        let stretch = (time_secs / STRETCH_SECS).floor();
        let r = |k: u64| noise::unit(self.seed, stream::LISTEN + k, stretch as i64);
        let start_secs = (stretch + 0.05 + 0.75 * r(0)) * STRETCH_SECS;
        let end_secs = start_secs + ASIDE_SECS * (0.5 + r(1));
        if self.to_turn(start_secs, end_secs + SACCADE_SECS) <= 0.0 {
            return [0.0; 2];
        }
        let there = minimum_jerk((time_secs - start_secs) / SACCADE_SECS);
        let back = minimum_jerk((time_secs - end_secs) / SACCADE_SECS);
        let side = if r(2) < 0.5 { -1.0 } else { 1.0 };
        [side * (0.1 + 0.15 * r(3)), -0.05 + 0.2 * r(4)].map(|a| a * (there - back))
    }

    /// Returns the gaze offset of small steps over the other's face at a time: yaw and pitch,
    /// radians.
    fn fixation(&self, time_secs: f64) -> [f64; 2] {
        let bucket = (time_secs / FIXATION_SECS).floor();
        let i = bucket as i64;
        let late = 0.6 * FIXATION_SECS * noise::unit(self.seed, stream::SACCADE, i);
        let s = minimum_jerk((time_secs - bucket * FIXATION_SECS - late) / STEP_SECS);
        [1, 2].map(|k| {
            let at = |i: i64| ON_FACE_RAD * noise::signed(self.seed, stream::SACCADE + k, i);
            let before = at(i.wrapping_sub(1));
            before + (at(i) - before) * s
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::ops;

    #[test]
    fn a_listener_looks_at_the_other_and_aside_as_people_do() {
        let listening = ListenerGaze::new(Vec::new(), 1.0, 5);
        let is_aside = |i: i32| {
            let [yaw, pitch] = listening.aversion(f64::from(i) * 0.01);
            ops::hypot(yaw, pitch) > 0.05
        };
        let share = (0..360_000).filter(|i| is_aside(*i)).count() as f64 / 360_000.0;
        assert!((share - 13.0 / 250.5).abs() < 0.005, "{share}");
    }

    #[test]
    fn who_is_about_to_speak_looks_aside_no_more() {
        let listening = ListenerGaze::new(vec![[10.0, 20.0], [30.0, 40.0]], 1.0, 5);
        assert!(
            (100..=200).all(|i| listening.aversion(f64::from(i) * 0.1) == [0.0; 2]),
            "the listener who is about to speak does not look away"
        );
        for i in 0..50_000 {
            let t = f64::from(i) * 0.001;
            let [a, b] = [listening.aversion(t), listening.aversion(t + 0.001)];
            assert!(ops::hypot(a[0] - b[0], a[1] - b[1]) < 0.012, "{t}");
        }
    }
}
