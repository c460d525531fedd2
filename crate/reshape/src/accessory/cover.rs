//! Head covers: cloth over the skin, from a pole to a rim.

use std::f64::consts::{FRAC_PI_2, TAU};

use raconteur_base::curve::{lerp, smooth};
use raconteur_base::{DVec3, ops};

use super::super::{hairs, narrow, wide};
use super::solid::Solid;
use super::{Fit, landmark, material};
use raconteur_body::figure::{MaterialKind, Mesh};

const COLUMNS: usize = 72;
const ROWS: usize = 26;
/// The skin's reach in a direction is that of its farthest vertex within this angle's cosine (14°).
const NEAR_COS: f64 = 0.97;
/// Sampling step over the skin vertices.
const STEP: usize = 2;
/// Hair under cloth is so thick.
const PRESSED_M: f64 = 0.0035;
/// Height by which hair emerges under the rim over this angle.
const LOOSE_M: f64 = 0.02;
const LOOSE_RAD: f64 = 0.3;
/// Number of smoothing rounds for the reach.
const ROUNDS: usize = 6;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Cut {
    Cap,
    Hat,
    Scarf,
}

/// Head cover (cap, hat or headscarf) fitted to a head, as a surface from a pole to a rim.
pub(in super::super) struct Cover {
    cut: Cut,
    centre: DVec3,
    /// Axes of the pole, and of column 0 and a quarter on.
    axes: [DVec3; 3],
    /// Angle from the pole to the rim at each column.
    rim: Vec<f64>,
    /// Reach of the skin at each row and column, metres.
    reach: Vec<Vec<f64>>,
}

impl Cover {
    /// Creates a knitted cap from the forehead over the tops of the ears to the nape.
    pub(in super::super) fn cap(fit: &Fit) -> Self {
        let front = fit.position(landmark::TRICHION).y - 0.014;
        Self::crown(Cut::Cap, fit, [front, 0.034, -0.012])
    }

    /// Builds the cover of a hat, which sits higher.
    pub(in super::super) fn hat(fit: &Fit) -> Self {
        let front = fit.position(landmark::TRICHION).y - 0.008;
        Self::crown(Cut::Hat, fit, [front, 0.046, 0.022])
    }

    /// Creates a cover whose rim has the given heights at the front, sides and back, metres.
    fn crown(cut: Cut, fit: &Fit, [front, side, back]: [f64; 3]) -> Self {
        let centre = DVec3::new(0.0, 0.045, -0.012);
        let mut cover = Self::bare(cut, centre, [DVec3::Y, DVec3::Z, DVec3::X]);
        cover.rim = (0..COLUMNS)
            .map(|j| {
                let turn = cover.turn(j);
                let along = (1.0 - ops::cos(turn)) / 2.0;
                let at_side = ops::sin(turn) * ops::sin(turn);
                let height = lerp(lerp(front, back, along), side, at_side);
                let reach = reach_of(fit, centre, cover.direction(turn, FRAC_PI_2)).max(0.06);
                ops::acos(((height - centre.y) / reach).clamp(-0.9, 0.9))
            })
            .collect();
        cover.measure(fit);
        cover
    }

    /// Creates a headscarf that leaves the face free, from the hairline to below the chin.
    pub(in super::super) fn scarf(fit: &Fit) -> Self {
        let centre = DVec3::new(0.0, 0.008, -0.012);
        let mut cover = Self::bare(Cut::Scarf, centre, [-DVec3::Z, DVec3::Y, DVec3::X]);
        let angle = |p: DVec3| {
            let d = (p - centre).normalize_or_zero();
            ops::acos(-d.z)
        };
        let top = angle(fit.position(landmark::TRICHION) + DVec3::new(0.0, -0.006, 0.0));
        let chin = angle(fit.position(landmark::GNATHION) + DVec3::new(0.0, -0.012, -0.026));
        let side = FRAC_PI_2 + 0.55;
        cover.rim = (0..COLUMNS)
            .map(|j| {
                let turn = cover.turn(j);
                let along = (1.0 - ops::cos(turn)) / 2.0;
                let at_side = ops::sin(turn) * ops::sin(turn);
                lerp(lerp(top, chin, along), side, at_side)
            })
            .collect();
        cover.measure(fit);
        cover
    }

    fn bare(cut: Cut, centre: DVec3, axes: [DVec3; 3]) -> Self {
        Self {
            cut,
            centre,
            axes,
            rim: Vec::new(),
            reach: Vec::new(),
        }
    }

