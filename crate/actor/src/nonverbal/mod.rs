//! Nonverbal behaviour of face and head (F&H sections 4.1 to 4.3): raises of head and brows with
//! the pitch, blinks, gaze, thought, moistened lips, and loudness.
//!
//! The planner creates keys on the story clock once, from the utterances and a seed; any time can
//! then be evaluated, in any order, without allocation.
//!
//! Scope: illustrators, punctuators, regulators and manipulators (section 4.1.1). Out of scope:
//! emblems and affect displays, which require the meaning of the words; lips.

mod accent;
mod blink;
mod contour;
mod extreme;
mod gaze;
mod head_gesture;
mod listen;
mod loudness;
mod lungs;
mod manner;
mod negation;
mod pitch;
mod raise;
mod speech_features;
#[cfg(test)]
mod tests;
mod text;
mod think;
mod track;

use raconteur_base::order::sort_by_number;
use raconteur_body::face::{FaceControls, Muscle};
use raconteur_speech::TimedUtterance;

use crate::discourse::Discourse;
use crate::superposition::SuperposedTrack;

use blink::Blinks;
use gaze::Gaze;
pub(crate) use gaze::PlacedLook;
use head_gesture::HeadGestures;
use listen::ListenerGaze;
use raise::Raises;
use speech_features::SpeechFeatures;
use track::Track;

pub use blink::{CLOSED_SECS, CLOSING_SECS, MAX_APART_SECS, OPENING_SECS};
pub use gaze::AT_LISTENER_RAD;
pub use manner::{Manner, PlanBasis};
pub use raise::HEAD_RAISE_RAD;

/// Largest valid time, seconds: thirty years, at which a double still resolves microseconds.
const MAX_TIME_SECS: f64 = 1e9;
/// Contraction of the frontalis in thought, and of corrugator and procerus. Designed.
const THOUGHT_BROWS: f64 = 0.5;
const FROWN: [f64; 2] = [0.45, 0.25];
/// Tilt of the head to the right while it is raised in thought, radians (figure 4.2).
const THOUGHT_TILT_RAD: f64 = 0.035;
/// Share of the medial frontalis where the lateral one is raised. Designed.
const MEDIAL: f64 = 0.85;
/// Tongue and ring of the mouth while the lips are moistened. Designed.
const LICK: [f64; 2] = [0.6, 0.2];
/// Time before and after a speaker's turn in which the gaze is planned with it, seconds.
const AROUND_TURN_SECS: [f64; 2] = [0.6, 1.5];

/// Deviation of the gaze from a straight look at the listener, for eyes and head: yaw (left) and
/// pitch (down), radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GazeAversion {
    /// The eyes in all: yaw (left) and pitch (down), radians.
    pub eyes: [f64; 2],
    /// The head's part in it.
    pub head: [f64; 2],
}

/// Movements of head and body that accompany speech.
#[derive(Clone, Debug, Default)]
pub(crate) struct SpeechMotion {
    pub(crate) head: HeadGestures,
    /// Filling of the lungs, −1 (exhaled) to 1.6 (a deep breath).
    pub(crate) lungs: SuperposedTrack<1>,
    /// Start times of accented syllables, ascending, seconds.
    pub(crate) accents: Vec<f64>,
}

/// Non-verbal signals of one figure over a story: head and brow raises, gaze, blinks, thinking, lip
/// moistening and loudness.
#[derive(Clone, Debug)]
pub struct NonVerbal {
    raises: Raises,
    /// Brows while thinking: 1 raised, −1 drawn together.
    thought: Track,
    lick: Track,
    loudness: Track,
    gaze: Gaze,
    listening: ListenerGaze,
    blinks: Blinks,
}

impl NonVerbal {
    /// Plans everything for utterances in any order. The same seed gives the same plan, a different
    /// seed another. Utterances with invalid times are skipped.
    #[must_use]
    pub fn new(speech: &[TimedUtterance], seed: u64, manner: &Manner) -> Self {
        Self::in_discourse(speech, (&Discourse::default(), &[]), seed, manner).0
    }

