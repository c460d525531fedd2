//! Joint weights of the cage's points.

use raconteur_base::curve::smooth;
use raconteur_base::{Side, ops};

use super::{ARM_RINGS, COLUMNS, HOLE, Key, LEG_RINGS, RING, ROWS};
use crate::torso::shape::{CM, Joints};
use crate::torso::shell::Shell;
use crate::torso::weights::{Rig, Weights};
use raconteur_body::skeleton::Bone;

/// Computes the skinning weights of the cage: one joint label for each vertex, then rounds of
/// averaging with the neighbours.
pub(super) fn weights(
    shell: &Shell,
    keys: &[Key],
    heights: &[f64],
    joints: &Joints,
) -> Vec<Weights> {
    let mut w: Vec<Weights> = keys.iter().map(|k| label(*k, heights, joints)).collect();
    let (around, _) = shell.neighbours();
    for round in 0..36 {
        let before = w.clone();
        for (v, key) in keys.iter().enumerate() {
            let on_limb = match key {
                Key::Arm(_, j, _) => ARM_RINGS[*j] > 0.68,
                Key::Leg(_, j, _) => LEG_RINGS[*j] > 0.68,
                Key::Trunk(..) | Key::Crotch(_) => false,
            };
            if on_limb && round >= 3 {
                continue;
            }
            let share = 0.5 / around[v].len().max(1) as f64;
            let terms = around[v].iter().map(|&i| (&before[i as usize], share));
            w[v] = Weights::mix(terms.chain([(&before[v], 0.5)]));
        }
    }
    w
}

/// Weights along the spine at a height: each bone carries the trunk from its joint to the
/// next, with a soft change at the joint.
fn spine_label(y: f64, joints: &Joints) -> Weights {
    let mut out = Weights::bone(Bone::Sacroiliac);
    for bone in [Bone::Lumbar, Bone::Thoracic, Bone::Cervical] {
        let reach = if bone == Bone::Cervical { 1.5 } else { 3.5 } * CM;
        let above = smooth((y - joints.position_of(bone).y + reach) / (2.0 * reach));
        out = out.lerp(&Weights::bone(bone), above);
    }
    out
}

fn label(key: Key, heights: &[f64], joints: &Joints) -> Weights {
    match key {
        Key::Crotch(_) => Weights::bone(Bone::Sacroiliac),
        Key::Trunk(r, column) => {
            let last = ROWS.len() - 1;
            let q = column.min(COLUMNS - column);
            let side = if column < 12 { Side::Left } else { Side::Right };
            let girdle = (r > HOLE.0 && r <= HOLE.1 && (3..=9).contains(&q))
                || ((HOLE.1 - 1..=HOLE.1).contains(&r) && (q == 2 || q == 10));
            if r == last {
                Weights::bone(Bone::Skull)
            } else if r + 1 == last {
                Weights::bone(Bone::Cervical)
            } else if girdle {
                Weights::bone(Bone::on(side, "scapula"))
            } else {
                spine_label(heights[r], joints)
            }
        }
        Key::Arm(side, j, k) => {
            // Over the shoulder, the girdle extends farther, because a raised arm would otherwise
            // fold the cloth into the trunk; the armpit's cloth follows the arm.
            let top = ops::cos(core::f64::consts::TAU * k as f64 / RING as f64).max(0.0);
            let near = 1.0 - smooth((ARM_RINGS[j] - 0.10) / 0.5);
            arm_label(side, ARM_RINGS[j] - 0.09 * top * near)
        }
        Key::Leg(side, j, _) => {
            let [hip, knee, foot] = ["hip", "knee", "subtalar"].map(|n| Bone::on(side, n));
            match LEG_RINGS[j] {
                t if t < 0.15 => Weights::one(Rig::Half(hip)),
                t if t < 0.90 => Weights::bone(hip),
                t if t < 1.09 => Weights::one(Rig::Half(knee)),
                t if t < 1.95 => Weights::bone(knee),
                _ => Weights::bone(foot),
            }
        }
    }
}

/// Weights along the arm: half joints at shoulder and elbow, the wrist's twist by thirds.
fn arm_label(side: Side, t: f64) -> Weights {
    let [scapula, shoulder, elbow, wrist] =
        ["scapula", "shoulder", "elbow", "wrist"].map(|n| Bone::on(side, n));
    let stops = [
        (-0.04, Rig::Bone(scapula)),
        (0.14, Rig::Half(shoulder)),
        (0.40, Rig::Swing(shoulder, 1)),
        (0.60, Rig::Swing(shoulder, 1)),
        (0.72, Rig::Swing(shoulder, 2)),
        (0.86, Rig::Bone(shoulder)),
        (1.0, Rig::Half(elbow)),
        (1.17, Rig::Bone(elbow)),
        (1.36, Rig::Twist(wrist, 1)),
        (1.66, Rig::Twist(wrist, 2)),
        (1.92, Rig::Twist(wrist, 2)),
        (2.0, Rig::Half(wrist)),
        (2.08, Rig::Bone(wrist)),
    ];
    let i = stops.partition_point(|s| s.0 <= t);
    match (i.checked_sub(1).map(|b| stops[b]), stops.get(i)) {
        (None, _) => Weights::one(stops[0].1),
        (Some(last), None) => Weights::one(last.1),
        (Some(a), Some(b)) => Weights::one(a.1).lerp(&Weights::one(b.1), (t - a.0) / (b.0 - a.0)),
    }
}