    fn turn(&self, column: usize) -> f64 {
        TAU * column as f64 / COLUMNS as f64
    }

    fn direction(&self, turn: f64, angle: f64) -> DVec3 {
        let [pole, first, quarter] = self.axes;
        let around = first * ops::cos(turn) + quarter * ops::sin(turn);
        pole * ops::cos(angle) + around * ops::sin(angle)
    }

    fn measure(&mut self, fit: &Fit) {
        let row = |i: usize| -> Vec<f64> {
            let one = |j: usize| {
                let angle = self.rim[j] * i as f64 / ROWS as f64;
                reach_of(fit, self.centre, self.direction(self.turn(j), angle))
            };
            (0..COLUMNS).map(one).collect()
        };
        let mut reach: Vec<Vec<f64>> = (0..=ROWS).map(row).collect();
        for _ in 0..ROUNDS {
            let before = reach.clone();
            let at = |i: usize, j: usize| before[i.min(ROWS)][j % COLUMNS];
            for (i, row) in reach.iter_mut().enumerate() {
                for (j, r) in row.iter_mut().enumerate() {
                    let around = at(i, j + 1)
                        + at(i, j + COLUMNS - 1)
                        + at(i + 1, j)
                        + at(i.saturating_sub(1), j);
                    *r = 0.4 * at(i, j) + 0.15 * around;
                }
            }
        }
        self.reach = reach;
    }

    /// Returns a point of the cloth at a distance above the skin.
    fn place(&self, i: usize, j: usize, off: f64) -> DVec3 {
        let (turn, angle) = (self.turn(j), self.rim[j] * i as f64 / ROWS as f64);
        self.centre + self.direction(turn, angle) * (self.reach[i][j] + off)
    }

    /// Presses hair under the cloth, and removes it under a scarf; beards stay.
    pub(in super::super) fn press(&self, mesh: &mut Mesh, origin: DVec3) {
        if mesh.name == hairs::BEARD {
            return;
        }
        if self.cut == Cut::Scarf {
            hairs::leave(mesh, |_| false);
            return;
        }
        for p in &mut mesh.positions {
            let off = wide(*p) - origin - self.centre;
            let length = off.length();
            let most = self.most(off);
            if length > most {
                *p = narrow(origin + self.centre + off * (most / length));
            }
        }
    }

    /// Returns the maximum distance of hair from the centre in a direction: limited to the cloth,
    /// and relaxed gradually below its rim.
    fn most(&self, off: DVec3) -> f64 {
        let [pole, first, quarter] = self.axes;
        let turn = ops::atan2(off.dot(quarter), off.dot(first)).rem_euclid(TAU);
        let column = ((turn / TAU * COLUMNS as f64).round() as usize) % COLUMNS;
        let angle = ops::acos((off.dot(pole) / off.length().max(1e-9)).clamp(-1.0, 1.0));
        let rim = self.rim[column];
        let row = ((angle / rim * ROWS as f64).round() as usize).min(ROWS);
        let below = ((angle - rim) / LOOSE_RAD).max(0.0);
        self.reach[row][column] + PRESSED_M + LOOSE_M * below * below
    }

    /// Returns the meshes of the cover in a colour, as parts of the figure.
    pub(super) fn meshes(&self, fit: &Fit, colour: [f32; 3]) -> Vec<Mesh> {
        match self.cut {
            Cut::Cap => vec![fit.mesh(
                "cap",
                self.shell(&|i, _| knitted(i)),
                material(MaterialKind::Rib, colour, 0.9),
            )],
            Cut::Hat => {
                let mut felt = self.raised();
                felt.join(self.brim());
                let band = self.band();
                vec![
                    fit.mesh("hat", felt, material(MaterialKind::Fleece, colour, 0.9)),
                    fit.mesh(
                        "hat_band",
                        band,
                        material(MaterialKind::Woven, colour.map(|x| x * 0.25), 0.6),
                    ),
                ]
            }
            Cut::Scarf => vec![fit.mesh(
                "scarf",
                self.shell(&|i, j| self.draped(i, j)),
                material(MaterialKind::Woven, colour, 0.8),
            )],
        }
    }

