//! `raconteur transcription`.

mod plots;

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result};
use clap::{Args, Subcommand};
use raconteur_annotate::gestura::{Statistics, Tally};
use raconteur_annotate::{Read, anvil, read_transcription};
use raconteur_voice::files::{disk, input};
use serde_json::{Value, json};

use crate::commands::import::{MAX_BYTES, mapping};
use crate::{Format, Outcome, report, terminal};

/// Number of hand shapes in the table.
const SHAPES_SHOWN: usize = 12;

/// Check transcriptions of gestures and count them.
#[derive(Args)]
pub(crate) struct Transcription {
    #[command(subcommand)]
    what: Action,
}

#[derive(Subcommand)]
enum Action {
    /// Report what contradicts the rules of GestuRA.
    Check(Files),
    /// Print the statistics of a transcription.
    Statistics {
        #[command(flatten)]
        files: Files,
        /// Picture to draw, SVG.
        #[arg(long, value_name = "FILE")]
        plots: Option<PathBuf>,
    },
    /// Write the specification of GestuRA for ANVIL.
    Specification {
        /// The file to write.
        #[arg(default_value = "gestura-spec.xml")]
        output: PathBuf,
    },
}

#[derive(Args)]
struct Files {
    /// Annotation file of ANVIL or ELAN.
    file: PathBuf,
    /// File that maps the tiers of ELAN to the tracks of GestuRA. Without this, they are guessed.
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

impl Transcription {
    pub(crate) fn run(&self) -> Result<Outcome> {
        match &self.what {
            Action::Check(files) => files.check(),
            Action::Statistics { files, plots } => files.statistics(plots.as_deref()),
            Action::Specification { output } => {
                disk::replace(output, anvil::GESTURA.as_bytes())?;
                Ok(Outcome::Fine)
            }
        }
    }
}

impl Files {
    fn read(&self) -> Result<Read> {
        let bytes = input::bytes(&self.file, MAX_BYTES).context("the annotation")?;
        let (mapping, _) = mapping(self.map.as_deref())?;
        Ok(read_transcription(&bytes, mapping.as_ref()))
    }

    fn name(&self) -> String {
        self.file.display().to_string()
    }

    fn check(&self) -> Result<Outcome> {
        let read = self.read()?;
        match self.format {
            Format::Text => report::print(&self.name(), &read.text, &read.diagnostics)?,
            Format::Json => {
                let name = self.name();
                let entries = report::entries(&name, &read.text, &read.diagnostics);
                writeln!(terminal::out(), "{}", terminal::json_lines(&entries)?)?;
            }
        }
        Ok(report::outcome(&read.diagnostics))
    }

    fn statistics(&self, picture: Option<&Path>) -> Result<Outcome> {
        let read = self.read()?;
        report::print(&self.name(), &read.text, &read.diagnostics)?;
        let statistics = Statistics::new(&read.transcription);
        let mut out = terminal::out();
        match self.format {
            Format::Text => write!(out, "{}", table(&statistics))?,
            Format::Json => writeln!(out, "{}", terminal::json(&values(&statistics))?)?,
        }
        if let Some(path) = picture {
            disk::replace(path, plots::plots(&statistics)?.as_bytes())?;
        }
        Ok(report::outcome(&read.diagnostics))
    }
}

/// Returns the statistics as a table for people.
fn table(statistics: &Statistics) -> String {
    let mut out = String::new();
    let mut row = |name: &str, value: String| {
        // Writing to a string does not fail.
        let _ = writeln!(out, "{name:<24} {value}");
    };
    row("length", format!("{:.1} s", statistics.length_secs));
    row("words", statistics.words.to_string());
    row("utterances", statistics.utterances.to_string());
    row("gestures", statistics.gestures.to_string());
    let rate = statistics.gestures_per_minute();
    row("gestures per minute", format!("{rate:.1}"));
    for (name, tallies) in groups(statistics) {
        row(name, shares(tallies));
    }
    row("mirrored", statistics.symmetric.to_string());
    let confidence = statistics.confidence.iter().enumerate();
    let confidence: Vec<String> = confidence
        .map(|(level, count)| format!("{} {count}", level + 1))
        .collect();
    row("confidence", confidence.join(", "));
    let scores = statistics.beat_scores.iter().enumerate();
    let scores: Vec<String> = scores
        .map(|(score, count)| format!("{score}: {count}"))
        .collect();
    row("beat filter", scores.join(", "));
    if let Some(lead) = statistics.stroke_lead_secs {
        row("stroke before its word", format!("{:.0} ms", 1000.0 * lead));
    }
    let shapes = statistics.shapes.iter().take(SHAPES_SHOWN);
    let shapes: Vec<String> = shapes.map(|(id, count)| format!("{id}: {count}")).collect();
    row("hand shapes", shapes.join(", "));
    for phase in &statistics.phases {
        let value = format!(
            "{} of {:.2} s (deviation {:.2}, {:.2} to {:.2})",
            phase.count, phase.mean_secs, phase.deviation_secs, phase.least_secs, phase.most_secs
        );
        row(phase.name, value);
    }
    out
}

fn groups(statistics: &Statistics) -> [(&'static str, &[Tally]); 4] {
    [
        ("discourse levels", &statistics.levels),
        ("classes", &statistics.classes),
        ("dimensions", &statistics.dimensions),
        ("hands", &statistics.hands),
    ]
}

/// Returns counts with their shares.
fn shares(tallies: &[Tally]) -> String {
    let whole: usize = tallies.iter().map(|tally| tally.count).sum();
    let share = |tally: &Tally| {
        let percent = 100.0 * tally.count as f64 / whole.max(1) as f64;
        format!("{} {} ({percent:.0} %)", tally.name, tally.count)
    };
    tallies.iter().map(share).collect::<Vec<_>>().join(", ")
}

/// Returns the statistics as JSON.
fn values(statistics: &Statistics) -> Value {
    let tallies = |tallies: &[Tally]| -> Value {
        tallies
            .iter()
            .map(|tally| (tally.name.to_owned(), json!(tally.count)))
            .collect()
    };
    let phases: Value = statistics
        .phases
        .iter()
        .map(|phase| {
            let value = json!({
                "count": phase.count,
                "mean": phase.mean_secs,
                "deviation": phase.deviation_secs,
                "least": phase.least_secs,
                "most": phase.most_secs,
            });
            (phase.name.to_owned(), value)
        })
        .collect();
    let shapes: Value = statistics
        .shapes
        .iter()
        .map(|(id, count)| (id.to_string(), json!(count)))
        .collect();
    json!({
        "length": statistics.length_secs,
        "words": statistics.words,
        "utterances": statistics.utterances,
        "gestures": statistics.gestures,
        "gesturesPerMinute": statistics.gestures_per_minute(),
        "discourseLevels": tallies(&statistics.levels),
        "classes": tallies(&statistics.classes),
        "dimensions": tallies(&statistics.dimensions),
        "hands": tallies(&statistics.hands),
        "mirrored": statistics.symmetric,
        "confidence": statistics.confidence,
        "beatFilter": statistics.beat_scores,
        "strokeLead": statistics.stroke_lead_secs,
        "perHalfMinute": statistics.per_half_minute,
        "handShapes": shapes,
        "phases": phases,
    })
}
