//! Live performance: clauses that arrive while a story plays.

mod common;

use common::{asset, figure, perform, text};
use raconteur_player::body::Bone;
use raconteur_player::live::{FragmentOutcome, limits};
use raconteur_player::{Event, Options, Player};

/// A player of `eml` with the voice of `hello-world`, open-ended.
fn player(eml: &str) -> Player {
    let bundle = asset("stories/hello-world/voice/speech.json");
    let mut player = perform(eml, Some(&bundle), figure(), Options::default()).player;
    player.set_open_ended(true);
    player
}

fn hello_world() -> Player {
    player(&text("stories/hello-world/story.eml"))
}

const WAITING: &str = "<eml><body/></eml>";
const LINE: &str = "<voice-text time='0' timeId='v'><div>Hello <emph><tm name='w'/>world!</emph>\
                    </div></voice-text>";
const HAND: &str = "<gesture-key time='0' duration='0.4' handedness='right'>\
                    <motion><key x='-12' y='38' z='-6'/></motion></gesture-key>";

fn codes(performed: &FragmentOutcome) -> Vec<&'static str> {
    performed.diagnostics.iter().map(|d| d.code).collect()
}

/// Plays at 60 Hz from one time to another; the events.
fn play(player: &mut Player, from: f64, to: f64) -> Vec<Event> {
    let mut events = Vec::new();
    let frames = ((to - from) * 60.0).ceil() as u32;
    for i in 1..=frames {
        player.advance((from + f64::from(i) / 60.0).min(to));
        events.extend(player.drain_events());
    }
    events
}

/// One word for each event, in order.
fn outline(events: &[Event]) -> Vec<String> {
    let lines = events.iter().map(|event| match event {
        Event::Word { text, .. } => format!("word {text}"),
        Event::Phone { symbol, .. } => format!("phone {symbol}"),
        Event::Mark { name, .. } => format!("mark {name}"),
        Event::Clause { phase, element, .. } => format!("{phase} {element}"),
        Event::Utterance { phase, text, .. } => format!("{phase} “{text}”"),
        Event::StoryEvent { kind, payload, .. } => format!("event {kind:?} {payload}"),
        Event::Failed { code, .. } => format!("failed {code}"),
        other => format!("{other:?}"),
    });
    lines.collect()
}

fn right_hand(player: &mut Player, t: f64) -> raconteur_base::DVec3 {
    player.frame(t, 1.6).world_from_joint[Bone::RWrist.index()].translation
}

#[test]
fn a_waiting_figure_speaks_a_baked_line_and_tells_of_it() {
    let mut player = player(WAITING);
    let _ = play(&mut player, 0.0, 5.0);
    let performed = player.perform(1, LINE, 5.0);
    assert!(codes(&performed).is_empty(), "{:?}", performed.diagnostics);
    assert_eq!(performed.clauses[0].start_secs, 5.0);
    assert!(
        !performed.utterances[0].timed.utterance.audio.is_empty(),
        "the baked line has audio"
    );
    let events = play(&mut player, 5.0, 8.0);
    assert_eq!(
        outline(&events),
        [
            "start voice-text",
            "start “Hello world!”",
            "phone pau",
            "mark v",
            "word Hello",
            "phone hh",
            "phone ax",
            "phone l",
            "phone ow",
            "word world!",
            "phone w",
            "mark w",
            "phone er",
            "phone l",
            "phone d",
            "phone pau",
            "end voice-text",
            "end “Hello world!”",
        ]
    );
    assert_eq!(player.end_secs(), 8.0);
    // The lips move during the speech.
    let jaw = |player: &mut Player, t| player.frame(t, 1.6).world_from_joint[Bone::Chin.index()];
    let (closed, open) = (jaw(&mut player, 4.9), jaw(&mut player, 5.35));
    let turn = closed.matrix3.inverse() * open.matrix3;
    assert!(
        (turn.col(0).x - 1.0).abs() > 1e-4,
        "the jaw opens during the speech"
    );
    assert!(
        player.speech_at(5.4).is_some() && player.speech_at(7.0).is_none(),
        "the line is spoken in its interval only"
    );
}

#[test]
fn a_line_that_was_not_baked_is_captioned_with_a_warning() {
    let mut player = player(WAITING);
    let performed = player.perform(
        1,
        "<voice-text time='0'>Nobody baked this</voice-text>",
        1.0,
    );
    assert_eq!(codes(&performed), ["player::not-baked"]);
    let said = &performed.utterances[0];
    assert!(
        said.estimated && said.timed.utterance.audio.is_empty(),
        "the line without a bake is estimated and silent"
    );
    let words = outline(&play(&mut player, 1.0, 4.0));
    assert!(words.contains(&"word baked".to_owned()), "{words:?}");
}

