//! Hand shapes over time. They have their own keys, so that drumming or walking fingers do not stop
//! the arm.

use raconteur_base::curve::minimum_jerk;
use raconteur_base::profile::Profile;
use raconteur_body::hand_shape::HandAngles;

use super::RestPostures;
use super::pace::MAX_FINGER_SPEED_RAD_S;
use super::tracks::piece_at;

/// Lead of finger formation: fingers take this share less of the time, so they form slightly before
/// the hand arrives.
const EARLY: f64 = 1.2;
/// Maximum overshoot of a profile between two shapes: fingers have little range beyond their
/// shapes.
const OVERSHOOT: f64 = 0.15;

/// Finger angles of one hand over the whole story, with their own keys.
#[derive(Clone, Debug, Default)]
pub(super) struct FingerTrack {
    times: Vec<f64>,
    nodes: Vec<FingerNode>,
}

/// A shape, and how the fingers move on from it.
#[derive(Clone, Copy, Debug)]
struct FingerNode {
    /// Hand shape; `None` is rest.
    shape: Option<HandAngles>,
    /// Profile to the next node; `None` uses the default motion of fingers.
    profile: Option<Profile>,
}

impl FingerNode {
    fn angles(&self, rest: &HandAngles) -> HandAngles {
        self.shape.unwrap_or(*rest)
    }
}

impl FingerTrack {
    /// Returns the finger angles at a time (those at rest before the first key) and the share of
    /// the rest posture in them, 0 to 1.
    pub(super) fn sample(&self, time_secs: f64, rest: &HandAngles) -> (HandAngles, f64) {
        let Some((i, s, _)) = piece_at(&self.times, time_secs) else {
            return (*rest, 1.0);
        };
        let (from, to) = (&self.nodes[i], &self.nodes[i + 1]);
        let m = match from.profile {
            Some(profile) => profile.sample(s).clamp(-OVERSHOOT, 1.0 + OVERSHOOT),
            None => minimum_jerk((s * EARLY).min(1.0)),
        };
        let share = |node: &FingerNode| f64::from(u8::from(node.shape.is_none()));
        let rest_share = share(from) + (share(to) - share(from)) * m.clamp(0.0, 1.0);
        (from.angles(rest).lerp(&to.angles(rest), m), rest_share)
    }

    /// Returns the last key; rest when there is none.
    pub(super) fn last(&self) -> Option<HandAngles> {
        self.nodes.last().and_then(|node| node.shape)
    }

    /// Returns the time of the last key; minus infinity when there is none.
    pub(super) fn last_secs(&self) -> f64 {
        self.times.last().copied().unwrap_or(f64::NEG_INFINITY)
    }

    /// Adds a key, no earlier than fingers can follow the one before. Returns its time.
    pub(super) fn push(
        &mut self,
        time_secs: f64,
        shape: Option<HandAngles>,
        profile: Option<Profile>,
    ) -> f64 {
        let node = FingerNode {
            shape,
            profile: None,
        };
        let mut time_secs = time_secs;
        if let (Some(t), Some(last)) = (self.times.last(), self.nodes.last_mut()) {
            let turn_rad = last
                .angles(&RestPostures::shape())
                .greatest_difference(&node.angles(&RestPostures::shape()));
            time_secs = time_secs.max(t + turn_rad / MAX_FINGER_SPEED_RAD_S);
            last.profile = profile;
        }
        self.times.push(time_secs);
        self.nodes.push(node);
        time_secs
    }

    /// Removes keys later than a time.
    pub(super) fn forget_after(&mut self, time_secs: f64) {
        let keep = self.times.partition_point(|t| *t <= time_secs);
        self.times.truncate(keep);
        self.nodes.truncate(keep);
    }
}
