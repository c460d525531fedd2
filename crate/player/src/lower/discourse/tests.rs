//! Discourse of whole scripts.

use std::sync::Arc;

use raconteur_actor::Mention;
use raconteur_base::Side;
use raconteur_body::{Figure, Skeleton};

use super::*;
use crate::lower::plan::ScriptPlan;

fn read(body: &str) -> Script {
    let eml = format!("<eml xmlns:r='urn:raconteur:eml:1' r:lead='snap'><body>{body}</body></eml>");
    Script::read(&eml, None)
}

fn cast(script: &Script) -> Cast {
    let figure = Figure {
        name: "example".to_owned(),
        skeleton: Skeleton::example(),
        inverse_bind: Vec::new(),
        meshes: Vec::new(),
        morph_names: Vec::new(),
        lid_closure_rad: [0.0; 2],
        sex: None,
        dominant_hand: Side::Right,
        images: Vec::new(),
        tissue: None,
        springs: raconteur_body::Springs::default(),
    };
    Cast::new(Arc::new(figure), &script.document, None)
}

fn plan(body: &str) -> DiscoursePlan {
    let script = read(body);
    ScriptPlan::new(&script, &cast(&script), 0, None).discourse
}

fn discourse(bodies: &[&str]) -> Discourse {
    let plans: Vec<DiscoursePlan> = bodies.iter().map(|body| plan(body)).collect();
    together(plans.iter(), &[])
}

/// Returns the start of each word of a script, story time.
fn starts(body: &str) -> Vec<f64> {
    plan(body)
        .words
        .iter()
        .map(|word| word.start_secs)
        .collect()
}

/// Returns the indices of the words at which mentions start, and the sideways places in units.
fn mentioned(bodies: &[&str]) -> Vec<(usize, f64)> {
    let script = read("");
    let units = cast(&script).units;
    let all: Vec<f64> = bodies.iter().flat_map(|body| starts(body)).collect();
    let middle = units.speaker_point([0.0; 3]).x;
    let shown = |mention: Mention| {
        let word = all.iter().position(|start| *start == mention.start_secs);
        let x = (mention.place_in_figure.x - middle) / units.metres();
        (
            word.expect("a mention starts with a word"),
            (x * 1e6).round() / 1e6,
        )
    };
    discourse(bodies).mentions.into_iter().map(shown).collect()
}

fn texts(words: &[&str]) -> String {
    let text =
        |(i, words): (usize, &&str)| format!("<voice-text time='{}'>{words}</voice-text>", 20 * i);
    words.iter().enumerate().map(text).collect()
}

#[test]
fn words_and_their_endings_mention_a_referent() {
    for (place, text, expected) in [
        (
            "name='goat' x='40'",
            "The Goat, a \u{201c}goat\u{201d}.",
            vec![1, 3],
        ),
        (
            "name='goat'",
            "Goats scapegoat goat\u{2019}s goat's goats' goatee",
            vec![0, 2],
        ),
        (
            "name='Hase' words='Hase Tier'",
            "Hasen gab es dort, und Tieren, Tiere",
            vec![0, 5],
        ),
        ("name='goat' words=''", "goat", vec![0]),
        ("name='goat' words='cabra'", "goat", vec![]),
        ("name='goat' words=' \u{2026} '", "goat \u{2026}", vec![0]),
        ("name='s'", "s", vec![0]),
    ] {
        let body = format!("<r:place time='0' {place}/><voice-text time='0'>{text}</voice-text>");
        let words: Vec<usize> = mentioned(&[&body]).iter().map(|(word, _)| *word).collect();
        assert_eq!(words, expected, "{place} {text}");
    }
}

#[test]
fn the_same_word_twice_is_one_mention_unless_it_is_later() {
    let body = "<r:place time='0' name='goat'/><voice-text time='0'>goat goat and then it was \
                again a goat</voice-text>";
    let mentions = discourse(&[body]).mentions;
    let words = plan(body).words;
    assert_eq!(mentions.len(), 2, "{mentions:?}");
    assert_eq!(mentions[0].end_secs, words[1].end_secs, "both words");
    assert_eq!(mentions[1].start_secs, words[8].start_secs, "later");
}

