//! Facial behaviour apart from lips and idle life: accompaniment of speech, emotions and control
//! parameters.

use raconteur_base::order::sort_by_number;
use raconteur_base::{DVec3, noise};
use raconteur_body::face::FaceControls;
use raconteur_speech::emotion::EmotionPoint;

use crate::discourse::Discourse;
use crate::emotion::{Breathing, EmotionTrack};
use crate::idle::gaze::angles_of;
use crate::idle::stream;
use crate::lips::MouthTargets;
use crate::nonverbal::{GazeAversion, Manner, NonVerbal, PlacedLook, SpeechMotion};
use crate::parameters::ParameterTrack;
use crate::performance::Performance;

/// Face and head motion of one performance in addition to lips and idle motion: speech signals,
/// emotions and control parameters. Evaluation is a function of time.
#[derive(Clone, Debug)]
pub(crate) struct FacialBehaviour {
    nonverbal: NonVerbal,
    motion: SpeechMotion,
    emotions: EmotionTrack,
    parameters: ParameterTrack,
}

/// Head rotation from speech and emotion, radians.
pub(crate) struct HeadMotion {
    /// Down, to the left side, to the left about the vertical.
    pub(crate) pitch: f64,
    pub(crate) roll: f64,
    pub(crate) yaw: f64,
}

impl FacialBehaviour {
    /// Plans the behaviour that accompanies speech in a manner, and prepares the rest.
    /// The eyes are at `eyes_in_figure`, metres, in the zero pose.
    pub(crate) fn new(
        performance: &Performance,
        discourse: &Discourse,
        manner: &Manner,
        eyes_in_figure: DVec3,
    ) -> Self {
        let library = |name: &str| performance.library.parameters(name);
        let parameters = ParameterTrack::new(&performance.parameters, &library);
        let seed = performance.seed;
        let looks = looks(
            discourse,
            performance.listener_in_world - eyes_in_figure,
            eyes_in_figure,
            seed,
        );
        let (nonverbal, motion) =
            NonVerbal::in_discourse(&performance.speech, (discourse, &looks), seed, manner);
        Self {
            nonverbal,
            motion,
            emotions: EmotionTrack::new(&performance.emotions, parameters.emotions()),
            parameters,
        }
    }

    /// Returns the relative loudness of speech, see [`NonVerbal::loudness`].
    pub(crate) fn loudness(&self, t: f64) -> f64 {
        self.nonverbal.loudness(t)
    }

    /// Adds to the controls of a face.
    pub(crate) fn add(&self, t: f64, controls: &mut FaceControls) {
        let liveliness = self.emotions.liveliness(t);
        self.nonverbal.face(t, liveliness, controls);
        self.emotions.add(t, controls);
        self.parameters.add(t, controls);
    }

    /// Returns the closure of the lids by a blink, 0 to 1, see [`NonVerbal::closure`].
    pub(crate) fn closure(&self, t: f64) -> f64 {
        self.nonverbal.closure(t)
    }

    /// Returns the strength of emotion, 0 (calm) to 1, see [`EmotionTrack::strength`].
    pub(crate) fn strength(&self, t: f64) -> f64 {
        self.emotions.strength(t)
    }

    /// Returns the emotional activation, 0 (calm or passive) to 1.
    pub(crate) fn arousal(&self, t: f64) -> f64 {
        (self.emotions.sample(t).activation / 100.0).clamp(0.0, 1.0)
    }

    /// Returns the emotion, see [`EmotionTrack::sample`].
    pub(crate) fn affect(&self, t: f64) -> EmotionPoint {
        self.emotions.sample(t)
    }

    /// Returns the start times of accented syllables, ascending, seconds.
    pub(crate) fn accents(&self) -> &[f64] {
        &self.motion.accents
    }

    /// Returns the filling of the lungs with speech at a time, −1 (exhaled) to 1.6 (a deep breath).
    pub(crate) fn lungs(&self, t: f64) -> f64 {
        self.motion.lungs.sample(t)[0]
    }

    /// Returns the state of breathing, see [`EmotionTrack::breath`].
    pub(crate) fn breath(&self, t: f64) -> Breathing {
        self.emotions.breath(t)
    }

