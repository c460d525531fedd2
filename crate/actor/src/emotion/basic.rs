//! The six basic expressions (Ekman; F&H section 4.4.3).
//!
//! The selection of muscles follows the prototypes of the Facial Action Coding System (Ekman &
//! Friesen 1978, Facial Action Coding System, Consulting Psychologists Press; Ekman, Friesen &
//! Hager 2002, FACS Investigator's Guide, chapter 12) and of EMFACS (Friesen & Ekman 1983,
//! unpublished manual, University of California, San Francisco). Each action unit (AU) uses the
//! muscles that the FACS manual specifies for it. The contractions are *designed*: about those of a
//! strong, not an extreme display, which leaves room for stronger ones.

use raconteur_body::face::Muscle as M;
use raconteur_speech::emotion::EmotionPoint;

use crate::parameters::FaceControl;

/// Number of basic emotions (Ekman; F&H section 4.4.3).
pub const BASICS: usize = 6;

/// Basic emotion (Ekman), ordered by its angle on the activation-evaluation disc (F&H section 4.4).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub enum BasicEmotion {
    /// F&H's joy.
    Joy,
    /// Full activation and no other component (F&H section 4.4.3).
    Surprise,
    /// F&H's hate.
    Disgust,
    /// F&H's anger.
    Anger,
    /// F&H's fear.
    Fear,
    /// F&H's sorry-for.
    Sadness,
}

/// Contribution of an expression to one face control, percent. Values of the left side apply to the
/// right as well.
pub(super) type Share = (FaceControl, i8);

pub(super) const fn m(muscle: M, percent: i8) -> Share {
    (FaceControl::from_muscle(muscle), percent)
}

/// AU 6, 12 and a little 25 and 26.
const JOY: &[Share] = &[
    m(M::ZygomaticusMajorLeft, 80),
    m(M::ZygomaticusMinorLeft, 30),
    m(M::LevatorAnguliLeft, 35),
    m(M::LevatorLabiiLeft, 25),
    m(M::OrbicularisOculiLeft, 85),
    (FaceControl::LOWER_LID_LEFT, 60),
    (FaceControl::JAW, 10),
];

/// AU 1, 2, 5, 26.
const SURPRISE: &[Share] = &[
    m(M::FrontalisMedialLeft, 95),
    m(M::FrontalisLateralLeft, 95),
    (FaceControl::UPPER_LID_LEFT, -95),
    (FaceControl::JAW, 55),
];

/// AU 9, 10, 17 with 4 and 7, which accompany a wrinkled nose, and a little 15.
const DISGUST: &[Share] = &[
    m(M::LevatorLabiiAlaequeLeft, 90),
    m(M::LevatorLabiiLeft, 45),
    m(M::ZygomaticusMinorLeft, 10),
    m(M::NasalisLeft, 60),
    m(M::Procerus, 75),
    m(M::CorrugatorLeft, 40),
    m(M::DepressorSuperciliiLeft, 50),
    m(M::OrbicularisOculiLeft, 50),
    m(M::MentalisLeft, 20),
    m(M::DepressorAnguliLeft, 20),
    (FaceControl::LOWER_LID_LEFT, 35),
    (FaceControl::UPPER_LID_LEFT, 10),
];

/// AU 4, 5, 7, 23, 24 with a little 17 and 38, jaw forwards (AU 29).
const ANGER: &[Share] = &[
    m(M::CorrugatorLeft, 95),
    m(M::DepressorSuperciliiLeft, 95),
    m(M::Procerus, 75),
    m(M::OrbicularisOculiLeft, 35),
    m(M::OrbicularisOrisUpper, 14),
    m(M::OrbicularisOrisLower, 16),
    m(M::DepressorAnguliLeft, 22),
    m(M::MentalisLeft, 35),
    m(M::NasalisLeft, 25),
    m(M::LevatorLabiiAlaequeLeft, 8),
    (FaceControl::LIP_PROTRUSION_UPPER, -80),
    (FaceControl::LIP_PROTRUSION_LOWER, -80),
    (FaceControl::LOWER_LID_LEFT, 60),
    (FaceControl::UPPER_LID_LEFT, -35),
    (FaceControl::JAW_FORWARD, 25),
];

/// AU 1, 2, 4, 5, 20, 26, the lips slightly parted (AU 25).
const FEAR: &[Share] = &[
    m(M::FrontalisMedialLeft, 90),
    m(M::FrontalisLateralLeft, 35),
    m(M::CorrugatorLeft, 50),
    m(M::RisoriusLeft, 65),
    m(M::PlatysmaLeft, 45),
    m(M::BuccinatorLeft, 15),
    m(M::DepressorLabiiLeft, 30),
    (FaceControl::UPPER_LID_LEFT, -90),
    (FaceControl::LOWER_LID_LEFT, 45),
    (FaceControl::JAW, 18),
];

/// AU 1, 4, 15, 17 with a little 6, the lids low.
const SADNESS: &[Share] = &[
    m(M::FrontalisMedialLeft, 90),
    m(M::CorrugatorLeft, 50),
    m(M::DepressorAnguliLeft, 60),
    m(M::MentalisLeft, 65),
    m(M::OrbicularisOculiLeft, 12),
    (FaceControl::UPPER_LID_LEFT, 25),
    (FaceControl::LOWER_LID_LEFT, 10),
];

impl BasicEmotion {
    /// All basic emotions, ordered by their angle on the disc of activation and evaluation.
    pub const ALL: [Self; BASICS] = [
        Self::Joy,
        Self::Surprise,
        Self::Disgust,
        Self::Anger,
        Self::Fear,
        Self::Sadness,
    ];

    /// Returns the closest word in the emotion table of F&H (section 4.4.3).
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Joy => "joy",
            Self::Surprise => "surprise",
            Self::Disgust => "hate",
            Self::Anger => "anger",
            Self::Fear => "fear",
            Self::Sadness => "sorry-for",
        }
    }

    /// Returns its place in the emotion space: the place of its word (F&H table 4.4).
    #[must_use]
    pub fn place(self) -> EmotionPoint {
        raconteur_speech::emotion::place(self.word()).unwrap_or_default()
    }

    /// Returns the controls in its expression at its place, in percent, on both sides.
    pub(super) fn shares(self) -> &'static [Share] {
        match self {
            Self::Joy => JOY,
            Self::Surprise => SURPRISE,
            Self::Disgust => DISGUST,
            Self::Anger => ANGER,
            Self::Fear => FEAR,
            Self::Sadness => SADNESS,
        }
    }
}
