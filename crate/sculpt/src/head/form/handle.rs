//! One form for each measure: how a distance of the face is changed by a millimetre while
//! the rest is left as it is. Where one form touches another's distance, the amounts are
//! solved together.

use raconteur_base::DVec3;

use super::{Form, Knot, Pull, below, lid, nose_tip, on_neck, on_nose, pulled, reach};
use crate::head::cage::Key;
use crate::head::ear_shape::EarShape;
use crate::head::rig::smooth;

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

macro_rules! pulls {
    ($($at:expr, $radius:expr, $shift:expr);+ $(;)?) => {
        Form::of(|key, p| pulled(&[$(Pull::new($at, $radius, $shift)),+], key, p))
    };
}

/// Not lids, ears or the inside of the mouth.
fn outer(key: Key) -> f64 {
    match key {
        Key::Eye(..) => 0.0,
        _ => 1.0,
    }
}

pub(crate) const HEAD_LENGTH: Form = Form::of(|key, p| {
    v(0.0, 0.0, -(-p.z / 97.0).clamp(0.0, 1.0)) * outer(key) * (1.0 - below(p.y, -60.0, -110.0))
});
pub(crate) const HEAD_BREADTH: Form = Form::of(|key, p| {
    let wide = p.x / 75.0 * 0.5;
    let front = 1.0 - smooth(40.0, 85.0, p.z);
    v(wide * front * (1.0 - below(p.y, 20.0, -50.0)), 0.0, 0.0) * outer(key)
});
pub(crate) const HEAD_HEIGHT: Form =
    Form::of(|key, p| v(0.0, ((p.y - 52.0) / 78.0).clamp(0.0, 1.05), 0.0) * outer(key));
pub(crate) const FOREHEAD_BREADTH: Form = pulls!([54.0, 50.0, 73.0], 15.0, [0.5, 0.0, 0.0]);
pub(crate) const FACE_BREADTH: Form = pulls!(
    [70.0, 4.0, 46.0], 19.0, [0.42, 0.0, 0.0];
    [62.0, -8.0, 68.0], 13.0, [0.15, 0.0, 0.0]
);
pub(crate) const JAW_BREADTH: Form = pulls!(
    [58.0, -60.0, 16.0], 20.0, [0.42, 0.0, 0.0];
    [48.0, -74.0, 48.0], 16.0, [0.2, 0.0, 0.0]
);

/// The front of the face, from the ears forward.
fn front(p: DVec3) -> f64 {
    smooth(-15.0, 45.0, p.z)
}

/// What lies below the chin goes along less and less.
fn throat(p: DVec3) -> f64 {
    1.0 - below(p.y, -95.0, -150.0)
}

pub(crate) const FACE_HEIGHT: Form =
    Form::of(|_, p| v(0.0, -below(p.y, -25.0, -89.0) * front(p) * throat(p), 0.0));
pub(crate) const NOSE_HEIGHT: Form = Form::of(|key, p| {
    let side = 1.0 - smooth(36.0, 66.0, p.x) * (1.0 - below(p.y, -10.0, -50.0));
    v(
        0.0,
        -below(p.y, 22.0, -24.0) * side * front(p) * throat(p),
        0.0,
    ) * reach(key)
});
pub(crate) const NOSE_BREADTH: Form = Form::of(|key, p| match key {
    _ if on_nose(key) && p.y < 4.0 => v(p.x / 36.8, 0.0, 0.0),
    Key::Grid(6 | 7, 9..=14) => v(0.3, 0.0, 0.0),
    _ => DVec3::ZERO,
});
/// The tip comes forward while the base of the columella stays, or the distance between
/// them would not change.
pub(crate) const NOSE_PROTRUSION: Form = Form::of(|key, _| match key {
    Key::Grid(i @ 0..=5, j @ 8..=13) => {
        let row = [0.2, 0.55, 0.9, 1.0, 0.85, 0.45][usize::from(j) - 8];
        let side = if i < 3 { 1.0 } else { 0.45 };
        v(0.0, 0.0, row * side)
    }
    _ => DVec3::ZERO,
});
pub(crate) const TIP_LIFT: Form = Form::of(|key, _| v(0.0, 1.0, -0.1) * nose_tip(key));

