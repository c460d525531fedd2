//! Expressive wrinkles (F&H section 3.1.2): the lines that contracting muscles bring forth, by
//! the cage's own coordinates; across the pull of the muscle, as all of them run.
//!
//! Three kinds, one a channel of the map, so that muscles side by side fold apart: see
//! [`Maps::wrinkles`](crate::figure::Maps::wrinkles). Where lines lie: Pessa and Rohrich,
//! "Facial Topography", 2012. Depths *designed*: a child's skin folds little, an old man's to
//! most of a millimetre, in folds wider than the fine lines that stay.

use raconteur_base::{DVec3, Side, ops};

use super::SkinParams;
use super::face_lines::Scribe;
use super::marks::Marks;
use super::texture::{cells, rise, space_noise};
use crate::generator::head::Places;

/// Where the chance of these lines begins, apart from those that stay.
const FIRST: u64 = 100_000;

/// Skin that the mentalis dimples: middle and radii on the mean head, mm.
const CHIN: [DVec3; 2] = [DVec3::new(0.0, -80.0, 99.0), DVec3::new(17.0, 11.0, 16.0)];
/// Distance between its dimples, mm.
const DIMPLES_MM: f64 = 3.6;

/// The expressive wrinkles of a face. Strengths are depths in mm.
pub(super) struct ExpressionMarks {
    kinds: [Marks; 3],
    /// Depth of the dimples of the chin, mm.
    dimples_mm: f64,
    seed: u64,
}

/// How deep a fold is when its muscle contracts fully, mm.
fn depth_mm(skin: &SkinParams) -> f64 {
    0.16 + 0.30 * rise(10.0, 32.0, skin.age_years) + 0.30 * rise(30.0, 75.0, skin.age_years)
}

impl ExpressionMarks {
    pub(super) fn new(skin: &SkinParams, places: &Places) -> Self {
        let deep = depth_mm(skin);
        let mut scribe = Scribe::new(places, skin, FIRST);
        forehead(&mut scribe, deep);
        let red = scribe.take();
        for side in Side::BOTH {
            glabella(&mut scribe, side, deep);
            crows_feet(&mut scribe, side, deep);
            cheek(&mut scribe, side, deep);
        }
        let green = scribe.take();
        nose_root(&mut scribe, deep);
        for side in Side::BOTH {
            bunny(&mut scribe, side, deep);
            lips(&mut scribe, side, deep);
        }
        let blue = scribe.take();
        Self {
            kinds: [red, green, blue],
            dimples_mm: 0.55 * deep,
            seed: skin.seed << 8,
        }
    }

    /// Heights of each kind at a place: on the mean head with its normal, and on this person.
    pub(super) fn heights_mm(&self, q: DVec3, p: DVec3, normal: DVec3) -> [f64; 3] {
        let mut heights = [0, 1, 2].map(|kind: usize| {
            let felt = self.kinds[kind].at(q, normal);
            // Skin that folds stands up beside the furrow.
            0.45 * felt.bank - felt.core
        });
        let d = (q - CHIN[0]) / CHIN[1];
        let share = rise(1.0, 0.35, d.length());
        if share > 0.0 {
            let wander = DVec3::new(
                space_noise(self.seed + 61, p / 4.0),
                space_noise(self.seed + 62, p / 4.0),
                0.0,
            );
            let (first, second, name) = cells(self.seed + 63, p / DIMPLES_MM + wander * 0.25);
            let pit = ops::exp(-(first / 0.36) * (first / 0.36)) * (0.45 + 0.55 * name);
            let between = rise(0.0, 0.5, second - first) - 0.5;
            heights[2] += self.dimples_mm * share * (0.25 * between - pit);
        }
        heights
    }
}

/// Across the forehead, from the hairline to above the brows: they dip between the brows and
/// outwards, as the muscle's two bellies pull.
fn forehead(scribe: &mut Scribe<'_>, deep: f64) {
    let lines = 5;
    for i in 0..lines {
        let row = 0.85 + 0.60 * f64::from(i) + scribe.between(-0.08, 0.08);
        let centre = 1.0 - (f64::from(i) - 2.3).abs() / 4.2;
        let strength = deep * centre * scribe.between(0.85, 1.1);
        let reach = 4.2 + 2.6 * centre;
        let (shift, beat) = (scribe.between(-0.6, 0.6), scribe.between(0.7, 1.3));
        let ends = [scribe.between(0.8, 1.0), scribe.between(0.8, 1.0)];
        let through: Vec<DVec3> = (0..=16)
            .map(|k| {
                let t = f64::from(k) / 16.0;
                let c = reach * (t * (ends[0] + ends[1]) - ends[0]);
                let dip = 0.16 * ops::exp(-(c / 1.6) * (c / 1.6)) + 0.30 * (c / 7.0) * (c / 7.0);
                let wave = 0.05 * ops::sin(beat * c + 4.0 * shift);
                scribe.grid(c, row + dip + wave)
            })
            .collect();
        scribe.line(Side::Left, &through, strength, 1.15, 0.15);
        // A short one between two long ones.
        let from = scribe.between(-4.5, 1.5);
        let to = from + scribe.between(1.6, 3.4);
        let short: Vec<DVec3> = (0..=6)
            .map(|k| {
                let c = from + (to - from) * f64::from(k) / 6.0;
                scribe.grid(c, row + 0.31 + 0.30 * (c / 7.0) * (c / 7.0))
            })
            .collect();
        scribe.line(Side::Left, &short, 0.45 * strength, 0.8, 0.1);
    }
}

