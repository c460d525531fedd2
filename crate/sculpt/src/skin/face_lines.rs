//! Lines and spots of the face, laid out by the cage's own coordinates.
//!
//! Onset of the lines: forehead, glabella and crow's feet from the late twenties, the folds about
//! the mouth from forty, cheeks and neck later (order after Pessa and Rohrich, "Facial Topography",
//! 2012; depths *designed*, of the order of the 0.1 to 0.5 mm that profilometry finds).

use raconteur_base::{DVec3, Side, mirror_vector, noise};

use super::SkinParams;
use super::marks::{Marks, Pen};
use crate::head::{HeadSheet, Places};
use crate::texture::{rise, space_noise};

/// Marks painted on a face: wrinkles, freckles, spots, moles, vessels. Wrinkle strengths are depths
/// in mm, the others 0..1.
#[derive(Clone, Debug, Default)]
pub(super) struct FaceMarks {
    pub(super) wrinkles: Marks,
    pub(super) freckles: Marks,
    pub(super) spots: Marks,
    pub(super) moles: Marks,
    pub(super) vessels: Marks,
}

/// Generator of skin marks that varies each line with a seeded random number.
pub(super) struct Scribe<'a> {
    pub(super) places: &'a Places,
    pub(super) skin: &'a SkinParams,
    marks: Marks,
    drawn: u64,
}

impl<'a> Scribe<'a> {
    /// Creates the marks; `first` separates the random numbers of one drawing from those of
    /// another.
    pub(super) fn new(places: &'a Places, skin: &'a SkinParams, first: u64) -> Self {
        Self {
            places,
            skin,
            marks: Marks::default(),
            drawn: first,
        }
    }

    /// Returns the marks drawn since the last call.
    pub(super) fn take_marks(&mut self) -> Marks {
        core::mem::take(&mut self.marks).finish()
    }

    /// Returns a random number 0..1, different for each call.
    pub(super) fn chance(&mut self) -> f64 {
        self.drawn += 1;
        noise::unit(self.skin.seed, 0x77A1, self.drawn as i64)
    }

