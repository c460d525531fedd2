//! Samples limbs at even times when a script is compiled, and records a path through the joints
//! where the targets would make them snap ([`super::smoothing`]).

use super::aim::FORCED;
use super::perform::Manipulators;
use super::scene::CommandContext;
use super::smoothing::{EVEN_HZ, Interval, MAX_RAD_PER_S, Sample, lerp_joints, nearest};
use super::solve::LimbSolution;
use crate::limb::ARM_BONES;
use crate::limb::chain::END;
use crate::limb::{Joints, Limb};

/// Rate at which joints catch up with a target after a snap, as a share of the remaining distance
/// per second; minimum and maximum speed. Designed: as a quick movement that ends softly.
const CATCH_UP_HZ: f64 = 6.0;
const MAX_SPEED_RAD_PER_S: f64 = 10.0;
const MIN_SPEED_RAD_PER_S: f64 = 2.0;
/// Mean speed between even times from which it is looked at as a snap: in between it may be
/// some more.
const SNAP_RAD_PER_S: f64 = 0.7 * MAX_RAD_PER_S;
/// Flexion of elbow or knee below which they may stretch and bend between even times, radians: near
/// the reach a small displacement of the end is a large one of these joints.
const STRETCHED_RAD: f64 = 0.4;
/// Turn between even times below which no motion between them is considered, radians: for stretched
/// elbows and knees, and for all others.
const STILL_RAD: f64 = 0.003;
const UNSEEN_RAD: f64 = 0.02;
/// The shortest time in which a snap is looked for, seconds, and how often it is doubled to an
/// even step.
const MIN_SECS: f64 = 1.0 / 480.0;
const HALVINGS: u32 = 4;
/// Turn in both halves of an interval that cannot hide a snap, even if part of it is instantaneous,
/// radians.
const HARMLESS_RAD: f64 = SNAP_RAD_PER_S * MIN_SECS;
/// Times that a step by the joints is shortened to its bones' speed.
const SHORTENINGS: usize = 4;
/// Joints this near to those of the target have caught up, radians.
const CAUGHT_RAD: f64 = 1e-6;
/// Maximum catch-up time of joints when all else rests, and the pause in which limbs are not
/// followed, seconds.
const AFTER_SECS: f64 = 3.0;
const PAUSE_SECS: f64 = 0.5;
/// Time for which a loop is followed, seconds.
const LOOP_SECS: f64 = 60.0;
/// Times farther than this from the story's beginning are ignored, seconds.
const MAX_TIME_SECS: f64 = 1e9;
/// Maximum number of even times followed in one performance, 20 minutes of motion: later motion
/// follows the targets alone, so every script is bounded in time.
const MAX_STEPS: u32 = 36_000;

/// The state of one limb while it is followed.
#[derive(Clone, Copy, Debug, Default)]
struct ScannedLimb {
    /// Joints of the target at the last even time.
    target: Option<Joints>,
    /// True if the joints have not caught up with the target.
    is_behind: bool,
    /// True if its motion is over.
    rests: bool,
}

/// State of the scan that follows all limbs at even time steps when a script is compiled, to find
/// jumps of their joints.
#[derive(Debug)]
pub(super) struct Scan {
    limbs: [ScannedLimb; 5],
    /// End of each limb's motion, story time, seconds.
    rests_from: [f64; 5],
    /// End of all motions, story time, seconds.
    busy_until: f64,
    /// Flags of the limbs that move in a loop, and of the figure: they never rest.
    loops: [bool; 5],
    figure_loops: bool,
    /// The next even time; `None` while everything rests.
    next: Option<i64>,
    steps: u32,
}

impl Scan {
    pub(super) fn new() -> Self {
        Self {
            limbs: Default::default(),
            rests_from: [f64::NEG_INFINITY; 5],
            busy_until: f64::NEG_INFINITY,
            loops: [false; 5],
            figure_loops: false,
            next: None,
            steps: 0,
        }
    }

    /// Records that a limb starts to move, for `secs` seconds; infinite for a loop.
    pub(super) fn limb_moves(&mut self, limb: Limb, from_secs: f64, secs: f64) {
        let until_secs = from_secs + followed_secs(secs);
        self.busy_until = self.busy_until.max(until_secs);
        self.rests_from[limb.index()] = until_secs;
        self.loops[limb.index()] = secs.is_infinite();
    }

