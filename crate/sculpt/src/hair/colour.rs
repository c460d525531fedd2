//! Colours of single hairs around the common colour.

use raconteur_base::curve::{lerp, smooth};
use raconteur_base::{noise, ops};
use raconteur_body::HairColour;

/// Hair without pigment.
const WHITE: [f64; 3] = HairColour::WHITE_RGB;
/// Headroom of the vertex colours over the mean colour.
const HEADROOM: f64 = 1.9;
/// Tone of roots and tips relative to the mean: sun and wear lighten hair along its length. Light
/// hair differs less.
const ROOT: f64 = 0.70;
const TIP: f64 = 1.30;
/// Spread of tones among cards.
const SPREAD: f64 = 0.42;

/// Colours of individual hair cards, stored as factors over the common base colour of the material.
pub(super) struct Palette {
    /// The material's colour.
    pub(super) base: [f64; 3],
    pigment: [f64; 3],
    grey: f64,
    seed: u64,
}

impl Palette {
    pub(super) fn new(colour: &HairColour, seed: u64) -> Self {
        let pigment = colour.pigment_rgb();
        let top = |i: usize| {
            if colour.grey > 0.0 {
                WHITE[i].max(pigment[i])
            } else {
                pigment[i]
            }
        };
        Self {
            base: core::array::from_fn(|i| (top(i) * HEADROOM).min(1.0)),
            pigment,
            grey: colour.grey.clamp(0.0, 1.0),
            seed,
        }
    }

    /// Returns the share of white hairs in card `id`: a lock mixes both kinds, with a share around
    /// the mean.
    pub(super) fn grey_of(&self, id: i64) -> f64 {
        let g = self.grey;
        (g + 0.3 * noise::signed(self.seed, 503, id) * g * (1.0 - g)).clamp(0.0, 1.0)
    }

    /// Returns the colour as a factor of the base at a share of the hair's length; `tint` 0..1 is
    /// the tone of the card, `grey` its share of white hairs.
    pub(super) fn shade(&self, share: f64, tint: f64, grey: f64) -> [f64; 3] {
        let t = smooth(share);
        let tone = ops::exp(SPREAD * (tint - 0.5));
        core::array::from_fn(|i| {
            let pale = self.pigment[i].clamp(0.0, 0.4) / 0.4;
            let (root, tip) = (lerp(ROOT, 0.85, pale), lerp(TIP, 1.12, pale));
            let own = lerp(self.pigment[i] * lerp(root, tip, t), WHITE[i], grey);
            (own * tone / self.base[i].max(1e-4)).clamp(0.0, 1.0)
        })
    }

    /// Returns the colour of hair at the root, linear RGB.
    pub(super) fn root(&self) -> [f64; 3] {
        let shade = self.shade(0.0, 0.5, self.grey);
        core::array::from_fn(|i| shade[i] * self.base[i])
    }
}
