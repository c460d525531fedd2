//! Diagnostics for people and programs.

use std::io::Write as _;

use anyhow::Result;
use codespan_reporting::diagnostic::{Diagnostic as Shown, Label, LabelStyle, Severity as Level};
use codespan_reporting::term::{self, Config};
use raconteur_eml::{Diagnostic, LineIndex, Severity};
use serde::Serialize;

use crate::excerpt::Excerpt;
use crate::{Outcome, terminal};

/// Position in a source file. Lines and columns count from 1, columns in characters.
#[derive(Serialize)]
pub(crate) struct Location {
    line: u32,
    column: u32,
    offset: u32,
}

/// Diagnostic in the JSON output of commands.
#[derive(Serialize)]
pub(crate) struct Entry<'a> {
    file: &'a str,
    code: &'a str,
    severity: &'static str,
    message: &'a str,
    start: Location,
    end: Location,
    hints: &'a [String],
}

fn severity_name(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    }
}

/// Converts the diagnostics of one file to entries of the JSON output.
pub(crate) fn entries<'a>(
    file: &'a str,
    source: &'a str,
    diagnostics: &'a [Diagnostic],
) -> Vec<Entry<'a>> {
    let index = LineIndex::new(source);
    let place = |offset: u32| {
        let at = index.position(offset);
        Location {
            line: at.line,
            column: at.column,
            offset,
        }
    };
    diagnostics
        .iter()
        .map(|d| Entry {
            file,
            code: d.code,
            severity: severity_name(d.severity),
            message: &d.message,
            start: place(d.span.start),
            end: place(d.span.end),
            hints: &d.hints,
        })
        .collect()
}

/// Returns the outcome: a failure if any diagnostic is an error.
pub(crate) fn outcome(diagnostics: &[Diagnostic]) -> Outcome {
    if diagnostics.iter().any(|d| d.severity == Severity::Error) {
        Outcome::Errors
    } else {
        Outcome::Fine
    }
}

/// Writes diagnostics to standard error: `file:line:column: severity[code]: message`, the
/// excerpt with carets, and hints.
pub(crate) fn print(file: &str, source: &str, diagnostics: &[Diagnostic]) -> Result<()> {
    let index = LineIndex::new(source);
    let config = Config::default();
    let mut stderr = terminal::err();
    for diagnostic in diagnostics {
        let spans = diagnostic.related.iter().map(|(span, _)| *span);
        let excerpt = Excerpt::from_source(file, &index, diagnostic.span, spans);
        let mut labels = vec![Label::new(
            LabelStyle::Primary,
            (),
            excerpt.range(diagnostic.span),
        )];
        for (span, message) in &diagnostic.related {
            let range = excerpt.range(*span);
            labels.push(Label::new(LabelStyle::Secondary, (), range).with_message(message));
        }
        let level = match diagnostic.severity {
            Severity::Error => Level::Error,
            Severity::Warning => Level::Warning,
        };
        let shown = Shown::new(level)
            .with_code(diagnostic.code)
            .with_message(&diagnostic.message)
            .with_labels(labels)
            .with_notes(
                diagnostic
                    .hints
                    .iter()
                    .map(|h| format!("hint: {h}"))
                    .collect(),
            );
        let text = term::emit_into_string(&config, &excerpt, &shown)?;
        let at = index.position(diagnostic.span.start);
        write!(stderr, "{file}:{}:{}: {text}", at.line, at.column)?;
    }
    Ok(())
}
