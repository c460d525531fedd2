//! Behavior Markup Language as EML scripts.

mod faults;

use raconteur_annotate::{Anchoring, Imported, import};
use raconteur_eml::{
    ClauseKind, Document, EstimatedDurations, Handedness, Phase, Severity, Timeline, parse, write,
};

/// Script that uses every core behaviour.
const EVERYTHING: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="b1" characterId="Ana">
  <speech id="s1" start="0.5"><text>Hello, <sync id="t1"/>my <sync id="t2"/>big world.</text></speech>
  <gesture id="g1" lexeme="HELLO" start="bml:start" strokeStart="s1:t1" end="s1:end + 0.5"/>
  <gesture id="g2" lexeme="BIG" mode="BOTH_HANDS" stroke="s1:t2" relax="s1:t2 + 1"/>
  <gesture lexeme="BEAT" mode="LEFT_HAND" start="g1:end + 0.25"/>
  <pointing id="p1" target="LEFT" stroke="s1:end+6"/>
  <gaze id="z1" target="RIGHT" influence="WAIST" offsetAngle="10" offsetDirection="UP" start="1" end="3"/>
  <gazeShift target="LISTENER" influence="EYES" start="4"/>
  <headDirectionShift target="LISTENER" start="4.5"/>
  <head lexeme="NOD" repetition="2" start="5"/>
  <posture start="1" relax="6"><stance type="SITTING"/><pose lexeme="LEANING_FORWARD"/></posture>
  <postureShift start="9"><stance type="STANDING"/></postureShift>
  <faceLexeme lexeme="RAISE_BROWS" amount="0.8" start="1" attackPeak="1.2" relax="2" end="2.5"/>
  <faceFacs au="12" side="LEFT" amount="0.6" start="2"/>
  <face start="3" amount="1"><lexeme lexeme="SMILE"/><facs au="1" side="BOTH" amount="0.2"/></face>
  <faceShift lexeme="OBLIQUE_BROWS" start="6"/>
  <locomotion target="FRONT" start="10" end="12"/>
  <wait id="w1" duration="2" start="s1:end"/>
  <required><gesture id="g3" lexeme="STOP" start="w1:end"/></required>
  <constraint id="c1">
    <synchronize ref="s1:t2"><sync ref="g3:end - 9"/></synchronize>
    <before ref="g3:start"><sync ref="w1:start"/></before>
    <after ref="w1:start"><sync ref="g3:start"/></after>
  </constraint>
</bml>"#;

fn read(source: &str) -> Imported {
    import(source.as_bytes(), None, Anchoring::Words)
}

fn bml(body: &str) -> Imported {
    read(&format!("<bml id='b'>{body}</bml>"))
}

fn codes(imported: &Imported) -> Vec<&'static str> {
    imported.diagnostics.iter().map(|d| d.code).collect()
}

fn clean(body: &str) -> Document {
    let imported = bml(body);
    assert_eq!(imported.diagnostics, [], "{body} has no problem");
    imported.document
}

/// Returns the document, written and parsed again, with its timeline.
fn timeline(document: &Document) -> (Document, Timeline) {
    let text = write(document);
    let parsed = parse(&text);
    let errors = parsed.diagnostics.iter();
    let errors: Vec<_> = errors.filter(|d| d.severity == Severity::Error).collect();
    assert!(errors.is_empty(), "the script is valid: {errors:?}\n{text}");
    let resolved = Timeline::resolve(&parsed.document, &EstimatedDurations);
    assert_eq!(resolved.diagnostics, [], "all times resolve:\n{text}");
    (parsed.document, resolved.timeline)
}

/// Returns start and end of the phases of all gestures, seconds.
fn phases(document: &Document) -> Vec<(Phase, f64, f64)> {
    let (document, timeline) = timeline(document);
    let lead = timeline.lead_in_secs;
    let clauses = timeline.clauses.iter();
    let phases = clauses.filter_map(|timed| match &document.clause(timed.clause).kind {
        ClauseKind::GestureKey(key) => {
            let secs = |secs: f64| ((secs - lead) * 1000.0).round() / 1000.0;
            Some((
                key.phase.expect("a phase"),
                secs(timed.start_secs),
                secs(timed.end_secs),
            ))
        }
        _ => None,
    });
    phases.collect()
}

