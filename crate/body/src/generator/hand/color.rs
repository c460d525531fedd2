//! Colours of the skin and the nails, and the lines of the palm.

use raconteur_base::{DVec3, curve};

use super::anatomy::{Anatomy, FINGER_COUNT};
use super::field::Field;
use super::nail::Nail;
use super::surface::{Skin, bell, blotches, finger_share};

/// A line in the palm or at the wrist.
pub(super) struct Crease {
    points: &'static [(f64, f64)],
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

/// Linear RGB of the skin at a vertex.
fn skin_color(
    anatomy: &Anatomy,
    base: DVec3,
    p: DVec3,
    normal: DVec3,
    ownership: &[f64; FINGER_COUNT],
) -> DVec3 {
    let body = 1.0 - curve::smooth(ownership.iter().sum());
    let mut palm = curve::smooth((normal.z + 0.1) / 0.6) * body;
    let (mut red, mut dark) = (0.0, 0.0);
    for (f, finger) in anatomy.fingers.iter().enumerate() {
        let m = curve::smooth((ownership[f] - 0.3) / 0.5);
        if m <= 0.0 {
            continue;
        }
        let local = finger.local(p);
        let section = finger.section(local.y);
        let joints = finger.joints();
        let height = local.z / section.palmar;
        palm = palm.max(curve::smooth((height + 0.15) / 0.5) * m);
        red += m * 0.8 * curve::smooth((finger.joint_coordinate(local.y) - 2.45) / 0.4);
        let dorsal = curve::smooth((-local.z / section.dorsal - 0.2) / 0.6);
        let palmar = curve::smooth((height + 0.1) / 0.6);
        for joint in &joints[1..3] {
            let d = local.y - joint;
            red += m * dorsal * 0.65 * bell(d / 5.5);
            dark += m * dorsal * 0.5 * bell(d / 4.5);
            dark += m * palmar * 0.45 * bell(d / 1.2);
        }
        if f > 0 {
            dark += m * palmar * 0.4 * bell((local.y - finger.along(0.405)) / 1.3);
            let knuckle = finger.origin - DVec3::Z * 12.0;
            red += 0.5 * bell((p - knuckle).length() / 8.0);
        }
        if local.z < 0.0 {
            let (e, v) = Nail::of(f).outline(finger, local);
            red += m * 0.4 * bell((e - 0.6) / 1.2) * curve::smooth((0.9 - v) / 0.3);
        }
    }
    for finger in &anatomy.fingers[1..] {
        let knuckle = finger.origin - DVec3::Z * 12.0;
        red += 0.5 * body * bell((p - knuckle).length() / 8.0);
    }
    let hypothenar = bell((p - DVec3::new(-26.0, 34.0, 20.0)).length() / 18.0);
    let thenar = bell((p - DVec3::new(28.0, 28.0, 30.0)).length() / 18.0);
    let heads = bell((p.y - 92.0) / 9.0) * f64::from(u8::from(p.z > 5.0));
    red += palm * (0.32 + 0.55 * hypothenar + 0.55 * thenar + 0.3 * heads);
    for crease in &CREASES {
        let (d, fade) = crease.at(p);
        dark += palm * body * fade * crease.depth_mm * 0.8 * bell(d / 1.5);
    }

    let mut c = base * (DVec3::ONE + DVec3::new(0.20, 0.17, 0.20) * palm);
    let back = (1.0 - palm) * curve::smooth((0.2 - normal.z) / 0.6);
    c *= DVec3::ONE - DVec3::new(0.06, 0.07, 0.09) * back;
    let coarse = blotches(p, 0.12);
    let red = (red + 0.15 * coarse).clamp(0.0, 1.2);
    c *= DVec3::ONE - DVec3::new(-0.02, 0.17, 0.20) * red;
    c *= DVec3::ONE - DVec3::new(0.13, 0.16, 0.18) * dark.clamp(0.0, 1.0);
    c *= 1.0 + 0.035 * coarse + 0.02 * blotches(p, 0.5);
    c.clamp(DVec3::ZERO, DVec3::ONE)
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

/// Colour and occlusion of every vertex.
pub(super) fn skin_colors(
    anatomy: &Anatomy,
    field: &Field<'_>,
    skin: &Skin,
    base: DVec3,
) -> Vec<[f64; 4]> {
    (0..skin.positions.len())
        .map(|i| {
            let (p, n) = (skin.positions[i], skin.normals[i]);
            let c = skin_color(anatomy, base, p, n, &skin.ownership[i]);
            let mut open = occlusion(field, p, n);
            if finger_share(&skin.ownership[i]) < 0.3 {
                for crease in &CREASES {
                    let (d, fade) = crease.at(p);
                    let palm = curve::smooth((n.z - 0.3) / 0.5);
                    open *= 1.0 - 0.3 * palm * fade * crease.depth_mm * bell(d / 1.6);
                }
            }
            [c.x, c.y, c.z, open]
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
