//! Facial behaviour apart from lips and idle life: accompaniment of speech, emotions and control
//! parameters.

use raconteur_body::face::FaceControls;

use crate::emotion::{Breathing, EmotionTrack};
use crate::lips::MouthTargets;
use crate::nonverbal::{GazeAversion, Manner, NonVerbal};
use crate::parameters::ParameterTrack;
use crate::performance::Performance;

/// Face and head motion of one performance in addition to lips and idle motion: speech signals,
/// emotions and control parameters. Evaluation is a function of time.
#[derive(Clone, Debug)]
pub(crate) struct FacialBehaviour {
    nonverbal: NonVerbal,
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
    pub(crate) fn new(performance: &Performance, manner: &Manner) -> Self {
        let library = |name: &str| performance.library.parameters(name);
        let parameters = ParameterTrack::new(&performance.parameters, &library);
        Self {
            nonverbal: NonVerbal::new(&performance.speech, performance.seed, manner),
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

    /// Returns the state of breathing, see [`EmotionTrack::breath`].
    pub(crate) fn breath(&self, t: f64) -> Breathing {
        self.emotions.breath(t)
    }

    /// Rotations of the head.
    pub(crate) fn head(&self, t: f64) -> HeadMotion {
        let GazeAversion { head: aside, .. } = self.nonverbal.gaze(t);
        let felt = self.emotions.head(t);
        let [nod, turn, tilt] = self.nonverbal.head(t, self.emotions.liveliness(t));
        HeadMotion {
            pitch: aside[1] + nod + felt[1],
            roll: tilt + felt[2],
            yaw: aside[0] + turn + felt[0],
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
