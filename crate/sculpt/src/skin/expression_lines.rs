//! Expressive wrinkles (F&H section 3.1.2): the lines caused by contracting muscles, in the cage's
//! own coordinates and perpendicular to the pull of the muscle.
//!
//! Three kinds, one per channel of the map, so that adjacent muscles fold separately: see
//! [`Maps::wrinkles`](raconteur_body::figure::TextureMaps::wrinkles). Positions of lines: Pessa and
//! Rohrich, "Facial Topography", 2012. Depths *designed*: a child's skin folds little, an old man's
//! to most of a millimetre, in folds wider than the permanent fine lines.

use raconteur_base::{DVec3, Side, ops};

use super::SkinParams;
use super::face_lines::Scribe;
use super::marks::{Marks, Pen};
use crate::head::Places;
use crate::texture::{rise, space_noise};

/// First random stream of these lines, separate from the permanent ones.
const FIRST: u64 = 100_000;

/// Skin that the mentalis dimples: middle and radii on the mean head, mm.
const CHIN: [DVec3; 2] = [DVec3::new(0.0, -79.0, 98.0), DVec3::new(20.0, 13.0, 18.0)];
/// Minimum depth of the folds of the nose, mm.
const MIN_NOSE_MM: f64 = 0.26;
/// Size of its dimples, mm.
const DIMPLES_MM: f64 = 2.7;

/// Expressive wrinkles of a face, which appear when muscles contract. Strengths are depths in mm.
pub(super) struct ExpressionMarks {
    kinds: [Marks; 3],
    /// Depth of the dimples of the chin, mm.
    dimples_mm: f64,
    seed: u64,
}

/// Returns the depth of a fold at full contraction of its muscle, mm.
fn depth_mm(skin: &SkinParams) -> f64 {
    0.16 + 0.30 * rise(10.0, 32.0, skin.age_years) + 0.30 * rise(30.0, 75.0, skin.age_years)
}

impl ExpressionMarks {
    pub(super) fn new(skin: &SkinParams, places: &Places) -> Self {
        let deep = depth_mm(skin);
        let mut scribe = Scribe::new(places, skin, FIRST);
        forehead(&mut scribe, deep);
        let red = scribe.take_marks();
        for side in Side::BOTH {
            glabella(&mut scribe, side, deep);
            crows_feet(&mut scribe, side, deep);
            cheek(&mut scribe, side, deep);
        }
        let green = scribe.take_marks();
        // A nose wrinkles at any age.
        let nose = deep.max(MIN_NOSE_MM);
        nose_root(&mut scribe, nose);
        for side in Side::BOTH {
            bunny(&mut scribe, side, nose);
            lips(&mut scribe, side, deep);
        }
        let blue = scribe.take_marks();
        Self {
            kinds: [red, green, blue],
            dimples_mm: 0.60 * deep,
            seed: skin.seed << 8,
        }
    }

    /// Returns the heights of each kind at a position: on the mean head with its normal, and on
    /// this person.
    pub(super) fn heights_mm(&self, q: DVec3, p: DVec3, normal: DVec3) -> [f64; 3] {
        let mut heights = [0, 1, 2].map(|kind: usize| {
            let felt = self.kinds[kind].sample(q, normal);
            // Folding skin rises next to the furrow.
            0.45 * felt.bank - felt.core
        });
        let d = (q - CHIN[0]) / CHIN[1];
        let share = rise(1.0, 0.25, d.length());
        if share > 0.0 {
            // Soft pits of uneven size, as the short bundles of the muscle pull the skin in.
            let wide = space_noise(self.seed + 61, p / DIMPLES_MM);
            let fine = space_noise(self.seed + 62, p / (0.45 * DIMPLES_MM));
            let pit = rise(-0.15, 0.75, wide + 0.35 * fine);
            heights[2] -= self.dimples_mm * share * (pit - 0.25);
        }
        heights
    }
}

/// Draws an expressive fold: like a permanent line, but smooth and unbroken, because the skin
/// between folds stays in one piece.
fn fold(scribe: &mut Scribe<'_>, side: Side, through: &[DVec3], strength: f64, width: f64) {
    scribe.draw(
        side,
        through,
        Pen {
            strength,
            width,
            wander: 0.12 + 0.14 * width,
            broken: 0.0,
            unsteady: 0.18,
            seed: 0,
        },
    );
}

