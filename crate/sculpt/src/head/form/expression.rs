//! The face at rest need not be blank.

use raconteur_base::DVec3;

use super::{Form, Knot, Pull, lid, pulled};
use crate::head::cage::Key;

const PULLS: [Pull; 2] = [
    // The knot of muscles beside the corner, and the cheek it lifts.
    Pull::new([33.0, -47.0, 88.0], 6.0, [0.6, 1.4, 0.7]),
    Pull::new([44.0, -8.0, 84.0], 15.0, [0.4, 0.9, 0.9]),
];
const LOWER_LID: [Knot; 7] = [
    (9, [0.0, 0.3, 0.0]),
    (10, [0.0, 0.4, 0.0]),
    (11, [0.0, 0.5, 0.0]),
    (12, [0.0, 0.5, 0.0]),
    (13, [0.0, 0.4, 0.0]),
    (14, [0.0, 0.25, 0.0]),
    (15, [0.0, 0.1, 0.0]),
];

/// A friendly resting face: corners a little out, up and back, lower lids raised. Chosen by
/// eye.
pub(crate) const SMILE: Form = Form::of(|key, p| {
    let mut d = pulled(&PULLS, key, p) + lid(&[(5, &LOWER_LID)], key);
    if let Some((ring, k)) = key.mouth_position() {
        let near = [
            0.0, 0.02, 0.05, 0.13, 0.34, 0.7, 1.0, 0.7, 0.34, 0.13, 0.05, 0.02, 0.0,
        ][k];
        let back = if ring >= 3 { -0.9 } else { -0.4 };
        let share = if ring == 0 { 0.7 } else { 1.0 };
        d += DVec3::new(0.9, 2.4, back) * near * share;
    }
    if let Key::Eye(2, 10..=14) = key {
        d += DVec3::new(0.0, 0.2, 0.35);
    }
    d
});
