//! Films: frames piped into ffmpeg with the story's audio, or numbered images without ffmpeg.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};

use anyhow::{Context as _, Result, bail};

use crate::picture::write_png;
use crate::soundtrack::Soundtrack;
use crate::terminal;
use raconteur_voice::files::disk::PendingFile;

/// Destination of the frames of a film: an ffmpeg process or a folder of numbered images.
pub(crate) enum Sink {
    /// Running ffmpeg process and its output.
    Ffmpeg {
        child: Child,
        frames: ChildStdin,
        film: PendingFile,
    },
    /// Folder of numbered images.
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
        soundtrack: &Soundtrack,
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
        for sound in soundtrack.sounds() {
            // A sound that has already begun is entered in its middle.
            let skip = (-sound.start_secs).max(0.0);
            command.args(["-ss", &format!("{skip:.6}")]);
            sound.file.input(&mut command);
        }
        if let Some(filter) = soundtrack.filter() {
            command.args(["-filter_complex", &filter, "-map", "0:v", "-map", "[mix]"]);
        }
        // Encoders of this format want even sides.
        command.args([
            "-vf",
            "crop=trunc(iw/2)*2:trunc(ih/2)*2",
            "-pix_fmt",
            "yuv420p",
        ]);
        // A path with a number pattern selects one file per frame.
        let film = if path.to_string_lossy().contains('%') {
            PendingFile::direct(path)
        } else {
            PendingFile::for_target(path)?
        };
        command
            .args(["-t", &format!("{length_secs:.6}")])
            .arg(film.path());
        match command.stdin(Stdio::piped()).spawn() {
            Ok(mut child) => {
                let frames = child.stdin.take().context("ffmpeg takes no input")?;
                Ok(Self::Ffmpeg {
                    child,
                    frames,
                    film,
                })
            }
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                let folder = path.with_extension("");
                terminal::report(format_args!(
                    "ffmpeg is not installed: writing numbered pictures without sound into {}",
                    folder.display()
                ));
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
        if let Self::Ffmpeg {
            mut child,
            frames,
            film,
        } = self
        {
            drop(frames);
            let status = child.wait()?;
            if !status.success() {
                bail!("ffmpeg could not write the film ({status})");
            }
            film.commit()?;
        }
        Ok(())
    }
}
