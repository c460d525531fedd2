//! `raconteur timeline`.

use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use raconteur_eml::LineIndex;
use serde::Serialize;

use crate::report;
use crate::story::StoryFiles;
use crate::{Format, Outcome, terminal};

/// Print the resolved clauses of a story in time order.
#[derive(Args)]
pub(crate) struct Timeline {
    /// Script, or folder that contains a story.eml.
    file: PathBuf,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

#[derive(Serialize)]
struct Entry<'a> {
    element: &'static str,
    line: u32,
    /// Seconds.
    start: f64,
    /// Seconds.
    end: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    id: Option<&'a str>,
    /// Index of the enclosing seq or par in this list.
    #[serde(skip_serializing_if = "Option::is_none")]
    container: Option<u32>,
    /// Iteration of its container, from 0.
    #[serde(skip_serializing_if = "is_first")]
    iteration: u32,
    /// Delay of its stroke, seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    late: Option<f64>,
}

#[allow(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde passes a reference"
)]
fn is_first(iteration: &u32) -> bool {
    *iteration == 0
}

#[derive(Serialize)]
struct TimelineReport<'a> {
    duration: f64,
    lead_in: f64,
    /// Share of the lead-in needed by the hands, seconds.
    waits: f64,
    clauses: Vec<Entry<'a>>,
    marks: BTreeMap<&'a str, f64>,
}

impl Timeline {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let mut out = terminal::out();
        let files = StoryFiles::read(&self.file)?;
        let script = files.script();
        report::print(
            &files.script.display().to_string(),
            &files.text,
            &script.diagnostics,
        )?;
        let index = LineIndex::new(&files.text);
        let timeline = &script.timeline;
        let late = script.late_strokes();
        let whole = TimelineReport {
            duration: timeline.duration_secs,
            lead_in: timeline.lead_in_secs,
            waits: script.waits_secs,
            clauses: timeline
                .clauses
                .iter()
                .map(|c| (c, script.document.clause(c.clause)))
                .map(|(c, clause)| Entry {
                    element: clause.kind.name(),
                    line: index.position(clause.span.start).line,
                    start: c.start_secs,
                    end: c.end_secs,
                    id: clause.time_id.as_deref(),
                    container: c.container,
                    iteration: c.iteration,
                    late: late
                        .iter()
                        .find(|(id, _)| *id == c.clause)
                        .map(|(_, secs)| *secs),
                })
                .collect(),
            marks: timeline
                .marks
                .iter()
                .map(|(name, &at)| (name.as_str(), at))
                .collect(),
        };
        match self.format {
            Format::Json => writeln!(out, "{}", terminal::json_lines(&whole)?)?,
            Format::Text => {
                writeln!(
                    out,
                    "{:>9} {:>9}  {:<16} {:>5}  name",
                    "start", "end", "element", "line"
                )?;
                for c in &whole.clauses {
                    let id = c.id.unwrap_or("");
                    let late = c.late.map(|secs| format!("  {secs:.3} s late"));
                    let late = late.unwrap_or_default();
                    writeln!(
                        out,
                        "{:9.3} {:9.3}  {:<16} {:>5}  {id}{late}",
                        c.start, c.end, c.element, c.line
                    )?;
                }
                for (name, at) in &whole.marks {
                    writeln!(out, "{at:9.3} {:>9}  {:<16} {:>5}  {name}", "", "mark", "")?;
                }
                if whole.waits > 0.0 {
                    writeln!(out, "delayed by {:.3} s for the hands", whole.waits)?;
                }
                writeln!(out, "duration {:.3} s", whole.duration)?;
            }
        }
        Ok(report::outcome(&script.diagnostics))
    }
}
