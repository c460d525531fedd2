//! Inverse kinematics in closed form: all joint angles that bring a limb's end to a target, by
//! kinematic decoupling, and the selection of one solution (GEVH section 3.3.2.1 and fig. 3.6).
//!
//! The last three axes meet in the end effector, so its position depends on the first joints alone
//! and is solved first; the last three then set the orientation.

use core::f64::consts::PI;

use raconteur_base::{DMat3, DQuat, DVec3, Length, METRES_PER_INCH, ops};

use super::chain::{LimbBase, LimbRig, ROLL};
use super::{Joints, RigidFrame, limits};

/// Maximum number of joint-angle sets for one target: two flexions, two solutions of the shoulder
/// and two of the wrist.
pub const MAX_SOLUTIONS: usize = 8;

/// Joint angle sets that reach a target, found by inverse kinematics in closed form.
#[derive(Clone, Copy, Debug, Default)]
pub struct Solutions {
    joints: [Joints; MAX_SOLUTIONS],
    count: usize,
}

impl Solutions {
    /// Returns the joint angle sets, each angle in −π..π.
    #[must_use]
    pub fn as_slice(&self) -> &[Joints] {
        &self.joints[..self.count]
    }

    pub(crate) fn push(&mut self, joints: Joints) {
        if let Some(slot) = self.joints.get_mut(self.count) {
            *slot = joints;
            self.count += 1;
        }
    }

    /// Adds every combination of shoulder solutions (joints 1, 2 and 7) and wrist solutions.
    pub(crate) fn push_combinations(
        &mut self,
        shoulder: [[f64; 3]; 2],
        flexion: f64,
        wrist: &[[f64; 3]],
    ) {
        for s in shoulder {
            for w in wrist {
                self.push([s[0], s[1], flexion, w[0], w[1], w[2], s[2]]);
            }
        }
    }
}

/// Criteria for choosing one of several joint angle sets, in the order of the filters in GEVH.
#[derive(Clone, Copy, Debug)]
pub struct SolutionCriteria<'a> {
    /// Weight of the joint limits, 0 to 1.
    pub limited: f64,
    /// Current angles of the limb; among equally exact solutions the one with the least variation
    /// is chosen.
    pub current: Option<&'a Joints>,
    /// The angles that are preferred where there is no current configuration.
    pub preferred: &'a Joints,
}

/// A limb hanging or standing slightly bent: the default preference.
pub const AT_EASE: Joints = [0.2, 0.2, 0.3, 0.0, 0.0, 0.0, 0.0];

/// Targets within this share of the square of a rotation's elements count as met alike.
const ALIKE: f64 = 1e-9;

impl LimbRig {
    /// Returns the joint angles of bones, the inverse of [`LimbRig::posed`]: all combinations of
    /// two shoulder and two wrist solutions, each angle in −π..π.
    #[must_use]
    pub fn joints_of(&self, rotations: [DQuat; 3], base: &LimbBase) -> Solutions {
        let upper = base.parent * self.upper_zero * rotations[0];
        let link = base.rotation.inverse() * upper * self.link_from_upper.inverse();
        let turn = self.target_from_end * rotations[2] * self.target_from_end.inverse();
        let flexion = self.chain.flexion_of(rotations[1]);
        let mut found = Solutions::default();
        found.push_combinations(self.shoulder_angles(link), flexion, &self.turn_angles(turn));
        found
    }

    /// Projects a position (from the base, metres) to the nearest one in reach, and returns true if
    /// it moved: to the sphere of the stretched limb, or of the most bent one. `limited` is the
    /// weight of the elbow limit, 0 to 1.
    #[must_use]
    pub fn projected(&self, from_base: DVec3, limited: f64) -> (DVec3, bool) {
        let free = self.distances_m(false);
        let kept = self.distances_m(true);
        let [shortest, longest] = [0, 1].map(|i| free[i] + limited * (kept[i] - free[i]));
        let distance = from_base.magnitude();
        if (shortest..=longest).contains(&distance) {
            return (from_base, false);
        }
        let direction = from_base.try_normalized().unwrap_or(DVec3::NEG_Y);
        (direction * distance.clamp(shortest, longest), true)
    }

