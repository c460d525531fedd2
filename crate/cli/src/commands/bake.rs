//! `raconteur bake`.

use std::io::{self, Write as _};
use std::path::PathBuf;

use anyhow::{Context as _, Result};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};

use crate::Outcome;
use crate::bake::{self, BakeOptions};
use crate::report;
use crate::story::StoryFiles;

/// Make or refresh the speech bundles of stories.
#[derive(Args)]
pub(crate) struct Bake {
    /// Scripts, or folders that hold a story.eml.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Voice, as the engine calls it.
    #[arg(long, default_value = "cmu_us_slt_arctic_hts")]
    voice: String,
}

impl Bake {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let mut out = io::stdout().lock();
        let mut worst = Outcome::Fine;
        for path in &self.files {
            let files = StoryFiles::read(path)?;
            let script = files.script();
            // That the voice is missing or stale is what this command is for.
            let problems: Vec<_> = script
                .diagnostics
                .iter()
                .filter(|d| !d.code.starts_with("player::"))
                .cloned()
                .collect();
            report::print(&files.script.display().to_string(), &files.text, &problems)?;
            if report::outcome(&problems) == Outcome::Errors {
                worst = Outcome::Errors;
            }
            let contents = script.contents();
            let bar = ProgressBar::new(contents.len() as u64).with_style(
                ProgressStyle::with_template("{bar:30} {pos}/{len} {wide_msg}")?,
            );
            let options = BakeOptions {
                voice: self.voice.clone(),
                ..BakeOptions::default()
            };
            let report = bake::bake(&contents, &files.voice(), &options, &|done, _, text| {
                bar.set_position(done as u64);
                bar.set_message(text.to_owned());
            })
            .with_context(|| format!("baking {}", files.script.display()))?;
            bar.finish_and_clear();
            writeln!(
                out,
                "{}: {} utterances, {:.1} s of speech, {} spoken anew, {} old files removed; \
                 Ogg Opus {} bytes, MP3 {} bytes",
                files.script.display(),
                report.utterances,
                report.duration_secs,
                report.synthesised,
                report.removed,
                report.opus_bytes,
                report.mp3_bytes,
            )?;
        }
        Ok(worst)
    }
}
