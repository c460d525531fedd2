//! Face: combines speech with all other facial motion.

use raconteur_base::noise;
use raconteur_body::face::{FaceControls, Muscle};

use super::Actor;
use crate::articulation::{articulate, hold_closures};
use crate::idle::stream;
use crate::lips::{LipTrack, MouthTargets};

/// Smile of a figure with no other expression. Designed: friendly, not grinning.
const RESTING_SMILE: f64 = 0.14;

/// Smile of a figure that waits to begin. Designed: a welcome to the audience.
const WELCOME_SMILE: f64 = 0.34;

impl Actor {
    /// Returns the activation of the emotions at a time, 0 (calm or passive) to 1; pupils widen
    /// with it.
    #[must_use]
    pub fn arousal(&self, time_secs: f64) -> f64 {
        self.feeling.arousal(time_secs)
    }

    /// Returns the controls of the face at a story time, seconds. They apply to figures of every
    /// kind, and every value is within its range.
    #[must_use]
    pub fn controls(&self, time_secs: f64) -> FaceControls {
        let t = if time_secs.is_finite() {
            time_secs
        } else {
            0.0
        };
        self.face(&self.mouth(t), t)
    }

    /// Computes the face controls: speech first, then all other sources, each added to the sum (F&H
    /// section 4.3.5: contractions are summed, then limited).
    pub(super) fn face(&self, mouth: &MouthTargets, t: f64) -> FaceControls {
        let mut controls = FaceControls::default();
        articulate(mouth, self.feeling.loudness(t), &mut controls);
        self.expression(t, &mut controls);
        self.feeling.add(t, &mut controls);
        controls.raise_jaw();
        // Closures override the sum of all motion; a blink overrides the lids.
        hold_closures(&mut controls);
        controls.close_lids(self.feeling.closure(t));
        controls
    }

    /// Returns the state of the mouth at a story time, seconds: from speech, plus the visemes that
    /// the script sets.
    pub(super) fn mouth(&self, t: f64) -> MouthTargets {
        let mut mouth = self.spoken_mouth(t);
        if let Some(asked) = self.feeling.visemes(t) {
            let channels = mouth.channels.iter_mut().zip(asked.channels);
            channels.for_each(|(value, more)| *value += more);
            mouth.press = (mouth.press + asked.press).min(1.0);
            mouth.bite = (mouth.bite + asked.bite).min(1.0);
        }
        mouth
    }

    /// Returns the lip track of each utterance with its start time, story seconds.
    #[must_use]
    pub fn lips(&self) -> &[(f64, LipTrack)] {
        &self.lips
    }

    fn spoken_mouth(&self, t: f64) -> MouthTargets {
        let i = self.lips.partition_point(|(start, _)| *start <= t);
        let track = |i: usize| self.lips.get(i).map(|(start, track)| (t - start, track));
        // The one that has begun, else the one about to.
        let begun = i
            .checked_sub(1)
            .and_then(track)
            .filter(|(at, track)| track.covers(*at));
        match begun.or_else(|| track(i).filter(|(at, track)| track.covers(*at))) {
            Some((at, track)) => track.sample(at),
            None => MouthTargets::default(),
        }
    }

    /// Adds a resting smile and a little unrest.
    fn expression(&self, t: f64, controls: &mut FaceControls) {
        let n =
            |id: u64, hz: f64| noise::perlin(self.seed, stream::FACE + id, hz * t) * self.amount;
        let speaking = self.rhythm.speaking(t) * self.amount;
        // A crying character does not smile idly.
        let resting = if self.welcomes {
            WELCOME_SMILE
        } else {
            RESTING_SMILE
        };
        let resting = resting * (1.0 - self.feeling.strength(t));
        let smile = resting + 0.05 * n(0, 0.11) - 0.03 * speaking;
        let smile = [smile + 0.012 * n(1, 0.2), smile - 0.012 * n(1, 0.2)];
        let inner = 0.05 * n(2, 0.3).max(0.0) + 0.03 * speaking;
        let down = 0.05 * (-n(2, 0.3)).max(0.0);
        let squint = 0.04 + 0.03 * n(3, 0.17);
        for (i, smile) in smile.into_iter().enumerate() {
            for (muscle, contraction) in [
                (Muscle::ZygomaticusMajorLeft, smile),
                (Muscle::OrbicularisOculiLeft, squint + 0.25 * smile),
                (Muscle::FrontalisMedialLeft, inner),
                (Muscle::CorrugatorLeft, 0.8 * down),
                (Muscle::DepressorSuperciliiLeft, 0.8 * down),
            ] {
                controls.contraction[muscle.index() + i] += contraction;
            }
        }
    }
}
