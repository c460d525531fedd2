//! Minimum durations of hand motion between keys.

use raconteur_base::{DQuat, DVec3, Length};
use raconteur_body::hand_shape::HandAngles;

use super::path::reach_secs;

/// Maximum mean speed of a wrist, metres per second: with the peak of a free movement 4.1 m/s, as
/// in brisk conversation. Faster requests arrive later.
pub(super) const MAX_SPEED_M_S: f64 = 2.2;
/// Maximum mean turn rate of a hand, radians per second: half a turn takes a fifth of a second.
/// Designed.
pub(super) const MAX_TURN_SPEED_RAD_S: f64 = 15.0;
/// Fastest mean speed of a finger joint, radians a second: a fist closes in a tenth of a
/// second at best. Designed.
pub(super) const MAX_FINGER_SPEED_RAD_S: f64 = 18.0;
/// Distance within which a key repeats the previous place and keeps it, metres.
pub(super) const SAME_PLACE_M: f64 = 1e-6;
/// Turns and finger angles within this are one, radians.
const SAME_RAD: f64 = 1e-6;
/// Duration of an unhurried turn: to start, and per radian, seconds. Designed: half a turn takes
/// 0.7 s, as long as a reach of 20 cm.
const TURN_SECS: [f64; 2] = [0.2, 0.16];
/// Time in which fingers form another shape unhurried, seconds. Designed.
pub(super) const SHAPING_SECS: f64 = 0.35;

/// Minimum and comfortable duration of a hand movement, seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct MoveDurations {
    /// The shortest that the planner plans.
    pub(super) min_secs: f64,
    /// Unhurried duration.
    pub(super) easy_secs: f64,
}

impl MoveDurations {
    /// Returns the durations of a wrist movement between two positions, metres.
    pub(super) fn by_wrist(from: DVec3, to: DVec3) -> Self {
        let way_m = from.distance_to(to);
        if way_m <= SAME_PLACE_M {
            return Self::default();
        }
        let least_secs = way_m / MAX_SPEED_M_S;
        Self {
            min_secs: least_secs,
            easy_secs: reach_secs(way_m).max(least_secs),
        }
    }

    /// Returns the durations of a rotation of the hand.
    pub(super) fn by_hand(from: DQuat, to: DQuat) -> Self {
        let turn_rad = from.angle_between(to);
        if turn_rad <= SAME_RAD {
            return Self::default();
        }
        Self {
            min_secs: turn_rad / MAX_TURN_SPEED_RAD_S,
            easy_secs: TURN_SECS[0] + TURN_SECS[1] * turn_rad,
        }
    }

    /// Returns the durations of a change of the hand shape.
    pub(super) fn by_fingers(from: &HandAngles, to: &HandAngles) -> Self {
        let turn_rad = from.greatest_difference(to);
        if turn_rad <= SAME_RAD {
            return Self::default();
        }
        Self {
            min_secs: turn_rad / MAX_FINGER_SPEED_RAD_S,
            easy_secs: SHAPING_SECS,
        }
    }

    /// Returns the durations of two simultaneous movements.
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            min_secs: self.min_secs.max(other.min_secs),
            easy_secs: self.easy_secs.max(other.easy_secs),
        }
    }
}
