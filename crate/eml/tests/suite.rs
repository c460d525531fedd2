//! Runs `tests/suite/eml`: one concept per file.
//!
//! The last lines of a case specify its diagnostics, in order: `<!-- error eml::code line:column
//! message -->`. They are removed before the case is read, so that a case need not be XML. A
//! `.timeline` file next to a case contains its timeline. `UPDATE=1` writes both again (a timeline
//! only where a file, possibly empty, exists); review the change before committing it.
//!
//! `<!-- limits: clauses=3 -->` in a case lowers limits, `<!-- phones: letters -->` gives every
//! word its letters as phones.

use raconteur_eml::schema::ELEMENTS;
use raconteur_eml::{
    ClauseId, Diagnostic, Document, Durations, EstimatedDurations, Limits, LineIndex, PhoneTime,
    Timeline, VoiceText, VoiceTiming, parse_bytes,
};
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

#[test]
fn every_case_gives_what_it_says() {
    let cases = cases();
    assert!(cases.len() >= 200, "only {} cases", cases.len());
    let update = std::env::var_os("UPDATE").is_some();
    let mut wrong = String::new();
    for case in cases {
        let bytes = fs::read(&case).expect("a case");
        let (source, expected) = split(&bytes);
        let (diagnostics, timeline) = run(source);
        if update {
            let mut out = source.to_vec();
            out.extend_from_slice(diagnostics.as_bytes());
            fs::write(&case, out).expect("the case is written");
        } else if diagnostics != expected {
            let name = case.file_name().unwrap_or_default().display();
            let _ = writeln!(wrong, "{name}\n expected\n{expected} found\n{diagnostics}");
        }
        let beside = case.with_extension("timeline");
        let Ok(expected) = fs::read_to_string(&beside) else {
            continue;
        };
        if update {
            fs::write(&beside, timeline).expect("the timeline is written");
        } else if timeline != expected {
            let name = beside.file_name().unwrap_or_default().display();
            let _ = writeln!(wrong, "{name}\n expected\n{expected} found\n{timeline}");
        }
    }
    assert!(wrong.is_empty(), "{wrong}(UPDATE=1 accepts what was found)");
}

/// The files of the suite.
fn cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/suite/eml");
    let mut cases: Vec<PathBuf> = fs::read_dir(&folder)
        .expect("the folder of the suite")
        .map(|entry| entry.expect("an entry of the suite").path())
        .filter(|path| path.extension().is_some_and(|e| e == "eml"))
        .collect();
    cases.sort();
    cases
}

/// A case and the annotations at its end.
fn split(bytes: &[u8]) -> (&[u8], String) {
    let mut end = bytes.len();
    let mut annotations = String::new();
    while end > 0 {
        let start = bytes[..end - 1]
            .iter()
            .rposition(|&b| b == b'\n')
            .map_or(0, |at| at + 1);
        let Ok(line) = std::str::from_utf8(&bytes[start..end]) else {
            break;
        };
        if !line.starts_with("<!-- error ") && !line.starts_with("<!-- warning ") {
            break;
        }
        annotations.insert_str(0, line);
        end = start;
    }
    (&bytes[..end], annotations)
}

/// The annotations and the timeline of a source.
fn run(source: &[u8]) -> (String, String) {
    let lossy = String::from_utf8_lossy(source);
    let parsed = parse_bytes(source, &limits(&lossy));
    let spelt = lossy.contains("<!-- phones: letters -->");
    let resolved = if spelt {
        Timeline::resolve(&parsed.document, &LetterDurations)
    } else {
        Timeline::resolve(&parsed.document, &EstimatedDurations)
    };
    let lines = LineIndex::new(&lossy);
    let mut annotations = String::new();
    for Diagnostic {
        code,
        severity,
        span,
        message,
        ..
    } in parsed.diagnostics.iter().chain(&resolved.diagnostics)
    {
        let at = lines.position(span.start);
        // XML forbids two hyphens in a comment.
        let message = message.replace("--", "- -");
        let _ = writeln!(
            annotations,
            "<!-- {} {code} {}:{} {message} -->",
            severity.name(),
            at.line,
            at.column,
        );
    }
    (
        annotations,
        timeline_text(&parsed.document, &resolved.timeline, &lines),
    )
}

