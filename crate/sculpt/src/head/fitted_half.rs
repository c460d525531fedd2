//! Adaptation of a bound head for motion: lids on an eyeball of life size, lips that meet, the
//! lining of lids, mouth and nostrils, and the neck below it.

use raconteur_base::{DQuat, DVec3, Side};

use super::binding::ModelHeadShape;
use super::cage::{Key, LAST_COLUMN, LAST_ROW, Points};
use super::ear_relief;
use super::lining::{
    CANTHUS, GLOBE_RADIUS_MM, LIP_BULGE_MM, line_lids, line_mouth, nostril, ring, upward,
};
use super::rig::smooth;

/// Radius at which the lashes root: the thickness of the lid outside the eyeball.
const LASH_RADIUS_MM: f64 = GLOBE_RADIUS_MM + 1.5;
/// Minimum distance of the lid plate outside the lashes' sphere, mm.
const PLATE_MM: f64 = 0.45;
/// Lowering of the upper lid at rest, mm: the model's eyes are wide open. From 1.1 mm on they look
/// dull.
const LID_REST_MM: f64 = 1.0;
/// Height of the pupil between the middles of the lower and the upper lid: margin reflex
/// distances of 5.5 and 4.3 mm (Murchison, Sires and Jian-Amadi 2009,
/// doi:10.1001/archfacial.2009.23).
const PUPIL_HEIGHT: f64 = 0.56;
/// Share of the lateral distance from the model's position to the midpoint between the eye's
/// corners by which the eyeball is moved; pupils are near that midpoint. Designed.
pub(crate) const CENTRED: f64 = 0.8;
/// Maximum height of the open eye at positions 6 and 7, as a share of that in the middle: the outer
/// corner is sharp, and the lids can meet there. Designed.
const TAPER: [(usize, f64); 2] = [(6, 0.76), (7, 0.48)];
/// Weights with which rings 2 to 5 follow the lid.
const LID_FOLLOWS: [f64; 4] = [0.0, 0.2, 0.8, 1.0];

/// Left half of a head, fitted so that lids and lips can move.
#[derive(Clone, Debug)]
pub(crate) struct FittedHalf {
    /// Positions of the cage's vertices, mm; vertices not listed are free.
    pub(crate) points: Points,
    /// Centre of the eyeball, mm.
    pub(crate) globe: DVec3,
    /// Crest of the brow from its inner end, mm.
    pub(crate) brow: Vec<DVec3>,
}

/// Fits a bound head; `neck` gives the positions of the cage's lowest rows.
pub(crate) fn fit(bound: &ModelHeadShape, neck: impl Fn(Key) -> Option<DVec3>) -> FittedHalf {
    let mut points = bound.symmetric();
    smooth_helix(&mut points);
    ear_relief::shape(&mut points);
    join_neck(&mut points, neck);
    let globe = lids(&mut points, bound.globe());
    line_lids(&mut points, globe);
    lips(&mut points);
    line_mouth(&mut points);
    nostril(&mut points);
    FittedHalf {
        points,
        globe,
        brow: bound.brow(),
    }
}

/// Returns the distance of the left eye of a head from the midline, mm.
pub(crate) fn eye_mm(bound: &ModelHeadShape) -> f64 {
    fit(bound, |_| None).globe.x
}

/// Smooths the root of the helix between its neighbouring lines: it would fold over where an ear
/// stands off.
fn smooth_helix(points: &mut Points) {
    if let (Some(&front), Some(&rear)) = (points.get(&Key::ear(1, 2)), points.get(&Key::ear(3, 2)))
    {
        points.insert(Key::ear(2, 2), front.lerp(rear, 0.45));
    }
}

/// Row of the grid down to which the neck is the model's; the rim of ours below it fits the
/// collar, and between them the surface is fair.
const MODEL_NECK_ROW: u8 = 29;

/// Blends the model's neck into that of this crate.
fn join_neck(points: &mut Points, neck: impl Fn(Key) -> Option<DVec3>) {
    for row in MODEL_NECK_ROW + 1..=LAST_ROW {
        for column in 0..=LAST_COLUMN {
            let key = Key::Grid(column, row);
            points.remove(&key);
            if row == LAST_ROW {
                points.extend(neck(key).map(|own| (key, own)));
            }
        }
    }
}

