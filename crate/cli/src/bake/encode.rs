//! Encodes an utterance: Ogg Opus for the browsers that take it, MP3 for the others.

use std::fs;
use std::path::Path;

use anyhow::{Context as _, Result};

use super::program::{FFMPEG, OPUSENC};

/// File endings of what [`encode`] writes.
pub(crate) const ENDINGS: [&str; 2] = ["opus", "mp3"];

/// Writes the sound to `folder` and returns file names with MIME types, preferred first.
///
/// # Errors
/// When an encoder is missing or fails.
pub(crate) fn encode(
    samples: &[f64],
    rate_hz: u32,
    stem: &str,
    folder: &Path,
) -> Result<Vec<(String, &'static str)>> {
    let scratch = tempfile::tempdir().context("making a folder for the sound")?;
    let wave = scratch.path().join("sound.wav");
    write_wave(&wave, samples, rate_hz)?;
    let [opus, mp3] = ENDINGS.map(|ending| format!("{stem}.{ending}"));

    // A fixed serial number and no picture or comment: the same sound gives the same file.
    let made = scratch.path().join("sound.opus");
    let mut command = OPUSENC.command();
    command
        .args([
            "--quiet",
            "--bitrate",
            "36",
            "--vbr",
            "--speech",
            "--comp",
            "10",
        ])
        .args(["--serial", "1", "--discard-comments", "--discard-pictures"])
        .arg(&wave)
        .arg(&made);
    OPUSENC.run(command)?;
    publish(&made, &folder.join(&opus))?;

    // The header that libmp3lame writes tells players how much silence it added.
    let made = scratch.path().join("sound.mp3");
    let mut command = FFMPEG.command();
    command
        .args(["-v", "error", "-nostdin", "-y", "-i"])
        .arg(&wave)
        .args(["-codec:a", "libmp3lame", "-b:a", "48k", "-write_xing", "1"])
        .args([
            "-map_metadata",
            "-1",
            "-id3v2_version",
            "0",
            "-fflags",
            "+bitexact",
        ])
        .arg(&made);
    FFMPEG.run(command)?;
    publish(&made, &folder.join(&mp3))?;

    Ok(vec![(opus, "audio/ogg; codecs=opus"), (mp3, "audio/mpeg")])
}

fn write_wave(path: &Path, samples: &[f64], rate_hz: u32) -> Result<()> {
    let spec = hound::WavSpec {
        channels: 1,
        sample_rate: rate_hz,
        bits_per_sample: 16,
        sample_format: hound::SampleFormat::Int,
    };
    let mut writer = hound::WavWriter::create(path, spec).context("writing the sound")?;
    for sample in samples {
        let level = (sample * 32767.0).round().clamp(-32768.0, 32767.0);
        writer.write_sample(level as i16)?;
    }
    writer.finalize().context("writing the sound")
}

/// Copies a finished file to its place. A half-written one never stands there.
fn publish(made: &Path, place: &Path) -> Result<()> {
    fs::copy(made, place).with_context(|| format!("writing {}", place.display()))?;
    Ok(())
}