#[test]
fn a_place_holds_from_its_time_and_a_later_one_moves_the_referent() {
    let body = "<voice-text time='0'>The goat.</voice-text>\
        <r:place time='10' name='goat' x='40' words='goat Bock'/>\
        <voice-text time='20'>The goat. A Bock.</voice-text>\
        <r:place time='30' name='goat' x='-30'/>\
        <voice-text time='40'>The goat or one more Bock.</voice-text>";
    let expected = [(3, 40.0), (5, 40.0), (7, -30.0), (11, -30.0)];
    assert_eq!(mentioned(&[body]), expected, "before, after, moved");
}

#[test]
fn a_place_of_the_story_holds_in_fragments() {
    let story = "<r:place time='0' name='goat' x='40'/>";
    let fragment = "<voice-text time='20'>The goat.</voice-text>";
    assert_eq!(mentioned(&[story, fragment]), [(1, 40.0)], "story first");
    let plans = [plan(fragment)];
    let kept = plan(story).places;
    assert_eq!(together(plans.iter(), &kept).mentions.len(), 1, "carried");
    let mut cut = plan(&format!("{story}{fragment}"));
    cut.cut(20.0);
    assert_eq!(together([cut].iter(), &[]).mentions, [], "not spoken");
}

#[test]
fn a_gesture_places_the_word_it_accompanies() {
    let point = |time: f64| {
        format!(
            "<gesture-key time='{time}' duration='0.6' handedness='left'><motion><key x='25' \
             y='25' z='-10'/></motion></gesture-key>"
        )
    };
    let speech = texts(&["A goat saw it.", "The goat and goats.", "The house."]);
    let body = format!("{}{speech}", point(0.1));
    let mentions = discourse(&[&body]).mentions;
    let starts = starts(&body);
    assert_eq!(mentions.len(), 2, "{mentions:?}");
    assert_eq!(
        (mentions[0].start_secs, mentions[0].end_secs),
        (0.1, 0.7),
        "stroke"
    );
    assert_eq!(
        mentions[1].start_secs, starts[5],
        "the first word of a mention 4 s later"
    );
    let place = mentions[0].place_in_figure;
    assert!(place.x > 0.5 && place.z > 0.1, "left and in front: {place}");
    let own = format!("<r:place time='0' name='goat' x='40'/>{body}");
    assert_eq!(
        mentioned(&[&own]),
        [(1, 40.0), (5, 40.0)],
        "the author's place takes precedence"
    );
    let off = format!("<gesture-is-on time='0' isOn='false'/>{body}");
    assert_eq!(discourse(&[&off]).mentions, [], "gestures are off");
}

/// Returns the texts between the starts and ends of the spans of direct speech, with their sides.
fn roles(bodies: &[&str]) -> Vec<(String, f64)> {
    let plans: Vec<DiscoursePlan> = bodies.iter().map(|body| plan(body)).collect();
    let spans = together(plans.iter(), &[]).roles;
    let spoken = |start_secs: f64, end_secs: f64| {
        let words = plans.iter().flat_map(|plan| &plan.words);
        let own = words.filter(|w| w.start_secs >= start_secs && w.end_secs <= end_secs);
        own.map(|w| w.bare.as_str()).collect::<Vec<_>>().join(" ")
    };
    spans
        .iter()
        .map(|span| (spoken(span.start_secs, span.end_secs), span.side))
        .collect()
}

fn shown(roles: &[(String, f64)]) -> Vec<(&str, f64)> {
    roles
        .iter()
        .map(|(text, side)| (text.as_str(), *side))
        .collect()
}

