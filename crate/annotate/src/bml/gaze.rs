//! Gaze and head direction: eyes by control parameters, the head by its manipulator, the trunk by
//! its posture.

use raconteur_base::ops;
use raconteur_eml::{
    AdsrControlParameter, ClauseKind, ConfigureManipulator, ForwardKinematics, Manipulator,
    Posture, quoted,
};

use super::behaviour::{Kind, Point};
use super::output::Output;
use crate::script::rounded;
use crate::xml::Element;

/// Height of the eyes, speaker coordinates in skeleton units: *measured* on the shipped figures.
const EYE_HEIGHT: f64 = 35.0;
/// Turn of the eyes at the value 1 of `GazeX` and `GazeY`, degrees (docs/face.md: 0.5 rad).
const EYES_DEG: f64 = 28.6;
/// Maximum turn of the head to a side, and up or down, degrees: *designed*, within its joint limits.
const HEAD_DEG: (f64, f64) = (55.0, 25.0);
/// Maximum turn and lean of the trunk, degrees: *designed*.
const TRUNK_DEG: (f64, f64) = (30.0, 8.0);
/// Share of a direction that the trunk takes, by influence: *designed*.
const TRUNK_SHARES: [(&str, f64); 7] = [
    ("EYES", 0.0),
    ("HEAD", 0.0),
    ("NECK", 0.0),
    ("SHOULDER", 0.2),
    ("SHOULDERS", 0.2),
    ("WAIST", 0.4),
    ("WHOLE", 0.5),
];
/// Maximum offset, degrees.
const MAX_OFFSET_DEG: f64 = 180.0;

/// Direction as turns to the speaker's left and up, degrees.
#[derive(Clone, Copy)]
struct Direction {
    left_deg: f64,
    up_deg: f64,
}

/// Returns the direction from the eyes to a place.
fn direction([x, y, z]: [f64; 3]) -> Direction {
    let up = y - EYE_HEIGHT;
    Direction {
        left_deg: ops::atan2(x, -z).to_degrees(),
        up_deg: ops::atan2(up, ops::hypot(x, z)).to_degrees(),
    }
}

/// Adds a gaze, or a shift of the gaze that stays.
pub(super) fn add_gaze(output: &mut Output<'_>, index: usize) {
    let element = output.behaviour(index).element;
    output.check_children(index, element, &[]);
    let Some(place) = output.target(index, element) else {
        return;
    };
    let mut toward = direction(place);
    offset(output, index, element, &mut toward);
    let influence = element.value("influence").unwrap_or("HEAD");
    let mut shares = TRUNK_SHARES.iter();
    let share = shares.find(|(name, _)| name.eq_ignore_ascii_case(influence));
    if share.is_none() {
        let span = element
            .attribute("influence")
            .map_or(element.tag, |t| t.span);
        let message = format!("{} is not an influence; the head turns", quoted(influence));
        let problem = output.lost(index, "bml::influence", span, message);
        let hint = "influences are EYES, HEAD, SHOULDER, WAIST and WHOLE";
        problem.hints.push(hint.to_owned());
    }
    let share = share.map_or(0.0, |(_, share)| *share);
    let moves_head = !influence.eq_ignore_ascii_case("EYES");
    let trunk = Direction {
        left_deg: (toward.left_deg * share).clamp(-TRUNK_DEG.0, TRUNK_DEG.0),
        up_deg: (toward.up_deg * share).clamp(-TRUNK_DEG.1, TRUNK_DEG.1),
    };
    if share > 0.0 {
        add_trunk(output, index, trunk);
    }
    let mut rest = Direction {
        left_deg: toward.left_deg - trunk.left_deg,
        up_deg: toward.up_deg - trunk.up_deg,
    };
    if moves_head {
        let head = head_part(rest);
        add_head(output, index, head);
        rest.left_deg -= head.left_deg;
        rest.up_deg -= head.up_deg;
    }
    add_eyes(output, index, rest);
}

/// Adds a lasting direction of the head.
pub(super) fn add_head_direction(output: &mut Output<'_>, index: usize) {
    let element = output.behaviour(index).element;
    output.check_children(index, element, &[]);
    if let Some(place) = output.target(index, element) {
        add_head(output, index, head_part(direction(place)));
    }
}

fn head_part(toward: Direction) -> Direction {
    Direction {
        left_deg: toward.left_deg.clamp(-HEAD_DEG.0, HEAD_DEG.0),
        up_deg: toward.up_deg.clamp(-HEAD_DEG.1, HEAD_DEG.1),
    }
}

