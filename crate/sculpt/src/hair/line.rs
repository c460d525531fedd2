//! Hairline: a closed curve on the scalp, and the distance of a point inside it.

use std::f64::consts::TAU;

use raconteur_base::{DVec2, DVec3, ops};

use super::{HairParams, HairStyle};
use crate::texture::space_noise;

/// Landmarks of a hairline from the middle of the forehead to the nape: azimuth from the front and
/// elevation, relative to the origin of the hair frame, degrees; mirrored to the other side.
type Landmarks = [[f64; 2]; 25];

/// A woman's: oval, fine, low at the temples.
const OVAL: Landmarks = [
    [0.0, 30.5],
    [8.0, 31.0],
    [16.0, 31.5],
    [25.0, 32.0],
    [33.0, 30.5],
    [40.0, 26.0],
    [46.0, 20.5],
    [51.0, 15.0],
    [57.0, 11.0],
    [63.0, 6.0],
    [68.0, -2.0],
    [72.0, -11.0],
    [76.0, -19.0],
    [80.0, -19.0],
    [83.0, -10.0],
    [87.0, -3.0],
    [95.0, -2.0],
    [104.0, -6.0],
    [110.0, -16.0],
    [115.0, -30.0],
    [124.0, -44.0],
    [138.0, -51.0],
    [152.0, -55.0],
    [166.0, -52.0],
    [180.0, -51.0],
];

/// A man's: squarer, with corners at the temples and sideburns.
const SQUARE: Landmarks = [
    [0.0, 35.0],
    [10.0, 35.5],
    [20.0, 37.0],
    [29.0, 39.0],
    [36.0, 37.0],
    [42.0, 29.0],
    [47.0, 21.0],
    [52.0, 15.0],
    [58.0, 11.0],
    [64.0, 6.0],
    [69.0, -3.0],
    [73.0, -13.0],
    [77.0, -22.0],
    [82.0, -22.0],
    [84.0, -12.0],
    [87.0, -3.0],
    [95.0, -2.0],
    [104.0, -6.0],
    [110.0, -16.0],
    [115.0, -30.0],
    [124.0, -42.0],
    [138.0, -48.0],
    [152.0, -50.0],
    [166.0, -49.0],
    [180.0, -48.0],
];

/// Upward shift of the line at full male recession, degrees, by landmark (Norwood's stage III to
/// IV, 1975, doi:10.1097/00007611-197511000-00009; designed).
const RECEDED: [f64; 25] = [
    6.0, 7.0, 10.0, 17.0, 21.0, 24.0, 21.0, 16.0, 10.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
];

/// Centre of crown thinning; the next constant is the largest bare radius, metres.
const CROWN: DVec3 = DVec3::new(0.0, 0.085, -0.020);
const BARE_CROWN_M: f64 = 0.082;

/// Radius of the sphere on whose map angles become lengths, metres.
const RADIUS_M: f64 = 0.095;
/// Backward tilt of the map's pole, radians.
const TIP: f64 = 0.349;
/// Half the side of the square hairline raster on the flattened scalp, metres.
pub(super) const HALF_M: f64 = 0.225;
/// Side of the raster that stores distances.
const SIDE: usize = 320;
/// Points of the curve to a landmark.
const STEPS: usize = 6;

/// Returns azimuth from the front and elevation of a position, degrees.
pub(super) fn angles(p: DVec3) -> (f64, f64) {
    (
        ops::atan2(p.x, p.z).to_degrees(),
        ops::asin_clamped(p.y / p.length().max(1e-9)).to_degrees(),
    )
}

/// Maps a position on the scalp to the plane: great-circle distances from a pole at the crown,
/// metres.
pub(super) fn flat(p: DVec3) -> DVec2 {
    let d = p.normalize_or(DVec3::Y);
    let (sine, cosine) = (ops::sin(TIP), ops::cos(TIP));
    let up = d.y * cosine - d.z * sine;
    let front = d.y * sine + d.z * cosine;
    let angle = ops::acos_clamped(up);
    let r = (d.x * d.x + front * front).sqrt() + 1e-9;
    DVec2::new(d.x, front) * (angle * RADIUS_M / r)
}

fn on_sphere([azimuth, elevation]: [f64; 2]) -> DVec3 {
    let (a, e) = (azimuth.to_radians(), elevation.to_radians());
    DVec3::new(
        ops::cos(e) * ops::sin(a),
        ops::sin(e),
        ops::cos(e) * ops::cos(a),
    )
}

