//! Emotion in the voice: words and emoticons with their place in the space of activation,
//! evaluation and power, and what each dimension does to prosody (F&H 4.3.2, 4.4.1, 4.4.2).

/// A place in the space of emotions; each from −100 to 100, 0 is neutral.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Place {
    /// Passive to active.
    pub activation: f64,
    /// Negative to positive.
    pub evaluation: f64,
    /// Submissive to dominant.
    pub power: f64,
}

/// The words of F&H table 4.4 (NECA's working model), with `surprise`, which F&H 4.4.3 adds
/// as full activation and nothing else, and the two of the emoticons that the table lacks:
/// `kidding`, *designed* as gloating's mildness, and `disgusted`, as disliking (F&H 4.4.1
/// finds anger and disgust too near to tell apart).
pub const WORDS: [(&str, [f64; 3]); 27] = [
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
    ("disgusted", [15.0, -35.0, -10.0]),
];

/// F&H table 4.1, each with a word of [`WORDS`].
pub const EMOTICONS: [(&str, &str); 6] = [
    (":-)", "joy"),
    (":-(", "distress"),
    (":-o", "surprise"),
    (";-)", "kidding"),
    (">:-<", "anger"),
    (":-|", "disgusted"),
];

/// The place of an emotion's word; `None` for a word that is not in the table.
#[must_use]
pub fn place(word: &str) -> Option<Place> {
    let (_, [activation, evaluation, power]) =
        WORDS.iter().find(|(w, _)| w.eq_ignore_ascii_case(word))?;
    Some(Place {
        activation: *activation,
        evaluation: *evaluation,
        power: *power,
    })
}

/// The word of an emoticon that is a whole token.
#[must_use]
pub fn of_emoticon(token: &str) -> Option<&'static str> {
    let (_, word) = EMOTICONS
        .iter()
        .find(|(sign, _)| sign.eq_ignore_ascii_case(token))?;
    Some(word)
}

/// Whether a token is an emoticon.
#[must_use]
pub fn is_emoticon(token: &str) -> bool {
    of_emoticon(token).is_some()
}

impl Place {
    /// Each dimension times `factor`, within −100 to 100.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        let scale = |x: f64| (x * factor).clamp(-100.0, 100.0);
        Self {
            activation: scale(self.activation),
            evaluation: scale(self.evaluation),
            power: scale(self.power),
        }
    }

    /// Whether it is neutral.
    #[must_use]
    pub fn is_neutral(self) -> bool {
        self == Self::default()
    }
}

/// The shape of a pitch accent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AccentShape {
    /// From high to low.
    Falling,
    /// From low to high.
    Rising,
    /// The one after the other.
    Alternating,
}

/// What an emotion does to the voice: factors on what a neutral voice would do, 1 is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prosody {
    /// On the mean of the fundamental frequency.
    pub pitch: f64,
    /// On the frequency at the end of a phrase against its begin.
    pub pitch_dynamics: f64,
    /// On the range of the fundamental frequency.
    pub range: f64,
    /// On the range at the end of a phrase against its begin.
    pub range_dynamics: f64,
    /// On the height of accents.
    pub accent_prominence: f64,
    /// On the steepness of accents.
    pub accent_slope: f64,
    /// Which shape accents have rather than the engine's; `None` leaves them.
    pub accent_shape: Option<AccentShape>,
    /// Whether phrases end high (`true`) or low; `None` leaves them.
    pub ends_high: Option<bool>,
    /// On the pace.
    pub rate: f64,
    /// On the number of pauses inside sentences.
    pub number_of_pauses: f64,
    /// On the length of pauses.
    pub pause_duration: f64,
    /// On the length of vowels, nasals and liquids.
    pub sonorant_duration: f64,
    /// On the length of plosives and fricatives.
    pub obstruent_duration: f64,
    /// On the amplitude.
    pub volume: f64,
}

impl Prosody {
    /// F&H table 4.5: each coefficient is the change in percent for one unit of a dimension.
    /// `pitch` is read as percent too, and `range` as the 0.04 semitones on a neutral 4 that
    /// MARY's own rules have (the table's 0.4 would close every range at −10). A neutral
    /// place changes nothing, so the shapes that the table gives to it are left out.
    #[must_use]
    pub fn of(place: Place) -> Self {
        let Place {
            activation: a,
            evaluation: e,
            power: p,
        } = place;
        // No sum of coefficients may turn a length or a loudness around.
        let factor = |percent: f64| (1.0 + percent / 100.0).clamp(0.3, 2.5);
        Self {
            pitch: factor(0.3 * a + 0.1 * e - 0.1 * p),
            pitch_dynamics: factor(0.3 * a - 0.3 * p),
            range: factor(a),
            range_dynamics: factor(1.2 * a + 0.4 * p),
            accent_prominence: factor(0.5 * a - 0.5 * e),
            accent_slope: factor(a - 0.5 * e),
            accent_shape: if e <= -20.0 {
                Some(AccentShape::Falling)
            } else if e > 40.0 {
                Some(AccentShape::Alternating)
            } else if e != 0.0 {
                Some(AccentShape::Rising)
            } else {
                None
            },
            ends_high: (p != 0.0).then_some(p < 0.0),
            rate: factor(0.5 * a + 0.2 * e),
            number_of_pauses: factor(0.7 * a),
            pause_duration: factor(-0.2 * a),
            sonorant_duration: factor(0.3 * e + 0.3 * p),
            obstruent_duration: factor(0.5 * a - 0.3 * e),
            volume: factor(0.33 * a),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_the_thesis() {
        assert_eq!(
            place("Hate"),
            Some(Place {
                activation: 60.0,
                evaluation: -60.0,
                power: 30.0
            })
        );
        assert_eq!(place("calm"), None);
        assert!(
            WORDS
                .iter()
                .all(|(_, v)| v.iter().all(|x| x.abs() <= 100.0))
        );
        for (sign, word) in EMOTICONS {
            assert_eq!(of_emoticon(sign), Some(word));
            assert!(place(word).is_some());
        }
    }

    #[test]
    fn a_neutral_place_changes_nothing() {
        let neutral = Prosody::of(Place::default());
        for factor in [
            neutral.pitch,
            neutral.pitch_dynamics,
            neutral.range,
            neutral.range_dynamics,
            neutral.accent_prominence,
            neutral.accent_slope,
            neutral.rate,
            neutral.number_of_pauses,
            neutral.pause_duration,
            neutral.sonorant_duration,
            neutral.obstruent_duration,
            neutral.volume,
        ] {
            assert_eq!(factor, 1.0);
        }
        assert_eq!((neutral.accent_shape, neutral.ends_high), (None, None));
    }

    #[test]
    fn the_example_of_the_text_holds() {
        // F&H 4.4.2: 0.5 % from activation to rate is +25 % at +50 and −15 % at −30.
        let at = |activation| {
            Prosody::of(Place {
                activation,
                ..Place::default()
            })
            .rate
        };
        assert!((at(50.0) - 1.25).abs() < 1e-12 && (at(-30.0) - 0.85).abs() < 1e-12);
    }
}
