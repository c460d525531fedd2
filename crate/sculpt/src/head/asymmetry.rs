//! Natural differences between the two halves.

use raconteur_base::{DVec3, mirror_vector, noise};

use super::form::Pull;

/// Pulls on one side only, mm, at asymmetry 1. Sizes as usual in faces (mean
/// asymmetry of landmarks about 1 mm; Ferrario et al. 1994, J. Oral
/// Maxillofac. Surg. 52); places chosen by eye.
const PULLS: [Pull; 8] = [
    Pull::new([0.0, -12.0, 118.0], 14.0, [0.7, 0.0, 0.0]),
    Pull::new([30.0, 48.0, 91.0], 13.0, [0.0, 0.9, 0.2]),
    Pull::new([26.0, -48.0, 92.0], 8.0, [0.2, 0.6, 0.0]),
    Pull::new([-30.0, -48.0, 90.0], 9.0, [0.3, -0.3, 0.0]),
    Pull::new([-20.0, -86.0, 92.0], 18.0, [0.8, 0.4, 0.0]),
    Pull::new([-48.0, -20.0, 82.0], 18.0, [-0.4, -0.5, 0.4]),
    Pull::new([-31.0, 27.0, 85.0], 5.0, [0.0, -0.3, 0.0]),
    Pull::new([60.0, -60.0, 20.0], 22.0, [-0.8, 0.0, 0.0]),
];
const STREAM: u64 = 0xA5;

/// The person's own differences: each of the pulls stronger or weaker, mirrored for every
/// second seed. `warp` carries a place on the mean head to the person's.
pub(crate) fn pulls(seed: u64, amount: f64, warp: &dyn Fn(DVec3) -> DVec3) -> Vec<Pull> {
    let flip = seed.is_multiple_of(2);
    PULLS
        .iter()
        .enumerate()
        .map(|(i, pull)| {
            let strength = amount * (1.0 + 0.3 * noise::signed(seed, STREAM, i as i64));
            let at = warp_both(warp, pull.at);
            let turned = |p: DVec3| if flip { mirror_vector(p) } else { p };
            Pull {
                at: turned(at),
                shift: turned(pull.shift) * strength,
                radius: pull.radius,
            }
        })
        .collect()
}

/// Carries a place of either half; the warp knows the left one.
fn warp_both(warp: &dyn Fn(DVec3) -> DVec3, p: DVec3) -> DVec3 {
    if p.x < 0.0 {
        mirror_vector(warp(mirror_vector(p)))
    } else {
        warp(p)
    }
}
