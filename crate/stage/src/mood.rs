//! Emotional state of a character over time: the current emotions, the strongest of them, and the
//! resulting mood (GEVH 3.5.4).

use raconteur_base::ops;

use crate::emotion::{EmotionType, STRONGEST, Valence};

/// Time constant with which a mood follows emotions, seconds. Designed.
const MOOD_SECS: f64 = 10.0;
/// Time after its end from which an emotion has no effect on the mood, seconds: less than a
/// hundredth of the scale remains.
const FORGOTTEN_SECS: f64 = 7.0 * MOOD_SECS;
/// Moods beyond this, of 10, are positive or negative. Designed.
const MOODY: f64 = 1.0;
/// Moods whose activity is beyond this, of 10, are aroused. Designed.
const AROUSED: f64 = 0.6;
/// Maximum number of emotions considered at one time; more are left out. It bounds the work.
const MAX_EMOTIONS: usize = 64;
/// Strength difference from which another emotion replaces the strongest one in force: two of
/// similar strength do not alternate. Designed.
const HYSTERESIS: f64 = 0.25;

/// Emotion over time, in an attack-sustain-release shape: its intensity rises linearly to the apex,
/// stays constant, and falls linearly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmotionEnvelope {
    /// Type of the emotion.
    pub kind: &'static EmotionType,
    /// Strength of the eliciting events, 0 to 10.
    pub potential: f64,
    /// Peak intensity, 0 to 10: the potential beyond the character's threshold.
    pub intensity: f64,
    /// Activation, −1 to 1.
    pub activation: f64,
    /// Start of the emotion, story time, seconds.
    pub start_secs: f64,
    /// Time of full strength, not before the start.
    pub apex_secs: f64,
    /// End of the constant phase, story time, seconds; not before the apex.
    pub until_secs: f64,
    /// End of the fade, not before the previous time.
    pub end_secs: f64,
}

impl EmotionEnvelope {
    /// Returns the intensity of the emotion at a story time, 0 to 10.
    #[must_use]
    pub fn intensity_at(&self, time_secs: f64) -> f64 {
        if time_secs < self.start_secs || time_secs >= self.end_secs {
            return 0.0;
        }
        let up = (time_secs - self.start_secs) / (self.apex_secs - self.start_secs).max(1e-9);
        let down = (self.end_secs - time_secs) / (self.end_secs - self.until_secs).max(1e-9);
        self.intensity * up.min(down).clamp(0.0, 1.0)
    }

    /// Returns the time at which it has lost half its intensity, until which shot and light are in
    /// force, seconds.
    #[must_use]
    pub fn in_force_until_secs(&self) -> f64 {
        0.5 * (self.until_secs + self.end_secs)
    }

    fn is_in_force(&self, time_secs: f64) -> bool {
        self.intensity > 0.0 && (self.start_secs..self.in_force_until_secs()).contains(&time_secs)
    }

    /// Returns the remainder of its intensity in the mood at a time: a first-order low pass.
    fn left_at(&self, time_secs: f64) -> f64 {
        let ramp = |from: f64| {
            let t = (time_secs - from).max(0.0);
            t - MOOD_SECS * (1.0 - ops::exp(-t / MOOD_SECS))
        };
        let slope = |from: f64, to: f64| (ramp(from) - ramp(to)) / (to - from).max(1e-6);
        let rise = slope(self.start_secs, self.apex_secs.max(self.start_secs + 1e-6));
        let fall = slope(self.until_secs, self.end_secs.max(self.until_secs + 1e-6));
        self.intensity * (rise - fall)
    }
}

/// Mood of a character: the smoothed sum of its emotions, which colours the light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mood {
    /// Sum of good less sum of bad emotions, smoothed; usually −10 to 10.
    pub valence: f64,
    /// Arousal: sum of the activations of the emotions, smoothed; usually −10 to 10.
    pub arousal: f64,
}

impl Mood {
    /// Returns the valence of the mood: negative, neutral or positive.
    #[must_use]
    pub fn sign(&self) -> Valence {
        match self.valence {
            v if v > MOODY => Valence::Positive,
            v if v < -MOODY => Valence::Negative,
            _ => Valence::Neutral,
        }
    }

    /// Returns its strength, 0 to 1, regardless of valence.
    #[must_use]
    pub fn activity(&self) -> f64 {
        (self.arousal / (3.0 * AROUSED)).clamp(0.0, 1.0)
    }

    /// Returns true if the arousal is above the threshold of an aroused mood.
    #[must_use]
    pub fn is_aroused(&self) -> bool {
        self.arousal > AROUSED
    }
}

/// All emotions of a performance, sorted by start; computes mood and emotion at any time.
#[derive(Clone, Debug, Default)]
pub struct EmotionTimeline {
    felt: Vec<EmotionEnvelope>,
    /// The longest of them, seconds.
    longest_secs: f64,
}

impl EmotionTimeline {
    /// Creates a timeline from emotions in any order; emotions whose times are not numbers are
    /// omitted.
    #[must_use]
    pub fn new(felt: impl IntoIterator<Item = EmotionEnvelope>) -> Self {
        let mut felt: Vec<EmotionEnvelope> = felt.into_iter().filter_map(ordered).collect();
        felt.sort_by(|a, b| a.start_secs.total_cmp(&b.start_secs));
        let lengths = felt.iter().map(|f| f.end_secs - f.start_secs);
        Self {
            longest_secs: lengths.fold(0.0, f64::max),
            felt,
        }
    }

