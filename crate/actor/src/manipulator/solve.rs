//! Solutions of limbs and head for their goals at one time: by the goal alone, by the mean of the
//! last goals, or by the recorded path.

use raconteur_base::curve::smooth;
use raconteur_base::{DAffine3, DQuat, DVec3, Length, ops};
use raconteur_body::{Bone, Pose, Skeleton};

use super::aim::FORCED;
use super::aim::ReachTarget;
use super::head::HEAD_BONES;
use super::motion::MotionGoal;
use super::perform::Manipulators;
use super::scene::FigureState;
use super::smoothing::{nearest, spline};
use crate::limb::ARM_BONES;
use crate::limb::chain::{END, LimbBase, PosedLimb, ROLL};
use crate::limb::limits;
use crate::limb::solve::{AT_EASE, SolutionCriteria, choose, matrix_error};
use crate::limb::swivel::{JointPreference, SwivelCriteria};
use crate::limb::{Joints, Limb, RigidFrame};

/// Rotation error of a hand or foot, radians, above which it no longer influences elbow or knee:
/// its least strain would change with every sway of the body.
const HOPELESS: f64 = 1.0;
/// Smallest correction, radians.
const MENDED: f64 = 1e-3;
/// Distance from the target that counts as a radian, metres.
const FORCED_M: f64 = 0.15;
/// Spacing of the even times whose goals are averaged, seconds: a limb changes between deviations
/// from its target within about three of them, and lags by two. Designed: as quick as a quick
/// movement.
const EVEN_SECS: f64 = 1.0 / 20.0;

/// Options for solving a limb: weights of joint limits and girdle motion, swivel angle and joint
/// preference.
#[derive(Clone, Copy, Debug)]
pub(super) struct SolveOptions {
    /// Weight of the joint limits.
    pub(super) limited: f64,
    /// Share by which the girdle follows the arm instead of its previous motion.
    pub(super) set_in: f64,
    /// Swivel from the natural direction; `None` uses the best one.
    pub(super) swivel_rad: Option<f64>,
    /// The user's preference.
    pub(super) preference: JointPreference,
}

/// Conditions for the joints that bring a limb to a frame: swivel angle, weight of the limits, and
/// joints to stay near.
#[derive(Clone, Copy, Debug)]
pub(super) struct ReachRequest<'a> {
    /// Swivel angle of elbow or knee, radians from the natural direction.
    pub(super) swivel_rad: f64,
    /// Weight of the joint limits, 0 to 1.
    pub(super) limited: f64,
    /// Joints that the solution should be near; `None` chooses the most comfortable.
    pub(super) current: Option<&'a Joints>,
}

/// Solution of a limb closest to a goal: joints and bones, with the corrections that limits forced.
#[derive(Clone, Copy, Debug)]
pub(super) struct LimbSolution {
    pub(super) base: LimbBase,
    /// Correction of the upper bone by its limits, and of a too near target to the distance of the
    /// bent limb: radians, and lengths as [`FORCED_M`] to a radian.
    forced: f64,
    /// Correction of wrist or ankle by their limits, radians.
    forced_end: f64,
    pub(super) posed: PosedLimb,
    /// The scapula's rotation, of an arm.
    pub(super) scapula: Option<DQuat>,
    /// Joints of the solution.
    pub(super) joints: Joints,
    /// Cue that the girdle followed, trunk axes, metres.
    pub(super) cue: DVec3,
    pub(super) target: RigidFrame,
}

impl LimbSolution {
    /// Returns the deviation of the limb and of its end from the target because of limits or reach,
    /// radians. The part of the end beyond [`HOPELESS`] counts for the whole limb.
    pub(super) fn forced_by(&self) -> [f64; 2] {
        let limb = self.forced.max(self.forced_end - HOPELESS);
        [limb, self.forced.max(self.forced_end)]
    }
}

