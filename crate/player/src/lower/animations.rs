//! Conversion of the clauses of animation players to the actor's commands (GEVH 3.2, D.3.5 to
//! D.3.18).

use raconteur_actor::animation::{
    BODY_GROUPS, BoneSet, CommandProblemKind, Operation, Playback, PlayerCommand, PlayerKind,
    PlayerScript, Players, Property, TrackRef, Tracks, body_group,
};
use raconteur_body::Bone;
use raconteur_eml::{
    AnimationStyle, Bones, ClauseKind, DeterministicPrimitive, Diagnostic, Document, Member,
    MemberKind, PlaybackStyle, PrimitiveKind, Set, Span, Timeline, TrackProperty, items_of,
    layer_number, nearest, quoted,
};

/// Default number of layers of a player.
const LAYERS: usize = 2;

/// Returns a script's commands to animation players, by time, and their clauses.
pub(crate) fn commands(
    document: &Document,
    timeline: &Timeline,
) -> (Vec<(f64, PlayerCommand)>, Vec<Span>) {
    let clauses = timeline.clauses.iter().filter_map(|timed| {
        let clause = document.clause(timed.clause);
        let command = command(&clause.kind, &document.sets)?;
        Some(((timed.start_secs, command), clause.tag_span))
    });
    clauses.unzip()
}

fn command(kind: &ClauseKind, sets: &[Set]) -> Option<PlayerCommand> {
    Some(match kind {
        ClauseKind::DeterministicAnimation(animation) => PlayerCommand::Configure {
            smooth: animation.smooth,
            swap_secs: animation.swap_secs,
        },
        ClauseKind::PlayerAdd(add) => PlayerCommand::Add {
            name: add.name.clone().unwrap_or_default(),
            kind: player_kind(add.kind, add.layers),
            bones: bones(add.bones.as_ref(), sets),
            exclusive: false,
        },
        ClauseKind::PlayerSetExclusive(set) => PlayerCommand::Add {
            name: set.name.clone().unwrap_or_default(),
            kind: player_kind(set.kind, set.layers),
            bones: bones(set.bones.as_ref(), sets),
            exclusive: true,
        },
        ClauseKind::PlayerChangePriority(change) => PlayerCommand::ChangePriority {
            player: change.name.clone(),
            priority: change.priority,
        },
        ClauseKind::PlayerRemove(remove) => PlayerCommand::Remove {
            player: remove.name.clone(),
        },
        ClauseKind::PlayerClear => PlayerCommand::Clear,
        ClauseKind::DeterministicTrackProperty(set) => PlayerCommand::Set {
            player: set.player.clone(),
            tracks: tracks(set.tracks.as_ref().map(|t| &t.members[..]), sets),
            property: match set.property {
                TrackProperty::Speed => Property::Speed,
                TrackProperty::Weight => Property::Weight,
                TrackProperty::Enable => Property::Enable,
            },
            value: set.new_value,
            duration_secs: set.duration_secs,
        },
        ClauseKind::DeterministicPrimitive(primitive) => PlayerCommand::Operate {
            player: primitive.player.clone(),
            tracks: tracks(primitive.tracks.as_ref().map(|t| &t.members[..]), sets),
            operation: operation(primitive)?,
        },
        _ => return None,
    })
}

fn player_kind(kind: raconteur_eml::PlayerKind, layers: Option<u32>) -> PlayerKind {
    match kind {
        raconteur_eml::PlayerKind::Multiple => {
            PlayerKind::Multiple(layers.map_or(LAYERS, |n| n as usize))
        }
        raconteur_eml::PlayerKind::BodyGroup => PlayerKind::BodyGroup,
        raconteur_eml::PlayerKind::Pose => PlayerKind::Pose,
    }
}

/// Returns the operation of a clause; `None` if it adds an unnamed animation, which the language
/// checks report.
fn operation(primitive: &DeterministicPrimitive) -> Option<Operation> {
    let name = || primitive.animation.clone();
    Some(match primitive.primitive {
        PrimitiveKind::Push => Operation::Push(name()?, playback(primitive.style.as_ref())),
        PrimitiveKind::Exchange => Operation::Exchange(name()?, playback(primitive.style.as_ref())),
        PrimitiveKind::Pop => Operation::Pop,
        PrimitiveKind::Clear => Operation::Clear,
    })
}

fn playback(style: Option<&AnimationStyle>) -> Playback {
    let Some(style) = style else {
        return Playback::Loop;
    };
    let n = style.iterations;
    match style.style {
        PlaybackStyle::Loop => Playback::Loop,
        PlaybackStyle::LoopReverse => Playback::LoopReverse,
        PlaybackStyle::PingPong => Playback::PingPong,
        PlaybackStyle::Iterations => Playback::Iterations(n),
        PlaybackStyle::IterationsReverse => Playback::IterationsReverse(n),
        PlaybackStyle::TemporaryIterations => Playback::TemporaryIterations(n),
        PlaybackStyle::TemporaryIterationsReverse => Playback::TemporaryIterationsReverse(n),
    }
}

/// Returns the names that a member denotes: its own, or those of its set.
fn names<'a>(member: &'a Member, sets: &'a [Set]) -> Vec<&'a str> {
    match member.kind {
        MemberKind::Set => items_of(sets, &member.name),
        _ => vec![&member.name],
    }
}

fn bones(bones: Option<&Bones>, sets: &[Set]) -> BoneSet {
    let Some(bones) = bones else {
        return BoneSet::ALL;
    };
    let mut all = BoneSet::NONE;
    for member in &bones.members {
        for name in names(member, sets) {
            if let Some(group) = body_group(name) {
                all = all.or(group);
            } else if let Some(bone) = Bone::from_name(name) {
                all = all.with(bone);
            }
        }
    }
    all
}

