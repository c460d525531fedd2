//! Choice of rest postures by emotion and formality.

use raconteur_speech::emotion::EmotionPoint;

use super::RestPosture;

/// Seconds of use that the full liking for a posture outweighs. Designed.
const LIKING_SECS: f64 = 20.0;

/// Mood in which a posture is chosen: degrees of sorrow, anger, fear and joy, 0 to 1, and formality,
/// −1 (casual) to 1 (formal).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct RestMood {
    degrees: [f64; 5],
}

impl RestMood {
    /// Returns the mood for an emotion and a formality, 0 (casual) to 1 (formal).
    pub(crate) fn new(felt: &EmotionPoint, formality: f64) -> Self {
        let [active, good, strong] =
            [felt.activation, felt.evaluation, felt.power].map(|x| (x / 60.0).clamp(-1.0, 1.0));
        let [excited, passive] = [active.max(0.0), (-active).max(0.0)];
        let bad = (-good).max(0.0);
        Self {
            degrees: [
                passive * bad,
                excited * bad * strong.max(0.0),
                excited * bad * (-strong).max(0.0),
                good.max(0.0),
                2.0 * formality.clamp(0.0, 1.0) - 1.0,
            ],
        }
    }

    /// Returns the advantage of a posture, seconds of use that it makes up for.
    pub(super) fn liking_secs(&self, posture: RestPosture) -> f64 {
        let fit: f64 = fits(posture)
            .iter()
            .zip(self.degrees)
            .map(|(a, b)| a * b)
            .sum();
        LIKING_SECS * fit
    }
}

/// Returns how a posture fits sorrow, anger, fear, joy and formality, −1 to 1. Designed after
/// Wallbott 1998 (doi:10.1002/(SICI)1099-0992(1998110)28:6<879::AID-EJSP901>3.0.CO;2-W): the
/// sorrowful and the afraid close up and hold themselves, the angry and the proud take space.
fn fits(posture: RestPosture) -> [f64; 5] {
    match posture {
        RestPosture::Hanging => [0.6, 0.2, 0.0, 0.0, 0.3],
        RestPosture::Belly => [0.0, 0.0, 0.2, 0.3, 0.2],
        RestPosture::Clasped => [0.6, -0.5, 0.5, 0.2, 0.6],
        RestPosture::Fingertips => [-0.4, 0.2, -0.2, 0.3, 0.8],
        RestPosture::WristHeld => [0.7, -0.3, 0.7, 0.0, 0.3],
        RestPosture::OneOnHip => [-1.0, 0.9, -0.8, 0.5, -1.0],
        RestPosture::OneInPocket => [0.1, -0.4, -0.6, 0.2, -1.0],
        RestPosture::OneAtBelly => [0.3, 0.0, 0.3, 0.1, -0.2],
        RestPosture::Behind => [-0.3, -0.1, -0.8, -0.1, 0.9],
        RestPosture::Folded => [0.3, 0.8, 0.4, -0.6, -0.5],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the posture that a mood likes best.
    fn favourite([activation, evaluation, power]: [f64; 3], formality: f64) -> RestPosture {
        let felt = EmotionPoint {
            activation,
            evaluation,
            power,
        };
        let mood = RestMood::new(&felt, formality);
        let by_liking = |a: &RestPosture, b: &RestPosture| {
            mood.liking_secs(*a).total_cmp(&mood.liking_secs(*b))
        };
        RestPosture::ALL
            .into_iter()
            .max_by(by_liking)
            .expect("there are postures")
    }

    #[test]
    fn emotion_and_formality_choose() {
        assert_eq!(
            favourite([-60.0, -60.0, -40.0], 0.5),
            RestPosture::WristHeld,
            "sorrow"
        );
        assert_eq!(
            favourite([60.0, -60.0, 60.0], 0.5),
            RestPosture::OneOnHip,
            "anger"
        );
        assert_eq!(
            favourite([0.0; 3], 1.0),
            RestPosture::Behind,
            "formal speech"
        );
        let casual = RestMood::new(&EmotionPoint::default(), 0.0);
        assert!(
            casual.liking_secs(RestPosture::OneInPocket) > casual.liking_secs(RestPosture::Behind),
            "casual speech"
        );
        let plain = RestMood::new(&EmotionPoint::default(), 0.5);
        assert!(
            RestPosture::ALL.map(|p| plain.liking_secs(p)) == [0.0; 10],
            "nothing is preferred without feeling"
        );
    }
}
