//! Properties of animation players over random scripts.

mod clips;

use clips::*;
use proptest::prelude::*;
use raconteur_actor::animation::{
    BoneSet, Operation, Playback, PlayerCommand, PlayerKind, PlayerScript, Players, Property,
    TrackRef,
};
use raconteur_actor::limb::{ArmRig, Build, Sex};
use raconteur_body::{Bone, Skeleton};

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

    /// Checks that nothing jumps: neither at a command, nor at the end of a fade, nor at a seam.
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
                // A stretching knee turns without bound; half a thousandth of a radian in 0.2 µs is
                // still no jump.
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
        // Two stances of a joint differ by at most 80° here, a clip moves by 3 × 40°/s, and legs
        // follow the feet.
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
