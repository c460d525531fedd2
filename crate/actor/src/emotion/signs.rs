//! Emotional signs other than muscles: blood in the skin, gaze, head, breath and the amount of
//! motion (F&H section 4.4.4).

use raconteur_base::{DVec3, Length};
use raconteur_speech::emotion::{self, EmotionPoint};

use super::blend::{Affect, EmotionSpace, nearness, vector};
use super::expression::compress;
use super::look::{self, BaseExpression};

/// Signs of an emotion other than facial muscles: blush, gaze, head, breathing and liveliness; all
/// 0 when calm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EmotionSigns {
    /// Change of the blood in the skin, −1 (pale) to 1 (flushed); 0 as usual.
    pub blush: f64,
    /// The gaze downwards, radians.
    pub gaze_down_rad: f64,
    /// The head bowed, radians.
    pub head_down_rad: f64,
    /// Turn of the head away from the addressee, to the figure's right, radians; the eyes stay on
    /// the addressee.
    pub head_turn_rad: f64,
    /// The head tilted to the figure's left, radians.
    pub head_tilt_rad: f64,
    /// Increase of the breathing rate, as a share.
    pub breath_rate: f64,
    /// Increase of the breathing depth, as a share.
    pub breath_depth: f64,
    /// Increase of movement, as a share.
    pub liveliness: f64,
}

/// Emotions whose signs are known, by their words, in percent and, for angles, hundredths of
/// a radian: blush, gaze down, head down, breath rate, breath depth, liveliness.
///
/// Blood: blushing in shame and anger, pallor in fear (Darwin 1872, The Expression of the Emotions
/// in Man and Animals, chapters 12 and 13). Head and gaze: bowed in shame and sadness, raised in
/// pride (Keltner 1995, doi:10.1037/0022-3514.68.3.441; Tracy & Robins 2004,
/// doi:10.1111/j.0956-7976.2004.01503008.x). Breathing: fast and deep in excitement, fast and
/// shallow in fear, slow in sadness (Boiten, Frijda & Wientjes 1994,
/// doi:10.1016/0167-8760(94)90027-2). Movement: reduced in sadness (F&H section 4.4.4). The amounts
/// are designed.
const KNOWN: [(&str, [i8; 6]); 8] = [
    ("joy", [25, 0, -3, 15, 10, 25]),
    ("surprise", [0, 0, -4, 10, 35, 35]),
    ("hate", [10, 3, -2, 5, -10, 10]),
    ("anger", [60, -1, 5, 35, 25, 45]),
    ("fear", [-60, 0, -3, 50, -30, -10]),
    ("sorry-for", [-10, 16, 10, -15, 5, -45]),
    ("shame", [80, 22, 14, 10, -15, -35]),
    ("pride", [10, -2, -8, -5, 20, 10]),
];

/// Angle of a bow of thanks, radians.
const BOW_RAD: f64 = 0.18;

/// Neutral signs.
const CALM: EmotionSigns = EmotionSigns {
    blush: 0.0,
    gaze_down_rad: 0.0,
    head_down_rad: 0.0,
    head_turn_rad: 0.0,
    head_tilt_rad: 0.0,
    breath_rate: 0.0,
    breath_depth: 0.0,
    liveliness: 0.0,
};