    /// Builds cloth with the distance from the skin given by row and column; its rim turns in.
    fn shell(&self, off: &dyn Fn(usize, usize) -> f64) -> Solid {
        let row = |i: usize, off: &dyn Fn(usize, usize) -> f64| {
            (0..COLUMNS).map(|j| self.place(i, j, off(i, j))).collect()
        };
        let mut rows: Vec<Vec<DVec3>> = (0..=ROWS).map(|i| row(i, off)).collect();
        rows.push(row(ROWS, &|i, j| off(i, j) - 0.002));
        rows.push(row(ROWS, &|_, _| 0.0005));
        Solid::sheet(&rows, true).outward(self.centre)
    }

    /// Folds of a scarf: loose about the neck, close at the face.
    fn draped(&self, i: usize, j: usize) -> f64 {
        let p = self.place(i, j, 0.0);
        let low = smooth(((-0.045 - p.y) / 0.09).clamp(0.0, 1.0));
        let edge = smooth(((i as f64 / ROWS as f64 - 0.86) / 0.14).clamp(0.0, 1.0));
        let turn = self.turn(j);
        let fold = ops::sin(9.0 * turn + 14.0 * p.y / 0.1 * 0.35)
            * (1.0 - edge)
            * smooth((i as f64 / ROWS as f64 * 2.0).min(1.0));
        lerp(0.008, 0.026, low) + 0.0016 * fold * (1.0 + 1.5 * low) + 0.002 * edge
    }

    /// Returns the crown of a hat, higher than the head, with a crease along its top.
    fn raised(&self) -> Solid {
        let rows: Vec<Vec<DVec3>> = (0..=ROWS)
            .map(|i| {
                (0..COLUMNS)
                    .map(|j| self.crease(self.place(i, j, 0.007), i))
                    .collect()
            })
            .collect();
        Solid::sheet(&rows, true).outward(self.centre)
    }

    fn crease(&self, p: DVec3, row: usize) -> DVec3 {
        let top = 1.0 - smooth((row as f64 / ROWS as f64).clamp(0.0, 1.0));
        let dent =
            ops::exp(-(p.x / 0.022) * (p.x / 0.022)) * ops::exp(-(p.z / 0.075) * (p.z / 0.075));
        DVec3::new(
            p.x * (1.0 - 0.04 * top),
            p.y + 0.034 * top - 0.016 * dent * top,
            p.z,
        )
    }

    fn brim(&self) -> Solid {
        const ACROSS: usize = 10;
        let point = |k: usize, j: usize| {
            let turn = self.turn(j);
            let rim = self.crease(self.place(ROWS, j, 0.0068), ROWS);
            let out = DVec3::new(ops::sin(turn), 0.0, ops::cos(turn));
            let t = k as f64 / ACROSS as f64;
            let at_side = ops::sin(turn) * ops::sin(turn);
            let rise = lerp(-0.012 * t, 0.016 * t * t, at_side);
            rim + out * (0.058 * t) + DVec3::Y * rise
        };
        let upper = (0..=ACROSS).map(|k| (0..COLUMNS).map(|j| point(k, j)).collect());
        let lower = (0..=ACROSS).rev().map(|k| {
            (0..COLUMNS)
                .map(|j| point(k, j) - DVec3::Y * 0.0022)
                .collect()
        });
        let rows: Vec<Vec<DVec3>> = upper.chain(lower).collect();
        Solid::sheet(&rows, true).outward(self.centre - DVec3::Y)
    }

    fn band(&self) -> Solid {
        let from = ROWS * 4 / 5;
        let rows: Vec<Vec<DVec3>> = (from..=ROWS)
            .map(|i| {
                (0..COLUMNS)
                    .map(|j| self.crease(self.place(i, j, 0.0082), i))
                    .collect()
            })
            .collect();
        Solid::sheet(&rows, true).outward(self.centre)
    }
}

/// Returns the distance of a knitted cap from the skin: hair lies under it, and its edge is turned
/// up.
fn knitted(row: usize) -> f64 {
    let t = row as f64 / ROWS as f64;
    let fold = smooth(((t - 0.70) / 0.05).clamp(0.0, 1.0))
        * (1.0 - smooth(((t - 0.97) / 0.03).clamp(0.0, 1.0)) * 0.5);
    lerp(0.014, 0.006, t * t) + 0.0045 * fold
}

/// Returns the distance from the centre to the skin in a direction.
fn reach_of(fit: &Fit, centre: DVec3, direction: DVec3) -> f64 {
    let mut far = 0.0_f64;
    for p in fit.skin.iter().step_by(STEP) {
        let d = *p - centre;
        let along = d.dot(direction);
        if along > far && along * along > NEAR_COS * NEAR_COS * d.length_squared() {
            far = along;
        }
    }
    far
}
