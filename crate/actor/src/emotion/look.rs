//! Own expressions of words whose known display exceeds a blend of the six basic expressions.
//!
//! Each entry gives the source of its action units and of its head and gaze directions. The
//! contractions are *designed*, as for the six basic expressions: a clear, not an extreme display.

use raconteur_body::face::Muscle as M;

use super::basic::{BASICS, BasicEmotion, Share, m};
use crate::parameters::FaceControl;

/// Number of base expressions: six of basic emotions, nine of single words.
pub const BASE_EXPRESSIONS: usize = BASICS + 9;

/// Base expression from which facial expressions are blended: of a basic emotion, or specific to
/// one emotion word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BaseExpression {
    /// Expression of one of the six basic emotions.
    Basic(BasicEmotion),
    /// Ashamed.
    Shame,
    /// Proud.
    Pride,
    /// Repelled by somebody or something.
    Disliking,
    /// Grudging.
    Resentment,
    /// Content.
    Satisfaction,
    /// Relieved.
    Relief,
    /// Tender.
    Love,
    /// Joking.
    Kidding,
    /// One eye closed, with the cheek raised to it; it accompanies kidding briefly.
    Wink,
}

/// Head and gaze go down (AU 54, 64) without a smile: Keltner 1995, doi:10.1037/0022-3514.68.3.441.
/// Pressed lips (AU 24) with lowered corners belong to the same display when restrained: Keltner &
/// Buswell 1996, doi:10.1080/026999396380312.
const SHAME: &[Share] = &[
    m(M::FrontalisMedialLeft, 55),
    m(M::CorrugatorLeft, 35),
    m(M::OrbicularisOrisUpper, 12),
    m(M::OrbicularisOrisLower, 14),
    (FaceControl::LIP_PROTRUSION_UPPER, -65),
    (FaceControl::LIP_PROTRUSION_LOWER, -65),
    m(M::DepressorAnguliLeft, 35),
    m(M::MentalisLeft, 35),
    (FaceControl::UPPER_LID_LEFT, 35),
];

/// A small smile (AU 12 without 6) with the head tilted back: Tracy & Robins 2004,
/// doi:10.1111/j.0956-7976.2004.01503008.x; 2007, doi:10.1037/1528-3542.7.4.789. The lids are
/// slightly lowered, because the gaze goes down at others.
const PRIDE: &[Share] = &[
    m(M::ZygomaticusMajorLeft, 42),
    m(M::LevatorAnguliLeft, 25),
    m(M::BuccinatorLeft, 25),
    m(M::FrontalisLateralLeft, 30),
    (FaceControl::UPPER_LID_LEFT, 22),
    (FaceControl::LOWER_LID_LEFT, 15),
];

/// The upper lip raised (AU 10), the face of disgust shown towards persons and their acts: Rozin,
/// Lowery & Ebert 1994, doi:10.1037/0022-3514.66.5.870; more on one side, as in contempt (Ekman &
/// Friesen 1986, doi:10.1007/BF00992253), with AU 15 and the head drawn away.
const DISLIKING: &[Share] = &[
    m(M::CorrugatorLeft, 35),
    m(M::DepressorSuperciliiLeft, 30),
    m(M::DepressorAnguliLeft, 50),
    m(M::MentalisLeft, 30),
    m(M::OrbicularisOculiLeft, 15),
    (FaceControl::UPPER_LID_LEFT, 18),
    (FaceControl::LOWER_LID_LEFT, 30),
];
const DISLIKING_RIGHT: &[Share] = &[
    m(M::LevatorLabiiRight, 38),
    m(M::LevatorLabiiAlaequeRight, 30),
    m(M::ZygomaticusMinorRight, 20),
    m(M::NasalisRight, 20),
];