/// Returns the limits requested by a case.
fn limits(source: &str) -> Limits {
    let mut limits = Limits::default();
    let Some((_, after)) = source.split_once("<!-- limits: ") else {
        return limits;
    };
    for word in after.split(" -->").next().unwrap_or("").split(' ') {
        let (name, number) = word.split_once('=').expect("a limit is name=number");
        let number = number.parse().expect("a limit is a number");
        match name {
            "bytes" => limits.bytes = number,
            "depth" => limits.depth = number,
            "clauses" => limits.clauses = number,
            "attributes" => limits.attributes = number,
            "clause_words" => limits.clause_words = number,
            "words" => limits.words = number,
            "diagnostics" => limits.diagnostics = number,
            _ => panic!("there is no limit {name}"),
        }
    }
    limits
}

/// Times as estimated, but known to the letter: each is a phone, all of one length.
struct LetterDurations;

impl Durations for LetterDurations {
    fn voice(&self, id: ClauseId, text: &VoiceText) -> VoiceTiming {
        let mut timing = EstimatedDurations.voice(id, text);
        timing.estimated = false;
        for (index, (word, time)) in text.words().iter().zip(&timing.words).enumerate() {
            let letters: Vec<char> = word.text.chars().filter(|c| c.is_alphabetic()).collect();
            let length = (time.end_secs - time.start_secs) / letters.len().max(1) as f64;
            for (place, letter) in letters.iter().enumerate() {
                let start_secs = time.start_secs + length * place as f64;
                timing.phones.push(PhoneTime {
                    symbol: letter.to_string(),
                    start_secs,
                    end_secs: start_secs + length,
                    word: index,
                });
            }
        }
        timing
    }
}

/// Contradictions and gaps in the source's appendix, with the case that shows their interpretation.
const INCONSISTENCIES: [(&str, &str); 30] = [
    ("back quotes and other quotes", "voice_back_quotes"),
    ("letter case", "letter_case"),
    ("truth values in mixed case", "boolean_spellings"),
    ("is0n for isOn in gestures", "gesture_is0n"),
    ("is0n for isOn in manipulators", "manipulator_is0n"),
    ("key for type in event", "event_key_is_an_alias"),
    ("repeated arguments", "move_arguments_of_the_source"),
    ("relative times", "groups_nest"),
    ("names in groups", "named_time_in_a_group_is_absolute"),
    ("times before 0", "time_lead_in"),
    ("names before their definition", "time_forward_reference"),
    ("tracks-configuration", "sets_tracks_configuration"),
    ("the undefined set lowerBody", "sets_undefined_reference"),
    (
        "the lost end of a track property",
        "track_property_as_printed",
    ),
    ("the attributes of bg and ly", "tracks_members"),
    ("bone with bone_", "bones_members"),
    ("multipleAnimation", "player_type_multiple_animation"),
    ("pose players", "player_type_pose"),
    ("the default name of a new player", "player_without_a_name"),
    ("operation for primitive", "primitive_operation_is_an_alias"),
    ("iterations without a number", "animation_styles"),
    ("nJoint for nJoints", "fk"),
    ("staticTime and staticVelocity", "joint_interpolation_both"),
    (
        "the lost arguments of a limb's function",
        "function_of_a_limb",
    ),
    ("delay or decay", "parameter_adsr"),
    (
        "the example of ADSR",
        "parameter_adsr_example_of_the_source",
    ),
    ("the value of an animation", "parameter_animate"),
    ("voice-say twice", "say_second_specification"),
    ("a phone of another word", "voice_phone_of_another_word"),
    ("discreteLevel for level", "voice_volume_discrete_level"),
];

