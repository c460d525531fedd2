//! Hair colour from its pigments.

use raconteur_base::ops;
use serde::{Deserialize, Serialize};

/// Hair colour by pigments: eumelanin, pheomelanin and the share of grey hairs.
///
/// Absorption follows d'Eon, Francois, Hill, Letteri and Aubry 2011 ("An energy-conserving hair
/// reflectance model", doi:10.1111/j.1467-8659.2011.01976.x). The conversion from absorption to the
/// colour of a head of hair follows Chiang, Bitterli, Tappan and Burley 2016 ("A practical and
/// controllable hair and fur model for production path tracing", doi:10.1111/cgf.12830, eq. 9 at
/// azimuthal roughness 0.3).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HairColour {
    /// Eumelanin: 0.05 blond, 0.25 brown, 1.5 black.
    pub eumelanin: f64,
    /// Pheomelanin: 0.2 blond, 0.4 brown, 0.9 red.
    pub pheomelanin: f64,
    /// Share of hairs without pigment, 0..1.
    pub grey: f64,
}

impl HairColour {
    /// Hair without pigment, linear RGB: paper white would glow next to skin. Chosen by eye.
    pub const WHITE_RGB: [f64; 3] = [0.42, 0.408, 0.388];

    /// Eight natural colours without grey, from dark to pale, with their names.
    pub const NATURAL: [(&str, Self); 8] = [
        ("black", Self::from_pigments(1.50, 0.10)),
        ("dark brown", Self::from_pigments(0.60, 0.30)),
        ("brown", Self::from_pigments(0.30, 0.40)),
        ("auburn", Self::from_pigments(0.22, 0.90)),
        ("red", Self::from_pigments(0.08, 0.85)),
        ("light brown", Self::from_pigments(0.17, 0.24)),
        ("dark blond", Self::from_pigments(0.10, 0.18)),
        ("blond", Self::from_pigments(0.045, 0.12)),
    ];

    const fn from_pigments(eumelanin: f64, pheomelanin: f64) -> Self {
        Self {
            eumelanin,
            pheomelanin,
            grey: 0.0,
        }
    }
}

impl Default for HairColour {
    fn default() -> Self {
        Self {
            eumelanin: 0.25,
            pheomelanin: 0.4,
            grey: 0.0,
        }
    }
}

/// Absorption per unit of pigment for red, green and blue (d'Eon et al. 2011).
const EUMELANIN: [f64; 3] = [0.419, 0.697, 1.37];
const PHEOMELANIN: [f64; 3] = [0.187, 0.400, 1.05];
/// The denominator of Chiang et al. 2016, eq. 9, at 0.3.
const REACH: f64 = 5.888;
/// Reflectance of the hairs' surface without pigment: 4.6 % at normal incidence for keratin (index
/// 1.55), part of which appears in diffuse light. Chosen by eye.
const SURFACE: f64 = 0.009;
impl HairColour {
    /// Returns the colour of the pigmented hairs, linear RGB.
    #[must_use]
    pub fn pigment_rgb(&self) -> [f64; 3] {
        core::array::from_fn(|i| {
            let sigma =
                self.eumelanin.max(0.0) * EUMELANIN[i] + self.pheomelanin.max(0.0) * PHEOMELANIN[i];
            // Hair with next to no pigment is not whiter than white hair.
            (SURFACE + ops::exp(-sigma.sqrt() * REACH)).min(Self::WHITE_RGB[i])
        })
    }

    /// Returns the mean colour of the hair including grey hairs, linear RGB.
    #[must_use]
    pub fn linear_rgb(&self) -> [f64; 3] {
        let own = self.pigment_rgb();
        core::array::from_fn(|i| own[i] + (Self::WHITE_RGB[i] - own[i]) * self.grey.clamp(0.0, 1.0))
    }
}
