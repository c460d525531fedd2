//! Mouth shapes for each phone of English, German and Portuguese: targets, dominance and viseme.
//!
//! The ten channels follow the visual-speech set of F&H section 3.1.3 (Albrecht): contraction and
//! protrusion of the orbicularis oris, mentalis, risorius (`spread`), depressor labii inferioris,
//! with jaw and tongue parameters, and an aperture of the lips for faces without muscles. Her
//! numbers are not published: **targets and dominances are designed**. Bilabials have a dominance
//! that keeps neighbours 80 ms away within a few hundredths of closed; rounding begins early and
//! decays slowly. Visemes are the fifteen of OpenXR's `XR_META_face_tracking_visemes`.
//!
//! A [`PhoneRow`] is an index into the table. Bakers resolve symbols of a phone set to rows
//! ([`find`]); a bundle names the rows, and its reader resolves the names once.

mod columns;
mod names;
mod sets;
mod table;

pub use sets::{PHONE_SETS, find, translate};

use table::{SCHWA, SILENCE, TABLE};

/// Number of mouth channels, the parameters of a mouth shape.
pub const CHANNELS: usize = 10;

/// Mouth channel, one parameter of a mouth shape; in the order of [`PhoneTargets::channels`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub enum Channel {
    /// Opening of the jaw, 0..1.
    Jaw,
    /// Aperture between the lips, 0..1.
    LipOpen,
    /// Contraction of the orbicularis oris, 0..1.
    OoContract,
    /// Protrusion (positive) or retraction of the lips, −1..1.
    Protrude,
    /// Corners pulled apart (risorius), 0..1.
    Spread,
    /// Chin raised, lower lip pushed up, 0..1.
    Mentalis,
    /// Lower lip pulled down, 0..1.
    DeprLabii,
    /// Tip of the tongue raised to the ridge, 0..1.
    TongueTip,
    /// Back of the tongue raised to the velum, 0..1.
    TongueBack,
    /// Tongue between the teeth, 0..1.
    TongueOut,
}

impl Channel {
    /// Index of the dominance magnitude that rules each channel, in [`PhoneTargets::alphas`].
    pub const ALPHA: [usize; CHANNELS] = [0, 0, 1, 1, 2, 0, 0, 3, 3, 3];
}

/// Manner of articulation of a phone, as relevant for the lips.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Steady vowel.
    Vowel,
    /// Vowel that glides; see [`PhoneTargets::glide`].
    Diphthong,
    /// p, b: lips closed, then released.
    BilabialStop,
    /// m: lips closed throughout.
    BilabialNasal,
    /// f, v: lower lip at the upper teeth.
    Labiodental,
    /// Any other consonant, which hardly affects the lips.
    Consonant,
    /// Silence: no phone is spoken.
    Silence,
}

/// Visual targets of one phone: the mouth shape that it requires, one row of the phone table.
///
/// # Examples
///
/// ```
/// use raconteur_speech::phones::{Channel, by_name};
///
/// let p = by_name("p").expect("a phone of the table");
/// assert!(p.channel(Channel::Jaw).is_finite());
/// assert!(by_name("no phone").is_none());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PhoneTargets {
    /// Name of the row: Festival's symbol, or SAMPA's if Festival has none.
    pub name: &'static str,
    /// Viseme: one of sil PP FF TH DD kk CH SS nn RR aa E ih oh ou.
    pub viseme: &'static str,
    /// Manner of articulation.
    pub class: Class,
    glide_viseme: &'static str,
    /// Targets in the order of [`Channel`].
    pub channels: [f64; CHANNELS],
    /// Dominance magnitudes for opening, rounding, spreading and tongue.
    pub alphas: [f64; 4],
    /// Rates at which dominance rises before and falls after the peak, 1/s.
    pub thetas_per_s: [f64; 2],
}

impl PhoneTargets {
    /// Returns the target of one mouth channel.
    #[must_use]
    pub fn channel(&self, channel: Channel) -> f64 {
        self.channels[channel as usize]
    }

    /// Returns the glide of a diphthong, its second part.
    #[must_use]
    pub fn glide(&self) -> Option<&'static Self> {
        let symbol = match self.glide_viseme {
            "ih" => "ih",
            "ou" => "uh",
            "E" => "eh",
            _ => return None,
        };
        by_name(symbol)
    }
}

/// Index of a row in the phone table, which gives a phone its mouth shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PhoneRow(u8);

impl PhoneRow {
    /// Row of silence: the closed mouth at rest.
    pub const SILENCE: Self = Self(SILENCE as u8);

    /// A phone that hardly constrains the lips (schwa), for unknown symbols.
    pub const NEUTRAL: Self = Self(SCHWA as u8);

    /// Returns the row with a name; `None` for an unknown name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let index = TABLE.iter().position(|row| row.name == name)?;
        u8::try_from(index).ok().map(Self)
    }

    /// Returns the visual targets of the row.
    #[must_use]
    pub fn targets(self) -> &'static PhoneTargets {
        &TABLE[usize::from(self.0)]
    }
}

impl Default for PhoneRow {
    /// Returns [`PhoneRow::NEUTRAL`].
    fn default() -> Self {
        Self::NEUTRAL
    }
}

/// Iterates over the targets of all rows of the phone table.
pub fn all() -> impl Iterator<Item = &'static PhoneTargets> {
    TABLE.iter()
}

/// Returns the targets of a row by name; `None` for an unknown name.
#[must_use]
pub fn by_name(name: &str) -> Option<&'static PhoneTargets> {
    PhoneRow::named(name).map(PhoneRow::targets)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn silence_is_closed_and_the_fallback_is_a_schwa() {
        let silence = PhoneRow::SILENCE.targets();
        assert_eq!(silence.class, Class::Silence);
        assert_eq!(silence.channels, [0.0; CHANNELS]);
        assert_eq!(PhoneRow::named("pau"), Some(PhoneRow::SILENCE));
        assert_eq!(PhoneRow::named("ax"), Some(PhoneRow::NEUTRAL));
    }

    #[test]
    fn diphthongs_and_nothing_else_glide() {
        for row in &TABLE {
            assert_eq!(
                row.class == Class::Diphthong,
                row.glide().is_some(),
                "{:?}",
                row.name
            );
        }
    }

    #[test]
    fn targets_stay_in_range() {
        for row in &TABLE {
            for (i, v) in row.channels.iter().enumerate() {
                let low = if i == Channel::Protrude as usize {
                    -1.0
                } else {
                    0.0
                };
                assert!((low..=1.0).contains(v), "{:?}", row.name);
            }
            assert!(
                row.alphas.iter().all(|a| *a > 0.0) && row.thetas_per_s.iter().all(|t| *t > 0.0),
                "all alphas and thetas are positive"
            );
        }
    }
}
