//! The 27 bones inside a hand, fitted to its joints. From wrist to fingertip they follow the bone
//! lengths of `super::anatomy`; widths are designed after plain anatomy (a phalanx is broad at its
//! base, waisted, and ends in a head), and stay inside the hand's field.

use raconteur_base::{DMat3, DVec3, Side};

use super::anatomy::{Anatomy, FINGER_COUNT, Finger, HandBuild};
use super::weights::Influence;
use super::{HandParams, Placement, surface};
use crate::part::JointRef;
use crate::solid::Solid;

/// One bone of the hand as a closed surface, hand frame (see [`super`]), metres.
#[derive(Clone, Debug)]
pub struct HandBone {
    /// Name of the bone, for example `l_index_proximal`.
    pub name: String,
    /// Joint to which it is rigidly attached.
    pub joint: JointRef,
    /// Surface of the bone.
    pub solid: Solid,
}

/// Carpal bones: name, centre and half axes (radial, distal, palmar), mm, by eye.
const CARPALS: [(&str, [f64; 3], [f64; 3]); 8] = [
    ("scaphoid", [11.5, 5.5, 1.5], [6.0, 6.5, 4.6]),
    ("lunate", [1.0, 4.5, 0.0], [5.4, 4.8, 5.6]),
    ("triquetrum", [-9.5, 6.0, -0.5], [4.8, 5.0, 5.0]),
    ("pisiform", [-14.0, 8.0, 8.0], [3.6, 4.4, 3.6]),
    ("trapezium", [19.0, 11.0, 6.0], [4.6, 4.6, 5.0]),
    ("trapezoid", [12.0, 14.5, 0.0], [4.0, 4.2, 5.2]),
    ("capitate", [2.5, 13.5, -1.0], [4.8, 5.8, 5.8]),
    ("hamate", [-8.0, 15.0, 0.5], [5.0, 5.2, 5.6]),
];

const FINGERS: [&str; FINGER_COUNT] = ["thumb", "index", "middle", "ring", "pinky"];

/// Profile of a long bone of the hand, for a bone of half width 1 at its head: share of the length,
/// half width, half height, and rise of the shaft's arch towards the back.
const PROFILE: [(f64, f64, f64, f64); 6] = [
    (0.02, 1.08, 1.0, 0.0),
    (0.16, 0.98, 0.88, 0.05),
    (0.42, 0.66, 0.66, 0.16),
    (0.68, 0.66, 0.64, 0.14),
    (0.88, 0.92, 0.88, 0.04),
    (0.98, 0.90, 0.92, 0.0),
];

/// Builds a long bone between two points; `half` is the half width and height at its head.
fn long_bone(from: DVec3, to: DVec3, dorsal: DVec3, half: (f64, f64), gap: f64) -> Solid {
    let along = (to - from).try_normalize().unwrap_or(DVec3::Y);
    let (from, to) = (from + along * gap, to - along * gap);
    let side = along.cross(dorsal).try_normalize().unwrap_or(DVec3::X);
    let up = side.cross(along);
    let sections: Vec<_> = PROFILE
        .iter()
        .map(|&(t, w, h, arch)| {
            let p = from.lerp(to, t) + up * arch * half.1;
            (p, side * w * half.0, up * h * half.1)
        })
        .collect();
    Solid::tube(&sections, 8)
}

/// Builds phalanx `k` of a finger, mm; `tip_mm` is the soft tissue beyond the last bone (Buryanov
/// and Kotiuk 2010, table I: 5.67 mm thumb, 3.7 to 4.0 mm fingers).
fn phalanx(finger: &Finger, k: usize, tip_mm: f64) -> Solid {
    let joints = finger.joints();
    let (from, mut to) = (joints[k], joints[k + 1]);
    if k == 2 {
        to -= tip_mm;
    }
    let section = finger.section(f64::midpoint(from, to));
    let middle = finger.section(to);
    let w = 0.56 * section.half_width.min(middle.half_width.max(6.0));
    let h = 0.50 * section.dorsal.min(section.palmar);
    // The last bone is flat and lies under the nail.
    let (w, h, drop) = if k == 2 {
        (w * 0.86, h * 0.72, 0.6)
    } else {
        (w, h, 0.0)
    };
    let point = |y: f64, z: f64| finger.point(DVec3::new(0.0, y, z));
    long_bone(
        point(from, 0.0),
        point(to, drop),
        -finger.frame.z_axis,
        (w, h),
        h * 0.45 + 0.4,
    )
}

/// Builds the 27 bones of a hand.
#[must_use]
pub fn bones(params: &HandParams, side: Side) -> Vec<HandBone> {
    let anatomy = Anatomy::new(HandBuild::from_sex_and_age(params.sex, params.age_years));
    let field = super::field::Field::new(&anatomy);
    let cage = super::cage::build(&anatomy, &field);
    let place = Placement::new(params, side, &surface::build(&anatomy, &field, &cage));
    let letter = if side == Side::Left { "l" } else { "r" };
    let mut out = Vec::with_capacity(27);
    let mut add = |name: String, joint: Influence, solid: Solid| {
        out.push(HandBone {
            name: format!("{letter}_{name}"),
            joint: joint.joint(side),
            solid: solid.mapped(|p| place.position(p)),
        });
    };
    for (name, centre, half) in CARPALS {
        let axes = DMat3::from_diagonal(DVec3::from_array(half));
        add(
            name.to_owned(),
            Influence::Hand,
            Solid::blob(DVec3::from_array(centre), axes, 8),
        );
    }
    for (f, finger) in anatomy.fingers.iter().enumerate() {
        let name = FINGERS[f];
        let bases = if f == 0 {
            // The thumb's first segment is its metacarpal.
            let tip = [6.0, 6.0, 5.67];
            let bone = |k: usize| phalanx(finger, k, tip[k]);
            add(
                format!("{name}_metacarpal"),
                Influence::Finger(f, 0),
                bone(0),
            );
            add(format!("{name}_proximal"), Influence::Finger(f, 1), bone(1));
            add(format!("{name}_distal"), Influence::Finger(f, 2), bone(2));
            continue;
        } else {
            anatomy.metacarpal_base[f - 1]
        };
        let head = 6.3 * finger.girth;
        add(
            format!("{name}_metacarpal"),
            Influence::Hand,
            long_bone(
                bases,
                finger.origin + DVec3::new(0.0, 0.0, -0.6),
                DVec3::NEG_Z,
                (head, head * 0.92),
                head * 0.45,
            ),
        );
        for (k, bone) in ["proximal", "middle", "distal"].into_iter().enumerate() {
            add(
                format!("{name}_{bone}"),
                Influence::Finger(f, k),
                phalanx(finger, k, 3.9),
            );
        }
    }
    out
}
