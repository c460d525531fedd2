//! Checks of a story without rendering: plays it and reports visible faults.
//!
//! A sweep examines 120 frames per second of a [`Player`] and measures each of them: lengths of
//! bones, rotations, speeds of joints, hands in the body or in each other, limits of joints, start
//! times of strokes compared with the script, swinging hair in skin or clothes, hands and face in
//! the frame, and speech closures of the face. It reports the worst value of each with its location
//! and time.

mod face;
mod folds;
mod framing;
mod hair;
mod solids;

use std::ops::RangeInclusive;
use std::sync::Arc;

use raconteur_actor::gesture::contact::Capsule;
use raconteur_actor::limb::wrist::WristLimits;
use raconteur_actor::limb::{LimbRig, Sex};
use raconteur_base::{DAffine3, DQuat, DVec3, Side, ops};
use raconteur_body::{Bone, Figure, Skeleton};

use crate::Player;
use face::FaceSweep;
pub use folds::{Fold, Folds, MAX_FOLD_DEPTH_MM};
use framing::{FramedPoints, Framing};
use hair::HairSweep;
use solids::{Body, Hand, local_rotation};

/// Sampling rate of a sweep (a check of a story without rendering), frames per second.
pub const RATE_HZ: f64 = 120.0;

/// Distance from its target at which a hand counts as arrived, metres. Designed: the trunk below it
/// breathes, and one and a half centimetres are no different place.
const THERE_M: f64 = 0.015;
/// Distance beyond the reach that the planner allows, and an invisible remainder, metres.
const STRETCHED_M: f64 = 0.05;
const UNSEEN_M: f64 = 0.003;
/// A stroke is looked for this long, seconds.
const LOOKED_FOR_SECS: f64 = 0.4;

/// Worst value of one measure over a sweep, with its limit, time and location.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// Measured quantity, for example `joint-speed`.
    pub name: &'static str,
    /// The worst that was found.
    pub worst: f64,
    /// Maximum value that passes the check.
    pub limit: f64,
    /// Unit of both, for example `rad/s`.
    pub unit: &'static str,
    /// Location of the worst value: the name of a bone or a phone; empty if nothing was found.
    pub location: &'static str,
    /// Time of the worst value, story time, seconds.
    pub at_secs: f64,
}

impl Check {
    /// Returns true if the worst value is within the limit. NaN is not.
    #[must_use]
    pub fn is_ok(&self) -> bool {
        self.worst <= self.limit
    }

    fn new(name: &'static str, limit: f64, unit: &'static str) -> Self {
        Self {
            name,
            worst: 0.0,
            limit,
            unit,
            location: "",
            at_secs: 0.0,
        }
    }

    fn measure_bone(&mut self, value: f64, bone: Bone, at_secs: f64) {
        self.measure(value, bone.name(), at_secs);
    }

    fn measure(&mut self, value: f64, location: &'static str, at_secs: f64) {
        if value > self.worst || value.is_nan() {
            (self.worst, self.location, self.at_secs) = (value, location, at_secs);
        }
    }
}

/// Runs the framing part of [`sweep`]: visibility of hands and face, zoom speed and shot durations.
#[must_use]
pub fn check_framing(player: &mut Player) -> Vec<Check> {
    let mut framing = Framing::new(player);
    for i in frames(&(0.0..=player.end_secs()), framing::RATE_HZ) {
        let t = i as f64 / framing::RATE_HZ;
        let places = FramedPoints::from_frame(player.frame(t, 1.0));
        framing.measure(player, &places, t);
    }
    framing.checks()
}

/// Sweeps over the whole of a story. Times pass in a player as in a viewer's; its cues do
/// not.
#[must_use]
pub fn sweep(player: &mut Player) -> Vec<Check> {
    let end = player.end_secs();
    sweep_between(player, 0.0..=end)
}

/// Sweeps an interval of a story, story time, seconds.
#[must_use]
pub fn sweep_between(player: &mut Player, secs: RangeInclusive<f64>) -> Vec<Check> {
    let mut sweep = Sweep::new(player.figure());
    let mut face = player.face().is_some().then(|| FaceSweep::new(player));
    // The player moves while the meshes are read.
    let figure = Arc::clone(player.figure());
    let mut hair = HairSweep::new(&figure);
    let mut framing = Framing::new(player);
    let every = |rate_hz: f64, i: u64| i.is_multiple_of((RATE_HZ / rate_hz) as u64);
    for i in frames(&secs, RATE_HZ) {
        let t = i as f64 / RATE_HZ;
        let is_cut = player.cuts_between(t - 1.0 / RATE_HZ, t);
        let frame = player.frame(t, 1.6);
        if is_cut {
            sweep.forget();
        }
        sweep.measure(&frame.world_from_joint, t);
        if let Some(hair) = hair.as_mut().filter(|_| every(hair::RATE_HZ, i)) {
            hair.measure(&frame.world_from_joint, t);
        }
        let places = FramedPoints::from_frame(frame);
        if every(framing::RATE_HZ, i) {
            framing.measure(player, &places, t);
        }
        if let (Some(face), Some(tissue)) = (&mut face, player.face()) {
            let controls = player.face_controls(t);
            face.measure(tissue, &controls, t);
            if every(folds::RATE_HZ, i) {
                face.look_for_folds(&figure, &player.last_frame().tissue, t);
            }
            face.look_at_lids(&controls, player.lids_rad(), t);
        }
    }
    let late = late_strokes(player, &secs);
    let mut checks = sweep.checks();
    checks.push(late);
    checks.extend(framing.checks());
    checks.extend(hair.map(HairSweep::check));
    checks.extend(face.into_iter().flat_map(FaceSweep::checks));
    checks.extend(face::fast(player, &secs));
    checks
}

