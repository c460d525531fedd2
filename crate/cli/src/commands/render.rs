//! `raconteur render`.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};
use clap::{ArgGroup, Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use raconteur_player::Player;
use raconteur_render::headless::Headless;
use raconteur_render::{Quality, RenderOptions};
use raconteur_stage::{Set, Shot, StageSet};

use crate::Outcome;
use crate::film;
use crate::picture;
use crate::picture::write_png;
use crate::report;
use crate::soundtrack::Soundtrack;
use crate::story::StoryFiles;

/// Shot size on the speaker.
#[derive(Clone, Copy, ValueEnum)]
enum ShotName {
    Storyteller,
    Full,
    Medium,
    Close,
    ExtremeClose,
    Long,
}

/// Render an image or film of a story.
#[derive(Args)]
#[command(group(ArgGroup::new("what").required(true).args(["output", "video"])))]
pub(crate) struct Render {
    /// Script, or folder that contains a story.eml.
    file: PathBuf,
    /// Time of the image, seconds.
    #[arg(long, default_value_t = 0.0)]
    at: f64,
    /// Output image (PNG).
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Output film with audio; ffmpeg chooses the format by the name. Without ffmpeg, numbered
    /// images are written to a folder of that name.
    #[arg(long)]
    video: Option<PathBuf>,
    /// Frames a second of the film.
    #[arg(long, default_value_t = 25)]
    fps: u32,
    /// Length of the film, seconds; by default the rest of the story from --at.
    #[arg(long)]
    length: Option<f64>,
    /// Width and height in pixels.
    #[arg(long, default_value = "1280x720", value_parser = parse_size)]
    size: (u32, u32),
    /// Initial shot size, until the story or an emotion changes it.
    #[arg(long, value_enum, default_value = "storyteller")]
    shot: ShotName,
    /// Rendering quality: lowest, low, medium or high.
    #[arg(long, default_value = "high", value_parser = parse_quality)]
    quality: Quality,
    /// A figure's name, or the path of a .glb file; without it, the story's choice, else sofia.
    #[arg(long)]
    figure: Option<String>,
    /// Set behind the speaker, in its usual light: curtain, fireside, garden, night or school; by
    /// default the story's.
    #[arg(long, value_parser = parse_set)]
    set: Option<StageSet>,
}

pub(crate) fn parse_set(name: &str) -> Result<StageSet, String> {
    let found = Set::NAMES.iter().find(|(known, _)| *known == name);
    found.map(|(_, kind)| *kind).ok_or_else(|| {
        let names = Set::NAMES.map(|(known, _)| known);
        format!("one of {}", names.join(", "))
    })
}

fn parse_quality(name: &str) -> Result<Quality, String> {
    let names = Quality::NAMES.map(|(_, name)| name);
    let known = Quality::NAMES.iter().find(|(_, known)| *known == name);
    known.map_or_else(
        || Err(format!("one of {}", names.join(", "))),
        |(quality, _)| Ok(*quality),
    )
}

/// Maximum side of an image, pixels; supported by every adapter.
const MAX_SIDE_PX: u32 = 8192;

pub(crate) fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let (w, h) = text
        .split_once('x')
        .ok_or("write WIDTHxHEIGHT, for example 1280x720")?;
    let side = |s: &str| match s.parse::<u32>() {
        Ok(n) if (1..=MAX_SIDE_PX).contains(&n) => Ok(n),
        _ => Err(format!(
            "{s} is not a number of pixels from 1 to {MAX_SIDE_PX}"
        )),
    };
    Ok((side(w)?, side(h)?))
}

impl Render {
    pub(crate) fn run(&self) -> Result<Outcome> {
        if !(self.at.is_finite() && self.at >= 0.0) {
            bail!("--at takes a time of 0 s or later, not {}", self.at);
        }
        if self.fps == 0 || self.fps > 240 {
            bail!("--fps takes 1 to 240, not {}", self.fps);
        }
        let files = StoryFiles::read(&self.file)?;
        let shot = match self.shot {
            ShotName::Storyteller => Shot::Storyteller,
            ShotName::Full => Shot::Full,
            ShotName::Medium => Shot::Medium,
            ShotName::Close => Shot::Close,
            ShotName::ExtremeClose => Shot::ExtremeClose,
            ShotName::Long => Shot::Long,
        };
        let mut loaded = files.player(self.figure.as_deref(), shot)?;
        report::print(
            &files.script.display().to_string(),
            &files.text,
            &loaded.diagnostics,
        )?;
        loaded.player.override_set(self.set);
        let mut headless = Headless::new_blocking(RenderOptions {
            quality: self.quality,
        })
        .context("no graphics adapter (on Debian: apt install mesa-vulkan-drivers libvulkan1)")?;
        picture::set_figure(&mut headless, loaded.player.figure())?;
        if let Some(path) = &self.output {
            let pixels = self.draw(&mut loaded.player, &mut headless, self.at)?;
            write_png(path, self.size, &pixels)?;
        }
        if let Some(path) = &self.video {
            self.film(path, &files, &mut loaded.player, &mut headless)?;
        }
        Ok(report::outcome(&loaded.diagnostics))
    }

    fn draw(&self, player: &mut Player, headless: &mut Headless, time: f64) -> Result<Vec<u8>> {
        let (w, h) = self.size;
        let frame = player.frame(time, f64::from(w) / f64::from(h));
        Ok(headless.render_rgba(frame, w, h)?)
    }

    fn film(
        &self,
        path: &Path,
        files: &StoryFiles,
        player: &mut Player,
        headless: &mut Headless,
    ) -> Result<()> {
        let rest = (player.duration_secs() - self.at).max(0.0);
        let length = self
            .length
            .filter(|l| l.is_finite() && *l > 0.0)
            .unwrap_or(rest)
            .min(rest);
        let count = (length * f64::from(self.fps)).ceil().max(1.0) as u64;
        let bar = ProgressBar::new(count).with_style(ProgressStyle::with_template(
            "{bar:30} {pos}/{len} frames, {eta} left",
        )?);
        let soundtrack = Soundtrack::collect(player, &files.script, self.at, length);
        let mut sink = film::Sink::open(path, self.size, self.fps, length, &soundtrack)?;
        for n in 0..count {
            let time = self.at + n as f64 / f64::from(self.fps);
            sink.push(&self.draw(player, headless, time)?)?;
            bar.inc(1);
        }
        bar.finish_and_clear();
        sink.close()
    }
}