/// One corner of the mouth tightened (AU 14), as in contempt (Ekman & Friesen 1986,
/// doi:10.1007/BF00992253; Matsumoto & Ekman 2004, doi:10.1037/0022-3514.87.4.529), with the
/// lowered brows, narrow lids and pressed lips (AU 4, 7, 24) of suppressed anger.
const RESENTMENT: &[Share] = &[
    m(M::CorrugatorLeft, 75),
    m(M::DepressorSuperciliiLeft, 80),
    m(M::OrbicularisOrisUpper, 12),
    m(M::OrbicularisOrisLower, 14),
    (FaceControl::LIP_PROTRUSION_UPPER, -65),
    (FaceControl::LIP_PROTRUSION_LOWER, -65),
    m(M::MentalisLeft, 25),
    m(M::OrbicularisOculiLeft, 20),
    (FaceControl::LOWER_LID_LEFT, 55),
    (FaceControl::UPPER_LID_LEFT, 22),
];
const RESENTMENT_RIGHT: &[Share] = &[
    m(M::BuccinatorRight, 90),
    m(M::LevatorAnguliRight, 40),
    m(M::ZygomaticusMajorRight, 15),
];

/// A slight smile under lowered lids (AU 12, 43): Cordaro et al. 2018, doi:10.1037/emo0000302
/// (contentment).
const SATISFACTION: &[Share] = &[
    m(M::ZygomaticusMajorLeft, 45),
    m(M::OrbicularisOculiLeft, 25),
    m(M::OrbicularisOrisLower, 15),
    (FaceControl::UPPER_LID_LEFT, 50),
    (FaceControl::LOWER_LID_LEFT, 20),
];

/// A sigh, which marks relief (Vlemincx et al. 2009, doi:10.1111/j.1469-8986.2009.00842.x). There
/// is no agreed prototype of its face; *designed*: lids nearly closed, brows relaxed upwards,
/// breath through parted lips (AU 43, 1, 25, 26), a weak smile.
const RELIEF: &[Share] = &[
    m(M::FrontalisMedialLeft, 50),
    m(M::FrontalisLateralLeft, 20),
    m(M::ZygomaticusMajorLeft, 25),
    (FaceControl::UPPER_LID_LEFT, 65),
    (FaceControl::JAW, 24),
    (FaceControl::LIP_PROTRUSION_LOWER, 20),
];

/// A genuine smile (AU 6, 12) with the head inclined to the other person: Gonzaga et al. 2001,
/// doi:10.1037/0022-3514.81.2.247. Raised inner brows and soft lids are *designed*.
const LOVE: &[Share] = &[
    m(M::ZygomaticusMajorLeft, 55),
    m(M::OrbicularisOculiLeft, 40),
    m(M::FrontalisMedialLeft, 45),
    (FaceControl::UPPER_LID_LEFT, 22),
    (FaceControl::LOWER_LID_LEFT, 25),
];

/// A smile that is stronger on the side of the wink, one brow raised on the other. *Designed*:
/// F&H figure 4.7 shows it as a smile with a wink.
const KIDDING: &[Share] = &[
    m(M::ZygomaticusMajorLeft, 50),
    m(M::OrbicularisOculiLeft, 25),
    m(M::LevatorAnguliLeft, 15),
    (FaceControl::LOWER_LID_LEFT, 15),
];
const KIDDING_RIGHT: &[Share] = &[
    m(M::FrontalisLateralRight, 55),
    m(M::FrontalisMedialRight, 20),
];

/// AU 46 with AU 6 and 12 of its side. The left eye closes: two people in three look with the right
/// one (Bourassa, McManus & Bryden 1996, doi:10.1080/713754206), which stays on the addressee of
/// the wink.
const WINK_LEFT: &[Share] = &[
    m(M::OrbicularisOculiLeft, 60),
    m(M::ZygomaticusMajorLeft, 25),
    m(M::ZygomaticusMinorLeft, 30),
    m(M::DepressorSuperciliiLeft, 30),
    (FaceControl::UPPER_LID_LEFT, 100),
    (FaceControl::LOWER_LID_LEFT, 70),
];

