//! Who the body is of: measures, joints, rest pose.
//!
//! Heights as shares of stature and breadths are common anthropometric knowledge (not
//! survey rows); the thesis's own table has the hips at 0.577 of stature, anatomy at 0.52.

use raconteur_base::curve::lerp;
use raconteur_base::{DQuat, DVec3, Side, mirror_vector, ops};

use crate::skeleton::{Bone, zero_frames};

/// Centimetres to metres: the section tables are in centimetres.
pub const CM: f64 = 0.01;

/// Angle of the arms below the horizontal in the rest pose, radians (48°): half way
/// between hanging and raised, so that both stretch the shoulder least.
pub const ARMS_DOWN_RAD: f64 = 48.0 * core::f64::consts::PI / 180.0;

/// Measures of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyParams {
    /// 0 male to 1 female proportions.
    pub sex: f64,
    /// Standing height, metres.
    pub stature_m: f64,
    /// −1 lean to +1 heavy; 10 % of all radii a unit.
    pub build: f64,
    /// Size of the bust, 1 = average.
    pub bust: f64,
}

impl BodyParams {
    /// Stature against the 175 cm of most tables.
    pub(super) fn scale(&self) -> f64 {
        self.stature_m / 1.75
    }
}

/// Places and orientations of the bones in the rest pose.
#[derive(Clone, Debug)]
pub struct Joints {
    /// Origins in the world.
    pub positions: [DVec3; Bone::COUNT],
    /// World from bone.
    pub rotations: [DQuat; Bone::COUNT],
}

impl Joints {
    /// Origin of a bone.
    #[must_use]
    pub fn at(&self, bone: Bone) -> DVec3 {
        self.positions[bone.index()]
    }

    /// Along the left arm, away from the trunk.
    #[must_use]
    pub fn arm_axis() -> DVec3 {
        DVec3::new(ops::cos(ARMS_DOWN_RAD), -ops::sin(ARMS_DOWN_RAD), 0.0)
    }

    /// Across the left arm, upwards.
    #[must_use]
    pub fn arm_up() -> DVec3 {
        DVec3::new(ops::sin(ARMS_DOWN_RAD), ops::cos(ARMS_DOWN_RAD), 0.0)
    }

    /// Joints by shares of stature; fingers as in the thesis's example, scaled.
    #[must_use]
    pub fn place(p: &BodyParams) -> Self {
        let s = p.stature_m;
        let hip_x = lerp(0.0505, 0.0525, p.sex) * s;
        let shoulder_x = lerp(0.0945, 0.0835, p.sex) * s;
        let mut at = [DVec3::ZERO; Bone::COUNT];
        let mut put = |bone: Bone, q: DVec3| {
            at[bone.index()] = q;
            if bone.side().is_some() {
                at[bone.mirrored().index()] = mirror_vector(q);
            }
        };
        let v = DVec3::new;
        put(Bone::Sacroiliac, v(0.0, 0.545 * s, -2.0 * CM));
        put(Bone::Lumbar, v(0.0, 0.60 * s, -2.5 * CM));
        put(Bone::Thoracic, v(0.0, 0.70 * s, -3.5 * CM));
        put(Bone::Cervical, v(0.0, 0.825 * s, -4.0 * CM));
        put(Bone::Skull, v(0.0, 0.888 * s, -CM));
        put(Bone::Chin, v(0.0, 0.913 * s, 0.5 * CM));
        put(Bone::LHip, v(hip_x, 0.522 * s, 0.0));
        put(Bone::LKnee, v(hip_x * 0.98, 0.282 * s, 0.5 * CM));
        put(Bone::LSubtalar, v(hip_x * 0.95, 0.046 * s, -2.5 * CM));
        put(Bone::LMidtarsal, v(hip_x, 0.030 * s, 4.0 * CM));
        put(
            Bone::LMetatarsal,
            v(hip_x * 1.08, 0.014 * s, 11.0 * CM * p.scale()),
        );
        put(Bone::LScapula, v(0.018 * s, 0.815 * s, -2.0 * CM));
        let shoulder = v(shoulder_x, 0.794 * s, -2.0 * CM);
        let elbow = shoulder + Self::arm_axis() * 0.168 * s;
        let wrist = elbow + Self::arm_axis() * 0.143 * s;
        put(Bone::LShoulder, shoulder);
        put(Bone::LElbow, elbow);
        put(Bone::LWrist, wrist);
        let down = DQuat::from_rotation_z(-ARMS_DOWN_RAD);
        let hand_scale = s / 1.956;
        for bone in Bone::ALL {
            let is_finger =
                bone.index() > Bone::LWrist.index() && bone.index() <= Bone::LThumb2.index();
            if is_finger {
                let from_wrist = bone.example_position_m() - Bone::LWrist.example_position_m();
                put(bone, wrist + down * from_wrist * hand_scale);
            }
        }
        Self {
            positions: at,
            rotations: rest_rotations(),
        }
    }
}

/// World from bone in the rest pose: zero frames, arms turned down about the world's z.
#[must_use]
pub fn rest_rotations() -> [DQuat; Bone::COUNT] {
    let zero = zero_frames();
    Bone::ALL.map(|bone| {
        let (first, last) = match bone.side() {
            Some(Side::Left) => (Bone::LShoulder.index(), Bone::LThumb2.index()),
            Some(Side::Right) => (Bone::RShoulder.index(), Bone::RThumb2.index()),
            None => return zero[bone.index()],
        };
        if !(first..=last).contains(&bone.index()) {
            return zero[bone.index()];
        }
        let sign = if bone.side() == Some(Side::Left) {
            -1.0
        } else {
            1.0
        };
        DQuat::from_rotation_z(sign * ARMS_DOWN_RAD) * zero[bone.index()]
    })
}