fn tracks(members: Option<&[Member]>, sets: &[Set]) -> Tracks {
    let names = members?.iter().flat_map(|member| names(member, sets));
    Some(names.filter_map(track).collect())
}

/// Returns the track of a name: a body group, or a layer by the number at its end; `None` for any
/// other name.
fn track(name: &str) -> Option<TrackRef> {
    if let Some(i) = BODY_GROUPS.iter().position(|(group, _)| *group == name) {
        return Some(TrackRef::Group(i));
    }
    layer_number(name).map(TrackRef::Layer)
}

/// The animations of the library that is shipped, for hints.
const SHIPPED: &[&str] = &[
    "applaud",
    "arms-clap",
    "arms-curl",
    "arms-open-close",
    "arms-overhead-clap",
    "arms-press",
    "arms-punch",
    "arms-raise-front",
    "arms-raise-side",
    "arms-roll",
    "arms-row",
    "arms-swing",
    "arms-triceps",
    "bow",
    "breathe",
    "hands-behind",
    "hands-on-hips",
    "listen",
    "look-around",
    "nod",
    "point",
    "roll-shoulders",
    "shake",
    "shift-weight",
    "shrug",
    "sit",
    "sit-down",
    "stand",
    "stand-left",
    "stand-right",
    "stand-wide",
    "step-a",
    "step-box",
    "step-charleston",
    "step-end",
    "step-grapevine",
    "step-heel-dig",
    "step-jack",
    "step-jog",
    "step-kick",
    "step-knee-lift",
    "step-leg-curl",
    "step-leg-lift",
    "step-lunge",
    "step-mambo",
    "step-march",
    "step-side-lunge",
    "step-side-tap",
    "step-squat",
    "step-stance",
    "step-sway",
    "step-toe-tap",
    "step-touch",
    "step-twist",
    "step-two-step",
    "step-v",
    "stretch-calf",
    "stretch-side",
    "think",
    "tilt-head",
    "walk",
    "wave",
    "welcome",
];

/// Returns a hint for an unknown animation: the name in the library that is probably meant.
pub(crate) fn hint(name: &str) -> Option<String> {
    let near = nearest(name, SHIPPED.iter().copied())?;
    Some(format!("did you mean `{near}`?"))
}

/// Returns the problems of a script's commands; of a live fragment, after all commands `before`.
/// Missing animations are reported if the page provides none.
pub(crate) fn problems(
    document: &Document,
    timeline: &Timeline,
    before: Option<Vec<(f64, PlayerCommand)>>,
) -> Vec<Diagnostic> {
    let (own, spans) = commands(document, timeline);
    if own.is_empty() {
        return Vec::new();
    }
    let is_fragment = before.is_some();
    let mut commands = before.unwrap_or_default();
    let first = commands.len();
    commands.extend(own);
    let script = PlayerScript { commands };
    let problems = Players::problems(&script);
    let added: Vec<&str> = script
        .commands
        .iter()
        .filter_map(|(_, command)| match command {
            PlayerCommand::Add { name, .. } => Some(name.as_str()).filter(|name| !name.is_empty()),
            _ => None,
        })
        .collect();
    let told = problems.into_iter().filter_map(|problem| {
        let span = spans[problem.command.checked_sub(first)?];
        let message = match problem.kind {
            // Of a whole script the checks of the language report it.
            CommandProblemKind::NoPlayer(Some(name)) if !added.contains(&name.as_str()) => {
                return is_fragment.then(|| unknown_player(&name, &added, span));
            }
            CommandProblemKind::NoPlayer(Some(name)) => {
                format!("there is no animation player `{name}` at this time")
            }
            CommandProblemKind::NoPlayer(None) => {
                "there is no animation player at this time".to_owned()
            }
            CommandProblemKind::NoTrack(TrackRef::Group(_)) => {
                "this player has layers and no body groups".to_owned()
            }
            CommandProblemKind::NoTrack(TrackRef::Layer(i)) => {
                format!("this player has no layer {i}")
            }
            CommandProblemKind::NoClip(_) => return None,
        };
        Some(Diagnostic::warning("player::no-effect", span, message))
    });
    told.collect()
}

/// Creates the warning about an unknown player, as the checks of the `eml` crate report it.
fn unknown_player(name: &str, added: &[&str], span: Span) -> Diagnostic {
    let message = format!("no clause adds a player {}", quoted(name));
    let warning = Diagnostic::warning("eml::unknown-player", span, message);
    match nearest(name, added.iter().copied()) {
        Some(near) => warning.hint(format!("did you mean `{near}`?")),
        None => warning,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hints_know_every_animation_that_is_shipped() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/animations");
        let files = std::fs::read_dir(folder).expect("the library");
        let names = files.filter_map(|file| {
            let name = file.expect("a file").file_name().into_string().ok()?;
            name.strip_suffix(".json").map(str::to_owned)
        });
        let mut names: Vec<String> = names.collect();
        names.sort();
        assert_eq!(names, SHIPPED);
        assert_eq!(hint("applaudd").as_deref(), Some("did you mean `applaud`?"));
    }

    #[test]
    fn the_language_knows_the_bones_and_body_groups_of_the_figure() {
        let bones: Vec<&str> = Bone::ALL.iter().map(|b| &b.name()[5..]).collect();
        assert_eq!(raconteur_eml::BONES, bones);
        let groups: Vec<&str> = BODY_GROUPS.iter().map(|(name, _)| *name).collect();
        let mut known = raconteur_eml::BODY_GROUPS.to_vec();
        assert!(groups.iter().all(|g| known.contains(g)), "{groups:?}");
        known.retain(|g| !groups.contains(g));
        assert_eq!(known, [""; 0]);
    }
}
