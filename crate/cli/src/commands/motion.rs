//! `raconteur motion`.

use std::io::{self, Write as _};
use std::ops::RangeInclusive;
use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::Args;
use raconteur_player::motion::{Measure, MotionReport, RATE_HZ, measure_between};
use serde::Serialize;

use crate::story::play_each;
use crate::{Format, Outcome, terminal};

/// Play stories without rendering and compare the motion of the body with people's.
#[derive(Args)]
pub(crate) struct Motion {
    /// Scripts, or folders that contain a story.eml.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Performer: a name, or the path of a figure; by default the story's choice, otherwise sofia.
    #[arg(long)]
    figure: Option<String>,
    /// Start of the measured interval, seconds.
    #[arg(long, default_value_t = 0.0)]
    from: f64,
    /// End of the measured interval, seconds; by default the end of the story.
    #[arg(long)]
    to: Option<f64>,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

#[derive(Serialize)]
struct Entry {
    name: String,
    unit: &'static str,
    /// Null if the story has nothing to measure.
    value: Option<f64>,
    /// Null if unknown.
    lively: Option<f64>,
    /// Null if unknown, or if the quantity does not scale.
    calm: Option<f64>,
}

#[derive(Serialize)]
struct Story {
    file: String,
    figure: String,
    duration: f64,
    from: f64,
    to: f64,
    measures: Vec<Entry>,
}

impl From<Measure> for Entry {
    fn from(measure: Measure) -> Self {
        Self {
            name: measure.name,
            unit: measure.unit,
            value: measure.value,
            lively: measure.lively,
            calm: measure.calm,
        }
    }
}

impl Motion {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let mut out = terminal::out();
        let mut stories = Vec::new();
        let worst = play_each(&self.files, self.figure.as_deref(), &mut |file, player| {
            let duration = player.end_secs();
            let report = measure_between(player, self.interval(duration)?);
            let figure = player.figure().name.clone();
            if self.format == Format::Text {
                let (from, to) = (report.from_secs, report.to_secs);
                writeln!(
                    out,
                    "{file}: {from:.1} to {to:.1} s at {RATE_HZ:.0} Hz, {figure}"
                )?;
                print(&mut out, &report)?;
            }
            stories.push(Story {
                file,
                figure,
                duration,
                from: report.from_secs,
                to: report.to_secs,
                measures: report.measures.into_iter().map(Entry::from).collect(),
            });
            Ok(Outcome::Fine)
        })?;
        if self.format == Format::Json {
            writeln!(out, "{}", terminal::reports_json(&stories)?)?;
        }
        Ok(worst)
    }

    /// Returns the measured interval of a story of this duration, seconds.
    fn interval(&self, duration: f64) -> Result<RangeInclusive<f64>> {
        if !(0.0..=duration).contains(&self.from) {
            let from = self.from;
            bail!("--from takes a time within the story, 0 to {duration:.1} s, not {from}");
        }
        let to = self.to.unwrap_or(duration);
        if self.to.is_some() && (to.is_nan() || to <= self.from) {
            bail!("--to takes a time after --from, not {to}");
        }
        Ok(self.from..=to.min(duration))
    }
}

/// Prints a table: measure, this story, a lively performer, and calm conversation.
fn print(out: &mut impl io::Write, report: &MotionReport) -> io::Result<()> {
    writeln!(
        out,
        "  {:<32} {:>10} {:>8} {:>8}",
        "measure", "this story", "lively", "calm"
    )?;
    for measure in &report.measures {
        let [value, lively, calm] = [measure.value, measure.lively, measure.calm].map(shown);
        let line = format!(
            "  {:<32} {value:>10} {lively:>8} {calm:>8} {}",
            measure.name, measure.unit
        );
        writeln!(out, "{}", line.trim_end())?;
    }
    Ok(())
}

/// Returns a value with about three digits; a hyphen if there is none.
fn shown(value: Option<f64>) -> String {
    let Some(x) = value else {
        return "-".to_owned();
    };
    let digits = if x.abs() < 10.0 { 2 } else { 1 };
    format!("{x:.digits$}")
}
