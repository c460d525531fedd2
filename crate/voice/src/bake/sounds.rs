//! Recordings requested by a text.

use std::path::{Path, PathBuf};

use crate::assemble::Recording;
use crate::signal::resample;
use anyhow::{Context as _, Result};

use super::program::FFMPEG;
use crate::files::inside;
use crate::files::media::Sound;

/// The longest recording, seconds.
const MAX_SECS: f64 = 600.0;

/// Returns the path of a recording of a story.
///
/// # Errors
/// Returns an error if the recording does not exist, its path leaves the story's folder, or it is
/// not an audio file.
pub(super) fn find(folder: &Path, src: &str) -> Result<PathBuf> {
    let told = || format!("the recording {src:?}");
    let path = inside::find(folder, src)
        .with_context(told)?
        .with_context(|| format!("there is no {}", folder.join(src).display()))
        .with_context(told)?;
    Sound::open(&path).with_context(told)?;
    Ok(path)
}

/// Decodes a recording to one channel at a sample rate.
///
/// # Errors
/// Returns the same errors as [`decode`].
pub(super) fn read(path: &Path, rate_hz: f64) -> Result<Recording> {
    let (samples, own_hz) = decode(path)?;
    Ok(Recording {
        samples: resample(&samples, own_hz, rate_hz),
    })
}

/// Decodes an audio file with ffmpeg to one channel; returns the samples and the sample rate, Hz.
///
/// # Errors
/// Returns an error if the file is not audio of a known format, or cannot be decoded.
pub(super) fn decode(path: &Path) -> Result<(Vec<f64>, f64)> {
    let sound = Sound::open(path)?;
    let scratch = tempfile::tempdir().context("making a folder for a recording")?;
    let wave = scratch.path().join("sound.wav");
    let mut command = FFMPEG.command();
    command.args(["-v", "error", "-nostdin", "-y"]);
    sound.input(&mut command);
    command
        .args(["-vn", "-sn", "-dn", "-t", &MAX_SECS.to_string()])
        .args(["-ac", "1", "-sample_fmt", "s16"])
        .arg(&wave);
    FFMPEG.run(command)?;
    super::engine::read_wave(&wave)
}
