//! Old age: what a man or woman of 70 has that one of 30 has not.
//!
//! Direction of each change from anatomical knowledge (bone loss at orbit, jaw and midface,
//! descent of fat pads, lengthening of ear and nose tip, thinning of the lips; reviewed by
//! Mendelson & Wong 2012, doi:10.1007/s00266-012-9904-3); amounts designed by eye. Masses
//! narrower than about 4 mm are left to the normal map.

use raconteur_base::DVec3;

use super::{Form, Knot, Pull, lid, lips, nose_tip, on_lips, on_nose, pulled, scaled};
use crate::head::cage::Key;
use crate::head::ear_shape::EarShape;

const PULLS: [Pull; 16] = [
    // Hollow temples and cheeks, bony arch.
    Pull::new([62.0, 44.0, 64.0], 13.0, [-2.6, 0.0, -2.0]),
    Pull::new([66.0, 36.0, 48.0], 11.0, [-1.2, 0.0, 0.0]),
    Pull::new([50.0, -36.0, 80.0], 12.0, [-1.6, -1.0, -2.6]),
    Pull::new([60.0, -34.0, 60.0], 12.0, [-2.0, 0.0, -0.8]),
    Pull::new([53.0, 2.0, 80.0], 10.0, [1.0, -0.5, 0.8]),
    // Jowl, the notch before it, loose skin under the chin.
    Pull::new([38.0, -77.0, 72.0], 9.0, [3.2, -5.0, 3.0]),
    Pull::new([46.0, -66.0, 66.0], 9.0, [2.4, -2.6, 2.0]),
    Pull::new([26.0, -85.0, 84.0], 6.0, [-0.8, 1.6, -1.8]),
    Pull::new([0.0, -98.0, 52.0], 14.0, [0.0, -6.0, 5.0]),
    // The roll beside the nasolabial furrow, the furrow itself, marionette hollow.
    Pull::new([33.0, -32.0, 91.0], 6.0, [1.0, -1.0, 2.4]),
    Pull::new([27.0, -38.0, 94.0], 4.0, [-0.3, 0.3, -1.6]),
    Pull::new([34.0, -59.0, 86.0], 6.0, [0.0, 0.0, -1.4]),
    Pull::new([42.0, -56.0, 80.0], 7.0, [0.8, -0.8, 1.4]),
    // Brow and glabella sink.
    Pull::new([40.0, 46.0, 88.0], 12.0, [0.0, -1.6, 0.0]),
    Pull::new([0.0, 20.0, 98.0], 6.0, [0.0, 0.0, -0.8]),
    // A hump as the tip drops.
    Pull::new([0.0, 10.0, 107.0], 6.0, [0.0, 0.0, 1.0]),
];
const MARGIN: [Knot; 14] = [
    (1, [0.0, -0.1, 0.0]),
    (2, [0.0, -0.2, 0.0]),
    (3, [0.0, -0.45, 0.0]),
    (4, [0.0, -0.7, 0.0]),
    (5, [0.0, -0.9, 0.0]),
    (6, [-0.1, -1.0, 0.0]),
    (7, [-0.3, -0.9, 0.0]),
    (8, [-0.6, -0.8, -0.2]),
    (9, [-0.4, -0.7, 0.0]),
    (10, [0.0, -0.6, 0.0]),
    (11, [0.0, -0.5, 0.0]),
    (12, [0.0, -0.3, 0.0]),
    (13, [0.0, -0.2, 0.0]),
    (14, [0.0, -0.1, 0.0]),
];
const CREASE: [Knot; 6] = [
    (1, [0.0, -0.1, 0.0]),
    (2, [0.0, -0.4, 0.0]),
    (4, [0.0, -0.7, -0.1]),
    (6, [0.0, -1.0, -0.1]),
    (8, [-0.4, -1.0, 0.1]),
    (10, [0.0, 0.0, 0.0]),
];
const FOLD: [Knot; 8] = [
    (0, [0.0, 0.0, 0.0]),
    (2, [0.0, -0.9, 0.4]),
    (4, [0.0, -1.5, 0.9]),
    (6, [0.2, -2.2, 1.3]),
    (8, [0.6, -2.2, 1.2]),
    (10, [0.0, -0.8, 0.9]),
    (12, [0.0, -0.6, 1.2]),
    (14, [0.0, -0.5, 0.6]),
];
const SULCUS: [Knot; 8] = [
    (0, [0.0, 0.0, 0.0]),
    (2, [0.0, -1.4, 0.3]),
    (4, [0.0, -2.2, -0.8]),
    (6, [0.0, -2.6, 0.2]),
    (8, [0.0, -1.6, 0.3]),
    (10, [0.0, -2.0, 1.8]),
    (12, [0.0, -2.2, 2.3]),
    (14, [0.0, -1.4, 1.1]),
];
const RIM: [Knot; 8] = [
    (0, [0.0, 0.0, 0.0]),
    (2, [0.0, -1.2, 0.6]),
    (4, [0.0, -1.7, 0.3]),
    (6, [0.0, -1.7, 0.3]),
    (8, [0.0, 0.0, 0.0]),
    (10, [0.0, -2.6, -1.0]),
    (12, [0.0, -2.8, -1.6]),
    (14, [0.0, -1.2, -1.4]),
];
const LIPS: [Knot; 10] = [
    (0, [0.0, -1.5, -0.8]),
    (2, [0.0, -1.5, -0.7]),
    (3, [0.0, -1.2, -0.6]),
    (4, [0.0, -0.8, -0.4]),
    (6, [0.0, 0.0, 0.0]),
    (7, [0.0, 0.4, -0.2]),
    (8, [0.0, 1.0, -0.4]),
    (9, [0.0, 1.5, -0.6]),
    (10, [0.0, 1.7, -0.8]),
    (12, [0.0, 1.7, -0.8]),
];

fn old(key: Key, p: DVec3) -> DVec3 {
    let mut d = pulled(&PULLS, key, p);
    d += DVec3::new(0.0, -2.4, 0.9) * nose_tip(key);
    if on_nose(key) {
        d += scaled(p, [0.0; 3], [1.03, 1.0, 1.0]);
    }
    d += lid(
        &[
            (5, &MARGIN),
            (3, &CREASE),
            (2, &FOLD),
            (1, &SULCUS),
            (0, &RIM),
        ],
        key,
    );
    if on_lips(key) {
        // A longer lip, and bone and teeth worn back.
        d += lips(&LIPS, key) + DVec3::new(0.02 * p.x, -1.0, -1.3);
    }
    d
}

/// Seventy against thirty.
pub(crate) const OLD: Form = Form {
    displace: old,
    globe: DVec3::new(0.0, 0.0, -0.9),
    ear: EarShape {
        height: 0.05,
        breadth: 0.03,
        lobe_drop: 3.5,
        ..EarShape::NONE
    },
};
