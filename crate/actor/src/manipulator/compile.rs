//! Conversion from commands to motions: each command is resolved at the limb's position at its
//! start time.

use raconteur_base::order::sort_by_number;
use raconteur_base::{DAffine3, DVec3, ops};
use raconteur_body::{Pose, Skeleton};

use super::aim::ReachTarget;
use super::head::HEAD_BONES;
use super::jacobian::Twist;
use super::motion::{
    HeldLimb, JointCorrection, LimbMotion, MotionGoal, MotionKind, SETTLE_SECS, even_secs,
};
use super::path::TimedPath;
use super::perform::Manipulators;
use super::scan::Scan;
use super::scene::{CommandContext, FigureState};
use super::solve::SolveOptions;
use super::track::LimbTrack;
use super::{Command, JointSpeed, ManipulatorScript, Motion};
use crate::limb::ARM_BONES;
use crate::limb::chain::{LimbBase, ROLL};
use crate::limb::limits;
use crate::limb::solve::{AT_EASE, SolutionCriteria, Solutions, choose};
use crate::limb::{Joints, Limb, RigidFrame};

/// Longest time that inverse velocity is followed to a target, seconds.
const TARGET_SECS: f64 = 8.0;
/// Total time for which unending velocity motions of a performance are followed, seconds. Each
/// takes half of the remaining time, so every script is bounded in time and memory.
const VELOCITY_SECS: f64 = 1200.0;
/// Time over which a limb moving at a velocity is checked for snaps, seconds.
const SCANNED_SECS: f64 = 30.0;
/// Share of the remaining distance covered per second, and the highest speed.
const GAIN_HZ: f64 = 3.0;
const MAX_SPEED_M_PER_S: f64 = 0.7;
const MAX_SPEED_RAD_PER_S: f64 = 2.5;

/// State of a limb at one time: pose, base frame, joint angles and end frame; commands are resolved
/// from it.
pub(super) struct LimbState {
    /// Story time, seconds.
    pub(super) at_secs: f64,
    /// The figure just before the limb is moved.
    pub(super) pose: Pose,
    pub(super) trunk: DAffine3,
    pub(super) base: LimbBase,
    pub(super) joints: Joints,
    pub(super) frame: RigidFrame,
    pub(super) cue: DVec3,
    pub(super) lean: DVec3,
    pub(super) help: DVec3,
    /// Elbow or knee from the base, metres.
    pub(super) hinge: DVec3,
    /// Offset of the cue and the lean from those for the position.
    pub(super) cue_lag: DVec3,
    pub(super) lean_lag: [DVec3; 2],
}

impl LimbState {
    pub(super) fn held(&self) -> HeldLimb {
        HeldLimb {
            joints: self.joints,
            cue: self.cue,
            lean: self.lean,
            help: self.help,
        }
    }
}

impl Manipulators {
    /// Turns commands into motions, in order of time.
    pub(super) fn compile(
        &mut self,
        script: &ManipulatorScript,
        skeleton: &Skeleton,
        idle: &dyn Fn(f64, &mut Pose),
    ) {
        let scene = CommandContext { skeleton, idle };
        let finite = |c: &&Command| c.time_secs.is_finite();
        let mut commands: Vec<&Command> = script.commands.iter().filter(finite).collect();
        sort_by_number(&mut commands, |c| c.time_secs);
        let mut is_on = [true; 5];
        let mut velocity_secs = VELOCITY_SECS;
        let mut scan = Scan::new();
        let mut figure = self.root.motions().into_iter().peekable();
        for (i, command) in commands.iter().enumerate() {
            let at = command.time_secs;
            while let Some((from_secs, secs)) = figure.next_if(|(from_secs, _)| *from_secs <= at) {
                self.figure_moves(&mut scan, from_secs, secs, &scene);
            }
            self.follow_to(&mut scan, at, &scene);
            let on = &mut is_on[command.limb.index()];
            if let Motion::Configure {
                is_on: switch,
                limits,
                preferred,
            } = &command.motion
            {
                *on = switch.unwrap_or(*on);
                if !*on || limits.is_some() || preferred.is_some() {
                    self.wake(&mut scan, at, &scene);
                    scan.limb_moves(command.limb, at, SETTLE_SECS);
                }
                let track = &mut self.tracks[command.limb.index()];
                if !*on {
                    track.switch_control(at, false);
                }
                if let Some(limited) = limits {
                    track.switch_limits(at, *limited);
                }
                if let Some(preferred) = preferred {
                    track.prefer(at, preferred);
                }
            } else if *on {
                let next = commands[i + 1..]
                    .iter()
                    .find(|c| c.limb == command.limb && c.motion.moves());
                let until = next.map_or(f64::INFINITY, |c| c.time_secs);
                self.wake(&mut scan, at, &scene);
                if command.motion.cuts() {
                    scan.reset(command.limb);
                } else {
                    self.begin_scan(&scan, command.limb, &scene);
                }
                let is_velocity = matches!(command.motion, Motion::JacobianVelocity { .. });
                let most_secs = match is_velocity {
                    true => (until - at).min(0.5 * velocity_secs),
                    false => until - at,
                };
                self.begin(command, most_secs, &scene);
                let mut secs = self.tracks[command.limb.index()].rests_after_secs(at);
                if is_velocity {
                    velocity_secs -= most_secs.min(secs);
                    secs = secs.min(SCANNED_SECS);
                }
                scan.limb_moves(command.limb, at, secs);
            }
        }
        for (from_secs, secs) in figure {
            self.figure_moves(&mut scan, from_secs, secs, &scene);
        }
        self.follow_to(&mut scan, f64::INFINITY, &scene);
    }

