//! Relief of the ear: the body model's ear is a shallow bowl; cartilage adds ridges and hollows.
//!
//! The auricle's parts after Gray's Anatomy: helix, scapha, antihelix with its two crura about the
//! triangular fossa, concha, tragus, antitragus and lobule. Depths are *designed*, about those of
//! section drawings.

use raconteur_base::DVec3;

use super::cage::{Key, Points};
use super::registration::ear::NORMAL;
use super::rig::smooth;

/// Height of an adult's ear from the rim's top to its lowest point, mm; the relief scales with it.
const HEIGHT_MM: f64 = 62.0;

/// Displaced area: rings, positions, and displacement outwards, backwards and up, mm.
type Part = ([u8; 2], [u8; 2], [f64; 3]);

/// Rings from the rim (4) inwards; positions from the root of the helix (2) over its top (5) and
/// back (9) to the lobule (14) and up before the tragus (17, 0).
#[rustfmt::skip]
const PARTS: [Part; 20] = [
    // The helix rolls over: its crest protrudes, its inner edge overhangs the scapha.
    ([4, 4], [3, 11], [0.9, 0.0, 0.0]),
    ([5, 5], [3, 11], [1.2, -0.5, 0.0]),
    // Scapha, down to the lobule.
    ([6, 6], [6, 10], [-3.2, -0.6, 0.0]),
    ([6, 6], [3, 5], [-1.6, 0.0, -0.6]),
    ([6, 6], [11, 12], [-1.5, 0.0, 0.0]),
    // Antihelix, midway to the canal; in front of its upper end the triangular fossa.
    ([7, 7], [6, 12], [0.6, -1.6, 0.0]),
    ([8, 8], [6, 12], [3.0, -2.4, 0.0]),
    ([8, 8], [4, 5], [-2.4, 0.0, -1.0]),
    ([7, 7], [4, 5], [-1.6, 0.0, -0.8]),
    ([9, 9], [4, 6], [2.4, 0.0, 1.2]),
    // Concha.
    ([9, 9], [7, 12], [-2.0, -1.0, 0.0]),
    ([10, 10], [0, 17], [-2.5, 0.0, 0.0]),
    // Tragus, which covers the canal, and antitragus across the notch.
    ([7, 8], [17, 17], [1.8, 1.6, 0.0]),
    ([7, 8], [0, 0], [2.2, 2.2, 0.0]),
    ([7, 8], [1, 1], [1.0, 1.0, 0.0]),
    ([8, 8], [13, 14], [2.0, 0.0, 0.8]),
    // Lobule: round below, full.
    ([3, 5], [12, 13], [0.2, 1.4, -1.0]),
    ([3, 5], [14, 14], [0.6, 0.4, -1.8]),
    ([3, 5], [15, 15], [0.6, -0.4, -1.6]),
    ([6, 7], [13, 15], [0.9, 0.0, -0.5]),
];

/// Displacement of the rim towards the head at its positions around the top, mm, so that the top of
/// the ear is round in frontal view.
const TOP_MM: [(u8, f64); 5] = [(3, 0.8), (4, 2.2), (5, 3.0), (6, 2.2), (7, 0.8)];

/// Shapes the left ear of a cage.
pub(super) fn shape(points: &mut Points) {
    let (Some(top), Some(bottom)) = (points.get(&Key::ear(4, 5)), points.get(&Key::ear(4, 14)))
    else {
        return;
    };
    let scale = (top.y - bottom.y) / HEIGHT_MM;
    let normal = NORMAL.normalize();
    let back = DVec3::Y.cross(normal).normalize();
    let up = normal.cross(back);
    let mut push = |ring: u8, position: u8, by: DVec3| {
        if let Some(p) = points.get_mut(&Key::Ear(ring, position)) {
            *p += by * scale;
        }
    };
    for (rings, [first, last], [out, behind, above]) in PARTS {
        let by = normal * out + back * behind + up * above;
        for ring in rings[0]..=rings[1] {
            for position in first..=last {
                push(ring, position, by);
            }
        }
    }
    for (position, inwards) in TOP_MM {
        for ring in 2..=8u8 {
            let share = smooth(9.0, 5.0, f64::from(ring)) * smooth(0.5, 3.0, f64::from(ring));
            push(ring, position, DVec3::NEG_X * (inwards * share));
        }
    }
}
