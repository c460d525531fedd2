//! Words of emotions with their position in the space of activation, evaluation and power (F&H
//! 4.4.1). Their emoticons are part of EML.

/// Emotion as a point in the space of activation, evaluation and power; each from −100 to 100, 0 is
/// neutral.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EmotionPoint {
    /// Activation, −100 passive to 100 active.
    pub activation: f64,
    /// Evaluation, −100 negative to 100 positive.
    pub evaluation: f64,
    /// Power, −100 submissive to 100 dominant.
    pub power: f64,
}

/// The words of F&H table 4.4 (NECA's working model), and others that F&H name: `surprise`, which
/// 4.4.3 adds as full activation and no other component; `disgust`, whose place 4.4.3 equates with
/// that of hate; `anxiety` and `panic`, the same as fear at half and at twice its distance from the
/// middle of the disc (figure 4.17; the amounts are *designed*, and panic's power ends at −100);
/// and `kidding` of table 4.1, *designed* as a milder gloating.
pub const WORDS: [(&str, [f64; 3]); 29] = [
    ("joy", [17.3, 42.2, 12.5]),
    ("distress", [-17.2, -40.1, -52.4]),
    ("happy-for", [17.3, 42.2, 12.5]),
    ("gloating", [40.0, 30.0, 30.0]),
    ("resentment", [0.0, -40.0, -20.0]),
    ("sorry-for", [-17.2, -40.1, -52.4]),
    ("hope", [20.0, 20.0, -10.0]),
    ("fear", [14.8, -44.4, -79.4]),
    ("satisfaction", [-14.9, 33.1, 12.2]),
    ("relief", [3.0, 33.0, -3.0]),
    ("fears-confirmed", [-30.0, -50.0, -70.0]),
    ("disappointment", [2.4, -24.9, -37.2]),
    ("pride", [30.0, 40.0, 30.0]),
    ("admiration", [27.0, 53.0, 17.0]),
    ("shame", [4.6, -26.3, -62.3]),
    ("reproach", [-3.0, -30.0, 43.0]),
    ("liking", [-14.9, 33.1, 12.2]),
    ("disliking", [15.0, -35.0, -10.0]),
    ("gratitude", [20.0, 40.0, -30.0]),
    ("anger", [34.0, -35.6, 20.0]),
    ("gratification", [-14.9, 33.1, 12.2]),
    ("remorse", [4.6, -26.3, -62.3]),
    ("love", [1.2, 33.3, 14.9]),
    ("hate", [60.0, -60.0, 30.0]),
    ("surprise", [100.0, 0.0, 0.0]),
    ("kidding", [20.0, 30.0, 15.0]),
    ("disgust", [60.0, -60.0, 30.0]),
    ("anxiety", [7.4, -22.2, -39.7]),
    ("panic", [29.6, -88.8, -100.0]),
];

/// Returns the place of an emotion word; `None` for a word that is not in the table.
#[must_use]
pub fn place(word: &str) -> Option<EmotionPoint> {
    let (_, [activation, evaluation, power]) =
        WORDS.iter().find(|(w, _)| w.eq_ignore_ascii_case(word))?;
    Some(EmotionPoint {
        activation: *activation,
        evaluation: *evaluation,
        power: *power,
    })
}

impl EmotionPoint {
    /// Returns the point with each dimension multiplied by `factor`, limited to −100 to 100.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        let scale = |x: f64| (x * factor).clamp(-100.0, 100.0);
        Self {
            activation: scale(self.activation),
            evaluation: scale(self.evaluation),
            power: scale(self.power),
        }
    }

    /// Returns true if all dimensions are 0.
    #[must_use]
    pub fn is_neutral(self) -> bool {
        self == Self::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_the_thesis() {
        assert_eq!(
            place("Hate"),
            Some(EmotionPoint {
                activation: 60.0,
                evaluation: -60.0,
                power: 30.0
            })
        );
        assert_eq!(place("calm"), None);
        assert_eq!(place("disgust"), place("hate"));
        assert!(
            WORDS
                .iter()
                .all(|(_, v)| v.iter().all(|x| x.abs() <= 100.0)),
            "the values of the table are within 100"
        );
    }
}
