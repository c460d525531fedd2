//! Conversion of the clauses of manipulators and `vh-move` to commands of the actor.
//!
//! Targets are in the figure's own world coordinates: units from the floor below it, which
//! `vh-move` moves.

use core::f64::consts::{FRAC_PI_2, PI};

use raconteur_actor::ManipulatorScript;
use raconteur_actor::limb::{Limb, RigidFrame};
use raconteur_actor::manipulator::path::rotation_from;
use raconteur_actor::manipulator::{
    Command, JointSpeed, Motion, Path, PathShape, Placement, RootMotion,
};
use raconteur_base::{DVec3, Length, ops};
use raconteur_eml::{
    Arg, ArgValue, ClauseKind, Diagnostic, Document, FunctionArgs, MAX_COORDINATE, Manipulator,
    Span, Target, Timeline, nearest, quoted,
};
use raconteur_stage::{Gesture, TakenSpace};

use crate::lower::reach::Reach;
use crate::lower::units::Units;

/// Extension of the hand's reach by the spine, as a share of the arm; measured on the example
/// figure to the side, where it is smallest except for straight up.
const SPINE_HELP: f64 = 0.14;

/// Functions of time: name, and arguments in addition to the period, the angles of both ends and,
/// for paths between places, the positions of both ends. A name ending in `*` stands for three,
/// ending in X, Y and Z.
const FUNCTIONS: [(&str, bool, &[&str]); 8] = [
    ("segment", true, &[]),
    ("sinusoid", true, &["amplitude", "across*", "cycles"]),
    ("bezier", true, &["control1*", "control2*"]),
    ("hermite", true, &["startVelocity*", "endVelocity*"]),
    (
        "circle",
        false,
        &["center*", "normal*", "radius", "startAngle", "turns"],
    ),
    (
        "ellipse",
        false,
        &[
            "center*",
            "normal*",
            "radiusX",
            "radiusY",
            "startAngle",
            "turns",
        ],
    ),
    (
        "helix",
        false,
        &[
            "center*",
            "normal*",
            "radius",
            "startAngle",
            "turns",
            "rise",
        ],
    ),
    (
        "lemniscate",
        false,
        &["center*", "normal*", "radius", "tilt", "turns"],
    ),
];

const AXES: [&str; 3] = ["X", "Y", "Z"];
const ANGLES: [&str; 3] = ["Yaw", "Pitch", "Roll"];

fn limb(manipulator: Manipulator) -> Limb {
    match manipulator {
        Manipulator::LeftArm => Limb::LeftArm,
        Manipulator::RightArm => Limb::RightArm,
        Manipulator::LeftLeg => Limb::LeftLeg,
        Manipulator::RightLeg => Limb::RightLeg,
        Manipulator::Head => Limb::Head,
    }
}

fn bounded(number: f64) -> f64 {
    number.clamp(-MAX_COORDINATE, MAX_COORDINATE)
}

fn frame(target: &Target, units: &Units) -> RigidFrame {
    RigidFrame {
        position: units.world_point(target.position.map(bounded)),
        rotation: rotation_from(Units::angles(target.angles_deg.map(bounded))),
    }
}

/// The arguments of a function.
struct Args<'a> {
    args: &'a FunctionArgs,
    units: &'a Units,
}

