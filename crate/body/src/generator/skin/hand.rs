//! Skin of the hand: a red palm without melanin, darker knuckles, veins in age.

use raconteur_base::{DVec3, ops};

use super::SkinParams;
use super::bake::Tissue;
use super::marks::Marks;
use super::raster::Hit;
use super::texture::{cells, rise, space_noise};

/// The hand's skin as the baking needs it. Both hands share it as mirror images.
#[derive(Clone, Debug, Default)]
pub(crate) struct HandSheet {
    /// Place of each vertex in the atlas, 0..1.
    pub(crate) uv: Vec<[f64; 2]>,
    /// Triangles.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Right hand in the frame of its anatomy (radial, distal, palmar), mm.
    pub(crate) at: Vec<DVec3>,
    /// Unit normals.
    pub(crate) normals: Vec<DVec3>,
    /// What the anatomy says of each vertex.
    pub(crate) regions: Vec<HandRegion>,
    /// Lines that every hand has: depth in mm.
    pub(crate) creases: Vec<HandLine>,
    /// Lines of slack and old skin, drawn by age.
    pub(crate) slack: Vec<HandLine>,
    /// Courses of the veins on the back.
    pub(crate) veins: Vec<HandLine>,
}

/// A line on the hand.
#[derive(Clone, Debug)]
pub(crate) struct HandLine {
    /// Places on the surface, mm.
    pub(crate) through: Vec<DVec3>,
    /// Depth or strength.
    pub(crate) strength: f64,
    /// Half width, mm.
    pub(crate) width: f64,
    /// Share of its length lost to gaps.
    pub(crate) broken: f64,
}

/// Shares of a vertex, 0..1.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct HandRegion {
    /// Palm and inner side of the fingers.
    pub(crate) palm: f64,
    /// Fingertip, inner side.
    pub(crate) tip: f64,
    /// Over a joint on the back.
    pub(crate) knuckle: f64,
    /// Around a nail.
    pub(crate) nail: f64,
    /// Balls of the thumb and the little finger, heads of the metacarpals.
    pub(crate) cushion: f64,
}

impl HandRegion {
    fn to_array(self) -> [f64; 5] {
        [self.palm, self.tip, self.knuckle, self.nail, self.cushion]
    }
}

/// A hand that is about to be painted.
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
        let slack = 0.25 + 0.75 * skin.since(30.0);
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
        // The palm has a thick clear horn layer and a fifth of the melanin (Jacques 1998).
        tissue.ln_melanosomes -= (0.55 + 1.1 * self.skin.melanin) * palm;
        tissue.ln_melanosomes += 0.10 * (1.0 - palm);
        tissue.ln_blood += k * palm * (0.05 + 0.5 * cushion + 0.55 * tip);
        tissue.ln_blood += k * (0.34 * knuckle + 0.40 * nail) * (1.0 - 0.5 * palm);
        tissue.ln_melanosomes += 0.16 * knuckle * (1.0 - palm);
        tissue.ln_blood += 0.16 * space_noise(seed + 1, p / 11.0)
            + (0.10 + 0.10 * palm) * space_noise(seed + 2, p / 4.0)
            + 0.06 * space_noise(seed + 3, p / 1.8);
        tissue.ln_melanosomes +=
            (0.05 + 0.07 * self.old) * space_noise(seed + 4, p / 6.0) * (1.0 - palm);

        let crease = self.creases.at(p, normal);
        let slack = self.slack.at(p, normal);
        let dent = crease.core.max(slack.core);
        tissue.height_mm += 0.28 * crease.bank.max(slack.bank) - dent;
        tissue.light *= 1.0 - (0.40 * dent).min(0.38);
        tissue.ln_blood += 0.55 * dent;

        let vein = self.veins.at(p, normal).core * (1.0 - palm);
        tissue.height_mm += 0.55 * self.old * vein;
        tissue.oxygen -= 0.22 * vein;
        tissue.ln_blood += 0.16 * vein;

        let spot = self.spots.at(p, normal).core * (1.0 - palm);
        let ragged = 1.0 + 0.5 * space_noise(seed + 6, p / 1.2);
        tissue.ln_melanosomes += 0.7 * rise(0.18, 0.6, spot * ragged) * spot.min(1.0);

        // Back: a net of furrows that widens with age. Palm: ridges half a millimetre apart
        // are below a texel; what is seen of them is a fine grain.
        let (first, second, _) = cells(seed + 11, p / (1.2 + 0.4 * self.old));
        let gap = (second - first) / 0.17;
        let furrow = ops::exp(-gap * gap);
        tissue.height_mm -= (1.0 - palm) * (0.028 + 0.03 * self.old) * furrow;
        tissue.height_mm -= palm * 0.012 * furrow;
        tissue.height_mm += 0.02 * space_noise(seed + 12, p / 2.4)
            + 0.05 * self.old * (1.0 - palm) * space_noise(seed + 13, p / 4.5)
            - 0.03 * (first - 0.5) * (1.0 - palm);
        tissue
    }
}
