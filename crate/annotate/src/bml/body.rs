//! Head gestures and postures as animations of the library, locomotion and waiting.

use raconteur_eml::{
    AnimationStyle, Arg, ArgValue, Bones, ClauseKind, DeterministicPrimitive, FunctionArgs, Member,
    MemberKind, PlaybackStyle, PlayerAdd, PlayerKind, Posture, PrimitiveKind, VhMove, nearest,
    quoted,
};

use super::behaviour::{Kind, Point};
use super::output::Output;
use crate::script::seconds;
use crate::xml::Element;

/// Length of one pass of the animations of the head, seconds (assets/animations: 1.5 to 2.4).
pub(super) const HEAD_SECS: f64 = 1.5;
/// Maximum number of repetitions.
const MAX_REPETITIONS: f64 = 20.0;

/// Animations of head gestures (assets/animations).
const HEADS: [(&str, &str); 5] = [
    ("NOD", "nod"),
    ("SHAKE", "shake"),
    ("TILT", "tilt-head"),
    ("TILT_LEFT", "tilt-head"),
    ("TILT_RIGHT", "tilt-head"),
];

/// Animations of stances, and of poses of parts of the body.
const STANCES: [(&str, &str); 2] = [("SITTING", "sit"), ("STANDING", "stand")];
const POSES: [(&str, &str); 3] = [
    ("ARMS_AKIMBO", "hands-on-hips"),
    ("ARMS_NEUTRAL", "stand"),
    ("LEGS_OPEN", "stand-wide"),
];
/// Poses of the trunk as its lean to the front, degrees: *designed*.
const LEANS: [(&str, f64); 2] = [("LEANING_FORWARD", 14.0), ("LEANING_BACKWARD", -8.0)];

/// Returns the repetitions of a head gesture, at least 1.
pub(super) fn repetition(element: &Element) -> u32 {
    let count = element.value("repetition").and_then(|t| t.parse().ok());
    let count: f64 = count.unwrap_or(1.0);
    count.clamp(1.0, MAX_REPETITIONS) as u32
}

/// Adds the animation player of a behaviour unless it is there, and returns its name. A behaviour
/// that begins before a word or a block has one of its own: a shared one could come too late.
fn player(
    output: &mut Output<'_>,
    index: usize,
    shared: &'static str,
    group: Option<&str>,
) -> String {
    let is_early = output.when(index, Point::Start).secs < 0.0;
    let name = if is_early {
        format!("{shared}-{index}")
    } else {
        shared.to_owned()
    };
    if !output.players.insert(name.clone()) {
        return name;
    }
    let bones = group.map(|group| Bones {
        members: vec![Member {
            kind: MemberKind::Group,
            name: group.to_owned(),
        }],
    });
    let player = PlayerAdd {
        name: Some(name.clone()),
        kind: PlayerKind::Multiple,
        layers: Some(1),
        bones,
    };
    let add = ClauseKind::PlayerAdd(player);
    if is_early {
        output.push(index, Point::Start, add);
    } else {
        output.builder.push(seconds(0.0), add);
    }
    name
}

fn push(animation: &str, player: &str, style: Option<AnimationStyle>) -> ClauseKind {
    ClauseKind::DeterministicPrimitive(Box::new(DeterministicPrimitive {
        primitive: PrimitiveKind::Push,
        player: Some(player.to_owned()),
        animation: Some(animation.to_owned()),
        style,
        ..DeterministicPrimitive::default()
    }))
}

fn pop(player: &str) -> ClauseKind {
    ClauseKind::DeterministicPrimitive(Box::new(DeterministicPrimitive {
        primitive: PrimitiveKind::Pop,
        player: Some(player.to_owned()),
        ..DeterministicPrimitive::default()
    }))
}

/// Player of the head's animations.
const HEAD_PLAYER: &str = "bml-head";
/// Player of stances and poses.
const BODY_PLAYER: &str = "bml-body";
/// Player of the legs that walk.
const WALK_PLAYER: &str = "bml-walk";

/// Adds a nod or a shake of the head.
pub(super) fn add_head(output: &mut Output<'_>, index: usize) {
    let behaviour = output.behaviour(index);
    let element = behaviour.element;
    output.check_children(index, element, &[]);
    let Some(animation) = named(output, index, element, ("lexeme", &HEADS)) else {
        return;
    };
    let name = element.value("lexeme").unwrap_or("");
    if name.ends_with("_LEFT") || name.ends_with("_RIGHT") {
        let message = "the animation of the library tilts the head to its own side";
        output.lost(index, "bml::lexeme", element.tag, message);
    }
    if let Some(text) = element.attribute("amount") {
        let message = "a movement of the head has its own size; the amount has no effect";
        output.lost(index, "bml::amount", text.span, message);
    }
    let range = (1.0, MAX_REPETITIONS);
    let iterations = output.number(element, "repetition", range, 1.0) as u32;
    if behaviour.given.len() > 1 {
        let message = "a movement of the head has its own length; only its start is kept";
        output.lost(index, "bml::length", element.tag, message);
    }
    let player = player(output, index, HEAD_PLAYER, Some("head"));
    let style = AnimationStyle {
        style: PlaybackStyle::TemporaryIterations,
        iterations,
    };
    output.push(index, Point::Start, push(animation, &player, Some(style)));
}