impl Args<'_> {
    fn number(&self, name: &str) -> Option<f64> {
        self.args.number(name).map(bounded)
    }

    fn length(&self, name: &str) -> f64 {
        self.number(name).unwrap_or(0.0) * self.units.metres()
    }

    /// Returns three numeric arguments whose names have a common start; `None` for absent ones.
    fn three(&self, start: &str, ends: [&str; 3]) -> [Option<f64>; 3] {
        ends.map(|end| {
            let mut known = self.args.args.iter().rev();
            let found = known.find(|arg| arg.name.strip_prefix(start) == Some(end))?;
            match found.value {
                ArgValue::Number(number) => Some(bounded(number)),
                ArgValue::Text(_) => None,
            }
        })
    }

    /// Returns a direction, unscaled; zero if absent.
    fn direction(&self, start: &str) -> DVec3 {
        Units::axis(self.three(start, AXES).map(|n| n.unwrap_or(0.0)))
    }

    fn place(&self, start: &str) -> Placement {
        let metres = self.units.metres();
        let [x, y, z] = self.three(start, AXES);
        let [yaw, pitch, roll] = self.three(start, ANGLES);
        Placement {
            position: [
                x.map(|x| x * metres),
                y.map(|y| y * metres),
                z.map(|z| -z * metres),
            ],
            angles: [
                yaw.map(|a| -a.to_radians()),
                pitch.map(|a| -a.to_radians()),
                roll.map(f64::to_radians),
            ],
        }
    }

    fn shape(&self, function: &str, period_secs: f64) -> Option<PathShape> {
        let metres = self.units.metres();
        let number = |name, default| self.number(name).unwrap_or(default);
        Some(match function {
            "segment" => PathShape::Segment,
            "sinusoid" => {
                let across = self.direction("across").try_normalized();
                PathShape::Sinusoid {
                    across: across.unwrap_or(DVec3::Y) * self.length("amplitude"),
                    cycles: number("cycles", 1.0),
                }
            }
            "bezier" => PathShape::Bezier {
                controls: ["control1", "control2"].map(|c| self.place(c)),
            },
            "hermite" => PathShape::Hermite {
                tangents: ["startVelocity", "endVelocity"]
                    .map(|v| self.direction(v) * metres * period_secs),
            },
            "circle" | "ellipse" | "helix" => PathShape::Round {
                centre: self.place("center"),
                normal: self.direction("normal"),
                radii: if function == "ellipse" {
                    ["radiusX", "radiusY"].map(|r| self.length(r))
                } else {
                    [self.length("radius"); 2]
                },
                from_rad: number("startAngle", 0.0).to_radians(),
                turns: number("turns", 1.0),
                rise: self.length("rise"),
            },
            "lemniscate" => PathShape::Lemniscate {
                centre: self.place("center"),
                normal: self.direction("normal"),
                half_width: self.length("radius"),
                tilt_rad: number("tilt", 0.0).to_radians(),
                turns: number("turns", 1.0),
            },
            _ => return None,
        })
    }
}

/// Converts a function to a path; `None` for an unknown name.
fn path(function: &str, looping: bool, args: Option<&FunctionArgs>, units: &Units) -> Option<Path> {
    let none = FunctionArgs::default();
    let args = args.unwrap_or(&none);
    let period_secs = args.period_secs().min(MAX_COORDINATE);
    let args = Args { args, units };
    Some(Path {
        shape: args.shape(function, period_secs)?,
        from: args.place("start"),
        to: args.place("end"),
        period_secs,
        looping,
    })
}

fn motion(kind: &ClauseKind, units: &Units) -> Option<(Manipulator, Motion)> {
    Some(match kind {
        ClauseKind::ConfigureManipulator(c) => (
            c.manipulator,
            Motion::Configure {
                is_on: c.is_on,
                limits: c.joint_limits_active,
                preferred: c.preferred_deg.as_ref().map(|preferred| {
                    let angles = preferred.iter().map(|a| a.to_radians());
                    angles.collect()
                }),
            },
        ),
        ClauseKind::ForwardKinematics(fk) => {
            let angles = fk.counted_deg().map(|j| j.map(|a| bounded(a).to_radians()));
            let secs = fk.length_secs();
            (fk.manipulator, Motion::Joints { angles, secs })
        }
        ClauseKind::JointInterpolation(j) => {
            let speed = j.static_velocity_rad_per_s.unwrap_or(0.0);
            let pace = j
                .static_time_secs
                .map_or(JointSpeed::RadPerSec(speed), JointSpeed::Secs);
            let to = frame(&j.target, units);
            (j.manipulator, Motion::JointInterpolation { to, pace })
        }
        ClauseKind::FrameInterpolation(f) => {
            let to = frame(&f.target, units);
            let secs = f.period_secs;
            (f.manipulator, Motion::FrameInterpolation { to, secs })
        }
        ClauseKind::ManipulatorFunction(f) => {
            let path = path(&f.function, f.is_looping, f.args.as_ref(), units)?;
            (f.manipulator, Motion::Function(Box::new(path)))
        }
        ClauseKind::Jacobian(j) if j.is_static_target => (
            j.manipulator,
            Motion::JacobianTarget(frame(&j.target, units)),
        ),
        ClauseKind::Jacobian(j) => {
            let linear = Units::axis(j.velocity.map(bounded)) * units.metres();
            let angular = Units::angular(j.angular_velocity_deg.map(bounded));
            (j.manipulator, Motion::JacobianVelocity { linear, angular })
        }
        ClauseKind::ManipulatorStop(s) => (s.manipulator, Motion::Stop),
        ClauseKind::ManipulatorLock(l) => (l.manipulator, Motion::Lock(l.is_lock)),
        _ => return None,
    })
}

