//! Spine, neck and shoulders: posture, noise, breath and small head motion.

use raconteur_base::curve::last_at_or_before;
use raconteur_base::order::sort_by_number;
use raconteur_base::{DQuat, DVec3, noise, ops};

use super::stream;
use crate::body_posture::{BodyPosture, Turn};
use crate::emotion::Breathing;

/// Breaths at rest, Hz (12 to 18 a minute is the adult norm).
const BREATH_HZ: f64 = 0.25;
/// Increase of the breathing rate while speaking, Hz. Designed.
const BREATH_SPEAKING_HZ: f64 = 0.07;

/// Speech intervals of a story; they make breath and head motion livelier during speech.
#[derive(Clone, Debug, Default)]
pub struct SpeechRhythm {
    /// Beginning of each utterance, ascending, seconds.
    starts: Vec<f64>,
    ends: Vec<f64>,
    /// Seconds of speech before each utterance.
    spoken: Vec<f64>,
}

impl SpeechRhythm {
    /// Creates the rhythm from intervals of speech (start and end, seconds, in any order).
    #[must_use]
    pub fn new(spans: &[(f64, f64)]) -> Self {
        let mut spans = spans.to_vec();
        sort_by_number(&mut spans, |s| s.0);
        let mut rhythm = Self::default();
        let mut total = 0.0;
        for (start, end) in spans {
            rhythm.starts.push(start);
            rhythm.ends.push(end);
            rhythm.spoken.push(total);
            total += (end - start).max(0.0);
        }
        rhythm
    }

    /// Returns the seconds spoken before a time.
    fn spoken_before(&self, time_secs: f64) -> f64 {
        last_at_or_before(&self.starts, time_secs).map_or(0.0, |i| {
            self.spoken[i] + (time_secs.min(self.ends[i]) - self.starts[i]).max(0.0)
        })
    }

    /// Returns the proximity of speech at a time: 1 during speech, falling to 0 half a second
    /// before and after it.
    #[must_use]
    pub fn speaking(&self, time_secs: f64) -> f64 {
        self.near(time_secs, 0.5)
    }

    /// Returns the proximity of speech at a time: 1 during speech, falling to 0 by `secs` before and
    /// after it.
    pub(crate) fn near(&self, time_secs: f64, secs: f64) -> f64 {
        let near = |i: usize| {
            let outside = (self.starts[i] - time_secs)
                .max(time_secs - self.ends[i])
                .max(0.0);
            1.0 - raconteur_base::curve::smooth(outside / secs)
        };
        let i = self.starts.partition_point(|s| *s <= time_secs);
        let before = i.checked_sub(1).map_or(0.0, near);
        let after = if i < self.starts.len() { near(i) } else { 0.0 };
        before.max(after)
    }
}

/// Idle motion of trunk, shoulders and head: breathing and seeded noise.
#[derive(Clone, Copy, Debug)]
pub struct TrunkMotion {
    /// Seed of the performance.
    pub seed: u64,
}

impl TrunkMotion {
    /// Returns the breath without the phrases of speech at a time, −1 (exhaled) to 1 (inhaled) if
    /// `breathing` is calm.
    #[must_use]
    pub fn breath(&self, rhythm: &SpeechRhythm, time_secs: f64, breathing: &Breathing) -> f64 {
        let turns = BREATH_HZ * (time_secs + breathing.lead_secs)
            + BREATH_SPEAKING_HZ * rhythm.spoken_before(time_secs)
            + 0.12 * noise::perlin(self.seed, stream::BREATH, 0.21 * time_secs);
        // In faster than out.
        let phase = core::f64::consts::TAU * turns;
        breathing.depth * ops::sin(phase + 0.35 * ops::sin(phase))
    }

