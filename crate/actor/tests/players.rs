//! Properties of animation players over generated scripts.

mod clips;

use clips::*;
use raconteur_actor::animation::{
    BODY_GROUPS, BoneSet, CommandProblemKind, Operation, Playback, PlayerCommand, PlayerKind,
    PlayerScript, Players, Property, TrackRef, body_group,
};
use raconteur_actor::limb::{ArmRig, Build, Sex};
use raconteur_body::{Bone, Pose, Skeleton};

#[test]
fn nothing_played_leaves_the_pose_to_the_bit() {
    let stage = Stage::new(vec![(1.0, add("p", ONE, BoneSet::ALL))]);
    let mut pose = Pose::zero();
    assert!(
        stage
            .players
            .apply(&stage.skeleton, 0.5, &mut pose)
            .is_none(),
        "players without an animation have no effect"
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
    // A single layer counts fully.
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
    assert!(
        pose.rotation(Bone::LElbow).w < 0.9,
        "the elbow of the group is bent"
    );
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
    // An animation pauses at its start.
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
    assert!(
        pose.rotation(Bone::LIndex1).w < 0.75,
        "the index finger of the hand shape is bent"
    );
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
    // The transition to a stop adds half a second of motion.
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
    // The player without a name is the first, although it was added later.
    let unnamed = Stage::new(vec![
        (0.0, add("a", ONE, BoneSet::ALL)),
        (0.0, add("", ONE, BoneSet::ALL)),
        (0.0, on(None, None, push("left"))),
        (0.0, on(Some("a"), None, push("right"))),
        (1.0, PlayerCommand::Remove { player: None }),
    ]);
    near(unnamed.turn(0.9), 40.0);
    near(unnamed.turn(1.9), -40.0);
    // Where no other player moves the bone, a change of order has no effect: no dip at 1.2 s.
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
    let told: Vec<(usize, CommandProblemKind)> =
        problems.into_iter().map(|p| (p.command, p.kind)).collect();
    assert_eq!(
        told,
        [
            (0, CommandProblemKind::NoPlayer(None)),
            (2, CommandProblemKind::NoPlayer(Some("q".to_owned()))),
            (3, CommandProblemKind::NoClip("no-such".to_owned())),
            (4, CommandProblemKind::NoTrack(TrackRef::Layer(5))),
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
