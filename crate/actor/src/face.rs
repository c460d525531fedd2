//! From mouth channels, brows and lids to a figure's jaw and morph weights.
//!
//! Morph targets are found by their ARKit names once; a figure that lacks one goes
//! without. Jaw, lids and eyes are joints; a figure that has none of these, as other
//! people's avatars, moves them by targets too.

use raconteur_base::{DQuat, DVec3, Side, ops};
use raconteur_body::figure::{JAW_OPEN_RAD, MOUTH_CLOSE_RAD};
use raconteur_body::skeleton::Drive;
use raconteur_body::{Bone, Figure, Pose, Skeleton};
use raconteur_speech::phones::Channel;

use crate::lips::MouthTargets;

/// Rotation of the jaw at a channel value of 1, radians. Speech opens the mouth less than
/// it can (F&H's jaw channel is the whole range): the widest vowel turns it by 9°, as one
/// who speaks to a room does.
const JAW_RAD: f64 = 0.245;
/// Turn of the eye that the whole of a gaze target stands for, radians. ARKit gives no
/// angle; the eye's range in usual looking. Designed.
const LOOK_RAD: f64 = 0.5;
/// Lip aperture that a jaw channel of 1 opens by itself, as a lip channel.
const LIPS_OF_JAW: f64 = 0.9;

/// The morph targets that the actor uses, in the order of [`FaceRig::index`].
const NAMES: [&str; M::COUNT] = [
    "mouthClose",
    "mouthPucker",
    "mouthFunnel",
    "mouthStretchLeft",
    "mouthStretchRight",
    "mouthPressLeft",
    "mouthPressRight",
    "mouthPress",
    "mouthRollLower",
    "mouthRollUpper",
    "mouthShrugLower",
    "mouthLowerDown",
    "mouthLowerDownLeft",
    "mouthLowerDownRight",
    "mouthUpperUp",
    "mouthUpperUpLeft",
    "mouthUpperUpRight",
    "mouthSmileLeft",
    "mouthSmileRight",
    "browInnerUp",
    "browOuterUpLeft",
    "browOuterUpRight",
    "browDownLeft",
    "browDownRight",
    "eyeSquintLeft",
    "eyeSquintRight",
    "cheekSquintLeft",
    "cheekSquintRight",
    "tongueUp",
    "tongueOut",
    "jawOpen",
    "eyeBlinkLeft",
    "eyeBlinkRight",
    "eyeLookUpLeft",
    "eyeLookUpRight",
    "eyeLookDownLeft",
    "eyeLookDownRight",
    "eyeLookInLeft",
    "eyeLookInRight",
    "eyeLookOutLeft",
    "eyeLookOutRight",
];

/// Indices into [`NAMES`].
#[derive(Clone, Copy)]
#[repr(usize)]
enum M {
    Close,
    Pucker,
    Funnel,
    StretchL,
    StretchR,
    PressL,
    PressR,
    Press,
    RollLower,
    RollUpper,
    ShrugLower,
    LowerDown,
    LowerDownL,
    LowerDownR,
    UpperUp,
    UpperUpL,
    UpperUpR,
    SmileL,
    SmileR,
    BrowInner,
    BrowOuterL,
    BrowOuterR,
    BrowDownL,
    BrowDownR,
    SquintL,
    SquintR,
    CheekL,
    CheekR,
    TongueUp,
    TongueOut,
    JawOpen,
    BlinkL,
    BlinkR,
    LookUpL,
    LookUpR,
    LookDownL,
    LookDownR,
    LookInL,
    LookInR,
    LookOutL,
    LookOutR,
}

impl M {
    const COUNT: usize = Self::LookOutR as usize + 1;

    /// Targets that stand for a joint of the face: nothing of them may be written where the
    /// joint itself carries skin.
    const JAW: [Self; 1] = [Self::JawOpen];
    const LIDS: [Self; 2] = [Self::BlinkL, Self::BlinkR];
    const GAZE: [Self; 8] = [
        Self::LookUpL,
        Self::LookUpR,
        Self::LookDownL,
        Self::LookDownR,
        Self::LookInL,
        Self::LookInR,
        Self::LookOutL,
        Self::LookOutR,
    ];
}