/// Returns the numbers of the frames within an interval, at a given rate.
fn frames(secs: &RangeInclusive<f64>, rate_hz: f64) -> RangeInclusive<u64> {
    (secs.start() * rate_hz).ceil() as u64..=(secs.end() * rate_hz).floor() as u64
}

/// Measures of every frame.
struct Sweep {
    skeleton: Skeleton,
    zero_rotations: Vec<DQuat>,
    body: Body,
    hands: [Hand; 2],
    arms: [LimbRig; 2],
    /// Rotations and turns (radians a second) of the frame before.
    before: Option<Vec<(DQuat, Option<DVec3>)>>,
    wrists: Option<[DVec3; 2]>,
    capsules: [Vec<Capsule>; 2],
    length: Check,
    rotation: Check,
    speed: Check,
    kick: Check,
    wrist: Check,
    trunk: Check,
    head: Check,
    other_hand: Check,
    limits: Check,
}

impl Sweep {
    fn new(figure: &Figure) -> Self {
        Self {
            skeleton: figure.skeleton.clone(),
            zero_rotations: figure
                .skeleton
                .joints()
                .iter()
                .map(|j| j.zero_rotation)
                .collect(),
            body: Body::new(figure),
            hands: Side::BOTH.map(|side| Hand::new(figure, side)),
            arms: Side::BOTH.map(|side| {
                LimbRig::new(&figure.skeleton, side, true, Sex::from_share(figure.sex))
            }),
            before: None,
            wrists: None,
            capsules: [Vec::new(), Vec::new()],
            // A chain of ten joints of a metre rounds by less than a nanometre.
            length: Check::new("bone-length", 1e-6, "mm"),
            rotation: Check::new("unit-rotation", 1e-9, ""),
            // A fist that closes at the planner's maximum speed.
            speed: Check::new("joint-speed", 41.0, "rad/s"),
            // The fastest turn of the planner, started abruptly by a linear profile.
            kick: Check::new("joint-jump", 16.0, "rad/s"),
            // The fastest path of the planner, by minimum jerk, on a moving trunk.
            wrist: Check::new("wrist-speed", 4.4, "m/s"),
            trunk: Check::new("hand-in-trunk", 5.0, "mm"),
            head: Check::new("hand-in-head", 5.0, "mm"),
            other_hand: Check::new("hand-in-hand", 5.0, "mm"),
            limits: Check::new("beyond-limits", 0.1, "°"),
        }
    }

    fn checks(self) -> Vec<Check> {
        vec![
            self.length,
            self.rotation,
            self.speed,
            self.kick,
            self.wrist,
            self.trunk,
            self.head,
            self.other_hand,
            self.limits,
        ]
    }

    /// Forgets the frame before: the script cuts the figure from that to the next one.
    fn forget(&mut self) {
        (self.before, self.wrists) = (None, None);
    }

    fn measure(&mut self, world_from_joint: &[DAffine3], t: f64) {
        self.bones(world_from_joint, t);
        self.motion(world_from_joint, t);
        self.solids(world_from_joint, t);
        self.joints(world_from_joint, t);
    }

    /// Measures the bending of elbows and wrists beyond the human range.
    fn joints(&mut self, world_from_joint: &[DAffine3], t: f64) {
        for side in Side::BOTH {
            let [elbow, wrist] = ["elbow", "wrist"].map(|part| Bone::on(side, part));
            let own = |bone: Bone| {
                let zero = self.zero_rotations[bone.index()];
                (zero.inverse() * local_rotation(world_from_joint, bone)).normalize()
            };
            let bend = turn(DQuat::IDENTITY, own(elbow));
            // A hinge about z, from stretched to bent.
            let most = self.arms[side.index()].limits()[2].max_rad;
            let over = (bend.z - most).max(-bend.z).max(0.0);
            let aside = bend.truncate().length();
            self.limits
                .measure_bone(over.max(aside).to_degrees(), elbow, t);
            // Limits are known of one axis at a time. A wrist that is turned about several is
            // within them if it is so by a swing after the forearm's twist, as gestures turn
            // it, or by the joints of GEVH table 3.1.
            let turned = own(wrist);
            let arm = &self.arms[side.index()];
            let by_swing = WristLimits::new(side, arm.limits()).beyond_rad(turned);
            let over = by_swing.min(arm.end_beyond_limits_rad(turned));
            self.limits.measure_bone(over.to_degrees(), wrist, t);
        }
    }

