//! Clip fitted to one figure: positions in metres, solved reaches and planted legs.

use std::sync::Arc;

use raconteur_base::curve::smooth;
use raconteur_base::{DQuat, DVec3, Length, Side, mirror_vector};
use raconteur_body::skeleton::zero_frames;
use raconteur_body::{Bone, Pose, Skeleton};

use super::clip::{Clip, FootTrack, ReachTrack};
use super::curve::Curve;
use super::groups::BoneSet;
use super::layering::BlendedLayers;
use crate::idle::stance::Leg;
use crate::kinematics::{rotation_of, world_from_bone};
use crate::limb::{ARM_BONES, ArmGoal, ArmRig, LEG_BONES, Sex};
use crate::palm;

/// Distance of the heel's edge behind the ankle, share of stature: a quarter of the foot
/// (foot length is 0.152 of stature, ANSUR). Designed.
const HEEL_BEHIND: f64 = 0.033;
/// Foot lift above which the toes are released, share of stature. Designed.
const TOES_FREE: f64 = 0.03;

/// Measures of a figure that fit animation clips to it: legs, arms, balls of the feet, shoulders
/// and stature.
#[derive(Clone, Debug)]
pub(crate) struct ClipSkeleton {
    pub(crate) legs: [Leg; 2],
    arms: [Arc<ArmRig>; 2],
    /// The ball of each foot in the zero pose, world, metres.
    balls: [DVec3; 2],
    /// Balls of the left and right foot in the frame of the ankle, metres.
    ball_in_foot: [DVec3; 2],
    /// Middle between the shoulders in the zero pose, world, metres.
    shoulders: DVec3,
    pub(crate) stature_m: f64,
    toe_zero: [DQuat; 2],
}

/// The bones of the toes.
const TOES: [Bone; 2] = [Bone::LMetatarsal, Bone::RMetatarsal];

impl ClipSkeleton {
    pub(crate) fn new(skeleton: &Skeleton, arms: [Arc<ArmRig>; 2], sex: Sex) -> Self {
        let zero = Pose::zero();
        let at = |bone| world_from_bone(skeleton, &zero, bone).translation;
        let frames = zero_frames();
        let legs = Side::BOTH.map(|side| Leg::new(skeleton, side, sex));
        Self {
            ball_in_foot: Side::BOTH.map(|side| {
                let standing = legs[side.index()].world_from_ankle();
                standing.inverse().transform_point3(at(TOES[side.index()]))
            }),
            legs,
            arms,
            balls: TOES.map(at),
            shoulders: 0.5 * (at(Bone::LShoulder) + at(Bone::RShoulder)),
            stature_m: skeleton.stature_m(),
            toe_zero: TOES.map(|bone| frames[bone.index()]),
        }
    }

    /// Returns the ball of a foot for an ankle position (world, metres) and a foot rotation (world
    /// from ankle); world, metres.
    pub(crate) fn ball(&self, side: usize, ankle: DVec3, foot: DQuat) -> DVec3 {
        ankle + foot * self.ball_in_foot[side]
    }

    /// Returns the ankle for a ball of the foot (world, metres) and a foot rotation (world from
    /// ankle); world, metres.
    pub(crate) fn ankle(&self, side: usize, ball: DVec3, foot: DQuat) -> DVec3 {
        ball - foot * self.ball_in_foot[side]
    }

    /// Returns ankle (world, metres), foot rotation (world from ankle), knee direction, and local
    /// rotation of the toes of a foot track at a time.
    fn foot(&self, track: &FootTrack, side: Side, time_secs: f64) -> (DVec3, DQuat, DVec3, DQuat) {
        let i = side.index();
        let sign = side.sign();
        let [out, up, front, knee] = track.place.sample(time_secs);
        let [heel, turn, roll, _] = track.turn.sample(time_secs);
        let standing = self.legs[i].world_from_ankle();
        let ankle = standing.translation;
        let about = DQuat::from_rotation_y(sign * turn);
        let tipped = DQuat::from_rotation_x(heel) * DQuat::from_rotation_z(-sign * roll);
        // A raised heel turns the foot about its ball, raised toes about the heel's edge.
        let pivot = if heel > 0.0 {
            self.balls[i]
        } else {
            DVec3::new(ankle.x, 0.0, ankle.z - HEEL_BEHIND * self.stature_m)
        };
        let lever = ankle - pivot;
        let from_ball = ankle - self.balls[i];
        let moved = DVec3::new(sign * out, up, front) * self.stature_m;
        // Feet turn on their balls.
        let at = self.balls[i] + moved + about * (from_ball + tipped * lever - lever);
        let contact = 1.0 - smooth(up / TOES_FREE);
        let flat = DQuat::from_rotation_x(-heel.max(0.0) * contact);
        let zero = self.toe_zero[i];
        (
            at,
            about * tipped * rotation_of(standing),
            DQuat::from_rotation_y(sign * (knee + 0.8 * turn)) * DVec3::Z,
            (zero.inverse() * flat * zero).normalized(),
        )
    }
}

/// Clip at one of its times, with the bones that it moves and its weight in a weighted mean of
/// clips.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WeightedClip {
    /// The clip's own time, seconds.
    pub(crate) time_secs: f64,
    pub(crate) bones: BoneSet,
    /// Weight in the mean.
    pub(crate) share: f64,
}

/// Animation clip fitted to one figure: its reaches are solved as arm rotations.
#[derive(Clone, Debug)]
pub(crate) struct BoundClip {
    pub(crate) clip: Arc<Clip>,
    /// Arms solved from reaches.
    arms: Vec<(Bone, Curve)>,
    moves: BoneSet,
}

