//! Coordinates of the skin about eyes, mouth, nostrils and ears, and the colour of the mouth behind
//! the lips; a map colours the skin itself.

use raconteur_base::DVec3;

use super::cage::{Cage, Key};
use super::rig::smooth;
use super::surface::Surface;

/// Colour of the mouth behind the lips, linear RGB.
pub(crate) const MOUTH_DEEP: [f64; 3] = [0.16, 0.04, 0.035];

/// Smooth coordinates of a point on the head, from which the zones of the skin paint are derived.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coordinates {
    /// Ring number at the mouth, 0 outside.
    pub(crate) mouth: f64,
    /// Ring number at the eye.
    pub(crate) eye: f64,
    /// 1 on the upper half of the eye's rings, −1 on the lower.
    pub(crate) eye_upper: f64,
    /// Ring number at the nostril.
    pub(crate) nostril: f64,
    /// Ring number at the ear.
    pub(crate) ear: f64,
}

/// Returns the coordinates of every rendered vertex.
pub(super) fn coordinates(cage: &Cage, surface: &Surface) -> Vec<Coordinates> {
    let ring = |f: fn(Key) -> Option<u8>| {
        surface.apply_by(cage, |v| f(cage.keys[v].0).map_or(0.0, f64::from))
    };
    let upper = surface.apply_by(cage, |v| match cage.keys[v].0 {
        Key::Eye(_, k) if (1..8).contains(&k) => 1.0,
        Key::Eye(_, k) if k > 8 => -1.0,
        _ => 0.0,
    });
    let mouth = ring(|k| {
        if let Key::Mouth(r, _) = k {
            Some(r)
        } else {
            None
        }
    });
    let eye = ring(|k| {
        if let Key::Eye(r, _) = k {
            Some(r)
        } else {
            None
        }
    });
    let nostril = ring(|k| {
        if let Key::Nostril(r, _) = k {
            Some(r)
        } else {
            None
        }
    });
    let ear = ring(|k| {
        if let Key::Ear(r, _) = k {
            Some(r)
        } else {
            None
        }
    });
    (0..surface.len())
        .map(|v| Coordinates {
            mouth: mouth[v],
            eye: eye[v],
            eye_upper: upper[v],
            nostril: nostril[v],
            ear: ear[v],
        })
        .collect()
}

/// The lips' wet inner side, linear RGB.
const LIP_INSIDE: [f64; 3] = [0.34, 0.115, 0.095];

/// Returns the linear RGB of the mouth's lining from where the lips meet (ring 5) inwards.
pub(super) fn lining(c: &Coordinates, p: DVec3) -> [f64; 3] {
    let share = smooth(4.5, 5.6, c.mouth);
    let wet = 1.0 + 0.04 * crate::texture::space_noise(7, p / 2.1);
    core::array::from_fn(|i| (LIP_INSIDE[i] + (MOUTH_DEEP[i] - LIP_INSIDE[i]) * share) * wet)
}