fn mark(document: &Document, name: &str) -> f64 {
    let (_, timeline) = timeline(document);
    let mark = timeline.marks.get(name).copied();
    let mark = mark.map(|mark| mark - timeline.lead_in_secs);
    mark.unwrap_or_else(|| panic!("there is a mark {name}"))
}

#[test]
fn every_core_behaviour_is_performed() {
    let imported = read(EVERYTHING);
    // The gestures `g1` and `g3` have ends at other words than their starts.
    assert_eq!(codes(&imported), ["bml::end"; 2]);
    let (document, _) = timeline(&imported.document);
    let names: Vec<&str> = document.clauses.iter().map(|c| c.kind.name()).collect();
    for wanted in [
        "voice-text",
        "gesture-key",
        "body-animate-ADSR-control-parameter",
        "body-non-deterministic-fk",
        "body-configure-manipulator",
        "posture",
        "body-deterministic-primitive",
        "vh-move",
        "null",
    ] {
        assert!(names.contains(&wanted), "{wanted} is among {names:?}");
    }
}

#[test]
fn syncs_of_a_speech_are_marks_at_their_words() {
    let document = clean(
        "<speech id='s'><text>Hello <sync id='w'/>world <sync id='x'/></text></speech>\
         <gesture lexeme='BEAT' strokeStart='s:w+0.25'/>",
    );
    let text = write(&document);
    assert!(
        text.contains("Hello <tm name='v_s_w'/>world <tm name='v_s_x'/><tm name='v_s_end'/>")
            || text.contains("Hello <tm name='v_s_w'/>world<tm name='v_s_x'/>"),
        "marks stand before their words: {text}"
    );
    let world = mark(&document, "v_s_w");
    assert!(world > 0.3, "the second word is later: {world}");
    let stroke = phases(&document)[1];
    assert_eq!(stroke.0, Phase::Stroke, "the phase after the preparation");
    assert!(
        (stroke.1 - world - 0.25).abs() < 2e-3,
        "the stroke follows the word: {stroke:?}, {world}"
    );
}

#[test]
fn two_points_on_one_mark_give_the_length_between() {
    let document = clean(
        "<speech id='s'><text>One <sync id='t'/>two three four five six.</text></speech>\
         <gesture lexeme='STOP' start='s:t - 0.2' strokeStart='s:t + 0.1' strokeEnd='s:t + 1.1' \
         relax='s:t + 1.4' end='s:t + 2.4'/>",
    );
    let t = mark(&document, "v_s_t");
    let found = phases(&document);
    let wanted = [
        (Phase::Preparation, -0.2, 0.1),
        (Phase::Stroke, 0.1, 1.1),
        (Phase::PostStroke, 1.1, 1.4),
        (Phase::Retraction, 1.4, 2.4),
    ];
    assert_eq!(found.len(), wanted.len(), "{found:?}");
    for (found, wanted) in found.iter().zip(wanted) {
        assert_eq!(found.0, wanted.0, "the phases are in order");
        let off = (found.1 - t - wanted.1).abs() + (found.2 - t - wanted.2).abs();
        assert!(off < 4e-3, "{found:?} is {wanted:?} after {t}");
    }
}

#[test]
fn other_times_have_usual_lengths() {
    let document = clean("<gesture lexeme='STOP' strokeStart='2'/>");
    let found = phases(&document);
    assert_eq!(
        found,
        [
            (Phase::Preparation, 1.5, 2.0),
            (Phase::Stroke, 2.0, 2.55),
            (Phase::PostStroke, 2.55, 2.75),
            (Phase::Retraction, 2.75, 3.45),
        ],
        "the usual phases around a stroke"
    );
    // A longer time is spent in the hold.
    let document = clean("<gesture lexeme='STOP' start='1' end='6'/>");
    let found = phases(&document);
    assert_eq!(found[1], (Phase::Stroke, 1.5, 2.05), "a usual stroke");
    assert_eq!(found[2], (Phase::PostStroke, 2.05, 5.3), "a long hold");
    // A shorter one shortens all phases.
    let document = clean("<gesture lexeme='STOP' start='1' end='1.975'/>");
    let found = phases(&document);
    assert_eq!(found[0], (Phase::Preparation, 1.0, 1.25), "half a phase");
}