/// Upright between the brows.
fn glabella(scribe: &mut Scribe<'_>, side: Side, deep: f64) {
    let (a, b) = (scribe.between(0.62, 0.85), scribe.between(0.8, 1.05));
    let top = scribe.between(2.7, 3.1);
    let through = [
        scribe.grid(b, top),
        scribe.grid(a, 3.9),
        scribe.grid(0.85 * a, 4.8),
        scribe.grid(0.8 * a, 5.5),
    ];
    scribe.line(side, &through, 1.1 * deep, 1.1, 0.05);
    let out = scribe.between(1.5, 1.8);
    let through = [
        scribe.grid(out + 0.3, top + 0.35),
        scribe.grid(out, 3.9),
        scribe.grid(out - 0.35, 4.5),
    ];
    scribe.line(side, &through, 0.5 * deep, 0.8, 0.1);
}

/// A fan from the outer corner of the eye, and what a squint lays under it.
fn crows_feet(scribe: &mut Scribe<'_>, side: Side, deep: f64) {
    for i in 0..5 {
        let fan = (f64::from(i) - 2.0) / 2.2 + scribe.between(-0.1, 0.1);
        let start = scribe.between(8.2, 8.6);
        let end = start + scribe.between(1.7, 2.8) * (1.0 - 0.25 * fan.abs());
        let row = 6.1 + 0.7 * fan;
        let fall = 1.3 * fan + 0.15 + scribe.between(-0.2, 0.2);
        let bow = scribe.between(-0.1, 0.15);
        let through = [
            scribe.grid(start, row),
            scribe.grid((start + end) / 2.0, row + 0.42 * fall + bow),
            scribe.grid(end, row + fall),
        ];
        let strength = 0.9 * deep * scribe.between(0.7, 1.05) * (1.0 - 0.25 * fan.abs());
        scribe.line(side, &through, strength, 0.75, 0.1);
    }
    for i in 0..4 {
        let ring = 0.35 + 0.62 * f64::from(i) + scribe.between(-0.1, 0.1);
        let (a, b) = (scribe.between(8.9, 9.8), scribe.between(12.2, 14.4));
        let through: Vec<DVec3> = (0..=6)
            .map(|k| scribe.places.eye(ring, a + (b - a) * f64::from(k) / 6.0))
            .collect();
        scribe.line(side, &through, 0.42 * deep, 0.6, 0.15);
    }
}

/// The furrow from the wing of the nose past the corner of the mouth, its parallels on the
/// cheek, and what goes on below the corner.
fn cheek(scribe: &mut Scribe<'_>, side: Side, deep: f64) {
    let through = [
        scribe.grid(3.75, 13.2),
        scribe.grid(4.35, 14.8),
        scribe.grid(4.85, 16.4),
        scribe.grid(5.25, 18.0),
        scribe.grid(5.35, 19.3),
    ];
    scribe.line(side, &through, 1.25 * deep, 1.6, 0.0);
    for i in 0..2 {
        let out = 6.1 + 0.8 * f64::from(i) + scribe.between(-0.1, 0.1);
        let (top, end) = (scribe.between(14.8, 15.8), scribe.between(18.8, 20.2));
        let through = [
            scribe.grid(out - 0.3, top),
            scribe.grid(out + 0.25, (top + end) / 2.0),
            scribe.grid(out, end),
        ];
        let strength = (0.62 - 0.22 * f64::from(i)) * deep;
        scribe.line(side, &through, strength, 1.2, 0.1);
    }
    let through = [
        scribe.grid(4.5, 19.3),
        scribe.grid(4.75, 20.5),
        scribe.grid(4.5, 22.2),
    ];
    scribe.line(side, &through, 0.8 * deep, 1.2, 0.05);
}

/// Across the root of the nose.
fn nose_root(scribe: &mut Scribe<'_>, deep: f64) {
    for i in 0..3 {
        let row = 5.35 + 0.62 * f64::from(i) + scribe.between(-0.1, 0.1);
        let reach = scribe.between(0.95, 1.25);
        let through: Vec<DVec3> = (0..=6)
            .map(|k| {
                let c = reach * (f64::from(k) / 3.0 - 1.0);
                scribe.grid(c, row - 0.25 * c * c)
            })
            .collect();
        let strength = deep * (0.9 - 0.18 * f64::from(i));
        scribe.line(Side::Left, &through, strength, 0.9, 0.05);
    }
}

/// From the bridge over the flank of the nose, down and outwards.
fn bunny(scribe: &mut Scribe<'_>, side: Side, deep: f64) {
    for i in 0..3 {
        let row = 7.5 + 0.75 * f64::from(i) + scribe.between(-0.12, 0.12);
        let end = scribe.between(2.2, 2.7);
        let through = [
            scribe.grid(0.55, row),
            scribe.grid(1.35, row + 0.45),
            scribe.grid(end, row + 1.25),
        ];
        let strength = deep * (0.75 - 0.12 * f64::from(i));
        scribe.line(side, &through, strength, 0.8, 0.1);
    }
}

/// Away from the lips, as a drawn purse folds.
fn lips(scribe: &mut Scribe<'_>, side: Side, deep: f64) {
    let mut k = 0.25;
    while k < 11.8 {
        // Beside the corners there are others.
        if !(4.9..7.1).contains(&k) {
            let lean = scribe.between(-0.15, 0.15);
            let out = scribe.between(0.0, 0.35);
            let through = [
                scribe.places.mouth(1.75, k),
                scribe.places.mouth(1.1, k + 0.3 * lean),
                scribe.places.mouth(0.7, k + 0.7 * lean),
                scribe.places.mouth(out, k + lean),
            ];
            let strength = 0.55 * deep * scribe.between(0.55, 1.05);
            scribe.line(side, &through, strength, 0.6, 0.05);
        }
        k += scribe.between(0.38, 0.62);
    }
}
