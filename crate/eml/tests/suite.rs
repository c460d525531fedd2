//! Runs `tests/suite/eml`: one concept a file.
//!
//! The last lines of a case say what diagnostics it gives, in order:
//! `<!-- error eml::code line:column message -->`. They are cut off before the case
//! is read, so that a case may also be no XML at all. A `.timeline` file beside a
//! case holds its timeline. `UPDATE=1` writes both anew (a timeline only where a
//! file, perhaps an empty one, is there already); the change is to be read before it
//! is committed.

use raconteur_eml::{Diagnostic, EstimatedDurations, Limits, LineIndex, Timeline, parse_bytes};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

#[test]
fn every_case_gives_what_it_says() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/suite/eml");
    let mut cases: Vec<PathBuf> = fs::read_dir(&folder)
        .expect("the folder of the suite")
        .map(|entry| entry.expect("an entry of the suite").path())
        .filter(|path| path.extension().is_some_and(|e| e == "eml"))
        .collect();
    cases.sort();
    assert!(cases.len() >= 50, "only {} cases", cases.len());
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
    let parsed = parse_bytes(source, &Limits::default());
    let resolved = Timeline::resolve(&parsed.document, &EstimatedDurations);
    let lossy = String::from_utf8_lossy(source);
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
    (annotations, timeline_text(&resolved.timeline, &lines))
}

fn timeline_text(timeline: &Timeline, lines: &LineIndex<'_>) -> String {
    let mut out = format!(
        "duration {:.3} lead-in {:.3}\n",
        timeline.duration_secs, timeline.lead_in_secs
    );
    for clause in &timeline.clauses {
        let line = lines.position(clause.span.start).line;
        let (start, end) = (clause.start_secs, clause.end_secs);
        let _ = write!(out, "{start:.3} {end:.3} {} line {line}", clause.element);
        if let Some(id) = &clause.id {
            let _ = write!(out, " id {id}");
        }
        if let Some(container) = clause.container {
            let element = timeline.clauses[container].element;
            let _ = write!(
                out,
                " in {element} [{container}] iteration {}",
                clause.iteration
            );
        }
        out.push('\n');
    }
    for (name, secs) in timeline.marks.iter() {
        let _ = writeln!(out, "mark {name} {secs:.3}");
    }
    out
}
