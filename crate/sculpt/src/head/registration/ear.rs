//! Lines of the ear on the body model's mean head, for rings and positions of the cage's ear.
//!
//! They were read off an image of the model's ear along its normal: the edge of the helix, its
//! crest and inner edge, the scapha, the antihelix with tragus and antitragus, the wall of the
//! concha and its floor.

use std::collections::BTreeMap;

use raconteur_base::{DVec3, Side, mirror_vector};

use crate::head::cage::Key;
use crate::surface::{Place, Surface};

/// Outward normal of the left ear's plane, before it is made one long: 18° to the front.
pub(in crate::head) const NORMAL: DVec3 = DVec3::new(0.951_06, -0.1, 0.309_02);
/// Middle of the ear along the plane's first axis, which points back, mm.
const MIDDLE_MM: f64 = 35.75;
/// Ring behind the rim, and the positions at which it is visible from the head.
const BEHIND: (u8, core::ops::RangeInclusive<u8>) = (3, 5..=15);
/// Minimum distance of the ear from the head's midline, along the normal, mm.
const EAR_FROM_MM: [f64; 2] = [50.0, 58.0];

/// Ring and position, and the point in the plane: back and up, mm.
#[rustfmt::skip]
const LINES: [(u8, u8, [f64; 2]); 147] = [
    (3, 5, [6.2, 30.8]), (3, 6, [11.8, 28.0]), (3, 7, [16.2, 21.5]), (3, 8, [17.9, 13.4]),
    (3, 9, [17.4, 7.0]), (3, 10, [14.2, -0.6]), (3, 11, [9.8, -5.8]), (3, 12, [5.4, -10.2]),
    (3, 13, [1.5, -13.8]), (3, 14, [-2.5, -15.4]), (3, 15, [-6.8, -15.0]),
    (3, 0, [-10.7, -4.0]), (3, 1, [-9.9, 4.6]), (3, 2, [-8.0, 15.7]), (3, 16, [-10.6, -14.6]),
    (3, 17, [-10.9, -9.8]), (2, 0, [-11.2, -4.8]), (2, 1, [-10.6, 4.4]), (2, 2, [-8.7, 17.2]), (2, 16, [-11.0, -16.4]), (2, 17, [-11.3, -11.8]),
    (4, 0, [-10.1, -3.0]), (4, 1, [-9.4, 5.0]), (4, 2, [-7.6, 13.9]), (4, 3, [-5.2, 22.3]),
    (4, 4, [0.3, 29.4]), (4, 5, [6.5, 31.6]), (4, 6, [12.4, 28.8]), (4, 7, [16.8, 21.8]),
    (4, 8, [18.5, 13.5]), (4, 9, [18.0, 7.0]), (4, 10, [14.8, -0.7]), (4, 11, [10.4, -6.0]),
    (4, 12, [6.0, -10.5]), (4, 13, [2.0, -14.3]), (4, 14, [-2.6, -16.0]), (4, 15, [-7.0, -15.8]),
    (4, 16, [-10.0, -13.4]), (4, 17, [-10.4, -8.6]),
    (5, 0, [-9.3, -1.6]), (5, 1, [-8.7, 5.6]), (5, 2, [-7.2, 13.2]), (5, 3, [-4.5, 20.9]),
    (5, 4, [1.0, 28.0]), (5, 5, [6.5, 30.0]), (5, 6, [11.5, 27.4]), (5, 7, [15.6, 21.3]),
    (5, 8, [17.1, 13.4]), (5, 9, [16.6, 7.2]), (5, 10, [13.6, 0.1]), (5, 11, [9.4, -4.9]),
    (5, 12, [5.2, -9.2]), (5, 13, [1.3, -12.8]), (5, 14, [-2.8, -14.4]), (5, 15, [-6.8, -14.2]),
    (5, 16, [-9.4, -11.8]), (5, 17, [-9.7, -7.0]),
    (6, 0, [-8.5, -0.2]), (6, 1, [-8.0, 6.2]), (6, 2, [-6.5, 12.8]), (6, 3, [-3.9, 19.6]),
    (6, 4, [1.6, 26.9]), (6, 5, [6.5, 28.7]), (6, 6, [10.8, 26.1]), (6, 7, [14.6, 20.7]),
    (6, 8, [15.7, 13.3]), (6, 9, [15.1, 7.5]), (6, 10, [12.3, 1.1]), (6, 11, [8.3, -3.2]),
    (6, 12, [4.3, -6.8]), (6, 13, [0.6, -9.4]), (6, 14, [-3.2, -11.0]), (6, 15, [-6.6, -11.0]),
    (6, 16, [-8.6, -9.4]), (6, 17, [-9.0, -5.4]),
    (7, 0, [-7.8, 1.6]), (7, 1, [-7.4, 7.0]), (7, 2, [-5.9, 12.8]), (7, 3, [-3.0, 18.9]),
    (7, 4, [2.4, 25.4]), (7, 5, [6.5, 26.4]), (7, 6, [9.9, 24.2]), (7, 7, [12.9, 19.3]),
    (7, 8, [13.9, 12.9]), (7, 9, [13.5, 8.0]), (7, 10, [11.0, 2.6]), (7, 11, [7.1, -0.5]),
    (7, 12, [3.2, -2.7]), (7, 13, [-0.6, -4.4]), (7, 14, [-4.0, -6.0]), (7, 15, [-6.4, -7.0]),
    (7, 16, [-7.9, -6.6]), (7, 17, [-8.3, -3.6]),
    (8, 0, [-7.0, 3.6]), (8, 1, [-6.7, 8.0]), (8, 2, [-5.0, 13.6]), (8, 3, [-1.8, 16.8]),
    (8, 4, [2.4, 19.5]), (8, 5, [6.2, 20.0]), (8, 6, [9.2, 18.2]), (8, 7, [11.2, 14.8]),
    (8, 8, [12.0, 11.0]), (8, 9, [11.6, 7.2]), (8, 10, [9.5, 4.2]), (8, 11, [6.0, 2.1]),
    (8, 12, [2.6, 0.6]), (8, 13, [-0.7, -0.5]), (8, 14, [-3.8, -1.7]), (8, 15, [-6.1, -3.0]),
    (8, 16, [-7.4, -3.6]), (8, 17, [-7.7, -0.8]),
    (9, 0, [-5.9, 5.0]), (9, 1, [-5.6, 8.4]), (9, 2, [-4.6, 11.2]), (9, 3, [-2.0, 12.8]),
    (9, 4, [1.0, 13.6]), (9, 5, [4.0, 13.3]), (9, 6, [6.6, 12.1]), (9, 7, [8.2, 10.4]),
    (9, 8, [8.8, 8.4]), (9, 9, [8.0, 6.0]), (9, 10, [6.0, 4.2]), (9, 11, [3.6, 2.9]),
    (9, 12, [1.2, 2.0]), (9, 13, [-1.0, 1.3]), (9, 14, [-3.0, 0.7]), (9, 15, [-4.8, 0.0]),
    (9, 16, [-5.9, -0.6]), (9, 17, [-6.2, 2.0]),
    (10, 0, [-4.1, 5.4]), (10, 1, [-4.0, 6.5]), (10, 2, [-3.7, 7.5]), (10, 3, [-2.8, 8.0]),
    (10, 4, [-1.8, 8.2]), (10, 5, [-0.8, 8.1]), (10, 6, [0.1, 7.7]), (10, 7, [0.6, 7.2]),
    (10, 8, [0.8, 6.5]), (10, 9, [0.5, 5.7]), (10, 10, [-0.1, 5.1]), (10, 11, [-0.9, 4.7]),
    (10, 12, [-1.7, 4.4]), (10, 13, [-2.5, 4.2]), (10, 14, [-3.1, 4.0]), (10, 15, [-3.7, 3.7]),
    (10, 16, [-4.1, 3.6]), (10, 17, [-4.2, 4.4]),
];