/// Returns the meaning of an attribute by a table. Reports an unknown or missing value.
fn named<T: Copy>(
    output: &mut Output<'_>,
    index: usize,
    element: &Element,
    (attribute, table): (&str, &[(&'static str, T)]),
) -> Option<T> {
    let value = element.value(attribute).unwrap_or("");
    let mut known = table.iter();
    let found = known.find(|(name, _)| name.eq_ignore_ascii_case(value));
    if let Some((_, meaning)) = found {
        return Some(*meaning);
    }
    let span = element.attribute(attribute).map_or(element.tag, |t| t.span);
    let message = if value.is_empty() {
        format!("{} has no `{attribute}`", quoted(&element.name))
    } else {
        format!("the {attribute} {} is not performed", quoted(value))
    };
    let names: Vec<&str> = table.iter().map(|(name, _)| *name).collect();
    let hint = match nearest(value, names.iter().copied()) {
        Some(near) => format!("did you mean {near}?"),
        None => format!("known are {}", names.join(", ")),
    };
    let problem = output.lost(index, "bml::lexeme", span, message);
    problem.hints.push(hint);
    None
}

/// Maximum number of stances and poses of a posture.
const MAX_PARTS: usize = 16;

/// Adds a posture that ends, or a shift to one that stays.
pub(super) fn add_posture(output: &mut Output<'_>, index: usize) {
    let behaviour = output.behaviour(index);
    let element = behaviour.element;
    output.check_children(index, element, &["stance", "pose"]);
    let stances = element.all("stance").map(|stance| (stance, "type"));
    let poses = element.all("pose").map(|pose| (pose, "lexeme"));
    if element.children.len() > MAX_PARTS {
        let message = format!("only the first {MAX_PARTS} parts of the posture are performed");
        output.lost(index, "bml::too-large", element.tag, message);
    }
    let mut count = 0;
    for (part, attribute) in stances.chain(poses).take(MAX_PARTS) {
        count += 1;
        let lexeme = part.value(attribute).unwrap_or("");
        let mut leans = LEANS.iter();
        if let Some((_, lean_deg)) = leans.find(|(name, _)| *name == lexeme) {
            add_lean(output, index, *lean_deg);
            continue;
        }
        let table: &[(&str, &str)] = if attribute == "type" {
            &STANCES
        } else {
            &POSES
        };
        let Some(animation) = named(output, index, part, (attribute, table)) else {
            continue;
        };
        let player = player(output, index, BODY_PLAYER, None);
        output.push(index, Point::Start, push(animation, &player, None));
        if behaviour.kind == Kind::Posture {
            output.push(index, Point::Relax, pop(&player));
        }
    }
    if count == 0 {
        let message = "the posture has neither a stance nor a pose";
        output.lost(index, "bml::posture", element.tag, message);
    }
}

fn add_lean(output: &mut Output<'_>, index: usize, lean_deg: f64) {
    let posture = |lean_deg: f64, secs: f64| {
        ClauseKind::Posture(Box::new(Posture {
            lean_deg,
            duration_secs: secs.clamp(0.2, 3.0),
            ..Posture::default()
        }))
    };
    let secs = output.length_secs(index, Point::Start, Point::Ready);
    output.push(index, Point::Start, posture(lean_deg, secs));
    if output.behaviour(index).kind == Kind::Posture {
        let secs = output.length_secs(index, Point::Relax, Point::End);
        output.push(index, Point::Relax, posture(0.0, secs));
    }
}

/// Distance from a target at which a figure stops, skeleton units: *designed*, an arm's length.
const STOP_DISTANCE: f64 = 25.0;

/// Adds a walk to a target: the figure moves along a segment while its legs walk on the spot.
pub(super) fn add_locomotion(output: &mut Output<'_>, index: usize) {
    let element = output.behaviour(index).element;
    output.check_children(index, element, &[]);
    let Some([x, _, z]) = output.target(index, element) else {
        return;
    };
    let distance = raconteur_base::ops::hypot(x, z);
    let share = (1.0 - STOP_DISTANCE / distance.max(STOP_DISTANCE)).max(0.0);
    let secs = output.length_secs(index, Point::Start, Point::End);
    let args = [
        ("timePeriod", secs),
        ("endX", (x * share).round()),
        ("endZ", (z * share).round()),
    ];
    let args = args.map(|(name, value)| Arg {
        name: name.to_owned(),
        value: ArgValue::Number(value),
    });
    let motion = VhMove {
        function: "segment".to_owned(),
        args: Some(FunctionArgs { args: args.into() }),
        ..VhMove::default()
    };
    let player = player(output, index, WALK_PLAYER, None);
    output.push(index, Point::Start, push("walk", &player, None));
    output.push(index, Point::Start, ClauseKind::VhMove(motion));
    output.push(index, Point::End, pop(&player));
}

/// Adds a wait: the script goes on at least until its end.
pub(super) fn add_wait(output: &mut Output<'_>, index: usize) {
    let behaviour = output.behaviour(index);
    let element = behaviour.element;
    for child in &element.children {
        let message = "a script cannot wait for an event; it waits for the duration";
        output.lost(index, "bml::event", child.tag, message);
    }
    let duration = output.number(element, "duration", (0.0, 1e5), 0.0);
    if duration == 0.0 && !behaviour.given.contains_key(&Point::End) {
        let message = "the wait has no duration";
        output.lost(index, "bml::wait", element.tag, message);
    }
    output.push(index, Point::End, ClauseKind::Null);
}
