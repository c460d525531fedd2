//! Skin of head and neck: variation of blood, melanin and relief between its parts.
//!
//! Positions are on the mean head (mm; x left, y up, z front, origin between the tragions), so that
//! they follow every person's face.

use raconteur_base::{DVec3, ops};

use super::SkinParams;
use super::expression_lines::ExpressionMarks;
use super::face_lines::{FaceMarks, face_marks};
use super::params::INSIDE;
use super::tissue::Tissue;
use crate::atlas::Hit;
use crate::hair::Cap;
use crate::head::{Coordinates, HeadSheet, MOUTH_DEEP};
use crate::texture::{cells, mix, rise, space_noise};

/// Soft region of one half: its changes to the logarithms of blood and melanin and to the oxygen,
/// and the width of its pores.
struct Zone {
    at: [f64; 3],
    radius: [f64; 3],
    blood: f64,
    melanin: f64,
    oxygen: f64,
    pores: f64,
}

#[rustfmt::skip]
const fn zone(at: [f64; 3], radius: [f64; 3], blood: f64, melanin: f64, oxygen: f64, pores: f64) -> Zone {
    Zone { at, radius, blood, melanin, oxygen, pores }
}

/// Regions after the distribution of haemoglobin and melanin over the face (Jimenez et al.
/// 2010, doi:10.1145/1882261.1866167, haemoglobin maps of faces; strengths *designed*).
#[rustfmt::skip]
const ZONES: [Zone; 18] = [
    // Apple of the cheek and its flank, tip of the nose, ala, bridge.
    zone([45.0, -8.0, 82.0], [15.0, 12.0, 15.0], 0.50, 0.00, 0.06, 0.55),
    zone([58.0, -12.0, 66.0], [14.0, 15.0, 16.0], 0.26, 0.03, 0.04, 0.1),
    zone([0.0, -12.0, 118.0], [12.0, 9.0, 14.0], 0.52, 0.00, 0.05, 1.0),
    zone([17.0, -20.0, 99.0], [6.5, 7.0, 7.0], 0.55, 0.02, 0.03, 1.0),
    zone([0.0, 12.0, 104.0], [8.0, 16.0, 14.0], 0.16, 0.03, 0.02, 0.3),
    // Chin, forehead, temple.
    zone([0.0, -82.0, 100.0], [15.0, 9.0, 14.0], 0.32, 0.00, 0.03, 0.5),
    zone([0.0, 64.0, 92.0], [46.0, 20.0, 40.0], -0.05, 0.10, 0.00, 0.25),
    zone([66.0, 34.0, 58.0], [12.0, 16.0, 16.0], -0.16, 0.02, -0.04, 0.0),
    // Thin skin under the eye with slow blood, inner corner, upper lid, under the brow.
    zone([29.0, 6.0, 86.0], [14.0, 5.5, 10.0], 0.18, 0.16, -0.12, -0.6),
    zone([15.0, 18.0, 90.0], [6.0, 8.0, 9.0], 0.30, 0.10, -0.10, -0.4),
    zone([31.0, 31.0, 86.0], [15.0, 6.0, 11.0], 0.16, 0.00, 0.02, -0.6),
    zone([36.0, 42.0, 90.0], [16.0, 4.0, 9.0], 0.06, 0.00, 0.02, 0.0),
    // Ear, fold next to the mouth, skin around the mouth, side of the jaw.
    zone([84.0, 4.0, -10.0], [14.0, 34.0, 24.0], 0.62, 0.00, 0.08, -0.3),
    zone([27.0, -28.0, 93.0], [4.5, 9.0, 8.0], 0.30, 0.04, 0.00, 0.3),
    zone([0.0, -36.0, 104.0], [20.0, 6.0, 12.0], 0.10, 0.04, 0.00, 0.1),
    zone([32.0, -66.0, 86.0], [24.0, 14.0, 22.0], -0.20, 0.02, -0.03, 0.0),
    // Under the jaw no sun, front of the neck some flush.
    zone([0.0, -104.0, 60.0], [44.0, 12.0, 34.0], -0.10, -0.14, 0.00, -0.1),
    zone([0.0, -140.0, 44.0], [34.0, 22.0, 40.0], 0.20, 0.00, 0.04, -0.2),
];

/// Ends of the sternomastoid on the left, from the skull behind the ear to the breastbone.
const CORD: [DVec3; 2] = [DVec3::new(66.0, -48.0, 2.0), DVec3::new(14.0, -160.0, 50.0)];
/// Height and half width of that cord at its most prominent point, mm; *designed*.
const CORD_MM: [f64; 2] = [1.5, 8.0];
/// Shaded hollows, for which the mesh is too coarse: corner of the mouth, groove behind the ala.
/// Radius in mm and share of light lost; *designed*.
const HOLLOWS: [([f64; 3], [f64; 3], f64); 2] = [
    ([27.0, -48.6, 90.5], [2.2, 1.6, 4.0], 0.16),
    ([21.5, -17.0, 93.0], [2.2, 7.0, 6.0], 0.14),
];

