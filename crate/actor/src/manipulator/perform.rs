//! Performance of a figure's manipulators: a function of time without state or allocation.

use std::sync::Arc;

use raconteur_base::{DAffine3, DQuat, Side};
use raconteur_body::{Bone, Pose, Skeleton};

use super::ManipulatorScript;
use super::head::HeadRig;
use super::motion::MotionGoal;
use super::root::RootTrack;
use super::smoothing::SmoothedPaths;
use super::track::LimbTrack;
use crate::kinematics::world_from_bone;
use crate::limb::chain::{LimbBase, LimbRig, PosedLimb};
use crate::limb::limits::{self, Limit};
use crate::limb::obstacles::Obstacles;
use crate::limb::solve::Solutions;
use crate::limb::{ARM_BONES, ArmRig};
use crate::limb::{Joints, Limb, RigidFrame, Sex};

/// Manipulators of a figure: rigs of limbs and head, with the scheduled motions of each; solves
/// them at any story time.
#[derive(Clone, Debug)]
pub struct Manipulators {
    pub(super) arms: [Arc<ArmRig>; 2],
    pub(super) limbs: [LimbRig; 4],
    pub(super) head: HeadRig,
    pub(super) tracks: [LimbTrack; 5],
    pub(super) root: RootTrack,
    /// Joints that guide the limbs where their targets would make them snap.
    pub(super) steady: [SmoothedPaths; 5],
}

impl Manipulators {
    /// Measures a figure and prepares a script for it. `idle` poses the figure without manipulators
    /// at a time; commands start from that pose, or from the result of earlier commands.
    #[must_use]
    pub fn new(
        script: &ManipulatorScript,
        skeleton: &Skeleton,
        sex: Sex,
        arms: [Arc<ArmRig>; 2],
        idle: &dyn Fn(f64, &mut Pose),
    ) -> Self {
        let mut all = Self::at_rest(skeleton, sex, arms);
        all.root = RootTrack::new(&script.moves);
        all.compile(script, skeleton, idle);
        all
    }

    /// Creates manipulators without commands for a skeleton.
    #[must_use]
    pub fn at_rest(skeleton: &Skeleton, sex: Sex, arms: [Arc<ArmRig>; 2]) -> Self {
        let [left, right] = arms.each_ref().map(|arm| arm.limb().clone());
        let [left_leg, right_leg] = Side::BOTH.map(|s| LimbRig::new(skeleton, s, false, sex));
        Self {
            arms,
            limbs: [left, right, left_leg, right_leg],
            head: HeadRig::new(skeleton, sex),
            // A neck has no twist as a manipulator.
            tracks: Limb::ALL.map(|limb| match limb {
                Limb::Head => LimbTrack::setting_in(),
                _ => LimbTrack::default(),
            }),
            root: RootTrack::default(),
            steady: Default::default(),
        }
    }

    /// Returns world from figure axes at a time, as moved by `vh-move`; `None` if it never moves.
    #[must_use]
    pub fn world_from_figure(&self, time_secs: f64) -> Option<DAffine3> {
        self.root.sample(time_secs)
    }

    /// Returns true if the script cuts a limb to other joints after one time and up to another,
    /// seconds.
    #[must_use]
    pub fn cuts_between(&self, after_secs: f64, to_secs: f64) -> bool {
        let mut cuts = self.steady.iter().flat_map(|steady| &steady.cuts_secs);
        cuts.any(|cut| *cut > after_secs && *cut <= to_secs)
    }

    /// Returns the goal of a limb at a time, and its degree of control; `None` if it is not
    /// controlled.
    pub(super) fn goal(&self, limb: Limb, time_secs: f64) -> Option<(MotionGoal, f64)> {
        let track = &self.tracks[limb.index()];
        let weight = track.weight(time_secs);
        if weight <= 0.0 {
            return None;
        }
        let figure_from_world = match self.root.sample(time_secs) {
            Some(moved) => moved.inverse(),
            None => DAffine3::IDENTITY,
        };
        Some((track.goal(time_secs, &figure_from_world)?, weight))
    }

    /// Moves arms and legs, after all other sources of motion. Returns each target, figure axes, in
    /// the order of [`Limb::ALL`], for the limbs under manipulator control.
    pub fn limbs(
        &self,
        skeleton: &Skeleton,
        time_secs: f64,
        pose: &mut Pose,
    ) -> [Option<RigidFrame>; 4] {
        self.first_limbs(self.limbs.len(), skeleton, time_secs, pose)
    }