/// What a face shows besides the mouth's speech.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Expression {
    /// Smile of the left and right corner, 0..1.
    pub smile: [f64; 2],
    /// Inner brows raised, 0..1.
    pub brow_inner: f64,
    /// Outer brows raised, left and right, 0..1.
    pub brow_outer: [f64; 2],
    /// Brows drawn down, 0..1.
    pub brow_down: f64,
    /// Eyes narrowed, 0..1.
    pub squint: f64,
}

/// Where a figure keeps its face: found once, used each frame.
#[derive(Clone, Debug)]
pub struct FaceRig {
    indices: [Option<usize>; M::COUNT],
    /// Upper-lid rotation that closes the eye, left and right, radians.
    lid_closure_rad: [f64; 2],
    /// Eyeball centres in the skull bone's frame, metres.
    eyes_in_skull: [DVec3; 2],
}

impl FaceRig {
    /// Finds the face of a figure.
    #[must_use]
    pub fn new(figure: &Figure) -> Self {
        let mut rig = Self::from_parts(
            &figure.skeleton,
            &figure.morph_names,
            figure.lid_closure_rad,
        );
        // What a joint moves must not be moved a second time.
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
        let mut forget =
            |targets: &[M]| targets.iter().for_each(|m| rig.indices[*m as usize] = None);
        if carries(|d| d == Drive::Bone(Bone::Chin)) {
            forget(&M::JAW);
        }
        if carries(|d| matches!(d, Drive::UpperLid(_))) {
            forget(&M::LIDS);
        }
        if carries(|d| matches!(d, Drive::Eye(_))) {
            forget(&M::GAZE);
        }
        rig
    }