/// Converts a position of the whole figure from the frame of its root. That frame is turned by half
/// a turn in table A.1 of GEVH (the sacroiliac's first angle is 178.7°); in the example of D.1.6,
/// whose pitch is 180° throughout, the figure is upright. So a pitch beyond a right angle is
/// counted from there.
fn upright(place: &mut Placement) {
    let [_, pitch, roll] = &mut place.angles;
    if let Some(pitch) = pitch
        && ops::wrap_angle(*pitch).abs() > FRAC_PI_2
    {
        *pitch = ops::wrap_angle(*pitch + PI);
        // The reversed axis of the roll points the other way.
        *roll = roll.map(|roll| -roll);
    }
}

/// Returns a script's commands to manipulators, and its motions of the whole figure.
pub(crate) fn script(document: &Document, timeline: &Timeline, units: &Units) -> ManipulatorScript {
    let mut script = ManipulatorScript::default();
    for timed in &timeline.clauses {
        let kind = &document.clause(timed.clause).kind;
        let time_secs = timed.start_secs;
        if let ClauseKind::VhMove(m) = kind {
            if let Some(mut path) = path(&m.function, m.is_looping, m.args.as_ref(), units) {
                upright(&mut path.from);
                upright(&mut path.to);
                script.moves.push(RootMotion { time_secs, path });
            }
        } else if let Some((manipulator, motion)) = motion(kind, units) {
            script.commands.push(Command {
                time_secs,
                limb: limb(manipulator),
                motion,
            });
        }
    }
    script
}

/// Merges the manipulator commands and figure motions of all scripts of a performance.
pub(crate) fn together<'a>(
    scripts: impl Iterator<Item = &'a ManipulatorScript>,
) -> ManipulatorScript {
    let mut all = ManipulatorScript::default();
    for script in scripts {
        all.commands.extend_from_slice(&script.commands);
        all.moves.extend_from_slice(&script.moves);
    }
    all
}

/// Returns true if there are no commands and no moves.
pub(crate) fn is_empty(script: &ManipulatorScript) -> bool {
    script.commands.is_empty() && script.moves.is_empty()
}

/// Returns the image space that targets of the arms and motions of the figure need: for the whole
/// time, since they follow one another; `None` without commands.
pub(crate) fn space(script: &ManipulatorScript, hand_length_m: f64) -> Option<Gesture> {
    if is_empty(script) {
        return None;
    }
    // Released hands hang.
    let mut space = TakenSpace {
        top_m: 0.0,
        bottom_m: 0.0,
        half_width_m: 0.0,
    };
    let mut hold = |x: f64, top: f64| {
        space.half_width_m = space.half_width_m.max(x.abs() + hand_length_m);
        space.top_m = space.top_m.max(top + hand_length_m);
    };
    for command in &script.commands {
        let is_arm = command.limb.side().is_some_and(|(_, is_arm)| is_arm);
        match &command.motion {
            Motion::JointInterpolation { to, .. }
            | Motion::FrameInterpolation { to, .. }
            | Motion::JacobianTarget(to)
                if is_arm =>
            {
                hold(to.position.x, to.position.y);
            }
            _ => {}
        }
    }
    for ends in script.moves.iter().flat_map(|m| [&m.path.from, &m.path.to]) {
        hold(ends.position[0].unwrap_or(0.0), 0.0);
    }
    Some(Gesture {
        from_secs: f64::NEG_INFINITY,
        to_secs: f64::INFINITY,
        space,
    })
}

/// Returns the problems of manipulator clauses: targets out of reach, unknown functions and
/// arguments.
pub(crate) fn problems(document: &Document, units: &Units, reach: &Reach) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for (_, clause) in document.iter() {
        let span = clause.tag_span;
        match &clause.kind {
            ClauseKind::VhMove(m) => {
                function(&m.function, m.args.as_ref(), span, &mut found);
                found.extend(loop_without_period(m.is_looping, m.args.as_ref(), span));
            }
            ClauseKind::ManipulatorFunction(f) => {
                function(&f.function, f.args.as_ref(), span, &mut found);
                found.extend(loop_without_period(f.is_looping, f.args.as_ref(), span));
            }
            kind => {
                if let Some((manipulator, motion)) = motion(kind, units) {
                    found.extend(out_of_reach(limb(manipulator), &motion, span, reach));
                }
            }
        }
    }
    found
}

