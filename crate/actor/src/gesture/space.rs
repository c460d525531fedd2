//! The space that the body takes: hands keep out of trunk and head.
//!
//! The trunk is an elliptic column, the head an ellipsoid, both in the zero pose.

use raconteur_base::curve::smooth;
use raconteur_base::{DVec3, ops};
use raconteur_body::{Bone, Pose, Skeleton};

use crate::arm_ik::TRUNK_HALF_AXES_M;
use crate::kinematics::world_from_bone;

/// Room that a wrist needs, for a stature of 1.7 m, metres.
const HAND_RADIUS_M: f64 = 0.045;
/// Half axes of the head (with hair), for a stature of 1.7 m, metres.
const HEAD_HALF_AXES_M: [f64; 3] = [0.085, 0.125, 0.105];
/// Width of the edge in which a hand is eased out, as a share of the half axes.
const EDGE: f64 = 0.04;

/// The body's obstacles for a wrist, in the zero pose, world, metres.
#[derive(Clone, Copy, Debug)]
pub struct BodySpace {
    axis_z: f64,
    half_width: f64,
    half_depth: f64,
    bottom: f64,
    top: f64,
    waist: f64,
    fade: f64,
    head: DVec3,
    head_half_axes: DVec3,
}

impl BodySpace {
    /// Measures a figure, with the room that a wrist needs.
    #[must_use]
    pub fn new(skeleton: &Skeleton) -> Self {
        Self::with_room(skeleton, HAND_RADIUS_M)
    }

    /// Measures a figure for what needs `room_m` around it, for a stature of 1.7 m, metres.
    #[must_use]
    pub fn with_room(skeleton: &Skeleton, room_m: f64) -> Self {
        let zero = Pose::zero();
        let at = |bone| world_from_bone(skeleton, &zero, bone).translation;
        let scale = skeleton.stature_m() / 1.7;
        let hand = room_m * scale;
        let skull = at(Bone::Skull);
        Self {
            axis_z: 0.5 * (at(Bone::LShoulder).z + at(Bone::Lumbar).z),
            half_width: TRUNK_HALF_AXES_M[0] * scale + hand,
            half_depth: TRUNK_HALF_AXES_M[1] * scale + hand,
            bottom: at(Bone::LHip).y - 0.12 * scale,
            top: at(Bone::LShoulder).y,
            waist: at(Bone::Lumbar).y,
            fade: 0.08 * scale,
            // The skull bone ends the neck; the head's middle is above and before it.
            head: skull + DVec3::new(0.0, 0.075, 0.03) * scale,
            head_half_axes: DVec3::from_array(HEAD_HALF_AXES_M) * scale + DVec3::splat(hand),
        }
    }

    /// Half width of the column for a wrist, metres.
    #[must_use]
    pub fn half_width_m(&self) -> f64 {
        self.half_width
    }

    /// Frontmost z of the column for a wrist, metres.
    #[must_use]
    pub fn front_m(&self) -> f64 {
        self.axis_z + self.half_depth
    }

    /// Height of the waist, metres.
    #[must_use]
    pub fn waist_m(&self) -> f64 {
        self.waist
    }

    /// The nearest place outside trunk and head for a wrist. Places farther out than a few
    /// hundredths of the half axes are left exactly alone.
    #[must_use]
    pub fn keep_out(&self, p: DVec3) -> DVec3 {
        let p = self.out_of_head(p);
        let (x, z) = (p.x / self.half_width, (p.z - self.axis_z) / self.half_depth);
        let r = ops::hypot(x, z);
        let grown = self.height_share(p.y);
        if r >= grown * (1.0 + EDGE) {
            return p;
        }
        let target = grown * eased(r / grown);
        // On the axis itself the hand leaves to the front.
        let (ux, uz) = if r > 1e-9 { (x / r, z / r) } else { (0.0, 1.0) };
        DVec3::new(
            ux * target * self.half_width,
            p.y,
            self.axis_z + uz * target * self.half_depth,
        )
    }

    /// How deep a wrist is inside, and the way out: the vector from it to
    /// [`BodySpace::keep_out`].
    #[must_use]
    pub fn way_out(&self, p: DVec3) -> DVec3 {
        self.keep_out(p) - p
    }

    fn out_of_head(&self, p: DVec3) -> DVec3 {
        let v = (p - self.head) / self.head_half_axes;
        let r = v.length();
        let target = eased(r);
        if target <= r {
            return p;
        }
        let u = if r > 1e-9 { v / r } else { DVec3::Z };
        self.head + u * target * self.head_half_axes
    }

    /// 1 at the height of the trunk, fading to 0 above the shoulders and below the hips.
    fn height_share(&self, y: f64) -> f64 {
        let above = 1.0 - smooth((y - self.top) / self.fade);
        let below = smooth((y - self.bottom + self.fade) / self.fade);
        above * below
    }
}

/// max(r, 1) with its corner rounded within ±[`EDGE`].
fn eased(r: f64) -> f64 {
    let x = r - 1.0;
    if x >= EDGE {
        r
    } else if x <= -EDGE {
        1.0
    } else {
        1.0 + (x + EDGE) * (x + EDGE) / (4.0 * EDGE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::noise;

    #[test]
    fn nothing_stays_inside_and_the_outside_is_left_alone() {
        let space = BodySpace::new(&Skeleton::example());
        let mut moved = 0;
        for i in 0..5_000 {
            let r = |k| noise::signed(2, k, i);
            let p = DVec3::new(0.5 * r(0), 1.3 + 0.6 * r(1), 0.5 * r(2));
            let q = space.keep_out(p);
            assert!(space.way_out(q).length() < 0.012, "{p} {q}");
            if q != p {
                moved += 1;
                let near = DVec3::new(p.x / 0.30, 0.0, (p.z - space.axis_z) / 0.25).length();
                let head = ((p - space.head) / space.head_half_axes).length();
                assert!(near < 1.05 || head < 1.05);
            }
        }
        assert!(moved > 100);
    }

    #[test]
    fn keeping_out_is_continuous() {
        let space = BodySpace::new(&Skeleton::example());
        for i in 0..5_000 {
            let r = |k| noise::signed(3, k, i);
            let p = DVec3::new(0.35 * r(0), 1.3 + 0.6 * r(1), 0.05 + 0.3 * r(2).abs());
            let q = p + DVec3::new(1e-5, 1e-5, -1e-5);
            let d = space.keep_out(p).distance(space.keep_out(q));
            // Near the axis a column magnifies; hands pass it only when told to.
            if ops::hypot(p.x, p.z - space.axis_z) > 0.06 && p.distance(space.head) > 0.06 {
                assert!(d < 30.0 * p.distance(q), "{p}: {d}");
            }
        }
    }
}