    pub(super) fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.chance()
    }

    /// Draws a line through points on one side of the face.
    fn line(&mut self, side: Side, through: &[DVec3], strength: f64, width: f64, broken: f64) {
        self.draw(
            side,
            through,
            Pen {
                strength,
                width,
                wander: 0.35 + 0.5 * width,
                broken,
                unsteady: 0.45,
                seed: 0,
            },
        );
    }

    /// Draws a line on one side with the given pen and its own seed.
    pub(super) fn draw(&mut self, side: Side, through: &[DVec3], pen: Pen) {
        self.drawn += 1;
        let pen = Pen {
            seed: self.skin.seed.wrapping_mul(0x9E37).wrapping_add(self.drawn),
            ..pen
        };
        if side == Side::Left {
            self.marks.line(through, pen);
        } else {
            let turned: Vec<DVec3> = through.iter().map(|p| mirror_vector(*p)).collect();
            self.marks.line(&turned, pen);
        }
    }

    /// Returns the position at a column, also negative (the right half), and row.
    pub(super) fn grid(&self, column: f64, row: f64) -> DVec3 {
        let p = self.places.grid(column.abs(), row);
        if column < 0.0 { mirror_vector(p) } else { p }
    }

    /// Draws a line across both halves of the face along a row, between two columns, with its own
    /// bend.
    fn across(&mut self, row: f64, [from, to]: [f64; 2], bend: f64, strength: f64, width: f64) {
        let (a, b) = (self.between(-0.1, 0.1), self.between(0.6, 1.4));
        let through: Vec<DVec3> = (0..=12)
            .map(|i| {
                let c = from + (to - from) * f64::from(i) / 12.0;
                let wave = a + 0.07 * raconteur_base::ops::sin(b * c + 3.0 * a);
                self.grid(c, row + wave + bend * (c / 6.0) * (c / 6.0))
            })
            .collect();
        self.line(Side::Left, &through, strength, width, 0.5);
    }

    fn forehead(&mut self) {
        let deep = 0.60 * self.skin.since(29.0);
        for i in 0..6 {
            let row = 1.0 + 0.46 * f64::from(i) + self.between(-0.1, 0.1);
            // The middle lines are the longest and deepest.
            let centre = 1.0 - (f64::from(i) - 2.6).abs() / 4.0;
            let reach = 3.2 + 3.4 * centre;
            let (a, b) = (self.between(0.6, 1.0), self.between(0.6, 1.0));
            let strength = deep * centre * self.between(0.55, 1.1);
            if self.chance() < 0.55 {
                self.across(row, [-reach * a, reach * b], 0.16, strength, 0.75);
            } else {
                let meet = self.between(-1.2, 1.2);
                self.across(row, [-reach * a, meet], 0.16, strength, 0.7);
                self.across(row + 0.12, [meet - 0.8, reach * b], 0.16, strength, 0.7);
            }
            // A fine companion.
            let start = self.between(-4.5, 1.0);
            let end = start + self.between(2.0, 4.0);
            self.across(row + 0.23, [start, end], 0.12, 0.35 * deep, 0.45);
        }
    }

    fn glabella(&mut self) {
        let deep = 0.48 * self.skin.since(31.0);
        for side in Side::BOTH {
            let (a, b) = (self.between(0.55, 0.95), self.between(0.7, 1.1));
            let top = self.between(3.0, 3.5);
            let through = [
                self.grid(b, top),
                self.grid(a, 4.2),
                self.grid(0.9 * a, 5.0),
            ];
            let strength = deep * self.between(0.6, 1.1);
            self.line(side, &through, strength, 0.8, 0.2);
        }
        // Across the root of the nose.
        let deep = 0.26 * self.skin.since(42.0);
        for row in [6.0, 6.7, 7.5] {
            let r = row + self.between(-0.15, 0.15);
            let to = self.between(0.7, 1.1);
            self.across(r, [-1.0, to], -2.0, deep, 0.55);
        }
    }

    /// Draws crow's feet: a few lines that leave the corner at different points, bend away from
    /// each other, fork and fade at different lengths.
    fn crows_feet(&mut self, side: Side) {
        let deep = 0.50 * self.skin.since(29.0);
        for i in 0..6 {
            let fan = (f64::from(i) - 2.4) / 2.6 + self.between(-0.14, 0.14);
            let start = self.between(8.15, 8.7);
            let end = start + self.between(1.2, 2.7) * (1.0 - 0.25 * fan.abs());
            let row = 6.1 + 0.75 * fan;
            let fall = 1.15 * fan + self.between(-0.25, 0.25) + 0.15;
            let mid = (start + end) / 2.0;
            let bow = self.between(-0.12, 0.18);
            let through = [
                self.grid(start, row),
                self.grid(mid, row + 0.42 * fall + bow),
                self.grid(end, row + fall),
            ];
            let strength = deep * self.between(0.45, 1.1) * (1.0 - 0.3 * fan.abs());
            self.line(side, &through, strength, 0.6, 0.35);
            if self.chance() < 0.6 {
                let fork = self.between(-0.5, 0.5);
                let through = [
                    self.grid(mid, row + 0.42 * fall + bow),
                    self.grid(end + 0.3, row + fall + fork),
                ];
                self.line(side, &through, 0.5 * strength, 0.42, 0.3);
            }
        }
    }

    /// Draws fine lines along both lids and the crossing net below the eye.
    fn lids(&mut self, side: Side) {
        let age = self.skin.since(26.0);
        for i in 0..9 {
            let ring = 0.25 + 0.34 * f64::from(i) + self.between(-0.1, 0.1);
            let (a, b) = (self.between(9.0, 11.5), self.between(12.5, 15.4));
            let through: Vec<DVec3> = (0..=6)
                .map(|k| self.places.eye(ring, a + (b - a) * f64::from(k) / 6.0))
                .collect();
            let strength = (0.03 + 0.22 * age) * self.between(0.5, 1.1);
            self.line(side, &through, strength, 0.42, 0.45);
        }
        for _ in 0..16 {
            let k = self.between(9.2, 14.6);
            let lean = self.between(0.3, 1.3);
            let (a, b) = (self.between(1.4, 2.9), self.between(0.0, 0.7));
            let through = [
                self.places.eye(a, k),
                self.places.eye(b, (k - lean).max(8.2)),
            ];
            let strength = 0.18 * age * self.between(0.4, 1.0);
            self.line(side, &through, strength, 0.38, 0.4);
        }
        // The fold of the upper lid, visible on its plate when the lid closes.
        let fold: Vec<DVec3> = (0..=8)
            .map(|k| self.places.eye(3.05, 0.9 + 6.4 * f64::from(k) / 8.0))
            .collect();
        let pen = Pen {
            strength: 0.2,
            width: 0.6,
            wander: 0.05,
            broken: 0.0,
            unsteady: 0.15,
            seed: 0,
        };
        self.draw(side, &fold, pen);
        for i in 0..5 {
            let ring = 3.15 + 0.3 * f64::from(i);
            let (a, b) = (self.between(1.6, 3.0), self.between(5.6, 7.6));
            let through: Vec<DVec3> = (0..=6)
                .map(|k| self.places.eye(ring, a + (b - a) * f64::from(k) / 6.0))
                .collect();
            let strength = 0.03 + 0.15 * age * self.between(0.5, 1.0);
            self.line(side, &through, strength, 0.4, 0.4);
        }
    }

    /// Grooves of the red, and in age the lines that run from it into the skin.
    fn lips(&mut self, side: Side) {
        let age = self.skin.since(46.0);
        let mut k = 0.15;
        while k < 11.9 {
            let j = k + self.between(-0.12, 0.12);
            let end = self.between(2.6, 4.3);
            let lean = self.between(-0.12, 0.12);
            let through = [
                self.places.mouth(self.skin_edge(), j),
                self.places.mouth(2.2, j + lean),
                self.places.mouth(end, j + 1.3 * lean),
            ];
            let strength = (0.09 + 0.07 * self.skin.since(30.0)) * self.between(0.4, 1.1);
            self.line(side, &through, strength, 0.36, 0.25);
            // Few lines are long; next to the corners none are.
            if age > 0.0 && !(5.0..7.0).contains(&k) && self.chance() < 0.62 {
                let out = self.between(-0.2, 0.75);
                let through = [
                    self.places.mouth(1.35, j),
                    self.places.mouth(0.9, j),
                    self.places
                        .mouth(out.max(0.0), j + self.between(-0.25, 0.1)),
                ];
                let strength = 0.38 * age * self.between(0.3, 1.0);
                self.line(side, &through, strength, 0.5, 0.2);
            }
            k += self.between(0.16, 0.42);
        }
    }

    fn skin_edge(&mut self) -> f64 {
        self.between(1.0, 1.5)
    }

    /// Draws the fine part of the folds next to nose and mouth; the folds themselves are part of
    /// the shape.
    fn mouth_folds(&mut self, side: Side) {
        let deep = 0.42 * self.skin.since(38.0);
        for i in 0..3 {
            let out = 0.28 * f64::from(i) + self.between(-0.06, 0.06);
            let top = self.between(13.3, 15.2);
            let end = self.between(17.6, 19.6);
            let through = [
                self.grid(3.9 + out, top),
                self.grid(4.7 + out, (top + end) / 2.0),
                self.grid(5.1 + 1.2 * out, end),
            ];
            let strength = deep * if i == 0 { 1.0 } else { 0.4 };
            self.line(
                side,
                &through,
                strength,
                if i == 0 { 0.95 } else { 0.5 },
                0.25,
            );
        }
        for i in 0..2 {
            let out = 0.4 * f64::from(i);
            let end = self.between(21.6, 22.8);
            let through = [
                self.grid(4.5 + out, 19.4),
                self.grid(4.7 + out, 20.6),
                self.grid(4.4 + out, end),
            ];
            self.line(side, &through, deep * (0.75 - 0.4 * f64::from(i)), 0.7, 0.3);
        }
    }

    /// Draws long fine lines over the cheek and in front of the ear.
    fn cheeks(&mut self, side: Side) {
        let deep = 0.36 * self.skin.since(52.0);
        for i in 0..8 {
            let c = 6.2 + 0.75 * f64::from(i) + self.between(-0.25, 0.25);
            let (top, end) = (self.between(9.3, 13.0), self.between(15.5, 20.5));
            let lean = self.between(0.3, 1.3);
            let through = [
                self.grid(c, top),
                self.grid(c - 0.3 * lean, (top + end) / 2.0),
                self.grid(c - lean, end),
            ];
            let strength = deep * self.between(0.3, 1.0);
            self.line(side, &through, strength, 0.55, 0.6);
        }
        // The net of an old cheek: short lines that cross.
        for _ in 0..70 {
            let (c, r) = (self.between(5.8, 11.6), self.between(9.6, 20.0));
            let (dc, dr) = (self.between(-0.9, 0.9), self.between(0.5, 1.5));
            let through = [self.grid(c, r), self.grid(c + dc, r + dr)];
            let strength = 0.45 * deep * self.between(0.3, 1.0);
            self.line(side, &through, strength, 0.45, 0.2);
        }
        for i in 0..2 {
            let c = 11.45 - 0.4 * f64::from(i);
            let through = [
                self.grid(c, 7.0),
                self.grid(c - 0.1, 9.4),
                self.grid(c, 11.8),
            ];
            self.line(side, &through, 0.9 * deep, 0.6, 0.3);
        }
    }

    fn neck(&mut self) {
        let age = self.skin.since(32.0);
        for (i, row) in [25.4, 27.0, 28.7, 30.0].into_iter().enumerate() {
            let row = row + self.between(-0.3, 0.3);
            let reach = self.between(6.0, 11.0);
            let strength = (0.04 + 0.40 * age) * if i == 1 { 1.0 } else { 0.6 };
            let to = reach * self.between(0.75, 1.0);
            self.across(row, [-reach, to], 0.12, strength, 1.0);
        }
        let deep = 0.28 * self.skin.since(55.0);
        for _ in 0..120 {
            let (c, r) = (self.between(-10.0, 10.0), self.between(23.6, 30.6));
            let (dc, dr) = (self.between(-0.8, 0.8), self.between(-0.9, 0.9));
            let through = [self.grid(c, r), self.grid(c + dc, (r + dr).min(30.9))];
            let strength = deep * self.between(0.3, 1.0);
            self.line(Side::Left, &through, strength, 0.5, 0.2);
        }
    }

    /// Draws widened vessels: short crooked threads over the cheeks and the wings of the nose.
    fn vessels(&mut self) {
        let amount = self.skin.vessels;
        let count = (150.0 * amount) as usize;
        for i in 0..count {
            let side = Side::BOTH[i % 2];
            let nose = self.chance() < 0.34;
            let (c, r) = if nose {
                (self.between(1.6, 3.9), self.between(11.4, 13.8))
            } else {
                (self.between(5.4, 9.6), self.between(9.6, 14.6))
            };
            let (dc, dr) = (self.between(-0.5, 0.5), self.between(-0.5, 0.6));
            let through = [
                self.grid(c, r),
                self.grid(c + 0.5 * dc + 0.12, r + 0.5 * dr),
                self.grid(c + dc, r + dr),
            ];
            let strength = (0.35 + 0.5 * amount) * self.between(0.3, 1.0);
            self.line(side, &through, strength, 0.34, 0.2);
        }
    }
}

