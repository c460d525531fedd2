//! Space of the body: hands and arms stay outside trunk and head.
//!
//! The trunk is an elliptic column and the head an ellipsoid, both in the zero pose. The depth of
//! the column's front at each height is measured on the figure, where available.

use raconteur_base::curve::smooth;
use raconteur_base::{DVec3, Length, ops};
use raconteur_body::figure::MaterialKind;
use raconteur_body::{Bone, Figure, Pose, Skeleton};

use crate::kinematics::{rotation_of, world_from_bone};

/// Half width and half depth of the trunk for a stature of 1.7 m, metres; measured at the chest of
/// an average clothed adult.
const TRUNK_HALF_AXES_M: [f64; 2] = [0.17, 0.13];

/// Room that a wrist needs, for a stature of 1.7 m, metres.
const HAND_RADIUS_M: f64 = 0.045;
/// Half axes of the head (with hair) for a stature of 1.7 m: x, y, z; metres.
const HEAD_HALF_AXES_M: [f64; 3] = [0.085, 0.125, 0.105];
/// Width of the edge in which a hand is eased out, as a share of the half axes.
const EDGE: f64 = 0.04;

/// Heights at which the trunk's front is measured.
const LEVELS: usize = 16;

/// Depth profile of a trunk: distances of its front and its back from its axis at levels from the
/// hips to the shoulders, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrunkShape {
    depths_m: [f64; LEVELS],
    backs_m: [f64; LEVELS],
}

impl TrunkShape {
    /// Measures the trunk of a figure, including its clothes.
    #[must_use]
    pub fn from_figure(figure: &Figure) -> Self {
        let space = BodySpace::new(&figure.skeleton, None);
        let (mut depths_m, mut backs_m) = ([0.0_f64; LEVELS], [0.0_f64; LEVELS]);
        for bone in [Bone::Sacroiliac, Bone::Lumbar, Bone::Thoracic] {
            let zero = world_from_bone(&figure.skeleton, &Pose::zero(), bone);
            let Some(bind) = figure.inverse_bind.get(bone.index()) else {
                continue;
            };
            let zero_from_bind = zero * *bind;
            let hair = |kind| matches!(kind, MaterialKind::Hair | MaterialKind::Lash);
            for mesh in figure.meshes.iter().filter(|m| !hair(m.material.kind)) {
                let weights = mesh.joints.iter().zip(&mesh.weights);
                for (p, (joints, weights)) in mesh.positions.iter().zip(weights) {
                    let mut own = joints.iter().zip(weights);
                    if !own.any(|(j, w)| *w > 0.5 && usize::from(*j) == bone.index()) {
                        continue;
                    }
                    let p = DVec3::from_array(p.map(f64::from));
                    let p = zero_from_bind.transform_point3(p);
                    // The half axis of the ellipse that passes through here.
                    let aside = p.x / space.half_width;
                    let depth = (p.z - space.axis_z) / (1.0 - aside * aside).max(0.3).sqrt();
                    let level = space.level(p.y);
                    if (0.0..=(LEVELS - 1) as f64).contains(&level) {
                        for i in [level.floor(), level.ceil()] {
                            let i = i as usize;
                            depths_m[i] = depths_m[i].max(depth);
                            backs_m[i] = backs_m[i].max(-depth);
                        }
                    }
                }
            }
        }
        // Heights without skin have the default depth.
        let usual = space.half_depth;
        let known = |depths: [f64; LEVELS]| depths.map(|d| if d > 0.5 * usual { d } else { usual });
        Self {
            depths_m: known(depths_m),
            backs_m: known(backs_m),
        }
    }
}

/// Obstacles that the body is for its hands, in the zero pose, world, metres: the trunk as an
/// elliptic column, the head as an ellipsoid.
#[derive(Clone, Copy, Debug)]
pub struct BodySpace {
    axis_z: f64,
    half_width: f64,
    half_depth: f64,
    bottom: f64,
    top: f64,
    waist: f64,
    fade: f64,
    /// Middle of the head.
    head: DVec3,
    /// Centre of the head relative to the skull's joint, skull axes, metres.
    head_in_skull: DVec3,
    head_half_axes: DVec3,
    /// Stature over 1.7 m.
    scale: f64,
    /// Room that a wrist needs.
    hand: f64,
    shape: Option<TrunkShape>,
}