impl Manipulators {
    /// Solves the goal of a limb at a time, or follows its smoothed path.
    pub(super) fn solve_at(
        &self,
        limb: Limb,
        goal: &MotionGoal,
        time_secs: f64,
        skeleton: &Skeleton,
        pose: &Pose,
    ) -> LimbSolution {
        let mut met = self.solve_static(limb, goal, time_secs, skeleton, pose);
        let rig = self.limbs.get(limb.index());
        if let Some(lead) = self.steady[limb.index()].sample(time_secs, rig) {
            let near = nearest(&lead.joints, &met.joints, rig);
            let [limb_forced, end_forced] = met.forced_by();
            let share = |i: usize, forced: f64| {
                lead.weights[i].max(lead.weight_unmet * smooth(forced / FORCED))
            };
            let (even, even_end) = (share(0, limb_forced), share(1, end_forced));
            for (i, (joint, near)) in met.joints.iter_mut().zip(near).enumerate() {
                let even = if END.contains(&i) { even_end } else { even };
                *joint += even * (near - *joint);
            }
            met.posed = self.posed(limb, &met.joints, &met.base);
        }
        met
    }

    /// Blends the bones of a limb towards its solution by a share.
    pub(super) fn place(&self, limb: Limb, met: &LimbSolution, weight: f64, pose: &mut Pose) {
        if let (Some(scapula), Some(bones)) = (met.scapula, ARM_BONES.get(limb.index())) {
            blend(pose, bones[0], scapula, weight);
        }
        let bones = match self.limbs.get(limb.index()) {
            Some(rig) => &rig.bones[..],
            None => &HEAD_BONES,
        };
        for (bone, rotation) in bones.iter().zip(met.posed.rotations) {
            blend(pose, *bone, rotation, weight);
        }
    }

    /// Solves the goal of a limb at a time from that goal alone.
    ///
    /// Joints that reach their target turn as steadily as it does. Joints that cannot, because of
    /// their limits or their reach, may have to switch from one way of missing it to another. They
    /// then take the mean of the last goals, by a cubic B-spline over uniformly spaced times. The
    /// result is smooth for any goals in between, and stays within limits.
    pub(super) fn solve_static(
        &self,
        limb: Limb,
        goal: &MotionGoal,
        time_secs: f64,
        skeleton: &Skeleton,
        pose: &Pose,
    ) -> LimbSolution {
        let moment = FigureState { skeleton, pose };
        let track = &self.tracks[limb.index()];
        let mut terms = self.terms_at(limb, time_secs);
        let recent = self.recent(limb, time_secs);
        if matches!(goal, MotionGoal::Frame { .. }) {
            terms.swivel_rad = self.steady_swivel(limb, goal, &recent, &terms, moment);
        }
        let mut met = self.solve(limb, goal, &terms, None, moment);
        let even = smooth(met.forced / FORCED);
        let even_end = even.max(smooth(met.forced_end / FORCED));
        let mut mean = [0.0; 7];
        for (goal, weight) in &recent {
            if even_end <= 0.0 {
                break;
            }
            let mut other = match goal {
                Some(goal) => self.solve(limb, goal, &terms, None, moment).joints,
                None => met.joints,
            };
            if let Some(rig) = self.limbs.get(limb.index()) {
                other = rig.alike(&other, &met.joints, terms.limited >= 0.5);
            }
            for (i, sum) in mean.iter_mut().enumerate() {
                // Within limits, every mean is within them; without limits, the shorter rotation
                // applies.
                let free = terms.limited < 0.5 || i == ROLL;
                let angle = if free {
                    met.joints[i] + ops::wrap_angle(other[i] - met.joints[i])
                } else {
                    other[i]
                };
                *sum += weight * angle;
            }
        }
        for (i, (joint, mean)) in met.joints.iter_mut().zip(mean).enumerate() {
            let even = if END.contains(&i) { even_end } else { even };
            *joint += even * (mean - *joint);
        }
        if let Some(mend) = track.correct_start(time_secs) {
            if let Some(rig) = self.limbs.get(limb.index()) {
                rig.turn_upper(mend.upper, &mut met.joints);
            }
            for (joint, mend) in met.joints.iter_mut().zip(mend.joints) {
                *joint += mend;
            }
            // The compensation limits the approach to the target as joint limits do.
            let turn = mend.upper.angle_between(DQuat::IDENTITY);
            let off = mend
                .joints
                .iter()
                .fold(turn, |sum, joint| sum + joint.abs());
            if off > MENDED {
                met.forced += off;
            }
        }
        met.joints = self.clamp_joints(limb, terms.limited, &met.joints);
        met.posed = self.posed(limb, &met.joints, &met.base);
        met
    }

