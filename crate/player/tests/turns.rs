//! Live performance: utterances follow each other, and interrupted ones end.

mod common;

use common::{asset, figure, perform, text};
use raconteur_player::body::Bone;
use raconteur_player::body::face::FaceControls;
use raconteur_player::{Event, Options, Player};

/// A player of the story `hello-world`, open-ended.
fn hello_world() -> Player {
    let bundle = asset("stories/hello-world/voice/speech.json");
    let eml = text("stories/hello-world/story.eml");
    let mut player = perform(&eml, Some(&bundle), figure(), Options::default()).player;
    player.set_open_ended(true);
    player
}

const LINE: &str = "<voice-text time='0' timeId='v'><div>Hello <emph><tm name='w'/>world!</emph>\
                    </div></voice-text>";
const HAND: &str = "<gesture-key time='0' duration='2' handedness='right'>\
                    <motion><key time='0' x='-12' y='38' z='-6'/>\
                    <key time='1' x='-20' y='45' z='-6'/></motion></gesture-key>";
const FEELING: &str =
    "<r:emotion xmlns:r='urn:raconteur:eml:1' time='0' type='joy' potential='8'/>";

/// Numbers that are the same every time.
struct SeededRandom(u64);

impl SeededRandom {
    /// From 0 to below `below`.
    fn roll(&mut self, below: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(0x5851_f42d_4c95_7f2d)
            .wrapping_add(0x1405_7b7e_f767_814f);
        (self.0 >> 33) % below
    }
}

/// Returns a random speaking fragment, possibly delayed, with repetition or a gesture.
fn remark(dice: &mut SeededRandom) -> String {
    let words = ["so", "and then he", "nobody knew why the old door was open"];
    let pause = dice.roll(20) as f64 / 10.0;
    let said = words[dice.roll(3) as usize];
    let hand = if dice.roll(3) == 0 { HAND } else { "" };
    let more = if dice.roll(3) == 0 {
        "<voice-text time='e+1.5'>more</voice-text>"
    } else {
        ""
    };
    format!("<voice-text time='{pause}'>{said}<tm name='e'/></voice-text>{more}{hand}")
}

fn play(player: &mut Player, from: f64, to: f64) -> Vec<Event> {
    player.advance(from);
    let mut events = player.drain_events();
    let frames = ((to - from) * 60.0).ceil() as u32;
    for i in 1..=frames {
        player.advance((from + f64::from(i) / 60.0).min(to));
        events.extend(player.drain_events());
    }
    events
}

#[test]
fn no_two_utterances_of_fragments_overlap() {
    for seed in 0..40 {
        let mut dice = SeededRandom(seed);
        let mut player = hello_world();
        let mut spoken: Vec<(f64, f64)> = player
            .utterances()
            .iter()
            .map(|u| (u.timed.start_secs, u.timed.end_secs()))
            .collect();
        let mut now = 0.0;
        for _ in 0..12 {
            now += dice.roll(15) as f64 / 10.0;
            let performed = player.perform(1, &remark(&mut dice), now);
            let told: Vec<f64> = performed.clauses.iter().map(|c| c.start_secs).collect();
            for said in &performed.utterances {
                // The response specifies the time of the speech.
                assert!(
                    told.contains(&said.timed.start_secs),
                    "the utterance starts at a reported time"
                );
                spoken.push((said.timed.start_secs, said.timed.end_secs()));
            }
        }
        spoken.sort_by(|a, b| a.0.total_cmp(&b.0));
        for pair in spoken.windows(2) {
            assert!(pair[0].1 <= pair[1].0 + 1e-6, "seed {seed}: {pair:?}");
        }
    }
}

