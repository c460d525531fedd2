//! Checks of the whole document: references of clauses, and attributes without effect next to
//! others.

use crate::clauses::functions::FunctionArgs;
use crate::clauses::manipulators::{ForwardKinematics, JOINTS, Jacobian};
use crate::clauses::players::{DeterministicPrimitive, PlayerKind, PrimitiveKind, TrackProperty};
use crate::clauses::sets::{BODY_GROUPS, BONES, Member, MemberKind, Set, SetKind, layer_number};
use crate::diagnostic::Sink;
use crate::question_checks;
use crate::suggest::{MAX_HINTS, nearest, quoted};
use crate::{Clause, ClauseKind, Diagnostic, Document, Span};
use std::collections::{BTreeMap, BTreeSet};

/// Index of the set of each name.
type Index<'d> = BTreeMap<&'d str, usize>;

/// Start tag that adds the player of each name, and of the unnamed one.
type Starts<'d> = BTreeMap<&'d str, Span>;

/// Reports attributes that have no effect together with others, clauses without required parts,
/// and, in a whole script, undefined references.
pub(crate) fn clauses(document: &Document, is_fragment: bool, sink: &mut Sink) {
    // Those that have to do with players: few, if any.
    let mut playing = Vec::new();
    question_checks::lesson(document, is_fragment, sink);
    for clause in &document.clauses {
        meaning(clause, sink);
        if is_playing(&clause.kind) {
            playing.push(clause);
        }
    }
    // A mind may refer to definitions of the running script, apart from those of every figure.
    let own = (!is_fragment).then(|| (sets(&document.sets, sink), players(&playing, sink)));
    for clause in playing {
        references(clause, own.as_ref(), sink);
    }
}

/// Reports arguments given twice.
fn arguments(args: Option<&FunctionArgs>, span: Span, sink: &mut Sink) {
    let mut seen = BTreeSet::new();
    for arg in args.iter().flat_map(|args| &args.args) {
        if !seen.insert(arg.name.as_str()) {
            let message = format!(
                "the argument {} is given twice; the last one counts",
                quoted(&arg.name)
            );
            sink.push(Diagnostic::warning(
                "eml::duplicate-argument",
                span,
                message,
            ));
        }
    }
}

fn meaning(clause: &Clause, sink: &mut Sink) {
    match &clause.kind {
        ClauseKind::VhMove(function) => {
            return arguments(function.args.as_ref(), clause.tag_span, sink);
        }
        ClauseKind::ManipulatorFunction(function) => {
            return arguments(function.args.as_ref(), clause.tag_span, sink);
        }
        _ => {}
    }
    if let ClauseKind::DeterministicPrimitive(primitive) = &clause.kind {
        return primitive_animation(primitive, clause.tag_span, sink);
    }
    let mut ignored = |message: &str| sink.push(ignored_attribute(clause.tag_span, message));
    let layers_only_for_multiple =
        |layers: &Option<u32>, kind| layers.is_some() && kind != PlayerKind::Multiple;
    match &clause.kind {
        ClauseKind::PlayerAdd(add) if layers_only_for_multiple(&add.layers, add.kind) => {
            ignored("`numberOfLayers` only applies with type='multiple'");
        }
        ClauseKind::PlayerSetExclusive(set) if layers_only_for_multiple(&set.layers, set.kind) => {
            ignored("`numberOfLayers` only applies with type='multiple'");
        }
        ClauseKind::DeterministicTrackProperty(property)
            if property.property == TrackProperty::Enable && property.duration_secs > 0.0 =>
        {
            ignored("`duration` has no effect with property='enable'");
        }
        ClauseKind::JointInterpolation(motion)
            if motion.static_time_secs.is_some() && motion.static_velocity_rad_per_s.is_some() =>
        {
            ignored("`staticVelocity` has no effect with `staticTime`");
        }
        ClauseKind::ForwardKinematics(fk) => {
            joints_given(fk, &mut ignored);
        }
        ClauseKind::Jacobian(jacobian) => {
            target_or_velocity(jacobian, &mut ignored);
        }
        _ => {}
    }
}

fn ignored_attribute(span: Span, message: &str) -> Diagnostic {
    Diagnostic::warning("eml::ignored-attribute", span, message)
}

/// Reports an animation name that a track operation lacks, or has without effect.
fn primitive_animation(primitive: &DeterministicPrimitive, tag_span: Span, sink: &mut Sink) {
    let is_reported = primitive.animation.is_none() && sink.concerns(tag_span);
    let needs = matches!(
        primitive.primitive,
        PrimitiveKind::Push | PrimitiveKind::Exchange
    );
    let word = primitive.primitive.word();
    match &primitive.animation {
        // A value that is no name has its own diagnostic.
        None if needs && !is_reported => {
            let message = format!("primitive='{word}' needs `animationSetName`");
            sink.push(Diagnostic::error(
                "eml::missing-attribute",
                tag_span,
                message,
            ));
        }
        Some(_) if !needs => {
            sink.push(ignored_attribute(
                tag_span,
                &format!("`animationSetName` has no effect with primitive='{word}'"),
            ));
        }
        _ => {}
    }
}

