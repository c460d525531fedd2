//! What emotions do besides the muscles: blood in the skin, gaze, head, breath, and how much
//! one moves at all (F&H section 4.4.4).

use raconteur_base::DVec3;
use raconteur_speech::emotion::{self, Place};

use super::blend::{nearness, vector};

/// Signs of an emotion; all 0 when one is calm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Signs {
    /// More (positive) or less blood in the skin than usual, −1 to 1.
    pub blush: f64,
    /// The gaze downwards, radians.
    pub gaze_down_rad: f64,
    /// The head bowed, radians.
    pub head_down_rad: f64,
    /// How much faster one breathes, as a share.
    pub breath_rate: f64,
    /// How much deeper, as a share.
    pub breath_depth: f64,
    /// How much more one moves, as a share.
    pub liveliness: f64,
}

/// Emotions whose signs are known, by their words, in percent and, for angles, hundredths of
/// a radian: blush, gaze down, head down, breath rate, breath depth, liveliness.
///
/// Blood: blushing in shame and anger, pallor in fear (Darwin 1872, The Expression of the
/// Emotions in Man and Animals, chapters 12 and 13). Head and gaze: bowed in shame and
/// sadness, raised in pride (Keltner 1995, doi:10.1037/0022-3514.68.3.441; Tracy & Robins
/// 2004, doi:10.1111/j.0956-7976.2004.01503008.x). Breath: fast and deep in excitement, fast
/// and shallow in fear, slow in sadness (Boiten, Frijda & Wientjes 1994,
/// doi:10.1016/0167-8760(94)90027-2). Movement: less in sadness (F&H section 4.4.4). The
/// amounts are designed.
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

impl Signs {
    /// Those of a place: of the known emotions that are near in direction, by distance.
    #[must_use]
    pub fn of(place: Place) -> Self {
        let sites: [DVec3; KNOWN.len()] =
            KNOWN.map(|(word, _)| vector(emotion::place(word).unwrap_or_default()));
        let mut near = [1.0; KNOWN.len()];
        nearness(vector(place), &sites, &mut near);
        let (sum, length) = (near.iter().sum::<f64>(), vector(place).length());
        let mut signs = Self::default();
        if sum > 0.0 {
            for (i, (_, percent)) in KNOWN.iter().enumerate() {
                let factor = 0.01 * near[i] / sum * length / sites[i].length();
                let [blush, gaze, head, rate, depth, lively] = percent.map(f64::from);
                let one = Self {
                    blush,
                    gaze_down_rad: gaze,
                    head_down_rad: head,
                    breath_rate: rate,
                    breath_depth: depth,
                    liveliness: lively,
                };
                signs.add(&one, factor);
            }
        }
        signs
    }

    /// Adds so much of others.
    pub(super) fn add(&mut self, other: &Self, factor: f64) {
        self.blush += factor * other.blush;
        self.gaze_down_rad += factor * other.gaze_down_rad;
        self.head_down_rad += factor * other.head_down_rad;
        self.breath_rate += factor * other.breath_rate;
        self.breath_depth += factor * other.breath_depth;
        self.liveliness += factor * other.liveliness;
    }

    /// The same where no sign is beyond what people show.
    pub(super) fn limited(self) -> Self {
        Self {
            blush: self.blush.clamp(-1.0, 1.0),
            gaze_down_rad: self.gaze_down_rad.clamp(-0.15, 0.35),
            head_down_rad: self.head_down_rad.clamp(-0.15, 0.25),
            breath_rate: self.breath_rate.clamp(-0.3, 0.8),
            breath_depth: self.breath_depth.clamp(-0.5, 0.8),
            liveliness: self.liveliness.clamp(-0.6, 0.8),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(word: &str) -> Signs {
        Signs::of(emotion::place(word).expect(word))
    }

    #[test]
    fn known_emotions_have_their_own_signs() {
        for (word, percent) in KNOWN {
            let signs = of(word);
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
        assert_eq!(Signs::of(Place::default()), Signs::default());
    }

    #[test]
    fn shame_blushes_fear_pales_sadness_looks_down_pride_raises_the_head() {
        assert!(of("shame").blush > 0.5 && of("joy").blush > 0.1 && of("anger").blush > 0.3);
        assert!(of("fear").blush < -0.3);
        assert!(of("sorry-for").gaze_down_rad > 0.1 && of("fears-confirmed").gaze_down_rad > 0.1);
        assert!(of("pride").head_down_rad < -0.05 && of("remorse").head_down_rad > 0.1);
        assert!(of("distress").liveliness < -0.3 && of("anger").liveliness > 0.3);
    }
}