/// Hairline of a person, stored as a signed-distance raster on the flattened scalp.
pub(super) struct Line {
    /// Distance inside, metres, negative outside, on a raster of the flat scalp.
    raster: Vec<f32>,
    seed: u64,
}

impl Line {
    pub(super) fn new(p: &HairParams) -> Self {
        // A bald crown leaves a wreath of hair.
        let (recession, thinning) = match p.style {
            HairStyle::Balding => (1.0, 1.0),
            _ => (p.recession, p.thinning),
        };
        let table = if p.square { &SQUARE } else { &OVAL };
        let half: Vec<[f64; 2]> = table
            .iter()
            .zip(RECEDED)
            .map(|([a, e], up)| [*a, e + up * recession])
            .collect();
        let other = half[1..half.len() - 1].iter().rev().map(|[a, e]| [-a, *e]);
        let corners: Vec<DVec2> = half
            .iter()
            .copied()
            .chain(other)
            .map(|c| flat(on_sphere(c)))
            .collect();
        let curve = rounded(&corners);
        let at = |i: usize| (i as f64 / (SIDE - 1) as f64 * 2.0 - 1.0) * HALF_M;
        let crown = flat(CROWN);
        let bare_m = thinning * BARE_CROWN_M;
        let raster = (0..SIDE * SIDE)
            .map(|i| {
                let q = DVec2::new(at(i % SIDE), at(i / SIDE));
                let within = inside(&curve, q);
                let off_crown = if bare_m > 0.0 {
                    (q - crown).length() - bare_m
                } else {
                    f64::MAX
                };
                within.min(off_crown) as f32
            })
            .collect();
        Self {
            raster,
            seed: p.seed,
        }
    }

    /// Returns the distance inside the smoothed hairline, metres.
    pub(super) fn smooth_distance(&self, p: DVec3) -> f64 {
        let q = (flat(p) / HALF_M + 1.0) * 0.5 * (SIDE - 1) as f64;
        let q = q.clamp(DVec2::ZERO, DVec2::splat(SIDE as f64 - 1.001));
        let cell = q.floor();
        let f = q - cell;
        let first = cell.y as usize * SIDE + cell.x as usize;
        let v = |i: usize| f64::from(self.raster[i]);
        let low = v(first) + (v(first + 1) - v(first)) * f.x;
        let high = v(first + SIDE) + (v(first + SIDE + 1) - v(first + SIDE)) * f.x;
        low + (high - low) * f.y
    }

    /// Returns the distance of a position inside the hairline, metres; the line is made uneven with
    /// noise.
    pub(super) fn distance(&self, p: DVec3) -> f64 {
        self.smooth_distance(p)
            + 0.0016 * space_noise(self.seed + 1, p * 160.0)
            + 0.0024 * space_noise(self.seed + 2, p * 60.0)
    }
}

/// Returns a closed Catmull–Rom curve through the corners.
fn rounded(corners: &[DVec2]) -> Vec<DVec2> {
    let n = corners.len();
    let at = |i: usize, k: usize| corners[(i + k + n - 1) % n];
    (0..n * STEPS)
        .map(|j| {
            let (i, t) = (j / STEPS, (j % STEPS) as f64 / STEPS as f64);
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| at(i, k));
            (b * 2.0
                + (c - a) * t
                + (a * 2.0 - b * 5.0 + c * 4.0 - d) * (t * t)
                + (b * 3.0 - a - c * 3.0 + d) * (t * t * t))
                * 0.5
        })
        .collect()
}

/// Returns the distance of a point from a closed curve, positive inside. The winding number of the
/// curve decides the sign.
fn inside(curve: &[DVec2], p: DVec2) -> f64 {
    let (mut nearest, mut turn) = (f64::MAX, 0.0);
    for (i, &a) in curve.iter().enumerate() {
        let b = curve[(i + 1) % curve.len()];
        let (edge, to) = (b - a, p - a);
        let t = (to.dot(edge) / edge.length_squared().max(1e-12)).clamp(0.0, 1.0);
        nearest = nearest.min((to - edge * t).length_squared());
        turn += (a - p).angle_to(b - p);
    }
    let sign = if turn.abs() > 0.5 * TAU { 1.0 } else { -1.0 };
    sign * nearest.sqrt()
}