impl BodySpace {
    /// Measures a skeleton; without a shape its trunk is of average build.
    #[must_use]
    pub fn new(skeleton: &Skeleton, shape: Option<TrunkShape>) -> Self {
        let zero = Pose::zero();
        let at = |bone| world_from_bone(skeleton, &zero, bone).translation;
        let scale = skeleton.scale();
        let skull = world_from_bone(skeleton, &zero, Bone::Skull);
        // The skull bone ends the neck; the head's middle is above and before it.
        let to_head = DVec3::new(0.0, 0.075, 0.03) * scale;
        Self {
            axis_z: 0.5 * (at(Bone::LShoulder).z + at(Bone::Lumbar).z),
            half_width: TRUNK_HALF_AXES_M[0] * scale,
            half_depth: TRUNK_HALF_AXES_M[1] * scale,
            bottom: at(Bone::LHip).y - 0.12 * scale,
            top: at(Bone::LShoulder).y,
            waist: at(Bone::Lumbar).y,
            fade: 0.08 * scale,
            head: skull.translation + to_head,
            head_in_skull: rotation_of(&skull).inverse() * to_head,
            scale,
            head_half_axes: DVec3::from_array(HEAD_HALF_AXES_M) * scale,
            hand: HAND_RADIUS_M * scale,
            shape,
        }
    }

    /// Returns the ratio of the figure's stature to 1.7 m.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Returns the centre of the head in the zero pose, world, metres.
    #[must_use]
    pub fn head(&self) -> DVec3 {
        self.head
    }

    /// Returns the centre of the head relative to the skull's joint, skull axes, metres.
    #[must_use]
    pub fn head_in_skull(&self) -> DVec3 {
        self.head_in_skull
    }

    /// Returns the half width of the column around the trunk that a wrist must stay out of, metres;
    /// includes the thickness of the hand.
    #[must_use]
    pub fn wrist_column_half_width_m(&self) -> f64 {
        self.half_width + self.hand
    }

    /// Returns the greatest z at height `y` of the column that a wrist must stay out of, world,
    /// metres.
    #[must_use]
    pub fn front_m(&self, y: f64) -> f64 {
        self.axis_z + self.depth_m(y) + self.hand
    }

    /// Returns the least z at height `y` of the column that a wrist must stay out of, world,
    /// metres.
    #[must_use]
    pub fn back_m(&self, y: f64) -> f64 {
        self.axis_z - self.rear_m(y) - self.hand
    }

    /// Returns the height of the waist in the zero pose, world, metres.
    #[must_use]
    pub fn waist_m(&self) -> f64 {
        self.waist
    }

    /// Returns the fractional index of a height among the measured heights.
    fn level(&self, y: f64) -> f64 {
        (y - self.bottom) / (self.top - self.bottom) * (LEVELS - 1) as f64
    }

    /// Returns the distance of the trunk's front from its axis at a height, metres.
    fn depth_m(&self, y: f64) -> f64 {
        self.depth_of(y, |shape| &shape.depths_m)
    }

    /// Returns the distance of the trunk's back from its axis at a height, metres.
    fn rear_m(&self, y: f64) -> f64 {
        self.depth_of(y, |shape| &shape.backs_m)
    }

    fn depth_of(&self, y: f64, side: fn(&TrunkShape) -> &[f64; LEVELS]) -> f64 {
        let Some(shape) = &self.shape else {
            return self.half_depth;
        };
        let depths_m = side(shape);
        let level = self.level(y).clamp(0.0, (LEVELS - 1) as f64);
        let below = (level as usize).min(LEVELS - 2);
        let [a, b] = [depths_m[below], depths_m[below + 1]];
        a + (b - a) * (level - below as f64)
    }

    /// Returns the nearest wrist position (world of the zero pose, metres) outside the ellipsoids of
    /// trunk and head. Positions farther out than a few hundredths of their half axes are unchanged.
    #[must_use]
    pub fn project_outside(&self, p: DVec3) -> DVec3 {
        self.project(p, self.hand)
    }

    /// Returns the displacement out of trunk and head for a point with clearance `room_m`; zero
    /// outside.
    #[must_use]
    pub fn exit_displacement(&self, p: DVec3, room_m: f64) -> DVec3 {
        self.project(p, room_m) - p
    }