/// Lash roots and liner.
const LASH: [f64; 3] = [0.055, 0.032, 0.026];

/// Painter of a face's skin: marks, wrinkles and zones of a head.
pub(super) struct FacePainter<'a> {
    skin: &'a SkinParams,
    sheet: &'a HeadSheet,
    marks: FaceMarks,
    expression: Option<ExpressionMarks>,
    base: Tissue,
    /// Age from 0 young to 1 old, for slow changes.
    old: f64,
    /// Hair painted on the scalp.
    cap: Option<&'a Cap>,
    /// Tint of the skin under dark brows.
    brow_stain: f64,
}

fn darkness(rgb: [f64; 3]) -> f64 {
    let luma = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    1.0 - rise(0.05, 0.45, luma)
}

impl HeadSheet {
    pub(super) fn painter<'a>(
        &'a self,
        skin: &'a SkinParams,
        cap: Option<&'a Cap>,
    ) -> FacePainter<'a> {
        FacePainter {
            cap,
            skin,
            sheet: self,
            marks: self
                .places
                .map_or_else(FaceMarks::default, |p| face_marks(skin, p, self)),
            expression: self.places.map(|p| ExpressionMarks::new(skin, p)),
            base: Tissue::new(skin),
            old: rise(28.0, 78.0, skin.age_years),
            brow_stain: darkness(self.brow_colour),
        }
    }
}

/// Position of a texel in all frames of reference.
struct TexelFrames {
    /// Position on the mean head, millimetres.
    on_mean: DVec3,
    /// Position on this head, millimetres.
    on_own: DVec3,
    /// Normal of this head's skin.
    normal: DVec3,
}

