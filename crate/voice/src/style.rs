//! Meaning of markup: the style of each word, with all its enclosing markup combined.

use crate::content::{Markup, Setting, Speaker};
use crate::text::SayAs;
use raconteur_speech::emotion::EmotionPoint;

/// Emphasis of speech without markup, on SABLE's scale.
pub const NO_EMPHASIS: f64 = 0.5;

/// Limit of the factor of a setting, or of its inverse; beyond it a voice is unrecognisable.
pub const MAX_FACTOR: f64 = 4.0;

/// Value of a speech property, resolved from all surrounding markup.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Amount {
    /// Requested value, in the property's unit; `None`: the voice's own.
    pub value: Option<f64>,
    /// A factor on it.
    pub factor: f64,
}

impl Default for Amount {
    fn default() -> Self {
        Self {
            value: None,
            factor: 1.0,
        }
    }
}

impl Amount {
    /// Applies a nested setting. NaN, or a value not above zero, changes nothing.
    #[must_use]
    pub fn with(self, setting: Setting) -> Self {
        let fine = |x: f64| x.is_finite() && x > 0.0;
        match setting {
            Setting::Factor(factor) if fine(factor) => Self {
                value: self.value,
                factor: (self.factor * factor).clamp(1.0 / MAX_FACTOR, MAX_FACTOR),
            },
            Setting::Value(value) if fine(value) => Self {
                value: Some(value),
                factor: 1.0,
            },
            Setting::Default => Self::default(),
            Setting::Factor(_) | Setting::Value(_) => self,
        }
    }

    /// Returns the value for a voice whose own value is `own`.
    #[must_use]
    pub fn apply(self, own: f64) -> f64 {
        self.value.unwrap_or(own) * self.factor
    }

    /// Returns the factor on the voice's own value, limited to [`MAX_FACTOR`] and its inverse.
    #[must_use]
    pub fn factor_on(self, own: f64) -> f64 {
        (self.apply(own) / own).clamp(1.0 / MAX_FACTOR, MAX_FACTOR)
    }

    /// Returns true if the value leaves the voice unchanged.
    #[must_use]
    pub fn is_default(self) -> bool {
        self == Self::default()
    }
}

/// Speech style of a word: emphasis, pitch, rate, loudness and speaker, resolved from the markup.
#[derive(Clone, Debug, PartialEq)]
pub struct Style {
    /// SABLE's level of emphasis: 0 reduced, [`NO_EMPHASIS`], 1 moderate, 2 strong.
    pub emphasis: f64,
    /// Pitch of the base line, hertz.
    pub pitch_base: Amount,
    /// Mean pitch, hertz.
    pub pitch_middle: Amount,
    /// Range of the pitch, hertz.
    pub pitch_range: Amount,
    /// Pace, words a minute.
    pub rate: Amount,
    /// Amplitude against the voice's own; a value is a factor too. May be 0: silence.
    pub volume: f64,
    /// Text type of the word, which determines its reading; `None` for ordinary text.
    pub say_as: Option<SayAs>,
    /// Pronunciation in the International Phonetic Alphabet.
    pub ipa: Option<String>,
    /// Replacement text, from markup of pronunciation or of an engine.
    pub instead: Option<String>,
    /// Language, as the author wrote it.
    pub language: Option<String>,
    /// Speaker that the markup requests.
    pub speaker: Speaker,
    /// Emotion requested by markup, with its word.
    pub emotion: Option<(String, EmotionPoint)>,
}

impl Default for Style {
    fn default() -> Self {
        Self {
            emphasis: NO_EMPHASIS,
            pitch_base: Amount::default(),
            pitch_middle: Amount::default(),
            pitch_range: Amount::default(),
            rate: Amount::default(),
            volume: 1.0,
            say_as: None,
            ipa: None,
            instead: None,
            language: None,
            speaker: Speaker::default(),
            emotion: None,
        }
    }
}