    /// Rotations of the head.
    pub(crate) fn head(&self, t: f64) -> HeadMotion {
        let GazeAversion { head: aside, .. } = self.nonverbal.gaze(t);
        let felt = self.emotions.head(t);
        let liveliness = self.emotions.liveliness(t);
        let [raise, turn, tilt] = self.nonverbal.head(t, liveliness);
        let [pitch, yaw, roll] = self.motion.head.sample(t, liveliness);
        HeadMotion {
            pitch: aside[1] + raise + pitch + felt[1],
            roll: tilt + roll + felt[2],
            yaw: aside[0] + turn + yaw + felt[0],
        }
    }

    /// Returns the turn of the eyes away from the listener: to the left and up, radians.
    pub(crate) fn eyes(&self, t: f64) -> [f64; 2] {
        let (felt, asked) = (self.emotions.gaze(t), self.parameters.gaze(t));
        let looked = self.nonverbal.gaze(t).eyes;
        [0, 1].map(|k| looked[k] + felt[k] + asked[k])
    }

    /// Returns the mouth targets of the visemes set by the script, see [`ParameterTrack::visemes`].
    pub(crate) fn visemes(&self, t: f64) -> Option<MouthTargets> {
        self.parameters.visemes(t)
    }
}

/// Direction of the look to the side of a character: yaw for side 1, and pitch, radians. Designed.
const ROLE_LOOK_RAD: [f64; 2] = [0.42, 0.02];
/// Shortest look to that side, and what chance adds, seconds; the same for the looks at the listener
/// between two of them. Designed.
const ROLE_LOOK_SECS: [f64; 2] = [1.0, 0.9];
const ROLE_BACK_SECS: [f64; 2] = [0.5, 0.4];
/// Largest number of looks in the speech of one character without the narrator.
const MAX_ROLE_LOOKS: usize = 100;
/// Time before a mention at which the look begins, and its shortest length, seconds. Designed.
const MENTION_LEAD_SECS: f64 = 0.2;
const MENTION_SECS: f64 = 0.75;
/// Largest direction of a look at a referent from the listener, yaw and pitch, radians.
const MAX_LOOK_RAD: [f64; 2] = [0.85, 0.35];

/// Returns the looks at referents and to the sides of characters, sorted by time. The listener is
/// at `listener` from the eyes.
fn looks(discourse: &Discourse, listener: DVec3, eyes: DVec3, seed: u64) -> Vec<PlacedLook> {
    let straight = angles_of(listener);
    let mut looks: Vec<PlacedLook> = discourse
        .mentions
        .iter()
        .map(|mention| {
            let to = angles_of(mention.place_in_figure - eyes);
            let start_secs = mention.start_secs - MENTION_LEAD_SECS;
            PlacedLook {
                start_secs,
                end_secs: mention
                    .end_secs
                    .clamp(start_secs + MENTION_SECS, start_secs + 2.0),
                direction_rad: [0, 1]
                    .map(|k| (to[k] - straight[k]).clamp(-MAX_LOOK_RAD[k], MAX_LOOK_RAD[k])),
            }
        })
        .collect();
    for role in &discourse.roles {
        let mut start_secs = role.start_secs - 0.15;
        for _ in 0..MAX_ROLE_LOOKS {
            if start_secs >= role.end_secs {
                break;
            }
            let bucket = (1e3 * start_secs).round() as i64;
            let r = |id: u64| noise::unit(seed, stream::GAZE + 8 + id, bucket);
            let end_secs = start_secs + ROLE_LOOK_SECS[0] + ROLE_LOOK_SECS[1] * r(0);
            looks.push(PlacedLook {
                start_secs,
                end_secs: end_secs.min(role.end_secs),
                direction_rad: [role.side * ROLE_LOOK_RAD[0], ROLE_LOOK_RAD[1]],
            });
            start_secs = end_secs + ROLE_BACK_SECS[0] + ROLE_BACK_SECS[1] * r(1);
        }
    }
    sort_by_number(&mut looks, |look| look.start_secs);
    looks
}