/// Adds the offset of a gaze to its direction.
fn offset(output: &mut Output<'_>, index: usize, element: &Element, toward: &mut Direction) {
    let range = (-MAX_OFFSET_DEG, MAX_OFFSET_DEG);
    let angle_deg = output.number(element, "offsetAngle", range, 0.0);
    let Some(text) = element.attribute("offsetDirection") else {
        toward.left_deg -= angle_deg;
        return;
    };
    let diagonal = core::f64::consts::FRAC_1_SQRT_2;
    let (left, up) = match text.value.as_str() {
        "" | "RIGHT" => (-1.0, 0.0),
        "LEFT" => (1.0, 0.0),
        "UP" => (0.0, 1.0),
        "DOWN" => (0.0, -1.0),
        "UPRIGHT" => (-diagonal, diagonal),
        "UPLEFT" => (diagonal, diagonal),
        "DOWNRIGHT" => (-diagonal, -diagonal),
        "DOWNLEFT" => (diagonal, -diagonal),
        other => {
            let message = format!("{} is not a direction of an offset", quoted(other));
            let problem = output.lost(index, "bml::direction", text.span, message);
            let hint = "directions are RIGHT, LEFT, UP, DOWN, UPRIGHT, UPLEFT, DOWNRIGHT and \
                        DOWNLEFT";
            problem.hints.push(hint.to_owned());
            return;
        }
    };
    toward.left_deg += left * angle_deg;
    toward.up_deg += up * angle_deg;
}

/// Returns true if the behaviour returns at its relax point.
fn returns(output: &Output<'_>, index: usize) -> bool {
    output.behaviour(index).kind == Kind::Gaze
}

fn add_head(output: &mut Output<'_>, index: usize, toward: Direction) {
    let configure = |is_on: bool| {
        ClauseKind::ConfigureManipulator(ConfigureManipulator {
            manipulator: Manipulator::Head,
            is_on: Some(is_on),
            ..ConfigureManipulator::default()
        })
    };
    // The head turns by its third joint and nods by its fourth (docs/eml.md).
    let joints_deg = [
        Some(0.0),
        Some(0.0),
        Some(rounded(toward.left_deg)),
        Some(rounded(0.0 - toward.up_deg)),
        Some(0.0),
        None,
    ];
    output.push(index, Point::Start, configure(true));
    let turn = ForwardKinematics {
        manipulator: Manipulator::Head,
        joint_count: Some(5),
        joints_deg,
        is_smooth: true,
    };
    output.push(
        index,
        Point::Start,
        ClauseKind::ForwardKinematics(Box::new(turn)),
    );
    if returns(output, index) {
        output.push(index, Point::Relax, configure(false));
    }
}

fn add_eyes(output: &mut Output<'_>, index: usize, toward: Direction) {
    let does_return = returns(output, index);
    for (parameter, deg) in [("GazeX", toward.left_deg), ("GazeY", toward.up_deg)] {
        let value = rounded((deg / EYES_DEG).clamp(-1.0, 1.0));
        let adsr = AdsrControlParameter {
            parameter: parameter.to_owned(),
            attack_secs: output.length_secs(index, Point::Start, Point::Ready),
            attack_value: value,
            decay_secs: 0.0,
            decay_value: value,
            sustain_secs: output.length_secs(index, Point::Ready, Point::Relax),
            sustain_value: None,
            release_secs: output.length_secs(index, Point::Relax, Point::End),
            release_value: if does_return { 0.0 } else { value },
        };
        output.push(
            index,
            Point::Start,
            ClauseKind::AdsrControlParameter(Box::new(adsr)),
        );
    }
}

/// Shortest and longest movement of a posture, seconds (docs/eml.md).
const POSTURE_SECS: (f64, f64) = (0.2, 3.0);

fn add_trunk(output: &mut Output<'_>, index: usize, toward: Direction) {
    let (least, most) = POSTURE_SECS;
    let posture = |turn_deg: f64, lean_deg: f64, secs: f64| {
        ClauseKind::Posture(Box::new(Posture {
            turn_deg: rounded(turn_deg),
            lean_deg: rounded(lean_deg),
            duration_secs: secs.clamp(least, most),
            ..Posture::default()
        }))
    };
    let secs = output.length_secs(index, Point::Start, Point::Ready);
    let kind = posture(toward.left_deg, 0.0 - toward.up_deg, secs);
    output.push(index, Point::Start, kind);
    if returns(output, index) {
        let secs = output.length_secs(index, Point::Relax, Point::End);
        output.push(index, Point::Relax, posture(0.0, 0.0, secs));
    }
}
