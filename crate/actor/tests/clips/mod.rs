//! Generated clips, and a stage on which players play them.

#![allow(dead_code, reason = "each test uses some of it")]

use raconteur_actor::animation::{
    BoneSet, Library, Operation, Playback, PlayerCommand, PlayerKind, PlayerScript, Players,
    Property, TrackRef,
};
use raconteur_actor::idle::stance::Stance;
use raconteur_actor::limb::{ArmRig, Build, Sex};
use raconteur_base::{Side, ops};
use raconteur_body::{Bone, Pose, Skeleton};

/// Stances that turn the head by some degrees, a nod that loops, and a turn that does not.
pub(crate) const CLIPS: [(&str, &str); 6] = [
    (
        "left",
        r#"{"seconds": 0, "tracks": {"head": {"turn": 40}}}"#,
    ),
    (
        "right",
        r#"{"seconds": 0, "tracks": {"head": {"turn": -40}}}"#,
    ),
    (
        "arm",
        r#"{"seconds": 0, "tracks": {"left_upper_arm": {"abduction": 60}}}"#,
    ),
    (
        "nod",
        r#"{"seconds": 1, "loop": true, "times": [0, 0.5], "tracks": {"head": {"flexion": [0, 20]}}}"#,
    ),
    (
        "turn",
        r#"{"seconds": 2, "ease": "linear", "times": [0, 2], "tracks": {"head": {"turn": [0, 40]}, "elbows": {"flexion": [20, 90]}}}"#,
    ),
    (
        "step",
        r#"{"seconds": 1, "mirrored": true, "tracks": {"root": {"times": [0, 0.25], "left": [0, 3], "up": -2},
            "left_foot": {"times": [0, 0.25, 0.5], "up": [0, 6, 0], "heel": [0, 20, 0]}}}"#,
    ),
];

pub(crate) fn library() -> Library {
    let mut library = Library::default();
    for (name, text) in CLIPS {
        library.add(name, text).expect(name);
    }
    library
}

pub(crate) fn add(name: &str, kind: PlayerKind, bones: BoneSet) -> PlayerCommand {
    PlayerCommand::Add {
        name: name.to_owned(),
        kind,
        bones,
        exclusive: false,
    }
}

pub(crate) fn on(
    player: Option<&str>,
    tracks: Option<Vec<usize>>,
    operation: Operation,
) -> PlayerCommand {
    PlayerCommand::Operate {
        player: player.map(str::to_owned),
        tracks: tracks.map(|list| list.into_iter().map(TrackRef::Layer).collect()),
        operation,
    }
}

pub(crate) fn push(name: &str) -> Operation {
    Operation::Push(name.to_owned(), Playback::Loop)
}

pub(crate) fn set(
    tracks: Option<Vec<usize>>,
    property: Property,
    value: f64,
    secs: f64,
) -> PlayerCommand {
    PlayerCommand::Set {
        player: None,
        tracks: tracks.map(|list| list.into_iter().map(TrackRef::Layer).collect()),
        property,
        value,
        duration_secs: secs,
    }
}

pub(crate) struct Stage {
    pub(crate) players: Players,
    pub(crate) skeleton: Skeleton,
}

impl Stage {
    pub(crate) fn new(commands: Vec<(f64, PlayerCommand)>) -> Self {
        let skeleton = Skeleton::example();
        let script = PlayerScript { commands };
        let (players, problems) = Players::new(
            &script,
            &library(),
            &skeleton,
            Sex::Male,
            ArmRig::both(&skeleton, &Build::default()),
        );
        assert_eq!(problems, []);
        Self { players, skeleton }
    }

    pub(crate) fn pose(&self, t: f64) -> Pose {
        pose(&self.players, &self.skeleton, t)
    }

    /// Turn of the head to the left at a time, degrees.
    pub(crate) fn turn(&self, t: f64) -> f64 {
        let q = self.pose(t).rotation(Bone::Skull);
        // About the skull's own upward axis.
        (2.0 * ops::atan2(q.x, q.w)).to_degrees()
    }
}

/// Returns a standing idle pose, the base for players.
pub(crate) fn idle(skeleton: &Skeleton) -> Pose {
    let mut pose = Pose::zero();
    Stance::new(skeleton, Sex::Male, 1).apply(skeleton, 0.0, 0.0, &mut pose);
    pose
}

pub(crate) fn pose(players: &Players, skeleton: &Skeleton, t: f64) -> Pose {
    let mut pose = idle(skeleton);
    let animated = players.apply(skeleton, t, &mut pose);
    for side in Side::BOTH {
        if let Some(animated) = &animated {
            animated.blend_arm(side, 1.0, 1.0, &mut pose);
        }
    }
    pose
}

pub(crate) fn near(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-6, "{a} is not {b}");
}

pub(crate) const ONE: PlayerKind = PlayerKind::Multiple(1);
pub(crate) const TWO: PlayerKind = PlayerKind::Multiple(2);