    /// From the parts of a figure that matter.
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
        Self {
            indices: NAMES.map(|name| morph_names.iter().position(|n| n == name)),
            lid_closure_rad,
            eyes_in_skull,
        }
    }

    /// Eyeball centres in the skull bone's frame, left and right, metres.
    #[must_use]
    pub fn eyes_in_skull(&self) -> [DVec3; 2] {
        self.eyes_in_skull
    }

    /// Sets jaw, lids and morph weights. `closure` is the blink, 0..1; `eye_pitch_rad` the
    /// eyes' downward pitch, which the lids follow. Weights of targets that the actor
    /// does not use are left alone; slots beyond `weights` are ignored.
    pub fn write(
        &self,
        mouth: &MouthTargets,
        expression: &Expression,
        closure: f64,
        eye_pitch_rad: [f64; 2],
        pose: &mut Pose,
        weights: &mut [f32],
    ) {
        let jaw_rad = JAW_RAD * mouth.channel(Channel::Jaw).clamp(0.0, 1.0);
        // The jaw turns about the figure's left, which is local z; positive drops the chin.
        pose.set(Bone::Chin, DQuat::from_rotation_z(jaw_rad));
        self.write_lids(closure, eye_pitch_rad, expression, pose);
        self.write_eye_targets(closure, pose, weights);
        self.write_mouth(mouth, expression, jaw_rad, weights);
        self.write_brows(expression, weights);
    }

    fn write_lids(&self, closure: f64, pitch: [f64; 2], expression: &Expression, pose: &mut Pose) {
        for (i, pitch) in pitch.into_iter().enumerate() {
            // The upper lid follows the gaze by some three quarters (Evinger et al. 1991),
            // the lower by a third; raised brows take the lid a little up.
            let follow = (0.72 * pitch).clamp(-0.12, 0.6 * self.lid_closure_rad[i]);
            let open = follow + 0.06 * expression.squint - 0.05 * expression.brow_inner;
            pose.upper_lid_rad[i] = open + (self.lid_closure_rad[i] - open) * closure;
            pose.lower_lid_rad[i] =
                (-0.3 * pitch).clamp(-0.1, 0.05) * (1.0 - closure) + 0.05 * expression.squint;
        }
    }

    /// Lids and gaze of a figure whose eyes have no joints.
    fn write_eye_targets(&self, closure: f64, pose: &Pose, weights: &mut [f32]) {
        let eyes = [
            [M::BlinkL, M::LookUpL, M::LookDownL, M::LookInL, M::LookOutL],
            [M::BlinkR, M::LookUpR, M::LookDownR, M::LookInR, M::LookOutR],
        ];
        for (side, [blink, up, down, inwards, out]) in Side::BOTH.into_iter().zip(eyes) {
            let ahead = pose.eyes[side.index()] * DVec3::Z;
            let falls = -ops::asin_clamped(ahead.y) / LOOK_RAD;
            let outwards = side.sign() * ops::atan2(ahead.x, ahead.z) / LOOK_RAD;
            // Lids follow a falling gaze, as those of joints do.
            let follow = (0.35 * falls).clamp(0.0, 0.35);
            for (m, value) in [
                (blink, follow + (1.0 - follow) * closure),
                (up, -falls),
                (down, falls),
                (inwards, -outwards),
                (out, outwards),
            ] {
                self.set(m, value, weights);
            }
        }
    }

    fn write_mouth(
        &self,
        mouth: &MouthTargets,
        expression: &Expression,
        jaw_rad: f64,
        weights: &mut [f32],
    ) {
        let value = |c: Channel| mouth.channel(c);
        let positive = |c: Channel| value(c).max(0.0);
        let open = value(Channel::LipOpen);
        let by_jaw = LIPS_OF_JAW * value(Channel::Jaw);
        // What the jaw opens more than the lips want is closed; what it opens less the
        // lips do themselves.
        let round = positive(Channel::Protrude);
        // Rounded lips also purse: their opening is narrow and hides the teeth.
        let bare = 1.0 - 0.6 * round;
        let kept = if by_jaw > 1e-6 {
            (open * bare / by_jaw).min(1.0)
        } else {
            1.0
        };
        let extra = (open - by_jaw).max(0.0);
        let spread = positive(Channel::Spread);
        let depressed = value(Channel::DeprLabii) * (1.0 - mouth.press) * open;
        let lower = (0.55 * extra + 0.35 * depressed) * bare;
        let upper = (0.50 * extra + 0.10 * open) * bare;
        let press = 0.35 * mouth.press;

        let mut set = |m: M, v: f64| self.set(m, v, weights);
        set(M::JawOpen, jaw_rad / JAW_OPEN_RAD);
        set(M::Close, (1.0 - kept) * jaw_rad / MOUTH_CLOSE_RAD);
        set(
            M::Pucker,
            1.15 * round * (1.0 - 0.4 * open) + 0.12 * value(Channel::OoContract),
        );
        set(M::Funnel, 0.9 * round * open);
        for (m, corner) in [(M::StretchL, 0), (M::StretchR, 1)] {
            set(m, 0.45 * spread - 0.1 * expression.smile[corner]);
        }
        for m in [M::PressL, M::PressR, M::Press] {
            set(m, press);
        }
        set(M::RollLower, 0.75 * mouth.bite + 0.12 * mouth.press);
        set(M::RollUpper, 0.10 * mouth.press);
        set(
            M::ShrugLower,
            0.4 * value(Channel::Mentalis) * (1.0 - mouth.bite),
        );
        for m in [M::LowerDown, M::LowerDownL, M::LowerDownR] {
            set(m, lower * (1.0 - mouth.bite));
        }
        for m in [M::UpperUp, M::UpperUpL, M::UpperUpR] {
            set(m, upper + 0.25 * mouth.bite);
        }
        // Rounded lips cannot smile; spread ones do a little more.
        for (m, corner) in [(M::SmileL, 0), (M::SmileR, 1)] {
            set(
                m,
                expression.smile[corner] * (1.0 - 0.75 * round) + 0.12 * spread,
            );
        }
        set(M::TongueUp, value(Channel::TongueTip));
        set(M::TongueOut, value(Channel::TongueOut));
    }

    fn write_brows(&self, e: &Expression, weights: &mut [f32]) {
        let mut set = |m: M, v: f64| self.set(m, v, weights);
        set(M::BrowInner, e.brow_inner);
        set(M::BrowOuterL, e.brow_outer[0]);
        set(M::BrowOuterR, e.brow_outer[1]);
        set(M::BrowDownL, e.brow_down);
        set(M::BrowDownR, e.brow_down);
        set(M::SquintL, e.squint + 0.25 * e.smile[0]);
        set(M::SquintR, e.squint + 0.25 * e.smile[1]);
        set(M::CheekL, 0.5 * e.smile[0]);
        set(M::CheekR, 0.5 * e.smile[1]);
    }

    fn set(&self, m: M, value: f64, weights: &mut [f32]) {
        if let Some(slot) = self.indices[m as usize].and_then(|i| weights.get_mut(i)) {
            *slot = value.clamp(0.0, 1.0) as f32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_speech::phones::CHANNELS;

    fn rig(names: &[&str]) -> FaceRig {
        let names: Vec<String> = names.iter().map(|n| (*n).to_owned()).collect();
        FaceRig::from_parts(&Skeleton::example(), &names, [0.8, 0.7])
    }

    fn mouth(set: &[(Channel, f64)]) -> MouthTargets {
        let mut m = MouthTargets {
            channels: [0.0; CHANNELS],
            press: 0.0,
            bite: 0.0,
        };
        for (c, v) in set {
            m.channels[*c as usize] = *v;
        }
        m
    }

    #[test]
    fn closed_lips_over_an_open_jaw_use_the_figures_contract() {
        let (mut pose, mut w) = (Pose::zero(), [0.0; 2]);
        let rig = rig(&["other", "mouthClose"]);
        rig.write(
            &mouth(&[(Channel::Jaw, 0.5)]),
            &Expression::default(),
            0.0,
            [0.0; 2],
            &mut pose,
            &mut w,
        );
        let angle = pose.rotation(Bone::Chin).to_scaled_axis().z;
        assert!(angle > 0.05);
        assert!((f64::from(w[1]) - angle / 0.2).abs() < 1e-6 && w[0] == 0.0);
    }

    #[test]
    fn targets_stand_in_for_joints() {
        let names = [
            "jawOpen",
            "eyeBlinkLeft",
            "eyeLookDownRight",
            "eyeLookOutLeft",
        ];
        let (mut pose, mut w) = (Pose::zero(), [0.0; 4]);
        pose.eyes = [DQuat::from_rotation_y(0.25) * DQuat::from_rotation_x(0.25); 2];
        rig(&names).write(
            &mouth(&[(Channel::Jaw, 1.0), (Channel::LipOpen, 1.0)]),
            &Expression::default(),
            0.0,
            [0.25; 2],
            &mut pose,
            &mut w,
        );
        assert!((f64::from(w[0]) - JAW_RAD / JAW_OPEN_RAD).abs() < 1e-6);
        assert!(w[1] > 0.1 && w[1] < 0.3, "the lid follows: {}", w[1]);
        assert!(
            (w[2] - 0.5).abs() < 0.03 && (w[3] - 0.5).abs() < 0.03,
            "{w:?}"
        );
        rig(&names).write(
            &mouth(&[]),
            &Expression::default(),
            1.0,
            [0.25; 2],
            &mut pose,
            &mut w,
        );
        assert_eq!((w[0], w[1]), (0.0, 1.0));
    }

    #[test]
    fn the_jaw_drops_the_chin() {
        let (mut pose, mut w) = (Pose::zero(), []);
        let skeleton = Skeleton::example();
        let chin = |pose: &Pose| {
            crate::kinematics::world_from_bone(&skeleton, pose, Bone::Chin)
                .transform_point3(DVec3::Y * 0.1)
        };
        let before = chin(&pose);
        rig(&[]).write(
            &mouth(&[(Channel::Jaw, 1.0)]),
            &Expression::default(),
            0.0,
            [0.0; 2],
            &mut pose,
            &mut w,
        );
        assert!(chin(&pose).y < before.y - 0.01);
    }

    #[test]
    fn a_blink_closes_both_lids_by_the_figures_angle_wherever_the_eyes_look() {
        for pitch in [-0.3, 0.0, 0.4] {
            let mut pose = Pose::zero();
            rig(&[]).write(
                &mouth(&[]),
                &Expression::default(),
                1.0,
                [pitch; 2],
                &mut pose,
                &mut [],
            );
            assert_eq!(pose.upper_lid_rad, [0.8, 0.7]);
        }
    }
}