#[test]
fn phases_on_different_words_stay_in_order() {
    let speech =
        "<speech id='s'><text>One <sync id='t'/>two three <sync id='u'/>four.</text></speech>";
    for (times, anchor, offset_secs) in [
        ("start='s:t' end='s:u + 3'", "v_s_t", 0.5),
        ("start='s:t' strokeStart='s:u'", "v_s_u", 0.0),
        ("strokeStart='s:t' end='s:u'", "v_s_t", 0.0),
    ] {
        let imported = bml(&format!("{speech}<gesture lexeme='STOP' {times}/>"));
        assert_eq!(codes(&imported), ["bml::end"], "{times}");
        let document = imported.document;
        let found = phases(&document);
        let stroke = found.iter().find(|(phase, ..)| *phase == Phase::Stroke);
        let off = stroke.expect("a stroke").1 - mark(&document, anchor) - offset_secs;
        assert!(off.abs() < 2e-3, "{times}: {found:?}");
        let order: Vec<Phase> = found.iter().map(|(phase, ..)| *phase).collect();
        let wanted = [
            Phase::Preparation,
            Phase::Stroke,
            Phase::PostStroke,
            Phase::Retraction,
        ];
        assert_eq!(order, wanted, "{times}");
    }
}

#[test]
fn references_to_behaviours_are_replaced_by_their_own_times() {
    let document = clean(
        "<gesture id='b' lexeme='BEAT' mode='LEFT_HAND' start='a:relax + 0.5'/>\
         <gesture id='a' lexeme='STOP' strokeStart='1'/>\
         <gesture id='c' lexeme='ME' start='b:end'/>",
    );
    let found = phases(&document);
    let starts: Vec<f64> = found
        .iter()
        .filter(|(phase, ..)| *phase == Phase::Preparation)
        .map(|(_, start, _)| *start)
        .collect();
    // a starts at 0.5 and relaxes at 1.75; b takes 1.95.
    assert_eq!(starts, [0.5, 2.25, 4.2], "sums over other gestures");
}

#[test]
fn a_cycle_is_an_error_with_both_places() {
    let imported = bml(
        "<gesture id='a' lexeme='BEAT' start='b:end'/><gesture id='b' lexeme='STOP' start='a:end'/>",
    );
    assert_eq!(codes(&imported), ["bml::cycle"], "one report");
    let problem = &imported.diagnostics[0];
    assert_eq!(problem.severity, Severity::Error, "an error");
    let places = [problem.span, problem.related[0].0];
    let mut places = places.map(|span| span.slice(&imported.text));
    places.sort_unstable();
    assert_eq!(places, ["a:end", "b:end"], "both references");
    let own = bml("<gesture id='a' lexeme='BEAT' start='a:end'/>");
    assert_eq!(codes(&own), ["bml::cycle"], "a behaviour after itself");
    let speech = bml("<speech id='s' start='g:end'><text>Yes.</text></speech>\
         <gesture id='g' lexeme='BEAT' start='s:end'/>");
    assert_eq!(codes(&speech), ["bml::cycle"], "speech and gesture");
    timeline(&speech.document);
}

#[test]
fn a_long_chain_of_references_resolves() {
    let mut body = String::from("<gesture id='g0' lexeme='BEAT' start='0'/>");
    for i in 1..9000 {
        // The last one is first.
        let link = format!(
            "<wait id='g{i}' duration='0.5' start='g{}:{}'/>",
            i - 1,
            if i == 1 { "start" } else { "end" }
        );
        body = if i % 100 == 0 {
            link + &body
        } else {
            body + &link
        };
    }
    let document = clean(&body);
    let (_, timeline) = timeline(&document);
    assert!(
        (timeline.duration_secs - 8999.0 * 0.5).abs() < 1e-6,
        "the sum of the chain: {}",
        timeline.duration_secs
    );
}

#[test]
fn the_number_of_clauses_is_limited() {
    let face = format!("<face>{}</face>", "<facs au='1'/>".repeat(60));
    let imported = bml(&face.repeat(2600));
    assert_eq!(codes(&imported), ["bml::too-large"], "told once");
    assert!(
        imported.document.clauses.len() <= 150_000,
        "{} clauses",
        imported.document.clauses.len()
    );
}