impl BoundClip {
    pub(crate) fn new(clip: Arc<Clip>, skeleton: &Skeleton, body: &ClipSkeleton) -> Self {
        let mut bound = Self {
            moves: clip.moves(),
            arms: Vec::new(),
            clip,
        };
        for reach in &bound.clip.reaches {
            let solved = bound.solve_reach(reach, skeleton, body);
            bound.arms.extend(solved);
        }
        bound
    }

    /// Rotations of an arm's bones at the keys of a reach; the arm swings between them.
    fn solve_reach(
        &self,
        reach: &ReachTrack,
        skeleton: &Skeleton,
        body: &ClipSkeleton,
    ) -> [(Bone, Curve); 4] {
        let side = reach.side;
        let rig = &body.arms[side.index()];
        let out = |v: DVec3| {
            if side == Side::Left {
                v
            } else {
                mirror_vector(v)
            }
        };
        let mut times = Vec::new();
        let mut turns = [const { Vec::new() }; 4];
        for key in &reach.keys {
            let mut pose = Pose::zero();
            pose.root_offset_in_world = self.root_at(key.time_secs, body).unwrap_or_default();
            for (bone, curve) in &self.clip.bones {
                if matches!(bone, Bone::Sacroiliac | Bone::Lumbar | Bone::Thoracic) {
                    pose.set(*bone, curve.rotation_at(key.time_secs));
                }
            }
            let thorax = world_from_bone(skeleton, &pose, Bone::Thoracic);
            let moved = thorax * rig.world_from_thorax_zero().inverse();
            let turned = rotation_of(&moved);
            let wrist = body.shoulders + out(key.place) * body.stature_m;
            let hand = palm::from_directions(side, out(key.fingers), out(key.palm));
            let solution = rig.solve(
                &thorax,
                &ArmGoal {
                    wrist_in_world: moved.transform_point3(wrist),
                    hand_in_world: hand.map(|h| turned * h),
                    shrug_rad: 0.0,
                },
            );
            times.push(key.time_secs);
            let solved = [
                solution.scapula,
                solution.shoulder,
                solution.elbow,
                solution.wrist,
            ];
            for (list, q) in turns.iter_mut().zip(solved) {
                list.push(q);
            }
        }
        let clip = &self.clip;
        let period = (clip.closed && clip.duration_secs > 0.0).then_some(clip.duration_secs);
        let bones = ARM_BONES[side.index()];
        core::array::from_fn(|i| {
            let curve = Curve::of_rotations(&times, &turns[i], reach.ease, period);
            (bones[i], curve)
        })
    }

    fn root_at(&self, time_secs: f64, body: &ClipSkeleton) -> Option<DVec3> {
        let [x, y, z, _] = self.clip.root.as_ref()?.sample(time_secs);
        Some(DVec3::new(x, y, z) * body.stature_m)
    }

    /// Returns the bones of a set that the clip moves.
    pub(crate) fn moved(&self, bones: BoneSet) -> BoneSet {
        bones.and(self.moves)
    }

    /// Adds the clip's values of some bones at a clip time to a mean.
    pub(crate) fn add(
        &self,
        skeleton: &Skeleton,
        body: &ClipSkeleton,
        part: WeightedClip,
        into: &mut BlendedLayers,
    ) {
        let WeightedClip {
            time_secs,
            bones,
            share,
        } = part;
        if share <= 0.0 || self.moved(bones).is_empty() {
            return;
        }
        // Legs need the clip's own pelvis, whichever player moves the pelvis in the end.
        let mut pose = Pose::zero();
        pose.root_offset_in_world = self.root_at(time_secs, body).unwrap_or_default();
        for (bone, curve) in self.clip.bones.iter().chain(&self.arms) {
            let is_leg = Side::BOTH.iter().any(|s| BoneSet::leg(*s).has(*bone));
            if bones.has(*bone) || *bone == Bone::Sacroiliac {
                let rotation = curve.rotation_at(time_secs);
                pose.set(*bone, rotation);
                if bones.has(*bone) && !is_leg {
                    into.add_bone(*bone, rotation, share);
                }
            }
        }
        let pelvis = world_from_bone(skeleton, &pose, Bone::Sacroiliac);
        let mut stands = 0.0;
        for side in Side::BOTH {
            let i = side.index();
            let leg_bones = BoneSet::leg(side);
            if self.moved(bones.and(leg_bones)).is_empty() {
                continue;
            }
            let whole = LEG_BONES[i].iter().all(|b| bones.has(*b));
            let leg = &body.legs[i];
            if let Some(track) = &self.clip.feet[i] {
                let (at, foot, knee, toes) = body.foot(track, side, time_secs);
                let solved = leg.solve(&pelvis, at, foot, knee);
                for (bone, q) in LEG_BONES[i].into_iter().zip(solved) {
                    pose.set(bone, q);
                }
                pose.set(TOES[i], toes);
                if whole {
                    into.add_foot(i, body.ball(i, at, foot), foot, share);
                }
            } else if whole {
                let turns = LEG_BONES[i].map(|b| pose.rotation(b));
                let (at, foot, _) = leg.placed(&pelvis, turns);
                into.add_foot(i, body.ball(i, at, foot), foot, share);
            }
            for bone in Bone::ALL {
                if leg_bones.and(bones).has(bone) && self.moves.has(bone) {
                    into.add_bone(bone, pose.rotation(bone), share);
                }
            }
            if whole {
                stands += 0.5;
            }
        }
        // Each leg moves the figure's position by half.
        into.add_root(pose.root_offset_in_world, share * stands);
    }
}