/// Returns the signs of a base expression of its own. Head and gaze of shame and pride follow the
/// sources of their expressions, in pride about 20°; in disliking and resentment the head turns
/// away while the eyes stay on the person; relief sighs. The amounts, and all others, are
/// *designed*.
fn of_look(look: BaseExpression) -> EmotionSigns {
    match look {
        BaseExpression::Basic(basic) => EmotionSigns::from_point(basic.place()),
        BaseExpression::Shame => EmotionSigns {
            blush: 0.8,
            gaze_down_rad: 0.33,
            head_down_rad: 0.26,
            head_turn_rad: 0.08,
            breath_rate: 0.1,
            breath_depth: -0.15,
            liveliness: -0.35,
            ..CALM
        },
        BaseExpression::Pride => EmotionSigns {
            blush: 0.1,
            head_down_rad: -0.34,
            breath_rate: -0.05,
            breath_depth: 0.2,
            liveliness: 0.1,
            ..CALM
        },
        BaseExpression::Disliking => EmotionSigns {
            head_down_rad: -0.08,
            head_turn_rad: 0.2,
            liveliness: -0.1,
            ..CALM
        },
        BaseExpression::Resentment => EmotionSigns {
            blush: 0.2,
            head_down_rad: 0.14,
            head_turn_rad: 0.08,
            head_tilt_rad: -0.04,
            breath_depth: 0.1,
            liveliness: -0.15,
            ..CALM
        },
        BaseExpression::Satisfaction => EmotionSigns {
            blush: 0.1,
            head_down_rad: 0.04,
            head_tilt_rad: 0.08,
            breath_rate: -0.15,
            breath_depth: 0.15,
            liveliness: -0.15,
            ..CALM
        },
        BaseExpression::Relief => EmotionSigns {
            head_down_rad: -0.06,
            breath_rate: -0.2,
            breath_depth: 0.6,
            liveliness: -0.2,
            ..CALM
        },
        BaseExpression::Love => EmotionSigns {
            blush: 0.25,
            head_down_rad: 0.05,
            head_tilt_rad: 0.14,
            breath_rate: 0.05,
            breath_depth: 0.15,
            ..CALM
        },
        BaseExpression::Kidding => EmotionSigns {
            blush: 0.05,
            head_down_rad: 0.04,
            head_tilt_rad: 0.12,
            breath_depth: 0.05,
            liveliness: 0.25,
            ..CALM
        },
        BaseExpression::Wink => CALM,
    }
}

impl EmotionSigns {
    /// Returns the signs of an emotion: those of its word's base expressions, where it shows these,
    /// else those of its place. Gratitude includes a bow (*designed*).
    #[must_use]
    pub fn from_affect(affect: Affect) -> Self {
        let word = affect.word.filter(|_| affect.space == EmotionSpace::Sphere);
        let mut signs = match word.and_then(look::of_word) {
            Some(looks) => {
                let mut signs = CALM;
                for (look, share) in looks {
                    signs.add(&of_look(*look), *share);
                }
                signs
            }
            None => Self::from_point(affect.place),
        };
        if word == Some("gratitude") {
            signs.head_down_rad = BOW_RAD;
        }
        signs
    }

    /// Returns the signs of a place: those of the known emotions near in direction, weighted by
    /// distance.
    #[must_use]
    pub fn from_point(place: EmotionPoint) -> Self {
        let sites: [DVec3; KNOWN.len()] =
            KNOWN.map(|(word, _)| vector(emotion::place(word).unwrap_or_default()));
        let mut near = [1.0; KNOWN.len()];
        nearness(vector(place), &sites, &mut near);
        let (sum, length) = (near.iter().sum::<f64>(), vector(place).magnitude());
        let mut signs = Self::default();
        if sum > 0.0 {
            for (i, (_, percent)) in KNOWN.iter().enumerate() {
                let factor = 0.01 * near[i] / sum * length / sites[i].magnitude();
                let [blush, gaze, head, rate, depth, lively] = percent.map(f64::from);
                let one = Self {
                    blush,
                    gaze_down_rad: gaze,
                    head_down_rad: head,
                    head_turn_rad: 0.0,
                    head_tilt_rad: 0.0,
                    breath_rate: rate,
                    breath_depth: depth,
                    liveliness: lively,
                };
                signs.add(&one, factor);
            }
        }
        signs
    }

    /// Adds other signs by a factor.
    pub(super) fn add(&mut self, other: &Self, factor: f64) {
        self.blush += factor * other.blush;
        self.gaze_down_rad += factor * other.gaze_down_rad;
        self.head_down_rad += factor * other.head_down_rad;
        self.head_turn_rad += factor * other.head_turn_rad;
        self.head_tilt_rad += factor * other.head_tilt_rad;
        self.breath_rate += factor * other.breath_rate;
        self.breath_depth += factor * other.breath_depth;
        self.liveliness += factor * other.liveliness;
    }