#[test]
fn characters_have_sides_by_their_first_appearance() {
    let body = texts(&[
        "He said <r:speaker name='a'>\u{201c}I do.</r:speaker>",
        "<r:speaker name='b'>No, <r:speaker name='c'>yes</r:speaker> no.</r:speaker> Then",
        "<r:speaker name='a'>go</r:speaker> \u{201c}away\u{201d} <r:speaker \
         gender='male'>x</r:speaker>",
        "<r:speaker name='e'>five</r:speaker>",
    ]);
    let expected = [
        ("i do", -0.6),
        ("no", 0.6),
        ("yes", -1.0),
        ("no", 0.6),
        ("go", -0.6),
        ("x", 1.0),
        ("five", -0.6),
    ];
    assert_eq!(shown(&roles(&[&body])), expected, "sides");
}

#[test]
fn spans_of_one_character_merge_over_short_narration() {
    let body = texts(&[
        "<r:speaker name='a'>Well,</r:speaker> he <r:speaker name='a'>come \
                        in.</r:speaker> They went in and <r:speaker name='a'>sat.</r:speaker>",
    ]);
    let expected = [("well he come in", -0.6), ("sat", -0.6)];
    assert_eq!(shown(&roles(&[&body])), expected, "merged");
}

#[test]
fn quotes_without_names_alternate() {
    let body = texts(&[
        "She said: \u{201c}Who is it?\u{201d} And he \u{201e}Me.\u{201c} Then \u{ab}So,\u{bb} she \
         said, \"it is",
        "late.\" And went \u{201c}on",
        "and on.",
    ]);
    let expected = [
        ("who is it", -0.6),
        ("me", 0.6),
        ("so", -0.6),
        ("it is", 0.6),
        ("late", 0.6),
        ("on", -0.6),
    ];
    assert_eq!(shown(&roles(&[&body])), expected, "sides");
}

#[test]
fn a_story_of_one_character_has_no_roles() {
    for text in [
        "<r:speaker name='a'>I am all</r:speaker> <r:speaker name='a'>there is.</r:speaker>",
        "\u{201c}I am all there is.\u{201d}",
        "Nobody speaks.",
    ] {
        assert_eq!(roles(&[&texts(&[text])]), [], "{text}");
    }
    let narrated = texts(&["It was late."]);
    let own = "<voice-text time='90'><r:speaker name='a'>I am.</r:speaker></voice-text>";
    assert_eq!(
        shown(&roles(&[&narrated, own])),
        [("i am", -0.6)],
        "a fragment"
    );
    assert_eq!(
        roles(&[own, &narrated]),
        [],
        "nothing before a fragment changes"
    );
}

#[test]
fn paragraphs_begin_with_utterances_and_divisions() {
    let body = texts(&[
        "<div type='paragraph'>One two.</div> <div type='paragraph'>Three four.</div> Five \
         <div type='sentence'>six.</div>",
        "Seven",
        "<break/>",
    ]);
    let starts = starts(&body);
    let expected = [0.0, starts[2], starts[4], 20.0];
    assert_eq!(discourse(&[&body]).paragraphs, expected, "starts");
}

fn tensions(body: &str) -> Vec<f64> {
    let keys = discourse(&[body]).tension;
    keys.iter()
        .map(|key| (key.tension * 1e3).round() / 1e3)
        .collect()
}

#[test]
fn short_stories_have_the_tension_of_their_sentences() {
    let text = "It was late. Who is it? Go <emph>away!</emph>";
    assert_eq!(tensions(&texts(&[text])), [0.5, 0.55, 0.65], "sentences");
    let text = "He said: \u{201c}<emph>Go</emph> away!\u{201d}";
    assert_eq!(tensions(&texts(&[text])), [0.65], "at most 0.15 more");
    let long = "a b c d e f g h i j k l m n o p.";
    assert_eq!(tensions(&texts(&[long])), [0.45], "long and calm");
    assert_eq!(tensions(&texts(&[])), [0.0; 0], "no speech");
}

