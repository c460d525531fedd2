//! Body shape of a person: measures, joints, rest pose.
//!
//! Heights as shares of stature: designed from common anthropometric knowledge, checked against the
//! surveys cited by the tests of [`super`]. The thesis's own table has the hips at 0.577 of
//! stature, anatomy at 0.52.

use raconteur_base::curve::{lerp, ramp, smooth};
use raconteur_base::{DQuat, DVec3, Side, mirror_vector, ops};

use raconteur_body::skeleton::{Bone, zero_frames};

/// Centimetres to metres: the section tables are in centimetres.
pub const CM: f64 = 0.01;

/// Angle of the arms below the horizontal in the rest pose, radians (48°): half way between hanging
/// and raised, so that both stretch the shoulder least.
pub const ARMS_DOWN_RAD: f64 = 48.0 * core::f64::consts::PI / 180.0;

/// Measures of a body, from which its distance field and its joints are derived.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyParams {
    /// 0 male to 1 female proportions.
    pub sex: f64,
    /// Years, 8 to 80.
    pub age_years: f64,
    /// Standing height, metres.
    pub stature_m: f64,
    /// −1 lean to +1 heavy; 10 % of all radii a unit.
    pub build: f64,
    /// Size of the bust, 1 = average. Women only.
    pub bust: f64,
}

impl BodyParams {
    /// Returns the stature relative to the 175 cm for which most tables are given.
    pub(super) fn scale(&self) -> f64 {
        self.stature_m / 1.75
    }

    /// Returns 1 for the proportions of a child of nine to 0 for an adult's: growth of the limbs
    /// and of the shoulders ends at about 17.
    #[must_use]
    pub fn child(&self) -> f64 {
        1.0 - smooth(ramp(9.0, 17.0, self.age_years))
    }

    /// Returns the effect of age on posture and volume: 0 up to fifty, 1 at eighty-five.
    #[must_use]
    pub fn old(&self) -> f64 {
        smooth(ramp(48.0, 86.0, self.age_years))
    }

    /// Returns the forward shift of the body by the spine's curve at a height, metres: with age the
    /// upper back rounds and the head moves in front of the trunk. Designed; thoracic kyphosis
    /// grows from about 25° at thirty to 43° at seventy-five (Fon et al. 1980,
    /// doi:10.2214/ajr.134.5.979).
    #[must_use]
    pub fn stoop_m(&self, y_m: f64) -> f64 {
        let h = y_m / self.stature_m;
        let bell = |c: f64, w: f64| ops::exp(-((h - c) / w) * ((h - c) / w));
        let head = 3.4 * smooth((h - 0.775) / 0.13);
        self.old() * self.scale() * CM * (head - 1.7 * bell(0.745, 0.06))
    }
}

/// Positions and orientations of the bones of a body in the rest pose.
#[derive(Clone, Debug)]
pub struct Joints {
    /// Origins in the world.
    pub positions: [DVec3; Bone::COUNT],
    /// Rotations of the bones, world from bone.
    pub rotations: [DQuat; Bone::COUNT],
}

impl Joints {
    /// Returns the position of the origin of a bone, world, metres.
    #[must_use]
    pub fn position_of(&self, bone: Bone) -> DVec3 {
        self.positions[bone.index()]
    }

    /// Returns the unit direction along the left arm, away from the trunk.
    #[must_use]
    pub fn arm_axis() -> DVec3 {
        DVec3::new(ops::cos(ARMS_DOWN_RAD), -ops::sin(ARMS_DOWN_RAD), 0.0)
    }

    /// Returns the unit direction across the left arm, upwards.
    #[must_use]
    pub fn arm_up() -> DVec3 {
        DVec3::new(ops::sin(ARMS_DOWN_RAD), ops::cos(ARMS_DOWN_RAD), 0.0)
    }

    /// Joints by shares of stature; fingers as in the thesis's example, scaled.
    #[must_use]
    pub fn place(p: &BodyParams) -> Self {
        let s = p.stature_m;
        let child = p.child();
        let by_age = |adult: f64, boy: f64| lerp(adult, boy, child) * s;
        let hip_x = by_age(lerp(0.0505, 0.0525, p.sex), 0.044);
        let shoulder_x = by_age(lerp(0.102, 0.092, p.sex), 0.090);
        let mut at = [DVec3::ZERO; Bone::COUNT];
        let mut put = |bone: Bone, q: DVec3| {
            at[bone.index()] = q;
            if bone.side().is_some() {
                at[bone.mirrored().index()] = mirror_vector(q);
            }
        };
        // Depths are those of a body of 175 cm.
        let k = p.scale();
        let v = |x: f64, y: f64, z_cm: f64| DVec3::new(x, y, z_cm * k * CM + p.stoop_m(y));
        put(Bone::Sacroiliac, v(0.0, by_age(0.545, 0.525), -2.0));
        put(Bone::Lumbar, v(0.0, by_age(0.60, 0.58), -2.5));
        put(Bone::Thoracic, v(0.0, by_age(0.70, 0.68), -3.5));
        put(Bone::Cervical, v(0.0, by_age(0.825, 0.812), -4.0));
        put(Bone::Skull, v(0.0, by_age(0.888, 0.865), -1.0));
        put(Bone::Chin, v(0.0, by_age(0.913, 0.895), 0.5));
        let foot = |x: f64, y: f64, z_cm: f64| DVec3::new(x, y, z_cm * k * CM);
        put(Bone::LHip, foot(hip_x, by_age(0.522, 0.505), 0.0));
        put(Bone::LKnee, foot(hip_x * 0.98, by_age(0.282, 0.272), 0.5));
        put(
            Bone::LSubtalar,
            foot(hip_x * 0.95, by_age(0.046, 0.048), -2.5),
        );
        put(Bone::LMidtarsal, foot(hip_x, 0.030 * s, 4.0));
        put(Bone::LMetatarsal, foot(hip_x * 1.08, 0.014 * s, 11.0));
        put(Bone::LScapula, v(0.018 * s, by_age(0.815, 0.80), -2.0));
        // Old shoulders hang.
        let shoulder_y = by_age(0.794, 0.778) - 0.006 * p.old() * s;
        let shoulder = v(shoulder_x, shoulder_y, -2.0);
        let elbow = shoulder + Self::arm_axis() * by_age(lerp(0.171, 0.168, p.sex), 0.164);
        let wrist = elbow + Self::arm_axis() * by_age(lerp(0.1505, 0.1445, p.sex), 0.145);
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

/// Returns the world rotations of the bones in the rest pose: zero frames, with the arms turned
/// down about the world's z axis.
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