impl BaseExpression {
    /// All base expressions, in the order of [`BaseExpression::index`].
    pub const ALL: [Self; BASE_EXPRESSIONS] = [
        Self::Basic(BasicEmotion::Joy),
        Self::Basic(BasicEmotion::Surprise),
        Self::Basic(BasicEmotion::Disgust),
        Self::Basic(BasicEmotion::Anger),
        Self::Basic(BasicEmotion::Fear),
        Self::Basic(BasicEmotion::Sadness),
        Self::Shame,
        Self::Pride,
        Self::Disliking,
        Self::Resentment,
        Self::Satisfaction,
        Self::Relief,
        Self::Love,
        Self::Kidding,
        Self::Wink,
    ];

    /// Returns its index among all base expressions; basic ones first, by [`BasicEmotion::ALL`].
    #[must_use]
    pub fn index(self) -> usize {
        Self::ALL.iter().position(|l| *l == self).unwrap_or(0)
    }

    /// Visits the controls that take part in it, in percent.
    pub(super) fn for_each_control(self, visit: &mut dyn FnMut(FaceControl, i8)) {
        let (both, one): (&[Share], &[Share]) = match self {
            Self::Basic(basic) => (basic.shares(), &[]),
            Self::Shame => (SHAME, &[]),
            Self::Pride => (PRIDE, &[]),
            Self::Disliking => (DISLIKING, DISLIKING_RIGHT),
            Self::Resentment => (RESENTMENT, RESENTMENT_RIGHT),
            Self::Satisfaction => (SATISFACTION, &[]),
            Self::Relief => (RELIEF, &[]),
            Self::Love => (LOVE, &[]),
            Self::Kidding => (KIDDING, KIDDING_RIGHT),
            Self::Wink => (&[], WINK_LEFT),
        };
        for (dial, percent) in both {
            visit(*dial, *percent);
            let right = dial.with_right_half();
            if right != *dial {
                visit(right, *percent);
            }
        }
        one.iter()
            .for_each(|(dial, percent)| visit(*dial, *percent));
    }
}

/// Returns the weight of each base expression in the emotion of a word at the strength of its
/// place; `None` for a word that has the expression of its place. The two that Ortony, Clore and
/// Collins (1988) compose of two others, gratification of pride and joy, remorse of shame and
/// distress, are half of each; gratitude, which they compose of admiration and joy, is joy with the
/// bow of thanks (see [`EmotionSigns`](super::EmotionSigns)). Liking is a weaker joy than its
/// place, shared with satisfaction, would imply (*designed*). Anxiety and panic are fear scaled by
/// the ratio of distances from the middle of the disc (F&H equation 4.7, figure 4.17).
pub(super) fn of_word(word: &str) -> Option<&'static [(BaseExpression, f64)]> {
    const FEAR: BaseExpression = BaseExpression::Basic(BasicEmotion::Fear);
    const JOY: BaseExpression = BaseExpression::Basic(BasicEmotion::Joy);
    const SADNESS: BaseExpression = BaseExpression::Basic(BasicEmotion::Sadness);
    Some(match word {
        "shame" => &[(BaseExpression::Shame, 1.0)],
        "pride" => &[(BaseExpression::Pride, 1.0)],
        "disliking" => &[(BaseExpression::Disliking, 1.0)],
        "resentment" => &[(BaseExpression::Resentment, 1.0)],
        "satisfaction" => &[(BaseExpression::Satisfaction, 1.0)],
        "relief" => &[(BaseExpression::Relief, 1.0)],
        "love" => &[(BaseExpression::Love, 1.0)],
        "liking" => &[(JOY, 0.6)],
        "kidding" => &[(BaseExpression::Kidding, 1.0), (BaseExpression::Wink, 1.0)],
        "gratification" => &[(BaseExpression::Pride, 0.5), (JOY, 0.5)],
        "remorse" => &[(BaseExpression::Shame, 0.5), (SADNESS, 0.5)],
        "anxiety" => &[(FEAR, 0.5)],
        "panic" => &[(FEAR, 2.0)],
        _ => return None,
    })
}