#[test]
fn long_stories_have_an_arc() {
    let body = texts(&[
        "A b.", "A b.", "A b.", "A b.", "A b.", "A b.", "A b.", "A b.", "A b.", "A b.",
    ]);
    let expected = [
        0.25, 0.31, 0.37, 0.43, 0.49, 0.55, 0.667, 0.783, 0.9, 0.6, 0.3,
    ];
    assert_eq!(tensions(&body), expected, "by spoken time");
    let keys = discourse(&[&body]).tension;
    assert_eq!(keys[1].at_secs, 20.0, "at the start of a sentence");
}

#[test]
fn beats_set_the_tension_of_what_follows_in_the_document() {
    let body = format!(
        "{}<r:beat time='0' tension='0.9'/><voice-text time='80'>It was! So!</voice-text>\
         <r:beat time='0'/><voice-text time='90'>Why?</voice-text>",
        texts(&["It was late."])
    );
    let found = tensions(&body);
    assert_eq!(found[1..3], [0.9, 0.9], "set");
    assert!(found[0] < 0.3 && found[3] < 0.9, "derived: {found:?}");
}

#[test]
fn times_that_are_no_numbers_do_no_harm() {
    let body = format!(
        "<r:place time='0' name='goat'/><gesture-key time='0.1' duration='0.6' \
         handedness='left'><motion><key x='25' y='25' z='-10'/></motion></gesture-key>{}",
        texts(&["The \u{201c}goat\u{201d} ran."])
    );
    let script = read(&body);
    let cast = cast(&script);
    let mut plan = ScriptPlan::new(&script, &cast, 0, None);
    for secs in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for cue in &mut plan.utterances {
            cue.timed.start_secs = secs;
        }
        for stroke in plan.strokes.iter_mut().flatten() {
            stroke.start_secs = secs;
        }
        let (strokes, switches) = (&plan.strokes, [(secs, false), (secs, true)]);
        let own = DiscoursePlan::new(&script, &plan.utterances, strokes, &switches, &cast);
        let mut found = together([own].iter(), &[]);
        assert_eq!(std::mem::take(&mut found), Discourse::default(), "{secs}");
    }
}

#[test]
fn quiet_and_whispered_words_are_hushed() {
    let hushed = |text: &str| -> Vec<[usize; 2]> {
        let body = format!("<voice-text time='0'>{text}</voice-text>");
        let words = plan(&body).words;
        let place = |t: f64, of: fn(&TimedWord) -> f64| {
            let found = words.iter().position(|word| of(word) == t);
            found.expect("a span begins and ends with words")
        };
        let spans = discourse(&[&body]).hushed.into_iter();
        spans
            .map(|span| {
                [
                    place(span.start_secs, |word| word.start_secs),
                    place(span.end_secs, |word| word.end_secs),
                ]
            })
            .collect()
    };
    for (text, expected) in [
        (
            "He <volume level='quiet'>had a <emph>big</emph> one</volume> there.",
            vec![[1, 4]],
        ),
        ("He <volume level='0.5'>had</volume> it.", vec![[1, 1]]),
        ("He <volume level='-20%'>had</volume> it.", vec![]),
        (
            "He <volume level='quiet'><volume level='loud'>had</volume></volume> it.",
            vec![],
        ),
        (
            "Hush now. \u{201c}Come here\u{201d}, she whispered. And then she ran.",
            vec![[2, 5]],
        ),
        ("Er fl\u{fc}sterte leise.", vec![[0, 2]]),
        ("A whisper of wind? No.", vec![[0, 3]]),
        ("Nothing is said.", vec![]),
    ] {
        assert_eq!(hushed(text), expected, "{text}");
    }
}

#[test]
fn a_cut_ends_hushed_speech() {
    let body = "<voice-text time='0'>He <volume level='quiet'>had a secret</volume>.</voice-text>";
    let mut plan = plan(body);
    let at_secs = plan.words[2].start_secs + 0.01;
    plan.cut(at_secs);
    let ends: Vec<f64> = plan.hushed.iter().map(|span| span.end_secs).collect();
    assert_eq!(ends, [at_secs], "it ends at the cut");
}
