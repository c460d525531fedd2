//! `raconteur figure sheet`.

use std::path::PathBuf;

use anyhow::{Context as _, Result, bail};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use raconteur_render::RenderOptions;
use raconteur_render::headless::Headless;

use crate::Outcome;
use crate::picture;
use crate::picture::write_png;
use crate::sheet::{self, SheetPart};
use crate::story::find_figure;

/// Draw a figure's contact sheet: face, eyes, body, hands, poses, mouth, lights, wireframe,
/// muscles, visemes, emotions.
#[derive(Args)]
pub(super) struct Sheet {
    /// A figure's name, or the path of a .glb file.
    figure: String,
    /// Output image (PNG).
    #[arg(short, long)]
    output: PathBuf,
    /// Part to render; may be given several times.
    #[arg(long, value_enum, default_value = "all", value_delimiter = ',')]
    part: Vec<SheetPart>,
    /// Height of a tile, pixels.
    #[arg(long, default_value_t = 400)]
    size: u32,
    /// Number of tiles per row, edge to edge and without captions, for programs.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=64))]
    grid: Option<u32>,
    /// The light of every tile but those that compare lights.
    #[arg(long, default_value = "studio")]
    light: String,
}

/// Largest and smallest height of a tile, pixels.
const SIZES: std::ops::RangeInclusive<u32> = 64..=1600;

impl Sheet {
    pub(super) fn run(&self) -> Result<Outcome> {
        if !SIZES.contains(&self.size) {
            bail!("--size takes {SIZES:?} pixels, not {}", self.size);
        }
        let light = sheet::light::named(&self.light).with_context(|| {
            format!(
                "there is no light named {}; there are {}",
                self.light,
                sheet::light::names().join(", ")
            )
        })?;
        let figure = find_figure(&self.figure)?;
        let tiles = sheet::tiles(&figure, &self.part, light);
        let mut headless = Headless::new_blocking(RenderOptions::default()).context(
            "no graphics adapter (on Debian: apt install mesa-vulkan-drivers libvulkan1)",
        )?;
        picture::set_figure(&mut headless, &figure)?;
        let bar = ProgressBar::new(tiles.len() as u64).with_style(ProgressStyle::with_template(
            "{bar:30} {pos}/{len} tiles, {eta} left",
        )?);
        let picture = sheet::draw(&figure, &tiles, self.size, self.grid, &mut headless, || {
            bar.inc(1);
        })?;
        bar.finish_and_clear();
        write_png(&self.output, picture.size(), picture.rgba())?;
        Ok(Outcome::Fine)
    }
}
