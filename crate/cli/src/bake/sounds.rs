//! Recordings that a text asks for.

use std::path::{Component, Path, PathBuf};

use anyhow::{Context as _, Result, bail, ensure};
use raconteur_player::speech::assemble::Recording;
use raconteur_player::speech::signal::resample;

use super::program::FFMPEG;

/// The longest recording, seconds.
const LONGEST_SECS: f64 = 600.0;

/// Where a recording of a story lies.
///
/// # Errors
/// When the path leaves the story's folder, or is an address.
pub(crate) fn find(folder: &Path, src: &str) -> Result<PathBuf> {
    ensure!(
        !src.contains(':') && !src.contains('\\'),
        "the recording {src:?} is not beside the story; put it there and name its path"
    );
    let path = Path::new(src);
    if !path.components().all(|c| matches!(c, Component::Normal(_))) {
        bail!("the path {src:?} leaves the story's folder");
    }
    let path = folder.join(path);
    ensure!(path.is_file(), "there is no recording {}", path.display());
    Ok(path)
}

/// Decodes a recording to one channel of so many samples a second.
///
/// # Errors
/// When it cannot be decoded, or is too long.
pub(crate) fn read(path: &Path, rate_hz: f64) -> Result<Recording> {
    let scratch = tempfile::tempdir().context("making a folder for a recording")?;
    let wave = scratch.path().join("sound.wav");
    let mut command = FFMPEG.command();
    command
        .args(["-v", "error", "-nostdin", "-y", "-i"])
        .arg(path)
        .args([
            "-t",
            &LONGEST_SECS.to_string(),
            "-ac",
            "1",
            "-sample_fmt",
            "s16",
        ])
        .arg(&wave);
    FFMPEG.run(command)?;
    let (samples, own_hz) = super::engine::read_wave(&wave)?;
    Ok(Recording {
        samples: resample(&samples, own_hz, rate_hz),
    })
}