#[test]
fn what_waits_begins_a_breath_later_and_stays_together() {
    let mut player = hello_world();
    let first = player.perform(1, LINE, 5.0);
    let second = player.perform(1, &format!("{LINE}<event time='v+0.5'>x</event>"), 5.3);
    let [first, second] = [first, second].map(|p| (p.utterances[0].timed.clone(), p.clauses));
    assert!(
        (second.0.start_secs - first.0.end_secs() - 0.15).abs() < 1e-6,
        "the second utterance starts 0.15 s after the first"
    );
    let event = second.1.iter().find(|c| c.clause.element == "event");
    assert!(
        (event.unwrap().start_secs - second.0.start_secs - 0.5).abs() < 1e-9,
        "the delayed event keeps its offset to the speech"
    );
    // A fragment without speech does not wait, nor does one that arrives in silence.
    assert!(
        player.perform(1, "<null time='0'/>", 5.6).clauses[0].start_secs < 5.8,
        "the fragment without speech is not delayed"
    );
    assert!(
        player.perform(1, LINE, 9.0).clauses[0].start_secs < 9.2,
        "the fragment after the speech is not delayed"
    );
}

#[test]
fn what_waits_and_what_is_cut_is_sought_as_it_is_played() {
    let times: Vec<f64> = (0..140).map(|i| 3.0 + f64::from(i) * 0.05).collect();
    let run = |ask_between: bool| {
        let mut player = hello_world();
        let mut digests = Vec::new();
        for &t in &times {
            if [3.2, 3.4, 6.0].iter().any(|at| (at - t).abs() < 0.01) {
                player.perform(1, &format!("{LINE}{HAND}"), t);
            }
            if (t - 5.5).abs() < 0.01 {
                assert!(player.interrupt(t).is_some(), "the speech is interrupted");
            }
            if ask_between {
                let _ = player.digest(t + 0.3);
            }
            player.advance(t);
            digests.push(player.digest(t));
        }
        (digests, player)
    };
    let (played, mut player) = run(false);
    assert_eq!(played, run(true).0);
    for (i, t) in times.iter().enumerate().skip(80).rev() {
        player.seek(*t);
        assert_eq!(player.digest(*t), played[i], "at {t}");
    }
}

/// Returns the name of an event, and its begin or end.
fn phase(event: &Event) -> Option<(String, &'static str)> {
    match event {
        Event::Clause {
            phase,
            clause,
            fragment: Some(of),
            ..
        } => Some((format!("{of} clause {clause}"), phase)),
        Event::Utterance {
            phase,
            utterance,
            fragment: Some(of),
            ..
        } => Some((format!("{of} said {utterance}"), phase)),
        _ => None,
    }
}

fn fragment(event: &Event) -> Option<u32> {
    match event {
        Event::Clause { fragment, .. }
        | Event::Utterance { fragment, .. }
        | Event::Word { fragment, .. }
        | Event::Phone { fragment, .. }
        | Event::Mark { fragment, .. }
        | Event::StoryEvent { fragment, .. } => *fragment,
        _ => None,
    }
}

#[test]
fn what_is_interrupted_ends_and_is_not_heard_of_again() {
    for step in 0..25 {
        let at = 4.0 + f64::from(step) * 0.2;
        let mut player = hello_world();
        for i in 0..3 {
            let eml = format!("{LINE}{HAND}<event time='v+1'>x</event>");
            player.perform(1, &eml, 4.0 + f64::from(i) * 0.01);
        }
        let before = play(&mut player, 3.9, at);
        let end = player.interrupt(at).unwrap_or(at);
        assert!((at..=at + 0.2).contains(&end), "{at} {end}");
        assert!(
            (0..200).all(|i| player.speech_at(end + f64::from(i) * 0.02).is_none()),
            "no speech is active after the interruption"
        );
        let after = play(&mut player, at, at + 10.0);
        // The end events come immediately, and no others.
        for event in &after {
            let told = phase(event).map(|(_, phase)| phase);
            assert!(
                fragment(event).is_none() || told.is_some() || at < end,
                "{event:?}"
            );
        }
        let mut open: Vec<String> = Vec::new();
        for (name, phase) in before.iter().chain(&after).filter_map(phase) {
            if phase == "start" {
                open.push(name);
            } else {
                let begun = open.iter().position(|o| *o == name);
                assert!(begun.is_some(), "{name} ends and did not begin");
                open.swap_remove(begun.unwrap_or(0));
            }
        }
        assert!(open.is_empty(), "at {at}: {open:?}");
        assert_eq!(player.interrupt(at + 9.0), None);
        // Another fragment may follow normally.
        let next = player.perform(1, LINE, at + 10.0);
        assert!(
            next.clauses[0].start_secs < at + 10.3,
            "a later fragment starts without delay"
        );
    }
}

