//! Faults of BML files: losses, wrong times and malformed text.

use raconteur_eml::{ClauseKind, Severity, parse, write};

use super::{EVERYTHING, bml, codes, read, timeline};

#[test]
fn losses_are_told_and_errors_if_required() {
    let many = format!("<face>{}</face>", "<facs au='1'/>".repeat(80));
    for (body, code) in [
        ("<gesture lexeme='FLY'/>", "bml::lexeme"),
        ("<gesture/>", "bml::lexeme"),
        ("<gesture lexeme='BEAT' mode='FOOT'/>", "bml::mode"),
        ("<pointing/>", "bml::target"),
        ("<pointing target='house'/>", "bml::target"),
        ("<gaze target='UP' influence='KNEE'/>", "bml::influence"),
        (
            "<gaze target='UP' offsetAngle='3' offsetDirection='IN'/>",
            "bml::direction",
        ),
        ("<head lexeme='ROLL'/>", "bml::lexeme"),
        ("<head lexeme='NOD' amount='0.9'/>", "bml::amount"),
        ("<head lexeme='NOD' start='1' end='9'/>", "bml::length"),
        ("<posture/>", "bml::posture"),
        ("<posture><stance type='LYING'/></posture>", "bml::lexeme"),
        ("<face/>", "bml::face"),
        ("<faceLexeme lexeme='GRIN'/>", "bml::lexeme"),
        ("<faceFacs au='99'/>", "bml::action-unit"),
        ("<faceFacs au='12' side='TOP'/>", "bml::side"),
        ("<wait><condition/></wait>", "bml::event"),
        ("<speech><text></text></speech>", "bml::no-text"),
        ("<dance/>", "bml::unknown-element"),
        (many.as_str(), "bml::too-large"),
        (
            "<gesture lexeme='BEAT' frob='3'/>",
            "bml::unknown-attribute",
        ),
        (
            "<gesture id='g' lexeme='BEAT' start='1'/><gesture id='h' lexeme='STOP' start='9'/>\
             <constraint><before ref='g:start'><sync ref='h:start'/></before></constraint>",
            "bml::constraint",
        ),
        (
            "<gesture id='g' lexeme='BEAT' start='1'/><gesture id='h' lexeme='STOP' start='9'/>\
             <constraint><synchronize ref='g:start'><sync ref='h:start'/></synchronize>\
             </constraint>",
            "bml::two-times",
        ),
        ("<constraint><during/></constraint>", "bml::unknown-element"),
        (
            "<gesture lexeme='BEAT' start='1'/><gesture lexeme='STOP' start='1.5'/>",
            "bml::same-hand",
        ),
    ] {
        let warned = bml(body);
        assert!(codes(&warned).contains(&code), "{body}: {warned:?}");
        let severities = warned.diagnostics.iter().map(|d| d.severity);
        assert!(
            severities.clone().all(|s| s == Severity::Warning),
            "{body} is a warning: {:?}",
            warned.diagnostics
        );
        timeline(&warned.document);
        let required = bml(&format!("<required>{body}</required>"));
        let is_error =
            |d: &raconteur_eml::Diagnostic| d.code == code && d.severity == Severity::Error;
        assert!(
            required.diagnostics.iter().any(is_error),
            "{body} is an error if required: {:?}",
            required.diagnostics
        );
    }
}

#[test]
fn wrong_times_are_told_where_they_stand() {
    for (body, code, place) in [
        (
            "<gesture lexeme='BEAT' start='x:end'/>",
            "bml::time",
            "x:end",
        ),
        (
            "<gesture id='g' lexeme='BEAT' start='noon'/>",
            "bml::time",
            "noon",
        ),
        (
            "<gesture id='g' lexeme='BEAT' start='1e9'/>",
            "bml::time",
            "1e9",
        ),
        (
            "<speech id='s'><text>a</text></speech><wait duration='1' start='s:t'/>",
            "bml::time",
            "s:t",
        ),
        (
            "<gesture lexeme='BEAT' stroke='3' end='2'/>",
            "bml::order",
            "2",
        ),
        (
            "<speech id='s' end='3'><text>a</text></speech>",
            "bml::speech-time",
            "3",
        ),
        (
            "<faceLexeme lexeme='SMILE' amount='2'/>",
            "bml::number",
            "2",
        ),
        (
            "<gesture lexeme='BEAT' speed='2'/>",
            "bml::unknown-attribute",
            "2",
        ),
        (
            "<wait id='a' duration='1'/><wait id='a' duration='1'/>",
            "bml::same-id",
            "<wait id='a' duration='1'/>",
        ),
    ] {
        let imported = bml(body);
        assert_eq!(codes(&imported), [code], "{body}");
        let found = imported.diagnostics[0].span.slice(&imported.text);
        assert_eq!(found, place, "{body}");
        timeline(&imported.document);
    }
}

