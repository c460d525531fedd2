//! `raconteur express`.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result};
use clap::{Args, Subcommand, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use raconteur_player::{Options, Player, StoryInput};
use raconteur_render::RenderOptions;
use raconteur_render::headless::Headless;
use raconteur_stage::emotion::EMOTIONS;
use raconteur_stage::{Frame, StageSet};

use crate::commands::render::{parse_set, parse_size};
use crate::picture::{self, write_png};
use crate::sheet::ContactSheet;
use crate::soundtrack::Soundtrack;
use crate::story::find_figure;
use crate::{Outcome, film};

/// The emotions of the third study of GEVH (section 4.3).
const STUDY: [&str; 8] = [
    "anger",
    "disliking",
    "distress",
    "fear",
    "joy",
    "liking",
    "reproach",
    "neutral",
];
/// Start of the emotion in a clip, seconds.
const BEGIN_SECS: f64 = 1.0;
/// Capture time of the sheet's images, seconds: camera and light have settled.
const SETTLED_SECS: f64 = 5.0;

/// Show how camera, light and music express emotions.
#[derive(Args)]
pub(crate) struct Express {
    #[command(subcommand)]
    what: ExpressAction,
}

#[derive(Subcommand)]
enum ExpressAction {
    /// Make a film of each emotion: by default the eight clips of the third study of GEVH.
    Clips(Clips),
    /// Render all emotions in one pose by the face, by each channel alone, and by all together.
    Sheet(Sheet),
}

/// A channel of the environment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Channel {
    Camera,
    Light,
    Music,
}

const CHANNELS: [Channel; 3] = [Channel::Camera, Channel::Light, Channel::Music];

#[derive(Args)]
struct SheetRow {
    /// Potential of the emotions, 0 to 10.
    #[arg(long, default_value_t = 5.0)]
    potential: f64,
    /// A figure's name, or the path of a .glb file.
    #[arg(long, default_value = "sofia")]
    figure: String,
    /// Set: curtain, fireside, garden, night or school.
    #[arg(long, value_parser = parse_set)]
    set: Option<StageSet>,
}

#[derive(Args)]
struct Clips {
    /// The folder that the films go into.
    #[arg(short, long)]
    output: PathBuf,
    /// Emotions by name.
    #[arg(default_values = STUDY, value_parser = parse_emotion)]
    emotions: Vec<String>,
    #[command(flatten)]
    shown: SheetRow,
    /// Channel that stays neutral; may be given several times.
    #[arg(long, value_enum)]
    without: Vec<Channel>,
    /// Length of a film, seconds.
    #[arg(long, default_value_t = 10.0)]
    length: f64,
    /// Width and height in pixels.
    #[arg(long, default_value = "640x360", value_parser = parse_size)]
    size: (u32, u32),
    /// Frames a second.
    #[arg(long, default_value_t = 25, value_parser = clap::value_parser!(u32).range(1..=240))]
    fps: u32,
}

#[derive(Args)]
struct Sheet {
    /// Output image (PNG).
    #[arg(short, long)]
    output: PathBuf,
    #[command(flatten)]
    shown: SheetRow,
    /// Height of each tile, pixels.
    #[arg(long, default_value_t = 150)]
    height: u32,
}

fn parse_emotion(name: &str) -> Result<String, String> {
    if EMOTIONS.iter().any(|e| e.name == name) {
        return Ok(name.to_owned());
    }
    let names: Vec<&str> = EMOTIONS.iter().map(|e| e.name).collect();
    Err(format!("one of {}", names.join(", ")))
}

impl SheetRow {
    /// Returns a player of a script that elicits an emotion for a duration and expresses it by some
    /// channels.
    fn player(&self, emotion: &str, by: &[Channel], secs: f64) -> Result<Player> {
        let on = |channel: Channel| by.contains(&channel);
        let felt = if emotion == "neutral" {
            String::new()
        } else {
            format!(
                "<r:emotion time='{BEGIN_SECS}' type='{emotion}' potential='{}' duration='{secs}'/>",
                self.potential.clamp(0.0, 10.0)
            )
        };
        let eml = format!(
            "<eml xmlns:r='urn:raconteur:eml:1'><head><r:environment camera='{}' light='{}' \
             music='{}'/></head><body>{felt}<null time='{secs}'/></body></eml>",
            on(Channel::Camera),
            on(Channel::Light),
            on(Channel::Music),
        );
        let mut player = Player::load(StoryInput {
            eml: &eml,
            bundle: None,
            figure: find_figure(&self.figure)?.into(),
            options: Options::default(),
        })
        .player;
        player.override_set(self.set);
        Ok(player)
    }
}

