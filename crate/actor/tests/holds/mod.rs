//! Invariants of any animation text, shared by the tests and the fuzz target.

use raconteur_actor::animation::{
    BoneSet, Library, Operation, Playback, PlayerCommand, PlayerKind, PlayerScript, Players,
};
use raconteur_actor::limb::{ArmRig, Build, Sex};
use raconteur_actor::parameters::ParameterClip;
use raconteur_body::{Pose, Skeleton};

/// A text as a clip and as an animation of control parameters: it is refused with a message of
/// bounded length, or it plays with finite poses.
pub(crate) fn animation(text: &str) {
    let short = |why: &str| assert!(!why.is_empty() && why.len() < 4096, "{why}");
    match ParameterClip::read(text) {
        Ok(clip) => assert!(
            clip.duration_secs() >= 0.0 && clip.duration_secs().is_finite(),
            "the clip has a finite duration of at least 0 s"
        ),
        Err(why) => short(&why),
    }
    let mut library = Library::default();
    if let Err(why) = library.add("x", text) {
        return short(&why);
    }
    let seconds = library.get("x").map_or(0.0, |clip| clip.duration_secs());
    assert!(
        (0.0..=3600.0).contains(&seconds),
        "the duration is between 0 and 3600 s"
    );
    let add = PlayerCommand::Add {
        name: "p".to_owned(),
        kind: PlayerKind::Multiple(1),
        bones: BoneSet::ALL,
        exclusive: false,
    };
    let push = PlayerCommand::Operate {
        player: None,
        tracks: None,
        operation: Operation::Push("x".to_owned(), Playback::PingPong),
    };
    let commands = vec![(0.0, add), (0.0, push)];
    let skeleton = Skeleton::example();
    let (players, _) = Players::new(
        &PlayerScript { commands },
        &library,
        &skeleton,
        Sex::Male,
        ArmRig::both(&skeleton, &Build::default()),
    );
    let mut world = Vec::new();
    for t in [0.0, 0.013, seconds / 3.0, seconds, 2.5 * seconds + 1.0] {
        let mut pose = Pose::zero();
        let _ = players.apply(&skeleton, t, &mut pose);
        skeleton.solve(&pose, &mut world);
        assert!(
            world.iter().all(raconteur_base::DAffine3::is_finite),
            "at {t} s"
        );
    }
}