#[test]
fn blocks_follow_or_join_each_other() {
    let source = "<scenario><bml id='one'><speech id='s'><text>One two three.</text></speech></bml>\
         <bml id='two'><gesture id='g' lexeme='BEAT' start='0.5'/></bml>\
         <bml id='three' composition='APPEND'><gesture lexeme='STOP' start='bml:start + 0.25'/>\
         <wait duration='1' start='two:g:start'/></bml></scenario>";
    let imported = read(source);
    assert_eq!(imported.diagnostics, [], "nothing is lost");
    let (_, timeline) = timeline(&imported.document);
    let found = phases(&imported.document);
    let (beat, stop) = (found[0].1, found[4].1);
    assert!((beat - 0.5).abs() < 2e-3, "merged blocks start together");
    let start = timeline.marks.get("block1").copied().expect("a start");
    let end = timeline.marks.get("v_s_end").copied().expect("an end");
    assert!(
        start >= end,
        "the block waits for the speech: {start}, {end}"
    );
    assert!(
        (stop - start + timeline.lead_in_secs - 0.25).abs() < 2e-3,
        "times count from the start of the block: {stop}, {start}"
    );
    let replaced = read("<a><bml><wait duration='1'/></bml><bml composition='REPLACE'/></a>");
    assert_eq!(codes(&replaced), ["bml::composition"], "told");
    let back = read(
        "<a><bml><wait duration='1' start='l:w:end'/></bml>\
         <bml id='l' composition='APPEND'><wait id='w' duration='1'/></bml></a>",
    );
    assert_eq!(codes(&back), ["bml::time"], "no waiting for later blocks");
}

#[test]
fn constraints_give_times_or_are_checked() {
    let document = clean(
        "<gesture id='g' lexeme='STOP'/><constraint>\
         <synchronize ref='2'><sync ref='g:strokeStart - 0.5'/></synchronize></constraint>",
    );
    assert_eq!(phases(&document)[1].1, 2.5, "the stroke is synchronised");
    let reversed = clean(
        "<gesture id='g' lexeme='STOP'/><speech id='s'><text>A <sync id='t'/>b</text></speech>\
         <constraint><synchronize ref='g:strokeStart'><sync ref='s:t'/></synchronize></constraint>",
    );
    let t = mark(&reversed, "v_s_t");
    assert!(
        (phases(&reversed)[1].1 - t).abs() < 2e-3,
        "the gesture follows the word"
    );
    let later = clean(
        "<gesture id='g' lexeme='STOP'/><constraint>\
         <after ref='3'><sync ref='g:start'/></after></constraint>",
    );
    assert_eq!(phases(&later)[0].1, 3.0, "at the earliest possible time");
    let broken = bml("<gesture id='g' lexeme='STOP' start='4'/><constraint>\
         <before ref='3'><sync ref='g:start'/></before></constraint>");
    assert_eq!(codes(&broken), ["bml::constraint"], "it does not hold");
    let open = bml(
        "<speech id='s'><text>A b c</text></speech><gesture id='g' lexeme='STOP' start='4'/>\
         <constraint><before ref='s:end'><sync ref='g:start'/></before></constraint>",
    );
    assert_eq!(codes(&open), ["bml::constraint"], "nobody knows");
}

#[test]
fn hands_and_mirrored_values() {
    let keys = |body: &str| {
        let document = clean(body);
        let keys = document
            .clauses
            .into_iter()
            .map(|clause| match clause.kind {
                ClauseKind::GestureKey(key) => key,
                other => panic!("only gestures, not {other:?}"),
            });
        keys.collect::<Vec<_>>()
    };
    let right = keys("<gesture lexeme='STOP'/>");
    let left = keys("<gesture lexeme='STOP' mode='LEFT_HAND'/>");
    assert_eq!(right[1].handedness, Handedness::Right, "the usual hand");
    assert_eq!(left[1].handedness, Handedness::Left, "the named hand");
    let (a, b) = (
        right[1].motions[0].keys[0].value.position,
        left[1].motions[0].keys[0].value.position,
    );
    assert_eq!([a[0], a[1]], [-b[0], b[1]], "mirrored positions");
    let (a, b) = (
        right[1].palms[0].keys[0].value,
        left[1].palms[0].keys[0].value,
    );
    assert_eq!(a.angle_deg, -b.angle_deg, "mirrored palms");
    // A place on the left is pointed at by the left hand, which ends in its direction.
    let left = keys("<pointing target='LEFT'/>");
    assert_eq!(left[1].handedness, Handedness::Left, "the hand of the side");
    let path = &left[1].motions[0].keys;
    assert!(
        path[1].value.position[0] > path[0].value.position[0] + 3.0,
        "to the left: {path:?}"
    );
}
