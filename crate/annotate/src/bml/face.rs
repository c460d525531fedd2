//! Faces as control parameters: lexemes, and action units of the Facial Action Coding System.

use raconteur_eml::{AdsrControlParameter, ClauseKind, nearest, quoted};

use super::behaviour::{Kind, Point};
use super::output::Output;
use crate::script::rounded;
use crate::xml::Element;

/// Control parameters with their values at the full amount; a name that ends in `*` exists for the
/// left and the right side.
type Parameters = &'static [(&'static str, f64)];

/// Lexemes of faces with the side that they move: `Both` unless their name says otherwise. The
/// muscles are those of the action units (FACS); the values are *designed*.
const LEXEMES: [(&str, Half, Parameters); 26] = [
    ("ANGER", Half::Both, &[("Anger", 1.0)]),
    ("CLOSE_EYES", Half::Both, &[("UpperLid*", 1.0)]),
    ("DISGUST", Half::Both, &[("Disgust", 1.0)]),
    ("FEAR", Half::Both, &[("Fear", 1.0)]),
    ("JOY", Half::Both, &[("Joy", 1.0)]),
    ("LOWER_BROWS", Half::Both, FROWN),
    ("LOWER_LEFT_BROW", Half::Left, FROWN),
    (
        "LOWER_LEFT_MOUTH_CORNER",
        Half::Left,
        &[("DepressorAnguliOris*", 1.0)],
    ),
    (
        "LOWER_MOUTH_CORNERS",
        Half::Both,
        &[("DepressorAnguliOris*", 1.0)],
    ),
    ("LOWER_RIGHT_BROW", Half::Right, FROWN),
    (
        "LOWER_RIGHT_MOUTH_CORNER",
        Half::Right,
        &[("DepressorAnguliOris*", 1.0)],
    ),
    ("NEUTRAL", Half::Both, &[]),
    (
        "OBLIQUE_BROWS",
        Half::Both,
        &[("FrontalisMedial*", 1.0), ("CorrugatorSupercilii*", 0.6)],
    ),
    (
        "OPEN_LIPS",
        Half::Both,
        &[
            ("DepressorLabiiInferioris*", 0.5),
            ("LevatorLabiiSuperioris*", 0.2),
        ],
    ),
    ("OPEN_MOUTH", Half::Both, &[("Jaw", 0.8)]),
    ("RAISE_BROWS", Half::Both, RAISE),
    ("RAISE_LEFT_BROW", Half::Left, RAISE),
    (
        "RAISE_LEFT_MOUTH_CORNER",
        Half::Left,
        &[("ZygomaticusMajor*", 1.0)],
    ),
    (
        "RAISE_MOUTH_CORNERS",
        Half::Both,
        &[("ZygomaticusMajor*", 1.0)],
    ),
    ("RAISE_RIGHT_BROW", Half::Right, RAISE),
    (
        "RAISE_RIGHT_MOUTH_CORNER",
        Half::Right,
        &[("ZygomaticusMajor*", 1.0)],
    ),
    ("SADNESS", Half::Both, &[("Sadness", 1.0)]),
    (
        "SMILE",
        Half::Both,
        &[("ZygomaticusMajor*", 1.0), ("OrbicularisOculi*", 0.4)],
    ),
    ("SURPRISE", Half::Both, &[("Surprise", 1.0)]),
    ("WIDEN_EYES", Half::Both, &[("UpperLid*", -1.0)]),
    (
        "WINK",
        Half::Left,
        &[("UpperLid*", 1.0), ("OrbicularisOculi*", 0.5)],
    ),
];
const RAISE: Parameters = &[("FrontalisMedial*", 1.0), ("FrontalisLateral*", 1.0)];
const FROWN: Parameters = &[
    ("CorrugatorSupercilii*", 1.0),
    ("DepressorSupercilii*", 0.8),
];

