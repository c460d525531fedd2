//! Joint goals that stay valid when other limbs move the body.
//!
//! A path through the joints is planned for the body with one limb moving alone. The manipulators
//! of a figure are independent (GEVH 3.3.2), but they share a trunk that leans for each of them.
//! The joints of such a path are therefore solved again on the current body, and the difference is
//! added to the path, with a weight that grows near the target.

use raconteur_base::curve::smooth;
use raconteur_base::{DAffine3, DQuat, DVec3, ops};

use super::between;
use crate::limb::chain::{END, LimbRig, ROLL};
use crate::limb::{Joints, RigidFrame};

/// Total joint correction by limits, radians, from which the mean of the last goals is used.
pub(super) const FORCED: f64 = 0.2;

/// Target of a limb's end with the joints that reach it on the body used for planning; joints are
/// corrected for the body's later motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct ReachTarget {
    /// Figure axes.
    pub(super) frame: RigidFrame,
    /// Position in the axes of the trunk used for planning, metres.
    pub(super) place: DVec3,
    pub(super) joints: Joints,
    /// Swivel of elbow or knee, radians from the natural direction; 0 for the head.
    pub(super) swivel_rad: f64,
    /// Weight, 0 to 1.
    pub(super) share: f64,
    /// Target of the limb, figure axes: the reference for its error.
    pub(super) target: RigidFrame,
}

impl ReachTarget {
    /// Returns the target with another weight and another reference for its error.
    pub(super) fn counting(&self, share: f64, target: RigidFrame) -> Self {
        Self {
            share,
            target,
            ..*self
        }
    }

    /// Interpolates towards another one by a share.
    pub(super) fn lerp(&self, to: &Self, share: f64) -> Self {
        let swivel_rad = ops::wrap_angle(to.swivel_rad - self.swivel_rad);
        Self {
            frame: self.frame.lerp(&to.frame, share),
            place: self.place.lerp(to.place, share),
            joints: between(&self.joints, &to.joints, share),
            swivel_rad: self.swivel_rad + share * swivel_rad,
            ..*self
        }
    }

    /// Returns the target of the limb; `None` while a joint-space path has not reached it.
    pub(super) fn target(&self) -> Option<RigidFrame> {
        (self.share >= 1.0).then_some(self.target)
    }

    /// Returns the displacement of the position from its planned one, in the axes of the present
    /// trunk, metres.
    pub(super) fn moved_on(&self, trunk: &DAffine3) -> DVec3 {
        self.share * (trunk.inverse().transform_point3(self.frame.position) - self.place)
    }

    /// Corrects joints for the present body: the turn of the upper bone as a rotation, since two
    /// sets of angles are equivalent, all others by their angles. A part kept from its place by
    /// limits stays as planned, because its deviation could change with every sway of the body.
    /// `now` gives the joints for the place nearest to those planned, and the rotation that limits
    /// force on its upper bone and its end, radians.
    pub(super) fn correct_joints(
        &self,
        joints: &mut Joints,
        (now, forced): &(Joints, [f64; 2]),
        rig: Option<&LimbRig>,
    ) {
        let [limb, end] = [forced[0], forced[0].max(forced[1])]
            .map(|forced| self.share * (1.0 - smooth(forced / FORCED)));
        if let Some(rig) = rig {
            let turn = rig.link(now) * rig.link(&self.joints).inverse();
            rig.turn_upper(DQuat::IDENTITY.slerp(turn, limb), joints);
        }
        for (i, (now, then)) in now.iter().zip(&self.joints).enumerate() {
            let share = match rig {
                Some(_) if [0, 1, ROLL].contains(&i) => continue,
                Some(_) if i < END.start => limb,
                _ => end,
            };
            joints[i] += share * ops::wrap_angle(now - then);
        }
    }
}
