//! Section tables of trunk, arm and leg and their smooth lookup.
//!
//! Breadths and depths: designed, from common anthropometric knowledge, and kept within one
//! standard deviation of surveyed girths by the tests of [`super`].

use raconteur_base::curve::lerp;
use raconteur_base::ops;

use super::shape::{BodyParams, CM};

/// Rows of a table: a parameter and five values.
type Table<const N: usize> = [[f64; 6]; N];

/// Trunk of a man of 175 cm: height / stature, half breadth, depth to the front, depth to
/// the back, centre z (cm), exponent of the superellipse.
#[rustfmt::skip]
const TRUNK_MALE: Table<15> = [
    [0.470, 5.0, 4.0, 5.0, 0.0, 2.0], [0.483, 13.0, 8.5, 9.5, 0.0, 2.1],
    [0.50, 16.2, 10.0, 11.2, 0.0, 2.3], [0.53, 16.7, 10.6, 11.2, 0.0, 2.3],
    [0.56, 16.0, 10.8, 9.8, 0.0, 2.3], [0.60, 14.9, 10.8, 8.3, 0.2, 2.3],
    [0.63, 14.5, 10.6, 8.0, 0.2, 2.3], [0.67, 15.1, 10.8, 8.8, 0.0, 2.3],
    [0.71, 16.0, 11.2, 10.0, -0.3, 2.4], [0.745, 16.6, 11.0, 10.6, -0.8, 2.4],
    [0.775, 16.0, 9.4, 10.3, -1.6, 2.3], [0.80, 14.2, 7.0, 9.0, -2.2, 2.2],
    [0.82, 10.8, 5.0, 7.3, -2.6, 2.1], [0.84, 7.2, 4.6, 5.6, -2.6, 2.0],
    [0.86, 5.0, 4.0, 4.0, -2.4, 2.0],
];

/// Trunk of a woman of 165 cm.
#[rustfmt::skip]
const TRUNK_FEMALE: Table<15> = [
    [0.455, 5.0, 4.0, 5.0, 0.0, 2.0], [0.475, 13.2, 8.5, 10.0, 0.0, 2.1],
    [0.50, 16.2, 9.3, 11.5, 0.0, 2.3], [0.53, 16.1, 9.1, 11.0, 0.0, 2.3],
    [0.56, 15.0, 9.1, 9.2, 0.0, 2.2], [0.60, 13.0, 8.9, 7.3, 0.3, 2.2],
    [0.63, 12.2, 8.6, 6.9, 0.3, 2.2], [0.67, 12.5, 8.7, 7.6, 0.0, 2.2],
    [0.71, 13.5, 8.9, 8.6, -0.4, 2.3], [0.745, 14.1, 9.0, 9.0, -0.9, 2.3],
    [0.775, 13.1, 8.0, 8.5, -1.6, 2.2], [0.80, 11.4, 6.1, 7.6, -2.1, 2.1],
    [0.82, 8.6, 4.4, 6.2, -2.4, 2.0], [0.84, 5.9, 4.0, 4.8, -2.4, 2.0],
    [0.86, 4.4, 3.4, 3.6, -2.2, 2.0],
];

/// Trunk of a child of nine, 133 cm tall: straight waist, round belly.
#[rustfmt::skip]
const TRUNK_CHILD: Table<15> = [
    [0.435, 3.6, 3.0, 3.6, 0.0, 2.0], [0.455, 8.8, 6.0, 6.8, 0.0, 2.1],
    [0.48, 11.4, 7.2, 7.9, 0.0, 2.2], [0.51, 11.7, 7.8, 7.8, 0.0, 2.2],
    [0.54, 11.2, 8.1, 6.9, 0.0, 2.2], [0.58, 10.5, 8.0, 6.0, 0.0, 2.2],
    [0.61, 10.4, 7.7, 5.9, 0.0, 2.2], [0.65, 10.7, 7.5, 6.3, -0.2, 2.2],
    [0.69, 11.2, 7.6, 6.8, -0.5, 2.3], [0.72, 11.4, 7.4, 7.0, -0.8, 2.3],
    [0.762, 10.9, 6.2, 6.8, -1.3, 2.2], [0.787, 9.4, 4.5, 5.8, -1.6, 2.1],
    [0.802, 7.2, 3.6, 4.8, -1.8, 2.0], [0.822, 4.9, 3.2, 3.9, -1.8, 2.0],
    [0.842, 3.6, 2.8, 3.0, -1.7, 2.0],
];