/// Across the forehead, from the hairline to above the brows: they dip between the brows and
/// outwards, as the muscle's two bellies pull.
fn forehead(scribe: &mut Scribe<'_>, deep: f64) {
    for i in 0..4 {
        let row = 0.90 + 0.82 * f64::from(i) + scribe.between(-0.10, 0.10);
        // The middle ones are the longest and the deepest.
        let centre = 1.0 - (f64::from(i) - 1.6).abs() / 4.0;
        let strength = deep * centre * scribe.between(0.95, 1.15);
        let reach = 4.6 + 3.6 * centre;
        let (shift, beat) = (scribe.between(-0.6, 0.6), scribe.between(0.5, 0.9));
        let ends = [scribe.between(0.75, 1.0), scribe.between(0.75, 1.0)];
        let through: Vec<DVec3> = (0..=16)
            .map(|k| {
                let t = f64::from(k) / 16.0;
                let c = reach * (t * (ends[0] + ends[1]) - ends[0]);
                let dip = 0.20 * ops::exp(-(c / 1.8) * (c / 1.8)) + 0.34 * (c / 7.0) * (c / 7.0);
                let wave = 0.09 * ops::sin(beat * c + 4.0 * shift);
                scribe.grid(c, row + dip + wave)
            })
            .collect();
        fold(scribe, Side::Left, &through, strength, 1.35);
        // Some fork: a short one leaves a long one.
        let from = scribe.between(-5.0, 2.5);
        let to = from + scribe.between(1.5, 2.5);
        let short: Vec<DVec3> = (0..=6)
            .map(|k| {
                let t = f64::from(k) / 6.0;
                let c = from + (to - from) * t;
                scribe.grid(c, row + 0.15 + 0.3 * t + 0.34 * (c / 7.0) * (c / 7.0))
            })
            .collect();
        if scribe.chance() < 0.6 {
            fold(scribe, Side::Left, &short, 0.40 * strength, 0.8);
        }
    }
}

/// Draws the upright fold between the brows (glabella).
fn glabella(scribe: &mut Scribe<'_>, side: Side, deep: f64) {
    let (a, b) = (scribe.between(1.0, 1.2), scribe.between(1.25, 1.45));
    let top = scribe.between(3.1, 3.4);
    let through = [
        scribe.grid(b, top),
        scribe.grid(a, 4.1),
        scribe.grid(0.9 * a, 4.9),
        scribe.grid(0.95 * a, 5.5),
    ];
    fold(scribe, side, &through, 1.0 * deep, 1.2);
    let inner = scribe.between(0.25, 0.4);
    let through = [
        scribe.grid(inner, 3.9),
        scribe.grid(inner, 4.6),
        scribe.grid(0.9 * inner, 5.2),
    ];
    fold(scribe, side, &through, 0.35 * deep, 0.8);
}

/// Draws a fan from the outer corner of the eye, and the lines of a squint below it.
fn crows_feet(scribe: &mut Scribe<'_>, side: Side, deep: f64) {
    for i in 0..5 {
        let fan = (f64::from(i) - 2.0) / 2.0 + scribe.between(-0.1, 0.1);
        let from = scribe
            .places
            .eye(scribe.between(1.3, 2.1), 8.0 + 0.75 * fan);
        let end = 8.9 + scribe.between(0.2, 1.3) * (1.0 - 0.3 * fan.abs());
        let row = 6.15 + 0.75 * fan;
        let fall = 0.75 * fan + 0.1 + scribe.between(-0.15, 0.15);
        let through = [
            from,
            scribe.grid(8.15, row),
            scribe.grid((8.15 + end) / 2.0, row + 0.45 * fall),
            scribe.grid(end, row + fall),
        ];
        let strength = 0.85 * deep * scribe.between(0.75, 1.05) * (1.0 - 0.25 * fan.abs());
        fold(scribe, side, &through, strength, 0.8);
    }
    for (ring, a, b) in [(2.7, 10.2, 12.6), (2.0, 9.2, 11.6), (1.35, 10.8, 13.4)] {
        let (a, b) = (a + scribe.between(-0.3, 0.3), b + scribe.between(-0.4, 0.4));
        let lean = scribe.between(-0.25, 0.1);
        let through: Vec<DVec3> = (0..=6)
            .map(|k| {
                let t = f64::from(k) / 6.0;
                scribe.places.eye(ring + lean * t, a + (b - a) * t)
            })
            .collect();
        fold(scribe, side, &through, 0.36 * deep, 0.65);
    }
}

