//! Gestures and pointing as gesture-keys, one for each phase.

use raconteur_base::{DVec3, Side};
use raconteur_eml::{
    ClauseKind, Coords, GestureKey, Handedness, Key, MotionKey, PalmKey, Phase, ShapeKey, Span,
    Track, nearest, quoted,
};

use super::behaviour::{Course, Point};
use super::lexicon::{self, Form};
use super::output::Output;
use super::times::When;
use crate::orientation::{palm_key, unit};

/// Usual lengths of the phases around a stroke, seconds: *designed*, after the storyteller's own.
const PREPARATION_SECS: f64 = 0.5;
const HOLD_SECS: f64 = 0.2;
const RETRACTION_SECS: f64 = 0.7;
/// Length of the stroke of an unknown gesture, seconds.
const STROKE_SECS: f64 = 0.5;
/// Shortest phase that is performed, seconds.
const MIN_SECS: f64 = 0.01;

/// Returns the default course of a gesture with a lexeme.
pub(super) fn course(lexeme: Option<&str>) -> Course {
    let form = lexeme.and_then(lexicon::find);
    let stroke_secs = form.map_or(STROKE_SECS, |form| form.stroke_secs);
    Course::phases(PREPARATION_SECS, stroke_secs, HOLD_SECS, RETRACTION_SECS)
}

/// Content of a stroke, in values of the hands that perform it.
struct Stroke {
    hands: Handedness,
    shape: u8,
    palm: PalmKey,
    path: Vec<[f64; 3]>,
}

/// Adds a gesture by its lexeme.
pub(super) fn add_gesture(output: &mut Output<'_>, index: usize) {
    let element = output.behaviour(index).element;
    output.check_children(index, element, &[]);
    let hands = hands(output, index);
    let Some(form) = element.value("lexeme").and_then(lexicon::find) else {
        let span = element.attribute("lexeme").map_or(element.tag, |t| t.span);
        let message = match element.value("lexeme") {
            Some(lexeme) => format!("the lexeme {} is unknown", quoted(lexeme)),
            None => "the gesture has no lexeme".to_owned(),
        };
        let names = lexicon::FORMS.iter().map(|form| form.lexeme);
        let near = nearest(element.value("lexeme").unwrap_or(""), names.clone());
        let known: Vec<&str> = names.collect();
        let hint = match near {
            Some(near) => format!("did you mean {near}? Known are {}", known.join(", ")),
            None => format!("known are {}", known.join(", ")),
        };
        let problem = output.lost(index, "bml::lexeme", span, message);
        problem.hints.push(hint);
        return;
    };
    let stroke = stroke(form, hands.unwrap_or(form.hands));
    add_phases(output, index, &stroke);
}

fn stroke(form: &Form, hands: Handedness) -> Stroke {
    // Values of both hands are those of the right one.
    let is_mirrored = hands == Handedness::Left;
    let mirror = |[x, y, z]: [f64; 3]| [if is_mirrored { 0.0 - x } else { x }, y, z];
    let (angle_deg, axis) = form.palm;
    Stroke {
        hands,
        shape: form.shape,
        palm: PalmKey {
            angle_deg: if is_mirrored { -angle_deg } else { angle_deg },
            axis: mirror(axis),
        },
        path: form.path.iter().copied().map(mirror).collect(),
    }
}

/// Returns the hands that a behaviour names. Reports an unknown mode.
fn hands(output: &mut Output<'_>, index: usize) -> Option<Handedness> {
    let text = output.behaviour(index).element.attribute("mode")?;
    let hands = match text.value.as_str() {
        "" => return None,
        "LEFT_HAND" => Handedness::Left,
        "RIGHT_HAND" => Handedness::Right,
        "BOTH_HANDS" => Handedness::Both,
        other => {
            let message = format!("{} is not a mode", quoted(other));
            let problem = output.lost(index, "bml::mode", text.span, message);
            let hint = "modes are LEFT_HAND, RIGHT_HAND and BOTH_HANDS";
            problem.hints.push(hint.to_owned());
            return None;
        }
    };
    Some(hands)
}

/// Shoulder of the right arm in the skeleton's rest pose, speaker coordinates (GEVH table A.1).
const SHOULDER: DVec3 = DVec3::new(-8.0, 24.7, 1.5);
/// Distance of the wrist from the shoulder at the start and the end of pointing, skeleton units: the
/// arm reaches 22.9. *Designed*.
const NEAR: f64 = 13.0;
const FAR: f64 = 20.0;
/// Shape of the pointing hand.
const INDEX_FINGER: u8 = 19;

