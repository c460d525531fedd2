//! Face morph targets: handles on named points of the cage move, and the rest follows by the same
//! fairness as in the head's shape, solved for displacements.
//!
//! Names follow ARKit's blend shapes where one fits. Amounts are anatomical estimates for a woman's
//! face, chosen by eye; millimetres.

use raconteur_base::{DMat3, DQuat, DVec3, Side, mirror_vector};

use super::cage::{Cage, Key};
use super::rig::{JAW_HINGE_MM, Shares, smooth};
use super::solve::{Fairness, Solved};
use crate::least_squares::{Terms, least_squares};

/// Jaw angle at which `mouthClose` at weight 1 leaves the lips just touching, radians.
pub(crate) const CLOSE_JAW_RAD: f64 = 0.2;

/// Morph target of the head, as displacements of the cage.
#[derive(Clone, Debug)]
pub(crate) struct CageMorph {
    pub(crate) name: &'static str,
    /// Displacement of each cage vertex at weight 1, mm.
    pub(crate) deltas: Vec<DVec3>,
}

/// Proximity of each mouth position to the corner, 0..1.
const CORNER: [f64; 13] = [
    0.0, 0.02, 0.08, 0.22, 0.48, 0.82, 1.0, 0.82, 0.48, 0.22, 0.08, 0.02, 0.0,
];

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// Displacement of the lips by a morph, by ring and position on the left half.
type Lips = fn(u8, usize, DVec3) -> DVec3;

/// Shift with its falloff about an anchor on the left half: centre, radius, displacement.
type Mass = ([f64; 3], f64, [f64; 3]);

struct Recipe {
    name: &'static str,
    lips: Option<Lips>,
    masses: &'static [Mass],
    /// True if the right half moves too (mirrored).
    both: bool,
}

/// Returns 1 on the red of the upper lip, falling to 0 at the corner and on the lower lip.
fn upper(k: usize) -> f64 {
    ((6.0 - k as f64) / 3.0).clamp(0.0, 1.0)
}

fn lower(k: usize) -> f64 {
    upper(12 - k)
}

/// Returns the share by which a lip ring turns, 0..1: inner rings turn more than the border.
fn inward(ring: u8) -> f64 {
    f64::from(ring.min(5)) / 5.0
}

const SMILE: Lips = |ring, k, _| {
    let c = CORNER[k];
    let thin = if ring == 1 {
        -0.5 * upper(k) + 0.5 * lower(k)
    } else {
        0.0
    };
    v(
        6.0 * c,
        5.2 * c + 0.5 * lower(k) + 0.4 * upper(k) + thin,
        -4.6 * c - 1.2 * (1.0 - c),
    )
};
const FROWN: Lips = |_, k, _| {
    let c = CORNER[k];
    v(
        1.0 * c,
        -4.6 * c + 0.5 * (1.0 - c),
        -1.2 * c + 0.4 * (1.0 - c),
    )
};
const STRETCH: Lips = |ring, k, _| {
    let c = CORNER[k];
    let thin = if ring <= 3 {
        0.4 * (lower(k) - upper(k))
    } else {
        0.0
    };
    v(6.0 * c, -0.8 * c + thin, -4.0 * c - 0.8 * (1.0 - c))
};
const PUCKER: Lips = |ring, k, p| {
    let turn = inward(ring);
    let forward = 4.0 + 3.2 * turn + 2.6 * CORNER[k];
    let roll = (upper(k) - lower(k)) * (0.4 + 0.5 * turn * (1.0 - turn) * 4.0);
    v(-0.44 * p.x, roll, forward)
};
const FUNNEL: Lips = |ring, k, p| {
    let turn = inward(ring);
    let open = 1.2 + 3.4 * turn;
    v(
        -0.27 * p.x,
        open * upper(k) - (open + 1.2) * lower(k),
        3.2 + 2.6 * (1.0 - turn) + 2.6 * CORNER[k],
    )
};
const PRESS: Lips = |ring, k, _| {
    let red = match ring {
        1 => 0.8,
        2 => 0.9,
        3 => 0.55,
        _ => 0.0,
    };
    let c = 1.0 - 0.7 * CORNER[k];
    let back = if ring == 3 || ring == 2 { -1.8 } else { -0.7 };
    v(
        0.3 * CORNER[k],
        (-1.5 * upper(k) + 1.9 * lower(k)) * red * c,
        back * c,
    )
};
const ROLL_LOWER: Lips = |ring, k, _| {
    let l = lower(k) * (1.0 - 0.4 * CORNER[k]);
    let (up, back) = match ring {
        0 => (0.6, -0.8),
        1 => (2.2, -3.2),
        2 => (2.4, -4.4),
        3 => (1.4, -6.6),
        4 => (-0.8, -7.0),
        _ => (-1.6, -5.4),
    };
    v(0.0, up * l, back * l)
};
const LOWER_DOWN: Lips = |ring, k, _| {
    let l = lower(k);
    let turn = if ring >= 4 { 0.9 } else { 1.0 };
    v(1.2 * CORNER[k], -4.2 * l * turn - 0.6 * CORNER[k], 0.3 * l)
};
const UPPER_UP: Lips = |ring, k, _| {
    let u = upper(k) * (0.75 + 0.25 * CORNER[k.min(4)]);
    let turn = if ring >= 4 { 0.9 } else { 1.0 };
    v(0.6 * CORNER[k], 3.8 * u * turn + 0.4 * CORNER[k], 0.2 * u)
};
const SNEER: Lips = |_, k, _| v(0.0, 1.6 * upper(k) * smooth(0.0, 2.0, k as f64), 0.0);

