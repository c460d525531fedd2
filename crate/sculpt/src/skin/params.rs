//! Parameters of a person's skin.

use raconteur_base::ops;
use serde::{Deserialize, Serialize};

use super::pigment::{Pigments, colour};

/// Skin of a person: pigment, blood, age and marks. Shares are 0..1 unless specified otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SkinParams {
    /// Melanin: 0 the lightest skin there is, 1 the darkest.
    pub melanin: f64,
    /// Blood: 0 very pale, 0.5 usual, 1 ruddy.
    pub blood: f64,
    /// Contrast of blood and pigment between the parts of the face; 1 is usual.
    pub contrast: f64,
    /// Years: lines, spots and loss of evenness follow.
    pub age_years: f64,
    /// Amount of freckles, 0..1.
    pub freckles: f64,
    /// Number of moles on face and neck.
    pub moles: u32,
    /// Sun in a lifetime: age spots, mottling.
    pub sun: f64,
    /// Small widened vessels on cheeks and nose.
    pub vessels: f64,
    /// Shadow of a shaven beard.
    pub beard: f64,
    /// Coverage of the skin by short hairs in the beard region.
    pub short_beard: f64,
    /// Linear RGB of stubble and short beard.
    pub beard_colour: [f64; 3],
    /// Redness of the lips; 0.5 is usual.
    pub lips: f64,
    /// Darkness of the line along the lashes.
    pub lash_line: f64,
    /// Seed of everything scattered.
    pub seed: u64,
}

impl SkinParams {
    /// Returns an even, light-brown adult skin without marks.
    #[must_use]
    pub fn plain() -> Self {
        Self {
            melanin: 0.2,
            blood: 0.5,
            contrast: 1.0,
            age_years: 30.0,
            freckles: 0.0,
            moles: 0,
            sun: 0.0,
            vessels: 0.0,
            beard: 0.0,
            short_beard: 0.0,
            beard_colour: [0.05, 0.04, 0.035],
            lips: 0.5,
            lash_line: 0.3,
            seed: 1,
        }
    }

    /// Returns the natural logarithm of the volume fraction of melanosomes: 1 % at melanin 0, 43 %
    /// at 1 (Jacques 1998: 1.3–43 %; *paper*).
    pub(crate) fn ln_melanosomes(&self) -> f64 {
        ops::ln(0.01) + ops::ln(43.0) * self.melanin.clamp(0.0, 1.0)
    }

    /// Returns the natural logarithm of the volume fraction of blood: 0.3 % to 3 % (Jacques 2013:
    /// 0.2–0.6 % averaged over the dermis, several times that in the face's plexus; *designed*
    /// within it).
    pub(crate) fn ln_blood(&self) -> f64 {
        ops::ln(0.003) + ops::ln(10.0) * self.blood.clamp(0.0, 1.0)
    }

    /// Returns the progress of an age-related change, 0 at its onset, 1 at 75; *designed*.
    pub(crate) fn since(&self, onset_years: f64) -> f64 {
        let t = ((self.age_years - onset_years) / (75.0 - onset_years)).clamp(0.0, 1.2);
        ops::pow(t, 1.15)
    }

    /// Returns the linear RGB of the skin without its zones: the colour at the side of the cheek.
    #[must_use]
    pub fn base_colour(&self) -> [f64; 3] {
        colour(&Pigments {
            melanosomes: ops::exp(self.ln_melanosomes()),
            blood: ops::exp(self.ln_blood()),
            oxygen: OXYGEN,
        })
    }
}

/// Share of oxygenated haemoglobin in resting skin, arterioles and venules together
/// (Jacques 2013; *paper*).
pub(crate) const OXYGEN: f64 = 0.75;

/// Deep red of a nostril's inside and of the mouth, linear RGB.
pub(crate) const INSIDE: [f64; 3] = [0.115, 0.038, 0.028];
