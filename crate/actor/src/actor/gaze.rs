//! Head and eye motion towards the listener and away.

use raconteur_base::{DAffine3, DQuat, DVec3, Length};
use raconteur_body::{Bone, Pose, Skeleton};

use super::{Actor, EYES_FROM_SKULL_M};
use crate::animation::AnimatedPose;
use crate::face::FaceRig;
use crate::idle::gaze::{HEAD_SHARE, angles_of, eye_towards};
use crate::idle::trunk::spine;
use crate::kinematics::{rotation_of, world_from_bone};

/// Head tilt of a figure that waits to begin, radians. Designed.
const WELCOME_TILT_RAD: f64 = 0.045;

impl Actor {
    /// Turns neck and skull towards the listener, in addition to their other motion.
    pub(super) fn head(
        &self,
        skeleton: &Skeleton,
        t: f64,
        listener: DVec3,
        animated: Option<&AnimatedPose>,
        pose: &mut Pose,
    ) {
        // Animations are added to the gaze, which must not undo them.
        let moved = animated.filter(|a| a.moves_head()).map(|_| {
            [Bone::Cervical, Bone::Skull].map(|bone| {
                let played = pose.rotation(bone);
                pose.set(bone, DQuat::IDENTITY);
                (bone, played)
            })
        });
        let head = world_from_bone(skeleton, pose, Bone::Skull);
        let axes = rotation_of(&head) * self.skull_zero.inverse();
        let eyes = head.translation + axes * EYES_FROM_SKULL_M;
        let [yaw, pitch] = angles_of(axes.inverse() * (listener - eyes));
        let motion = self.trunk.head_motion(&self.rhythm, t, self.amount);
        let mut pitch = (HEAD_SHARE * pitch).clamp(-0.4, 0.4) + motion.x;
        let mut yaw = (HEAD_SHARE * yaw).clamp(-0.7, 0.7) + motion.z;
        let mut roll = motion.y + if self.welcomes { WELCOME_TILT_RAD } else { 0.0 };
        let felt = self.feeling.head(t);
        pitch += felt.pitch;
        yaw += felt.yaw;
        roll += felt.roll;
        // Neck and skull share the turn.
        pose.set(Bone::Cervical, spine(0.4 * pitch, 0.4 * roll, 0.4 * yaw));
        pose.set(Bone::Skull, spine(0.6 * pitch, 0.6 * roll, 0.6 * yaw));
        for (bone, played) in moved.into_iter().flatten() {
            pose.set(bone, (played * pose.rotation(bone)).normalized());
        }
    }

    /// Turns the eyes to the listener. Returns the up or down pitch of each eye, radians.
    pub(super) fn eyes(
        &self,
        skeleton: &Skeleton,
        face: &FaceRig,
        t: f64,
        listener: DVec3,
        pose: &mut Pose,
    ) -> [f64; 2] {
        let skull = world_from_bone(skeleton, pose, Bone::Skull);
        let axes = DAffine3::from_rotation_translation(
            rotation_of(&skull) * self.skull_zero.inverse(),
            skull.translation,
        );
        let away = self.feeling.eyes(t);
        let mut pitch = [0.0; 2];
        for (i, eye) in face.eyes_in_skull().into_iter().enumerate() {
            let eye_in_world = skull.transform_point3(eye);
            (pose.eyes[i], pitch[i]) = eye_towards(&axes, eye_in_world, listener, away);
        }
        pitch
    }
}