    /// Resets a limb that a command switches to other joints, so that no jump is smoothed.
    pub(super) fn reset(&mut self, limb: Limb) {
        self.limbs[limb.index()] = ScannedLimb::default();
    }

    /// Records that the figure starts to move, and all limbs with it, for `secs` seconds; infinite
    /// for a loop.
    pub(super) fn figure_moves(&mut self, from_secs: f64, secs: f64) {
        let until_secs = from_secs + followed_secs(secs);
        self.busy_until = self.busy_until.max(until_secs);
        for rests_from in &mut self.rests_from {
            *rests_from = rests_from.max(until_secs);
        }
        self.figure_loops = secs.is_infinite();
    }
}

/// Returns the time for which a motion of a given duration is followed.
fn followed_secs(secs: f64) -> f64 {
    if secs.is_finite() { secs } else { LOOP_SECS }
}

impl Manipulators {
    /// Begins to follow, shortly before a time.
    pub(super) fn wake(&mut self, scan: &mut Scan, time_secs: f64, scene: &CommandContext<'_>) {
        let is_far = time_secs.abs() > MAX_TIME_SECS;
        if scan.next.is_some() || scan.steps >= MAX_STEPS || is_far {
            return;
        }
        let at = (time_secs * EVEN_HZ).floor() as i64;
        scan.next = Some(at + 1);
        scan.limbs = Default::default();
        // Samples of the limbs before this time.
        let mut samples: [Vec<Sample>; 5] = Default::default();
        for even in at - 3..=at {
            let secs = even as f64 / EVEN_HZ;
            let mut pose = scene.idle(secs);
            self.lean(scene.skeleton, secs, &mut pose);
            for limb in Limb::ALL {
                let Some((goal, weight)) = self.goal(limb, secs) else {
                    continue;
                };
                let met = self.solve_at(limb, &goal, secs, scene.skeleton, &pose);
                let lead = self.steady[limb.index()].sample(secs, self.limbs.get(limb.index()));
                let leads = lead.map_or([false; 2], |lead| {
                    let forced = met.forced_by();
                    [0, 1].map(|i| lead.weights[i] > 0.0 || forced[i] > 0.0)
                });
                samples[limb.index()].push(Sample {
                    joints: met.joints,
                    follows_joints: leads,
                });
                self.place(limb, &met, weight, &mut pose);
            }
        }
        for (limb, samples) in Limb::ALL.into_iter().zip(samples) {
            if samples.len() == 4 {
                self.steady[limb.index()].intervals.push(Interval {
                    from: at - 1,
                    first: at - 3,
                    samples,
                    rests: true,
                    lead_to: [at; 2],
                    takes: false,
                });
            }
        }
    }

    /// Begins to follow a limb from its present state, before a command takes it over.
    pub(super) fn begin_scan(&mut self, scan: &Scan, limb: Limb, scene: &CommandContext<'_>) {
        let i = limb.index();
        let Some(next) = scan.next else {
            return;
        };
        let open = self.steady[i].intervals.last_mut();
        if let Some(open) = open.filter(|s| s.next() == next) {
            // A command that drives joints starts with the joints.
            open.follow();
            return;
        }
        let samples = (next - 3..next).map(|even| Sample {
            joints: self.undisturbed_at(limb, even as f64 / EVEN_HZ, scene),
            follows_joints: [false; 2],
        });
        let stretch = Interval {
            from: next - 1,
            first: next - 3,
            samples: samples.collect(),
            rests: true,
            lead_to: [next - 1; 2],
            takes: true,
        };
        self.steady[i].intervals.push(stretch);
    }

    /// Follows up to a time.
    pub(super) fn follow_to(
        &mut self,
        scan: &mut Scan,
        time_secs: f64,
        scene: &CommandContext<'_>,
    ) {
        while let Some(even) = scan.next {
            let secs = even as f64 / EVEN_HZ;
            if secs > time_secs {
                return;
            }
            let is_behind = scan.limbs.iter().any(|limb| limb.is_behind);
            let over = secs - scan.busy_until;
            let waits = over < PAUSE_SECS || is_behind && over < AFTER_SECS;
            if !waits && time_secs - secs > PAUSE_SECS || scan.steps >= MAX_STEPS {
                scan.next = None;
                for (i, steady) in self.steady.iter_mut().enumerate() {
                    let Some(last) = steady.intervals.last_mut() else {
                        continue;
                    };
                    last.rests = !(scan.loops[i] || scan.figure_loops);
                    // If no joints are driven, the last samples suffice.
                    if last.samples.iter().all(|s| !s.follows_joints[1]) {
                        let keep = last.samples.len().saturating_sub(1);
                        last.samples.drain(..keep);
                        last.first += keep as i64;
                        last.from = last.from.max(last.first);
                    }
                }
                return;
            }
            self.follow_at(scan, even, scene);
            scan.steps += 1;
            scan.next = Some(even + 1);
        }
    }