const INNER: [Knot; 6] = [
    (0, [0.5, 0.0, 0.0]),
    (1, [0.34, 0.0, 0.0]),
    (2, [0.12, 0.0, 0.0]),
    (3, [0.0, 0.0, 0.0]),
    (14, [0.12, 0.0, 0.0]),
    (15, [0.34, 0.0, 0.0]),
];
pub(crate) const INNER_CANTHAL: Form = Form::of(|key, p| {
    let d = match key.eye_position() {
        Some((1..=5, k @ (0..=3 | 14..=15))) => super::along(&INNER, k),
        _ => DVec3::ZERO,
    };
    d + pulled(
        &[Pull::new([11.0, 18.0, 89.0], 7.0, [0.3, 0.0, 0.0])],
        key,
        p,
    ) * if matches!(key, Key::Eye(..)) {
        0.0
    } else {
        1.0
    }
});
const OUTER: [Knot; 5] = [
    (5, [0.0, 0.0, 0.0]),
    (7, [0.34, 0.0, 0.0]),
    (8, [0.5, 0.0, -0.25]),
    (9, [0.34, 0.0, 0.0]),
    (11, [0.0, 0.0, 0.0]),
];
pub(crate) const OUTER_CANTHAL: Form =
    Form::of(|key, _| lid(&[(5, &OUTER), (3, &OUTER), (2, &OUTER), (1, &OUTER)], key));