    fn bones(&mut self, world_from_joint: &[DAffine3], t: f64) {
        for bone in Bone::ALL {
            let joint = world_from_joint[bone.index()];
            let off = joint.matrix3.transpose() * joint.matrix3 - raconteur_base::DMat3::IDENTITY;
            let off = off.to_cols_array().into_iter().map(f64::abs);
            // A maximum would skip NaN.
            self.rotation.measure_bone(off.sum(), bone, t);
            if let Some(parent) = bone.parent() {
                let from = world_from_joint[parent.index()].translation;
                let length = joint.translation.distance(from);
                let stretched = self.skeleton.stretched_m(bone, length);
                self.length.measure_bone(1e3 * stretched, bone, t);
            }
        }
    }

    fn motion(&mut self, world_from_joint: &[DAffine3], t: f64) {
        let before = self.before.take();
        let mut now = Vec::with_capacity(Bone::COUNT);
        for bone in Bone::ALL {
            let rotation = local_rotation(world_from_joint, bone);
            let last = before.as_ref().map(|b| b[bone.index()]);
            let turn = last.map(|(from, _)| turn(from, rotation) * RATE_HZ);
            if let Some(turn) = turn {
                self.speed.measure_bone(turn.length(), bone, t);
            }
            if let (Some(turn), Some((_, Some(earlier)))) = (turn, last) {
                self.kick.measure_bone((turn - earlier).length(), bone, t);
            }
            now.push((rotation, turn));
        }
        self.before = Some(now);
        let bones = Side::BOTH.map(|side| Bone::on(side, "wrist"));
        let wrists = bones.map(|b| world_from_joint[b.index()].translation);
        if let Some(last) = self.wrists {
            for k in 0..2 {
                let speed = wrists[k].distance(last[k]) * RATE_HZ;
                self.wrist.measure_bone(speed, bones[k], t);
            }
        }
        self.wrists = Some(wrists);
    }

    fn solids(&mut self, world_from_joint: &[DAffine3], t: f64) {
        let wrists = Side::BOTH.map(|side| Bone::on(side, "wrist"));
        for side in Side::BOTH {
            let k = side.index();
            self.capsules[k].clear();
            self.capsules[k].extend(self.hands[k].capsules(world_from_joint));
            for capsule in &self.capsules[k] {
                let [trunk, head] = self.body.depths_m(world_from_joint, capsule);
                self.trunk.measure_bone(1e3 * trunk, wrists[k], t);
                self.head.measure_bone(1e3 * head, wrists[k], t);
            }
        }
        let far = |capsules: &[Capsule]| capsules.first().map_or(DVec3::ZERO, |c| c.ends[0]);
        // No two hands are as long as half a metre together.
        if far(&self.capsules[0]).distance(far(&self.capsules[1])) < 0.5 {
            for a in &self.capsules[0] {
                for b in &self.capsules[1] {
                    let depth = a.depth_m(b, DVec3::ZERO);
                    self.other_hand.measure_bone(1e3 * depth, wrists[0], t);
                }
            }
        }
    }
}

/// Returns the rotation from one orientation to another as axis times angle, radians.
fn turn(from: DQuat, to: DQuat) -> DVec3 {
    let q = to * from.inverse();
    let q = if q.w < 0.0 { -q } else { q };
    let v = DVec3::new(q.x, q.y, q.z);
    let sine = v.length();
    if sine > 1e-12 {
        v * (2.0 * ops::atan2(sine, q.w) / sine)
    } else {
        2.0 * v
    }
}

/// Measures the delay of strokes: the hand is at its first place.
fn late_strokes(player: &mut Player, secs: &RangeInclusive<f64>) -> Check {
    let mut check = Check::new("late-stroke", 20.0, "ms");
    for side in Side::BOTH {
        let bone = Bone::on(side, "wrist");
        for (begins, place) in player.strokes(side) {
            if !secs.contains(&begins) {
                continue;
            }
            let steps = (LOOKED_FOR_SECS * 1e3) as u32;
            let mut off_m = |ms: u32| {
                let t = begins + f64::from(ms) * 1e-3;
                let wrist = player.frame(t, 1.6).world_from_joint[bone.index()];
                // The position moves with the figure.
                let place = player.world_from_gestures(t).transform_point3(place);
                wrist.translation.distance(place)
            };
            let ways_m: Vec<f64> = (0..steps).map(&mut off_m).collect();
            let nearest_m = ways_m.iter().copied().fold(f64::INFINITY, f64::min);
            // A fully stretched arm counts as arrived.
            let there_m = if nearest_m < STRETCHED_M {
                THERE_M.max(nearest_m + UNSEEN_M)
            } else {
                THERE_M
            };
            let first = ways_m.iter().position(|way_m| *way_m < there_m);
            let late = first.and_then(|ms| u32::try_from(ms).ok());
            check.measure_bone(f64::from(late.unwrap_or(steps)), bone, begins);
        }
    }
    check
}