#[test]
fn the_suite_covers_the_language() {
    let mut tags: BTreeSet<(String, String)> = BTreeSet::new();
    let mut texts = String::new();
    // The reported diagnostics of the cases, not the specified ones.
    let mut reported = String::new();
    let mut names = BTreeSet::new();
    for case in cases() {
        names.insert(
            case.file_stem()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned(),
        );
        let bytes = fs::read(&case).expect("a case");
        let (source, _) = split(&bytes);
        reported.push_str(&run(source).0);
        let text = String::from_utf8_lossy(&bytes).into_owned();
        collect_tags(&text, &mut tags);
        texts.push_str(&text);
    }
    let mut missing = Vec::new();
    for element in ELEMENTS {
        let has =
            |name: &str, attribute: &str| tags.contains(&(name.to_owned(), attribute.to_owned()));
        for name in element.aliases.iter().chain([&element.name]) {
            if !has(name, "") {
                missing.push(format!("<{name}>"));
            }
        }
        for attribute in element.all_attributes() {
            for name in attribute.aliases.iter().chain([&attribute.name]) {
                // The attributes of all clauses need no example for each element.
                let timed = ["time", "timeId"].contains(name);
                if !timed && !has(element.name, name) {
                    missing.push(format!("<{} {name}>", element.name));
                }
            }
            for (alias, _) in attribute.word_aliases {
                if !texts.contains(&format!("{}='{alias}'", attribute.name)) {
                    missing.push(format!("<{} {}='{alias}'>", element.name, attribute.name));
                }
            }
        }
    }
    for code in codes() {
        if !reported.contains(&format!(" {code} ")) {
            missing.push(code);
        }
    }
    for (what, case) in INCONSISTENCIES {
        if !names.contains(case) {
            missing.push(format!("{what}: {case}"));
        }
    }
    assert!(missing.is_empty(), "no case has {missing:#?}");
}

/// Collects the start tags of a text, each alone and with each of its attributes, by their names
/// without prefixes.
fn collect_tags(text: &str, tags: &mut BTreeSet<(String, String)>) {
    let local = |name: &str| name.rsplit(':').next().unwrap_or(name).to_owned();
    for part in text.split('<').skip(1) {
        let is_name = |c: char| c.is_ascii_alphanumeric() || "-_:".contains(c);
        let end = part.find(|c| !is_name(c)).unwrap_or(part.len());
        let name = local(&part[..end]);
        tags.insert((name.clone(), String::new()));
        for (at, _) in part.match_indices(['=']) {
            let before = part[..at].trim_end();
            let start = before.rfind(|c| !is_name(c)).map_or(0, |at| at + 1);
            if start > 0 {
                tags.insert((name.clone(), local(&before[start..])));
            }
        }
    }
}

/// The codes of diagnostics in the sources of this crate.
fn codes() -> BTreeSet<String> {
    let mut codes = BTreeSet::new();
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("src")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder of sources") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let text = fs::read_to_string(&path).expect("a source");
            // Tests make up codes.
            let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or("");
            let found = code.split("\"eml::").skip(1);
            codes.extend(found.filter_map(|c| Some(format!("eml::{}", c.split('"').next()?))));
        }
    }
    assert!(codes.len() > 50, "{codes:?}");
    codes
}

fn timeline_text(document: &Document, timeline: &Timeline, lines: &LineIndex<'_>) -> String {
    let mut out = format!(
        "duration {:.3} lead-in {:.3}\n",
        timeline.duration_secs, timeline.lead_in_secs
    );
    for timed in &timeline.clauses {
        let clause = document.clause(timed.clause);
        let line = lines.position(clause.span.start).line;
        let (start, end) = (timed.start_secs, timed.end_secs);
        let element = clause.kind.name();
        let _ = write!(out, "{start:.3} {end:.3} {element} line {line}");
        if let Some(id) = &clause.time_id {
            let _ = write!(out, " id {id}");
        }
        if let Some(container) = timed.container {
            let group = timeline.clauses[container as usize].clause;
            let element = document.clause(group).kind.name();
            let _ = write!(
                out,
                " in {element} [{container}] iteration {}",
                timed.iteration
            );
        }
        out.push('\n');
    }
    for (name, secs) in timeline.marks.iter() {
        let _ = writeln!(out, "mark {name} {secs:.3}");
    }
    out
}