    fn figure_moves(
        &mut self,
        scan: &mut Scan,
        from_secs: f64,
        secs: f64,
        scene: &CommandContext<'_>,
    ) {
        self.follow_to(scan, from_secs, scene);
        if self.tracks.iter().any(LimbTrack::in_control) {
            self.wake(scan, from_secs, scene);
            scan.figure_moves(from_secs, secs);
        }
    }

    fn begin(&mut self, command: &Command, most_secs: f64, scene: &CommandContext<'_>) {
        let (limb, at) = (command.limb, command.time_secs);
        let track = &mut self.tracks[limb.index()];
        match command.motion {
            Motion::Stop => {
                if track.in_control() {
                    track.brake(at);
                }
                return;
            }
            Motion::Lock(false) if !(track.in_control() && track.is_locked(at)) => return,
            _ => {}
        }
        let now = self.now(limb, at, scene);
        let kind = match &command.motion {
            Motion::Configure { .. } | Motion::Stop => return,
            Motion::Joints { angles, secs } => self.to_joints(limb, angles, *secs, &now),
            Motion::JointInterpolation { to, pace } => {
                self.interpolate_joints(limb, to, *pace, &now, scene)
            }
            Motion::FrameInterpolation { to, secs } => MotionKind::Line {
                from: now.frame,
                to: *to,
                secs: *secs,
            },
            Motion::Function(path) => MotionKind::Curve(TimedPath::new(path, &now.frame, false)),
            Motion::JacobianTarget(to) => {
                let secs = most_secs.min(TARGET_SECS);
                self.follow(limb, &now, secs, Some(to), &|frame| {
                    let left = Twist::between(frame, to);
                    Twist {
                        linear: (left.linear * GAIN_HZ).clamp_length_max(MAX_SPEED_M_PER_S),
                        angular: (left.angular * GAIN_HZ).clamp_length_max(MAX_SPEED_RAD_PER_S),
                    }
                })
            }
            Motion::JacobianVelocity { linear, angular } => {
                let twist = Twist {
                    linear: *linear,
                    angular: *angular,
                };
                self.follow(limb, &now, most_secs, None, &|_| twist)
            }
            Motion::Lock(true) => {
                let moved = self.root.sample(at).unwrap_or(DAffine3::IDENTITY);
                MotionKind::Lock(now.frame.moved(&moved))
            }
            Motion::Lock(false) => MotionKind::Joints {
                from: now.held(),
                to: now.held(),
                aim: None,
                secs: 0.0,
                even: false,
            },
        };
        let track = &mut self.tracks[limb.index()];
        if command.motion.cuts() {
            track.cut_control(at);
            self.steady[limb.index()].cuts_secs.push(at);
        } else {
            track.switch_control(at, true);
        }
        track.begin(
            at,
            LimbMotion {
                kind,
                swivel_rad: 0.0,
                cue_lag: now.cue_lag,
                lean_lag: now.lean_lag,
                mend: JointCorrection::default(),
            },
        );
        self.replace(limb, at, scene, &now);
    }

