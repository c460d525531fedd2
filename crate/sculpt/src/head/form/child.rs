//! A child of nine against the adult: the face is shorter and narrower than the skull, the
//! eyes keep nearly their size.
//!
//! Proportions after growth curves (head 0.96, face height 0.88, face width 0.92 of the
//! adult's; Weinberg et al. 2016, doi:10.1597/15-199, Farkas 1994); masses from
//! anatomical knowledge.

use raconteur_base::DVec3;

use super::{
    Form, Knot, Pull, below, lid, lips, nose_tip, on_lips, on_neck, on_nose, pulled, reach, scaled,
};
use crate::head::cage::{Key, LAST_ROW};
use crate::head::ear_shape::EarShape;

const PULLS: [Pull; 14] = [
    // No ridge over the eyes, a full forehead.
    Pull::new([18.0, 42.0, 97.0], 13.0, [0.0, 0.0, -3.0]),
    Pull::new([44.0, 44.0, 85.0], 12.0, [0.0, 0.0, -1.6]),
    Pull::new([14.0, 70.0, 90.0], 22.0, [0.0, 0.0, 3.4]),
    Pull::new([46.0, 74.0, 70.0], 18.0, [1.0, 0.0, 1.0]),
    // A low bridge.
    Pull::new([0.0, 16.0, 102.0], 9.0, [0.0, 0.0, -4.6]),
    Pull::new([0.0, 6.0, 109.0], 7.0, [0.0, 0.0, -1.5]),
    // Full cheeks.
    Pull::new([48.0, -24.0, 82.0], 14.0, [1.8, -1.0, 2.2]),
    Pull::new([54.0, -44.0, 72.0], 14.0, [2.4, -0.5, 1.8]),
    Pull::new([42.0, -52.0, 80.0], 9.0, [0.6, 0.0, 1.6]),
    // Small jaw angle and chin.
    Pull::new([56.0, -64.0, 18.0], 16.0, [-1.2, 3.0, 0.0]),
    Pull::new([0.0, -88.0, 96.0], 11.0, [0.0, 1.0, -1.8]),
    Pull::new([20.0, -86.0, 90.0], 9.0, [-1.0, 1.0, 0.0]),
    // The upper lip stands a little forward of the lower.
    Pull::new([0.0, -38.0, 107.0], 7.0, [0.0, 0.0, 0.8]),
    Pull::new([0.0, -66.0, 99.0], 9.0, [0.0, 0.0, -0.8]),
];
const MARGIN: [Knot; 14] = [
    (0, [0.3, 0.0, 0.0]),
    (1, [0.2, 0.2, 0.0]),
    (2, [0.0, 0.4, 0.0]),
    (3, [0.0, 0.6, 0.0]),
    (4, [0.0, 0.7, 0.0]),
    (5, [0.0, 0.7, 0.0]),
    (6, [0.0, 0.5, 0.0]),
    (7, [0.0, 0.35, 0.0]),
    (8, [-0.2, 0.1, 0.0]),
    (9, [0.0, 0.0, 0.0]),
    (10, [0.0, -0.1, 0.0]),
    (11, [0.0, -0.2, 0.0]),
    (12, [0.0, -0.2, 0.0]),
    (13, [0.0, 0.0, 0.0]),
];
const CREASE: [Knot; 5] = [
    (1, [0.0, 0.1, 0.0]),
    (2, [0.0, 0.5, 0.0]),
    (4, [0.0, 0.5, 0.0]),
    (6, [0.0, 0.4, 0.0]),
    (8, [0.0, 0.0, 0.0]),
];
const FOLD: [Knot; 9] = [
    (0, [0.0, 0.0, 0.0]),
    (2, [0.0, 0.8, 0.5]),
    (4, [0.0, 0.9, 0.7]),
    (6, [0.0, 0.8, 0.5]),
    (8, [0.0, 0.0, 0.0]),
    (9, [0.0, 0.0, 0.2]),
    (10, [0.0, 0.0, 0.6]),
    (12, [0.0, 0.0, 0.8]),
    (14, [0.0, 0.0, 0.2]),
];
const LIPS: [Knot; 9] = [
    (0, [0.0, 0.4, 0.2]),
    (1, [0.0, 0.5, 0.2]),
    (2, [0.0, 0.5, 0.2]),
    (3, [0.0, 0.3, 0.0]),
    (6, [0.0, 0.0, 0.0]),
    (8, [0.0, 0.2, 0.1]),
    (9, [0.0, 0.0, 0.2]),
    (10, [0.0, 0.0, 0.3]),
    (12, [0.0, 0.0, 0.3]),
];

/// Piecewise-linear, constant outside.
fn table(knots: &[[f64; 2]], x: f64) -> f64 {
    let mut y = knots[0][1];
    for pair in knots.windows(2) {
        let ([a, ya], [b, yb]) = (pair[0], pair[1]);
        y += (yb - ya) * ((x - a) / (b - a)).clamp(0.0, 1.0);
    }
    y
}

fn proportions(key: Key, p: DVec3) -> DVec3 {
    let wide = table(
        &[
            [-95.0, 0.85],
            [-60.0, 0.89],
            [-20.0, 0.925],
            [20.0, 0.945],
            [60.0, 0.965],
        ],
        p.y,
    );
    let deep = table(
        &[[-95.0, 0.895], [-40.0, 0.91], [20.0, 0.935], [70.0, 0.955]],
        p.y,
    );
    let y = if p.y > 24.0 {
        24.0 + (p.y - 24.0) * 0.965
    } else if p.y > -89.3 {
        table(&[[-89.3, -78.3], [-30.6, -23.8], [24.0, 24.0]], p.y)
    } else {
        p.y + 11.0
    };
    let y = match key {
        Key::Grid(_, 28..=LAST_ROW) => p.y + 12.0,
        _ => y,
    };
    DVec3::new(p.x * (wide - 1.0), y - p.y, p.z * (deep - 1.0))
}

fn child(key: Key, p: DVec3) -> DVec3 {
    let mut d = proportions(key, p) * reach(key) + pulled(&PULLS, key, p);
    d += lid(&[(5, &MARGIN), (3, &CREASE), (2, &FOLD)], key);
    if on_lips(key) {
        d += lips(&LIPS, key) + DVec3::new(-0.10 * p.x, 0.3, -0.9);
    }
    d += DVec3::new(0.0, 1.7, -2.3) * nose_tip(key);
    if on_nose(key) {
        d += scaled(p, [0.0; 3], [0.95, 1.0, 1.0]);
    }
    if on_neck(key) {
        d += scaled(p, [0.0, -100.0, -14.0], [0.86, 1.0, 0.82]) * below(p.y, -84.0, -106.0);
    }
    d
}

/// A child of nine against the mean adult.
pub(crate) const CHILD: Form = Form {
    displace: child,
    globe: DVec3::new(-1.9, 0.25, -4.3),
    ear: EarShape {
        height: -0.08,
        breadth: -0.04,
        protrusion_deg: 7.0,
        ..EarShape::NONE
    },
};