/// Scatters positions evenly over the skin and keeps each with a given probability (0..1).
fn scatter(
    sheet: &HeadSheet,
    seed: u64,
    per_cm2: f64,
    share: impl Fn(DVec3) -> f64,
    mut put: impl FnMut(DVec3, [f64; 2]),
) {
    for (i, t) in (0u64..).zip(&sheet.triangles) {
        let [a, b, c] = t.map(|v| sheet.mean[v as usize]);
        let expected = (b - a).cross(c - a).length() / 2.0 * per_cm2 / 100.0;
        let number = |k: i64| noise::unit(seed, i, k);
        let count = (expected + number(0)).floor() as i64;
        for k in 0..count {
            let (mut x, mut y) = (number(8 * k + 1), number(8 * k + 2));
            if x + y > 1.0 {
                (x, y) = (1.0 - x, 1.0 - y);
            }
            let p = a + (b - a) * x + (c - a) * y;
            if number(8 * k + 3) < share(p) {
                put(p, [number(8 * k + 4), number(8 * k + 5)]);
            }
        }
    }
}

/// Generates all marks of a face from its skin parameters.
pub(super) fn face_marks(skin: &SkinParams, places: &Places, sheet: &HeadSheet) -> FaceMarks {
    let mut scribe = Scribe::new(places, skin, 0);
    scribe.forehead();
    scribe.glabella();
    for side in Side::BOTH {
        scribe.crows_feet(side);
        scribe.lids(side);
        scribe.lips(side);
        scribe.mouth_folds(side);
        scribe.cheeks(side);
    }
    scribe.neck();
    let wrinkles = scribe.take_marks();
    scribe.vessels();
    let vessels = scribe.take_marks();

    let mut freckles = Marks::default();
    if skin.freckles > 0.0 {
        let where_sun = |p: DVec3| {
            let band = (p.y - 2.0) / 17.0;
            let cheeks = raconteur_base::ops::exp(-band * band) * rise(48.0, 84.0, p.z);
            let rest = 0.16 * rise(30.0, 80.0, p.z) * rise(-95.0, -70.0, p.y);
            // The lines occur in groups.
            let group = 0.55 + 0.8 * space_noise(skin.seed + 90, p / 8.0);
            skin.freckles * (cheeks + rest).min(1.0) * group
        };
        scatter(sheet, skin.seed ^ 0xF7, 40.0, where_sun, |p, [a, b]| {
            freckles.spot(p, 0.25 + 0.75 * a * a, 0.42 + 0.65 * b * b);
        });
    }
    let mut spots = Marks::default();
    let aged = skin.sun * skin.since(38.0);
    if aged > 0.0 {
        let high = |p: DVec3| {
            let temple =
                rise(35.0, 60.0, p.x.abs()) * rise(-30.0, 10.0, p.y) * rise(-10.0, 30.0, p.z);
            let brow = rise(58.0, 80.0, p.y);
            (temple.max(brow) + 0.12) * aged * rise(-120.0, -60.0, p.y)
        };
        scatter(sheet, skin.seed ^ 0x5B, 1.1, high, |p, [a, b]| {
            spots.spot(p, 0.45 + 0.55 * a, 1.3 + 3.2 * b * b);
        });
    }
    let mut moles = Marks::default();
    let mut left = skin.moles;
    let front = |p: DVec3| 0.02 * rise(0.0, 40.0, p.z);
    scatter(sheet, skin.seed ^ 0x30, 6.0, front, |p, [a, b]| {
        if left > 0 {
            left -= 1;
            moles.spot(p, 0.6 + 0.4 * a, 0.7 + 0.7 * b);
        }
    });
    FaceMarks {
        wrinkles,
        freckles: freckles.finish(),
        spots: spots.finish(),
        moles: moles.finish(),
        vessels,
    }
}
