//! `raconteur voice`: measurements of a voice, as figures and as an image.

use std::io::Write as _;
use std::path::PathBuf;

use anyhow::{Result, anyhow};
use clap::{Args, Subcommand};
use raconteur_voice::Source;
use raconteur_voice::markup::{sable, ssml};
use serde_json::json;

use super::bake::list;
use crate::story::StoryFiles;
use crate::{Format, Outcome, terminal};
use raconteur_voice::bake::engine::{ENGINES, EngineOptions};
use raconteur_voice::bake::measure::{self, Row, Settings};
use raconteur_voice::bake::{Cast, picture};

/// Measure and inspect voices.
#[derive(Args)]
pub(crate) struct Voice {
    #[command(subcommand)]
    what: VoiceAction,
}

#[derive(Subcommand)]
enum VoiceAction {
    /// List the voices of an engine, or of all that are installed.
    List(List),
    /// Measure the effect of markup and emotions on a voice; fail if a setting misses its target.
    Measure(Measure),
    /// Draw a sentence: its spectrum with words, phones and pitch over it.
    Picture(Picture),
    /// Print the spoken text of a story as SSML 1.1 documents, one after the other.
    Ssml(Ssml),
}

#[derive(Args)]
struct List {
    /// The speech engine; without it, all.
    #[arg(long, value_parser = ENGINES)]
    engine: Option<String>,
    /// Address of a MaryTTS server.
    #[arg(long, default_value = "localhost:59125")]
    server: String,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

impl List {
    fn run(&self) -> Result<Outcome> {
        let options = EngineOptions {
            server: self.server.clone(),
            recordings: None,
        };
        list(self.engine.as_deref(), &options, self.format)
    }
}

#[derive(Args)]
struct Ssml {
    /// Script, or folder that contains a story.eml.
    story: PathBuf,
    /// Default language, a BCP 47 tag.
    #[arg(long, default_value = "en-US")]
    language: String,
}

impl Ssml {
    /// Prints the documents; contents of other files are not included.
    fn run(&self) -> Result<Outcome> {
        let files = StoryFiles::read(&self.story)?;
        let mut out = terminal::out();
        for said in raconteur_voice::speech_requests(&files.script().document) {
            let content = match said.source {
                Source::Content(content) => content,
                Source::Sable(text) => sable::read(&text).map_err(|p| anyhow!("{p}"))?.0,
                Source::File { .. } => continue,
            };
            writeln!(out, "{}", ssml::write(&content, &self.language))?;
        }
        Ok(Outcome::Fine)
    }
}

/// Choice of a voice.
#[derive(Args)]
struct VoiceChoice {
    /// The speech engine; without it, kokoro or the first that is installed.
    #[arg(long, value_parser = ENGINES)]
    engine: Option<String>,
    /// The voice, as its engine calls it; without it, the engine's first in
    /// English.
    #[arg(long)]
    voice: Option<String>,
    /// Address of a MaryTTS server.
    #[arg(long, default_value = "localhost:59125")]
    server: String,
}

impl VoiceChoice {
    fn cast(&self) -> Result<Cast> {
        let cast = Cast::new(
            self.engine.as_deref(),
            self.voice.as_deref(),
            EngineOptions {
                server: self.server.clone(),
                recordings: None,
            },
        )?;
        cast.missing().into_result()?;
        Ok(cast)
    }
}

#[derive(Args)]
struct Measure {
    #[command(flatten)]
    who: VoiceChoice,
    /// Measure one setting of each kind instead of all.
    #[arg(long)]
    sample: bool,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

#[derive(Args)]
struct Picture {
    #[command(flatten)]
    who: VoiceChoice,
    /// Spoken text; SABLE markup is supported.
    text: String,
    /// The SVG file.
    #[arg(short, long)]
    out: PathBuf,
}

impl Voice {
    pub(crate) fn run(&self) -> Result<Outcome> {
        match &self.what {
            VoiceAction::List(list) => list.run(),
            VoiceAction::Measure(measure) => measure.run(),
            VoiceAction::Picture(picture) => picture.run(),
            VoiceAction::Ssml(ssml) => ssml.run(),
        }
    }
}

impl Measure {
    fn run(&self) -> Result<Outcome> {
        let settings = if self.sample {
            Settings::OneOfAKind
        } else {
            Settings::All
        };
        let rows = measure::measure(&self.who.cast()?, settings)?;
        let mut out = terminal::out();
        if self.format == Format::Json {
            let rows: Vec<_> = rows.iter().map(row).collect();
            writeln!(out, "{}", terminal::json(&rows)?)?;
        } else {
            for row in &rows {
                writeln!(
                    out,
                    "{:24} {:24} requested {:6.3} measured {:6.3}, off by {:4.1} % ({:3.0} % of the change){}",
                    row.setting,
                    row.property,
                    row.requested,
                    row.measured,
                    row.error() * 100.0,
                    row.missing() * 100.0,
                    if row.is_met() {
                        ""
                    } else {
                        "  NOT AS REQUESTED"
                    }
                )?;
            }
        }
        Ok(if rows.iter().all(Row::is_met) {
            Outcome::Fine
        } else {
            Outcome::Errors
        })
    }
}

fn row(row: &Row) -> serde_json::Value {
    json!({
        "setting": row.setting,
        "property": row.property,
        "asked": row.requested,
        "heard": row.measured,
        "error": row.error(),
        "missing": row.missing(),
        "ok": row.is_met(),
    })
}

impl Picture {
    fn run(&self) -> Result<Outcome> {
        picture::draw(&self.who.cast()?, &self.text, &self.out)?;
        Ok(Outcome::Fine)
    }
}
