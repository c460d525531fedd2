//! Conversion from face controls to a figure's jaw, lids and morph weights.
//!
//! Morph targets are located by their ARKit names once; missing targets are skipped. Jaw, lids and
//! eyes are joints. Targets also move them in figures without these joints, such as imported
//! avatars. A figure whose skin follows the tissue uses only joints and tongue targets.

mod targets;

use raconteur_base::{DQuat, DVec3, Side, ops};
use raconteur_body::face::{FaceControls, Muscle};
use raconteur_body::skeleton::Drive;
use raconteur_body::{Bone, Figure, Pose, Skeleton};

use targets::{MorphTarget as T, NAMES, Weights};

/// Turn of the eye represented by a full gaze target, radians. ARKit gives no angle; this is the
/// eye's range in usual looking. Designed.
const LOOK_RAD: f64 = 0.5;
/// Turn of the upper lids that opens the eyes wide, radians: 1.5 mm on the globe. Designed.
const WIDE_RAD: f64 = 0.12;

/// Bones and morph targets of a figure's face, resolved once; converts face controls into a pose
/// each frame.
#[derive(Clone, Debug)]
pub struct FaceRig {
    /// The morph targets that are the left half, the right half and the whole of each target.
    slots: [[Option<u16>; 3]; T::COUNT],
    /// Upper-lid rotation that closes the eye, left and right, radians.
    lid_closure_rad: [f64; 2],
    /// Eyeball centres in the skull bone's frame, metres.
    eyes_in_skull: [DVec3; 2],
}

impl FaceRig {
    /// Finds the bones and morph targets of a figure's face.
    #[must_use]
    pub fn new(figure: &Figure) -> Self {
        let mut rig = Self::from_parts(
            &figure.skeleton,
            &figure.morph_names,
            figure.lid_closure_rad,
        );
        // A motion done by a joint must not be done again by a target.
        let carries = |wanted: fn(Drive) -> bool| {
            let joints = figure.skeleton.joints();
            figure.meshes.iter().any(|mesh| {
                mesh.joints.iter().zip(&mesh.weights).any(|(j, w)| {
                    j.iter().zip(w).any(|(j, w)| {
                        *w > 0.0 && joints.get(usize::from(*j)).is_some_and(|j| wanted(j.drive))
                    })
                })
            })
        };
        if carries(|d| d == Drive::Bone(Bone::Chin)) {
            rig.forget(&T::OF_JAW);
        }
        if carries(|d| matches!(d, Drive::UpperLid(_))) {
            rig.forget(&T::OF_LIDS);
        }
        if carries(|d| matches!(d, Drive::Eye(_))) {
            rig.forget(&T::OF_EYES);
        }
        if figure.tissue.is_some() {
            rig = rig.without_skin();
        }
        rig
    }

    /// Creates the rig from skeleton, names of morph targets and lid closure angles (left, right;
    /// radians).
    #[must_use]
    pub fn from_parts(
        skeleton: &Skeleton,
        morph_names: &[String],
        lid_closure_rad: [f64; 2],
    ) -> Self {
        let eyes_in_skull = Side::BOTH.map(|side| {
            let joint = skeleton
                .joints()
                .iter()
                .find(|j| j.drive == Drive::Eye(side));
            joint.map_or(DVec3::ZERO, |j| j.translation_in_parent)
        });
        let slots = NAMES.map(|name| {
            ["Left", "Right", ""].map(|half| {
                let is_it = |n: &String| n.strip_prefix(name) == Some(half);
                u16::try_from(morph_names.iter().position(is_it)?).ok()
            })
        });
        Self {
            slots,
            lid_closure_rad,
            eyes_in_skull,
        }
    }

    /// Returns the rig of a figure whose skin follows the tissue simulation: it moves jaw, lids,
    /// eyes and tongue, and leaves all morph targets that move skin unchanged.
    #[must_use]
    fn without_skin(mut self) -> Self {
        for (target, slots) in self.slots.iter_mut().enumerate() {
            if !T::OF_TONGUE.iter().any(|t| *t as usize == target) {
                *slots = [None; 3];
            }
        }
        self
    }

    fn forget(&mut self, targets: &[T]) {
        for target in targets {
            self.slots[*target as usize] = [None; 3];
        }
    }

    /// Returns the eyeball centres in the skull bone's frame, left and right, metres.
    #[must_use]
    pub fn eyes_in_skull(&self) -> [DVec3; 2] {
        self.eyes_in_skull
    }