    /// Returns the swivel of a goal of a limb at a time, without the offset of its course.
    pub(super) fn swivel_at(
        &self,
        limb: Limb,
        goal: &MotionGoal,
        time_secs: f64,
        skeleton: &Skeleton,
        pose: &Pose,
    ) -> Option<f64> {
        let terms = self.terms_at(limb, time_secs);
        let recent = self.recent(limb, time_secs);
        let moment = FigureState { skeleton, pose };
        self.steady_swivel(limb, goal, &recent, &terms, moment)
    }

    fn terms_at(&self, limb: Limb, time_secs: f64) -> SolveOptions {
        let track = &self.tracks[limb.index()];
        let set_in = track.set_in(time_secs);
        SolveOptions {
            limited: track.limited(time_secs) * set_in,
            set_in,
            swivel_rad: None,
            preference: track.preference(time_secs),
        }
    }

    /// Returns the goals of a limb at the last even times up to a time, with their weights. Later
    /// ones would let a command act before its time.
    fn recent(&self, limb: Limb, time_secs: f64) -> [(Option<MotionGoal>, f64); 4] {
        let step = (time_secs / EVEN_SECS).floor();
        let weights = spline(time_secs / EVEN_SECS - step);
        [0, 1, 2, 3].map(|k| {
            let even_secs = (step + f64::from(k) - 3.0) * EVEN_SECS;
            let at = self.tracks[limb.index()].begun_by(time_secs, even_secs);
            (
                self.goal(limb, at).map(|(goal, _)| goal),
                weights[k as usize],
            )
        })
    }

    /// Returns the swivel of elbow or knee at a time: the mean of the last best ones, which may
    /// change quickly from one side of an obstacle to the other. `None` for the head.
    fn steady_swivel(
        &self,
        limb: Limb,
        goal: &MotionGoal,
        recent: &[(Option<MotionGoal>, f64); 4],
        terms: &SolveOptions,
        moment: FigureState<'_>,
    ) -> Option<f64> {
        let FigureState { skeleton, pose } = moment;
        let rig = self.limbs.get(limb.index())?;
        let trunk = self.trunk(limb, skeleton, pose);
        let (_, _, base) = self.pose_girdle(limb, goal, terms.set_in, &trunk, pose);
        let obstacles = self.obstacles(limb, &trunk, skeleton, pose);
        let comfort = SwivelCriteria {
            obstacles: obstacles.as_ref(),
            preference: terms.preference,
            is_relaxed: false,
        };
        let mut mean = 0.0;
        for (at, weight) in recent {
            let frame = match at.as_ref().unwrap_or(goal) {
                MotionGoal::Joints(held, _) => rig.posed(&held.joints, &base).frame,
                MotionGoal::Frame { frame, .. } => *frame,
            };
            let near = self.projected(limb, &frame, &base, terms.limited);
            mean += weight * rig.swivel_for(&near, &base, &comfort);
        }
        Some(mean)
    }

    /// Returns the girdle's cue (trunk axes, metres), the scapula's rotation, if any, and the base
    /// of a limb driven by a goal on a trunk.
    fn pose_girdle(
        &self,
        limb: Limb,
        goal: &MotionGoal,
        set_in: f64,
        trunk: &DAffine3,
        pose: &Pose,
    ) -> (DVec3, Option<DQuat>, LimbBase) {
        let cue = match goal {
            MotionGoal::Joints(held, aim) => held.cued(aim.as_ref(), trunk),
            MotionGoal::Frame { frame, cue_lag, .. } => {
                trunk.inverse().transform_point3(frame.position) + *cue_lag
            }
        };
        let scapula = self.arms.get(limb.index()).map(|arm| {
            let wanted = arm
                .girdle()
                .scapula_for(trunk, trunk.transform_point3(cue), 0.0);
            let [bone, ..] = ARM_BONES[limb.index()];
            pose.rotation(bone).slerp(wanted, set_in)
        });
        (cue, scapula, self.base(limb, trunk, scapula))
    }