/// Action units with their muscles (Ekman, Friesen & Hager 2002); the values are *designed*.
const ACTION_UNITS: [(u32, Parameters); 37] = [
    (1, &[("FrontalisMedial*", 1.0)]),
    (2, &[("FrontalisLateral*", 1.0)]),
    (4, FROWN),
    (5, &[("UpperLid*", -1.0)]),
    (6, &[("OrbicularisOculi*", 1.0)]),
    (7, &[("LowerLid*", 1.0), ("UpperLid*", 0.2)]),
    (8, &[("LipSeal", 1.0)]),
    (9, &[("LevatorLabiiSuperiorisAlaequeNasi*", 1.0)]),
    (10, &[("LevatorLabiiSuperioris*", 1.0)]),
    (11, &[("ZygomaticusMinor*", 1.0)]),
    (12, &[("ZygomaticusMajor*", 1.0)]),
    (13, &[("LevatorAnguliOris*", 1.0)]),
    (14, &[("Buccinator*", 1.0)]),
    (15, &[("DepressorAnguliOris*", 1.0)]),
    (16, &[("DepressorLabiiInferioris*", 1.0)]),
    (17, &[("Mentalis*", 1.0)]),
    (
        18,
        &[("LipProtrusionUpper", 0.8), ("LipProtrusionLower", 0.8)],
    ),
    (20, &[("Risorius*", 1.0)]),
    (21, &[("Platysma*", 1.0)]),
    (
        22,
        &[("LipProtrusionUpper", 1.0), ("LipProtrusionLower", 1.0)],
    ),
    (
        23,
        &[("OrbicularisOrisUpper", 0.7), ("OrbicularisOrisLower", 0.7)],
    ),
    (
        24,
        &[("OrbicularisOrisUpper", 1.0), ("OrbicularisOrisLower", 1.0)],
    ),
    (
        25,
        &[
            ("DepressorLabiiInferioris*", 0.5),
            ("LevatorLabiiSuperioris*", 0.2),
        ],
    ),
    (26, &[("Jaw", 0.5)]),
    (27, &[("Jaw", 1.0)]),
    (
        28,
        &[("LipProtrusionUpper", -1.0), ("LipProtrusionLower", -1.0)],
    ),
    (29, &[("JawForward", 1.0)]),
    (31, &[("Masseter*", 1.0)]),
    (38, &[("Nasalis*", 1.0)]),
    (43, &[("UpperLid*", 1.0)]),
    (44, &[("UpperLid*", 0.6), ("LowerLid*", 0.6)]),
    (45, &[("UpperLid*", 1.0)]),
    (46, &[("UpperLid*", 1.0)]),
    (61, &[("GazeX", 1.0)]),
    (62, &[("GazeX", -1.0)]),
    (63, &[("GazeY", 1.0)]),
    (64, &[("GazeY", -1.0)]),
];

/// Half of the face that moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Half {
    Left,
    Right,
    Both,
}

/// Maximum number of lexemes and action units of a face; the head has fewer muscles.
const MAX_PARTS: usize = 64;
/// Default amount (BML 1.0).
const AMOUNT: f64 = 0.5;

/// Adds a face: its own lexeme or action unit, and those of its children.
pub(super) fn add(output: &mut Output<'_>, index: usize) {
    let behaviour = output.behaviour(index);
    let element = behaviour.element;
    let parts = ["lexeme", "faceLexeme", "facs", "faceFacs"];
    let is_container = matches!(behaviour.kind, Kind::Face | Kind::FaceShift);
    output.check_children(index, element, if is_container { &parts } else { &[] });
    let amount = output.number(element, "amount", (0.0, 1.0), AMOUNT);
    if element.children.len() >= MAX_PARTS {
        let message = format!("only the first {MAX_PARTS} parts of the face are performed");
        output.lost(index, "bml::too-large", element.tag, message);
    }
    let mut count = 0;
    let is_part = |child: &Element| {
        let mut parts = parts.iter();
        parts.any(|name| child.name.eq_ignore_ascii_case(name))
    };
    let children = element
        .children
        .iter()
        .filter(|child| is_container && is_part(child));
    for child in core::iter::once(element).chain(children).take(MAX_PARTS) {
        let own = if core::ptr::eq(child, element) {
            amount
        } else {
            output.number(child, "amount", (0.0, 1.0), amount)
        };
        if child.attribute("lexeme").is_some() {
            count += 1;
            add_lexeme(output, index, child, own);
        }
        if child.attribute("au").is_some() {
            count += 1;
            add_action_unit(output, index, child, own);
        }
    }
    if count == 0 {
        let message = "the face has neither a lexeme nor an action unit";
        let problem = output.lost(index, "bml::face", element.tag, message);
        let hint = "a face has `lexeme`, or `au` with `side`";
        problem.hints.push(hint.to_owned());
    }
}