impl FacePainter<'_> {
    pub(super) fn tissue(&self, t: [u32; 3], hit: &Hit) -> Tissue {
        let s = self.sheet;
        let q = hit.blend(t.map(|v| s.mean[v as usize]));
        let p = hit.blend(t.map(|v| s.at[v as usize]));
        let normal = hit
            .blend(t.map(|v| s.normals[v as usize]))
            .normalize_or_zero();
        let ring = |f: fn(&Coordinates) -> f64| hit.blend(t.map(|v| f(&s.rings[v as usize])));
        let (mouth, eye, nostril, ear) = (
            ring(|c| c.mouth),
            ring(|c| c.eye),
            ring(|c| c.nostril),
            ring(|c| c.ear),
        );
        let upper = ring(|c| c.eye_upper);
        let brow = hit.blend(t.map(|v| s.brow[v as usize])).clamp(0.0, 1.0);

        let mut tissue = self.base;
        let half = DVec3::new(q.x.abs(), q.y, q.z);
        let mut pores = 0.35;
        for z in &ZONES {
            let d = (half - DVec3::from_array(z.at)) / DVec3::from_array(z.radius);
            let d2 = d.length_squared();
            if d2 < 12.0 {
                let share = ops::exp(-0.5 * d2) * self.skin.contrast;
                tissue.ln_blood += z.blood * share;
                tissue.ln_melanosomes += z.melanin * share;
                tissue.oxygen += z.oxygen * share;
                pores += z.pores * ops::exp(-0.5 * d2);
            }
        }
        let seed = self.skin.seed << 8;
        self.mottle(&mut tissue, p, seed);
        let spot = TexelFrames {
            on_mean: q,
            on_own: p,
            normal,
        };
        self.scattered(&mut tissue, &spot, seed);

        // Lips: thin skin without melanin's veil over dense vessels.
        let edge = 0.10 * space_noise(seed + 21, p / 1.3);
        let corner = DVec3::new(25.6, -48.4, 91.8);
        let fade = 1.0 - 0.7 * ops::exp(-(half - corner).length_squared() / (2.0 * 2.6 * 2.6));
        let lip = rise(0.55, 1.75, mouth + 1.6 * edge) * fade;
        self.lip(&mut tissue, lip, p, seed);
        // Redder and darker where the lips roll in, up to their contact line.
        tissue.ln_blood += 0.35 * rise(2.2, 4.2, mouth) * fade;
        tissue.light *= 1.0 - 0.3 * rise(2.8, 4.6, mouth);
        // A pale line where the red begins.
        tissue.ln_blood -= 0.08 * ops::exp(-((mouth - 0.72) / 0.26) * ((mouth - 0.72) / 0.26));

        let lid = rise(0.6, 2.0, eye);
        let smoothness = (1.0 - lip) * (1.0 - 0.6 * lid) * (1.0 - rise(0.4, 2.0, nostril));
        self.relief(&mut tissue, &spot, pores * smoothness, smoothness, seed);
        if self.skin.beard > 0.0 {
            self.beard(&mut tissue, half, p, seed, (1.0 - lip) * (1.0 - lid));
        }

        // Lash edge, wet margin, the inside of nose and mouth, the ear's hollow.
        let lash = rise(4.1, 4.8, eye) * (1.0 - rise(5.15, 5.7, eye));
        let line = if upper > 0.0 { 1.0 } else { 0.34 };
        tissue.blend(LASH, lash * line * self.skin.lash_line);
        let wet = rise(5.2, 5.9, eye);
        tissue.ln_blood += 1.3 * wet;
        tissue.ln_melanosomes -= 0.6 * wet;
        tissue.blend(INSIDE, rise(0.55, 2.2, nostril) * 0.94);
        tissue.ln_blood += 0.35 * rise(6.5, 9.0, ear);
        tissue.light *= 1.0 - 0.3 * rise(7.5, 9.5, ear);
        tissue.blend(MOUTH_DEEP, rise(4.5, 5.6, mouth));
        for (at, radius, lost) in HOLLOWS {
            let d = (half - DVec3::from_array(at)) / DVec3::from_array(radius);
            tissue.light *= 1.0 - lost * ops::exp(-0.5 * d.length_squared());
        }
        tissue.height_mm += self.cord(half);
        if let Some(expression) = &self.expression {
            // Neither under the brows nor behind the lashes.
            let bare = (1.0 - brow) * (1.0 - rise(3.2, 4.2, eye)) * (1.0 - rise(0.3, 1.5, nostril));
            let [red, green, blue] = expression.heights_mm(q, p, normal).map(|h| h * bare);
            // The furrows of the cheek end before the lips.
            let off_lips = 1.0 - rise(0.05, 0.6, mouth);
            tissue.folds_mm = [red, green * off_lips, blue * (1.0 - rise(1.2, 2.2, mouth))];
        }

        // Short fine hairs without geometry of their own; pale ones are less visible.
        tissue.blend(s.brow_colour, brow * (0.30 + 0.34 * self.brow_stain));
        if let Some((rgb, share)) = self.cap.and_then(|c| c.sample(p * 1e-3)) {
            tissue.blend(rgb, share);
        }
        tissue
    }

    /// Returns the height of the sternomastoid under the skin, mm; 0 for children.
    fn cord(&self, half: DVec3) -> f64 {
        let [from, to] = CORD;
        let axis = to - from;
        let t = (half - from).dot(axis) / axis.length_squared();
        let d = (half - from - axis * t.clamp(0.0, 1.0)).length() / CORD_MM[1];
        let shown = rise(10.0, 22.0, self.skin.age_years) * (0.8 + 0.5 * self.old);
        CORD_MM[0] * shown * rise(0.05, 0.4, t) * ops::exp(-d * d)
    }

    /// Adds irregular mottling; it grows with age and sun.
    fn mottle(&self, tissue: &mut Tissue, p: DVec3, seed: u64) {
        let wide = space_noise(seed + 1, p / 13.0);
        let middle = space_noise(seed + 2, p / 5.0);
        let fine = space_noise(seed + 3, p / 1.9);
        let k = 1.0 + 0.9 * self.old;
        tissue.ln_blood += k * (0.15 * wide + 0.13 * middle + 0.10 * fine);
        let brown = space_noise(seed + 4, p / 8.0);
        let brown_fine = space_noise(seed + 5, p / 2.7);
        let k = 1.0 + 1.6 * self.skin.sun;
        tissue.ln_melanosomes += k * (0.07 * brown + 0.07 * brown_fine);
        // Old skin is paler and yellower: fewer vessels, a browner film.
        tissue.ln_blood -= 0.12 * self.old;
        tissue.ln_melanosomes += 0.08 * self.old;
    }

    /// Freckles, moles, age spots and widened vessels.
    fn scattered(&self, tissue: &mut Tissue, at: &TexelFrames, seed: u64) {
        let (q, normal) = (at.on_mean, at.normal);
        let ragged = 1.0 + 0.5 * space_noise(seed + 6, at.on_own / 1.2);
        let freckle = self.marks.freckles.sample(q, normal).core;
        tissue.ln_melanosomes += 0.75 * (freckle * ragged).min(1.2);
        let spot = self.marks.spots.sample(q, normal).core;
        tissue.ln_melanosomes += 0.95 * rise(0.15, 0.5, spot * ragged) * spot.min(1.0);
        let mole = self.marks.moles.sample(q, normal).core;
        tissue.ln_melanosomes += 1.9 * rise(0.15, 0.75, mole);
        tissue.height_mm += 0.25 * rise(0.1, 0.9, mole);
        let vessel = self.marks.vessels.sample(q, normal).core;
        tissue.ln_blood += 0.8 * vessel * (0.7 + 0.3 * ragged);
    }

    fn lip(&self, tissue: &mut Tissue, lip: f64, p: DVec3, seed: u64) {
        if lip <= 0.0 {
            return;
        }
        let own = ops::ln(0.016 + 0.068 * self.skin.lips) - 0.3 * self.skin.since(45.0);
        let streak = space_noise(seed + 22, DVec3::new(p.x / 0.8, p.y / 5.0, p.z / 5.0));
        tissue.ln_blood += (own + 0.12 * streak - tissue.ln_blood) * lip;
        tissue.ln_melanosomes -= 0.25 * lip;
        tissue.oxygen += (0.72 - tissue.oxygen) * lip;
        tissue.height_mm += 0.025 * streak * lip;
    }

    /// Wrinkles, the fine net of furrows, pores.
    fn relief(&self, tissue: &mut Tissue, at: &TexelFrames, pores: f64, net: f64, seed: u64) {
        let p = at.on_own;
        let wrinkle = self.marks.wrinkles.sample(at.on_mean, at.normal);
        tissue.height_mm += 0.3 * wrinkle.bank - wrinkle.core;
        // The furrow receives less light, and that light passes through blood.
        tissue.light *= 1.0 - (0.5 * wrinkle.core).min(0.4);
        tissue.ln_blood += 0.5 * wrinkle.core;
        // Furrows of the net run 0.6 to 1.5 mm apart and widen with age (*designed*).
        let spacing = 1.15 + 0.35 * self.old;
        let (first, second, name) = cells(seed + 11, p / spacing);
        let gap = (second - first) / 0.16;
        let furrow = ops::exp(-gap * gap);
        let depth = 0.04 + 0.035 * self.old;
        tissue.height_mm -= depth * net * furrow;
        let pore = ops::exp(-(first / 0.2) * (first / 0.2)) * rise(0.25, 0.6, name);
        let wide = pores.max(0.0) * (1.0 + 0.5 * self.old);
        tissue.height_mm -= 0.11 * wide * pore;
        tissue.light *= 1.0 - 0.12 * wide * pore;
        tissue.height_mm += net
            * (0.04 * space_noise(seed + 12, p / 2.2)
                + 0.09 * self.old * space_noise(seed + 13, p / 4.3));
    }

    /// Adds beard stubble: lip, chin, jaw and below.
    fn beard(&self, tissue: &mut Tissue, half: DVec3, p: DVec3, seed: u64, open: f64) {
        let ragged = 3.0 * space_noise(seed + 41, p / 9.0);
        // The upper border runs from the ear's lobe to the corner of the mouth.
        let border = -24.0 - (76.0 - half.x).clamp(0.0, 44.0) * 0.52;
        let cheek = rise(4.0, -8.0, half.y - border + ragged) * rise(4.0, 16.0, half.z);
        let moustache = rise(-23.0, -29.0, half.y + 0.4 * ragged)
            * rise(
                5.0,
                -5.0,
                half.x - 22.0 - 0.75 * (-27.0 - half.y).max(0.0) + ragged,
            )
            * rise(70.0, 84.0, half.z);
        let neck = rise(-134.0, -112.0, half.y + ragged);
        let area = cheek.max(moustache) * neck * open;
        if area <= 0.0 {
            return;
        }
        let (first, _, name) = cells(seed + 42, p / 0.95);
        let root = ops::exp(-(first / 0.3) * (first / 0.3)) * (0.5 + 0.5 * name);
        let share = self.skin.beard * area;
        let shade = mix(self.skin.beard_colour, [0.16, 0.13, 0.12], 0.35);
        tissue.blend(shade, share * (0.16 + 0.42 * root));
        tissue.height_mm += 0.04 * share * root;
        let short = self.skin.short_beard * area;
        if short > 0.0 {
            // Hairs point downwards: streaks longer than wide.
            let hair = space_noise(seed + 43, DVec3::new(p.x / 0.55, p.y / 2.6, p.z / 1.1));
            let tuft = space_noise(seed + 44, DVec3::new(p.x / 2.4, p.y / 5.0, p.z / 3.0));
            let light = 0.88 + 0.16 * hair + 0.10 * tuft;
            tissue.blend(
                self.skin.beard_colour.map(|x| x * light),
                short * (0.88 + 0.12 * hair).min(1.0),
            );
            tissue.height_mm += 0.10 * short * hair;
        }
    }
}
