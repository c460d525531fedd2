//! Openness of the skin, colours of the nails, and the lines of the palm.

use raconteur_base::{DVec3, curve};

use super::field::Field;
use super::surface::{Skin, bell, finger_share};

/// A line in the palm or at the wrist.
pub(super) struct Crease {
    /// Places in the palm's plane (x, y), mm.
    pub(super) points: &'static [(f64, f64)],
    /// Depth, mm.
    pub(super) depth_mm: f64,
}

/// Lines of the palm: thenar, two transverse, wrist.
pub(super) const CREASES: [Crease; 4] = [
    Crease {
        points: &[
            (31.0, 66.0),
            (22.0, 63.0),
            (13.0, 55.0),
            (7.0, 43.0),
            (4.0, 30.0),
            (4.0, 17.0),
            (6.0, 8.0),
        ],
        depth_mm: 1.0,
    },
    Crease {
        points: &[
            (33.0, 68.0),
            (22.0, 67.0),
            (8.0, 62.0),
            (-8.0, 54.0),
            (-22.0, 46.0),
            (-31.0, 40.0),
        ],
        depth_mm: 0.8,
    },
    Crease {
        points: &[
            (12.0, 88.0),
            (8.0, 80.0),
            (-4.0, 73.0),
            (-18.0, 69.0),
            (-30.0, 66.0),
            (-39.0, 66.0),
        ],
        depth_mm: 0.9,
    },
    Crease {
        points: &[(24.0, 4.0), (12.0, 1.0), (-6.0, 2.0), (-24.0, 4.0)],
        depth_mm: 0.4,
    },
];

impl Crease {
    /// Distance in the palm's plane, mm, and how far the line has set in there, 0 to 1
    /// (it fades at both ends).
    pub(super) fn at(&self, p: DVec3) -> (f64, f64) {
        let mut best = (f64::INFINITY, 0.0);
        let mut length = 0.0;
        for pair in self.points.windows(2) {
            let (ax, ay) = pair[0];
            let (dx, dy) = (pair[1].0 - ax, pair[1].1 - ay);
            let squared = dx * dx + dy * dy;
            let t = (((p.x - ax) * dx + (p.y - ay) * dy) / squared).clamp(0.0, 1.0);
            let (ex, ey) = (p.x - ax - t * dx, p.y - ay - t * dy);
            let d = (ex * ex + ey * ey).sqrt();
            if d < best.0 {
                best = (d, length + t * squared.sqrt());
            }
            length += squared.sqrt();
        }
        let along = best.1 / length;
        (
            best.0,
            curve::smooth(along / 0.12) * curve::smooth((1.0 - along) / 0.15),
        )
    }
}

/// How open the surface is, 1 in the clear: the field's growth along the normal against
/// the distance walked.
fn occlusion(field: &Field<'_>, p: DVec3, normal: DVec3) -> f64 {
    let mut hidden = 0.0;
    let mut weight = 0.0;
    for (step, share) in [(1.5, 0.4), (4.0, 0.35), (9.0, 0.25)] {
        let d = field.distance(p + normal * step);
        hidden += share * ((step - d) / step).clamp(0.0, 1.0);
        weight += share;
    }
    1.0 - 0.75 * hidden / weight
}

/// How open every vertex is, 0..1.
pub(super) fn openness(field: &Field<'_>, skin: &Skin) -> Vec<f64> {
    (0..skin.positions.len())
        .map(|i| {
            let (p, n) = (skin.positions[i], skin.normals[i]);
            let mut open = occlusion(field, p, n);
            if finger_share(&skin.ownership[i]) < 0.3 {
                for crease in &CREASES {
                    let (d, fade) = crease.at(p);
                    let palm = curve::smooth((n.z - 0.3) / 0.5);
                    open *= 1.0 - 0.2 * palm * fade * crease.depth_mm * bell(d / 1.6);
                }
            }
            open
        })
        .collect()
}

/// Linear RGB of a nail plate across (−1..1) and along (0 root, 1 free edge).
pub(super) fn nail_color(base: DVec3, f: usize, across: f64, along: f64) -> DVec3 {
    let u = across.abs();
    // The bed shows through: a little lighter and pinker than the skin.
    let bed = base * DVec3::new(1.14, 1.16, 1.36);
    let lunula = base * DVec3::new(1.24, 1.47, 1.80);
    let free = base.lerp(DVec3::new(0.78, 0.70, 0.60), 0.7);
    let moon = curve::smooth((0.27 - along - 0.10 * u * u) / 0.05);
    let edge = curve::smooth((along - 0.90 - 0.04 * (1.0 - u * u) + 0.06 * u * u) / 0.03);
    // Moons are large on the thumb and vanish towards the little finger.
    let moon = moon * if f < 3 { 0.55 } else { 0.2 };
    bed.lerp(lunula, moon)
        .lerp(free, edge)
        .clamp(DVec3::ZERO, DVec3::ONE)
}