    fn follow_at(&mut self, scan: &mut Scan, even: i64, scene: &CommandContext<'_>) {
        let secs = even as f64 / EVEN_HZ;
        let mut pose = scene.idle(secs);
        self.lean(scene.skeleton, secs, &mut pose);
        for limb in Limb::ALL {
            let i = limb.index();
            let Some((goal, weight)) = self.goal(limb, secs) else {
                scan.limbs[i] = ScannedLimb::default();
                continue;
            };
            let mut met = self.solve_static(limb, &goal, secs, scene.skeleton, &pose);
            let rests = secs >= scan.rests_from[i];
            scan.limbs[i].rests = rests;
            met.joints = self.step(limb, even, &mut scan.limbs[i], &met, scene);
            met.posed = self.posed(limb, &met.joints, &met.base);
            self.place(limb, &met, weight, &mut pose);
        }
    }

    /// Writes down the joints of a limb at an even time.
    fn step(
        &mut self,
        limb: Limb,
        even: i64,
        followed: &mut ScannedLimb,
        met: &LimbSolution,
        scene: &CommandContext<'_>,
    ) -> Joints {
        let i = limb.index();
        let target = &met.joints;
        let open = self.steady[i].intervals.last();
        let last = open
            .filter(|s| s.next() == even && !self.steady[i].is_cut_before(even))
            .and_then(|s| s.samples.last());
        let Some(last) = last.map(|s| s.joints) else {
            // The limb comes under control at its current position.
            self.steady[i]
                .intervals
                .push(Interval::new(even, even, *target));
            followed.target = Some(*target);
            return *target;
        };
        let before = followed.target.unwrap_or(last);
        let turned = self.rotation_distance(limb, &before, target);
        let was = followed.is_behind;
        let mut snaps = self.snaps(limb, even, [&before, target], turned, scene);
        followed.target = Some(*target);
        let forced = met.forced_by();
        let [stays, end_stays] = forced.map(|forced| forced >= FORCED && followed.rests && !was);
        let mut joints = *target;
        if stays {
            joints = last;
        } else if end_stays {
            joints[END].copy_from_slice(&last[END]);
        }
        // A resting limb also does not release its held position abruptly.
        snaps |= !stays
            && !was
            && self.rotation_distance(limb, &last, &joints) > SNAP_RAD_PER_S / EVEN_HZ;
        if (was || snaps) && !stays {
            let limited = self.tracks[i].limited(even as f64 / EVEN_HZ) >= 0.5;
            let along = if snaps { 0.0 } else { turned * EVEN_HZ };
            let open = self.steady[i].intervals.last_mut();
            let waited = open.and_then(|stretch| stretch.delay_snap(self.limbs.get(i)));
            let (last, waits) = waited.unwrap_or((last, false));
            joints = if waits {
                last
            } else {
                self.catch_up(limb, &last, target, along, limited)
            };
        }
        let is_off = self.turned(limb, &joints, target) > CAUGHT_RAD;
        followed.is_behind = is_off && (was || snaps && !stays);
        if let Some(stretch) = self.steady[i].intervals.last_mut() {
            // If the target is not met, the smoothing loses nothing.
            let begins = stretch.begins();
            stretch.push(
                joints,
                forced.map(|f| f > 0.0 && !begins || is_off || snaps || was),
            );
        }
        joints
    }

