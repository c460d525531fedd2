//! A setting with the request and what was heard, and how near they must be.

use crate::compare::{amplitude, frequency};

/// How far from the request a setting may end, as a share of it.
pub const TOLERANCE: f64 = 0.15;

/// The same for the slope of the melody within accented syllables, which few frames of each tell: where it is made
/// half as steep, seven voices end between 3 and 23 % off.
pub const SLOPE_TOLERANCE: f64 = 0.25;

/// Fewer semitones or decibels than these are not noticed in speech: differences of
/// pitch from 1.5 semitones on ('t Hart 1981, doi:10.1121/1.385592), of loudness from one
/// decibel on.
const UNNOTICED: f64 = 0.5;

/// The property that [`SLOPE_TOLERANCE`] is of.
pub(super) const ACCENT_SLOPE: &str = "accent slope";

/// What figures count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    /// A factor on what the voice does by itself.
    Factor,
    /// Semitones more than that.
    Semitones,
    /// Decibels more than that.
    Decibels,
    /// Seconds.
    Seconds,
}

/// One setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The markup, or the dimension of emotion.
    pub setting: String,
    /// What of the sound.
    pub property: &'static str,
    /// The request.
    pub asked: f64,
    /// What was heard.
    pub heard: f64,
    unit: Unit,
}

impl Row {
    pub(super) fn new(
        setting: &str,
        property: &'static str,
        unit: Unit,
        asked: f64,
        heard: f64,
    ) -> Self {
        Self {
            setting: setting.to_owned(),
            property,
            asked,
            heard,
            unit,
        }
    }

    pub(super) fn factor(setting: &str, property: &'static str, asked: f64, heard: f64) -> Self {
        Self::new(setting, property, Unit::Factor, asked, heard)
    }

    /// The measured value over the request, less one: of frequencies and amplitudes where
    /// figures are semitones and decibels.
    pub fn error(&self) -> f64 {
        let ratio = match self.unit {
            Unit::Factor | Unit::Seconds => self.heard / self.asked,
            Unit::Semitones => frequency(self.heard - self.asked),
            Unit::Decibels => amplitude(self.heard - self.asked),
        };
        (ratio - 1.0).abs()
    }

    /// How much of the requested change is missing, or too much: a stricter measure,
    /// since some requests are small changes.
    pub fn missing(&self) -> f64 {
        let neutral = f64::from(u8::from(self.unit == Unit::Factor));
        ((self.heard - self.asked) / (self.asked - neutral)).abs()
    }

    /// Whether it is near enough, in the right direction.
    pub fn is_met(&self) -> bool {
        let neutral = f64::from(u8::from(self.unit == Unit::Factor));
        let same_way = (self.heard - neutral) * (self.asked - neutral) > 0.0;
        let most = if self.property == ACCENT_SLOPE {
            SLOPE_TOLERANCE
        } else {
            TOLERANCE
        };
        let near = match self.unit {
            Unit::Factor | Unit::Seconds => self.error() <= most,
            Unit::Semitones | Unit::Decibels => {
                let most = (TOLERANCE * self.asked.abs()).max(UNNOTICED);
                (self.heard - self.asked).abs() <= most
            }
        };
        same_way && near
    }
}