/// Narrows the open eye towards its outer corner.
fn taper(points: &mut Points) {
    let edge: [DVec3; 16] = ring(points, |k| Key::eye(5, k));
    let open = edge[4].y - edge[12].y;
    for (k, share) in TAPER {
        let height = edge[k].y - edge[16 - k].y;
        let nearer = (height - share * open).max(0.0) / 2.0;
        for (k, step) in [(k, -nearer), (16 - k, nearer)] {
            for r in 2..=5u8 {
                if let Some(p) = points.get_mut(&Key::eye(r, k)) {
                    p.y += step * smooth(1.0, 5.0, f64::from(r));
                }
            }
        }
    }
}

/// Lays the lash line on the lids' sphere about an eyeball of life size, whose centre it
/// returns: `model` is that of the model, whose eyes are a third too large.
fn lids(points: &mut Points, model: DVec3) -> DVec3 {
    taper(points);
    let edge: [DVec3; 16] = ring(points, |k| Key::eye(5, k));
    let (upper, lower) = (edge[4].y - LID_REST_MM, edge[12].y);
    let middle = (edge[0].x + edge[8].x) / 2.0;
    let across = model.x + CENTRED * (middle - model.x);
    let model = DVec3::new(across, lower + PUPIL_HEIGHT * (upper - lower), model.z);
    let aside = |k: usize| {
        (edge[k] - model)
            .truncate()
            .length()
            .min(0.93 * LASH_RADIUS_MM)
    };
    let rise = |k: usize| (LASH_RADIUS_MM * LASH_RADIUS_MM - aside(k) * aside(k)).sqrt();
    let middle: Vec<usize> = (0..16)
        .filter(|&k| CANTHUS[k] < 0.05 && aside(k) < 0.92 * LASH_RADIUS_MM)
        .collect();
    let depth = middle.iter().map(|&k| edge[k].z - rise(k)).sum::<f64>() / middle.len() as f64;
    let globe = model.truncate().extend(depth);
    for k in 0..16 {
        let mut to = globe.z + rise(k);
        if (edge[k] - model).truncate().length() > 0.93 * LASH_RADIUS_MM {
            to = to.min(edge[k].z);
        }
        let shift = (to - edge[k].z) * (1.0 - CANTHUS[k]);
        let is_upper = k <= 8;
        let along = k as f64 / 4.0 - 1.0;
        let down = LID_REST_MM / LASH_RADIUS_MM * (1.0 - along * along).max(0.0);
        for r in 0..=5u8 {
            let Some(p) = points.get_mut(&Key::eye(r, k)) else {
                continue;
            };
            p.z += shift * smooth(0.4, 5.0, f64::from(r));
            if r < 3 {
                continue;
            }
            let out = *p - globe;
            let least = LASH_RADIUS_MM + if r < 5 { PLATE_MM } else { 0.0 };
            let short = (least - out.length()).max(0.0);
            *p += out.normalize()
                * (short
                    * if CANTHUS[k] < 0.3 {
                        1.0
                    } else {
                        1.0 - CANTHUS[k]
                    });
            if is_upper {
                let turn = DQuat::from_rotation_x(down * LID_FOLLOWS[usize::from(r) - 2]);
                *p = globe + turn * (*p - globe);
            }
        }
    }
    globe
}

/// Height of the line where the lips meet above the gap in front of it, mm, so that nothing is
/// visible between them.
const LIP_ROLL_MM: f64 = 1.7;

/// Smooths the lips' inner line near the corners between its neighbours: full lips of the model
/// fold over there.
fn smooth_corners(points: &mut Points) {
    let [outer, inner]: [[DVec3; 13]; 2] = [4, 5].map(|r| ring(points, |k| Key::mouth(r, k)));
    for k in [5, 7usize] {
        let in_from = |k: usize| inner[k] - outer[k];
        let at = outer[k] + (in_from(k - 1) + in_from(k + 1)) / 2.0;
        points.insert(Key::mouth(5, k), at);
    }
}