fn progress(count: u64, of: &str) -> Result<ProgressBar> {
    let style =
        ProgressStyle::with_template(&format!("{{bar:30}} {{pos}}/{{len}} {of}, {{eta}} left"))?;
    Ok(ProgressBar::new(count).with_style(style))
}

impl Express {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let mut headless = Headless::new_blocking(RenderOptions::default()).context(
            "no graphics adapter (on Debian: apt install mesa-vulkan-drivers libvulkan1)",
        )?;
        match &self.what {
            ExpressAction::Clips(clips) => clips.run(&mut headless)?,
            ExpressAction::Sheet(sheet) => sheet.run(&mut headless)?,
        }
        Ok(Outcome::Fine)
    }
}

impl Clips {
    fn run(&self, headless: &mut Headless) -> Result<()> {
        fs::create_dir_all(&self.output)
            .with_context(|| format!("making {}", self.output.display()))?;
        let by: Vec<Channel> = CHANNELS
            .into_iter()
            .filter(|c| !self.without.contains(c))
            .collect();
        let (w, h) = self.size;
        let length = if self.length.is_finite() {
            self.length.clamp(1.0, 600.0)
        } else {
            10.0
        };
        let count = (length * f64::from(self.fps)).ceil() as u64;
        let bar = progress(count * self.emotions.len() as u64, "frames")?;
        for (i, emotion) in self.emotions.iter().enumerate() {
            let mut player = self.shown.player(emotion, &by, length)?;
            if i == 0 {
                picture::set_figure(headless, player.figure())?;
            }
            // The script has no folder; all its music is from the library.
            let soundtrack = Soundtrack::collect(&player, Path::new(""), 0.0, length);
            let path = self.output.join(format!("{emotion}.mp4"));
            let mut sink = film::Sink::open(&path, self.size, self.fps, length, &soundtrack)?;
            for n in 0..count {
                let frame =
                    player.frame(n as f64 / f64::from(self.fps), f64::from(w) / f64::from(h));
                sink.push(&headless.render_rgba(frame, w, h)?)?;
                bar.inc(1);
            }
            sink.close()?;
        }
        bar.finish_and_clear();
        Ok(())
    }
}

impl Sheet {
    fn run(&self, headless: &mut Headless) -> Result<()> {
        const ASPECT: f64 = 16.0 / 9.0;
        let height = self.height.clamp(16, 1024);
        let width = (f64::from(height) * ASPECT).round() as u32;
        let columns: [(&str, &[Channel]); 4] = [
            ("face", &[]),
            ("camera", &[Channel::Camera]),
            ("light", &[Channel::Light]),
            ("all", &CHANNELS),
        ];
        let aspects = vec![ASPECT; columns.len() * EMOTIONS.len()];
        // Three emotions a row.
        let across = 3 * columns.len() as u32;
        let mut board = ContactSheet::new(
            &aspects,
            height,
            None,
            (f64::from(across) * ASPECT).ceil() as u32,
        );
        let bar = progress(aspects.len() as u64, "pictures")?;
        // The pose is fixed: only the environment moves.
        let mut calm = self.shown.player("neutral", &[], 2.0 * SETTLED_SECS)?;
        picture::set_figure(headless, calm.figure())?;
        let pose = calm.frame(SETTLED_SECS, ASPECT).clone();
        for emotion in &EMOTIONS {
            for (name, by) in columns {
                let mut player = self.shown.player(emotion.name, by, 2.0 * SETTLED_SECS)?;
                let seen = player.frame(SETTLED_SECS, ASPECT).clone();
                let shown = if matches!(name, "face" | "all") {
                    seen
                } else {
                    Frame {
                        camera: seen.camera,
                        lighting: seen.lighting,
                        set: seen.set,
                        ..pose.clone()
                    }
                };
                let pixels = headless.render_rgba(&shown, width, height)?;
                board.place_tile(&pixels, &format!("{}: {name}", emotion.name))?;
                bar.inc(1);
            }
        }
        bar.finish_and_clear();
        let picture = board.picture();
        write_png(&self.output, picture.size(), picture.rgba())
    }
}
