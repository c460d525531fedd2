//! Properties of animation players, over made-up and random scripts.

use proptest::prelude::*;
use raconteur_actor::animation::{
    BODY_GROUPS, BoneSet, Library, Operation, Playback, PlayerCommand, PlayerKind, PlayerScript,
    Players, ProblemKind, Property, TrackRef, body_group,
};
use raconteur_actor::idle::stance::Stance;
use raconteur_actor::limb::{ArmRig, Build, Sex};
use raconteur_base::{Side, ops};
use raconteur_body::{Bone, Pose, Skeleton};

/// Stances that turn the head by some degrees, a nod that closes, and a turn that does not.
const CLIPS: [(&str, &str); 6] = [
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

fn library() -> Library {
    let mut library = Library::default();
    for (name, text) in CLIPS {
        library.add(name, text).expect(name);
    }
    library
}

fn add(name: &str, kind: PlayerKind, bones: BoneSet) -> PlayerCommand {
    PlayerCommand::Add {
        name: name.to_owned(),
        kind,
        bones,
        exclusive: false,
    }
}

fn on(player: Option<&str>, tracks: Option<Vec<usize>>, operation: Operation) -> PlayerCommand {
    PlayerCommand::Operate {
        player: player.map(str::to_owned),
        tracks: tracks.map(|list| list.into_iter().map(TrackRef::Layer).collect()),
        operation,
    }
}

fn push(name: &str) -> Operation {
    Operation::Push(name.to_owned(), Playback::Loop)
}

fn set(tracks: Option<Vec<usize>>, property: Property, value: f64, secs: f64) -> PlayerCommand {
    PlayerCommand::Set {
        player: None,
        tracks: tracks.map(|list| list.into_iter().map(TrackRef::Layer).collect()),
        property,
        value,
        duration_secs: secs,
    }
}

struct Stage {
    players: Players,
    skeleton: Skeleton,
}

impl Stage {
    fn new(commands: Vec<(f64, PlayerCommand)>) -> Self {
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

    fn pose(&self, t: f64) -> Pose {
        pose(&self.players, &self.skeleton, t)
    }

    /// Turn of the head to the left at a time, degrees.
    fn turn(&self, t: f64) -> f64 {
        let q = self.pose(t).rotation(Bone::Skull);
        // About the skull's own upward axis.
        (2.0 * ops::atan2(q.x, q.w)).to_degrees()
    }
}

/// Standing still: what players lie over.
fn idle(skeleton: &Skeleton) -> Pose {
    let mut pose = Pose::zero();
    Stance::new(skeleton, Sex::Male, 1).apply(skeleton, 0.0, 0.0, &mut pose);
    pose
}

fn pose(players: &Players, skeleton: &Skeleton, t: f64) -> Pose {
    let mut pose = idle(skeleton);
    let animated = players.apply(skeleton, t, &mut pose);
    for side in Side::BOTH {
        if let Some(animated) = &animated {
            animated.blend_arm(side, 1.0, 1.0, &mut pose);
        }
    }
    pose
}

fn near(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-6, "{a} is not {b}");
}

const ONE: PlayerKind = PlayerKind::Multiple(1);
const TWO: PlayerKind = PlayerKind::Multiple(2);

#[test]
fn nothing_played_leaves_the_pose_to_the_bit() {
    let stage = Stage::new(vec![(1.0, add("p", ONE, BoneSet::ALL))]);
    let mut pose = Pose::zero();
    assert!(
        stage
            .players
            .apply(&stage.skeleton, 0.5, &mut pose)
            .is_none()
    );
    assert_eq!(pose, Pose::zero());
    assert_eq!(stage.pose(9.0), idle(&stage.skeleton));
}

#[test]
fn layers_are_averaged_by_their_weights() {
    let stage = Stage::new(vec![
        (0.0, add("p", TWO, BoneSet::ALL)),
        (0.0, on(None, Some(vec![0]), push("left"))),
        (1.0, on(None, Some(vec![1]), push("right"))),
        (3.0, set(Some(vec![0]), Property::Weight, 0.75, 2.0)),
    ]);
    // One layer alone counts wholly.
    near(stage.turn(0.9), 40.0);
    near(stage.turn(2.0), 0.0);
    near(stage.turn(4.0), 10.0);
    near(stage.turn(6.0), 20.0);
}

#[test]
fn body_groups_keep_to_their_bones() {
    let group = |name: &str| {
        BODY_GROUPS
            .iter()
            .position(|(n, _)| *n == name)
            .expect(name)
    };
    let on_group = |name: &str, clip: &str| PlayerCommand::Operate {
        player: None,
        tracks: Some(vec![TrackRef::Group(group(name))]),
        operation: push(clip),
    };
    let stage = Stage::new(vec![
        (0.0, add("p", PlayerKind::BodyGroup, BoneSet::ALL)),
        (0.0, on_group("head", "left")),
        (0.0, on_group("left_arm", "turn")),
        (0.0, on_group("right_leg", "arm")),
    ]);
    near(stage.turn(1.9), 40.0);
    let pose = stage.pose(1.9);
    assert!(pose.rotation(Bone::LElbow).w < 0.9);
    assert_eq!(
        pose.rotation(Bone::RElbow),
        Pose::zero().rotation(Bone::RElbow)
    );
    assert_eq!(
        pose.rotation(Bone::LShoulder),
        Pose::zero().rotation(Bone::LShoulder)
    );
}

#[test]
fn a_pose_player_blends_two_stances() {
    let stage = Stage::new(vec![
        (0.0, add("p", PlayerKind::Pose, BoneSet::ALL)),
        (0.0, on(None, Some(vec![0]), push("left"))),
        (0.0, on(None, Some(vec![1]), push("right"))),
        (1.0, set(Some(vec![1]), Property::Weight, 0.25, 1.0)),
        (3.0, on(None, Some(vec![0]), push("turn"))),
    ]);
    near(stage.turn(0.5), 40.0);
    near(stage.turn(2.5), 20.0);
    // An animation stands still at its beginning.
    near(stage.turn(4.0), -10.0);
    near(stage.turn(4.9), -10.0);
}

#[test]
fn hand_shapes_are_stances_of_the_library() {
    let stage = Stage::new(vec![
        (
            0.0,
            add(
                "p",
                PlayerKind::Pose,
                body_group("left_hand").expect("a group"),
            ),
        ),
        (0.0, on(None, None, push("hand-shape-14"))),
    ]);
    let pose = stage.pose(0.0);
    assert!(pose.rotation(Bone::LIndex1).w < 0.75);
    assert_eq!(
        pose.rotation(Bone::RIndex1),
        Pose::zero().rotation(Bone::RIndex1)
    );
}

#[test]
fn a_pop_returns_to_what_was_below() {
    let stage = Stage::new(vec![
        (0.0, add("p", ONE, BoneSet::ALL)),
        (0.0, on(None, None, push("nod"))),
        (2.0, on(None, None, push("left"))),
        (
            3.0,
            on(
                None,
                None,
                Operation::Exchange("right".to_owned(), Playback::Loop),
            ),
        ),
        (4.0, on(None, None, Operation::Pop)),
        (6.0, on(None, None, Operation::Clear)),
        (8.0, on(None, None, Operation::Pop)),
    ]);
    near(stage.turn(2.9), 40.0);
    near(stage.turn(3.9), -40.0);
    // The nod has gone on below, in its own rhythm.
    assert_eq!(stage.pose(5.25), stage.pose(1.25));
    assert_eq!(stage.pose(7.0), idle(&stage.skeleton));
    assert_eq!(stage.pose(9.0), idle(&stage.skeleton));
}

#[test]
fn what_is_temporary_leaves_by_itself_at_the_speed_it_has() {
    let temporary = Operation::Push("turn".to_owned(), Playback::TemporaryIterations(1));
    let stage = Stage::new(vec![
        (0.0, add("p", ONE, BoneSet::ALL)),
        (0.0, on(None, None, push("right"))),
        (1.0, on(None, None, temporary)),
        (2.0, set(None, Property::Speed, 0.5, 0.0)),
    ]);
    // One second at full speed, two at half: over at 4 s.
    near(stage.turn(3.0), 30.0);
    near(stage.turn(4.0), 40.0);
    near(stage.turn(4.5), -40.0);
}

#[test]
fn speed_is_integrated_and_may_be_negative() {
    let stage = Stage::new(vec![
        (0.0, add("p", ONE, BoneSet::ALL)),
        (0.0, on(None, None, push("turn"))),
        (0.5, set(None, Property::Speed, 0.0, 1.0)),
        (2.0, set(None, Property::Speed, -1.0, 0.0)),
    ]);
    near(stage.turn(0.5), 10.0);
    // Half a second more on the way to a stand.
    near(stage.turn(1.5), 20.0);
    near(stage.turn(2.0), 20.0);
    near(stage.turn(2.5), 10.0);
}

#[test]
fn the_highest_priority_moves_a_bone() {
    let head = body_group("head").expect("a group");
    let stage = Stage::new(vec![
        (0.0, add("low", ONE, BoneSet::ALL)),
        (0.0, add("high", ONE, head)),
        (0.0, on(Some("low"), None, push("left"))),
        (0.0, on(Some("high"), None, push("right"))),
        (
            1.0,
            PlayerCommand::ChangePriority {
                player: None,
                priority: 2,
            },
        ),
        (
            2.0,
            PlayerCommand::ChangePriority {
                player: Some("high".to_owned()),
                priority: 3,
            },
        ),
        (
            3.0,
            PlayerCommand::Remove {
                player: Some("high".to_owned()),
            },
        ),
        (
            4.0,
            PlayerCommand::Add {
                name: "only".to_owned(),
                kind: ONE,
                bones: head,
                exclusive: true,
            },
        ),
        (4.0, on(None, None, push("right"))),
        (5.0, PlayerCommand::Clear),
    ]);
    // Of equals the later one wins.
    near(stage.turn(0.9), -40.0);
    near(stage.turn(1.9), 40.0);
    near(stage.turn(2.9), -40.0);
    near(stage.turn(3.9), 40.0);
    near(stage.turn(4.9), -40.0);
    near(stage.turn(5.9), 0.0);
    // The one without a name is the first, though it came later.
    let unnamed = Stage::new(vec![
        (0.0, add("a", ONE, BoneSet::ALL)),
        (0.0, add("", ONE, BoneSet::ALL)),
        (0.0, on(None, None, push("left"))),
        (0.0, on(Some("a"), None, push("right"))),
        (1.0, PlayerCommand::Remove { player: None }),
    ]);
    near(unnamed.turn(0.9), 40.0);
    near(unnamed.turn(1.9), -40.0);
    // Where no other player moves the bone, a change of order is not seen: no dip at 1.2 s.
    let lone = Stage::new(vec![
        (0.0, add("a", ONE, BoneSet::ALL)),
        (0.0, on(None, None, push("left"))),
        (
            1.0,
            PlayerCommand::ChangePriority {
                player: None,
                priority: 5,
            },
        ),
    ]);
    for t in [1.05, 1.2, 1.35] {
        near(lone.turn(t), 40.0);
    }
}

#[test]
fn enabling_and_weights_of_groups_fade() {
    let stage = Stage::new(vec![
        (0.0, add("p", PlayerKind::BodyGroup, BoneSet::ALL)),
        (0.0, on(None, None, push("left"))),
        (1.0, set(None, Property::Enable, 0.0, 0.0)),
        (2.0, set(None, Property::Enable, 1.0, 0.0)),
        (3.0, set(None, Property::Weight, 0.5, 1.0)),
    ]);
    near(stage.turn(1.0), 40.0);
    near(stage.turn(1.2), 20.0);
    near(stage.turn(1.8), 0.0);
    near(stage.turn(2.9), 40.0);
    near(stage.turn(4.5), 20.0);
}

#[test]
fn configuration_sets_how_long_a_change_takes() {
    let configure = |smooth, swap_secs| PlayerCommand::Configure { smooth, swap_secs };
    let stage = Stage::new(vec![
        (0.0, add("p", ONE, BoneSet::ALL)),
        (0.0, on(None, None, push("left"))),
        (0.5, configure(Some(true), Some(2.0))),
        (1.0, on(None, None, push("right"))),
        (4.0, configure(Some(false), None)),
        (4.0, on(None, None, push("left"))),
    ]);
    near(stage.turn(2.0), 0.0);
    near(stage.turn(3.0), -40.0);
    near(stage.turn(4.04), 0.0);
    near(stage.turn(4.08), 40.0);
}

#[test]
fn what_cannot_be_done_is_told() {
    let script = PlayerScript {
        commands: vec![
            (0.0, on(None, None, push("nod"))),
            (1.0, add("p", TWO, BoneSet::ALL)),
            (2.0, on(Some("q"), None, Operation::Pop)),
            (2.0, on(None, None, push("no-such"))),
            (2.0, on(None, Some(vec![5]), push("nod"))),
        ],
    };
    let skeleton = Skeleton::example();
    let (_, problems) = Players::new(
        &script,
        &library(),
        &skeleton,
        Sex::Male,
        ArmRig::both(&skeleton, &Build::default()),
    );
    let told: Vec<(usize, ProblemKind)> =
        problems.into_iter().map(|p| (p.command, p.kind)).collect();
    assert_eq!(
        told,
        [
            (0, ProblemKind::NoPlayer(None)),
            (2, ProblemKind::NoPlayer(Some("q".to_owned()))),
            (3, ProblemKind::NoClip("no-such".to_owned())),
            (4, ProblemKind::NoTrack(TrackRef::Layer(5))),
        ]
    );
}

#[test]
fn feet_stay_while_one_step_passes_into_another() {
    let stage = Stage::new(vec![
        (0.0, add("p", ONE, BoneSet::ALL)),
        (0.3, on(None, None, push("step"))),
        (
            2.3,
            on(
                None,
                None,
                Operation::Exchange("step".to_owned(), Playback::LoopReverse),
            ),
        ),
    ]);
    let zero = place(&stage.skeleton, &idle(&stage.skeleton));
    for i in 0..400 {
        // At 0.3 + n seconds both feet are down, and the right one for half a second.
        let t = 0.3 + f64::from(i) * 0.01;
        if (t - 0.3).rem_euclid(1.0) < 0.5 && t < 2.3 {
            let drift = place(&stage.skeleton, &stage.pose(t)).distance(zero);
            assert!(drift < 1e-6, "{drift} m at {t}");
        }
    }
}

fn place(skeleton: &Skeleton, pose: &Pose) -> raconteur_base::DVec3 {
    raconteur_actor::kinematics::world_from_bone(skeleton, pose, Bone::RSubtalar).translation
}

fn any_name() -> impl Strategy<Value = Option<String>> {
    prop_oneof![Just(None), (0..3u8).prop_map(|i| Some(format!("p{i}"))),]
}

fn any_tracks() -> impl Strategy<Value = Option<Vec<TrackRef>>> {
    let track = prop_oneof![
        (0..4usize).prop_map(TrackRef::Layer),
        (0..8usize).prop_map(TrackRef::Group),
    ];
    prop::option::of(prop::collection::vec(track, 1..4))
}

fn any_playback() -> impl Strategy<Value = Playback> {
    (0..7u8, 1..4u32).prop_map(|(style, n)| match style {
        0 => Playback::Loop,
        1 => Playback::LoopReverse,
        2 => Playback::PingPong,
        3 => Playback::Iterations(n),
        4 => Playback::IterationsReverse(n),
        5 => Playback::TemporaryIterations(n),
        _ => Playback::TemporaryIterationsReverse(n),
    })
}

fn any_command() -> impl Strategy<Value = PlayerCommand> {
    let clip = || (0..CLIPS.len()).prop_map(|i| CLIPS[i].0.to_owned());
    let operation = prop_oneof![
        4 => (clip(), any_playback()).prop_map(|(c, p)| Operation::Push(c, p)),
        2 => (clip(), any_playback()).prop_map(|(c, p)| Operation::Exchange(c, p)),
        2 => Just(Operation::Pop),
        1 => Just(Operation::Clear),
    ];
    let kind = (0..3u8, 1..4usize).prop_map(|(k, n)| match k {
        0 => PlayerKind::Multiple(n),
        1 => PlayerKind::BodyGroup,
        _ => PlayerKind::Pose,
    });
    let property = prop_oneof![
        (-2.0..3.0f64).prop_map(|v| (Property::Speed, v)),
        (0.0..1.2f64).prop_map(|v| (Property::Weight, v)),
        (0..2u8).prop_map(|v| (Property::Enable, f64::from(v))),
    ];
    prop_oneof![
        4 => (any_name(), kind, any::<bool>()).prop_map(|(name, kind, exclusive)| PlayerCommand::Add {
            name: name.unwrap_or_else(|| "p".to_owned()),
            kind,
            bones: BoneSet::ALL,
            exclusive,
        }),
        12 => (any_name(), any_tracks(), operation).prop_map(|(player, tracks, operation)| {
            PlayerCommand::Operate { player, tracks, operation }
        }),
        5 => (any_name(), any_tracks(), property, 0.0..2.0f64).prop_map(
            |(player, tracks, (property, value), duration_secs)| PlayerCommand::Set {
                player,
                tracks,
                property,
                value,
                duration_secs,
            }
        ),
        1 => (any_name(), -3..4i32)
            .prop_map(|(player, priority)| PlayerCommand::ChangePriority { player, priority }),
        1 => any_name().prop_map(|player| PlayerCommand::Remove { player }),
        1 => Just(PlayerCommand::Clear),
        1 => (any::<Option<bool>>(), prop::option::of(0.0..1.5f64))
            .prop_map(|(smooth, swap_secs)| PlayerCommand::Configure { smooth, swap_secs }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    /// Nothing pops: not at any command, nor at the end of a fade, nor at a seam.
    #[test]
    fn motion_is_continuous(commands in prop::collection::vec((0.0..6.0f64, any_command()), 1..24)) {
        let mut commands = commands;
        commands.insert(0, (0.0, add("p", TWO, BoneSet::ALL)));
        let skeleton = Skeleton::example();
        let script = PlayerScript { commands: commands.clone() };
        let (players, _) = Players::new(&script, &library(), &skeleton, Sex::Male, ArmRig::both(&skeleton, &Build::default()));
        let mut times: Vec<f64> = commands.iter().map(|c| c.0).filter(|t| *t > 0.0).collect();
        times.extend((1..240).map(|i| f64::from(i) / 30.0));
        let h = 1e-7;
        for t in times {
            let (a, b) = (pose(&players, &skeleton, t - h), pose(&players, &skeleton, t + h));
            for bone in Bone::ALL {
                let (p, q) = (a.rotation(bone), b.rotation(bone));
                prop_assert!(p.is_finite() && p.is_normalized());
                // A knee that stretches turns without bound; half a thousandth of a radian
                // in 0.2 µs is still no pop.
                let turned = p.angle_between(q);
                prop_assert!(turned < 5e-4, "{} turns {turned} at {t}", bone.name());
            }
            let moved = a.root_offset_in_world.distance(b.root_offset_in_world);
            prop_assert!(moved < 1e-5, "the root moves {moved} at {t}");
        }
    }

    /// At 120 Hz no joint turns farther than the quickest change of a half turn allows.
    #[test]
    fn frames_follow_each_other(commands in prop::collection::vec((0.0..4.0f64, any_command()), 1..16)) {
        let mut commands = commands;
        commands.insert(0, (0.0, add("p", PlayerKind::BodyGroup, BoneSet::ALL)));
        let skeleton = Skeleton::example();
        let (players, _) = Players::new(&PlayerScript { commands }, &library(), &skeleton, Sex::Male, ArmRig::both(&skeleton, &Build::default()));
        let step = 1.0 / 120.0;
        let mut last = pose(&players, &skeleton, 0.0);
        // Two stances of a joint lie at most 80° apart here, a clip goes by 3 × 40°/s, and
        // legs by what the feet ask.
        let most = 80f64.to_radians() * 1.875 * step / raconteur_actor::animation::AT_ONCE_SECS;
        for i in 1..600 {
            let next = pose(&players, &skeleton, f64::from(i) * step);
            for bone in [Bone::Skull, Bone::LShoulder, Bone::LElbow] {
                let turned = last.rotation(bone).angle_between(next.rotation(bone));
                prop_assert!(turned < most + 0.1, "{} turns {turned}", bone.name());
            }
            last = next;
        }
    }

    /// The weights of a player's layers are one whole at every time.
    #[test]
    fn weights_sum_to_one(
        changes in prop::collection::vec((0.0..5.0f64, any_tracks(), -0.5..1.5f64, 0.0..2.0f64), 0..16),
        layers in 1..5usize,
    ) {
        let mut commands = vec![(0.0, add("p", PlayerKind::Multiple(layers), BoneSet::ALL))];
        for (t, tracks, value, duration_secs) in changes {
            commands.push((t, PlayerCommand::Set {
                player: None,
                tracks,
                property: Property::Weight,
                value,
                duration_secs,
            }));
        }
        let skeleton = Skeleton::example();
        let (players, _) = Players::new(
            &PlayerScript { commands },
            &library(),
            &skeleton,
            Sex::Male,
            ArmRig::both(&skeleton, &Build::default()),
        );
        for i in 0..80 {
            let weights: Vec<f64> = players.weights_at(0, f64::from(i) * 0.1).collect();
            prop_assert_eq!(weights.len(), layers);
            prop_assert!(weights.iter().all(|w| *w >= -1e-12));
            prop_assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-9);
        }
    }
}
