//! Openness of the skin, colours of the nails, and the lines of the palm.

use raconteur_base::{DVec3, curve};

use super::crease::CREASES;
use super::field::Field;
use super::surface::{Skin, bell, finger_share};

/// Returns the openness of the surface, 1 if unoccluded: the field's growth along the normal
/// relative to the distance.
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

/// Returns the openness of every vertex, 0..1.
pub(super) fn openness(field: &Field<'_>, skin: &Skin) -> Vec<f64> {
    (0..skin.positions.len())
        .map(|i| {
            let (p, n) = (skin.positions[i], skin.normals[i]);
            let mut open = occlusion(field, p, n);
            if finger_share(&skin.ownership[i]) < 0.3 {
                for crease in &CREASES {
                    let (d, fade) = crease.distance_and_depth(p);
                    let palm = curve::smooth((n.z - 0.3) / 0.5);
                    open *= 1.0 - 0.2 * palm * fade * crease.depth_mm * bell(d / 1.6);
                }
            }
            open
        })
        .collect()
}

/// Returns the linear RGB of a nail plate at a position across (−1..1) and along (0 root, 1 free
/// edge).
pub(super) fn nail_color(base: DVec3, f: usize, across: f64, along: f64) -> DVec3 {
    let u = across.abs();
    // The bed shows through: a little lighter and pinker than the skin.
    let bed = base * DVec3::new(1.14, 1.16, 1.36);
    // Along its sides, where the plate dives under the fold, it is darker and redder.
    let fold = curve::smooth((u - 0.55) / 0.45);
    let bed = bed * (DVec3::ONE - fold * DVec3::new(0.20, 0.36, 0.38));
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