#[rustfmt::skip]
const RECIPES: &[Recipe] = &[
    Recipe { name: "mouthSmileLeft", lips: Some(SMILE), both: false, masses: &[
        ([46.0, -14.0, 84.0], 11.0, [1.2, 4.2, 2.0]),
        ([33.0, 1.0, 85.0], 7.0, [0.2, 1.8, 0.7]),
        ([33.0, -47.0, 88.0], 5.0, [4.2, 3.6, -2.0]),
    ] },
    Recipe { name: "mouthFrownLeft", lips: Some(FROWN), both: false, masses: &[
        ([10.0, -78.0, 100.0], 8.0, [0.0, 1.2, 0.6]),
    ] },
    Recipe { name: "mouthStretchLeft", lips: Some(STRETCH), both: false, masses: &[] },
    Recipe { name: "mouthPucker", lips: Some(PUCKER), both: true, masses: &[
        ([36.0, -44.0, 84.0], 9.0, [-2.4, 0.0, 0.8]),
    ] },
    Recipe { name: "mouthFunnel", lips: Some(FUNNEL), both: true, masses: &[] },
    Recipe { name: "mouthPress", lips: Some(PRESS), both: true, masses: &[] },
    Recipe { name: "mouthRollLower", lips: Some(ROLL_LOWER), both: true, masses: &[] },
    Recipe { name: "mouthLowerDown", lips: Some(LOWER_DOWN), both: true, masses: &[] },
    Recipe { name: "mouthUpperUp", lips: Some(UPPER_UP), both: true, masses: &[
        ([21.0, -30.0, 95.0], 7.0, [0.3, 1.6, 0.4]),
    ] },
    Recipe { name: "browInnerUp", lips: None, both: true, masses: &[
        ([13.0, 44.0, 96.0], 10.0, [-0.4, 5.6, 0.3]),
        ([10.0, 62.0, 92.0], 13.0, [0.0, 2.4, 0.5]),
    ] },
    Recipe { name: "browOuterUpLeft", lips: None, both: false, masses: &[
        ([45.0, 46.0, 84.0], 11.0, [0.3, 5.2, 0.6]),
        ([44.0, 62.0, 80.0], 13.0, [0.0, 2.0, 0.3]),
    ] },
    Recipe { name: "browDownLeft", lips: None, both: false, masses: &[
        ([16.0, 43.0, 95.5], 10.0, [-2.4, -4.2, 0.9]),
        ([36.0, 46.0, 89.0], 11.0, [-0.8, -2.6, 0.5]),
    ] },
    Recipe { name: "eyeSquintLeft", lips: None, both: false, masses: &[
        ([32.0, 5.0, 85.0], 8.0, [0.0, 2.6, 1.0]),
        ([52.0, 10.0, 76.0], 8.0, [-0.8, 1.4, 0.6]),
    ] },
    Recipe { name: "noseSneerLeft", lips: Some(SNEER), both: false, masses: &[
        ([17.0, -18.0, 100.0], 6.0, [0.3, 2.6, 0.2]),
        ([12.0, 2.0, 98.0], 6.0, [-0.3, 1.6, 0.6]),
    ] },
    Recipe { name: "cheekPuff", lips: None, both: true, masses: &[
        ([46.0, -42.0, 80.0], 14.0, [6.4, 0.0, 5.6]),
        ([24.0, -36.0, 95.0], 8.0, [0.6, 0.0, 2.2]),
    ] },
];

