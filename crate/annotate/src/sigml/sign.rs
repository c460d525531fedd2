//! One sign as gesture-keys.

use raconteur_base::{DQuat, DVec3, Side};
use raconteur_eml::{
    ClauseKind, Coords, Diagnostic, GestureKey, Handedness, Key, MotionKey, PalmKey, Phase,
    ShapeKey, Span, Track, quoted,
};

use super::motion::{MAX_KEYS, Motion, handedness, shape};
use super::posture::{Change, Changes, Contact, HandPose, Hands};
use super::read_motion::{MotionReader, is_motion};
use super::read_posture::{PostureReader, is_posture};
use super::vocabulary::palm;
use crate::orientation::palm_key;
use crate::script::{Builder, permitted, rounded, seconds};
use crate::xml::Element;

/// Usual lengths, seconds: *designed*. Of the preparation of a sign, of one without a motion, and of
/// the hold after a sign.
const PREPARATION_SECS: f64 = 0.55;
const STILL_SECS: f64 = 0.5;
const HOLD_SECS: f64 = 0.25;
/// Distance from the wrist to the middle of the hand, skeleton units (GEVH table A.1: 3.54 to the
/// knuckles).
const MIDDLE: f64 = 3.5;
/// Component of the fingers towards the body from which they point at it.
const TOWARDS_BODY: f64 = 0.4;
/// Pace of a sign, relative to the usual one.
const PACES: (f64, f64) = (0.2, 5.0);

/// Keys of the hands at a time, seconds after the start of the stroke.
struct Sample {
    secs: f64,
    poses: [HandPose; 2],
}

/// Signs performed so far.
#[derive(Default)]
pub(super) struct SignSequence {
    pub(super) builder: Builder,
    /// End of the last sign, seconds.
    end_secs: f64,
    /// Hands that are raised.
    raised: [bool; 2],
}

impl SignSequence {
    /// Adds a sign. Its manual part is gestural SiGML.
    pub(super) fn add(&mut self, sign: &Element, manual: &Element, problems: &mut Vec<Diagnostic>) {
        let hands = Hands::read(manual);
        let mut moves = hands.moves;
        let mut poses = [HandPose::neutral(1.0), HandPose::neutral(-1.0)];
        let mut changes = Changes::default();
        let mut motions = Vec::new();
        self.read(manual, hands, &mut changes, &mut motions, problems);
        for hand in 0..2 {
            moves[hand] |= changes[hand] != Change::default();
            changes[hand].apply(&mut poses[hand]);
        }
        let motion = Motion::Sequence(motions);
        let pace = pace(sign, problems);
        let is_still = motion.secs() <= 0.0;
        let stroke_secs = rounded(if is_still { STILL_SECS } else { motion.secs() } / pace);
        let mut keys = vec![0.0];
        motion.add_keys(0.0, stroke_secs, &mut keys);
        keys.retain(|secs| secs.is_finite());
        raconteur_base::order::sort_by_number(&mut keys, |secs| *secs);
        keys.dedup_by(|b, a| (*b - *a).abs() < MIN_GAP_SECS);
        keys.truncate(MAX_KEYS);
        let sample = |secs: f64| {
            let progress = if is_still { 0.0 } else { secs / stroke_secs };
            let mut poses = poses;
            for (hand, pose) in poses.iter_mut().enumerate() {
                motion.apply(progress.clamp(0.0, 1.0), hand, &hands, pose);
            }
            Sample { secs, poses }
        };
        let samples: Vec<Sample> = keys.into_iter().map(sample).collect();
        self.perform(
            sign,
            moves,
            &samples,
            [PREPARATION_SECS / pace, stroke_secs],
        );
    }