/// Adds pointing at a target.
pub(super) fn add_pointing(output: &mut Output<'_>, index: usize) {
    let element = output.behaviour(index).element;
    output.check_children(index, element, &[]);
    let Some(target) = output.target(index, element) else {
        return;
    };
    let target = DVec3::from_array(target);
    let hands = hands(output, index).unwrap_or(if target.x > 0.0 {
        Handedness::Left
    } else {
        Handedness::Right
    });
    let side = match hands {
        Handedness::Left => Side::Left,
        _ => Side::Right,
    };
    // For both hands, the values are those of the right one.
    let shoulder = DVec3::new(SHOULDER.x * -side.sign(), SHOULDER.y, SHOULDER.z);
    let direction = unit(target - shoulder).unwrap_or(DVec3::NEG_Z);
    // The palm faces down, or inward where the finger points up or down.
    let inward = DVec3::X * -side.sign();
    let palm = palm_key(side, direction, DVec3::NEG_Y + inward * 0.2);
    let at = |reach: f64| (shoulder + direction * reach).to_array();
    let stroke = Stroke {
        hands,
        shape: INDEX_FINGER,
        palm: palm.unwrap_or_default(),
        path: vec![at(NEAR), at(FAR)].into_iter().map(round).collect(),
    };
    add_phases(output, index, &stroke);
}

fn round(position: [f64; 3]) -> [f64; 3] {
    position.map(|x| (x * 100.0).round() / 100.0)
}

/// Number of earlier gestures with which a gesture is compared.
const COMPARED: usize = 32;

/// Reports an earlier gesture that needs a hand at the same time, as far as the times are comparable.
fn check_overlap(output: &mut Output<'_>, index: usize, hands: Handedness) {
    let start = output.when(index, Point::Start);
    let end = output.when(index, Point::End);
    let shares = |other: Handedness| {
        other == hands || other == Handedness::Both || hands == Handedness::Both
    };
    let earlier = output.gestures.iter().rev().take(COMPARED);
    let overlaps = earlier.into_iter().any(|(other, from, to)| {
        let before = |a: &When, b: &When| b.secs_since(a).is_some_and(|secs| secs > MIN_SECS);
        shares(*other) && before(&start, to) && before(from, &end)
    });
    if overlaps {
        let span = output.behaviour(index).element.tag;
        let message = "another gesture needs the hand at the same time; they cut each other off";
        output.lost(index, "bml::same-hand", span, message);
    }
    output.gestures.push((hands, start, end));
}

/// Adds the phases of a gesture.
fn add_phases(output: &mut Output<'_>, index: usize, stroke: &Stroke) {
    check_overlap(output, index, stroke.hands);
    let first = stroke.path.first().copied().unwrap_or_default();
    let phases = [
        (Point::Start, Point::Ready, Phase::Preparation),
        (Point::Ready, Point::StrokeStart, Phase::PreStroke),
        (Point::StrokeStart, Point::StrokeEnd, Phase::Stroke),
        (Point::StrokeEnd, Point::Relax, Phase::PostStroke),
        (Point::Relax, Point::End, Phase::Retraction),
    ];
    output.check_lengths(index, phases.map(|(from, to, _)| (from, to)));
    for (from, to, phase) in phases {
        let length_secs = output.length_secs(index, from, to);
        if length_secs < MIN_SECS && phase != Phase::Stroke {
            continue;
        }
        // A gesture without length takes no time to see.
        let duration_secs = length_secs.max(MIN_SECS);
        let mut key = GestureKey {
            duration_secs,
            handedness: stroke.hands,
            phase: Some(phase),
            pace: None,
            hand_shapes: Box::default(),
            palms: Box::default(),
            motions: Box::default(),
        };
        match phase {
            Phase::Preparation => fill(&mut key, stroke, &[first]),
            Phase::Stroke => fill(&mut key, stroke, &stroke.path),
            _ => {}
        }
        output.push(index, from, ClauseKind::GestureKey(key));
    }
}

/// Fills a key with a shape and a palm, and positions evenly spaced in time.
fn fill(key: &mut GestureKey, stroke: &Stroke, path: &[[f64; 3]]) {
    // The only key of a preparation is at its end.
    let end_secs = if key.phase == Some(Phase::Preparation) {
        key.duration_secs
    } else {
        0.0
    };
    let shape = ShapeKey {
        id: stroke.shape,
        blend: None,
    };
    let count = path.len().saturating_sub(1).max(1) as f64;
    let motion = path.iter().enumerate().map(|(i, position)| {
        let secs = key.duration_secs * i as f64 / count;
        let value = MotionKey {
            position: *position,
            coords: Coords::Speaker,
        };
        (if path.len() == 1 { end_secs } else { secs }, value)
    });
    let motion: Vec<(f64, MotionKey)> = motion.collect();
    key.hand_shapes = Box::new([track([(end_secs, shape)])]);
    key.palms = Box::new([track([(end_secs, stroke.palm)])]);
    key.motions = Box::new([track(motion)]);
}

/// Returns a track of every hand that takes part.
fn track<K>(keys: impl IntoIterator<Item = (f64, K)>) -> Track<K> {
    let keys = keys.into_iter().map(|(secs, value)| Key {
        offset_secs: crate::script::rounded(secs),
        value,
        profile: None,
        span: Span::default(),
    });
    Track {
        hand: None,
        keys: keys.collect(),
        profile: None,
        span: Span::default(),
    }
}
