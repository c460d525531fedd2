//! Joint weights of lids, jaw, skull and neck, and the angle that closes the lids.

use raconteur_base::{DQuat, DVec3, Side, mirror_vector};

use super::cage::{Cage, Key, LAST_ROW};
use super::solve::Solved;
use crate::part::JointRef;
use raconteur_body::skeleton::{Bone, Drive};

/// Axis of the temporomandibular joints, mm: a finger's breadth in front of the ear's
/// canal. Chosen by eye from the head's anatomy.
pub(crate) const JAW_HINGE_MM: DVec3 = DVec3::new(0.0, -2.0, 8.0);
/// Position of the joint between skull and neck, mm: the occipital condyles are below and slightly
/// behind the ear canals. Chosen by eye.
pub(crate) const SKULL_ORIGIN_MM: DVec3 = DVec3::new(0.0, -18.0, -8.0);

/// Skinning shares of a cage vertex; the remainder belongs to the skull and the neck.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Shares {
    pub(crate) jaw: f64,
    pub(crate) upper_lid: f64,
    pub(crate) lower_lid: f64,
    /// 0 skull, 1 half-way joint, 2 neck.
    pub(crate) neck: f64,
}

impl core::ops::Mul<f64> for Shares {
    type Output = Self;

    fn mul(self, k: f64) -> Self {
        Self {
            jaw: self.jaw * k,
            upper_lid: self.upper_lid * k,
            lower_lid: self.lower_lid * k,
            neck: self.neck * k,
        }
    }
}

impl core::iter::Sum for Shares {
    fn sum<I: Iterator<Item = Self>>(shares: I) -> Self {
        shares.fold(Self::default(), |a, b| Self {
            jaw: a.jaw + b.jaw,
            upper_lid: a.upper_lid + b.upper_lid,
            lower_lid: a.lower_lid + b.lower_lid,
            neck: a.neck + b.neck,
        })
    }
}

