//! Joint angles of animation files: anatomical names, in degrees, relative to standing with hanging
//! arms.
//!
//! The zero pose of the skeleton stretches the arms out sideways, but authors think of hanging
//! arms. Only this file converts between the two.

use raconteur_base::{DQuat, DVec3, Length, Side};
use raconteur_body::Bone;
use raconteur_body::skeleton::zero_frames;

use core::f64::consts::FRAC_PI_2;

/// Kind of joint that a name denotes: its angles and their rotation axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum JointKind {
    /// `flexion` forwards, `side` to the left, `turn` to the left.
    Axial,
    /// `raise`, `front`: the shoulder blade.
    Girdle,
    /// `flexion` to the front and `abduction` to the side, both parts of one turn from
    /// hanging; `twist` outwards about itself.
    UpperArm,
    /// `flexion`.
    Elbow,
    /// `flexion` to the palm, `deviation` to the little finger, `supination` from thumb in
    /// front of the hanging hand to palm in front.
    Wrist,
    /// `flexion` forwards, `abduction` outwards, `twist` outwards.
    Hip,
    /// `flexion`.
    Knee,
    /// `flexion` of the toes downwards.
    Ankle,
}

/// Joint of the clip format: its name, its bone and the meaning of its angles. Names of paired
/// joints are written `left_NAME`, `right_NAME`, or `NAMEs` for both sides.
pub(super) struct Joint {
    /// Without its side.
    pub(super) name: &'static str,
    /// The bone; of those with a side, the left one.
    pub(super) bone: Bone,
    kind: JointKind,
}

const fn joint(name: &'static str, bone: Bone, kind: JointKind) -> Joint {
    Joint { name, bone, kind }
}

/// Joints that a clip may animate by anatomical angles.
pub(super) const JOINTS: [Joint; 12] = [
    joint("pelvis", Bone::Sacroiliac, JointKind::Axial),
    joint("waist", Bone::Lumbar, JointKind::Axial),
    joint("chest", Bone::Thoracic, JointKind::Axial),
    joint("neck", Bone::Cervical, JointKind::Axial),
    joint("head", Bone::Skull, JointKind::Axial),
    joint("shoulder", Bone::LScapula, JointKind::Girdle),
    joint("upper_arm", Bone::LShoulder, JointKind::UpperArm),
    joint("elbow", Bone::LElbow, JointKind::Elbow),
    joint("wrist", Bone::LWrist, JointKind::Wrist),
    joint("hip", Bone::LHip, JointKind::Hip),
    joint("knee", Bone::LKnee, JointKind::Knee),
    joint("ankle", Bone::LSubtalar, JointKind::Ankle),
];

impl Joint {
    /// Returns the names of the angles, in the order that [`Joint::rotation`] takes them.
    #[must_use]
    pub(super) fn angles(&self) -> &'static [&'static str] {
        match self.kind {
            JointKind::Axial => &["flexion", "side", "turn"],
            JointKind::Girdle => &["raise", "front"],
            JointKind::UpperArm | JointKind::Hip => &["flexion", "abduction", "twist"],
            JointKind::Wrist => &["flexion", "deviation", "supination"],
            JointKind::Elbow | JointKind::Knee | JointKind::Ankle => &["flexion"],
        }
    }

    /// Returns the rotation of the left (or middle) bone for joint angles in degrees, local and
    /// relative to the zero pose.
    #[must_use]
    pub(super) fn rotation(&self, angles_deg: [f64; 3]) -> DQuat {
        let [a, b, c] = angles_deg.map(f64::to_radians);
        let zero = zero_frames()[self.bone.index()];
        let (x, y, z) = (
            DQuat::from_rotation_x as fn(f64) -> DQuat,
            DQuat::from_rotation_y as fn(f64) -> DQuat,
            DQuat::from_rotation_z as fn(f64) -> DQuat,
        );
        // Each in the world's axes of the zero pose: x to the left, y up, z to the front.
        let in_world = match self.kind {
            // The turn is applied last, so that a turned head nods along its own line of sight.
            JointKind::Axial => y(c) * z(-b) * x(a),
            JointKind::Girdle => y(-b) * z(a),
            JointKind::UpperArm => {
                let down = z(-FRAC_PI_2);
                DQuat::from_scaled_axis(DVec3::new(-a, 0.0, b)) * y(c) * down
            }
            // In the zero pose, the forearm lies along x with the thumb in front.
            JointKind::Elbow => y(-a),
            // The forearm turns the hand, which then bends towards its own palm.
            JointKind::Wrist => x(-c) * y(b) * z(-a),
            JointKind::Hip => x(-a) * z(b) * y(c),
            JointKind::Knee | JointKind::Ankle => x(a),
        };
        (zero.inverse() * in_world * zero).normalized()
    }
}

