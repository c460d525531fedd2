//! What women and men differ in beyond the measured distances.
//!
//! The mean head lies midway, so each form is half of the difference. Amounts after
//! anatomical knowledge, chosen by eye; the measured distances are set afterwards.

use raconteur_base::DVec3;

use super::{
    Form, Knot, Pull, below, lid, lips, nose_tip, on_lips, on_neck, on_nose, on_skull, pulled,
    scaled,
};
use crate::head::cage::Key;
use crate::head::ear_shape::EarShape;

const WOMAN_PULLS: [Pull; 12] = [
    // A softer angle of the jaw and a narrower chin.
    Pull::new([56.0, -64.0, 18.0], 18.0, [-2.5, 3.5, 0.0]),
    Pull::new([14.0, -89.0, 94.0], 11.0, [-2.2, 1.5, -1.2]),
    Pull::new([22.0, -84.0, 90.0], 8.0, [-1.5, 1.0, -1.0]),
    // No ridge over the eyes, a shallow glabella, an upright round forehead.
    Pull::new([18.0, 43.0, 97.0], 13.0, [0.0, 0.0, -2.4]),
    Pull::new([46.0, 44.0, 84.0], 12.0, [-0.5, 0.0, -1.2]),
    Pull::new([0.0, 32.0, 96.0], 8.0, [0.0, 0.0, -1.2]),
    Pull::new([18.0, 70.0, 90.0], 20.0, [0.0, 0.0, 1.8]),
    // The cheek's apple and a narrower arch.
    Pull::new([49.0, -11.0, 84.0], 11.0, [0.2, 1.0, 1.2]),
    Pull::new([68.0, 20.0, 35.0], 22.0, [-2.2, 0.0, 0.0]),
    Pull::new([72.0, -10.0, 10.0], 30.0, [-1.5, 0.0, 0.0]),
    // A slightly hollow dorsum.
    Pull::new([0.0, 9.0, 109.0], 9.0, [0.0, 0.0, -1.4]),
    // The upper skull is narrower.
    Pull::new([66.0, 92.0, -5.0], 22.0, [-2.0, -0.5, 0.0]),
];
const WOMAN_MARGIN: [Knot; 14] = [
    (0, [-0.3, -0.1, 0.0]),
    (1, [0.0, 0.0, 0.0]),
    (2, [0.0, 0.0, 0.0]),
    (3, [0.0, 0.0, 0.0]),
    (4, [0.0, 0.0, 0.0]),
    (5, [0.2, 0.1, 0.0]),
    (6, [0.4, 0.3, 0.0]),
    (7, [0.7, 0.5, 0.0]),
    (8, [1.0, 0.7, -0.6]),
    (9, [0.8, 0.4, 0.0]),
    (10, [0.4, 0.1, 0.0]),
    (11, [0.0, 0.0, 0.0]),
    (12, [0.0, 0.0, 0.0]),
    (13, [0.0, 0.0, 0.0]),
];
const WOMAN_CREASE: [Knot; 6] = [
    (1, [0.0, 0.0, 0.0]),
    (2, [0.0, 0.5, 0.0]),
    (4, [0.0, 0.9, 0.0]),
    (6, [0.3, 1.1, 0.0]),
    (8, [0.8, 0.8, -0.4]),
    (10, [0.0, 0.0, 0.0]),
];
const WOMAN_FOLD: [Knot; 6] = [
    (1, [0.0, 0.3, 0.0]),
    (2, [0.0, 1.0, -0.5]),
    (4, [0.0, 1.6, -0.9]),
    (6, [0.2, 2.0, -0.6]),
    (8, [0.8, 1.0, -0.3]),
    (10, [0.0, 0.0, 0.0]),
];
const WOMAN_SULCUS: [Knot; 5] = [
    (0, [0.0, 0.0, 0.0]),
    (2, [0.0, 1.6, -0.6]),
    (4, [0.0, 2.2, -1.0]),
    (6, [0.0, 2.2, -0.6]),
    (8, [0.0, 0.0, 0.0]),
];
const WOMAN_RIM: [Knot; 5] = [
    (0, [0.0, 0.0, 0.0]),
    (2, [0.0, 2.0, 0.0]),
    (4, [0.0, 2.2, 0.0]),
    (6, [0.0, 2.2, 0.0]),
    (8, [0.0, 0.0, 0.0]),
];
const WOMAN_LIPS: [Knot; 9] = [
    (0, [0.0, 0.3, 0.1]),
    (1, [0.1, 0.5, 0.1]),
    (2, [0.2, 0.5, 0.1]),
    (3, [0.0, 0.5, 0.1]),
    (4, [0.0, 0.3, 0.1]),
    (6, [0.0, 0.0, 0.0]),
    (8, [0.0, -0.1, 0.1]),
    (10, [0.0, -0.1, 0.4]),
    (12, [0.0, -0.1, 0.4]),
];

