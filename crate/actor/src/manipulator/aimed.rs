//! Solves joints again for what they are to reach, on the body as it is.

use raconteur_base::DAffine3;

use super::aim::Aim;
use super::meet::Wish;
use super::perform::Manipulators;
use crate::limb::chain::Base;
use crate::limb::{Frame, Joints, Limb};

impl Manipulators {
    /// Solves joints again for what they are to reach on a base.
    pub(super) fn aimed(
        &self,
        limb: Limb,
        aim: &Aim,
        joints: &Joints,
        limited: f64,
        base: &Base,
    ) -> Joints {
        let mut joints = *joints;
        if aim.share > 0.0 {
            let wish = Wish {
                swivel_rad: aim.swivel_rad,
                limited,
                current: Some(&aim.joints),
            };
            let now = self.solved(limb, &aim.frame, &wish, base);
            aim.lead(&mut joints, &now, self.limbs.get(limb.index()));
        }
        joints
    }

    /// What joints are to reach on a base that stands on a trunk.
    pub(super) fn aim(
        &self,
        limb: Limb,
        frame: &Frame,
        joints: &Joints,
        base: &Base,
        trunk: &DAffine3,
    ) -> Aim {
        let swivel_rad = self.limbs.get(limb.index()).map_or(0.0, |rig| {
            let upper = rig.posed(joints, base).rotations[0];
            rig.swivel_of(rig.hinge_at(upper, base) - base.origin, frame, base)
        });
        // Solved as it will be again: without a change of the body nothing is added.
        let limited = f64::from(u8::from(self.tracks[limb.index()].has_limits()));
        let wish = Wish {
            swivel_rad,
            limited,
            current: Some(joints),
        };
        let (solved, _) = self.solved(limb, frame, &wish, base);
        Aim {
            frame: *frame,
            place: trunk.inverse().transform_point3(frame.position),
            joints: solved,
            swivel_rad,
            share: 1.0,
            target: *frame,
        }
    }
}