    /// Returns the joints one even time later on their way to those of a moving target, with their
    /// own turn rate, radians per second.
    fn catch_up(
        &self,
        limb: Limb,
        last: &Joints,
        target: &Joints,
        along_rad_per_s: f64,
        limited: bool,
    ) -> Joints {
        let to = match self.limbs.get(limb.index()) {
            Some(rig) if limited => rig.alike(target, last, true),
            None if limited => *target,
            rig => nearest(target, last, rig),
        };
        let left = self.rotation_distance(limb, last, &to);
        let own = (CATCH_UP_HZ * left).clamp(MIN_SPEED_RAD_PER_S, MAX_SPEED_RAD_PER_S);
        let most = (own + along_rad_per_s).min(SNAP_RAD_PER_S) / EVEN_HZ;
        if left <= most {
            return to;
        }
        // Bones may turn farther by their joints than by the shortest rotation.
        let mut share = most / left;
        let mut joints = lerp_joints(last, &to, share, limited);
        for _ in 0..SHORTENINGS {
            let turned = self.rotation_distance(limb, last, &joints);
            if turned > most {
                share *= most / turned;
                joints = lerp_joints(last, &to, share, limited);
            }
        }
        joints
    }

    /// Returns true if a limb's target makes it snap before an even time.
    fn snaps(
        &self,
        limb: Limb,
        even: i64,
        ends: [&Joints; 2],
        turned: f64,
        scene: &CommandContext<'_>,
    ) -> bool {
        let is_stretched = limb != Limb::Head && ends[0][2].min(ends[1][2]) < STRETCHED_RAD;
        if turned > SNAP_RAD_PER_S / EVEN_HZ {
            return true;
        }
        let still = if is_stretched { STILL_RAD } else { UNSEEN_RAD };
        turned > still
            && self.jumps_between(limb, ends, (even - 1) as f64 / EVEN_HZ, HALVINGS, scene)
    }

    /// Returns true if a limb's target makes it snap in one of 2 to the power of `halvings` parts
    /// of the 480th of a second after a time.
    fn jumps_between(
        &self,
        limb: Limb,
        [a, b]: [&Joints; 2],
        from_secs: f64,
        halvings: u32,
        scene: &CommandContext<'_>,
    ) -> bool {
        let half_secs = f64::from(1_u32 << halvings) * 0.5 * MIN_SECS;
        let turned = self.turned(limb, a, b);
        if turned > SNAP_RAD_PER_S * 2.0 * half_secs {
            return true;
        }
        let middle_secs = from_secs + half_secs;
        if halvings == 0 {
            return false;
        }
        let middle = self.undisturbed_at(limb, middle_secs, scene);
        // A small turn in one half can hide a turn back if the other half turns.
        let halves = [self.turned(limb, a, &middle), self.turned(limb, &middle, b)];
        halves.into_iter().any(|turned| turned > HARMLESS_RAD)
            && [(a, &middle, from_secs), (&middle, b, middle_secs)]
                .into_iter()
                .any(|(a, b, from_secs)| {
                    self.jumps_between(limb, [a, b], from_secs, halvings - 1, scene)
                })
    }

    /// Returns the joints of a limb's target alone at a time, or its joints without a target.
    fn undisturbed_at(&self, limb: Limb, time_secs: f64, scene: &CommandContext<'_>) -> Joints {
        let mut pose = scene.idle(time_secs);
        self.lean(scene.skeleton, time_secs, &mut pose);
        self.first_limbs(limb.index(), scene.skeleton, time_secs, &mut pose);
        match self.goal(limb, time_secs) {
            Some((goal, _)) => {
                let met = self.solve_static(limb, &goal, time_secs, scene.skeleton, &pose);
                met.joints
            }
            None => {
                let trunk = self.trunk(limb, scene.skeleton, &pose);
                let scapula = ARM_BONES.get(limb.index()).map(|b| pose.rotation(b[0]));
                let base = self.base(limb, &trunk, scapula);
                self.configuration(limb, &pose, &base)
            }
        }
    }

    /// Returns the turn of the bones of a limb on a joint-space path between two sets of joints,
    /// radians.
    fn rotation_distance(&self, limb: Limb, from: &Joints, to: &Joints) -> f64 {
        const PARTS: u32 = 4;
        let to = nearest(to, from, self.limbs.get(limb.index()));
        let mut at = *from;
        let mut sum = 0.0;
        for part in 1..=PARTS {
            let next = lerp_joints(from, &to, f64::from(part) / f64::from(PARTS), true);
            sum += self.turned(limb, &at, &next);
            at = next;
        }
        sum
    }

    /// Returns the largest turn of a bone of a limb between two sets of joints, radians.
    fn turned(&self, limb: Limb, from: &Joints, to: &Joints) -> f64 {
        match self.limbs.get(limb.index()) {
            Some(rig) => rig.turned(from, to),
            None => self.head.turned(from, to),
        }
    }
}