/// Draws the furrow from the wing of the nose past the corner of the mouth, its parallels on the
/// cheek, and its continuation below the corner.
fn cheek(scribe: &mut Scribe<'_>, side: Side, deep: f64) {
    let through = [
        scribe.grid(3.8, 13.2),
        scribe.grid(4.6, 14.7),
        scribe.grid(5.35, 16.2),
        scribe.grid(5.9, 17.8),
        scribe.grid(6.05, 19.2),
    ];
    fold(scribe, side, &through, 0.95 * deep, 1.5);
    for i in 0..2 {
        let out = 7.0 + 0.85 * f64::from(i) + scribe.between(-0.1, 0.1);
        let (top, end) = (scribe.between(15.0, 16.0), scribe.between(18.8, 20.0));
        let through = [
            scribe.grid(out - 0.45, top),
            scribe.grid(out + 0.2, (top + end) / 2.0),
            scribe.grid(out, end),
        ];
        let strength = (0.5 - 0.2 * f64::from(i)) * deep;
        fold(scribe, side, &through, strength, 1.1);
    }
    let through = [
        scribe.grid(4.75, 19.6),
        scribe.grid(4.95, 20.7),
        scribe.grid(4.75, 22.0),
    ];
    fold(scribe, side, &through, 0.42 * deep, 1.1);
}

/// Across the root of the nose.
fn nose_root(scribe: &mut Scribe<'_>, deep: f64) {
    for i in 0..3 {
        let row = 5.25 + 0.62 * f64::from(i) + scribe.between(-0.08, 0.08);
        let reach = scribe.between(1.5, 1.8);
        let through: Vec<DVec3> = (0..=8)
            .map(|k| {
                let c = reach * (f64::from(k) / 4.0 - 1.0);
                scribe.grid(c, row + 0.10 * c * c)
            })
            .collect();
        let strength = deep * (1.0 - 0.18 * f64::from(i));
        fold(scribe, Side::Left, &through, strength, 1.0);
    }
}

/// Draws the folds that run from the bridge over the side of the nose, down and outwards ("bunny
/// lines").
fn bunny(scribe: &mut Scribe<'_>, side: Side, deep: f64) {
    for i in 0..3 {
        let row = 7.5 + 0.8 * f64::from(i) + scribe.between(-0.12, 0.12);
        let end = scribe.between(2.5, 3.0);
        let through = [
            scribe.grid(0.5, row),
            scribe.grid(1.5, row + 0.45),
            scribe.grid(end, row + 1.35),
        ];
        let strength = deep * (0.9 - 0.12 * f64::from(i));
        fold(scribe, side, &through, strength, 0.85);
    }
}

/// Draws folds radiating from the lips, as in a tightened purse.
fn lips(scribe: &mut Scribe<'_>, side: Side, deep: f64) {
    let mut k = 0.25;
    while k < 11.8 {
        // Other lines exist next to the corners.
        if !(4.9..7.1).contains(&k) {
            let lean = scribe.between(-0.15, 0.15);
            let out = scribe.between(0.0, 0.35);
            let through = [
                scribe.places.mouth(1.6, k),
                scribe.places.mouth(1.1, k + 0.3 * lean),
                scribe.places.mouth(0.7, k + 0.7 * lean),
                scribe.places.mouth(out, k + lean),
            ];
            let strength = 0.62 * deep * scribe.between(0.55, 1.05);
            fold(scribe, side, &through, strength, 0.6);
        }
        k += scribe.between(0.40, 0.62);
    }
}
