//! Joint weights of a vertex.
//!
//! Linear blending with half joints: at each joint, a helper turns half the angle, and the weight
//! goes parent → half → child, which keeps the dorsal radius of a bent joint at 0.96 of its rest
//! value, compared with 0.63 without the helpers.

use raconteur_base::{DVec3, Side, curve};

use super::anatomy::{Anatomy, FINGER_COUNT};
use super::surface::{Skin, finger_share, mean_around};
use crate::part::JointRef;
use raconteur_body::hand_shape::finger_bones;
use raconteur_body::skeleton::{Bone, Drive};

/// Joint that a hand vertex can follow, independent of the side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Influence {
    /// First or second third of the wrist's twist, 1 or 2.
    ForearmTwist(u8),
    /// Joint with half the rotation of the wrist.
    HalfWrist,
    /// The wrist.
    Hand,
    /// Joint with half the rotation of a finger's joint: finger and joint, counted 0 to 2.
    Half(usize, usize),
    /// A finger's bone.
    Finger(usize, usize),
}

const COUNT: usize = 4 + 2 * 3 * FINGER_COUNT;
const TWIST1: usize = 0;
const TWIST2: usize = 1;
const HALF_WRIST: usize = 2;
const HAND: usize = 3;

fn half_joint(f: usize, k: usize) -> usize {
    4 + 3 * f + k
}

fn bone(f: usize, k: usize) -> usize {
    4 + 3 * FINGER_COUNT + 3 * f + k
}

/// Returns the bone of a finger, thumb 0 to little finger 4; `k` counts from the hand.
pub(super) fn finger_bone(side: Side, f: usize, k: usize) -> Bone {
    // `hand_shape` counts the index first and the thumb last.
    finger_bones(side)[3 * ((f + FINGER_COUNT - 1) % FINGER_COUNT) + k]
}

impl Influence {
    fn from_index(index: usize) -> Self {
        match index {
            TWIST1 => Self::ForearmTwist(1),
            TWIST2 => Self::ForearmTwist(2),
            HALF_WRIST => Self::HalfWrist,
            HAND => Self::Hand,
            i if i < 4 + 3 * FINGER_COUNT => Self::Half((i - 4) / 3, (i - 4) % 3),
            i => {
                let i = i - 4 - 3 * FINGER_COUNT;
                Self::Finger(i / 3, i % 3)
            }
        }
    }

    /// Returns the joint of this influence on a side.
    pub(super) fn joint(self, side: Side) -> JointRef {
        let wrist = match side {
            Side::Left => Bone::LWrist,
            Side::Right => Bone::RWrist,
        };
        JointRef(match self {
            Self::ForearmTwist(n) => Drive::Twist(wrist, f64::from(n) / 3.0),
            Self::HalfWrist => Drive::half(wrist),
            Self::Hand => Drive::Bone(wrist),
            Self::Half(f, k) => Drive::half(finger_bone(side, f, k)),
            Self::Finger(f, k) => Drive::Bone(finger_bone(side, f, k)),
        })
    }
}

/// Returns the smooth share 0 before a joint to 1 after it; the transition spans `before` + `after`
/// millimetres.
fn passed(along: f64, joint: f64, before: f64, after: f64) -> f64 {
    curve::smooth((along - joint + before) / (before + after))
}

/// Splits a share at a joint between parent, half joint and child; returns the child's.
fn split(row: &mut [f64; COUNT], u: f64, parent: usize, half: usize, share: f64) -> f64 {
    row[parent] += share * (1.0 - 2.0 * u).max(0.0);
    row[half] += share * (1.0 - (2.0 * u - 1.0).abs());
    share * (2.0 * u - 1.0).max(0.0)
}

fn to_segment(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let ab = b - a;
    let t = ((p - a).dot(ab) / ab.length_squared()).clamp(0.0, 1.0);
    (p - a - ab * t).length()
}

/// Returns the weight of the thumb's metacarpal relative to the palm at each vertex: inverse fourth
/// power of the distances to the bones, smoothed.
fn thumb_shares(anatomy: &Anatomy, skin: &Skin) -> Vec<f64> {
    let thumb = &anatomy.fingers[0];
    let along = thumb.frame.y_axis;
    let fourth = |d: f64| d * d * d * d;
    let raw: Vec<f64> = skin
        .positions
        .iter()
        .zip(&skin.ownership)
        .map(|(&p, owned)| {
            if finger_share(owned) >= 0.3 {
                return 0.0;
            }
            let to_thumb = to_segment(p, thumb.origin + along * 9.0, thumb.origin + along * 46.0);
            let carpus = to_segment(p, DVec3::new(15.0, -3.0, 4.0), DVec3::new(-12.0, 6.0, 4.0));
            let to_palm = (1..FINGER_COUNT)
                .map(|f| to_segment(p, anatomy.metacarpal_base[f - 1], anatomy.fingers[f].origin))
                .fold(carpus, f64::min);
            let near = fourth(to_palm) / (fourth(to_palm) + fourth(to_thumb * 0.95));
            near.max(curve::smooth((owned[0] - 0.35) / 0.4)) * curve::smooth((p.y + 2.0) / 16.0)
        })
        .collect();
    let mut shares = raw.clone();
    for _ in 0..5 {
        let before = shares.clone();
        for (i, share) in shares.iter_mut().enumerate() {
            if skin.ownership[i][0] <= 0.9 {
                *share = 0.5 * before[i] + 0.5 * mean_around(&before, &skin.neighbours[i]);
            }
        }
        for (share, raw) in shares.iter_mut().zip(&raw) {
            if *raw >= 1.0 {
                *share = 1.0;
            }
        }
    }
    shares
}