    /// Plans everything for utterances and the discourse structure, with looks at places, sorted
    /// by time; and the movements of head and body that accompany them.
    pub(crate) fn in_discourse(
        speech: &[TimedUtterance],
        (discourse, looks): (&Discourse, &[PlacedLook]),
        seed: u64,
        manner: &Manner,
    ) -> (Self, SpeechMotion) {
        let manner = manner.in_range();
        let fits = |u: &&TimedUtterance| u.start_secs.abs() < MAX_TIME_SECS;
        let mut utterances: Vec<&TimedUtterance> = speech.iter().filter(fits).collect();
        sort_by_number(&mut utterances, |u| u.start_secs);
        let heard = SpeechFeatures::new(&utterances, &manner, seed);
        let loudness = loudness::track(&utterances);
        // The text does not specify its loudness, which the mouth needs.
        let unknown = loudness::track(&[]);
        let by_sound = match manner.basis {
            PlanBasis::Audio => &loudness,
            PlanBasis::Text => &unknown,
        };
        let thoughts = think::thoughts(&heard, &manner, seed);
        let [before, after] = AROUND_TURN_SECS;
        let turns = heard
            .turns
            .iter()
            .map(|[start, _, end]| [start - before, end + after]);
        let motion = SpeechMotion {
            head: HeadGestures::new(&heard, discourse, &manner, seed),
            lungs: lungs::track(&heard),
            accents: heard.stresses.iter().map(|s| s.start_secs).collect(),
        };
        let plan = Self {
            raises: Raises::new(&heard, by_sound, &manner, seed),
            thought: think::brows(&thoughts),
            lick: think::licks(&heard, &thoughts, &manner, seed),
            gaze: Gaze::new(&heard, (&thoughts, looks), discourse, &manner, seed),
            listening: ListenerGaze::new(turns.collect(), manner.gaze, seed),
            blinks: Blinks::new(&heard, manner.blinks, seed),
            loudness,
        };
        (plan, motion)
    }

    /// Adds to the controls of a face at a time: brows raised or drawn together, lips moistened.
    /// `liveliness` scales it, 1 as planned.
    pub fn face(&self, time_secs: f64, liveliness: f64, face: &mut FaceControls) {
        use Muscle as M;
        let time_secs = possible(time_secs);
        let mut add = |muscle: M, contraction: f64| face.contraction[muscle.index()] += contraction;
        let thought = liveliness * self.thought.sample(time_secs);
        let [left, right] = self
            .raises
            .brows
            .each_ref()
            .map(|brow| (liveliness * brow.sample(time_secs)).max(THOUGHT_BROWS * thought));
        add(M::FrontalisLateralLeft, left);
        add(M::FrontalisLateralRight, right);
        add(M::FrontalisMedialLeft, MEDIAL * left);
        add(M::FrontalisMedialRight, MEDIAL * right);
        let frown = (-thought).max(0.0);
        add(M::CorrugatorLeft, FROWN[0] * frown);
        add(M::CorrugatorRight, FROWN[0] * frown);
        add(M::Procerus, FROWN[1] * frown);
        let lick = self.lick(time_secs);
        add(M::OrbicularisOrisUpper, LICK[1] * lick);
        add(M::OrbicularisOrisLower, LICK[1] * lick);
        face.tongue_out += LICK[0] * lick;
    }

    /// Returns the progress of moistening the lips at a time, 0 to 1.
    #[must_use]
    pub fn lick(&self, time_secs: f64) -> f64 {
        self.lick.sample(possible(time_secs))
    }

    /// Returns the closure of the lids by a blink at a time, 0 to 1.
    #[must_use]
    pub fn closure(&self, time_secs: f64) -> f64 {
        self.blinks.closure(possible(time_secs))
    }

    /// Returns the head rotation from pitch and thought at a time: pitch (positive down, never
    /// beyond [`HEAD_RAISE_RAD`]), yaw and roll (positive to the left), radians. `liveliness`
    /// scales it; 1 as planned.
    #[must_use]
    pub fn head(&self, time_secs: f64, liveliness: f64) -> [f64; 3] {
        let time_secs = possible(time_secs);
        let raise = (liveliness * self.raises.head.sample(time_secs)).min(HEAD_RAISE_RAD);
        let tilt = liveliness * self.raises.tilt.sample(time_secs);
        let thought = liveliness * self.thought.sample(time_secs).abs();
        [-raise, 0.5 * tilt, tilt - THOUGHT_TILT_RAD * thought]
    }

    /// Returns the deviation of the gaze from the listener at a time.
    #[must_use]
    pub fn gaze(&self, time_secs: f64) -> GazeAversion {
        let time_secs = possible(time_secs);
        let [eyes, head] = [&self.gaze.eyes, &self.gaze.head]
            .map(|tracks| tracks.each_ref().map(|track| track.sample(time_secs)));
        let other = self.listening.aversion(time_secs);
        GazeAversion {
            eyes: [eyes[0] + other[0], eyes[1] + other[1]],
            head,
        }
    }

    /// Returns the relative loudness of the speech around a time: 0 the quietest, 1 the loudest,
    /// and [`ORDINARY_LOUDNESS`](crate::articulation::ORDINARY_LOUDNESS) the mean, also where it is
    /// unknown.
    #[must_use]
    pub fn loudness(&self, time_secs: f64) -> f64 {
        self.loudness.sample(possible(time_secs))
    }
}

/// Returns a time if it is finite and in range; otherwise 0.
fn possible(time_secs: f64) -> f64 {
    if time_secs.abs() < MAX_TIME_SECS {
        time_secs
    } else {
        0.0
    }
}