/// Joints of forward kinematics: some, and no more than the manipulator has.
fn joints_given(fk: &ForwardKinematics, ignored: &mut dyn FnMut(&str)) {
    let most = fk.manipulator.joints();
    let given = fk.joints_deg.iter().flatten().count();
    let last = fk.joints_deg.iter().rposition(Option::is_some);
    let count = fk.joint_count.map_or(most, |n| n as usize);
    if given == 0 {
        ignored("no joint is given, so nothing moves");
    } else if let Some(last) = last.filter(|&last| last >= count.min(most)) {
        ignored(&format!(
            "`{}` has no effect: the manipulator has {} joints here",
            JOINTS[last],
            count.min(most)
        ));
    }
}

/// Reports a Jacobian with both target and velocity; only one of them applies.
fn target_or_velocity(jacobian: &Jacobian, ignored: &mut dyn FnMut(&str)) {
    let zero = |vector: &[f64; 3]| vector.iter().all(|&x| x == 0.0);
    let (target, still) = (
        &jacobian.target,
        zero(&jacobian.velocity) && zero(&jacobian.angular_velocity_deg),
    );
    if jacobian.is_static_target && !still {
        ignored("velocities have no effect with isStaticTarget='true'");
    }
    let no_target = zero(&target.position) && zero(&target.angles_deg);
    if !(jacobian.is_static_target || no_target) {
        ignored("a target has no effect with isStaticTarget='false'");
    }
}

/// Returns true if a clause creates, removes or references animation players.
fn is_playing(kind: &ClauseKind) -> bool {
    matches!(
        kind,
        ClauseKind::PlayerAdd(_)
            | ClauseKind::PlayerSetExclusive(_)
            | ClauseKind::PlayerChangePriority(_)
            | ClauseKind::PlayerRemove(_)
            | ClauseKind::PlayerClear
            | ClauseKind::DeterministicTrackProperty(_)
            | ClauseKind::DeterministicPrimitive(_)
    )
}

/// Checks the references of a clause; players and sets only if all of them are known.
fn references(clause: &Clause, own: Option<&(Index<'_>, Starts<'_>)>, sink: &mut Sink) {
    let span = clause.tag_span;
    let (player, members) = match &clause.kind {
        ClauseKind::PlayerAdd(add) => (None, add.bones.as_ref().map(|b| &b.members)),
        ClauseKind::PlayerSetExclusive(set) => (None, set.bones.as_ref().map(|b| &b.members)),
        ClauseKind::PlayerChangePriority(change) => (change.name.as_ref(), None),
        ClauseKind::PlayerRemove(remove) => (remove.name.as_ref(), None),
        ClauseKind::DeterministicTrackProperty(property) => (
            property.player.as_ref(),
            property.tracks.as_ref().map(|t| &t.members),
        ),
        ClauseKind::DeterministicPrimitive(primitive) => (
            primitive.player.as_ref(),
            primitive.tracks.as_ref().map(|t| &t.members),
        ),
        _ => return,
    };
    if let (Some(name), Some((_, players))) = (player, own)
        && !players.contains_key(name.as_str())
    {
        let message = format!("no clause adds a player {}", quoted(name));
        let known = players.keys().copied().filter(|name| !name.is_empty());
        unknown("eml::unknown-player", span, message, name, known, sink);
    }
    for member in members.into_iter().flatten() {
        check_member(member, own.map(|(sets, _)| sets), span, sink);
    }
}

/// Returns the names of all animation players with their start tags; reports names used twice.
fn players<'d>(playing: &[&'d Clause], sink: &mut Sink) -> Starts<'d> {
    let mut players = Starts::new();
    // A removed player may return under its name.
    let mut removed = false;
    for clause in playing {
        let name = match &clause.kind {
            ClauseKind::PlayerAdd(add) => add.name.as_deref().unwrap_or_default(),
            ClauseKind::PlayerSetExclusive(set) => {
                players.insert(set.name.as_deref().unwrap_or_default(), clause.tag_span);
                removed = true;
                continue;
            }
            ClauseKind::PlayerRemove(_) | ClauseKind::PlayerClear => {
                removed = true;
                continue;
            }
            _ => continue,
        };
        match players.get(name) {
            Some(first) if !removed => {
                let called = match name {
                    "" => "without a name".to_owned(),
                    name => quoted(name),
                };
                let message = format!("there is a player {called} already");
                sink.push(
                    Diagnostic::warning("eml::duplicate-player", clause.tag_span, message)
                        .related(*first, "added here"),
                );
            }
            _ => {
                players.insert(name, clause.tag_span);
            }
        }
    }
    players
}