fn add_lexeme(output: &mut Output<'_>, index: usize, element: &Element, amount: f64) {
    let Some(text) = element.attribute("lexeme") else {
        return;
    };
    let mut lexemes = LEXEMES.iter();
    let found = lexemes.find(|(name, ..)| name.eq_ignore_ascii_case(&text.value));
    let Some((_, half, parameters)) = found else {
        let message = format!("the lexeme {} is unknown", quoted(&text.value));
        let names = LEXEMES.iter().map(|(name, ..)| *name);
        let known: Vec<&str> = names.clone().collect();
        let hint = match nearest(&text.value, names) {
            Some(near) => format!("did you mean {near}? Known are {}", known.join(", ")),
            None => format!("known are {}", known.join(", ")),
        };
        let problem = output.lost(index, "bml::lexeme", text.span, message);
        problem.hints.push(hint);
        return;
    };
    add_parameters(output, index, (parameters, *half), amount);
}

fn add_action_unit(output: &mut Output<'_>, index: usize, element: &Element, amount: f64) {
    let Some(text) = element.attribute("au") else {
        return;
    };
    let digits = text.value.trim_start_matches(['A', 'U', 'a', 'u']);
    let number = digits.parse::<u32>().ok();
    let found = ACTION_UNITS
        .iter()
        .find(|(known, _)| Some(*known) == number);
    let Some((number, parameters)) = found else {
        let message = format!("the action unit {} is not performed", quoted(&text.value));
        let known: Vec<String> = ACTION_UNITS.iter().map(|(n, _)| n.to_string()).collect();
        let problem = output.lost(index, "bml::action-unit", text.span, message);
        problem
            .hints
            .push(format!("known are {}", known.join(", ")));
        return;
    };
    let half = match element.value("side").unwrap_or("BOTH") {
        "LEFT" => Half::Left,
        "RIGHT" => Half::Right,
        "BOTH" => Half::Both,
        other => {
            let span = element.attribute("side").map_or(element.tag, |t| t.span);
            let message = format!("{} is not a side; both move", quoted(other));
            let problem = output.lost(index, "bml::side", span, message);
            let hint = "sides are LEFT, RIGHT and BOTH";
            problem.hints.push(hint.to_owned());
            Half::Both
        }
    };
    let has_sides = parameters.iter().any(|(name, _)| name.ends_with('*'));
    if half != Half::Both && !has_sides {
        let message = format!("action unit {number} moves both sides");
        output.lost(index, "bml::side", text.span, message);
    }
    add_parameters(output, index, (parameters, half), amount);
}

/// Adds the parameters of a face with their course over its sync points.
fn add_parameters(
    output: &mut Output<'_>,
    index: usize,
    (parameters, half): (Parameters, Half),
    amount: f64,
) {
    let stays = output.behaviour(index).kind == Kind::FaceShift;
    for (name, full) in parameters {
        let parameter = match (name.strip_suffix('*'), half) {
            (Some(name), Half::Left) => format!("{name}Left"),
            (Some(name), Half::Right) => format!("{name}Right"),
            (Some(name), Half::Both) => name.to_owned(),
            (None, _) => (*name).to_owned(),
        };
        let value = rounded(full * amount);
        let adsr = AdsrControlParameter {
            parameter,
            attack_secs: output.length_secs(index, Point::Start, Point::Ready),
            attack_value: value,
            decay_secs: 0.0,
            decay_value: value,
            sustain_secs: output.length_secs(index, Point::Ready, Point::Relax),
            sustain_value: None,
            release_secs: output.length_secs(index, Point::Relax, Point::End),
            release_value: if stays { value } else { 0.0 },
        };
        output.push(
            index,
            Point::Start,
            ClauseKind::AdsrControlParameter(Box::new(adsr)),
        );
    }
}
