//! Solves joints for their goal again, on the current body.

use raconteur_base::DAffine3;

use super::aim::ReachTarget;
use super::perform::Manipulators;
use super::solve::ReachRequest;
use crate::limb::chain::LimbBase;
use crate::limb::{Joints, Limb, RigidFrame};

impl Manipulators {
    /// Solves joints again for their target on a base.
    pub(super) fn aimed(
        &self,
        limb: Limb,
        aim: &ReachTarget,
        joints: &Joints,
        limited: f64,
        base: &LimbBase,
    ) -> Joints {
        let mut joints = *joints;
        if aim.share > 0.0 {
            let wish = ReachRequest {
                swivel_rad: aim.swivel_rad,
                limited,
                current: Some(&aim.joints),
            };
            let now = self.solved(limb, &aim.frame, &wish, base);
            aim.correct_joints(&mut joints, &now, self.limbs.get(limb.index()));
        }
        joints
    }

    /// Returns the target of joints on a base of a trunk.
    pub(super) fn aim(
        &self,
        limb: Limb,
        frame: &RigidFrame,
        joints: &Joints,
        base: &LimbBase,
        trunk: &DAffine3,
    ) -> ReachTarget {
        let swivel_rad = self.limbs.get(limb.index()).map_or(0.0, |rig| {
            let upper = rig.posed(joints, base).rotations[0];
            rig.swivel_of(rig.hinge_at(upper, base) - base.origin, frame, base)
        });
        // The same solver applies in both cases, so an unchanged body adds nothing.
        let limited = f64::from(u8::from(self.tracks[limb.index()].has_limits()));
        let wish = ReachRequest {
            swivel_rad,
            limited,
            current: Some(joints),
        };
        let (solved, _) = self.solved(limb, frame, &wish, base);
        ReachTarget {
            frame: *frame,
            place: trunk.inverse().transform_point3(frame.position),
            joints: solved,
            swivel_rad,
            share: 1.0,
            target: *frame,
        }
    }
}