    /// Moves the first limbs in the order of [`Limb::ALL`], up to a count.
    pub(super) fn first_limbs(
        &self,
        count: usize,
        skeleton: &Skeleton,
        time_secs: f64,
        pose: &mut Pose,
    ) -> [Option<RigidFrame>; 4] {
        let mut targets = [None; 4];
        let limbs = Limb::ALL.into_iter().take(count.min(self.limbs.len()));
        for (index, limb) in limbs.enumerate() {
            let Some((goal, weight)) = self.goal(limb, time_secs) else {
                continue;
            };
            let met = self.solve_at(limb, &goal, time_secs, skeleton, pose);
            if let Some(target) = targets.get_mut(index) {
                *target = Some(met.target);
            }
            self.place(limb, &met, weight, pose);
        }
        targets
    }

    /// Turns the head towards its manipulator target in a pose. Call it after gaze has turned the
    /// head.
    pub fn head(&self, skeleton: &Skeleton, time_secs: f64, pose: &mut Pose) {
        let Some((goal, weight)) = self.goal(Limb::Head, time_secs) else {
            return;
        };
        let met = self.solve_at(Limb::Head, &goal, time_secs, skeleton, pose);
        self.place(Limb::Head, &met, weight, pose);
    }

    /// Projects a target into reach, preserving its orientation.
    pub(super) fn projected(
        &self,
        limb: Limb,
        frame: &RigidFrame,
        base: &LimbBase,
        limited: f64,
    ) -> RigidFrame {
        let Some(rig) = self.limbs.get(limb.index()) else {
            return self.head.clamp_target(frame, base, limited);
        };
        let (near, _) = rig.projected(frame.position - base.origin, limited);
        RigidFrame {
            position: base.origin + near,
            ..*frame
        }
    }

    pub(super) fn solutions(
        &self,
        limb: Limb,
        target: &RigidFrame,
        base: &LimbBase,
        swivel_rad: f64,
    ) -> Solutions {
        match self.limbs.get(limb.index()) {
            Some(rig) => {
                let elbow = rig.elbow_at(target, base, swivel_rad);
                rig.solutions(target, elbow, base, true)
            }
            None => self.head.solutions(target, base, true),
        }
    }

    /// Returns the bone that carries a limb, figure axes.
    pub(super) fn trunk(&self, limb: Limb, skeleton: &Skeleton, pose: &Pose) -> DAffine3 {
        match self.limbs.get(limb.index()) {
            Some(rig) => rig.trunk(skeleton, pose),
            None => world_from_bone(skeleton, pose, Bone::Thoracic),
        }
    }

    /// Returns a limb's base on its trunk; an arm's with the given scapula rotation.
    pub(super) fn base(&self, limb: Limb, trunk: &DAffine3, scapula: Option<DQuat>) -> LimbBase {
        match (self.limbs.get(limb.index()), self.arms.get(limb.index())) {
            (Some(rig), Some(arm)) => {
                let scapula = scapula.unwrap_or(DQuat::IDENTITY);
                rig.base(trunk, Some(arm.girdle().placed(trunk, scapula)))
            }
            (Some(rig), None) => rig.base(trunk, None),
            _ => self.head.base(trunk),
        }
    }

    /// Moves joints towards their limits by a share.
    pub(super) fn clamp_joints(&self, limb: Limb, share: f64, joints: &Joints) -> Joints {
        match self.limbs.get(limb.index()) {
            Some(rig) => rig.clamp_joints(share, joints),
            None => limits::clamp_joints(self.head.limits(), share, joints),
        }
    }

    pub(super) fn limits(&self, limb: Limb) -> &[Limit; 7] {
        match self.limbs.get(limb.index()) {
            Some(rig) => rig.limits(),
            None => self.head.limits(),
        }
    }

    pub(super) fn posed(&self, limb: Limb, joints: &Joints, base: &LimbBase) -> PosedLimb {
        match self.limbs.get(limb.index()) {
            Some(rig) => rig.posed(joints, base),
            None => self.head.posed(joints, base),
        }
    }

    /// Returns the obstacles of an arm in a pose; `None` for other limbs.
    pub(super) fn obstacles(
        &self,
        limb: Limb,
        thorax: &DAffine3,
        skeleton: &Skeleton,
        pose: &Pose,
    ) -> Option<Obstacles<'_>> {
        let [_, _, elbow, wrist] = match limb {
            Limb::LeftArm => ARM_BONES[1],
            Limb::RightArm => ARM_BONES[0],
            _ => return None,
        };
        let skull = world_from_bone(skeleton, pose, Bone::Skull);
        let elbow = world_from_bone(skeleton, pose, elbow);
        let joint = &skeleton.joints()[wrist.index()];
        let arm = &self.arms[limb.index()];
        Some(Obstacles {
            body: arm.space(),
            body_from_figure: arm.world_from_thorax_zero() * thorax.inverse(),
            head: skull.transform_point3(arm.space().head_in_skull()),
            other_forearm: Some([
                elbow.translation,
                elbow.transform_point3(joint.translation_in_parent),
            ]),
        })
    }
}