#[test]
fn a_line_that_was_not_baked_is_mimed_in_the_language_of_the_performer() {
    let mut player = player(
        "<eml xmlns:r='urn:raconteur:eml:1'><head><r:performer language='de'/></head><body/></eml>",
    );
    let performed = player.perform(1, "<voice-text time='0'>Wale</voice-text>", 1.0);
    let phones = &performed.utterances[0].timed.utterance.phones;
    let symbols: Vec<&str> = phones.iter().map(|phone| &*phone.symbol).collect();
    assert_eq!(symbols, ["v", "aa", "l", "ax"]);
}

#[test]
fn a_hand_is_raised_in_time_and_without_a_jump() {
    let mut player = hello_world();
    let rest = right_hand(&mut player, 5.0);
    let performed = player.perform(1, &format!("{LINE}{HAND}"), 5.0);
    let stroke = performed
        .clauses
        .iter()
        .find(|c| c.clause.element == "gesture-key");
    let start = stroke.map_or(0.0, |c| c.start_secs);
    // It waits for the arm, and the voice with it.
    assert!((5.35..=5.9).contains(&start), "{start}");
    assert!(
        performed.clauses.iter().all(|c| c.start_secs == start),
        "all clauses start simultaneously"
    );
    let there = right_hand(&mut player, start);
    assert!(there.y > rest.y + 0.3, "{rest} {there}");
    // A hand never moves faster than in a scripted gesture: 5 m/s.
    let mut before = right_hand(&mut player, 4.9);
    for i in 1..240 {
        let now = right_hand(&mut player, 4.9 + f64::from(i) / 120.0);
        assert!(
            (now - before).length() < 5.0 / 120.0,
            "frame {i}: {before} {now}"
        );
        before = now;
    }
}

#[test]
fn frames_depend_on_the_fragments_and_their_times_alone() {
    let script = [
        (1.0, HAND),
        (1.05, LINE),
        (1.1, HAND),
        (2.5, LINE),
        (4.0, HAND),
    ];
    let times: Vec<f64> = (0..120).map(|i| 0.9 + f64::from(i) * 0.05).collect();
    let digests = |ask_between: bool| {
        let mut player = hello_world();
        let mut sent = script.iter().peekable();
        let mut digests = Vec::new();
        for &t in &times {
            while let Some((at, fragment)) = sent.next_if(|(at, _)| *at <= t) {
                player.perform(1, fragment, *at);
                if ask_between {
                    let _ = player.digest(at + 0.3);
                }
            }
            player.advance(t);
            digests.push(player.digest(t));
        }
        (digests, player)
    };
    let (played, mut player) = digests(false);
    assert_eq!(played, digests(true).0);
    // Seeking shows the same as playing, as long as no other fragment arrives.
    for (i, t) in times.iter().enumerate().skip(85).rev() {
        player.seek(*t);
        assert_eq!(player.digest(*t), played[i], "at {t}");
    }
}

#[test]
fn times_may_name_what_has_passed_and_what_is_to_come() {
    let mut player = hello_world();
    let t2 = player.timeline().marks.get("t2").copied().unwrap();
    let performed = player.perform(1, "<event time='t2+3' timeId='e'>x</event>", t2 + 1.0);
    assert_eq!(performed.clauses[0].start_secs, t2 + 3.0);
    // From another fragment, and late.
    let performed = player.perform(2, "<event time='e+1'>y</event>", t2 + 5.0);
    assert_eq!(codes(&performed), ["live::late"]);
    assert_eq!(performed.clauses[0].start_secs, t2 + 5.0);
    let performed = player.perform(2, "<event time='nobody'>y</event>", t2 + 5.0);
    assert_eq!(codes(&performed), ["eml::unknown-name"]);
    assert!(
        performed.clauses.is_empty(),
        "an unknown time name leaves no clauses"
    );
}

#[test]
fn payloads_come_as_they_are() {
    let mut player = player(WAITING);
    player.perform(
        1,
        "<eml name='note'><body><event type='door'>&lt;b&gt; 1 &amp; 2</event></body></eml>",
        0.5,
    );
    let events = play(&mut player, 0.0, 1.0);
    let payload = events.iter().find_map(|e| match e {
        Event::StoryEvent {
            kind,
            payload,
            fragment,
            ..
        } => Some((kind.as_deref(), payload.as_str(), *fragment)),
        _ => None,
    });
    assert_eq!(payload, Some((Some("door"), "<b> 1 & 2", Some(1))));
}

#[test]
fn a_seek_skips_what_lies_before_and_repeats_what_lies_after() {
    let mut player = player(WAITING);
    player.perform(1, "<null time='2' timeId='n'/>", 1.0);
    player.advance(1.5);
    player.seek(6.0);
    player.advance(6.1);
    assert_eq!(outline(&player.drain_events()), ["failed live::skipped"]);
    player.seek(2.5);
    let told = outline(&play(&mut player, 2.5, 4.0));
    assert_eq!(told, ["start null", "mark n", "end null"]);
}

