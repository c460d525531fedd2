//! Colour of hair from its pigments.

use raconteur_base::{noise, ops};
use serde::{Deserialize, Serialize};

/// Pigments of hair.
///
/// Absorption by d'Eon, Francois, Hill, Letteri and Aubry 2011 ("An energy-conserving hair
/// reflectance model", doi:10.1111/j.1467-8659.2011.01976.x); from absorption to the colour
/// of a head of hair by Chiang, Bitterli, Tappan and Burley 2016 ("A practical and
/// controllable hair and fur model for production path tracing", doi:10.1111/cgf.12830,
/// eq. 9 at azimuthal roughness 0.3).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HairColour {
    /// Eumelanin: 0.05 blond, 0.25 brown, 1.5 black.
    pub eumelanin: f64,
    /// Pheomelanin: 0.2 blond, 0.4 brown, 0.9 red.
    pub pheomelanin: f64,
    /// Share of hairs without pigment, 0..1.
    pub grey: f64,
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
/// Hair without pigment, linear RGB: white paper would glow beside skin. Chosen by eye.
const WHITE: [f64; 3] = [0.47, 0.455, 0.43];
/// What the hairs' surface sends back before any pigment: 4.6 % at normal incidence for
/// keratin (index 1.55), of which diffuse light sees a part. Chosen by eye.
const SURFACE: f64 = 0.009;
/// Headroom of the vertex colours over the mean colour.
const HEADROOM: f64 = 1.45;

/// Colours of single locks over a common base.
pub(super) struct Palette {
    /// The material's colour.
    pub(super) base: [f64; 3],
    pigment: [f64; 3],
    grey: f64,
}

impl HairColour {
    /// Colour of the pigmented hairs, linear RGB.
    #[must_use]
    pub fn pigment_rgb(&self) -> [f64; 3] {
        core::array::from_fn(|i| {
            let sigma =
                self.eumelanin.max(0.0) * EUMELANIN[i] + self.pheomelanin.max(0.0) * PHEOMELANIN[i];
            // Hair with next to no pigment is not whiter than white hair.
            (SURFACE + ops::exp(-sigma.sqrt() * REACH)).min(WHITE[i])
        })
    }

    /// Mean colour, linear RGB.
    #[must_use]
    pub fn linear_rgb(&self) -> [f64; 3] {
        let own = self.pigment_rgb();
        core::array::from_fn(|i| own[i] + (WHITE[i] - own[i]) * self.grey.clamp(0.0, 1.0))
    }

    pub(super) fn palette(&self) -> Palette {
        let pigment = self.pigment_rgb();
        let top = |i: usize| {
            if self.grey > 0.0 {
                WHITE[i].max(pigment[i])
            } else {
                pigment[i]
            }
        };
        Palette {
            base: core::array::from_fn(|i| (top(i) * HEADROOM).min(1.0)),
            pigment,
            grey: self.grey.clamp(0.0, 1.0),
        }
    }
}

impl Palette {
    /// Colour of lock `id` over the base; `spread` is the share by which locks differ.
    pub(super) fn lock(&self, seed: u64, id: i64, spread: f64) -> [f64; 3] {
        let tone = 1.0 + spread * noise::signed(seed, 501, id);
        let warm = 0.35 * spread * noise::signed(seed, 502, id);
        // A lock holds hairs of both kinds: its share of grey lies about the mean.
        let g = self.grey;
        let share = (g + 0.8 * noise::signed(seed, 503, id) * g * (1.0 - g)).clamp(0.0, 1.0);
        core::array::from_fn(|i| {
            let own = self.pigment[i] + (WHITE[i] - self.pigment[i]) * share;
            let hue = 1.0 + warm * (1.0 - i as f64);
            (own * tone * hue / self.base[i].max(1e-4)).clamp(0.0, 1.0)
        })
    }
}