fn woman(key: Key, p: DVec3) -> DVec3 {
    let mut d = pulled(&WOMAN_PULLS, key, p);
    if let Key::Grid(_, 9..28) = key
        && !on_nose(key)
        && !on_lips(key)
    {
        d += scaled(p, [0.0, -20.0, 20.0], [0.89, 0.95, 0.98]) * below(p.y, -5.0, -60.0);
    }
    if on_nose(key) {
        d += scaled(p, [0.0; 3], [0.885, 1.0, 1.0]);
    }
    d += DVec3::new(0.0, 1.3, -1.5) * nose_tip(key);
    d += lid(
        &[
            (5, &WOMAN_MARGIN),
            (3, &WOMAN_CREASE),
            (2, &WOMAN_FOLD),
            (1, &WOMAN_SULCUS),
            (0, &WOMAN_RIM),
        ],
        key,
    );
    if on_lips(key) {
        d += lips(&WOMAN_LIPS, key) + DVec3::new(-0.085 * p.x, 1.2, -1.6);
    }
    if on_neck(key) {
        d += scaled(p, [0.0, -100.0, -14.0], [0.83, 1.0, 0.87]) * below(p.y, -86.0, -106.0);
    }
    if on_skull(key) {
        d += scaled(p, [0.0, 0.0, -5.0], [0.975, 0.98, 0.96]);
    }
    d
}

/// A woman against the mean of the sexes.
pub(crate) const WOMAN: Form = Form {
    displace: woman,
    globe: DVec3::new(-0.4, 0.0, -0.2),
    ear: EarShape {
        height: -0.05,
        breadth: -0.05,
        protrusion_deg: -2.0,
        ..EarShape::NONE
    },
};

const MAN_PULLS: [Pull; 11] = [
    // A square jaw and a broad chin.
    Pull::new([56.0, -64.0, 18.0], 20.0, [2.6, -1.5, 0.0]),
    Pull::new([14.0, -89.0, 94.0], 12.0, [1.5, -1.5, 1.6]),
    Pull::new([24.0, -84.0, 88.0], 9.0, [1.2, -0.6, 0.8]),
    // Ridge over the eyes, glabella, a sloping forehead.
    Pull::new([18.0, 41.0, 97.0], 12.0, [0.0, -1.6, 2.4]),
    Pull::new([40.0, 44.0, 88.0], 10.0, [0.0, -1.8, 1.8]),
    Pull::new([0.0, 33.0, 96.0], 7.0, [0.0, -0.6, 1.6]),
    Pull::new([10.0, 66.0, 92.0], 20.0, [0.0, 0.0, -1.8]),
    // Flatter cheek, wider arch.
    Pull::new([49.0, -14.0, 84.0], 12.0, [0.0, -0.6, -0.9]),
    Pull::new([68.0, 20.0, 35.0], 22.0, [1.6, 0.0, 0.0]),
    // Straight dorsum.
    Pull::new([0.0, 12.0, 106.0], 8.0, [0.0, 0.0, 1.2]),
    // Larynx.
    Pull::new([0.0, -116.0, 46.0], 8.0, [0.0, 0.0, 3.4]),
];
const MAN_FOLD: [Knot; 5] = [
    (0, [0.0, 0.0, 0.0]),
    (2, [0.0, -0.8, 0.4]),
    (4, [0.0, -1.2, 0.5]),
    (6, [0.0, -1.4, 0.4]),
    (8, [0.0, -0.4, 0.0]),
];
const MAN_RIM: [Knot; 5] = [
    (0, [0.0, 0.0, 0.0]),
    (2, [0.0, -1.2, 0.4]),
    (4, [0.0, -1.4, 0.4]),
    (6, [0.0, -1.4, 0.4]),
    (8, [0.0, 0.0, 0.0]),
];
const MAN_LIPS: [Knot; 7] = [
    (0, [0.0, -0.3, -0.2]),
    (2, [0.0, -0.4, -0.2]),
    (4, [0.0, -0.3, -0.1]),
    (6, [0.0, 0.0, 0.0]),
    (8, [0.0, 0.1, -0.1]),
    (10, [0.0, 0.2, -0.4]),
    (12, [0.0, 0.2, -0.4]),
];

fn man(key: Key, p: DVec3) -> DVec3 {
    let mut d = pulled(&MAN_PULLS, key, p);
    if let Key::Grid(_, 9..28) = key
        && !on_nose(key)
        && !on_lips(key)
    {
        d += scaled(p, [0.0, -20.0, 20.0], [1.05, 1.05, 1.02]) * below(p.y, -5.0, -60.0);
    }
    if on_nose(key) {
        d += scaled(p, [0.0; 3], [1.07, 1.0, 1.0]);
    }
    d += DVec3::new(0.0, -1.0, 1.0) * nose_tip(key);
    d += lid(&[(2, &MAN_FOLD), (0, &MAN_RIM)], key);
    if on_lips(key) {
        d += lips(&MAN_LIPS, key) + DVec3::new(0.03 * p.x, -1.2, 1.0);
    }
    if on_neck(key) {
        // The nape is broad from the skull down, the throat from under the jaw.
        let (factor, share) = match key {
            Key::Grid(15.., _) => ([1.22, 1.0, 1.26], below(p.y, -30.0, -70.0)),
            _ => ([1.22, 1.0, 1.28], below(p.y, -86.0, -106.0)),
        };
        d += scaled(p, [0.0, -100.0, -14.0], factor) * share;
    }
    if on_skull(key) {
        d += scaled(p, [0.0, 0.0, -5.0], [1.015, 1.015, 1.03]);
    }
    d
}

/// A man against the mean of the sexes.
pub(crate) const MAN: Form = Form {
    displace: man,
    globe: DVec3::new(0.4, 0.0, 0.0),
    ear: EarShape {
        height: 0.04,
        breadth: 0.04,
        protrusion_deg: 1.0,
        ..EarShape::NONE
    },
};