    /// Returns the rotations of lumbar and thoracic spine, without the head's gaze. `weight` is the
    /// stance's, `amount` scales everything, `breath` is the filling of the lungs.
    #[must_use]
    pub(crate) fn turns(
        &self,
        rhythm: &SpeechRhythm,
        time_secs: f64,
        weight: f64,
        amount: f64,
        (breath, posture): (f64, &BodyPosture),
    ) -> [DQuat; 2] {
        let n = |id: u64, hz: f64| noise::perlin(self.seed, stream::SPINE + id, hz * time_secs);
        let lively = 0.6 + 0.4 * rhythm.speaking(time_secs);
        // The spine compensates the tilt of the pelvis, so that the head stays over the feet.
        let lean = amount * (0.012 * n(0, 0.23) * lively) + 0.012;
        let roll = amount * (0.010 * n(1, 0.17) - 0.024 * weight);
        let yaw = amount * (0.022 * n(2, 0.15) * lively - 0.01 * weight);
        let Turn {
            lean: l,
            roll: r,
            yaw: y,
        } = posture.lumbar;
        let lumbar = spine(lean + l, roll + r, yaw + y);
        let lean = amount * (0.010 * n(3, 0.29) * lively - 0.007 * breath) - 0.008;
        let roll = amount * (0.007 * n(4, 0.31) - 0.024 * weight);
        let yaw = amount * 0.016 * n(5, 0.21) * lively;
        let Turn {
            lean: l,
            roll: r,
            yaw: y,
        } = posture.thoracic;
        [lumbar, spine(lean + l, roll + r, yaw + y)]
    }

    /// Returns the elevation of one shoulder, radians; `side_id` is 0 for left, 1 for right,
    /// `breath` the filling of the lungs.
    #[must_use]
    pub fn shrug(&self, time_secs: f64, side_id: u64, amount: f64, breath: f64) -> f64 {
        let slow = noise::perlin(self.seed, stream::SPINE + 8 + side_id, 0.14 * time_secs);
        amount * (0.011 * breath + 0.014 * slow)
    }

    /// Returns the noise rotation of the head relative to the chest: pitch (positive down), roll
    /// and yaw, radians.
    #[must_use]
    pub fn head_motion(&self, rhythm: &SpeechRhythm, time_secs: f64, amount: f64) -> DVec3 {
        let n = |id: u64, hz: f64| noise::perlin(self.seed, stream::HEAD + id, hz * time_secs);
        let lively = 0.5 + 0.9 * rhythm.speaking(time_secs);
        let pitch = 0.022 * n(0, 0.37) + 0.009 * n(1, 1.1);
        let roll = 0.024 * n(2, 0.27) + 0.006 * n(3, 0.9);
        let yaw = 0.034 * n(4, 0.31) + 0.010 * n(5, 0.8);
        DVec3::new(pitch, roll, yaw) * lively * amount
    }
}

/// Returns the local rotation of a bone of spine, neck or skull from lean (positive forward), roll
/// and yaw (positive to the left), radians. Local x is up, y front, z left.
#[must_use]
pub fn spine(lean_rad: f64, roll_rad: f64, yaw_rad: f64) -> DQuat {
    DQuat::from_rotation_x(yaw_rad)
        * DQuat::from_rotation_z(lean_rad)
        * DQuat::from_rotation_y(-roll_rad)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spine_angles_turn_the_way_they_say() {
        // In the local frame x is up, y front, z left.
        let up = DVec3::X;
        assert!(
            (spine(0.3, 0.0, 0.0) * up).y > 0.2,
            "the first spine angle tilts forwards"
        );
        assert!(
            (spine(0.0, 0.3, 0.0) * up).z > 0.2,
            "the second spine angle tilts to the left"
        );
        assert!(
            (spine(0.0, 0.0, 0.3) * DVec3::Y).z > 0.2,
            "the third spine angle turns to the left"
        );
    }

    #[test]
    fn breath_is_faster_in_speech() {
        let count = |rhythm: &SpeechRhythm| {
            let trunk = TrunkMotion { seed: 3 };
            let at = |i: i32| trunk.breath(rhythm, f64::from(i) * 0.01, &Breathing::CALM) > 0.0;
            (1..24_000).filter(|i| at(*i) && !at(i - 1)).count()
        };
        let silent = count(&SpeechRhythm::default());
        let talking = count(&SpeechRhythm::new(&[(0.0, 240.0)]));
        assert!((55..=66).contains(&silent), "{silent}");
        assert!(talking > silent + 12, "{talking}");
    }

    #[test]
    fn speech_fades_in_and_out() {
        let r = SpeechRhythm::new(&[(1.0, 2.0), (5.0, 6.0)]);
        assert_eq!(r.speaking(1.5), 1.0);
        assert_eq!(r.speaking(3.5), 0.0);
        assert!(
            r.speaking(2.25) > 0.4 && r.speaking(4.75) > 0.4,
            "speech fades out after 2 s and in before 5 s"
        );
        assert!(
            (r.spoken_before(5.5) - 1.5).abs() < 1e-12,
            "the time spoken before 5.5 s"
        );
    }
}