impl Style {
    /// Applies nested markup. `engine` is the name of the engine that will speak.
    #[must_use]
    pub fn with(&self, markup: &Markup, engine: &str) -> Self {
        let mut inner = self.clone();
        let set = |amount: &mut Amount, setting: &Option<Setting>| {
            if let Some(setting) = setting {
                *amount = amount.with(*setting);
            }
        };
        match markup {
            Markup::Emphasis(level) if level.is_finite() => {
                inner.emphasis = level.clamp(0.0, 2.0);
            }
            Markup::Pitch {
                base,
                middle,
                range,
            } => {
                set(&mut inner.pitch_base, base);
                set(&mut inner.pitch_middle, middle);
                set(&mut inner.pitch_range, range);
            }
            Markup::Rate(setting) => inner.rate = inner.rate.with(*setting),
            Markup::Volume(setting) => {
                inner.volume = match *setting {
                    Setting::Factor(factor) if factor >= 0.0 => {
                        (inner.volume * factor).min(MAX_FACTOR)
                    }
                    Setting::Value(gain) if gain >= 0.0 => gain.min(MAX_FACTOR),
                    Setting::Default => 1.0,
                    Setting::Factor(_) | Setting::Value(_) => inner.volume,
                };
            }
            Markup::Pronunciation { ipa, sub, origin } => {
                inner.ipa.clone_from(ipa);
                inner.instead.clone_from(sub);
                if origin.is_some() && ipa.is_none() && sub.is_none() {
                    inner.language.clone_from(origin);
                }
            }
            Markup::SayAs(kind) => inner.say_as = Some(*kind),
            Markup::Language(language) => inner.language = Some(language.clone()),
            Markup::Speaker(speaker) => {
                // A named voice is independent; without a name, the speaker modifies the current
                // one.
                if speaker.name.is_some() {
                    inner.speaker = speaker.clone();
                } else {
                    inner.speaker.gender = speaker.gender.or(inner.speaker.gender);
                    inner.speaker.age = speaker.age.or(inner.speaker.age);
                }
            }
            Markup::Engine { id, data } if engine.eq_ignore_ascii_case(id) => {
                inner.instead = Some(data.clone());
            }
            Markup::Emotion {
                name,
                activation,
                evaluation,
                power,
            } => {
                let place = EmotionPoint {
                    activation: *activation,
                    evaluation: *evaluation,
                    power: *power,
                };
                inner.emotion = Some((name.clone(), place.scaled(1.0)));
            }
            Markup::Emphasis(_) | Markup::Engine { .. } | Markup::Other => {}
        }
        inner
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_inside_each_other_multiply_and_values_begin_anew() {
        let faster = Markup::Rate(Setting::Factor(1.2));
        let once = Style::default().with(&faster, "");
        let twice = once.with(&faster, "");
        assert!(
            (twice.rate.factor_on(180.0) - 1.44).abs() < 1e-12,
            "nested changes of the rate multiply"
        );
        let named = twice.with(&Markup::Rate(Setting::Value(90.0)), "");
        assert_eq!(named.rate.factor_on(180.0), 0.5);
        let own = named.with(&Markup::Rate(Setting::Default), "");
        assert!(
            own.rate.is_default(),
            "the default replaces the nested rates"
        );
    }

    #[test]
    fn what_is_no_amount_changes_nothing_and_none_runs_away() {
        let amount = Amount::default();
        for x in [f64::NAN, f64::INFINITY, -1.0, 0.0] {
            assert_eq!(amount.with(Setting::Factor(x)), amount);
            assert_eq!(amount.with(Setting::Value(x)), amount);
        }
        let huge = (0..20).fold(amount, |a, _| a.with(Setting::Factor(1.5)));
        assert_eq!(huge.factor, MAX_FACTOR);
        let quiet = Style::default().with(&Markup::Volume(Setting::Value(0.0)), "");
        assert_eq!(quiet.volume, 0.0);
    }

    #[test]
    fn an_engine_hears_only_what_is_for_it() {
        let markup = Markup::Engine {
            id: "Festival".to_owned(),
            data: "hers".to_owned(),
        };
        let hers = Style::default().with(&markup, "festival");
        assert_eq!(hers.instead.as_deref(), Some("hers"));
        assert_eq!(Style::default().with(&markup, "flite").instead, None);
    }
}