    /// Solves a goal of a limb as closely as possible. Of several solutions the one nearest to
    /// `current`, or the most comfortable, is chosen.
    pub(super) fn solve(
        &self,
        limb: Limb,
        goal: &MotionGoal,
        terms: &SolveOptions,
        current: Option<&Joints>,
        moment: FigureState<'_>,
    ) -> LimbSolution {
        let FigureState { skeleton, pose } = moment;
        let trunk = self.trunk(limb, skeleton, pose);
        let (cue, scapula, base) = self.pose_girdle(limb, goal, terms.set_in, &trunk, pose);
        let mut forced = [0.0; 2];
        let (joints, target) = match goal {
            MotionGoal::Joints(held, aim) => {
                let joints = match aim {
                    Some(aim) => {
                        let aimed = self.aimed(limb, aim, &held.joints, terms.limited, &base);
                        self.clamp_joints(limb, terms.limited, &aimed)
                    }
                    None => limits::clamp_joints(self.limits(limb), terms.limited, &held.joints),
                };
                (joints, aim.as_ref().and_then(ReachTarget::target))
            }
            MotionGoal::Frame {
                frame, swivel_rad, ..
            } => {
                let swivel = terms.swivel_rad.unwrap_or_else(|| {
                    let obstacles = self.obstacles(limb, &trunk, skeleton, pose);
                    let near = self.projected(limb, frame, &base, terms.limited);
                    let rig = self.limbs.get(limb.index());
                    let comfort = SwivelCriteria {
                        obstacles: obstacles.as_ref(),
                        preference: terms.preference,
                        is_relaxed: false,
                    };
                    rig.map_or(0.0, |rig| rig.swivel_for(&near, &base, &comfort))
                });
                let wish = ReachRequest {
                    swivel_rad: swivel + swivel_rad,
                    limited: terms.limited,
                    current,
                };
                let joints;
                (joints, forced) = self.solved(limb, frame, &wish, &base);
                (joints, Some(*frame))
            }
        };
        let posed = self.posed(limb, &joints, &base);
        LimbSolution {
            base,
            forced: forced[0],
            forced_end: forced[1],
            joints,
            cue,
            scapula,
            target: target.unwrap_or(posed.frame),
            posed,
        }
    }
}

impl Manipulators {
    /// Returns the joints that bring a limb to a frame, or as near as reach and limits allow, and
    /// the corrections of its upper bone and its end, radians.
    pub(super) fn solved(
        &self,
        limb: Limb,
        frame: &RigidFrame,
        wish: &ReachRequest<'_>,
        base: &LimbBase,
    ) -> (Joints, [f64; 2]) {
        let ReachRequest {
            swivel_rad,
            limited,
            current,
        } = *wish;
        let rig = self.limbs.get(limb.index());
        let choice = SolutionCriteria {
            limited,
            current,
            preferred: &AT_EASE,
        };
        let near = self.projected(limb, frame, base, limited);
        let found = self.solutions(limb, &near, base, swivel_rad);
        let error = |raw: &Joints, kept: &Joints| match rig {
            Some(rig) => rig.error(raw, kept, &near, base),
            None => matrix_error(&self.head.posed(kept, base).frame, &near),
        };
        let keep = |raw: &Joints| self.clamp_joints(limb, limited, raw);
        let (index, joints) = choose(&found, &choice, &keep, &error).unwrap_or((0, AT_EASE));
        let mut forced = [0.0; 2];
        if let Some(raw) = found.as_slice().get(index) {
            let off_m = |frame: &RigidFrame| frame.position.distance_to(base.origin);
            let inside = (off_m(&near) - off_m(frame)).max(0.0) / FORCED_M;
            forced = match rig {
                Some(rig) => rig.bent(raw, &joints),
                None => [self.head.turned(raw, &joints); 2],
            };
            forced[0] += if limb == Limb::Head { 0.0 } else { inside };
        }
        (joints, forced)
    }
}

/// Rotates a bone by a share.
fn blend(pose: &mut Pose, bone: Bone, rotation: DQuat, weight: f64) {
    let to = if weight >= 1.0 {
        rotation
    } else {
        pose.rotation(bone).slerp(rotation, weight)
    };
    pose.set(bone, to.normalized());
}