#[test]
fn garbage_costs_nothing_but_an_answer() {
    let mut player = hello_world();
    let before: Vec<u64> = (0..10).map(|i| player.digest(f64::from(i) * 0.3)).collect();
    for garbage in [
        "",
        "hello",
        "<",
        "<voice-text",
        "</eml>",
        "\u{0}\u{1}",
        "<!DOCTYPE x [<!ENTITY a 'b'>]><eml>&a;</eml>",
        "<seq repetitionCount='1000000'><seq repetitionCount='1000000'><null/></seq></seq>",
        "<null time='1e9'/>",
        "<null time='500000'/>",
        "{\"json\": true}",
    ] {
        let performed = player.perform(1, garbage, 0.5);
        assert!(performed.clauses.is_empty(), "{garbage:?}: {performed:?}");
        assert!(!performed.diagnostics.is_empty(), "{garbage:?}");
    }
    let after: Vec<u64> = (0..10).map(|i| player.digest(f64::from(i) * 0.3)).collect();
    assert_eq!(before, after);
}

#[test]
fn a_flood_is_refused_and_another_mind_is_heard() {
    let mut player = player(WAITING);
    let mut refused = 0;
    for i in 0..2000 {
        let performed = player.perform(1, "<null time='0.1'/>", 1.0 + f64::from(i) * 1e-4);
        refused += usize::from(codes(&performed) == ["live::busy"]);
    }
    assert!(refused >= 2000 - limits::BURST as usize - 3, "{refused}");
    assert!(
        !player.has_room(1, 1.2) && player.has_room(2, 1.2),
        "only the flooding mind is blocked"
    );
    assert!(
        codes(&player.perform(2, "<null time='0'/>", 1.2)).is_empty(),
        "the other mind's fragment is accepted"
    );
    // After some time, the first mind is accepted again.
    assert!(player.has_room(1, 3.0), "the mind is accepted again later");
}

#[test]
fn clauses_are_bounded_and_finished_ones_are_forgotten() {
    let mut player = player(WAITING);
    let long = format!(
        "<seq time='0' repetitionCount='300'>{}</seq>",
        "<null time='1'/>"
    );
    let mut now = 1.0;
    let full = (0..10).find_map(|_| {
        now += 1.0;
        let performed = player.perform(1, &long, now);
        (codes(&performed) == ["live::full"]).then_some(())
    });
    assert!(full.is_some(), "the number of clauses reaches its limit");
    // A week of a talkative mind.
    for hour in 1..=168 {
        now = f64::from(hour) * 3600.0;
        let performed = player.perform(1, LINE, now);
        assert!(codes(&performed).is_empty(), "{performed:?}");
        player.advance(now + 2.0);
        assert!(
            player.drain_events().len() > 10,
            "more than 10 events are reported"
        );
        // The one before is forgotten, this one is not.
        let index = performed.first_utterance;
        assert!(
            player.utterance(index).is_some(),
            "the current utterance is stored"
        );
        assert!(
            index == 0 || player.utterance(index - 1).is_none(),
            "the finished utterance is removed"
        );
    }
    let too_long = format!(
        "<voice-text time='0'>{}</voice-text>",
        "a ".repeat(limits::FRAGMENT_BYTES)
    );
    assert_eq!(
        codes(&player.perform(1, &too_long, now)),
        ["live::too-large"]
    );
}

/// Returns the timing of a fragment whose hand cannot be in place in time: its start, the arrival
/// of the hand, seconds after it was sent, and the diagnostics.
fn hurried(lead: &str) -> (f64, f64, Vec<&'static str>) {
    let mut player = player(WAITING);
    let _ = play(&mut player, 0.0, 5.0);
    let fragment = format!(
        "<eml xmlns:r='urn:raconteur:eml:1'{lead}><body>{HAND}<null time='3'/></body></eml>"
    );
    let performed = player.perform(1, &fragment, 5.0);
    let begins = performed.clauses[0].start_secs - 5.0;
    let mut hand = |i: u32| right_hand(&mut player, 5.0 + f64::from(i) / 60.0);
    let ways: Vec<_> = (0..180).map(|i| (i, hand(i))).collect();
    let highest = ways.iter().fold(f64::MIN, |top, (_, hand)| top.max(hand.y));
    let there = ways.iter().find(|(_, hand)| hand.y > highest - 0.02);
    let there_secs = there.map_or(f64::NAN, |(i, _)| f64::from(*i) / 60.0);
    (begins, there_secs, codes(&performed))
}

#[test]
fn a_fragment_waits_or_its_stroke_comes_late_or_at_once() {
    let (begins, waited, told) = hurried("");
    assert!(begins > 0.5 && waited > 0.5, "{begins} {waited}");
    assert_eq!(told, [""; 0]);
    let (begins, late, told) = hurried(" r:lead='late'");
    assert!(begins.abs() < 1e-9 && late > 0.5, "{begins} {late}");
    assert_eq!(told, ["player::late"]);
    let (begins, at_once, told) = hurried(" r:lead='snap'");
    assert!(
        begins.abs() < 1e-9 && at_once < late - 0.1,
        "{begins} {at_once}"
    );
    assert_eq!(told, [""; 0]);
}