/// Distance of a ring of one lip from that of the other, mm, for each ring between it and the line
/// where they meet.
const LIP_FRONT_MM: f64 = 1.0;
/// Maximum gap one ring before that line, mm; with more, teeth would be visible.
const LIP_OPENS_MM: f64 = 1.5;

/// Closes the lips: the model's are open by up to 2.4 mm.
fn lips(points: &mut Points) {
    smooth_corners(points);
    let line: [DVec3; 13] = ring(points, |k| Key::mouth(5, k));
    for r in 2..=5u8 {
        let share = smooth(1.5, 5.0, f64::from(r));
        let before: [DVec3; 13] = ring(points, |k| Key::mouth(r, k));
        let mut own = before;
        for (k, p) in own.iter_mut().enumerate() {
            // The lips meet at the same depth: each as far forward as the other.
            let ahead = before[12 - k].z - before[k].z;
            let gap = (line[12 - k] - line[k]).with_z(ahead);
            *p += gap * (0.5 * share);
        }
        let apart = LIP_FRONT_MM * f64::from(5 - r);
        for k in 0..6 {
            // Full lips would go through each other, and thin ones show teeth.
            let gap = own[k].y - own[12 - k].y;
            let most = if r == 4 { LIP_OPENS_MM } else { f64::MAX };
            let wanted = gap.clamp(apart, most);
            own[k].y += (wanted - gap) / 2.0;
            own[12 - k].y -= (wanted - gap) / 2.0;
        }
        for (k, mut p) in own.into_iter().enumerate() {
            if r >= 4 {
                p.y += LIP_BULGE_MM[k.min(12 - k)] * upward(k).signum();
            }
            if r == 5 {
                p.y += LIP_ROLL_MM * upward(k).abs();
            }
            points.insert(Key::mouth(r, k), p);
        }
    }
}

/// Weights with which the rings of an eye, from 0, follow the asymmetry of its side of the head:
/// lids stay on their eyeball.
const EYE_SWAYS: [f64; 9] = [1.0, 0.8, 0.55, 0.3, 0.1, 0.0, 0.0, 0.0, 0.0];

/// Returns the lateral shift of the nose, which is moved as a whole; otherwise the thin walls of
/// the nostrils would cross.
fn nose_sway(bound: &ModelHeadShape) -> DVec3 {
    let rim = |side| (0..8).map(move |k| bound.asymmetry(Key::nostril(0, k), side));
    Side::BOTH.into_iter().flat_map(rim).sum::<DVec3>() / 16.0
}

/// Returns the weight with which a vertex of the grid follows the tip of the nose.
fn nose_share(column: u8, row: u8) -> f64 {
    match (column, row) {
        (0..=4, 10..=14) => 1.0,
        (0..=4, 9 | 15) | (5, 10..=14) => 0.5,
        _ => 0.0,
    }
}

/// Returns the natural asymmetry of a cage vertex: its displacement from the symmetrised head, mm.
pub(super) fn sway(bound: &ModelHeadShape, key: Key, side: Side) -> DVec3 {
    let at = |key| bound.asymmetry(key, side);
    match key {
        Key::Eye(ring, _) => at(key) * EYE_SWAYS[usize::from(ring)],
        // Lips that meet share their asymmetry at the contact line.
        Key::Mouth(ring @ 2.., k) => {
            let (k, other) = (usize::from(k), 12 - usize::from(k));
            let ring = ring.min(5);
            let both = (at(Key::mouth(5, k)) + at(Key::mouth(5, other))) / 2.0;
            at(Key::mouth(ring, k)).lerp(both, smooth(1.5, 5.0, f64::from(ring)))
        }
        Key::Nostril(..) => nose_sway(bound),
        Key::Grid(column, row) if nose_share(column, row) > 0.0 => {
            at(key).lerp(nose_sway(bound), nose_share(column, row))
        }
        Key::Grid(_, row) => at(key) * (1.0 - smooth(25.5, 29.4, f64::from(row))),
        _ => at(key),
    }
}