/// Number of points of both ears.
pub(super) const COUNT: usize = 2 * LINES.len();

/// Step towards the middle of the ear if a line misses it, as a share of the distance.
const INWARD: f64 = 0.02;
/// Maximum number of steps.
const STEPS: u32 = 12;

/// Returns the points of the lines on the model's head, of both ears.
pub(super) fn places(theirs: &Surface) -> BTreeMap<(Key, Side), Place> {
    let mut all = BTreeMap::new();
    for side in Side::BOTH {
        for (ring, position, at) in LINES {
            let key = Key::Ear(ring, position);
            if let Some(place) = outermost(theirs, side, (ring, position), at) {
                all.insert((key, side), place);
            }
        }
    }
    all
}

/// Returns the point of the ear above a point of its plane: the outermost from outside, or, behind
/// the rim, the outermost that faces the head.
fn outermost(
    theirs: &Surface,
    side: Side,
    (ring, position): (u8, u8),
    at: [f64; 2],
) -> Option<Place> {
    let normal = NORMAL.normalize();
    let back = DVec3::Y.cross(normal).normalize();
    let up = normal.cross(back);
    let turned = |p: DVec3| {
        if side == Side::Left {
            p
        } else {
            mirror_vector(p)
        }
    };
    let (back, up, normal) = (turned(back), turned(up), turned(normal));
    let is_behind = ring == BEHIND.0 && BEHIND.1.contains(&position);
    let least = EAR_FROM_MM[usize::from(ring < 8)];
    (0..STEPS).find_map(|step| {
        let [x, y] = at.map(|mm| mm * (1.0 - INWARD * f64::from(step)));
        let from = back * (MIDDLE_MM + x) + up * (y + 8.0 * INWARD * f64::from(step));
        let hits = theirs.along(from, normal);
        let ear = hits
            .into_iter()
            .filter(|p| p.at.dot(normal) > least && (p.normal.dot(normal) < 0.0) == is_behind);
        ear.max_by(|a, b| a.at.dot(normal).total_cmp(&b.at.dot(normal)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_ring_before_the_rim_is_drawn_whole() {
        for ring in 4..=10 {
            let mut positions: Vec<u8> =
                LINES.iter().filter(|l| l.0 == ring).map(|l| l.1).collect();
            positions.sort_unstable();
            assert_eq!(positions, (0..18).collect::<Vec<u8>>(), "{ring}");
        }
    }
}
