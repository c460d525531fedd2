//! Motions of the hands as functions of their progress.

use raconteur_base::{DQuat, DVec3, ops};
use raconteur_eml::{Diagnostic, Handedness, ShapeKey, quoted};

use super::posture::{Change, Changes, HandPose, Hands, PostureReader, is_posture};
use super::vocabulary::direction;
use crate::orientation::unit;
use crate::xml::Element;

/// Maximum nesting of motions.
const MAX_DEPTH: usize = 8;
/// Maximum number of motions of a sign.
const MAX_MOTIONS: usize = 64;
/// Maximum number of keys of a sign.
pub(super) const MAX_KEYS: usize = 200;

/// Usual lengths of motions, seconds: *designed*.
const LINE_SECS: f64 = 0.4;
const CIRCLE_SECS: f64 = 0.8;
const WRIST_SECS: f64 = 0.6;
const HOLD_SECS: f64 = 0.3;
const CHANGE_SECS: f64 = 0.4;
/// Distance of a motion and radius of a circle of usual size, skeleton units: *designed*.
const DISTANCE: f64 = 8.0;
const RADIUS: f64 = 4.0;
/// Factors of small and big sizes.
const SMALL: f64 = 0.5;
const BIG: f64 = 1.7;
/// Height of a curve or wave, as a share of its length.
const BULGE: f64 = 0.3;
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
    /// Where the first one starts.
    FromStart,
    /// Where the one before ends, and back.
    Back,
    /// Where the one before ends, and on.
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
fn circle_start(axis: DVec3) -> DVec3 {
    let across = |wanted: DVec3| unit(wanted - axis * wanted.dot(axis));
    let is_horizontal = axis.y.abs() > 0.9;
    let wanted = if is_horizontal {
        DVec3::NEG_Z
    } else {
        DVec3::Y
    };
    across(wanted).unwrap_or(DVec3::Y)
}

/// Reader of motions.
pub(super) struct MotionReader<'p> {
    pub(super) hands: Hands,
    pub(super) problems: &'p mut Vec<Diagnostic>,
    /// Motions read so far.
    pub(super) count: usize,
}

/// Motions of SiGML.
const MOTIONS: [&str; 14] = [
    "directedmotion",
    "circularmotion",
    "crossmotion",
    "wristmotion",
    "fingerplay",
    "changeposture",
    "nomotion",
    "nonman_motion",
    "par_motion",
    "seq_motion",
    "split_motion",
    "rpt_motion",
    "tgt_motion",
    "timed_motion",
];

/// Returns true if an element describes a motion.
pub(super) fn is_motion(element: &Element) -> bool {
    MOTIONS.contains(&element.name.as_str())
}

