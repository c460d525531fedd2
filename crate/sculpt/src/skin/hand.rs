//! Skin of the hand: a red palm without melanin, darker knuckles, veins in age.

use raconteur_base::ops;

use super::SkinParams;
use super::marks::Marks;
use super::tissue::Tissue;
use crate::atlas::Hit;
use crate::hand::{HandLine, HandRegion, HandSheet};
use crate::texture::{cells, rise, space_noise};

impl HandRegion {
    fn to_array(self) -> [f64; 5] {
        [self.palm, self.tip, self.knuckle, self.nail, self.cushion]
    }
}

/// Painter of a hand's skin: creases, veins, spots and regions.
pub(super) struct HandPainter<'a> {
    skin: &'a SkinParams,
    sheet: &'a HandSheet,
    creases: Marks,
    slack: Marks,
    veins: Marks,
    spots: Marks,
    base: Tissue,
    old: f64,
}

impl HandSheet {
    pub(super) fn painter<'a>(&'a self, skin: &'a SkinParams) -> HandPainter<'a> {
        let draw =
            |lines: &[HandLine], scale: f64, seed: u64| super::hand_lines::draw(lines, scale, seed);
        let slack = 0.3 + 1.2 * skin.since(30.0);
        HandPainter {
            skin,
            sheet: self,
            creases: draw(&self.creases, 1.0 + 0.35 * skin.since(30.0), skin.seed),
            slack: draw(&self.slack, slack, skin.seed + 1),
            veins: draw(&self.veins, 0.12 + 0.88 * skin.since(35.0), skin.seed + 2),
            spots: super::hand_lines::spots(self, skin),
            base: Tissue::new(skin),
            old: rise(28.0, 78.0, skin.age_years),
        }
    }
}

impl HandPainter<'_> {
    pub(super) fn tissue(&self, t: [u32; 3], hit: &Hit) -> Tissue {
        let s = self.sheet;
        let p = hit.blend(t.map(|v| s.at[v as usize]));
        let normal = hit
            .blend(t.map(|v| s.normals[v as usize]))
            .normalize_or_zero();
        let shares = t.map(|v| s.regions[v as usize].to_array());
        let [palm, tip, knuckle, nail, cushion] =
            core::array::from_fn(|i| hit.blend(shares.map(|r| r[i])).clamp(0.0, 1.0));
        let seed = (self.skin.seed << 8) + 128;
        let mut tissue = self.base;
        let k = self.skin.contrast;
        // The palm has a thick clear horny layer and less melanin: a fifth (Jacques 1998); it is
        // rendered with a third, because dark skin's palms would look grey.
        tissue.ln_melanosomes -= (0.50 + 0.65 * self.skin.melanin) * palm;
        tissue.ln_melanosomes += 0.10 * (1.0 - palm);
        tissue.ln_blood += k * palm * (0.24 + 0.5 * cushion + 0.55 * tip);
        tissue.ln_blood += k * (0.34 * knuckle + 0.40 * nail) * (1.0 - 0.5 * palm);
        tissue.ln_melanosomes += 0.16 * knuckle * (1.0 - palm);
        tissue.ln_blood += 0.16 * space_noise(seed + 1, p / 11.0)
            + (0.10 + 0.10 * palm) * space_noise(seed + 2, p / 4.0)
            + 0.06 * space_noise(seed + 3, p / 1.8);
        tissue.ln_melanosomes +=
            (0.05 + 0.07 * self.old) * space_noise(seed + 4, p / 6.0) * (1.0 - palm);

        let crease = self.creases.sample(p, normal);
        let slack = self.slack.sample(p, normal);
        let dent = crease.core.max(slack.core);
        tissue.height_mm += 0.28 * crease.bank.max(slack.bank) - dent;
        tissue.light *= 1.0 - (0.40 * dent).min(0.38);
        tissue.ln_blood += 0.55 * dent;

        let vein = self.veins.sample(p, normal).core * (1.0 - palm);
        tissue.height_mm += 0.8 * self.old * vein;
        tissue.oxygen -= 0.3 * vein;
        tissue.ln_blood += 0.16 * vein;

        let spot = self.spots.sample(p, normal).core * (1.0 - palm);
        let ragged = 1.0 + 0.5 * space_noise(seed + 6, p / 1.2);
        tissue.ln_melanosomes += 0.95 * rise(0.15, 0.5, spot * ragged) * spot.min(1.0);

        // Back: a net of furrows that widens with age. Palm: ridges half a millimetre apart
        // are below a texel; they appear as a fine grain.
        let (first, second, _) = cells(seed + 11, p / (1.2 + 0.4 * self.old));
        let gap = (second - first) / 0.17;
        let furrow = ops::exp(-gap * gap);
        tissue.height_mm -= (1.0 - palm) * (0.05 + 0.045 * self.old) * furrow;
        tissue.height_mm -= palm * 0.025 * furrow;
        tissue.height_mm += 0.02 * space_noise(seed + 12, p / 2.4)
            + 0.05 * self.old * (1.0 - palm) * space_noise(seed + 13, p / 4.5)
            - 0.03 * (first - 0.5) * (1.0 - palm);
        tissue
    }
}