/// Returns the weight of a soft mass at a vertex: the lids' rings stay on the globe.
fn reach(key: Key) -> f64 {
    match key {
        Key::Eye(1, _) => 0.7,
        Key::Eye(2, _) => 0.45,
        Key::Eye(3, _) => 0.2,
        Key::Eye(..) | Key::Nostril(2.., _) => 0.0,
        _ => 1.0,
    }
}

fn mass_at(masses: &[Mass], warp: &dyn Fn(DVec3) -> DVec3, p: DVec3) -> DVec3 {
    masses
        .iter()
        .map(|&(at, radius, shift)| {
            let d = (p - warp(DVec3::from_array(at))).length_squared();
            DVec3::from_array(shift) * raconteur_base::ops::exp(-d / (2.0 * radius * radius))
        })
        .sum()
}

/// Spreads the displacement of the lips over the skin about them.
struct Spread<'a> {
    cage: &'a Cage,
    fair: Vec<Terms>,
    solved: &'a Solved,
}

impl Spread<'_> {
    /// Solves a morph. `lips` gives displacements on the mouth's rings, already on both halves.
    /// `None` from the solver cannot occur on the built-in cage and leaves the lips' own
    /// displacement.
    fn solve(&self, lips: impl Fn(u8, usize, Side, DVec3) -> DVec3) -> Vec<DVec3> {
        let mut rows = Vec::new();
        let mut hard = vec![None; self.cage.len()];
        for (i, &(key, side)) in self.cage.keys.iter().enumerate() {
            let p = self.solved.cage_points[i];
            let (weight, value) = match key.mouth_position() {
                Some((0, k)) => (0.6, 0.62 * lips(0, k, side, p)),
                Some((ring @ 1..=5, k)) => {
                    let d = lips(ring, k, side, p);
                    hard[i] = Some(d);
                    (20.0, d)
                }
                // The bag follows less with growing depth.
                Some((ring, k)) => {
                    let d = lips(5, k, side, p) * [0.8, 0.35, 0.0][usize::from(ring - 6).min(2)];
                    hard[i] = Some(d);
                    (20.0, d)
                }
                None if is_anchor(key, p) => (2.0, DVec3::ZERO),
                None => continue,
            };
            rows.push((vec![(i as u32, weight)], value * weight));
        }
        let still = || vec![DVec3::ZERO; self.cage.len()];
        let mut deltas = least_squares(self.cage.len(), &rows, &self.fair).unwrap_or_else(still);
        for (d, h) in deltas.iter_mut().zip(hard) {
            *d = h.unwrap_or(*d);
        }
        for (d, &(key, _)) in deltas.iter_mut().zip(&self.cage.keys) {
            if key.on_midline() && d.x.abs() < 1e-9 {
                d.x = 0.0;
            }
        }
        deltas
    }
}

/// Vertices that the lips do not drag along.
fn is_anchor(key: Key, p: DVec3) -> bool {
    match key {
        Key::Grid(i, j) => {
            let mouth = v(0.0, -48.0, 92.0);
            let far = ((p - mouth) / v(1.15, 1.0, 1.0)).length() > 46.0;
            far || (j <= 14 && i <= 5) || j <= 11 || j >= 26
        }
        _ => true,
    }
}

