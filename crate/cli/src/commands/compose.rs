//! `raconteur compose`.

use std::io::Write as _;
use std::path::PathBuf;

use anyhow::{Context as _, Result};
use clap::Args;

use crate::compose::{self, Score};
use raconteur_voice::files::input;

use crate::{Outcome, terminal};
use raconteur_voice::bake::program::{FFMPEG, MissingPrograms, OPUSENC, Program};

/// Play a score on the built-in synthesiser.
#[derive(Args)]
pub(crate) struct Compose {
    /// A score, JSON; assets/music/README.md describes the format.
    score: PathBuf,
    /// Output file for the music: .wav, .opus or .mp3; may be given several times.
    #[arg(short, long, required = true)]
    output: Vec<PathBuf>,
}

impl Compose {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let programs: Vec<&Program> = self
            .output
            .iter()
            .filter_map(|path| match path.extension()?.to_str()? {
                "opus" => Some(&OPUSENC),
                "mp3" => Some(&FFMPEG),
                _ => None,
            })
            .collect();
        MissingPrograms::not_found(&programs).into_result()?;
        let text = input::text(&self.score, input::MAX_TEXT_BYTES).context("the score")?;
        let score = Score::read(&text).with_context(|| self.score.display().to_string())?;
        let music = compose::play(&score).with_context(|| self.score.display().to_string())?;
        let mut out = terminal::out();
        writeln!(
            out,
            "{}: {:.2} s, {:.1} LUFS, peak {:.1} dB",
            score.title,
            music.length_secs(),
            music.loudness_lufs(),
            music.peak_db()
        )?;
        for (name, start_secs) in score.sections() {
            writeln!(out, "{start_secs:8.3} s  {name}")?;
        }
        for path in &self.output {
            music.write(path)?;
        }
        Ok(Outcome::Fine)
    }
}
