//! Motions of the hands as functions of their progress.

use raconteur_base::{DQuat, DVec3, ops};
use raconteur_eml::{Handedness, ShapeKey};

use super::posture::{Change, Changes, HandPose, Hands};
use crate::orientation::unit;

/// Maximum number of keys of a sign.
pub(super) const MAX_KEYS: usize = 100;

/// Usual lengths of motions, seconds: *designed*.
const LINE_SECS: f64 = 0.4;
const CIRCLE_SECS: f64 = 0.8;
const WRIST_SECS: f64 = 0.6;
const HOLD_SECS: f64 = 0.3;
const CHANGE_SECS: f64 = 0.4;
/// Distance of a motion of usual size, skeleton units: *designed*.
pub(super) const DISTANCE: f64 = 8.0;
/// Angle of a turn of the wrist to either side, degrees.
const WRIST_DEG: f64 = 25.0;
/// Share of the relaxed shape to which playing fingers go.
const PLAY: f64 = 0.4;

/// Motion of the hands of a sign.
#[derive(Clone, Debug)]
pub(super) enum Motion {
    /// Along a vector, with a bulge to a side, and with waves.
    Line {
        vector: DVec3,
        bulge: DVec3,
        waves: u32,
    },
    /// Turns around an axis from a position of the circle; negative turns are counter-clockwise, seen
    /// along the axis.
    Circle {
        axis: DVec3,
        radius: f64,
        turns: f64,
    },
    /// Turns of the wrist about an axis as in [`HandPose::wrist_deg`].
    Wrist(DVec3),
    /// Playing fingers.
    Fingers,
    /// No motion.
    Hold,
    /// To a posture, along a motion.
    Target(Box<Motion>, Box<Changes>),
    Sequence(Vec<Motion>),
    Parallel(Vec<Motion>),
    /// One for each hand.
    Split(Vec<Motion>),
    /// A number of times.
    Repeat {
        motion: Box<Motion>,
        count: u32,
        kind: Repetition,
    },
    /// Faster or slower, by a factor of the time.
    Paced(Box<Motion>, f64),
}

/// Start of each further round of a repeated motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Repetition {
    /// At the start of the first one.
    FromStart,
    /// At the end of the one before, and back.
    Back,
    /// At the end of the one before, and on.
    Continued,
}

impl Motion {
    /// Returns the length, seconds.
    pub(super) fn secs(&self) -> f64 {
        match self {
            Self::Line { vector, .. } => LINE_SECS * (0.5 + 0.5 * vector.length() / DISTANCE),
            Self::Circle { turns, .. } => CIRCLE_SECS * turns.abs(),
            Self::Wrist(_) | Self::Fingers => WRIST_SECS,
            Self::Hold => HOLD_SECS,
            Self::Target(motion, _) => match **motion {
                Self::Hold => CHANGE_SECS,
                _ => motion.secs(),
            },
            Self::Sequence(all) => all.iter().map(Self::secs).sum(),
            Self::Parallel(all) | Self::Split(all) => {
                all.iter().map(Self::secs).fold(0.0, f64::max)
            }
            Self::Repeat { motion, count, .. } => motion.secs() * f64::from(*count),
            Self::Paced(motion, factor) => motion.secs() * factor,
        }
    }

    /// Adds the times at which keys are needed, seconds from `start_secs` on, of a motion of a length.
    pub(super) fn add_keys(&self, start_secs: f64, secs: f64, keys: &mut Vec<f64>) {
        let mut even = |count: u32| {
            let times = (1..=count).map(|i| start_secs + secs * f64::from(i) / f64::from(count));
            let room = MAX_KEYS.saturating_sub(keys.len());
            keys.extend(times.take(room));
        };
        match self {
            Self::Line { bulge, waves, .. } => even(match (bulge.length() > 0.0, waves) {
                (_, 1..) => waves * 2,
                (true, _) => 4,
                (false, _) => 1,
            }),
            Self::Circle { turns, .. } => even((turns.abs() * 8.0).ceil().clamp(2.0, 64.0) as u32),
            Self::Wrist(_) => even(6),
            Self::Fingers => even(4),
            Self::Hold => even(1),
            Self::Target(motion, _) => motion.add_keys(start_secs, secs, keys),
            Self::Sequence(all) => {
                let total = self.secs().max(f64::MIN_POSITIVE);
                let mut start_secs = start_secs;
                for motion in all {
                    let own_secs = secs * motion.secs() / total;
                    motion.add_keys(start_secs, own_secs, keys);
                    start_secs += own_secs;
                }
            }
            Self::Parallel(all) | Self::Split(all) => {
                for motion in all {
                    motion.add_keys(start_secs, secs, keys);
                }
            }
            Self::Repeat { motion, count, .. } => {
                let own_secs = secs / f64::from(*count);
                for i in 0..*count {
                    motion.add_keys(start_secs + own_secs * f64::from(i), own_secs, keys);
                }
            }
            Self::Paced(motion, _) => motion.add_keys(start_secs, secs, keys),
        }
    }