    /// Sets jaw, lids and morph weights. Limits `controls` to their ranges; `eye_pitch_rad` is the
    /// eyes' downward pitch, which the lids follow, left and right; `pose` already contains the
    /// eyes. Weights, 0 to 1, of targets that the actor does not use stay unchanged; slots beyond
    /// `weights` are ignored.
    pub fn write(
        &self,
        controls: &FaceControls,
        eye_pitch_rad: [f64; 2],
        pose: &mut Pose,
        weights: &mut [f32],
    ) {
        let mut controls = *controls;
        controls.limit();
        let jaw = controls.jaw;
        // In the skull's frame, x is up, y front and z left: positive turns move the chin to the
        // figure's left and down.
        pose.set(
            Bone::Chin,
            DQuat::from_rotation_x(jaw.yaw_rad) * DQuat::from_rotation_z(jaw.pitch_rad),
        );
        pose.jaw_offset_in_skull = DVec3::new(-jaw.down_m, jaw.forward_m, 0.0);
        self.write_lids(&controls, eye_pitch_rad, pose);
        let mut targets = targets::of_controls(&controls);
        turn_eyes(&controls, pose, &mut targets);
        for (slots, [left, right]) in self.slots.iter().zip(targets) {
            let values = [left, right, 0.5 * (left + right)];
            for (slot, value) in slots.iter().zip(values) {
                if let Some(weight) = slot.and_then(|slot| weights.get_mut(usize::from(slot))) {
                    *weight = value.clamp(0.0, 1.0) as f32;
                }
            }
        }
    }

    fn write_lids(&self, controls: &FaceControls, pitch: [f64; 2], pose: &mut Pose) {
        let contraction = |left: Muscle, side: usize| controls.contraction[left.index() + side];
        for (i, pitch) in pitch.into_iter().enumerate() {
            let squint = contraction(Muscle::OrbicularisOculiLeft, i);
            let raised = contraction(Muscle::FrontalisMedialLeft, i);
            let [closed, wide] = [1.0, -1.0].map(|sign| (sign * controls.upper_lid[i]).max(0.0));
            // The upper lid follows the gaze by about three quarters (Evinger et al. 1991), the
            // lower by a third; raised brows raise the lid slightly.
            let follow = (0.72 * pitch).clamp(-0.12, 0.6 * self.lid_closure_rad[i]);
            let open = follow + 0.06 * squint - 0.05 * raised - WIDE_RAD * wide;
            pose.upper_lid_rad[i] = open + (self.lid_closure_rad[i] - open) * closed;
            pose.lower_lid_rad[i] = (-0.3 * pitch).clamp(-0.1, 0.05) * (1.0 - closed)
                + 0.05 * (squint + controls.lower_lid[i]).min(1.0);
        }
    }
}