/// Checks the sets of the head against each other and returns the index of each.
fn sets<'d>(sets: &'d [Set], sink: &mut Sink) -> Index<'d> {
    let mut index = Index::new();
    for (place, set) in sets.iter().enumerate() {
        let Some(&first) = index.get(set.name.as_str()) else {
            index.insert(&set.name, place);
            continue;
        };
        let message = format!(
            "there is a set {} already; the first one counts",
            quoted(&set.name)
        );
        sink.push(
            Diagnostic::error("eml::duplicate-set", set.span, message)
                .related(sets[first].span, "defined here"),
        );
    }
    for set in sets {
        for member in &set.members {
            match (member.kind, set.kind) {
                (MemberKind::Set, _) => check_member(member, Some(&index), set.span, sink),
                (_, SetKind::BodyGroup) => check_group(&member.name, set.span, sink),
                (_, SetKind::Multiple) => check_layer(&member.name, set.span, sink),
            }
        }
    }
    for cycle in cycles(sets, &index) {
        let names = cycle.iter().take(8).map(|&i| quoted(&sets[i].name));
        let mut chain: Vec<String> = names.collect();
        chain.push(chain[0].clone());
        let message = format!("these sets contain each other: {}", chain.join(" -> "));
        sink.push(
            Diagnostic::error("eml::set-cycle", sets[cycle[0]].span, message)
                .hint("a repeated set counts once"),
        );
    }
    index
}

/// Returns the cycles among sets, each as the indices of its sets; every set is in at most one
/// cycle.
fn cycles(sets: &[Set], index: &Index<'_>) -> Vec<Vec<usize>> {
    #[derive(Clone, Copy, PartialEq)]
    enum State {
        New,
        Open,
        Done,
    }
    let mut state = vec![State::New; sets.len()];
    let mut found: Vec<Vec<usize>> = Vec::new();
    for root in 0..sets.len() {
        if state[root] != State::New {
            continue;
        }
        state[root] = State::Open;
        let mut path: Vec<(usize, usize)> = vec![(root, 0)];
        while let Some((set, next)) = path.last_mut() {
            let Some(member) = sets[*set].members.get(*next) else {
                state[*set] = State::Done;
                path.pop();
                continue;
            };
            *next += 1;
            let is_set = member.kind == MemberKind::Set;
            let inner = index.get(member.name.as_str()).filter(|_| is_set);
            match inner.map(|&inner| (inner, state[inner])) {
                Some((inner, State::New)) => {
                    state[inner] = State::Open;
                    path.push((inner, 0));
                }
                Some((inner, State::Open)) => {
                    let from = path.iter().position(|&(set, _)| set == inner).unwrap_or(0);
                    found.push(path[from..].iter().map(|&(set, _)| set).collect());
                }
                _ => {}
            }
        }
    }
    found
}

fn check_member(member: &Member, sets: Option<&Index<'_>>, span: Span, sink: &mut Sink) {
    let name = member.name.as_str();
    if name.is_empty() {
        // The reader of attributes has reported it.
        return;
    }
    match (member.kind, sets) {
        (MemberKind::Set, Some(sets)) if !sets.contains_key(name) => {
            let message = format!("there is no set {}; it counts as empty", quoted(name));
            let known = sets.keys().copied();
            unknown("eml::unknown-set", span, message, name, known, sink);
        }
        (MemberKind::Group, _) => check_group(name, span, sink),
        (MemberKind::Layer, _) => check_layer(name, span, sink),
        (MemberKind::Bone, _) if !BONES.contains(&name) => {
            let message = format!("there is no bone {}", quoted(name));
            let known = BONES.iter().copied();
            unknown("eml::unknown-bone", span, message, name, known, sink);
        }
        _ => {}
    }
}

fn check_group(name: &str, span: Span, sink: &mut Sink) {
    if !BODY_GROUPS.contains(&name) {
        let message = format!("there is no body group {}", quoted(name));
        let known = BODY_GROUPS.iter().copied();
        unknown("eml::unknown-body-group", span, message, name, known, sink);
    }
}

fn check_layer(name: &str, span: Span, sink: &mut Sink) {
    if layer_number(name).is_none() {
        let message = format!("{} is not the name of a layer", quoted(name));
        let hint = "the name of a layer ends in its number, such as layer1";
        sink.push(Diagnostic::warning("eml::unknown-layer", span, message).hint(hint));
    }
}

fn unknown<'n>(
    code: &'static str,
    span: Span,
    message: String,
    name: &str,
    known: impl Iterator<Item = &'n str>,
    sink: &mut Sink,
) {
    let mut diagnostic = Diagnostic::warning(code, span, message);
    if let Some(near) = nearest(name, known.take(MAX_HINTS)) {
        diagnostic = diagnostic.hint(format!("did you mean `{near}`?"));
    }
    sink.push(diagnostic);
}
