//! Setting with the requested and the measured value, and their tolerance.

use crate::compare::{amplitude, frequency};

/// Tolerance of a setting, as a share of the request.
pub const TOLERANCE: f64 = 0.15;

/// Tolerance for the pitch slope within accented syllables, which is measured on few frames each:
/// at half the slope, seven voices end between 3 and 23 % off.
pub const SLOPE_TOLERANCE: f64 = 0.25;

/// Fewer semitones or decibels than these are not noticed in speech: differences of
/// pitch from 1.5 semitones on ('t Hart 1981, doi:10.1121/1.385592), of loudness from one
/// decibel on.
const UNNOTICED: f64 = 0.5;

/// The property that [`SLOPE_TOLERANCE`] is of.
pub(super) const ACCENT_SLOPE: &str = "accent slope";

/// Unit of the requested and the measured value of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    /// Factor relative to the voice's default.
    Factor,
    /// Semitones more than that.
    Semitones,
    /// Decibels more than that.
    Decibels,
    /// Seconds.
    Seconds,
}

/// Measurement of one setting: the requested and the measured value of a property of the audio.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The markup, or the dimension of emotion.
    pub setting: String,
    /// Property of the audio.
    pub property: &'static str,
    /// Requested value.
    pub requested: f64,
    /// Measured value.
    pub measured: f64,
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
            requested: asked,
            measured: heard,
            unit,
        }
    }

    pub(super) fn factor(setting: &str, property: &'static str, asked: f64, heard: f64) -> Self {
        Self::new(setting, property, Unit::Factor, asked, heard)
    }

    /// Returns the relative error: the ratio of measured to requested value, less one. Semitones
    /// and decibels are compared as frequencies and amplitudes.
    pub fn error(&self) -> f64 {
        let ratio = match self.unit {
            Unit::Factor | Unit::Seconds => self.measured / self.requested,
            Unit::Semitones => frequency(self.measured - self.requested),
            Unit::Decibels => amplitude(self.measured - self.requested),
        };
        (ratio - 1.0).abs()
    }

    /// Returns the relative error of the requested change: a stricter measure, because some
    /// requests are small changes.
    pub fn missing(&self) -> f64 {
        let neutral = f64::from(u8::from(self.unit == Unit::Factor));
        ((self.measured - self.requested) / (self.requested - neutral)).abs()
    }

    /// Returns true if the value is within tolerance, in the right direction.
    pub fn is_met(&self) -> bool {
        let neutral = f64::from(u8::from(self.unit == Unit::Factor));
        let same_way = (self.measured - neutral) * (self.requested - neutral) > 0.0;
        let most = if self.property == ACCENT_SLOPE {
            SLOPE_TOLERANCE
        } else {
            TOLERANCE
        };
        let near = match self.unit {
            Unit::Factor | Unit::Seconds => self.error() <= most,
            Unit::Semitones | Unit::Decibels => {
                let most = (TOLERANCE * self.requested.abs()).max(UNNOTICED);
                (self.measured - self.requested).abs() <= most
            }
        };
        same_way && near
    }
}