    /// Reads postures up to the first motion, and all motions.
    fn read(
        &mut self,
        manual: &Element,
        hands: Hands,
        changes: &mut Changes,
        motions: &mut Vec<Motion>,
        problems: &mut Vec<Diagnostic>,
    ) {
        let mut count = 0;
        for child in &manual.children {
            if is_motion(child) {
                let mut reader = MotionReader {
                    hands,
                    problems,
                    count,
                };
                motions.push(reader.read(child, 0));
                count = reader.count;
            } else if child.name == "sign_manual" {
                // The depth of a file is limited.
                self.read(child, hands, changes, motions, problems);
            } else if is_posture(child) && motions.is_empty() {
                PostureReader { hands, problems }.read(child, changes);
            } else {
                let message = if is_posture(child) {
                    "a posture after a motion has no effect; it belongs into `tgt_motion`".into()
                } else {
                    format!("{} is not performed", quoted(&child.name))
                };
                problems.push(Diagnostic::warning(
                    "sigml::unknown-element",
                    child.tag,
                    message,
                ));
            }
        }
    }

    /// Adds the gloss and the phases of a sign.
    fn perform(
        &mut self,
        sign: &Element,
        moves: [bool; 2],
        samples: &[Sample],
        [preparation_secs, stroke_secs]: [f64; 2],
    ) {
        let start_secs = self.end_secs;
        let stroke_at = start_secs + preparation_secs;
        self.end_secs = stroke_at + stroke_secs + HOLD_SECS;
        // A hand that rests in this sign goes back.
        for hand in 0..2 {
            if self.raised[hand] && !moves[hand] {
                let mut only = [false; 2];
                only[hand] = true;
                self.retract(only, start_secs);
            }
        }
        if let Some(gloss) = sign.value("gloss") {
            let event = ClauseKind::Event {
                kind: Some("gloss".into()),
                payload: permitted(gloss).into(),
            };
            self.builder.push(seconds(stroke_at), event);
        }
        let first = samples.get(..1).unwrap_or(samples);
        let phases = [
            (start_secs, preparation_secs, Phase::Preparation, first),
            (stroke_at, stroke_secs, Phase::Stroke, samples),
            (stroke_at + stroke_secs, HOLD_SECS, Phase::PostStroke, &[]),
        ];
        for (at, secs, phase, samples) in phases {
            let key = gesture_key(secs, phase, moves, samples);
            self.builder.push(seconds(at), ClauseKind::GestureKey(key));
        }
        self.raised = moves;
    }

    fn retract(&mut self, moves: [bool; 2], at_secs: f64) {
        let key = gesture_key(RETRACTION_SECS, Phase::Retraction, moves, &[]);
        self.builder
            .push(seconds(at_secs), ClauseKind::GestureKey(key));
    }

    /// Returns the hands to rest.
    pub(super) fn finish(&mut self) {
        if self.raised != [false, false] {
            self.retract(self.raised, self.end_secs);
        }
    }
}

/// Length of a retraction, seconds: *designed*.
const RETRACTION_SECS: f64 = 0.8;
/// Least time between two keys, seconds.
const MIN_GAP_SECS: f64 = 0.02;

/// Returns the pace of a sign.
fn pace(sign: &Element, problems: &mut Vec<Diagnostic>) -> f64 {
    let speed = sign.number("speed", "sigml::number", problems);
    let scale = sign.number("timescale", "sigml::number", problems);
    let pace = speed.unwrap_or(1.0) / scale.filter(|s| *s > 0.0).unwrap_or(1.0);
    let (least, most) = PACES;
    pace.clamp(least, most)
}