    /// Moves a hand to a progress from 0 to 1.
    pub(super) fn apply(&self, progress: f64, hand: usize, hands: &Hands, pose: &mut HandPose) {
        let mirror = hands.motion_mirror(hand);
        match self {
            Self::Line {
                vector,
                bulge,
                waves,
            } => {
                let turn = core::f64::consts::PI * progress * f64::from((*waves).max(1) * 2 - 1);
                let wave = ops::sin(turn) * if *waves > 0 { 0.5 } else { 1.0 };
                pose.position += (*vector * progress + *bulge * wave) * mirror;
            }
            Self::Circle {
                axis,
                radius,
                turns,
            } => {
                let start = circle_start(*axis) * *radius;
                // In left-handed axes, a positive angle is counter-clockwise along the axis.
                let angle = -core::f64::consts::TAU * turns * progress;
                let turned = DQuat::from_axis_angle(*axis, angle) * start;
                pose.position += (turned - start) * mirror;
            }
            Self::Wrist(axis) => {
                let swing = ops::sin(core::f64::consts::TAU * 1.5 * progress);
                pose.wrist_deg += *axis * (WRIST_DEG * swing);
            }
            Self::Fingers => {
                let bent = 0.5 - 0.5 * ops::cos(core::f64::consts::TAU * 2.0 * progress);
                if bent > 0.01 {
                    pose.shape.blend = Some((0, PLAY * bent));
                }
            }
            Self::Hold => {}
            Self::Target(motion, changes) => {
                let towards = &changes[hand];
                reach_target(motion, towards, (progress, hand, hands), pose);
            }
            Self::Sequence(all) => {
                let total = self.secs().max(f64::MIN_POSITIVE);
                let mut start = 0.0;
                for motion in all {
                    let share = motion.secs() / total;
                    if progress <= start && start > 0.0 {
                        break;
                    }
                    let own = ((progress - start) / share.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
                    motion.apply(own, hand, hands, pose);
                    start += share;
                }
            }
            Self::Parallel(all) => {
                for motion in all {
                    motion.apply(progress, hand, hands, pose);
                }
            }
            Self::Split(all) => {
                if let Some(motion) = all.get(hand) {
                    let own = Hands {
                        mirror: DVec3::ONE,
                        ..*hands
                    };
                    motion.apply(progress, hand, &own, pose);
                }
            }
            Self::Repeat {
                motion,
                count,
                kind,
            } => {
                let rounds = f64::from(*count);
                repeat(motion, (rounds, *kind), (progress, hand, hands), pose);
            }
            Self::Paced(motion, _) => motion.apply(progress, hand, hands, pose),
        }
    }
}

/// Moves a hand along a motion to a posture, by a progress from 0 to 1.
fn reach_target(
    motion: &Motion,
    change: &Change,
    (progress, hand, hands): (f64, usize, &Hands),
    pose: &mut HandPose,
) {
    let from = pose.position;
    motion.apply(progress, hand, hands, pose);
    let moved = pose.position;
    let mut target = *pose;
    change.apply(&mut target);
    if progress >= 0.5 {
        change.apply(pose);
    }
    if change.moves() {
        // Only the deviation of the motion from its straight line remains.
        let mut end = *pose;
        end.position = from;
        motion.apply(1.0, hand, hands, &mut end);
        let deviation = moved - from.lerp(end.position, progress);
        pose.position = from.lerp(target.position, progress) + deviation;
    }
}

/// Moves a hand along some rounds of a motion, by a progress from 0 to 1 of all.
fn repeat(
    motion: &Motion,
    (rounds, kind): (f64, Repetition),
    (progress, hand, hands): (f64, usize, &Hands),
    pose: &mut HandPose,
) {
    let whole = progress * rounds;
    // The end of the last round is an end, not a start.
    let round = whole.floor().min(rounds - 1.0);
    let mut own = whole - round;
    match kind {
        Repetition::Back if round as u32 % 2 == 1 => own = 1.0 - own,
        Repetition::Continued => {
            let mut end = *pose;
            motion.apply(1.0, hand, hands, &mut end);
            pose.position += (end.position - pose.position) * round;
        }
        _ => {}
    }
    motion.apply(own, hand, hands, pose);
}

/// Returns the direction from the centre of a circle to its start: upwards, or to the front of a
/// horizontal one.
pub(super) fn circle_start(axis: DVec3) -> DVec3 {
    let across = |wanted: DVec3| unit(wanted - axis * wanted.dot(axis));
    let is_horizontal = axis.y.abs() > 0.9;
    let wanted = if is_horizontal {
        DVec3::NEG_Z
    } else {
        DVec3::Y
    };
    across(wanted).unwrap_or(DVec3::Y)
}

/// Returns the hands of EML that take part.
pub(super) fn handedness(moves: [bool; 2]) -> Handedness {
    match moves {
        [true, true] => Handedness::Both,
        [false, true] => Handedness::NonDominant,
        _ => Handedness::Dominant,
    }
}

/// Returns the shape of a pose for a key.
pub(super) fn shape(pose: &HandPose) -> ShapeKey {
    ShapeKey {
        id: pose.shape.id,
        blend: pose
            .shape
            .blend
            .map(|(id, share)| (id, (share * 100.0).round() / 100.0)),
    }
}
