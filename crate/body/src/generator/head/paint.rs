//! Colour of the skin: base tone, redder and browner zones, lips and lids. All colours are linear RGB; zones chosen by eye after the
//! distribution of haemoglobin and melanin in the face.

use raconteur_base::{DVec3, noise, ops};

use super::HeadColours;
use super::rig::smooth;

/// Smooth coordinates of the surface that zones are read from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coordinates {
    /// Position, mm.
    pub(crate) at: DVec3,
    /// Ring number at the mouth, 0 outside.
    pub(crate) mouth: f64,
    /// Ring number at the eye.
    pub(crate) eye: f64,
    /// 1 on the upper half of the eye's rings, −1 on the lower.
    pub(crate) eye_upper: f64,
    /// Ring number at the nostril.
    pub(crate) nostril: f64,
    /// Ring number at the ear.
    pub(crate) ear: f64,
}

struct Zone {
    at: [f64; 3],
    radius: [f64; 3],
    share: f64,
    tint: [f64; 3],
}

const fn zone(at: [f64; 3], radius: [f64; 3], share: f64, tint: [f64; 3]) -> Zone {
    Zone {
        at,
        radius,
        share,
        tint,
    }
}

/// Gaussian zones on one half, in the unshifted head's frame, mm.
#[rustfmt::skip]
const ZONES: [Zone; 15] = [
    // Cheek, nose tip, ala.
    zone([47.0, -9.0, 82.0], [17.0, 13.0, 15.0], 0.46, [1.04, 0.79, 0.76]),
    zone([0.0, -12.0, 118.0], [11.0, 9.0, 14.0], 0.62, [1.04, 0.76, 0.72]),
    zone([17.0, -20.0, 99.0], [6.0, 6.0, 6.0], 0.55, [1.0, 0.74, 0.71]),
    // Chin, forehead (yellower), under the eye (darker), upper lid, ear.
    zone([0.0, -82.0, 100.0], [16.0, 10.0, 14.0], 0.45, [1.03, 0.84, 0.81]),
    zone([0.0, 66.0, 92.0], [45.0, 18.0, 40.0], 0.6, [1.0, 1.0, 0.90]),
    zone([24.0, 7.0, 85.0], [9.0, 5.0, 9.0], 0.45, [0.88, 0.78, 0.82]),
    zone([31.0, 31.0, 86.0], [13.0, 6.0, 10.0], 0.55, [0.93, 0.80, 0.78]),
    zone([84.0, 4.0, -10.0], [14.0, 30.0, 22.0], 0.85, [1.06, 0.75, 0.71]),
    // Philtrum and the skin about the mouth, side of the jaw (paler), inner corner.
    zone([0.0, -36.0, 104.0], [24.0, 7.0, 12.0], 0.35, [0.98, 0.88, 0.86]),
    zone([30.0, -70.0, 88.0], [26.0, 16.0, 24.0], 0.35, [0.95, 0.96, 0.98]),
    zone([12.0, 24.0, 94.0], [7.0, 8.0, 9.0], 0.3, [0.95, 0.87, 0.88]),
    zone([0.0, -120.0, 30.0], [60.0, 25.0, 60.0], 0.4, [0.95, 0.92, 0.90]),
    // Nasolabial fold and temple.
    zone([26.0, -28.0, 93.0], [4.0, 8.0, 7.0], 0.3, [0.96, 0.84, 0.83]),
    zone([62.0, 36.0, 60.0], [10.0, 14.0, 12.0], 0.3, [0.97, 0.95, 0.98]),
    // Under the brow.
    zone([34.0, 41.0, 90.0], [16.0, 4.0, 9.0], 0.35, [0.95, 0.90, 0.88]),
];

fn mix(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    core::array::from_fn(|i| a[i] + (b[i] - a[i]) * t)
}

fn tint(a: [f64; 3], t: [f64; 3], share: f64) -> [f64; 3] {
    core::array::from_fn(|i| a[i] * (1.0 + (t[i] - 1.0) * share))
}

