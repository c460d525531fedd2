//! `raconteur sweep`.

use std::io::{self, Write as _};
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use raconteur_player::sweep::{Check, RATE_HZ, sweep};
use serde::Serialize;

use crate::story::play_each;
use crate::{Format, Outcome, terminal};

/// Play stories without rendering and report visible faults.
#[derive(Args)]
pub(crate) struct Sweep {
    /// Scripts, or folders that contain a story.eml.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Performer: a name, or the path of a figure; by default the story's choice, otherwise sofia.
    #[arg(long)]
    figure: Option<String>,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

#[derive(Serialize)]
struct Entry {
    name: &'static str,
    worst: f64,
    limit: f64,
    unit: &'static str,
    ok: bool,
    at_secs: f64,
    /// Bone; omitted if nothing was found.
    #[serde(skip_serializing_if = "str::is_empty")]
    part: &'static str,
}

#[derive(Serialize)]
struct Story {
    file: String,
    duration: f64,
    checks: Vec<Entry>,
}

impl From<Check> for Entry {
    fn from(check: Check) -> Self {
        Self {
            name: check.name,
            worst: check.worst,
            limit: check.limit,
            unit: check.unit,
            ok: check.is_ok(),
            at_secs: check.at_secs,
            part: check.location,
        }
    }
}

impl Sweep {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let mut out = terminal::out();
        let mut stories = Vec::new();
        let worst = play_each(&self.files, self.figure.as_deref(), &mut |file, player| {
            let checks = sweep(player);
            let duration = player.end_secs();
            if self.format == Format::Text {
                writeln!(out, "{file}: {duration:.1} s at {RATE_HZ:.0} Hz")?;
                for check in &checks {
                    print(&mut out, check)?;
                }
            }
            let is_clean = checks.iter().all(Check::is_ok);
            stories.push(Story {
                file,
                duration,
                checks: checks.into_iter().map(Entry::from).collect(),
            });
            Ok(if is_clean {
                Outcome::Fine
            } else {
                Outcome::Errors
            })
        })?;
        if self.format == Format::Json {
            writeln!(out, "{}", terminal::reports_json(&stories)?)?;
        }
        Ok(worst)
    }
}

fn print(out: &mut impl io::Write, check: &Check) -> io::Result<()> {
    let (mark, name, unit) = (
        if check.is_ok() { "ok" } else { "!!" },
        check.name,
        check.unit,
    );
    // Small numbers are rounding; their size is all that matters.
    let show = |x: f64| {
        if x != 0.0 && x.abs() < 1e-3 {
            format!("{x:.0e}")
        } else {
            format!("{x:.3}")
        }
    };
    let (worst, limit) = (show(check.worst), show(check.limit));
    write!(
        out,
        "  {mark} {name:<26} {worst:>8} of {limit:>8} {unit:<5}"
    )?;
    if !check.location.is_empty() {
        write!(out, " at {:.3} s, {}", check.at_secs, check.location)?;
    }
    writeln!(out)
}