/// Lids and gaze of a figure whose eyes have no joints.
fn turn_eyes(controls: &FaceControls, pose: &Pose, targets: &mut Weights) {
    for side in Side::BOTH {
        let i = side.index();
        let ahead = pose.eyes[i] * DVec3::Z;
        let falls = -ops::asin_clamped(ahead.y) / LOOK_RAD;
        let outwards = side.sign() * ops::atan2(ahead.x, ahead.z) / LOOK_RAD;
        // Lids follow a falling gaze, as those of joints do.
        let follow = (0.35 * falls).clamp(0.0, 0.35);
        let closed = controls.upper_lid[i].max(0.0);
        for (target, value) in [
            (T::Blink, follow + (1.0 - follow) * closed),
            (T::Wide, -controls.upper_lid[i]),
            (T::LookUp, -falls),
            (T::LookDown, falls),
            (T::LookIn, -outwards),
            (T::LookOut, outwards),
        ] {
            targets[target as usize][i] = value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_body::face::Jaw;
    use raconteur_body::figure::{JAW_OPEN_RAD, MOUTH_CLOSE_RAD};

    fn rig(names: &[&str]) -> FaceRig {
        let names: Vec<String> = names.iter().map(|n| (*n).to_owned()).collect();
        FaceRig::from_parts(&Skeleton::example(), &names, [0.8, 0.7])
    }

    fn with_jaw(pitch_rad: f64) -> FaceControls {
        FaceControls {
            jaw: Jaw {
                pitch_rad,
                ..Jaw::default()
            },
            ..FaceControls::default()
        }
    }

    #[test]
    fn closed_lips_over_an_open_jaw_use_the_figures_contract() {
        let (mut pose, mut w) = (Pose::zero(), [0.0; 2]);
        let sealed = FaceControls {
            seal: 1.0,
            ..with_jaw(0.12)
        };
        rig(&["other", "mouthClose"]).write(&sealed, [0.0; 2], &mut pose, &mut w);
        let angle = pose.rotation(Bone::Chin).to_scaled_axis().z;
        assert!(
            (angle - 0.12).abs() < 1e-12,
            "the jaw angle for closed lips"
        );
        assert!(
            (f64::from(w[1]) - angle / MOUTH_CLOSE_RAD).abs() < 1e-6 && w[0] == 0.0,
            "mouthClose replaces the jaw by its share of the angle"
        );
    }

    #[test]
    fn targets_stand_in_for_joints() {
        let names = [
            "jawOpen",
            "eyeBlinkLeft",
            "eyeLookDownRight",
            "eyeLookOutLeft",
            "jawLeft",
            "jawRight",
            "jawForward",
            "eyeWideLeft",
        ];
        let (mut pose, mut w) = (Pose::zero(), [0.0; 8]);
        pose.eyes = [DQuat::from_rotation_y(0.25) * DQuat::from_rotation_x(0.25); 2];
        let mut controls = with_jaw(0.2);
        (controls.jaw.yaw_rad, controls.jaw.forward_m) = (-0.05, 0.004);
        rig(&names).write(&controls, [0.25; 2], &mut pose, &mut w);
        assert!(
            (f64::from(w[0]) - 0.2 / JAW_OPEN_RAD).abs() < 1e-6,
            "jawOpen replaces the jaw by its share of the angle"
        );
        assert!(w[1] > 0.1 && w[1] < 0.3, "the lid follows: {}", w[1]);
        assert!(
            (w[2] - 0.5).abs() < 0.03 && (w[3] - 0.5).abs() < 0.03,
            "{w:?}"
        );
        assert!(
            (w[5] - 0.5).abs() < 1e-6 && (w[6] - 0.5).abs() < 1e-6,
            "{w:?}"
        );
        assert_eq!((w[4], w[7]), (0.0, 0.0));
        let mut shut = FaceControls::default();
        shut.close_lids(1.0);
        rig(&names).write(&shut, [0.25; 2], &mut pose, &mut w);
        assert_eq!((w[0], w[1], w[7]), (0.0, 1.0, 0.0));
        let wide = FaceControls {
            upper_lid: [-1.0; 2],
            ..shut
        };
        rig(&names).write(&wide, [0.0; 2], &mut pose, &mut w);
        assert!(w[1] < 0.3 && w[7] == 1.0, "{w:?}");
    }

    #[test]
    fn the_jaw_drops_turns_and_slides_the_chin() {
        let skeleton = Skeleton::example();
        let chin = |jaw: Jaw| {
            let mut pose = Pose::zero();
            let controls = FaceControls {
                jaw,
                ..FaceControls::default()
            };
            rig(&[]).write(&controls, [0.0; 2], &mut pose, &mut []);
            // In front of the joint, left, up, front.
            crate::kinematics::world_from_bone(&skeleton, &pose, Bone::Chin)
                .transform_point3(DVec3::Y * 0.1)
        };
        let rest = chin(Jaw::default());
        let jaw = Jaw::default;
        assert!(
            chin(Jaw {
                pitch_rad: 0.2,
                ..jaw()
            })
            .y < rest.y - 0.01,
            "the pitched jaw lowers the chin"
        );
        assert!(
            chin(Jaw {
                yaw_rad: 0.1,
                ..jaw()
            })
            .x > rest.x + 0.009,
            "the yawed jaw moves the chin sideways"
        );
        let slid = chin(Jaw {
            forward_m: 0.002,
            down_m: 0.003,
            ..jaw()
        }) - rest;
        assert!(
            slid.distance(DVec3::new(0.0, -0.003, 0.002)) < 1e-12,
            "{slid}"
        );
    }

    #[test]
    fn a_blink_closes_both_lids_by_the_figures_angle_wherever_the_eyes_look() {
        for pitch in [-0.3, 0.0, 0.4] {
            for lid in [-1.0, 0.0, 0.6] {
                let mut controls = FaceControls {
                    contraction: [0.7; raconteur_body::face::MUSCLES],
                    upper_lid: [lid; 2],
                    ..FaceControls::default()
                };
                controls.close_lids(1.0);
                let mut pose = Pose::zero();
                rig(&[]).write(&controls, [pitch; 2], &mut pose, &mut []);
                assert_eq!(pose.upper_lid_rad, [0.8, 0.7]);
            }
        }
    }

    #[test]
    fn tissue_leaves_only_the_tongue_to_targets() {
        let controls = FaceControls {
            contraction: [1.0; raconteur_body::face::MUSCLES],
            seal: 0.5,
            tongue_tip: 0.5,
            upper_lid: [1.0; 2],
            ..with_jaw(0.2)
        };
        let names = ["mouthClose", "tongueUp", "mouthSmileLeft", "browInnerUp"];
        let (mut pose, mut w) = (Pose::zero(), [0.25; 4]);
        let rig = rig(&names).without_skin();
        rig.write(&controls, [0.0; 2], &mut pose, &mut w);
        assert_eq!(w, [0.25, 0.5, 0.25, 0.25]);
        assert_eq!(pose.upper_lid_rad, [0.8, 0.7]);
        assert!(
            pose.rotation(Bone::Chin).to_scaled_axis().z > 0.19,
            "the jaw joint opens when the skin follows the tissue"
        );
    }

    #[test]
    fn one_target_for_both_sides_takes_their_mean() {
        let mut controls = FaceControls::default();
        controls.contraction[Muscle::FrontalisMedialLeft.index()] = 0.5;
        controls.contraction[Muscle::LevatorLabiiRight.index()] = 1.0;
        let (mut pose, mut w) = (Pose::zero(), [0.0; 4]);
        let names = [
            "browInnerUp",
            "mouthUpperUp",
            "mouthUpperUpRight",
            "mouthUpperUpLeft",
        ];
        rig(&names).write(&controls, [0.0; 2], &mut pose, &mut w);
        assert_eq!((w[0], w[3]), (0.25, 0.0));
        assert!(
            (w[1] - 0.35).abs() < 1e-6 && (w[2] - 0.7).abs() < 1e-6,
            "one target for both sides takes the mean"
        );
    }
}
