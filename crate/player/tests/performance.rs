//! Properties of whole performances: the shipped stories, played by the shipped figure.

mod common;

use common::{figure, perform, story};
use raconteur_base::noise;
use raconteur_player::body::Bone;
use raconteur_player::{CueKind, LoadedPlayer, Options};
use raconteur_tier::sized;

fn load(name: &str) -> LoadedPlayer {
    story(name, figure(), Options::default())
}

#[test]
fn seeking_to_a_time_shows_what_playing_to_it_shows() {
    for name in ["hello-world", "white-rabbit", "step-lesson"] {
        let mut played = load(name).player;
        let mut sought = load(name).player;
        let end = played.duration_secs();
        let times: Vec<f64> = (0..40).map(|i| end * f64::from(i) / 39.0).collect();
        let digests: Vec<u64> = times.iter().map(|t| played.digest(*t)).collect();
        // The other player jumps about.
        for i in 0..sized(50, 200) {
            let k = noise::hash(3, 1, i) as usize % times.len();
            assert_eq!(
                sought.digest(times[k]),
                digests[k],
                "{name} at {}",
                times[k]
            );
        }
    }
}

#[test]
fn everything_stays_finite_and_bones_keep_their_length() {
    let mut player = load("white-rabbit").player;
    let skeleton = figure().skeleton.clone();
    for i in 0..600 {
        let t = player.duration_secs() * f64::from(i) / 599.0;
        let frame = player.frame(t, 1.6);
        assert!(
            frame
                .morph_weights
                .iter()
                .all(|w| w.is_finite() && *w >= 0.0),
            "at {t}"
        );
        for bone in Bone::ALL {
            let world = frame.world_from_joint[bone.index()];
            assert!(world.is_finite(), "{} at {t}", bone.name());
            if let Some(parent) = bone.parent() {
                let from = frame.world_from_joint[parent.index()].translation;
                let length = (world.translation - from).length();
                // Rounding over a chain of ten joints of a metre or so.
                assert!(skeleton.stretched_m(bone, length) < 1e-9, "{}", bone.name());
            }
        }
    }
}

#[test]
fn times_outside_the_story_show_its_ends() {
    let mut player = load("hello-world").player;
    let end = player.duration_secs();
    let (first, last) = (player.digest(0.0), player.digest(end));
    for t in [-1.0, f64::NEG_INFINITY, f64::NAN] {
        assert_eq!(player.digest(t), first);
    }
    for t in [end + 1.0, f64::INFINITY] {
        assert_eq!(player.digest(t), last);
    }
}

#[test]
fn the_spoken_word_is_the_one_whose_time_it_is() {
    let player = load("white-rabbit").player;
    for (index, utterance) in player.utterances().iter().enumerate() {
        let timed = &utterance.timed;
        assert!(
            !utterance.estimated && !timed.utterance.audio.is_empty(),
            "the baked utterance has audio"
        );
        for (w, word) in timed.utterance.words.iter().enumerate() {
            let middle = timed.story_secs(0.5 * (word.start_secs + word.end_secs));
            let now = player.speech_at(middle).expect("speech");
            assert_eq!((now.utterance, now.word), (index, Some(w)), "{}", word.text);
        }
    }
}

#[test]
fn cues_come_in_order_and_each_exactly_once() {
    let mut player = load("white-rabbit").player;
    let mut heard = 0;
    let mut now = -1.0;
    while now < player.duration_secs() {
        now += 0.05;
        player.advance(now);
        heard += player.drain_events().len();
    }
    let all = player.cues();
    assert!(
        all.windows(2).all(|w| w[0].time_secs <= w[1].time_secs),
        "the cues are in chronological order"
    );
    assert_eq!(heard, all.len());
    let words = all
        .iter()
        .filter(|c| matches!(c.kind, CueKind::Word { .. }))
        .count();
    let utterances = player.utterances().iter();
    let written: usize = utterances.map(|u| u.timed.utterance.words.len()).sum();
    assert_eq!(words, written);
}

#[test]
fn the_greeting_hand_is_above_the_head_when_she_says_hello() {
    let mut player = load("hello-world").player;
    let first = &player.utterances()[0].timed;
    let hello = first.story_secs(first.utterance.words[0].start_secs);
    let frame = player.frame(hello, 1.6);
    let hand = frame.world_from_joint[Bone::RWrist.index()].translation;
    let skull = frame.world_from_joint[Bone::Skull.index()].translation;
    assert!(hand.y > skull.y && hand.x < 0.0, "{hand} {skull}");
    // And she begins with her hands down.
    let start = player.frame(0.0, 1.6);
    let hand = start.world_from_joint[Bone::RWrist.index()].translation;
    let shoulder = start.world_from_joint[Bone::RShoulder.index()].translation;
    assert!(hand.y < shoulder.y - 0.2, "{hand}");
}

#[test]
fn a_story_without_voice_still_moves_its_lips() {
    let eml = "<eml><body><voice-text time='0'>Once upon a time</voice-text></body></eml>";
    let mut loaded = perform(eml, None, figure(), Options::default());
    assert!(
        loaded
            .diagnostics
            .iter()
            .any(|d| d.code == "player::no-bundle"),
        "the diagnostics report the missing bundle"
    );
    let jaw = Bone::Chin.index();
    let closed = loaded.player.frame(0.0, 1.6).world_from_joint[jaw];
    let end = loaded.player.duration_secs();
    let moved = (0..60).any(|i| {
        let now = loaded
            .player
            .frame(end * f64::from(i) / 60.0, 1.6)
            .world_from_joint[jaw];
        let turn = closed.matrix3.inverse() * now.matrix3;
        (turn.col(0).x - 1.0).abs() > 1e-4
    });
    assert!(moved, "the lips move without a voice");
}

#[test]
fn a_figure_that_a_script_moves_goes_and_wants_the_animations_of_its_players() {
    let eml = "<eml><body>
        <voice-text time='0'>Here I stand</voice-text>
        <vh-move time='0' functionName='segment'><function-args><arg name='timePeriod' value='1'/>
            <arg name='endX' value='9'/></function-args></vh-move>
        <body-player-add time='0' name='p' type='multiple' numberOfLayers='1'/>
        <body-deterministic-primitive time='0' primitive='push' player='p'
            animationSetName='sit'/></body></eml>";
    let mut player = perform(eml, None, figure(), Options::default()).player;
    assert_eq!(player.needed_animations(), ["sit"]);
    let [from, to] = [0.0, 1.5].map(|t| player.frame(t, 1.6).world_from_joint[Bone::Skull.index()]);
    assert!(
        from.translation.distance(to.translation) > 0.1,
        "the script moves the figure by more than 10 cm"
    );
}