/// Shares of the four rays in a vertex of palm, webs or fingers.
fn ray_shares(anatomy: &Anatomy, p: DVec3, owned: &[f64; FINGER_COUNT]) -> [f64; 4] {
    let near = [1, 2, 3, 4].map(|f| {
        let d = anatomy.fingers[f].local(p).x.abs() + 1.5;
        1.0 / (d * d * d)
    });
    let sum: f64 = near.iter().sum();
    let sole = curve::smooth((finger_share(owned) - 0.5) / 0.35);
    let mut owner = 1;
    for f in 2..FINGER_COUNT {
        if owned[f] > owned[owner] {
            owner = f;
        }
    }
    core::array::from_fn(|i| near[i] / sum * (1.0 - sole) + if i + 1 == owner { sole } else { 0.0 })
}

/// Returns the progress of a vertex past each of a finger's joints, 0 to 1.
fn joints_passed(anatomy: &Anatomy, f: usize, p: DVec3) -> [f64; 3] {
    let finger = &anatomy.fingers[f];
    let local = finger.local(p);
    let joints = finger.joints();
    let s = local.y;
    if f == 0 {
        // The blend with the palm replaces the saddle joint's own zone.
        return [
            1.0,
            passed(s, joints[1], 9.0, 9.0),
            passed(s, joints[2], 7.0, 7.0),
        ];
    }
    let height = (local.z / finger.section(s).palmar).clamp(-1.0, 1.0);
    // On the palm side, the fold is further distal than the knuckle.
    let palmar = curve::smooth(0.5 + 0.5 * height);
    let g = finger.girth;
    [
        passed(s, 0.0, 9.0 * g + 2.0 * palmar, 8.0 * g + 7.0 * palmar),
        passed(s, joints[1], 7.2 * g, 7.2 * g),
        passed(s, joints[2], 5.6 * g, 5.6 * g),
    ]
}

/// Weights of every vertex of the skin: up to four, summing to 1. `forearm_mm` is the
/// length of the forearm in this folder's scale.
pub(super) fn weights(
    anatomy: &Anatomy,
    skin: &Skin,
    forearm_mm: f64,
) -> Vec<Vec<(Influence, f64)>> {
    let thumb_shares = thumb_shares(anatomy, skin);
    let mut rows: Vec<[f64; COUNT]> = skin
        .positions
        .iter()
        .zip(&skin.ownership)
        .zip(&thumb_shares)
        .map(|((&p, owned), &thumb)| {
            let mut row = [0.0; COUNT];
            // The forearm's skin twists in proportion to the distance from elbow to wrist. The
            // helpers represent thirds, so beyond the second third, part of the weight goes to the
            // wrist: little, because the wrist also bends. The half joint preserves the thickness
            // of a bent wrist, but lags behind in twist and receives half its share.
            let u = passed(p.y, 0.0, 16.0, 14.0);
            let half = 0.5 * (1.0 - (2.0 * u - 1.0).abs());
            let hand = u - half / 2.0;
            let leaning = 0.22 * curve::smooth((p.y + 75.0) / 65.0);
            let forearm = 1.0 - hand - half;
            let second = ((1.0 + p.y / forearm_mm) * 3.0 - 1.0).clamp(0.0, 1.0);
            row[HALF_WRIST] = half;
            row[TWIST1] = forearm * (1.0 - second);
            row[TWIST2] = forearm * second * (1.0 - leaning);
            row[HAND] += forearm * second * leaning;

            let rays = ray_shares(anatomy, p, owned);
            for f in 1..FINGER_COUNT {
                let mut share = hand * (1.0 - thumb) * rays[f - 1];
                let mut parent = HAND;
                for (k, u) in joints_passed(anatomy, f, p).into_iter().enumerate() {
                    share = split(&mut row, u, parent, half_joint(f, k), share);
                    parent = bone(f, k);
                }
                row[parent] += share;
            }
            let mut share = hand * thumb;
            for (k, u) in joints_passed(anatomy, 0, p).into_iter().enumerate().skip(1) {
                share = split(&mut row, u, bone(0, k - 1), half_joint(0, k), share);
            }
            row[bone(0, 2)] += share;
            // Around the thumb's base palm and metacarpal share through the half joint.
            let half = 1.6 * row[HAND].min(row[bone(0, 0)]);
            row[HAND] -= half / 2.0;
            row[bone(0, 0)] -= half / 2.0;
            row[half_joint(0, 0)] += half;
            row
        })
        .collect();

    let before = rows.clone();
    for (i, row) in rows.iter_mut().enumerate() {
        if finger_share(&skin.ownership[i]) < 0.95 && skin.positions[i].y > 55.0 {
            let around = &skin.neighbours[i];
            for (k, w) in row.iter_mut().enumerate() {
                let mean = around.iter().map(|&j| before[j as usize][k]).sum::<f64>()
                    / around.len() as f64;
                *w = 0.5 * (*w + mean);
            }
        }
    }
    rows.iter().map(strongest).collect()
}

/// Returns the four largest weights of a row, normalised to sum to 1.
fn strongest(row: &[f64; COUNT]) -> Vec<(Influence, f64)> {
    let mut order: Vec<usize> = (0..COUNT).filter(|&i| row[i] > 0.004).collect();
    order.sort_by(|&a, &b| row[b].total_cmp(&row[a]).then(a.cmp(&b)));
    order.truncate(4);
    let sum: f64 = order.iter().map(|&i| row[i]).sum();
    order
        .iter()
        .map(|&i| (Influence::from_index(i), row[i] / sum))
        .collect()
}