/// Finds a joint by its name in the clip format, with the sides meant; no sides for a joint on the
/// midline.
#[must_use]
pub(super) fn find(name: &str) -> Option<(&'static Joint, Option<&'static [Side]>)> {
    let (bare, sides) = sides_of(name);
    JOINTS.iter().find_map(|j| {
        let has_side = j.bone.side().is_some();
        (j.name == bare && has_side == sides.is_some()).then_some((j, sides))
    })
}

/// Splits the name of a joint or track into the bare name and the sides that it addresses; `None`
/// if it has no side.
#[must_use]
pub(super) fn sides_of(name: &str) -> (&str, Option<&'static [Side]>) {
    if let Some(bare) = name.strip_prefix("left_") {
        (bare, Some(&[Side::Left]))
    } else if let Some(bare) = name.strip_prefix("right_") {
        (bare, Some(&[Side::Right]))
    } else if name == "feet" {
        ("foot", Some(&Side::BOTH))
    } else if name == "reaches" {
        ("reach", Some(&Side::BOTH))
    } else if name != "pelvis"
        && let Some(bare) = name.strip_suffix('s')
    {
        (bare, Some(&Side::BOTH))
    } else {
        (name, None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::{rotation_of, world_from_bone};
    use raconteur_body::{Pose, Skeleton};

    fn mirrored(local: DQuat) -> DQuat {
        DQuat::from_xyzw(-local.x, -local.y, local.z, local.w)
    }

    fn posed(list: &[(&str, [f64; 3])]) -> Pose {
        let mut pose = Pose::zero();
        for (name, angles) in list {
            let (joint, sides) = find(name).unwrap_or_else(|| panic!("{name}"));
            let q = joint.rotation(*angles);
            for side in sides.unwrap_or(&[Side::Left]) {
                match side {
                    Side::Left => pose.set(joint.bone, q),
                    Side::Right => pose.set(joint.bone.mirrored(), mirrored(q)),
                }
            }
        }
        pose
    }

    /// Returns the unit vector from one bone's joint to another's in a pose, world.
    fn line(pose: &Pose, from: Bone, to: Bone) -> DVec3 {
        let skeleton = Skeleton::example();
        let at = |b| world_from_bone(&skeleton, pose, b).translation;
        (at(to) - at(from)).normalize()
    }

    #[test]
    fn arms_hang_rise_and_bend_as_written() {
        use Bone::{LElbow, LShoulder, LWrist, RElbow, RShoulder, RWrist};
        let hang = posed(&[("upper_arms", [0.0, 0.0, 0.0])]);
        assert!(
            line(&hang, LShoulder, LElbow).y < -0.99,
            "the hanging left upper arm points down"
        );
        assert!(
            line(&hang, RShoulder, RElbow).y < -0.99,
            "the hanging right upper arm points down"
        );
        let front = posed(&[("upper_arms", [90.0, 0.0, 0.0])]);
        assert!(
            line(&front, RShoulder, RElbow).z > 0.99,
            "the raised right upper arm points forwards"
        );
        let side = posed(&[("left_upper_arm", [0.0, 90.0, 0.0])]);
        assert!(
            side.rotation(LShoulder).angle_between(DQuat::IDENTITY) < 1e-9,
            "the left arm raised sideways is the zero pose"
        );
        // A bent elbow points the forearm forwards when the arm hangs and upwards when the arm is
        // raised forwards; outward twist moves the forearm outwards.
        for (arm, want) in [
            ([0.0, 0.0, 0.0], DVec3::Z),
            ([90.0, 0.0, 0.0], DVec3::Y),
            ([0.0, 90.0, 0.0], DVec3::Z),
            ([0.0, 0.0, 90.0], DVec3::X),
            ([0.0, 90.0, 90.0], DVec3::Y),
        ] {
            let pose = posed(&[("left_upper_arm", arm), ("left_elbow", [90.0, 0.0, 0.0])]);
            let d = line(&pose, LElbow, LWrist);
            assert!(d.dot(want) > 0.98, "{arm:?}: {d}");
        }
        let both = posed(&[
            ("upper_arms", [30.0, 40.0, 20.0]),
            ("elbows", [70.0, 0.0, 0.0]),
        ]);
        let (l, r) = (line(&both, LElbow, LWrist), line(&both, RElbow, RWrist));
        assert!(
            (raconteur_base::mirror_vector(l) - r).length() < 1e-9,
            "the left and right arm mirror each other"
        );
    }

    #[test]
    fn hands_trunk_and_legs_turn_as_written() {
        use Bone::{LHip, LIndex0, LKnee, LSubtalar, LWrist, Lumbar, Skull, Thoracic};
        let palm = |pose: &Pose| {
            let skeleton = Skeleton::example();
            let zero = world_from_bone(&skeleton, &Pose::zero(), LWrist);
            let now = world_from_bone(&skeleton, pose, LWrist);
            rotation_of(&now) * rotation_of(&zero).inverse() * DVec3::NEG_Y
        };
        let hang = ("left_upper_arm", [0.0, 0.0, 0.0]);
        // The left palm hangs facing right; supinated it faces the front.
        assert!(
            palm(&posed(&[hang])).x < -0.98,
            "the palm of the hanging hand faces the body"
        );
        assert!(
            palm(&posed(&[hang, ("left_wrist", [0.0, 0.0, 90.0])])).z > 0.98,
            "a wrist turned by 90 degrees faces the palm forwards"
        );
        // Flexion carries the fingers to the palm's side, deviation to the little finger's.
        let flexed = posed(&[hang, ("left_wrist", [60.0, 0.0, 0.0])]);
        assert!(
            line(&flexed, LWrist, LIndex0).x < -0.6,
            "the flexed wrist turns the hand inwards"
        );
        let aside = posed(&[hang, ("left_wrist", [0.0, 40.0, 0.0])]);
        let plain = line(&posed(&[hang]), LWrist, LIndex0).z;
        assert!(
            line(&aside, LWrist, LIndex0).z < plain - 0.4,
            "the wrist bent aside turns the hand backwards"
        );
        let bowed = posed(&[("waist", [40.0, 0.0, 0.0])]);
        assert!(
            line(&bowed, Lumbar, Thoracic).z > 0.6,
            "the bowed trunk leans forwards"
        );
        let leaning = posed(&[("waist", [0.0, 30.0, 0.0])]);
        assert!(
            line(&leaning, Lumbar, Thoracic).x > 0.4,
            "the trunk leans to the side"
        );
        let turned = posed(&[("head", [0.0, 0.0, 50.0])]);
        let skull = world_from_bone(&Skeleton::example(), &turned, Skull);
        // The skull's local y points to the front.
        assert!(
            (rotation_of(&skull) * DVec3::Y).x > 0.7,
            "the head tilts to the side"
        );
        let kick = posed(&[("left_hip", [90.0, 0.0, 0.0])]);
        assert!(
            line(&kick, LHip, LKnee).z > 0.98,
            "the kicked leg points forwards"
        );
        let apart = posed(&[("left_hip", [0.0, 40.0, 0.0])]);
        assert!(
            line(&apart, LHip, LKnee).x > 0.5,
            "the spread leg points outwards"
        );
        let curled = posed(&[("left_knee", [90.0, 0.0, 0.0])]);
        assert!(
            line(&curled, LKnee, LSubtalar).z < -0.95,
            "the bent knee moves the shank backwards"
        );
        let raised = posed(&[("left_shoulder", [20.0, 0.0, 0.0])]);
        let rest = line(&posed(&[]), Bone::LScapula, Bone::LShoulder).y;
        assert!(
            line(&raised, Bone::LScapula, Bone::LShoulder).y > rest + 0.2,
            "the raised shoulder blade lifts the shoulder"
        );
    }
}