/// Computes all morphs on the cage; right halves are mirrored from the left ones.
pub(crate) fn morphs(
    cage: &Cage,
    solved: &Solved,
    shares: &[Shares],
    warp: &dyn Fn(DVec3) -> DVec3,
) -> Vec<CageMorph> {
    let fair = Fairness::new(&cage.faces, cage.len());
    let spread = Spread {
        cage,
        fair: fair.rows(Some(&solved.cage_points)),
        solved,
    };
    let mut all = Vec::new();
    for recipe in RECIPES {
        let on = |side: Side| recipe.both || side == Side::Left;
        let mut deltas = match recipe.lips {
            None => vec![DVec3::ZERO; cage.len()],
            Some(lips) => spread.solve(|ring, k, side, p| {
                let left = if side == Side::Left {
                    p
                } else {
                    mirror_vector(p)
                };
                let mut d = lips(ring, k, left);
                if k == 0 || k == 12 {
                    // The midline moves by both halves' mean.
                    d.x = 0.0;
                    return if recipe.both { d } else { d * 0.5 };
                }
                // A one-sided morph fades over the middle third of the lips.
                let share = if recipe.both {
                    1.0
                } else {
                    smooth(-9.0, 9.0, p.x)
                };
                let d = if side == Side::Left {
                    d
                } else {
                    mirror_vector(d)
                };
                if recipe.both || side == Side::Left {
                    d * share
                } else {
                    v(0.0, d.y, d.z) * share
                }
            }),
        };
        for (i, &(key, side)) in cage.keys.iter().enumerate() {
            let p = solved.cage_points[i];
            let is_lip = matches!(key, Key::Mouth(..));
            if is_lip && recipe.lips.is_some() {
                continue;
            }
            let sides: &[Side] = if key.on_midline() {
                &Side::BOTH
            } else {
                &[side]
            };
            for &s in sides.iter().filter(|&&s| on(s)) {
                let left = if s == Side::Left { p } else { mirror_vector(p) };
                let d = mass_at(recipe.masses, warp, left) * reach(key);
                let d = if s == Side::Left { d } else { mirror_vector(d) };
                deltas[i] += d;
            }
            if key.on_midline() && recipe.both {
                deltas[i].x = 0.0;
            }
        }
        if recipe.name == "eyeSquintLeft" {
            raise_lower_margin(cage, solved, &mut deltas);
        }
        let mirrored = (!recipe.both).then(|| mirror(cage, &deltas));
        all.push(CageMorph {
            name: recipe.name,
            deltas,
        });
        if let Some(deltas) = mirrored {
            all.push(CageMorph {
                name: right_name(recipe.name),
                deltas,
            });
        }
    }
    all.push(CageMorph {
        name: "mouthClose",
        deltas: mouth_close(cage, &spread, shares),
    });
    all
}

fn right_name(left: &'static str) -> &'static str {
    match left {
        "mouthSmileLeft" => "mouthSmileRight",
        "mouthFrownLeft" => "mouthFrownRight",
        "mouthStretchLeft" => "mouthStretchRight",
        "browOuterUpLeft" => "browOuterUpRight",
        "browDownLeft" => "browDownRight",
        "eyeSquintLeft" => "eyeSquintRight",
        _ => "noseSneerRight",
    }
}

fn mirror(cage: &Cage, deltas: &[DVec3]) -> Vec<DVec3> {
    cage.keys
        .iter()
        .map(|&(key, side)| mirror_vector(deltas[cage.vertex(key, side.opposite())]))
        .collect()
}

/// Raises the edge of the lower lid over the globe by about a millimetre.
fn raise_lower_margin(cage: &Cage, solved: &Solved, deltas: &mut [DVec3]) {
    for k in 9..16usize {
        let middle = 1.0 - ((k as f64 - 12.0) / 4.0) * ((k as f64 - 12.0) / 4.0);
        for (ring, share) in [(3, 0.8), (4, 0.95), (5, 1.0), (6, 1.0), (7, 0.9)] {
            let i = cage.vertex(Key::eye(ring, k), Side::Left);
            // Below the globe's equator, the surface moves forward as it rises.
            let forward = if solved.cage_points[i].z > 0.0 {
                0.42
            } else {
                0.0
            };
            deltas[i] = v(0.0, 1.3, 1.3 * forward) * middle * share;
        }
    }
}

/// Returns the displacement that seals the lips over an open jaw: skinned at [`CLOSE_JAW_RAD`], it
/// brings both lips to one line a third of the way down.
fn mouth_close(cage: &Cage, spread: &Spread, shares: &[Shares]) -> Vec<DVec3> {
    let turn = DQuat::from_rotation_x(CLOSE_JAW_RAD);
    let skinned = |p: DVec3, w: f64| p.lerp(JAW_HINGE_MM + turn * (p - JAW_HINGE_MM), w);
    // Undoes the skinning of a displacement.
    let unskin = |d: DVec3, w: f64| {
        let forward = DMat3::from_quat(turn) * w + DMat3::IDENTITY * (1.0 - w);
        forward.inverse() * d
    };
    spread.solve(|_, k, side, p| {
        // Both lips at one position take the mean of their own skinned movement.
        let moved = |k: usize| {
            let i = cage.vertex(Key::mouth(4, k), side);
            let p = spread.solved.cage_points[i];
            skinned(p, shares[i].jaw) - p
        };
        let (up, low) = (k.min(12 - k), k.max(12 - k));
        let meet = moved(up).lerp(moved(low), 0.36);
        let own = shares[cage.vertex(Key::mouth(4, k), side)].jaw;
        unskin(p + meet - skinned(p, own), own)
    })
}