    /// Compensates for parts of a limb's previous state that its new course does not take over.
    fn replace(&mut self, limb: Limb, at: f64, scene: &CommandContext<'_>, now: &LimbState) {
        if let Some((goal @ MotionGoal::Frame { .. }, _)) = self.goal(limb, at) {
            if let Some(rig) = self.limbs.get(limb.index()) {
                let would = self.swivel_at(limb, &goal, at, scene.skeleton, &now.pose);
                let is = rig.swivel_of(now.hinge, &now.frame, &now.base);
                let off = ops::wrap_angle(is - would.unwrap_or(is));
                self.tracks[limb.index()].swivel_last(off);
            }
            let Some((goal, _)) = self.goal(limb, at) else {
                return;
            };
            let met = self.solve_static(limb, &goal, at, scene.skeleton, &now.pose);
            let limited = self.tracks[limb.index()].has_limits();
            let mut off = JointCorrection::default();
            for (i, off) in off.joints.iter_mut().enumerate() {
                let by = now.joints[i] - met.joints[i];
                *off = if limited { by } else { ops::wrap_angle(by) };
            }
            if let Some(rig) = self.limbs.get(limb.index()) {
                off.upper = rig.link(&now.joints) * rig.link(&met.joints).inverse();
                for joint in [0, 1, ROLL] {
                    off.joints[joint] = 0.0;
                }
            }
            self.tracks[limb.index()].correct_last(off);
        }
    }

    /// Returns the state of a limb at a time, from idle motion and the commands so far.
    fn now(&self, limb: Limb, time_secs: f64, scene: &CommandContext<'_>) -> LimbState {
        let skeleton = scene.skeleton;
        let upright = scene.idle(time_secs);
        let mut pose = upright.clone();
        let goal = self.goal(limb, time_secs);
        let leans = self.leans(skeleton, time_secs, &upright);
        let [lean, help] = leans.get(limb.index()).copied().unwrap_or_default();
        self.lean(skeleton, time_secs, &mut pose);
        self.first_limbs(limb.index(), skeleton, time_secs, &mut pose);
        let before = pose.clone();
        self.limbs(skeleton, time_secs, &mut pose);
        self.head(skeleton, time_secs, &mut pose);

        let trunk = self.trunk(limb, skeleton, &pose);
        let scapula = ARM_BONES.get(limb.index()).map(|b| pose.rotation(b[0]));
        let base = self.base(limb, &trunk, scapula);
        let joints = self.configuration(limb, &pose, &base);
        let frame = self.posed(limb, &joints, &base).frame;
        let place = trunk.inverse().transform_point3(frame.position);
        let cue = match goal {
            Some((MotionGoal::Joints(held, aim), _)) => held.cued(aim.as_ref(), &trunk),
            Some((MotionGoal::Frame { frame, cue_lag, .. }, _)) => {
                trunk.inverse().transform_point3(frame.position) + cue_lag
            }
            None => place,
        };
        let plain = MotionGoal::Frame {
            frame,
            swivel_rad: 0.0,
            cue_lag: DVec3::ZERO,
            lean_lag: [DVec3::ZERO; 2],
        };
        let own = self.lean_for(limb, &plain, skeleton, &upright);
        let other = leans
            .get(1 - limb.index().min(1))
            .map_or(DVec3::ZERO, |l| l[0]);
        let more = self.help_for(limb, &plain, [lean, other], skeleton, &upright);
        let lean_lag = [lean - own, help - more];
        // The position of elbow or knee.
        let hinge = self.limbs.get(limb.index()).map_or(DVec3::ZERO, |rig| {
            rig.hinge_at(pose.rotation(rig.bones[0]), &base) - base.origin
        });
        LimbState {
            at_secs: time_secs,
            pose: before,
            trunk,
            base,
            joints,
            frame,
            cue,
            lean,
            help,
            hinge,
            cue_lag: cue - place,
            lean_lag,
        }
    }

    /// Returns the joint angles of a limb in a pose. Of equivalent solutions, it takes the one
    /// within the limits and nearest to the middle of the ranges.
    pub(super) fn configuration(&self, limb: Limb, pose: &Pose, base: &LimbBase) -> Joints {
        let found: Solutions = match self.limbs.get(limb.index()) {
            Some(rig) => rig.joints_of(rig.bones.map(|b| pose.rotation(b)), base),
            None => self
                .head
                .joints_of(HEAD_BONES.map(|b| pose.rotation(b)), base),
        };
        let choice = SolutionCriteria {
            limited: 1.0,
            current: None,
            preferred: &AT_EASE,
        };
        let keep = |raw: &Joints| limits::clamp_joints(self.limits(limb), 1.0, raw);
        // Angles that have to be bent are worse the more they are.
        let chosen = choose(&found, &choice, &keep, &|raw, kept| {
            let bends = raw
                .iter()
                .zip(kept)
                .map(|(a, b)| ops::wrap_angle(a - b).abs());
            bends.sum()
        });
        let index = chosen.map_or(0, |(index, _)| index);
        let raw = found.as_slice().get(index).copied().unwrap_or_default();
        limits::clamp_joints(self.limits(limb), 0.0, &raw)
    }