fn gesture_key(
    duration_secs: f64,
    phase: Phase,
    moves: [bool; 2],
    samples: &[Sample],
) -> GestureKey {
    let handedness = handedness(moves);
    let mut key = GestureKey {
        duration_secs: rounded(duration_secs),
        handedness,
        phase: Some(phase),
        pace: None,
        hand_shapes: Box::default(),
        palms: Box::default(),
        motions: Box::default(),
    };
    if samples.is_empty() {
        return key;
    }
    let hands = [(0, Side::Right), (1, Side::Left)];
    let taking: Vec<(usize, Side)> = hands.into_iter().filter(|(hand, _)| moves[*hand]).collect();
    let hand = |side: Side| (handedness == Handedness::Both).then_some(side);
    // The only key of a preparation is at its end.
    let secs = |sample: &Sample| match phase {
        Phase::Preparation => key.duration_secs,
        _ => rounded(sample.secs),
    };
    let tracks = taking.iter().map(|(index, side)| {
        let poses = samples.iter().map(|s| (secs(s), s.poses[*index]));
        let poses: Vec<(f64, HandPose)> = poses.collect();
        let shapes = poses.iter().map(|(secs, pose)| (*secs, shape(pose)));
        let palms = poses
            .iter()
            .map(|(secs, pose)| (*secs, orientation(pose, *side)));
        let motions = poses.iter().map(|(secs, pose)| (*secs, wrist(pose)));
        (
            track(hand(*side), shapes),
            track(hand(*side), palms),
            track(hand(*side), motions),
        )
    });
    let mut shapes: Vec<Track<ShapeKey>> = Vec::new();
    let mut palms: Vec<Track<PalmKey>> = Vec::new();
    let mut motions: Vec<Track<MotionKey>> = Vec::new();
    for (shape, palm, motion) in tracks {
        shapes.push(shape);
        palms.push(palm);
        motions.push(motion);
    }
    key.hand_shapes = shapes.into();
    key.palms = palms.into();
    key.motions = motions.into();
    key
}

/// Returns a track without keys that repeat the one before.
fn track<K: PartialEq>(hand: Option<Side>, keys: impl Iterator<Item = (f64, K)>) -> Track<K> {
    let mut all: Vec<Key<K>> = Vec::new();
    let mut skipped: Option<Key<K>> = None;
    for (offset_secs, value) in keys {
        let key = Key {
            offset_secs,
            value,
            profile: None,
            span: Span::default(),
        };
        if all.last().is_some_and(|last| last.value == key.value) {
            skipped = Some(key);
            continue;
        }
        // The end of a constant part remains, so that the change begins there.
        all.extend(skipped.take());
        all.push(key);
    }
    Track {
        hand,
        keys: all,
        profile: None,
        span: Span::default(),
    }
}

/// Returns the directions of the fingers and the palm.
fn directions(pose: &HandPose) -> (DVec3, DVec3) {
    let fingers = pose.fingers * pose.mirror;
    let normal = palm(pose.palm, pose.fingers) * pose.mirror;
    let across = fingers.cross(normal);
    let turn = |axis: DVec3, deg: f64| match crate::orientation::unit(axis) {
        Some(axis) => DQuat::from_axis_angle(axis, deg.to_radians()),
        None => DQuat::IDENTITY,
    };
    let wrist = pose.wrist_deg;
    let turn = turn(normal, wrist.x) * turn(fingers, wrist.y) * turn(across, wrist.z);
    (turn * fingers, turn * normal)
}

fn orientation(pose: &HandPose, side: Side) -> PalmKey {
    let (fingers, normal) = directions(pose);
    let key = palm_key(side, fingers, normal);
    // Palm and fingers of one direction leave the palm open.
    let key = key.or_else(|| palm_key(side, fingers, DVec3::NEG_Y));
    let key = key.or_else(|| palm_key(side, fingers, DVec3::NEG_Z));
    let mut key = key.unwrap_or(PalmKey {
        angle_deg: 0.0,
        axis: [0.0, -1.0, 0.0],
    });
    key.angle_deg = (key.angle_deg * 100.0).round() / 100.0;
    key.axis = key.axis.map(|x| (x * 10_000.0).round() / 10_000.0);
    key
}

fn wrist(pose: &HandPose) -> MotionKey {
    let (fingers, _) = directions(pose);
    let length = match pose.contact {
        Contact::Tips => pose.reach,
        Contact::Either if fingers.z > TOWARDS_BODY => pose.reach,
        _ => MIDDLE,
    };
    let position = pose.position - fingers * length;
    MotionKey {
        position: position
            .to_array()
            .map(|x| 0.0 + (x * 100.0).round() / 100.0),
        coords: Coords::Speaker,
    }
}
