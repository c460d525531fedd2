//! Effect of each dimension of emotion on prosody (F&H 4.4.2).

use raconteur_speech::emotion::EmotionPoint;

/// Shape of a pitch accent that an emotion prefers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AccentShape {
    /// Accent that falls from high to low.
    Falling,
    /// Accent that rises from low to high.
    Rising,
    /// The one after the other.
    Alternating,
}

/// Effect of an emotion on the voice, as factors relative to neutral speech; 1 is no change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prosody {
    /// Factor on the mean fundamental frequency.
    pub pitch: f64,
    /// Factor on the frequency at the end of a phrase relative to its beginning.
    pub pitch_dynamics: f64,
    /// Factor on the range of the fundamental frequency.
    pub range: f64,
    /// Factor on the range at the end of a phrase relative to its beginning.
    pub range_dynamics: f64,
    /// Factor on the height of accents.
    pub accent_prominence: f64,
    /// Factor on the steepness of accents.
    pub accent_slope: f64,
    /// Preferred accent shape in place of the engine's; `None` leaves it.
    pub accent_shape: Option<AccentShape>,
    /// True if phrases end high, `false` for low; `None` leaves them.
    pub ends_high: Option<bool>,
    /// Factor on the speech rate.
    pub rate: f64,
    /// Factor on the number of pauses inside sentences.
    pub number_of_pauses: f64,
    /// Factor on the duration of pauses.
    pub pause_duration: f64,
    /// Factor on the duration of vowels, nasals and liquids.
    pub sonorant_duration: f64,
    /// Factor on the duration of plosives and fricatives.
    pub obstruent_duration: f64,
    /// Factor on the amplitude.
    pub volume: f64,
}

impl Prosody {
    /// Computes F&H table 4.5: each coefficient is the change in percent for one unit of a
    /// dimension. `pitch` is read as percent too, and `range` as the 0.04 semitones on a neutral 4
    /// of MARY's own rules (the table's 0.4 would close every range at −10). A neutral position
    /// changes nothing, so the table's shapes for it are omitted.
    #[must_use]
    pub fn from_point(place: EmotionPoint) -> Self {
        let EmotionPoint {
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
    fn a_neutral_place_changes_nothing() {
        let neutral = Prosody::from_point(EmotionPoint::default());
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
            Prosody::from_point(EmotionPoint {
                activation,
                ..EmotionPoint::default()
            })
            .rate
        };
        assert!(
            (at(50.0) - 1.25).abs() < 1e-12 && (at(-30.0) - 0.85).abs() < 1e-12,
            "the rate factors of 50 and -30 per cent"
        );
    }
}