impl MotionReader<'_> {
    fn warn(&mut self, code: &'static str, element: &Element, name: &str, message: String) {
        let span = element
            .attribute(name)
            .map_or(element.tag, |text| text.span);
        self.problems.push(Diagnostic::warning(code, span, message));
    }

    /// Reads a motion. Reports motions that are nested too deeply or too many.
    pub(super) fn read(&mut self, element: &Element, depth: usize) -> Motion {
        self.count += 1;
        if depth > MAX_DEPTH || self.count > MAX_MOTIONS {
            if depth > MAX_DEPTH || self.count == MAX_MOTIONS + 1 {
                let message =
                    format!("more than {MAX_DEPTH} levels or {MAX_MOTIONS} motions of a sign");
                let problem = Diagnostic::error("sigml::too-large", element.tag, message);
                self.problems.push(problem);
            }
            return Motion::Hold;
        }
        let motion = match element.name.as_str() {
            "directedmotion" | "crossmotion" => self.line(element),
            "circularmotion" => self.circle(element),
            "wristmotion" => self.wrist(element),
            "fingerplay" => Motion::Fingers,
            "par_motion" => Motion::Parallel(self.children(element, depth)),
            "seq_motion" => Motion::Sequence(self.children(element, depth)),
            "split_motion" => Motion::Split(self.children(element, depth)),
            "rpt_motion" => self.repeat(element, depth),
            "tgt_motion" => self.target(element, depth),
            "nonman_motion" => {
                let message = "motions of the body are not performed".to_owned();
                self.warn("sigml::unperformed", element, "", message);
                Motion::Hold
            }
            _ => Motion::Hold,
        };
        let flag = |name: &str| matches!(element.value(name), Some("true" | "1"));
        let factor = match (flag("fast"), flag("slow")) {
            (true, false) => 0.6,
            (false, true) => 1.7,
            _ => return motion,
        };
        Motion::Paced(Box::new(motion), factor)
    }

    fn children(&mut self, element: &Element, depth: usize) -> Vec<Motion> {
        let mut all = Vec::new();
        for child in &element.children {
            if is_motion(child) {
                all.push(self.read(child, depth + 1));
            } else if !is_posture(child) {
                let message = format!("{} is not a motion", quoted(&child.name));
                self.warn("sigml::unknown-element", child, "", message);
            }
        }
        all
    }

    fn direction(&mut self, element: &Element, name: &str) -> Option<DVec3> {
        let value = element.value(name)?;
        let found = direction(value);
        if found.is_none() {
            let message = format!("{} is not a direction", quoted(value));
            self.warn("sigml::direction", element, name, message);
        }
        found
    }

    fn size(&mut self, element: &Element) -> f64 {
        match element.value("size") {
            None | Some("medium") => 1.0,
            Some("small") => SMALL,
            Some("big" | "large") => BIG,
            Some(other) => {
                let message = format!("{} is not a size", quoted(other));
                self.warn("sigml::size", element, "size", message);
                1.0
            }
        }
    }

    fn line(&mut self, element: &Element) -> Motion {
        let Some(direction) = self.direction(element, "direction") else {
            if element.value("direction").is_none() {
                let message = "the motion has no direction".to_owned();
                self.warn("sigml::direction", element, "", message);
            }
            return Motion::Hold;
        };
        let vector = direction * DISTANCE * self.size(element);
        let waves = match element.value("zigzag_style") {
            None => 0,
            Some("wavy" | "zigzag") => 3,
            Some(other) => {
                let message = format!("{} is not a style of waves", quoted(other));
                self.warn("sigml::size", element, "zigzag_style", message);
                0
            }
        };
        let bulge = self.direction(element, "curve");
        let side = bulge.or((waves > 0).then(|| circle_start(direction)));
        let bulge = side.map_or(DVec3::ZERO, |side| side * vector.length() * BULGE);
        Motion::Line {
            vector,
            bulge,
            waves,
        }
    }

    fn circle(&mut self, element: &Element) -> Motion {
        let axis = self.direction(element, "axis").unwrap_or(DVec3::NEG_Z);
        let radius = RADIUS * self.size(element);
        let turns = match element.value("clockplus") {
            Some("true" | "1") => 2.0,
            _ => 1.0,
        };
        Motion::Circle {
            axis,
            radius,
            turns,
        }
    }

    fn wrist(&mut self, element: &Element) -> Motion {
        let axis = match element.value("motion").unwrap_or("") {
            "swinging" | "swing" => DVec3::X,
            "twisting" | "twist" => DVec3::Y,
            "nodding" | "nod" => DVec3::Z,
            "stircw" | "stirccw" => DVec3::new(0.7, 0.0, 0.7),
            other => {
                let message = format!("{} is not a motion of the wrist", quoted(other));
                self.warn("sigml::motion", element, "motion", message);
                return Motion::Hold;
            }
        };
        Motion::Wrist(axis)
    }

    fn repeat(&mut self, element: &Element, depth: usize) -> Motion {
        let motion = Box::new(Motion::Sequence(self.children(element, depth)));
        let repetition = element.value("repetition").unwrap_or("fromstart");
        let (kind, several) = match repetition.strip_suffix("_several") {
            Some(kind) => (kind, true),
            None => (repetition, false),
        };
        let kind = match kind {
            "fromstart" => Repetition::FromStart,
            "reverse" | "swap" => Repetition::Back,
            "continue" => Repetition::Continued,
            _ => {
                let message = format!("{} is not a repetition", quoted(repetition));
                self.warn("sigml::repetition", element, "repetition", message);
                Repetition::FromStart
            }
        };
        Motion::Repeat {
            motion,
            count: if several { 3 } else { 2 },
            kind,
        }
    }

    fn target(&mut self, element: &Element, depth: usize) -> Motion {
        let mut motions = self.children(element, depth);
        let motion = match motions.len() {
            0 => Motion::Hold,
            1 => motions.remove(0),
            _ => Motion::Sequence(motions),
        };
        let mut changes = Changes::default();
        let mut reader = PostureReader {
            hands: self.hands,
            problems: self.problems,
        };
        for child in element.children.iter().filter(|child| is_posture(child)) {
            reader.read(child, &mut changes);
        }
        Motion::Target(Box::new(motion), Box::new(changes))
    }
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