pub(crate) const PUPIL_DISTANCE: Form = Form {
    displace: |key, p| {
        pulled(
            &[Pull::new([31.0, 22.0, 84.0], 15.0, [0.5, 0.0, 0.0])],
            key,
            p,
        )
    },
    globe: DVec3::new(0.5, 0.0, 0.0),
    ear: EarShape::NONE,
};
const OPEN: [Knot; 5] = [
    (0, [0.0, 0.0, 0.0]),
    (2, [0.0, 0.4, 0.0]),
    (4, [0.0, 0.66, 0.0]),
    (6, [0.0, 0.5, 0.0]),
    (8, [0.0, 0.0, 0.0]),
];
const OPEN_LOWER: [Knot; 5] = [
    (8, [0.0, 0.0, 0.0]),
    (10, [0.0, -0.25, 0.0]),
    (12, [0.0, -0.34, 0.0]),
    (14, [0.0, -0.22, 0.0]),
    (15, [0.0, -0.1, 0.0]),
];
pub(crate) const FISSURE_HEIGHT: Form = Form::of(|key, _| {
    lid(
        &[
            (5, &OPEN),
            (3, &OPEN),
            (2, &OPEN),
            (5, &OPEN_LOWER),
            (3, &OPEN_LOWER),
        ],
        key,
    )
});
pub(crate) const MOUTH_BREADTH: Form = Form::of(|key, p| {
    if key.mouth_position().is_some() {
        v(p.x / 51.2, 0.0, 0.0)
    } else {
        pulled(
            &[Pull::new([32.0, -48.0, 88.0], 9.0, [0.4, 0.0, 0.0])],
            key,
            p,
        )
    }
});
/// Shift of lips and what lies under them, down to the chin.
fn lower_face(key: Key, p: DVec3) -> f64 {
    if key.mouth_position().is_some_and(|m| m.0 >= 1) {
        return 1.0;
    }
    let fade = smooth(-27.0, -38.0, p.y) * (1.0 - smooth(-66.0, -84.0, p.y));
    fade * (1.0 - smooth(28.0, 46.0, p.x)) * front(p)
}
pub(crate) const PHILTRUM_LENGTH: Form = Form::of(|key, p| v(0.0, -lower_face(key, p), 0.0));
pub(crate) const PHILTRUM_BREADTH: Form = Form::of(|key, _| match (key, key.mouth_position()) {
    (Key::Grid(2, 15), _) | (_, Some((0 | 1, 2))) => v(0.5, 0.0, 0.0),
    (_, Some((0 | 1, 1 | 3))) => v(0.25, 0.0, 0.0),
    _ => DVec3::ZERO,
});
const RED: [f64; 13] = [
    1.0, 1.0, 0.98, 0.85, 0.6, 0.3, 0.0, 0.3, 0.6, 0.85, 0.98, 1.0, 1.0,
];
pub(crate) const UPPER_RED: Form = Form::of(|key, _| match key.mouth_position() {
    Some((ring, k @ 0..=5)) => {
        let d = v(0.0, 1.0, 0.22) * RED[k];
        d * [0.5, 1.0, 0.0, 0.35, 0.0]
            .get(usize::from(ring))
            .copied()
            .unwrap_or(0.0)
    }
    _ => DVec3::ZERO,
});
pub(crate) const LOWER_RED: Form = Form::of(|key, _| match key.mouth_position() {
    Some((ring, k @ 7..=12)) => {
        let d = v(0.0, -1.0, 0.25) * RED[k];
        d * [0.5, 1.0, 0.0, 0.4, 0.0]
            .get(usize::from(ring))
            .copied()
            .unwrap_or(0.0)
    }
    _ => DVec3::ZERO,
});
pub(crate) const LOWER_LIP_SKIN: Form = Form::of(|key, p| {
    if key.mouth_position().is_some() {
        DVec3::ZERO
    } else {
        pulled(
            &[Pull::new([0.0, -68.0, 99.0], 9.0, [0.0, -1.0, 0.0])],
            key,
            p,
        )
    }
});
const fn ear(change: EarShape) -> Form {
    Form {
        displace: |_, _| DVec3::ZERO,
        globe: DVec3::ZERO,
        ear: change,
    }
}
pub(crate) const EAR_LENGTH: Form = ear(EarShape {
    height: 1.0 / 61.0,
    ..EarShape::NONE
});
pub(crate) const EAR_BREADTH: Form = ear(EarShape {
    breadth: 1.0 / 33.0,
    ..EarShape::NONE
});
pub(crate) const EAR_PROTRUSION: Form = ear(EarShape {
    protrusion_deg: 2.4,
    ..EarShape::NONE
});

pub(crate) const BRIDGE: Form = pulls!([0.0, 20.0, 98.0], 9.0, [0.0, 0.0, 1.0]);
pub(crate) const DORSUM: Form = pulls!([0.0, 9.0, 108.0], 6.0, [0.0, 0.0, 1.0]);
pub(crate) const LIP_PROTRUSION: Form = Form::of(|key, p| match key.mouth_position() {
    Some((0, k)) => v(0.0, 0.0, 0.55) * RED[k],
    Some((_, k)) => v(0.0, 0.0, 1.0) * RED[k].max(0.25),
    None => pulled(
        &[Pull::new([0.0, -33.0, 105.0], 5.0, [0.0, 0.0, 0.35])],
        key,
        p,
    ),
});
pub(crate) const CHIN_PROTRUSION: Form = pulls!([0.0, -82.0, 102.0], 13.0, [0.0, 0.0, 1.0]);
pub(crate) const CHIN_BREADTH: Form = pulls!([22.0, -84.0, 88.0], 9.0, [0.5, 0.0, 0.0]);
pub(crate) const BROW_RIDGE: Form = pulls!(
    [20.0, 44.0, 96.0], 11.0, [0.0, 0.0, 0.8];
    [44.0, 45.0, 86.0], 10.0, [0.0, 0.0, 0.6];
    [0.0, 38.0, 97.0], 8.0, [0.0, 0.0, 0.3]
);
pub(crate) const BROW_HEIGHT: Form = pulls!([34.0, 45.0, 91.0], 14.0, [0.0, 1.0, 0.0]);
pub(crate) const FOREHEAD_SLOPE: Form = pulls!([12.0, 78.0, 86.0], 20.0, [0.0, 0.0, 1.0]);
pub(crate) const CHEEKBONE: Form = pulls!([55.0, -2.0, 79.0], 11.0, [0.7, 0.2, 0.7]);
pub(crate) const CHEEK_FULLNESS: Form = pulls!(
    [50.0, -26.0, 81.0], 13.0, [0.6, 0.0, 0.7];
    [55.0, -44.0, 70.0], 13.0, [0.6, 0.0, 0.3]
);
const HOOD: [Knot; 6] = [
    (1, [0.0, 0.0, 0.0]),
    (2, [0.0, -0.4, 0.15]),
    (4, [0.0, -0.8, 0.3]),
    (6, [0.0, -1.0, 0.35]),
    (8, [0.1, -0.5, 0.25]),
    (9, [0.0, 0.0, 0.0]),
];
pub(crate) const LID_HOOD: Form =
    Form::of(|key, _| lid(&[(2, &HOOD)], key) + lid(&[(1, &HOOD)], key) * 0.6);