    /// Returns all emotions, sorted by start.
    #[must_use]
    pub fn all(&self) -> &[EmotionEnvelope] {
        &self.felt
    }

    /// Returns the emotions that began before a time and ended at most `past_secs` before it; the
    /// latest ones if there are many.
    fn about(&self, time_secs: f64, past_secs: f64) -> &[EmotionEnvelope] {
        let begun = self.felt.partition_point(|f| f.start_secs <= time_secs);
        let oldest_secs = time_secs - past_secs - self.longest_secs;
        let first = self.felt.partition_point(|f| f.start_secs < oldest_secs);
        &self.felt[first.max(begun.saturating_sub(MAX_EMOTIONS))..begun]
    }

    /// Returns the strongest emotion in force at a time; `before` is retained until another one is
    /// clearly stronger. Of two equals, the later one.
    #[must_use]
    pub fn strongest(
        &self,
        time_secs: f64,
        before: Option<&EmotionEnvelope>,
    ) -> Option<EmotionEnvelope> {
        let in_force = self.about(time_secs, 0.0).iter();
        let in_force = in_force.filter(|f| f.is_in_force(time_secs));
        let strongest = in_force.max_by(|a, b| a.potential.total_cmp(&b.potential))?;
        let kept = before.filter(|b| {
            // The emotion that begins last in the script is the current topic of the story.
            b.is_in_force(time_secs)
                && strongest.start_secs <= b.start_secs
                && strongest.potential < b.potential + HYSTERESIS
        });
        Some(*kept.unwrap_or(strongest))
    }

    /// Returns the mood at a story time.
    #[must_use]
    pub fn mood(&self, time_secs: f64) -> Mood {
        let felt = self.about(time_secs, FORGOTTEN_SECS).iter();
        felt.fold(Mood::default(), |mood, f| {
            let left = f.left_at(time_secs);
            Mood {
                valence: mood.valence + f.kind.valence.sign() * left,
                arousal: mood.arousal + f.activation * left,
            }
        })
    }
}

/// Returns the emotion with its times in order and its amounts clamped to their scales; `None` if a
/// value is not a number.
fn ordered(felt: EmotionEnvelope) -> Option<EmotionEnvelope> {
    let all = [
        felt.start_secs,
        felt.apex_secs,
        felt.until_secs,
        felt.end_secs,
        felt.potential,
        felt.intensity,
        felt.activation,
    ];
    if !all.iter().all(|x| x.is_finite()) {
        return None;
    }
    let apex_secs = felt.apex_secs.max(felt.start_secs);
    let until_secs = felt.until_secs.max(apex_secs);
    Some(EmotionEnvelope {
        potential: felt.potential.clamp(0.0, STRONGEST),
        intensity: felt.intensity.clamp(0.0, STRONGEST),
        activation: felt.activation.clamp(-1.0, 1.0),
        apex_secs,
        until_secs,
        end_secs: felt.end_secs.max(until_secs),
        ..felt
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn felt(kind: &str, start: f64, potential: f64) -> EmotionEnvelope {
        EmotionEnvelope {
            kind: EmotionType::named(kind).expect(kind),
            potential,
            intensity: potential,
            activation: 0.3,
            start_secs: start,
            apex_secs: start + 0.6,
            until_secs: start + 3.0,
            end_secs: start + 7.0,
        }
    }

    #[test]
    fn a_mood_is_the_low_pass_of_what_is_felt() {
        let feelings = EmotionTimeline::new([felt("joy", 1.0, 5.0), felt("anger", 6.0, 3.0)]);
        // The same by small steps.
        let (mut valence, step) = (0.0, 0.001);
        for i in 0..40_000 {
            let t = f64::from(i) * step;
            let sum: f64 = feelings
                .all()
                .iter()
                .map(|f| f.kind.valence.sign() * f.intensity_at(t))
                .sum();
            valence += (sum - valence) * step / MOOD_SECS;
            if i % 1000 == 0 {
                let mood = feelings.mood(t + step).valence;
                assert!((mood - valence).abs() < 2e-3, "{t}: {mood} {valence}");
            }
        }
    }

    #[test]
    fn the_strongest_emotion_is_not_disturbed_by_one_like_it() {
        let feelings = EmotionTimeline::new([felt("joy", 0.0, 5.0), felt("hope", 0.0, 5.1)]);
        let joy = feelings.all()[0];
        let first = feelings.strongest(1.0, None).expect("one");
        assert_eq!(first.kind.name, "hope");
        let kept = feelings.strongest(1.0, Some(&joy)).expect("one");
        assert_eq!(kept.kind.name, "joy");
        let later = EmotionTimeline::new([joy, felt("anger", 2.0, 4.9)]);
        assert_eq!(
            later.strongest(2.5, Some(&joy)).map(|f| f.kind.name),
            Some("joy")
        );
        assert_eq!(feelings.strongest(8.0, None), None);
    }
}