/// Smooth step from 0 at `a` to 1 at `b`.
pub(crate) fn smooth(a: f64, b: f64, x: f64) -> f64 {
    let t = ((x - a) / (b - a)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Boundary of the face, which the borders between jaw, skull and neck follow.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    mouth_corner: DVec3,
    menton: DVec3,
}

/// Share of the jaw along the mouth's rings: upper lip, corner (6), lower lip.
const JAW_AT_MOUTH: [f64; 13] = [
    0.0, 0.0, 0.0, 0.0, 0.06, 0.2, 0.5, 0.82, 0.96, 1.0, 1.0, 1.0, 1.0,
];

fn jaw_share(key: Key, p: DVec3, face: &Bounds) -> f64 {
    let in_front = |row: u8| smooth(2.0, 36.0, p.z) * (1.0 - smooth(24.5, 29.0, f64::from(row)));
    // Distance below the plane through hinge and mouth corner.
    let corner = ((face.mouth_corner - JAW_HINGE_MM) * DVec3::new(0.0, 1.0, 1.0)).normalize();
    let below = (p - JAW_HINGE_MM).dot(DVec3::new(0.0, -corner.z, corner.y));
    let by_plane = smooth(-10.0, 18.0, below);
    match (key, key.mouth_position()) {
        (Key::Mouth(8, _), _) => 0.5,
        (Key::Mouth(..), Some((_, k))) => JAW_AT_MOUTH[k],
        (Key::Grid(_, row), Some((_, k))) => JAW_AT_MOUTH[k] * in_front(row),
        (Key::Grid(_, row), None) => by_plane * in_front(row),
        _ => 0.0,
    }
}

fn neck_share(key: Key, p: DVec3, face: &Bounds) -> f64 {
    let Key::Grid(_, row) = key else { return 0.0 };
    // The border between head and neck rises from under the chin to the nape.
    let border = face.menton.y - 8.7 + (50.0 - p.z).clamp(0.0, 110.0) * 0.36;
    let below = border - p.y;
    if row >= LAST_ROW {
        2.0
    } else {
        2.0 * smooth(-6.0, 46.0, below)
    }
}

/// Weights with which each eye ring follows its lid; rings 3 to 7.
const UPPER_FOLLOWS: [f64; 5] = [0.14, 0.85, 1.0, 1.0, 0.9];
const LOWER_FOLLOWS: [f64; 5] = [0.2, 0.6, 1.0, 1.0, 0.9];

/// Skinning weights of all cage vertices, and the lid angles that close the eyes.
#[derive(Clone, Debug)]
pub(crate) struct Rig {
    pub(crate) shares: Vec<Shares>,
    /// Upper-lid angle that closes the eye, left and right, radians.
    pub(crate) closure_rad: [f64; 2],
}

/// Solves the rig on the limit surface.
pub(crate) fn rig(cage: &Cage, solved: &Solved, globe_centre_mm: DVec3) -> Rig {
    let limit = |key| solved.limit_of(cage.vertex(key, Side::Left), &solved.cage_points);
    let face = Bounds {
        mouth_corner: limit(Key::mouth(1, 6)),
        menton: limit(Key::Grid(0, 24)),
    };
    let mut shares: Vec<Shares> = cage
        .keys
        .iter()
        .zip(&solved.cage_points)
        .map(|(&(key, _), &p)| Shares {
            jaw: jaw_share(key, p, &face),
            neck: neck_share(key, p, &face),
            ..Shares::default()
        })
        .collect();
    let closure_rad = Side::BOTH.map(|side| {
        let centre = if side == Side::Left {
            globe_centre_mm
        } else {
            mirror_vector(globe_centre_mm)
        };
        close_lid(cage, solved, side, centre, &mut shares)
    });
    Rig {
        shares,
        closure_rad,
    }
}

/// Returns the overlap of the upper lash edge over the lower one at a position, mm, so that no slit
/// is left between the cage's positions.
fn overlap_mm(k: usize) -> f64 {
    0.2 + 1.1 * smooth(5.0, 7.0, k as f64)
}

/// Finds the shares along the upper lid for which one rotation lays its lash edge onto the
/// lower one at every position. Returns the angle.
fn close_lid(
    cage: &Cage,
    solved: &Solved,
    side: Side,
    centre: DVec3,
    shares: &mut [Shares],
) -> f64 {
    let elevation = |p: DVec3| raconteur_base::ops::atan2(p.y - centre.y, p.z - centre.z);
    // Required turn of positions 1..=7 of the upper lid.
    let mut turn = [0.0; 7];
    let mut closure = 0.0;
    for round in 0..12 {
        let posed: Vec<DVec3> = if round == 0 {
            solved.cage_points.clone()
        } else {
            let q = DQuat::from_rotation_x(closure);
            solved
                .cage_points
                .iter()
                .zip(shares.iter())
                .map(|(&p, s)| p.lerp(centre + q * (p - centre), s.upper_lid))
                .collect()
        };
        // The other side's lid is posed too, but has no effect here.
        let at = |k| solved.limit_of(cage.vertex(Key::eye(5, k), side), &posed);
        for (k, t) in (1..8).zip(&mut turn) {
            let arm = ((at(k) - centre) * DVec3::new(0.0, 1.0, 1.0))
                .length()
                .max(1.0);
            let open = elevation(at(k)) - elevation(at(16 - k)) + overlap_mm(k) / arm;
            *t = (*t + open).clamp(0.0, 1.4);
        }
        // Next to the outer corner, the lid has a very short lever arm about the eye: its required
        // angle would leave the middle too small a share, whose chord cuts into the globe.
        closure = turn[..6].iter().copied().fold(1e-3, f64::max);
        turn[6] = turn[6].min(closure);
        for k in 1..8usize {
            // Halfway rings of the lower lid bulge in the middle.
            let middle = 1.0 - ((k as f64 - 4.0) / 4.0) * ((k as f64 - 4.0) / 4.0);
            for (i, ring) in (3..=7).enumerate() {
                let upper = cage.vertex(Key::eye(ring, k), side);
                shares[upper].upper_lid = turn[k - 1] / closure * UPPER_FOLLOWS[i];
                let lower = cage.vertex(Key::eye(ring, 16 - k), side);
                shares[lower].lower_lid = middle * LOWER_FOLLOWS[i];
                // The outer corner sinks a little with the lid that closes.
                let corner = cage.vertex(Key::eye(ring, 8), side);
                shares[corner].upper_lid = 0.3 * turn[6] / closure * UPPER_FOLLOWS[i];
            }
        }
    }
    closure
}

/// Joints of one vertex.
pub(crate) fn joints(s: Shares, side: Side) -> Vec<(JointRef, f64)> {
    let lid_upper = s.upper_lid.clamp(0.0, 1.0);
    let lid_lower = s.lower_lid.clamp(0.0, 1.0 - lid_upper);
    let jaw = s.jaw.clamp(0.0, 1.0 - lid_upper - lid_lower);
    let rest = 1.0 - lid_upper - lid_lower - jaw;
    let neck = s.neck.clamp(0.0, 2.0);
    let all = [
        (Drive::UpperLid(side), lid_upper),
        (Drive::LowerLid(side), lid_lower),
        (Drive::Bone(Bone::Chin), jaw),
        (Drive::Bone(Bone::Skull), rest * (1.0 - neck).max(0.0)),
        (
            Drive::Share(Bone::Skull, 0.5),
            rest * (1.0 - (neck - 1.0).abs()),
        ),
        (Drive::Bone(Bone::Cervical), rest * (neck - 1.0).max(0.0)),
    ];
    let kept: Vec<_> = all.into_iter().filter(|&(_, w)| w > 1e-4).collect();
    let sum: f64 = kept.iter().map(|k| k.1).sum();
    kept.into_iter()
        .map(|(d, w)| (JointRef(d), w / sum))
        .collect()
}
