//! Composition of skin at one point.

use super::SkinParams;
use super::params::OXYGEN;
use super::pigment::Palette;
use crate::texture::mix;

/// Composition and relief of the skin at one texel: pigments, blood, height.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tissue {
    /// Natural logarithms of the volume fractions.
    pub(super) ln_melanosomes: f64,
    pub(super) ln_blood: f64,
    /// Share of oxygenated blood.
    pub(super) oxygen: f64,
    /// Height over the mesh, mm.
    pub(super) height_mm: f64,
    /// Heights of expressive wrinkles of each kind when they are fully there, mm.
    pub(super) folds_mm: [f64; 3],
    /// Cover over or in the skin (hair roots, wet margins): linear RGB and share.
    pub(super) cover: ([f64; 3], f64),
    /// Share of light that reaches the position, 1 if unoccluded.
    pub(super) light: f64,
}

impl Tissue {
    pub(super) fn new(skin: &SkinParams) -> Self {
        Self {
            ln_melanosomes: skin.ln_melanosomes(),
            ln_blood: skin.ln_blood(),
            oxygen: OXYGEN,
            height_mm: 0.0,
            folds_mm: [0.0; 3],
            cover: ([0.0; 3], 0.0),
            light: 1.0,
        }
    }

    /// Blends a colour over the present one.
    pub(super) fn blend(&mut self, rgb: [f64; 3], share: f64) {
        let (under, had) = self.cover;
        let all = had + share - had * share;
        if all > 0.0 {
            self.cover = (mix(under, rgb, share / all), all);
        }
    }

    pub(super) fn rgb(&self, palette: &Palette) -> [f64; 3] {
        let own = palette.sample(self.ln_melanosomes, self.ln_blood, self.oxygen);
        mix(own, self.cover.0, self.cover.1).map(|x| x * self.light)
    }
}