fn function(name: &str, args: Option<&FunctionArgs>, span: Span, into: &mut Vec<Diagnostic>) {
    let Some((_, leads, own)) = FUNCTIONS.iter().find(|(n, ..)| *n == name) else {
        let known: Vec<&str> = FUNCTIONS.iter().map(|(n, ..)| *n).collect();
        let mut warning = Diagnostic::warning(
            "player::unknown-function",
            span,
            format!("there is no function {}; nothing moves", quoted(name)),
        );
        if let Some(near) = nearest(name, known.iter().copied()) {
            warning = warning.hint(format!("did you mean `{near}`?"));
        }
        into.push(warning.hint(format!("the functions are {}", known.join(", "))));
        return;
    };
    let known = arguments(*leads, own);
    for arg in args.map_or(&[][..], |a| &a.args) {
        into.extend(bad_argument(name, arg, &known, span));
    }
}

/// Reports a loop without a period.
fn loop_without_period(
    is_looping: bool,
    args: Option<&FunctionArgs>,
    span: Span,
) -> Option<Diagnostic> {
    let has_period = args.is_some_and(|args| args.period_secs() > 0.0);
    (is_looping && !has_period).then(|| {
        let message = "a loop needs a period; the function ends after one run";
        Diagnostic::warning("player::no-period", span, message)
            .hint("add the argument `timePeriod`, in seconds, above 0")
    })
}

/// Returns the names of all arguments that a function accepts.
fn arguments(leads: bool, own: &[&str]) -> Vec<String> {
    let three = |start: &str, ends: [&str; 3]| ends.map(|end| format!("{start}{end}"));
    let mut known = vec!["timePeriod".to_owned()];
    for end in ["start", "end"] {
        known.extend(three(end, ANGLES));
        known.extend(leads.then(|| three(end, AXES)).into_iter().flatten());
    }
    for name in own {
        match name.strip_suffix('*') {
            Some(start) => known.extend(three(start, AXES)),
            None => known.push((*name).to_owned()),
        }
    }
    known
}

/// Returns the diagnostic for an argument with an invalid name, type or size; `None` for a valid
/// one.
fn bad_argument(function: &str, arg: &Arg, known: &[String], span: Span) -> Option<Diagnostic> {
    let name = quoted(&arg.name);
    let warning = |code, message: String| Some(Diagnostic::warning(code, span, message));
    if !known.contains(&arg.name) {
        let message = format!("{name} does not count for the function `{function}`");
        let near = nearest(&arg.name, known.iter().map(String::as_str));
        let hint = match near {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("its arguments are {}", known.join(", ")),
        };
        return warning("player::bad-argument", message).map(|w| w.hint(hint));
    }
    let ArgValue::Number(number) = arg.value else {
        let message = format!("{name} is not a number of the function `{function}`");
        return warning("player::bad-argument", message);
    };
    let least = if arg.name == "timePeriod" {
        0.0
    } else {
        -MAX_COORDINATE
    };
    if (least..=MAX_COORDINATE).contains(&number) {
        return None;
    }
    let message = format!(
        "{name} goes from {} to {}, so {} is as much as {}",
        least,
        MAX_COORDINATE,
        number,
        number.clamp(least, MAX_COORDINATE)
    );
    warning("player::out-of-range", message)
}

fn out_of_reach(limb: Limb, motion: &Motion, span: Span, reach: &Reach) -> Option<Diagnostic> {
    let (Motion::JointInterpolation { to, .. }
    | Motion::FrameInterpolation { to, .. }
    | Motion::JacobianTarget(to)) = motion
    else {
        return None;
    };
    let (side, is_arm) = limb.side()?;
    let (base, length_m, name) = if is_arm {
        let length_m = reach.arm_m * (1.0 + SPINE_HELP);
        (reach.shoulders_in_world[side.index()], length_m, "arm")
    } else {
        (reach.hips_in_world[side.index()], reach.leg_m, "leg")
    };
    let beyond = to.position.distance_to(base) - length_m;
    // A tenth of a millimetre is below the rounding of a script.
    (beyond > 1e-4).then(|| {
        let side = ["left", "right"][side.index()];
        Diagnostic::warning(
            "player::out-of-reach",
            span,
            format!(
                "this place is {:.0} cm beyond the reach of the {side} {name}",
                beyond * 100.0
            ),
        )
        .hint("it goes as far towards it as it can")
    })
}
