//! Linings derived from their rims: of lids, mouth and nostrils.

use raconteur_base::{DVec3, ops};

use super::cage::{Key, Points};

/// Radius of the eyeball, mm (adult mean 12.0–12.2; Bekerman et al. 2014,
/// doi:10.1155/2014/503645; *paper*).
pub(crate) const GLOBE_RADIUS_MM: f64 = 12.2;

pub(super) fn ring<const N: usize>(points: &Points, key: impl Fn(usize) -> Key) -> [DVec3; N] {
    core::array::from_fn(|k| points[&key(k)])
}

/// Share of each position that belongs to a canthus and leaves the globe.
pub(super) const CANTHUS: [f64; 16] = [
    1.0, 0.55, 0.1, 0.0, 0.0, 0.0, 0.0, 0.1, 0.5, 0.1, 0.0, 0.0, 0.0, 0.0, 0.1, 0.55,
];

/// Adds the inner margins of the lids and their lining behind them, derived from the lash line.
pub(super) fn line_lids(all: &mut Points, centre: DVec3) {
    let margin: [DVec3; 16] = ring(all, |k| Key::eye(5, k));
    let opening = DVec3::new(centre.x, centre.y - 0.4, 0.0);
    for k in 0..16 {
        let c = CANTHUS[k];
        let d = margin[k] - centre;
        let inner = centre + d * ((GLOBE_RADIUS_MM + 0.12) / d.length());
        let inner = inner.lerp(margin[k] + DVec3::new(0.0, 0.0, -2.2), c);
        all.insert(Key::eye(6, k), inner);
        let out = (inner - centre).normalize();
        let radial = DVec3::new(inner.x - opening.x, inner.y - opening.y, 0.0).normalize();
        for (r, turn, radius) in [
            (7, 0.35, GLOBE_RADIUS_MM + 0.35),
            (8, 0.8, GLOBE_RADIUS_MM + 0.5),
        ] {
            let d = out * ops::cos(turn) + radial * ops::sin(turn);
            let mut lining = centre + d.normalize() * radius;
            if (r, k) == (7, 8) {
                // The outer corner leaves the globe; its lining would fold back on the lid.
                lining += DVec3::new(0.6, 0.0, -0.3);
            }
            all.insert(Key::eye(r, k), lining);
        }
    }
}

/// Distance of the points of each lip from the line where the lips meet, mm, from the middle to the
/// corner: the skin bulges by a tenth less between them, so that the lips touch there without
/// intersecting.
pub(super) const LIP_BULGE_MM: [f64; 7] = [0.66, 0.65, 0.62, 0.55, 0.53, 0.40, 0.0];

/// Returns the direction of a lip position: 1 on the upper lip, −1 on the lower, 0 at the corner.
pub(super) fn upward(k: usize) -> f64 {
    ((6.0 - k as f64) * 0.7).clamp(-1.0, 1.0)
}

/// Builds the vestibule and the cavity behind the line where the lips meet.
pub(super) fn line_mouth(all: &mut Points) {
    for k in 0..13 {
        let mut p = all[&Key::mouth(5, k)];
        for (r, step, widen) in [
            (6, [6.5, -2.8], 1.0),
            (7, [5.5, -8.0], 1.16),
            (8, [2.0, -32.0], 1.0),
        ] {
            p += DVec3::new(0.0, step[0] * upward(k), step[1]);
            p.x *= widen;
            all.insert(Key::mouth(r, k), p);
        }
    }
}

/// Tip of the nose before its base on the mean head, mm.
const MEAN_PROTRUSION_MM: f64 = 15.3;

/// Lines the nostril.
pub(super) fn nostril(all: &mut Points) {
    let rim: [DVec3; 8] = ring(all, |k| Key::nostril(0, k));
    let centre = rim.iter().sum::<DVec3>() / 8.0;
    // Axes of the rim: the long one by power iteration on the covariance.
    let spread = |v: DVec3| {
        rim.iter()
            .map(|&p| (p - centre) * (p - centre).dot(v))
            .sum::<DVec3>()
    };
    let mut long = DVec3::new(0.3, 0.0, 1.0);
    for _ in 0..60 {
        long = spread(long).normalize();
    }
    let mut across = DVec3::X;
    for _ in 0..60 {
        across = spread(across - long * across.dot(long));
        across = (across - long * across.dot(long)).normalize();
    }
    let normal = long.cross(across);
    let half = |axis: DVec3| spread(axis).dot(axis).max(1e-9).sqrt();
    let (a, b) = (half(long), half(across));
    // A small nose has a shallow cavity, or it would pierce the ala.
    let reach = all[&Key::Grid(0, 11)].z - all[&Key::Grid(0, 15)].z;
    let rise = (reach / MEAN_PROTRUSION_MM).clamp(0.6, 1.1);
    let way = DVec3::new(0.05, 0.92, 0.25);
    // Its rim rolls in less, so that the lining has room behind it. It enters nearly perpendicular
    // to the rim, which is oblique where the wings are raised.
    let inward = normal * normal.dot(way).signum();
    let (up, deeper) = (
        inward.lerp(way, 0.3) * (rise * rise),
        way * ops::pow(rise, 1.5),
    );
    for (k, &p) in rim.iter().enumerate() {
        let d = p - centre;
        let turn = ops::atan2(d.dot(across) / b, d.dot(long) / a);
        let round = long * (ops::cos(turn) * a * 0.5)
            + across * (ops::sin(turn) * b * 0.5)
            + normal * d.dot(normal);
        all.insert(
            Key::nostril(1, k),
            centre + (d * 0.2 + round * 0.8) * 0.78 + up * 1.6,
        );
        all.insert(Key::nostril(2, k), centre + round * 0.7 + deeper * 5.0);
        let deep = round * 0.45 + deeper * 10.0 + DVec3::new(-1.0, 0.0, -2.0);
        all.insert(Key::nostril(3, k), centre + deep);
    }
}
