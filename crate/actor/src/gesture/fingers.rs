//! Hand shapes over time. They keep their own keys: fingers that drum or walk must not make
//! the arm that carries them stop.

use raconteur_base::curve::{last_at_or_before, minimum_jerk};
use raconteur_body::hand_shape::HandAngles;

use super::Rest;

/// Fingers form a little before the hand arrives: they take this share less of the time.
const EARLY: f64 = 1.2;

/// Finger angles of one hand over the whole story.
#[derive(Clone, Debug, Default)]
pub(super) struct FingerTrack {
    times: Vec<f64>,
    shapes: Vec<HandAngles>,
}

impl FingerTrack {
    /// The angles at a time: relaxed before the first key, the last key after it.
    pub(super) fn at(&self, time_secs: f64) -> HandAngles {
        let Some(i) = last_at_or_before(&self.times, time_secs) else {
            return Rest::shape();
        };
        let (from, Some(to)) = (&self.shapes[i], self.shapes.get(i + 1)) else {
            return self.shapes[i];
        };
        let length = self.times[i + 1] - self.times[i];
        if length <= 0.0 {
            return *to;
        }
        let s = (time_secs - self.times[i]) / length;
        from.lerp(to, minimum_jerk((s * EARLY).min(1.0)))
    }

    /// The shape of the last key.
    pub(super) fn last(&self) -> HandAngles {
        self.shapes.last().copied().unwrap_or_else(Rest::shape)
    }

    /// Adds a key, no earlier than the one before.
    pub(super) fn push(&mut self, time_secs: f64, shape: HandAngles) {
        let time_secs = self.times.last().map_or(time_secs, |t| time_secs.max(*t));
        self.times.push(time_secs);
        self.shapes.push(shape);
    }

    /// Takes keys later than this back.
    pub(super) fn forget_after(&mut self, time_secs: f64) {
        let keep = self.times.partition_point(|t| *t <= time_secs);
        self.times.truncate(keep);
        self.shapes.truncate(keep);
    }
}
