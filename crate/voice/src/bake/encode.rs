//! Encodes an utterance: Ogg Opus for the browsers that support it, MP3 for the others.

use std::fs;
use std::io::Cursor;
use std::path::Path;

use anyhow::{Context as _, Result, ensure};

use super::program::{FFMPEG, OPUSENC, Program};

/// File extensions and MIME types of the output of [`encode`], preferred first.
pub(super) const FORMATS: [(&str, &str); 2] =
    [("opus", "audio/ogg; codecs=opus"), ("mp3", "audio/mpeg")];

/// Encodes audio in each of [`FORMATS`] and returns the bytes of the files.
///
/// # Errors
/// Returns an error if an encoder is missing or fails.
pub(super) fn encode(samples: &[f64], rate_hz: u32) -> Result<[Vec<u8>; 2]> {
    let scratch = tempfile::tempdir().context("making a folder for the sound")?;
    let wave = scratch.path().join("sound.wav");
    fs::write(&wave, wave_of(samples, rate_hz)?).context("writing the sound")?;

    // A fixed serial number without images and comments makes the file reproducible.
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
    let opus = made_by(&OPUSENC, &made)?;

    // The header written by libmp3lame specifies the amount of added silence.
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
    let mp3 = made_by(&FFMPEG, &made)?;

    Ok([opus, mp3])
}

/// Encodes samples as a WAV file with one channel and 16 bits.
///
/// # Errors
/// Returns an error if the file would be too long.
pub(super) fn wave_of(samples: &[f64], rate_hz: u32) -> Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    let spec = hound::WavSpec {
        channels: 1,
        sample_rate: rate_hz,
        bits_per_sample: 16,
        sample_format: hound::SampleFormat::Int,
    };
    let mut writer = hound::WavWriter::new(&mut bytes, spec).context("writing the sound")?;
    for sample in samples {
        let level = (sample * 32767.0).round().clamp(-32768.0, 32767.0);
        writer.write_sample(level as i16)?;
    }
    writer.finalize().context("writing the sound")?;
    Ok(bytes.into_inner())
}

/// Returns the output of an encoder. Some exit successfully on a full disk.
fn made_by(program: &Program, path: &Path) -> Result<Vec<u8>> {
    let bytes = fs::read(path).with_context(|| format!("reading what {} made", program.name))?;
    ensure!(!bytes.is_empty(), "{} made an empty sound", program.name);
    Ok(bytes)
}