    /// Returns all solutions of the six joints of table 3.1, with the seventh 0: up to eight, none
    /// if the swivel of the table cannot reach. The target is in reach, figure axes.
    #[must_use]
    pub fn table_solutions(&self, target: &RigidFrame, base: &LimbBase) -> Solutions {
        let mut found = Solutions::default();
        let p = base.rotation.inverse() * (target.position - base.origin);
        for flexion in self.chain.flexions_for(p.magnitude()) {
            // The end in the table's second frame; off its plane by a hair.
            let end = self.link_from_upper * self.chain.end_in_upper(flexion);
            let level = (end.x * end.x + end.y * end.y).sqrt();
            if level <= 0.0 {
                continue;
            }
            let lift = ops::asin_clamped(p.z / level);
            let own = ops::atan2(end.y, end.x);
            for raised in [lift, PI - lift] {
                let out = level * ops::cos(raised);
                let first = ops::atan2(p.y, p.x) - ops::atan2(-end.z, out);
                let joints = [
                    self.sign * ops::wrap_angle(first),
                    ops::wrap_angle(raised - own),
                    flexion,
                    0.0,
                    0.0,
                    0.0,
                    0.0,
                ];
                self.complete(&joints, target.rotation, base, &mut found);
            }
        }
        found
    }

    /// Returns all solutions with the elbow or knee in a given direction from the line between base
    /// and target (figure axes, unit, perpendicular to that line): eight, or the two that no limit
    /// excludes, with the elbow bent the natural way and joint 5 within a right angle. The target
    /// is in reach.
    #[must_use]
    pub fn solutions(
        &self,
        target: &RigidFrame,
        elbow: DVec3,
        base: &LimbBase,
        natural_only: bool,
    ) -> Solutions {
        let mut found = Solutions::default();
        let p = target.position - base.origin;
        let direction = p.try_normalized().unwrap_or(base.rotation * DVec3::X);
        let flexions = self.chain.flexions_for(p.magnitude());
        let ways = if natural_only { 1 } else { 2 };
        for (flexion, side) in flexions.into_iter().zip([1.0, -1.0]).take(ways) {
            let upper = self.chain.aim(flexion, direction, elbow * side);
            let link = base.rotation.inverse() * upper * self.link_from_upper.inverse();
            let wrist = self.wrist_for(upper, flexion, target.rotation);
            let shoulder = self.shoulder_angles(link);
            found.push_combinations(shoulder, ops::wrap_angle(flexion), &wrist[..ways]);
        }
        found
    }

    /// Returns both solutions for the wrist angles, radians, for a rotation of the upper bone
    /// (figure axes), a flexion of the hinge and a target rotation.
    fn wrist_for(&self, upper: DQuat, flexion: f64, rotation: DQuat) -> [[f64; 3]; 2] {
        let lower = upper * self.chain.zero() * self.chain.flexed(flexion);
        self.turn_angles((lower * self.lower_from_target).inverse() * rotation)
    }

    /// Adds both wrist solutions to joints 1 to 3.
    fn complete(&self, joints: &Joints, rotation: DQuat, base: &LimbBase, into: &mut Solutions) {
        let upper = base.rotation * self.link(joints) * self.link_from_upper;
        for wrist in self.wrist_for(upper, joints[2], rotation) {
            let mut all = *joints;
            all[2] = ops::wrap_angle(all[2]);
            all[3..ROLL].copy_from_slice(&wrist);
            into.push(all);
        }
    }

    /// Chooses one of the solutions for a target, see [`choose`].
    #[must_use]
    pub fn choose(
        &self,
        solutions: &Solutions,
        target: &RigidFrame,
        base: &LimbBase,
        choice: &SolutionCriteria<'_>,
    ) -> Option<Joints> {
        let error = |raw: &Joints, kept: &Joints| self.error(raw, kept, target, base);
        let keep = |raw: &Joints| self.clamp_joints(choice.limited, raw);
        choose(solutions, choice, &keep, &error).map(|(_, kept)| kept)
    }

    /// Moves joints towards their limits by a share. A shoulder or hip that was clamped rotates its
    /// bone axially so elbow or knee stay in place as far as possible: where the bone points along
    /// the first axis, that angle is undefined, and the bone must not rotate with it.
    #[must_use]
    pub fn clamp_joints(&self, share: f64, joints: &Joints) -> Joints {
        let mut kept = limits::clamp_joints(&self.limits, share, joints);
        if !(same(kept[0], joints[0]) && same(kept[1], joints[1])) {
            let off = self.link(&kept).inverse() * self.link(joints);
            kept[ROLL] += self.sign * 2.0 * ops::atan2(off.x, off.w);
        }
        kept
    }

    /// Returns the rotation of the upper bone and of the end caused by clamping joints to their
    /// limits, radians; exactly 0 for unclamped joints.
    pub(crate) fn bent(&self, raw: &Joints, kept: &Joints) -> [f64; 2] {
        let is_kept = |joints: &[usize]| joints.iter().all(|&i| same(raw[i], kept[i]));
        let upper = || self.link(raw).angle_between(self.link(kept));
        let end = || self.turn(raw).angle_between(self.turn(kept));
        [
            if is_kept(&[0, 1, ROLL]) { 0.0 } else { upper() },
            if is_kept(&[3, 4, 5]) { 0.0 } else { end() },
        ]
    }