    /// Returns the depth in the trunk of a point with clearance `room_m`, as a share of the half
    /// axes: 1 in the middle, 0 outside.
    pub(super) fn depth_in_trunk(&self, p: DVec3, room_m: f64) -> f64 {
        // Most of an arm is next to the trunk, where its depth is not needed.
        if p.x.abs() >= self.half_width + room_m {
            return 0.0;
        }
        let [half_width, half_depth] = self.half_axes_at(p, room_m);
        let (x, z) = (p.x / half_width, (p.z - self.axis_z) / half_depth);
        let square = x * x + z * z;
        if square >= 1.0 {
            0.0
        } else {
            (1.0 - square.sqrt()) * self.height_share(p.y)
        }
    }

    /// Returns the half axes of the column around a point with clearance `room`.
    fn half_axes_at(&self, p: DVec3, room: f64) -> [f64; 2] {
        let depth = if p.z > self.axis_z {
            self.depth_m(p.y)
        } else {
            self.rear_m(p.y)
        };
        [self.half_width + room, depth + room]
    }

    /// Returns the displacement of a wrist out of the body.
    #[must_use]
    pub fn wrist_exit_displacement(&self, p: DVec3) -> DVec3 {
        self.exit_displacement(p, self.hand)
    }

    fn project(&self, p: DVec3, room: f64) -> DVec3 {
        let p = self.out_of_head(p, room);
        let [half_width, half_depth] = self.half_axes_at(p, room);
        let (x, z) = (p.x / half_width, (p.z - self.axis_z) / half_depth);
        let r = ops::hypot(x, z);
        let grown = self.height_share(p.y);
        if r >= grown * (1.0 + EDGE) {
            return p;
        }
        let target = grown * eased(r / grown);
        // On the axis itself the hand leaves to the front.
        let (ux, uz) = if r > 1e-9 { (x / r, z / r) } else { (0.0, 1.0) };
        DVec3::new(
            ux * target * half_width,
            p.y,
            self.axis_z + uz * target * half_depth,
        )
    }

    fn out_of_head(&self, p: DVec3, room: f64) -> DVec3 {
        let half_axes = self.head_half_axes + DVec3::splat(room);
        let v = (p - self.head) / half_axes;
        let r = v.magnitude();
        let target = eased(r);
        if target <= r {
            return p;
        }
        let u = if r > 1e-9 { v / r } else { DVec3::Z };
        self.head + u * target * half_axes
    }

    /// Returns the effect of the trunk at height `y`: 1 along the trunk, fading to 0 above the
    /// shoulders and below the hips.
    fn height_share(&self, y: f64) -> f64 {
        let above = 1.0 - smooth((y - self.top) / self.fade);
        let below = smooth((y - self.bottom + self.fade) / self.fade);
        above * below
    }
}

/// Returns max(r, 1) with its corner rounded within ±[`EDGE`].
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
        let space = BodySpace::new(&Skeleton::example(), None);
        let mut moved = 0;
        for i in 0..5_000 {
            let r = |k| noise::signed(2, k, i);
            let p = DVec3::new(0.5 * r(0), 1.3 + 0.6 * r(1), 0.5 * r(2));
            let q = space.project_outside(p);
            assert!(space.wrist_exit_displacement(q).length() < 0.012, "{p} {q}");
            if q != p {
                moved += 1;
                let near = DVec3::new(p.x / 0.30, 0.0, (p.z - space.axis_z) / 0.25).length();
                let half_axes = space.head_half_axes + DVec3::splat(space.hand);
                let head = ((p - space.head) / half_axes).length();
                assert!(
                    near < 1.05 || head < 1.05,
                    "the points near the boundary are outside the body"
                );
            }
        }
        assert!(
            moved > 100,
            "a moved point is at the surface of trunk or head"
        );
    }

    #[test]
    fn keeping_out_is_continuous() {
        let space = BodySpace::new(&Skeleton::example(), None);
        for i in 0..5_000 {
            let r = |k| noise::signed(3, k, i);
            let p = DVec3::new(0.35 * r(0), 1.3 + 0.6 * r(1), 0.05 + 0.3 * r(2).abs());
            let q = p + DVec3::new(1e-5, 1e-5, -1e-5);
            let d = space.project_outside(p).distance(space.project_outside(q));
            // Near the axis a column magnifies; hands pass it only by explicit keys.
            if ops::hypot(p.x, p.z - space.axis_z) > 0.06 && p.distance(space.head) > 0.06 {
                assert!(d < 30.0 * p.distance(q), "{p}: {d}");
            }
        }
    }
}
