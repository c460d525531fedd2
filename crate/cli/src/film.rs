//! Films: frames piped into ffmpeg together with the story's sounds, or numbered pictures
//! where there is no ffmpeg.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};

use anyhow::{Context as _, Result, bail};
use raconteur_player::Player;

use crate::commands::render::write_png;

/// A sound and when it starts in the film; negative when the film begins within it.
pub(crate) struct Sound {
    file: PathBuf,
    start_secs: f64,
}

/// The sounds of a story that can be heard in a film that begins at `from_secs`.
pub(crate) fn sounds(player: &Player, voice: &Path, from_secs: f64) -> Vec<Sound> {
    player
        .utterances()
        .iter()
        .filter(|u| u.start_secs + u.duration_secs > from_secs)
        .filter_map(|u| {
            Some(Sound {
                // The bundle's reader has made sure that the name stays in the folder.
                file: voice.join(&u.audio.first()?.file),
                start_secs: u.start_secs - from_secs,
            })
        })
        .filter(|s| s.file.is_file())
        .collect()
}

/// Where frames go.
pub(crate) enum Sink {
    /// A running ffmpeg.
    Ffmpeg { child: Child, frames: ChildStdin },
    /// A folder of numbered pictures.
    Folder {
        folder: PathBuf,
        size: (u32, u32),
        next: u64,
    },
}

impl Sink {
    /// Opens the film. `length_secs` ends it even where a sound would go on.
    pub(crate) fn open(
        path: &Path,
        size: (u32, u32),
        fps: u32,
        length_secs: f64,
        sounds: &[Sound],
    ) -> Result<Self> {
        let mut command = Command::new("ffmpeg");
        command.args([
            "-y",
            "-loglevel",
            "error",
            "-f",
            "rawvideo",
            "-pix_fmt",
            "rgba",
        ]);
        command.args([
            "-s",
            &format!("{}x{}", size.0, size.1),
            "-r",
            &fps.to_string(),
            "-i",
            "-",
        ]);
        for sound in sounds {
            // A sound that has already begun is entered in its middle.
            let skip = (-sound.start_secs).max(0.0);
            command
                .args(["-ss", &format!("{skip:.6}"), "-i"])
                .arg(&sound.file);
        }
        if !sounds.is_empty() {
            command.args([
                "-filter_complex",
                &mix(sounds),
                "-map",
                "0:v",
                "-map",
                "[mix]",
            ]);
        }
        // Encoders of this format want even sides.
        command.args([
            "-vf",
            "crop=trunc(iw/2)*2:trunc(ih/2)*2",
            "-pix_fmt",
            "yuv420p",
        ]);
        command.args(["-t", &format!("{length_secs:.6}")]).arg(path);
        match command.stdin(Stdio::piped()).spawn() {
            Ok(mut child) => {
                let frames = child.stdin.take().context("ffmpeg takes no input")?;
                Ok(Self::Ffmpeg { child, frames })
            }
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                let folder = path.with_extension("");
                eprintln!(
                    "ffmpeg is not installed: writing numbered pictures without sound into {}",
                    folder.display()
                );
                fs::create_dir_all(&folder)
                    .with_context(|| format!("cannot make {}", folder.display()))?;
                Ok(Self::Folder {
                    folder,
                    size,
                    next: 0,
                })
            }
            Err(error) => Err(error).context("cannot start ffmpeg"),
        }
    }

    /// Adds a frame of RGBA bytes.
    pub(crate) fn push(&mut self, rgba: &[u8]) -> Result<()> {
        match self {
            Self::Ffmpeg { frames, .. } => frames.write_all(rgba).context("ffmpeg stopped early"),
            Self::Folder { folder, size, next } => {
                *next += 1;
                write_png(&folder.join(format!("{next:06}.png")), *size, rgba)
            }
        }
    }

    /// Ends the film.
    pub(crate) fn close(self) -> Result<()> {
        if let Self::Ffmpeg { mut child, frames } = self {
            drop(frames);
            let status = child.wait()?;
            if !status.success() {
                bail!("ffmpeg could not write the film ({status})");
            }
        }
        Ok(())
    }
}

/// ffmpeg's filter that delays each sound to its time and adds them up at full level.
fn mix(sounds: &[Sound]) -> String {
    let mut filter = String::new();
    for (i, sound) in sounds.iter().enumerate() {
        let delay_ms = (sound.start_secs.max(0.0) * 1000.0).round();
        filter += &format!("[{}:a]adelay={delay_ms}:all=1[s{i}];", i + 1);
    }
    for i in 0..sounds.len() {
        filter += &format!("[s{i}]");
    }
    filter
        + &format!(
            "amix=inputs={}:normalize=0:dropout_transition=0[mix]",
            sounds.len()
        )
}
