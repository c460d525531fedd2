//! Forms: named directions in which the points of the head move. A person is the mean head
//! plus a sum of forms, each times an amount.
//!
//! Every form is a function of a point's key and of its place on the mean head, so that a
//! sum of forms does not depend on their order and a measured distance is nearly linear in
//! the amounts.

mod age;
mod child;
mod expression;
pub(crate) mod handle;
mod sex;

pub(crate) use self::age::OLD;
pub(crate) use self::child::CHILD;
pub(crate) use self::expression::SMILE;
pub(crate) use self::sex::{MAN, WOMAN};

use raconteur_base::{DVec3, ops};

use super::cage::Key;
use super::ear_shape::EarShape;

/// Displacement of a named point at amount 1, mm, from its key and place on the mean head.
pub(crate) type Displace = fn(Key, DVec3) -> DVec3;

/// One direction of variation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Form {
    /// Movement of the named points.
    pub(crate) displace: Displace,
    /// Movement of the left eyeball, which takes crease and lid margins along, mm.
    pub(crate) globe: DVec3,
    /// Change of the ear.
    pub(crate) ear: EarShape,
}

impl Form {
    /// A form of the named points alone.
    pub(crate) const fn of(displace: Displace) -> Self {
        Self {
            displace,
            globe: DVec3::ZERO,
            ear: EarShape::NONE,
        }
    }
}

/// A soft pull: a Gaussian about an anchor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pull {
    /// Centre, mm.
    pub(crate) at: DVec3,
    /// Standard deviation, mm.
    pub(crate) radius: f64,
    /// Shift at the centre, mm.
    pub(crate) shift: DVec3,
}

impl Pull {
    pub(crate) const fn new(at: [f64; 3], radius: f64, shift: [f64; 3]) -> Self {
        Self {
            at: DVec3::from_array(at),
            radius,
            shift: DVec3::from_array(shift),
        }
    }

    /// Its share at a place.
    pub(crate) fn share(&self, p: DVec3) -> f64 {
        ops::exp(-(p - self.at).length_squared() / (2.0 * self.radius * self.radius))
    }
}

/// How much of a soft pull reaches a point: lid margin, crease and plate belong to the
/// globe, not to the face.
pub(crate) fn reach(key: Key) -> f64 {
    match key {
        Key::Eye(1, _) => 0.75,
        Key::Eye(2, _) => 0.35,
        Key::Eye(..) => 0.0,
        _ => 1.0,
    }
}

/// The sum of soft pulls at a point.
pub(crate) fn pulled(pulls: &[Pull], key: Key, p: DVec3) -> DVec3 {
    let sum: DVec3 = pulls.iter().map(|pull| pull.shift * pull.share(p)).sum();
    sum * reach(key)
}

/// A knot: position along a ring and shift there, mm.
pub(crate) type Knot = (usize, [f64; 3]);

/// Piecewise-linear shift along a ring between knots in rising order; zero outside them.
pub(crate) fn along(knots: &[Knot], k: usize) -> DVec3 {
    let at = |(_, shift): Knot| DVec3::from_array(shift);
    for pair in knots.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        if (a.0..=b.0).contains(&k) {
            return at(a).lerp(at(b), (k - a.0) as f64 / (b.0 - a.0) as f64);
        }
    }
    knots
        .iter()
        .find(|n| n.0 == k)
        .map_or(DVec3::ZERO, |&n| at(n))
}

/// What a scaling about a centre moves a place by.
pub(crate) fn scaled(p: DVec3, centre: [f64; 3], factor: [f64; 3]) -> DVec3 {
    (p - DVec3::from_array(centre)) * (DVec3::from_array(factor) - DVec3::ONE)
}

/// Whether a point lies on the nose, alae and columella included.
pub(crate) fn on_nose(key: Key) -> bool {
    matches!(key, Key::Grid(i, j) if (7..=15).contains(&j)
        && i <= if j >= 9 { 5 } else { 4 }
        && !(j >= 15 && i > 2))
}

/// Share of the lower nose in a shift of its tip; the alar crease and what lies behind it
/// follow less.
pub(crate) fn nose_tip(key: Key) -> f64 {
    match key {
        Key::Grid(i, j @ 8..=14) if i <= 5 => {
            let row = [0.2, 0.55, 0.85, 1.0, 1.0, 0.95, 0.8][usize::from(j) - 8];
            row * if i < 4 { 1.0 } else { 0.6 }
        }
        Key::Grid(i, 15) if i <= 3 => 0.5,
        _ => 0.0,
    }
}

/// Whether a point belongs to the lips or the ring about them.
pub(crate) fn on_lips(key: Key) -> bool {
    key.mouth_position().is_some()
}

/// Shift of the lips' rings: the border in full, the ring about it and the fullest line in
/// part.
pub(crate) fn lips(knots: &[Knot], key: Key) -> DVec3 {
    let Some((ring, k)) = key.mouth_position() else {
        return DVec3::ZERO;
    };
    let d = along(knots, k);
    match ring {
        0 => DVec3::new(d.x, d.y * 0.55, d.z * 0.5),
        1 => d,
        3 => DVec3::new(d.x, d.y * 0.35, d.z * 1.6),
        4 => DVec3::new(d.x, 0.0, 0.0),
        _ => DVec3::ZERO,
    }
}

/// Shift of one ring of the eye.
pub(crate) fn lid(rings: &[(u8, &[Knot])], key: Key) -> DVec3 {
    let Some((ring, k)) = key.eye_position() else {
        return DVec3::ZERO;
    };
    rings
        .iter()
        .filter(|r| r.0 == ring)
        .map(|r| along(r.1, k))
        .sum()
}

/// Smooth step of a height below `top` that is full at `bottom`.
pub(crate) fn below(y: f64, top: f64, bottom: f64) -> f64 {
    ((top - y) / (top - bottom)).clamp(0.0, 1.0)
}

/// Neck and throat of the grid: rows under the jaw and the nape.
pub(crate) fn on_neck(key: Key) -> bool {
    matches!(key, Key::Grid(i, j) if j >= 25 || (i >= 15 && j > 18))
}

/// Skull above and behind the ears.
pub(crate) fn on_skull(key: Key) -> bool {
    matches!(key, Key::Crown(..)) || matches!(key, Key::Grid(i, j) if i >= 11 && j <= 20)
}