    /// Returns the signs scaled by a factor, limited to what people show.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let mut scaled = CALM;
        scaled.add(self, factor);
        scaled.limited()
    }

    /// Returns the turn of the head: yaw to the figure's left, pitch down, roll to the left,
    /// radians.
    #[must_use]
    pub fn head(&self) -> [f64; 3] {
        [-self.head_turn_rad, self.head_down_rad, self.head_tilt_rad]
    }

    /// Returns the signs limited to what people show: each grows monotonically with the emotion,
    /// but ever less near its limit.
    pub(super) fn limited(self) -> Self {
        let to = |sign: f64, least: f64, most: f64| {
            let end: f64 = if sign < 0.0 { least } else { most };
            let (share, end) = (sign / end.abs(), end.abs());
            let shown = compress(share);
            if shown == share { sign } else { end * shown }
        };
        Self {
            blush: to(self.blush, -1.0, 1.0),
            gaze_down_rad: to(self.gaze_down_rad, -0.15, 0.45),
            head_down_rad: to(self.head_down_rad, -0.45, 0.4),
            head_turn_rad: to(self.head_turn_rad, -0.4, 0.4),
            head_tilt_rad: to(self.head_tilt_rad, -0.2, 0.2),
            breath_rate: to(self.breath_rate, -0.3, 0.8),
            breath_depth: to(self.breath_depth, -0.5, 0.8),
            liveliness: to(self.liveliness, -0.6, 0.8),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signs_of_word(word: &str) -> EmotionSigns {
        EmotionSigns::from_point(emotion::place(word).expect(word))
    }

    fn felt(word: &str) -> EmotionSigns {
        EmotionSigns::from_affect(Affect::named(word).expect(word))
    }

    #[test]
    fn known_emotions_have_their_own_signs() {
        for (word, percent) in KNOWN {
            let signs = signs_of_word(word);
            assert!(
                (signs.blush - 0.01 * f64::from(percent[0])).abs() < 1e-9,
                "{word}"
            );
            assert!(
                (signs.head_down_rad - 0.01 * f64::from(percent[2])).abs() < 1e-9,
                "{word}"
            );
            assert_eq!(signs, signs.limited(), "{word}");
        }
        assert_eq!(
            EmotionSigns::from_point(EmotionPoint::default()),
            EmotionSigns::default()
        );
    }

    #[test]
    fn shame_blushes_fear_pales_sadness_looks_down_pride_raises_the_head() {
        assert!(
            signs_of_word("shame").blush > 0.5
                && signs_of_word("joy").blush > 0.1
                && signs_of_word("anger").blush > 0.3,
            "shame, joy and anger blush"
        );
        assert!(signs_of_word("fear").blush < -0.3, "fear pales");
        assert!(
            signs_of_word("sorry-for").gaze_down_rad > 0.1
                && signs_of_word("fears-confirmed").gaze_down_rad > 0.1,
            "sorry-for and fears-confirmed lower the gaze"
        );
        assert!(
            felt("pride").head_down_rad < -0.3 && felt("remorse").head_down_rad > 0.1,
            "pride raises and remorse lowers the head"
        );
        assert!(
            felt("shame").gaze_down_rad > 0.3 && felt("shame").head_down_rad > 0.2,
            "shame lowers the gaze and the head"
        );
        assert!(
            felt("panic").blush < signs_of_word("fear").blush
                && felt("anxiety").blush > signs_of_word("fear").blush,
            "panic pales more and anxiety less than fear"
        );
        assert!(
            signs_of_word("distress").liveliness < -0.3 && signs_of_word("anger").liveliness > 0.3,
            "distress slows and anger enlivens"
        );
    }
}
