//! Arms: hand goals of gestures and rest, separated from each other and moved out of the body.

use raconteur_base::{DAffine3, DQuat, DVec3, Length, Side, mirror_vector};
use raconteur_body::{Bone, Pose, Skeleton};

use super::Actor;
use crate::animation::AnimatedPose;
use crate::body_posture::BodyPosture;
use crate::gesture::HandTarget;
use crate::gesture::contact::TargetHand;
use crate::kinematics::{rotation_of, world_from_bone};
use crate::limb::{ArmGoal, ArmSolution};

/// Largest displacement of a resting hand with the other one, for a stature of 1.7 m, metres.
const MAX_ALONG_M: f64 = 0.14;

/// Moves a resting hand along with the mirrored movement of the other one, away from the body and
/// from the other hand.
fn move_along(targets: &mut [HandTarget; 2], scale: f64) {
    let along = Side::BOTH.map(|side| {
        let mirrored = mirror_vector(targets[side.opposite().index()].excursion);
        let out = (side.sign() * mirrored.x).max(0.0);
        DVec3::new(side.sign() * out, mirrored.y, mirrored.z.max(0.0))
    });
    for (target, along) in targets.iter_mut().zip(along) {
        target.wrist += (along * target.sympathy).clamp_length_max(MAX_ALONG_M * scale);
    }
}

impl Actor {
    /// Poses both arms and their hands. Returns their solutions, the wrist targets, and the share
    /// of rest in them.
    pub(super) fn arms(
        &self,
        skeleton: &Skeleton,
        t: f64,
        (animated, posture): (Option<&AnimatedPose>, &BodyPosture),
        pose: &mut Pose,
    ) -> ([ArmSolution; 2], [DVec3; 2], [f64; 2]) {
        let thorax = world_from_bone(skeleton, pose, Bone::Thoracic);
        let mut targets = self.plans.each_ref().map(|plan| plan.sample(t));
        move_along(&mut targets, skeleton.scale());
        // A resting hand moves with the trunk, a gesturing hand with the heading of the figure.
        let moved = thorax * self.rigs[0].world_from_thorax_zero().inverse();
        let turned = rotation_of(&moved);
        let carried = [self.heading.carry(t), moved];
        let mut hands =
            Side::BOTH.map(|side| self.place(side, &targets[side.index()], &carried, turned));
        let breath = self.breath(t);
        let solve = |side: Side, hand: &TargetHand| {
            let i = side.index();
            let goal = ArmGoal {
                wrist_in_world: hand.wrist,
                hand_in_world: Some(hand.hand),
                shrug_rad: posture.shrug[i] + self.trunk.shrug(t, i as u64, self.amount, breath),
            };
            self.rigs[i].solve(&thorax, &goal)
        };
        let mut arms = Side::BOTH.map(|side| solve(side, &hands[side.index()]));
        // The contact depends on the reached hand positions, which can differ from the requested
        // ones.
        let met = Side::BOTH.map(|side| {
            let i = side.index();
            TargetHand {
                hand: self.rigs[i].hand_of(&thorax, &arms[i]),
                ..hands[i]
            }
        });
        let axes = [turned * DVec3::X, turned * DVec3::Z];
        let apart = self.contact.apart([&met[0], &met[1]], axes);
        if apart != DVec3::ZERO {
            hands[0].wrist += apart * 0.5;
            hands[1].wrist -= apart * 0.5;
            arms = Side::BOTH.map(|side| solve(side, &hands[side.index()]));
        }
        for side in Side::BOTH {
            let i = side.index();
            self.calming[i].correct(side, t, &mut arms[i]);
            arms[i].apply(side, pose);
            for (bone, rotation) in hands[i].fingers {
                pose.set(bone, rotation);
            }
            if let Some(animated) = animated {
                let fingers = targets[i].finger_rest_share;
                animated.blend_arm(side, targets[i].rest_share, fingers, pose);
            }
        }
        let rest_shares = targets.each_ref().map(|target| target.rest_share);
        (arms, hands.map(|hand| hand.wrist), rest_shares)
    }

    /// Converts the target of a hand into a hand in world coordinates, moved with the trunk and
    /// kept outside the body.
    fn place(
        &self,
        side: Side,
        target: &HandTarget,
        [headed, moved]: &[DAffine3; 2],
        turned: DQuat,
    ) -> TargetHand {
        let carried = headed
            .transform_point3(target.wrist)
            .lerp(moved.transform_point3(target.wrist), target.rest_share);
        let in_body = moved.inverse().transform_point3(carried);
        let hand = rotation_of(headed).slerp(turned, target.hand_rest_share) * target.hand;
        let mut placed = TargetHand {
            wrist: self.space.project_outside(in_body),
            hand: (turned.inverse() * hand).normalized(),
            fingers: target.shape.rotations(side),
        };
        placed.wrist += self.contact.exit_displacement(side, &placed);
        placed.wrist = carried + turned * (placed.wrist - in_body);
        placed.hand = hand.normalized();
        placed
    }
}