    /// Sets the given joint angles over some seconds or immediately.
    fn to_joints(
        &self,
        limb: Limb,
        angles: &[Option<f64>; 6],
        secs: f64,
        now: &LimbState,
    ) -> MotionKind {
        let mut to = now.held();
        for (joint, angle) in to.joints.iter_mut().zip(angles) {
            *joint = angle.unwrap_or(*joint);
        }
        // GEVH table 3.1 has no seventh joint: the first two joints determine the elbow or knee.
        if angles[0].is_some() && angles[1].is_some() {
            to.joints[ROLL] = 0.0;
        }
        if self.tracks[limb.index()].has_limits() {
            to.joints = limits::clamp_joints(self.limits(limb), 1.0, &to.joints);
        }
        // The girdle follows the wrist position that results from the girdle at rest.
        let rest = self.base(limb, &now.trunk, None);
        let end = self.posed(limb, &to.joints, &rest).frame.position;
        to.cue = now.trunk.inverse().transform_point3(end);
        (to.lean, to.help) = (DVec3::ZERO, DVec3::ZERO);
        if secs <= 0.0 {
            return MotionKind::Cut(to);
        }
        MotionKind::Joints {
            from: now.held(),
            to,
            aim: None,
            secs,
            even: false,
        }
    }

    /// Moves to the joint angles of a target, computed for the body at the end of the path.
    fn interpolate_joints(
        &self,
        limb: Limb,
        to: &RigidFrame,
        pace: JointSpeed,
        now: &LimbState,
        scene: &CommandContext<'_>,
    ) -> MotionKind {
        let (even, mut secs) = match pace {
            JointSpeed::Secs(secs) => (false, secs.max(0.0)),
            JointSpeed::RadPerSec(_) => (true, 0.0),
        };
        let (mut end, mut aim) = self.held_at(limb, to, now.at_secs + secs, now, scene);
        if let JointSpeed::RadPerSec(speed) = pace {
            // Slower motion is not visible.
            let speed = speed.max(1e-3);
            secs = even_secs(longest(&now.joints, &end.joints), speed);
            (end, aim) = self.held_at(limb, to, now.at_secs + secs, now, scene);
            secs = even_secs(longest(&now.joints, &end.joints), speed);
        }
        MotionKind::Joints {
            from: now.held(),
            to: end,
            aim: Some(Box::new(aim)),
            secs,
            even,
        }
    }

    /// Returns the joints that bring a limb to a target at a time, nearest to the present ones,
    /// with no other limb moving the body.
    fn held_at(
        &self,
        limb: Limb,
        to: &RigidFrame,
        time_secs: f64,
        now: &LimbState,
        scene: &CommandContext<'_>,
    ) -> (HeldLimb, ReachTarget) {
        let mut pose = scene.idle(time_secs);
        let goal = MotionGoal::Frame {
            frame: *to,
            swivel_rad: 0.0,
            cue_lag: DVec3::ZERO,
            lean_lag: [DVec3::ZERO; 2],
        };
        let lean = self.lean_for(limb, &goal, scene.skeleton, &pose);
        super::lean::apply(scene.skeleton, lean, &mut pose);
        let limited = self.tracks[limb.index()].has_limits();
        let terms = SolveOptions {
            limited: f64::from(u8::from(limited)),
            set_in: 1.0,
            swivel_rad: None,
            preference: self.tracks[limb.index()].preference(time_secs),
        };
        let moment = FigureState {
            skeleton: scene.skeleton,
            pose: &pose,
        };
        let met = self.solve(limb, &goal, &terms, Some(&now.joints), moment);
        let mut joints = met.joints;
        for (i, (joint, from)) in joints.iter_mut().zip(&now.joints).enumerate() {
            if !limited || i == ROLL {
                *joint = from + ops::wrap_angle(*joint - from);
            }
        }
        let trunk = self.trunk(limb, scene.skeleton, &pose);
        let aim = self.aim(limb, to, &joints, &met.base, &trunk);
        let held = HeldLimb {
            joints,
            cue: met.cue,
            lean,
            help: DVec3::ZERO,
        };
        (held, aim)
    }
}

/// Returns the largest change of a joint, radians.
fn longest(from: &Joints, to: &Joints) -> f64 {
    let ways = from.iter().zip(to).map(|(a, b)| (a - b).abs());
    ways.fold(0.0, f64::max)
}

impl Motion {
    /// Returns true if the motion defines a path of the limb.
    fn moves(&self) -> bool {
        !matches!(self, Self::Configure { .. })
    }

    /// Returns true if the motion moves the limb instantly.
    pub(super) fn cuts(&self) -> bool {
        matches!(self, Self::Joints { secs, .. } if *secs <= 0.0)
    }
}