    /// Returns the joints with the shoulder or hip in whichever of its two solutions is nearer to
    /// other joints; the bones do not move. With limits, only a solution within them is used.
    pub(crate) fn alike(&self, joints: &Joints, to: &Joints, limited: bool) -> Joints {
        let mut turned = *joints;
        turned[0] = self.limits[0].wrapped(joints[0] + PI);
        turned[1] = self.limits[1].wrapped(PI - joints[1]);
        turned[ROLL] = joints[ROLL] + PI;
        let holds = |i: usize| self.limits[i].contains(turned[i]);
        if limited && !(holds(0) && holds(1)) || variation(&turned, to) >= variation(joints, to) {
            *joints
        } else {
            turned
        }
    }

    /// Rotates the upper bone further, in base axes. Of its two angle sets, the one that limits do
    /// not change, or change less, is chosen.
    pub(crate) fn turn_upper(&self, turn: DQuat, joints: &mut Joints) {
        let sets = self.shoulder_angles((turn * self.link(joints)).normalized());
        let [first, second] = sets.map(|[a, b, roll]| {
            let mut turned = *joints;
            (turned[0], turned[1], turned[ROLL]) = (a, b, roll);
            turned
        });
        let beyond = |set: &Joints| self.bent(set, &self.clamp_joints(1.0, set))[0];
        *joints = if beyond(&second) < beyond(&first) {
            second
        } else {
            first
        };
    }

    /// Returns the matrix error of clamped joints, relative to joints that meet the target.
    #[must_use]
    pub fn error(&self, raw: &Joints, kept: &Joints, target: &RigidFrame, base: &LimbBase) -> f64 {
        if [0, 1, 2, ROLL].iter().all(|&i| same(raw[i], kept[i])) {
            // The end effector is in place; the squared norm of its rotation matrix minus the
            // identity is 8 sin² of half the angle.
            let cosine = self.turn(raw).dot(self.turn(kept));
            return 8.0 * (1.0 - cosine * cosine).max(0.0);
        }
        matrix_error(&self.posed(kept, base).frame, target)
    }
}

/// Returns true if two angles are equal, up to full turns.
fn same(a: f64, b: f64) -> bool {
    ops::wrap_angle(a - b).abs() <= 1e-12
}

/// Chooses among solutions: first by matrix error with the joints within their limits (`keep`
/// clamps them by the weight of the limits, `error` returns the error of a solution's joints and
/// their clamped values), then by least variation or, without a current configuration, by
/// preference. Returns the solution's index and its clamped angles; `None` without solutions.
#[must_use]
pub fn choose(
    solutions: &Solutions,
    choice: &SolutionCriteria<'_>,
    keep: &dyn Fn(&Joints) -> Joints,
    error: &dyn Fn(&Joints, &Joints) -> f64,
) -> Option<(usize, Joints)> {
    let near = choice.current.unwrap_or(choice.preferred);
    let (mut least, mut varied) = (f64::INFINITY, f64::INFINITY);
    let mut best = None;
    for (index, joints) in solutions.as_slice().iter().enumerate() {
        let kept = keep(joints);
        let within = kept.iter().zip(joints).all(|(a, b)| same(*a, *b));
        let off = if within {
            0.0
        } else if least > 0.0 {
            error(joints, &kept)
        } else {
            continue;
        };
        let change = variation(&kept, near);
        if best.is_none() || off < least - ALIKE || (off < least + ALIKE && change < varied) {
            (least, varied) = (off, change);
            best = Some((index, kept));
        }
    }
    best
}

/// Returns the sum of the squared differences of two frames' matrices, with lengths in tenths of
/// the thesis's unit (an inch): a displaced wrist always weighs more than a turned one, so no
/// shoulder moves to improve the hand's rotation.
#[must_use]
pub fn matrix_error(a: &RigidFrame, b: &RigidFrame) -> f64 {
    let rotation = DMat3::from_quat(a.rotation) - DMat3::from_quat(b.rotation);
    let squares = |v: DVec3| v.length_squared();
    squares(rotation.x_axis)
        + squares(rotation.y_axis)
        + squares(rotation.z_axis)
        + squares((a.position - b.position) / (0.1 * METRES_PER_INCH))
}

/// Returns the sum of the squared differences of joint angles, each the short way round.
pub(crate) fn variation(a: &Joints, b: &Joints) -> f64 {
    let square = |(a, b): (&f64, &f64)| {
        let d = ops::wrap_angle(a - b);
        d * d
    };
    a.iter().zip(b).map(square).sum()
}