/// Smooth value noise in space, −1..1, one cell per unit.
pub(crate) fn space_noise(seed: u64, p: DVec3) -> f64 {
    let cell = p.floor();
    let f = p - cell;
    let s = f * f * (3.0 - 2.0 * f);
    let mut sum = 0.0;
    for corner in 0..8u64 {
        let o = DVec3::new(
            (corner & 1) as f64,
            (corner >> 1 & 1) as f64,
            (corner >> 2) as f64,
        );
        let c = cell + o;
        // Coordinates stay far below 2^20 cells.
        let id = ((c.x as i64 & 0xF_FFFF) << 20 | (c.y as i64 & 0xF_FFFF)) as u64;
        let w = (DVec3::ONE - o - s) * (1.0 - 2.0 * o);
        sum += noise::signed(seed, id, c.z as i64) * (w.x * w.y * w.z).abs();
    }
    sum
}

/// The colour of the skin at a place. `warp` carries zones from the unshifted head.
pub(crate) struct Painter<'a> {
    colours: &'a HeadColours,
    zones: Vec<(DVec3, &'static Zone)>,
    lip_corner: DVec3,
}

impl<'a> Painter<'a> {
    pub(crate) fn new(colours: &'a HeadColours, warp: impl Fn(DVec3) -> DVec3) -> Self {
        let zones = ZONES
            .iter()
            .map(|z| (warp(DVec3::from_array(z.at)), z))
            .collect();
        Self {
            colours,
            zones,
            lip_corner: warp(DVec3::new(25.6, -48.4, 91.8)),
        }
    }

    /// `brow` is the share that the brow covers, 0..1.
    pub(crate) fn colour(&self, c: &Coordinates, brow: f64) -> [f64; 3] {
        let own = self.colours;
        let p = DVec3::new(c.at.x.abs(), c.at.y, c.at.z);
        let mut rgb = own.skin;
        for (at, z) in &self.zones {
            let d = (p - *at) / DVec3::from_array(z.radius);
            let share = z.share * ops::exp(-0.5 * d.length_squared());
            rgb = tint(rgb, z.tint, share * own.flush);
        }
        // Blotches of a few millimetres to a centimetre keep the tone from looking sprayed.
        let wide = space_noise(1, c.at / 9.0) + 0.5 * space_noise(2, c.at / 4.0);
        let fine = space_noise(3, c.at / 1.7);
        rgb = tint(rgb, [1.02, 0.955, 0.955], wide + 0.35 * fine);
        // Sparse faint freckles over nose and cheeks.
        let freckle = smooth(0.62, 0.8, space_noise(5, c.at / 1.5))
            * ops::exp(-(((p.y + 2.0) / 14.0) * ((p.y + 2.0) / 14.0)))
            * smooth(70.0, 90.0, p.z);
        rgb = tint(rgb, [0.86, 0.76, 0.68], freckle * own.freckles);
        rgb = mix(rgb, own.brow, 0.5 * brow);
        rgb = self.lip(rgb, c, p);
        // Lids: lash edge and inner margin.
        let lash_edge = smooth(4.05, 4.75, c.eye) * (1.0 - smooth(5.3, 5.9, c.eye));
        let line = if c.eye_upper > 0.0 {
            own.lash_line
        } else {
            0.35 * own.lash_line
        };
        rgb = tint(rgb, [0.22, 0.15, 0.14], lash_edge * line);
        rgb = mix(rgb, [0.42, 0.17, 0.14], smooth(5.3, 6.0, c.eye));
        rgb = mix(rgb, [0.14, 0.05, 0.04], smooth(0.7, 2.2, c.nostril));
        rgb = tint(rgb, [0.86, 0.72, 0.70], smooth(7.0, 9.0, c.ear));
        rgb.map(|x| x.clamp(0.004, 0.95))
    }

    fn lip(&self, rgb: [f64; 3], c: &Coordinates, p: DVec3) -> [f64; 3] {
        let own = self.colours;
        let d = (p - self.lip_corner).length_squared();
        let fade = 1.0 - 0.75 * ops::exp(-d / (2.0 * 2.8 * 2.8));
        let red = mix(own.skin, own.lip, own.lip_strength);
        // Faint vertical creases of the red.
        let crease = 1.0 + 0.05 * space_noise(7, DVec3::new(c.at.x / 0.9, c.at.y / 6.0, 0.0));
        let red = red.map(|x| x * crease);
        let out = mix(rgb, red, smooth(0.78, 1.45, c.mouth) * fade);
        let deep = own.lip.map(|x| x * 0.68);
        mix(
            mix(out, deep, smooth(3.4, 4.4, c.mouth)),
            [0.16, 0.04, 0.035],
            smooth(4.6, 5.6, c.mouth),
        )
    }
}