#[test]
fn malformed_files_are_reported_within_their_text() {
    let mut variants: Vec<String> = Vec::new();
    let characters: Vec<char> = EVERYTHING.chars().collect();
    for i in 1..=60 {
        let cut = characters.len() * i / 61;
        variants.push(characters[..cut].iter().collect());
    }
    for (i, wrong) in "<>&\"'=:+-é\u{0}9".chars().cycle().take(60).enumerate() {
        let mut changed = characters.clone();
        let at = 200 + (i * 7919) % (characters.len() - 200);
        changed[at] = wrong;
        variants.push(changed.iter().collect());
    }
    assert!(variants.len() >= 100, "enough variants");
    for variant in variants {
        let imported = read(&variant);
        let length = u32::try_from(imported.text.len()).expect("a short text");
        for problem in &imported.diagnostics {
            assert!(
                problem.span.start <= problem.span.end && problem.span.end <= length,
                "{problem:?} is outside of {variant}"
            );
        }
        let text = write(&imported.document);
        let parsed = parse(&text);
        let errors = parsed.diagnostics.iter();
        let errors: Vec<_> = errors
            .filter(|d| d.severity == Severity::Error && d.code != "eml::missing-element")
            .collect();
        assert!(errors.is_empty(), "{errors:?}\n{variant}\n{text}");
    }
}

#[test]
fn an_end_at_another_word_than_the_start_is_told() {
    let face = |open: &str, close: &str| {
        let body = format!(
            "<speech id='s'><text>a <sync id='m'/>b c</text></speech>{open}<faceLexeme id='f' \
             lexeme='SMILE' start='s:start' end='s:m'/>{close}"
        );
        let imported = bml(&body);
        let problem = imported
            .diagnostics
            .into_iter()
            .find(|d| d.code == "bml::end");
        problem.expect("the end is told").severity
    };
    assert_eq!(face("", ""), Severity::Warning);
    assert_eq!(face("<required>", "</required>"), Severity::Error);
    for times in [
        "start='s:start' end='s:m'",
        "stroke='s:m' end='s:end'",
        "strokeStart='s:m' strokeEnd='s:end'",
    ] {
        let body = format!(
            "<speech id='s'><text>a <sync id='m'/>b c</text></speech><gesture id='g' \
             lexeme='BEAT' {times}/>"
        );
        let told = bml(&body).diagnostics;
        assert!(told.iter().any(|d| d.code == "bml::end"), "{times}");
    }
    let known = "<speech id='s'><text>a <sync id='m'/>b c</text></speech><gesture id='g' \
                 lexeme='BEAT' start='s:m' end='s:m+3'/>";
    assert_eq!(codes(&bml(known)), [""; 0]);
}

#[test]
fn a_movement_that_begins_before_its_word_has_its_animation_player() {
    let body = "<speech id='s'><text>a <sync id='m'/>b</text></speech><head id='h' lexeme='NOD' \
                start='s:m-9'/><head id='k' lexeme='NOD' start='s:m'/>";
    let (document, timeline) = timeline(&bml(body).document);
    let (mut players, mut pushes) = (Vec::new(), Vec::new());
    for timed in &timeline.clauses {
        match &document.clause(timed.clause).kind {
            ClauseKind::PlayerAdd(add) => players.push((add.name.clone(), timed.start_secs)),
            ClauseKind::DeterministicPrimitive(push) => {
                pushes.push((push.player.clone(), timed.start_secs));
            }
            _ => {}
        }
    }
    assert_eq!((players.len(), pushes.len()), (2, 2));
    for (player, start_secs) in pushes {
        let is_there =
            |(name, secs): &(Option<String>, f64)| *name == player && *secs <= start_secs;
        assert!(players.iter().any(is_there), "{player:?} in {players:?}");
    }
}

#[test]
fn a_file_without_behaviours_says_so() {
    assert_eq!(codes(&bml("")), ["bml::empty"]);
}