#[test]
fn a_fragment_may_follow_an_interruption_at_once() {
    let mut player = hello_world();
    player.perform(1, LINE, 5.0);
    player.advance(5.4);
    let answer = player.perform(1, " <interrupt/>\n", 5.4);
    assert!(
        answer.interrupts && answer.diagnostics.is_empty() && answer.clauses.is_empty(),
        "the answer interrupts without clauses or diagnostics"
    );
    let next = player.perform(1, LINE, 5.4);
    assert_eq!(next.clauses[0].start_secs, 5.4);
    assert_eq!(
        player.speech_at(5.41).map(|s| s.utterance),
        Some(next.first_utterance)
    );
}

#[test]
fn interrupting_nothing_and_the_story_changes_nothing() {
    let mut player = hello_world();
    let before: Vec<u64> = (0..10).map(|i| player.digest(f64::from(i) * 0.3)).collect();
    player.advance(1.2);
    assert_eq!(player.interrupt(1.2), None);
    assert_eq!(player.interrupt(f64::NAN), None);
    let after: Vec<u64> = (0..10).map(|i| player.digest(f64::from(i) * 0.3)).collect();
    assert_eq!(before, after);
    assert!(
        player.speech_at(1.5).is_some(),
        "the story continues to speak"
    );
}

/// The largest difference between two faces, lids apart: a blink is as quick as it is.
fn distance(a: &FaceControls, b: &FaceControls) -> f64 {
    let values = |f: &FaceControls| {
        let mut values = f.contraction.to_vec();
        values.extend(f.protrusion);
        values.extend([f.seal, f.bite, f.tongue_tip, f.tongue_back, f.tongue_out]);
        values
    };
    let pairs = values(a).into_iter().zip(values(b));
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// A frame of the easing by which the face passes from one fragment to another: all of a value in 0.12 s.
const EASED: f64 = 1.875 / 0.12 / 120.0;

/// The largest change of a joint's angle, radians, and of the face, between two frames.
fn jumps(player: &mut Player, from: f64, to: f64) -> (f64, f64) {
    const RATE: f64 = 120.0;
    let (mut angle, mut face): (f64, f64) = (0.0, 0.0);
    let mut before = None;
    for i in 0..((to - from) * RATE) as u32 {
        let t = from + f64::from(i) / RATE;
        let joints: Vec<_> = player.frame(t, 1.6).world_from_joint.clone();
        let controls = player.face_controls(t);
        let now = (joints, controls);
        if let Some((joints, controls)) = &before {
            let joints: &Vec<raconteur_base::DAffine3> = joints;
            for bone in Bone::ALL {
                let (a, b) = (joints[bone.index()].matrix3, now.0[bone.index()].matrix3);
                let turn = raconteur_base::DQuat::from_mat3(&(a.inverse() * b));
                angle = angle.max(2.0 * raconteur_base::ops::acos_clamped(turn.w.abs()));
            }
            face = face.max(distance(&now.1, controls));
        }
        before = Some(now);
    }
    (angle, face)
}

#[test]
fn an_interruption_does_not_jump() {
    let eml = format!("{LINE}{HAND}{FEELING}");
    let mut player = hello_world();
    player.perform(1, &eml, 5.0);
    let usual = jumps(&mut player, 4.5, 10.0);
    for step in 0..12 {
        let at = 5.1 + f64::from(step) * 0.23;
        let mut player = hello_world();
        player.perform(1, &eml, 5.0);
        player.advance(at);
        player.interrupt(at);
        let (angle, face) = jumps(&mut player, at - 0.1, at + 2.0);
        assert!(
            angle <= 1.1 * usual.0 && face <= usual.1.max(EASED),
            "{at}: {angle} {face}, usual {usual:?}"
        );
    }
}