/// Arm: 0 shoulder, 1 elbow, 2 wrist; radii upwards, downwards, front, back (cm), unused.
#[rustfmt::skip]
const ARM: Table<14> = [
    [-0.22, 2.6, 2.6, 2.6, 2.6, 0.0], [-0.1, 4.2, 4.6, 4.6, 4.6, 0.0],
    [0.0, 4.6, 5.2, 5.1, 5.2, 0.0], [0.18, 4.6, 5.2, 5.2, 5.2, 0.0],
    [0.38, 4.5, 4.8, 5.1, 5.0, 0.0], [0.62, 4.2, 4.4, 4.9, 4.7, 0.0],
    [0.85, 3.9, 4.0, 4.1, 4.2, 0.0], [1.0, 3.9, 4.0, 4.1, 4.4, 0.0],
    [1.15, 4.2, 4.2, 4.5, 4.3, 0.0], [1.35, 3.9, 3.9, 4.3, 4.0, 0.0],
    [1.6, 3.2, 3.2, 3.7, 3.5, 0.0], [1.85, 2.4, 2.4, 3.0, 2.9, 0.0],
    [2.0, 2.05, 2.05, 2.9, 2.8, 0.0], [2.12, 1.9, 1.9, 3.1, 3.0, 0.0],
];

/// Leg: 0 hip, 1 knee, 2 ankle; radii lateral, medial, front, back (cm), unused.
#[rustfmt::skip]
const LEG: Table<13> = [
    [-0.12, 7.5, 5.0, 7.0, 7.5, 0.0], [0.0, 9.2, 7.6, 8.4, 9.0, 0.0],
    [0.15, 9.2, 8.3, 8.8, 9.2, 0.0], [0.4, 8.1, 7.9, 8.6, 8.3, 0.0],
    [0.7, 6.7, 6.8, 7.3, 6.7, 0.0], [0.9, 5.8, 6.0, 6.3, 5.5, 0.0],
    [1.0, 5.6, 5.8, 6.2, 5.2, 0.0], [1.1, 5.3, 5.5, 5.5, 5.5, 0.0],
    [1.3, 5.4, 5.7, 4.8, 7.2, 0.0], [1.5, 4.7, 5.0, 4.3, 6.3, 0.0],
    [1.75, 3.5, 3.6, 3.7, 4.3, 0.0], [1.92, 3.3, 3.3, 3.6, 4.0, 0.0],
    [2.05, 3.5, 3.5, 4.0, 4.2, 0.0],
];

/// Table of cross-sections along a limb or the trunk, resampled at equal steps.
#[derive(Clone, Debug)]
pub(super) struct Sections {
    first: f64,
    last: f64,
    rows: Vec<[f64; 5]>,
}

impl Sections {
    /// Returns the parameter of the first row.
    pub(super) fn first(&self) -> f64 {
        self.first
    }

    /// Returns the parameter of the last row.
    pub(super) fn last(&self) -> f64 {
        self.last
    }

    /// Interpolates the five values at a parameter, clamped at both ends.
    pub(super) fn sample(&self, x: f64) -> [f64; 5] {
        let n = self.rows.len();
        let t = ((x - self.first) / (self.last - self.first) * (n - 1) as f64)
            .clamp(0.0, n as f64 - 1.001);
        let i = t as usize;
        let f = t - i as f64;
        core::array::from_fn(|k| lerp(self.rows[i][k], self.rows[i + 1][k], f))
    }

    /// Resamples a table by monotone cubic interpolation (Fritsch and Carlson 1980,
    /// doi:10.1137/0717021).
    fn resample(table: &[[f64; 6]]) -> Self {
        const ROWS: usize = 96;
        let (first, last) = (table[0][0], table[table.len() - 1][0]);
        let rows = (0..ROWS)
            .map(|r| {
                let x = lerp(first, last, r as f64 / (ROWS - 1) as f64);
                core::array::from_fn(|k| monotone(table, k + 1, x))
            })
            .collect();
        Self { first, last, rows }
    }