const TILT: [Knot; 5] = [
    (5, [0.0, 0.0, 0.0]),
    (7, [0.0, 0.7, 0.0]),
    (8, [0.0, 1.0, 0.0]),
    (9, [0.0, 0.7, 0.0]),
    (11, [0.0, 0.0, 0.0]),
];
pub(crate) const CANTHAL_TILT: Form =
    Form::of(|key, _| lid(&[(5, &TILT), (3, &TILT), (2, &TILT), (1, &TILT)], key));
pub(crate) const MOUTH_CORNER: Form = Form::of(|key, p| {
    let near = key.mouth_position().map_or(0.0, |(_, k)| 1.0 - RED[k]);
    v(0.0, near * near, 0.0)
        + pulled(
            &[Pull::new([33.0, -48.0, 88.0], 6.0, [0.1, 0.5, 0.2])],
            key,
            p,
        ) * if key.mouth_position().is_some() {
            0.0
        } else {
            1.0
        }
});
const BAG_SULCUS: [Knot; 4] = [
    (9, [0.0, 0.0, 0.0]),
    (11, [0.0, -0.7, 0.8]),
    (13, [0.0, -0.7, 0.8]),
    (15, [0.0, 0.0, 0.0]),
];
const BAG_RIM: [Knot; 4] = [
    (9, [0.0, 0.0, 0.0]),
    (11, [0.0, -0.8, -0.4]),
    (13, [0.0, -0.8, -0.7]),
    (15, [0.0, 0.0, -0.3]),
];
pub(crate) const EYE_BAG: Form =
    Form::of(|key, _| lid(&[(1, &BAG_SULCUS), (0, &BAG_RIM), (2, &BAG_SULCUS)], key));
pub(crate) const NASOLABIAL_FOLD: Form = pulls!(
    [33.0, -30.0, 91.0], 6.0, [0.4, -0.4, 1.0];
    [26.0, -37.0, 94.5], 4.0, [-0.1, 0.2, -0.8]
);
pub(crate) const JOWL: Form = pulls!(
    [38.0, -77.0, 72.0], 9.0, [0.7, -1.0, 0.6];
    [25.0, -85.0, 83.0], 6.0, [-0.2, 0.4, -0.5]
);
pub(crate) const NECK_CORD: Form = pulls!(
    [12.0, -114.0, 43.0], 5.0, [0.0, 0.0, 1.0];
    [0.0, -100.0, 48.0], 8.0, [0.0, -0.5, 0.3]
);
pub(crate) const NECK_BREADTH: Form = Form::of(|key, p| {
    if on_neck(key) {
        v(p.x / 106.0, 0.0, 0.0) * below(p.y, -86.0, -106.0)
    } else {
        DVec3::ZERO
    }
});