    pub(super) fn trunk(p: &BodyParams) -> Self {
        let mut table = TRUNK_FEMALE;
        let bell = |x: f64, c: f64, w: f64| ops::exp(-((x - c) / w) * ((x - c) / w));
        let (child, old) = (p.child(), p.old());
        let scale = p.stature_m / lerp(1.75, 1.65, p.sex);
        let rows = TRUNK_MALE.into_iter().zip(TRUNK_CHILD);
        for (row, (male, boy)) in table.iter_mut().zip(rows) {
            for (k, v) in row.iter_mut().enumerate() {
                let lengths = (1..5).contains(&k);
                let (adult, young) = if lengths {
                    (scale, p.stature_m / 1.33)
                } else {
                    (1.0, 1.0)
                };
                *v = lerp(lerp(male[k], *v, p.sex) * adult, boy[k] * young, child);
            }
            let wide = 1.0 + 0.10 * p.build;
            let waist_at = lerp(0.60, 0.58, child);
            // Weight collects at the waist first; with age, the belly protrudes and the muscles of
            // chest and seat become thinner.
            let waist = bell(row[0], waist_at, 0.06);
            row[1] *= wide * (1.0 + 0.05 * p.build * waist) * (1.0 + 0.07 * old * waist);
            row[2] = row[2] * wide
                + (5.6 + 2.5 * p.build.max(0.0)) * old * scale * bell(row[0], waist_at, 0.055);
            row[3] *= wide * (1.0 - 0.08 * old * bell(row[0], 0.51, 0.04));
            row[4] += p.stoop_m(row[0] * p.stature_m) / CM;
        }
        Self::resample(&table)
    }

    /// Returns the sections with the hollow between two parameters partly filled: cloth hangs from
    /// the wider parts above and below. `share` 0 leaves it, 1 makes it straight.
    pub(super) fn bridged(&self, from: f64, to: f64, share: f64) -> Self {
        let (low, high) = (self.sample(from), self.sample(to));
        let mut out = self.clone();
        let n = out.rows.len() - 1;
        for (i, row) in out.rows.iter_mut().enumerate() {
            let x = lerp(self.first, self.last, i as f64 / n as f64);
            let t = (x - from) / (to - from);
            if (0.0..=1.0).contains(&t) {
                for k in 0..3 {
                    let straight = lerp(low[k], high[k], t);
                    row[k] = row[k].max(lerp(row[k], straight, share));
                }
            }
        }
        out
    }

    pub(super) fn arm(radius_scale: f64) -> Self {
        Self::resample(&scaled(&ARM, radius_scale))
    }

    pub(super) fn leg(radius_scale: f64) -> Self {
        Self::resample(&scaled(&LEG, radius_scale))
    }
}

fn scaled<const N: usize>(table: &Table<N>, s: f64) -> Table<N> {
    table.map(|mut row| {
        for v in &mut row[1..5] {
            *v *= s;
        }
        row
    })
}

/// Returns the slope of a column at a row: harmonic mean of the secants to its neighbours, zero at
/// extrema.
fn slope(table: &[[f64; 6]], column: usize, row: usize) -> f64 {
    let secant =
        |i: usize| (table[i + 1][column] - table[i][column]) / (table[i + 1][0] - table[i][0]);
    if row == 0 {
        return secant(0);
    }
    if row + 1 == table.len() {
        return secant(row - 1);
    }
    let (a, b) = (secant(row - 1), secant(row));
    if a * b <= 0.0 {
        0.0
    } else {
        2.0 * a * b / (a + b)
    }
}

fn monotone(table: &[[f64; 6]], column: usize, x: f64) -> f64 {
    let i = table
        .partition_point(|row| row[0] <= x)
        .clamp(1, table.len() - 1)
        - 1;
    let h = table[i + 1][0] - table[i][0];
    raconteur_base::curve::hermite(
        table[i][column],
        slope(table, column, i) * h,
        table[i + 1][column],
        slope(table, column, i + 1) * h,
        ((x - table[i][0]) / h).clamp(0.0, 1.0),
    )
}
