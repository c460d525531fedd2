//! Writers of music as WAV, Ogg Opus or MP3.

use std::fs;
use std::path::Path;

use anyhow::{Context as _, Result, bail};

use super::signal::{Noise, RATE_HZ, Stereo};
use raconteur_voice::bake::program::{FFMPEG, OPUSENC};
use raconteur_voice::files::disk;

/// kbit/s, both channels.
const OPUS_RATE: &str = "56";
const MP3_RATE: &str = "80k";

/// Writes the sound in the format that the path's ending names.
///
/// # Errors
/// Returns an error if the extension is unknown, or an encoder is missing or fails.
pub(crate) fn encode(sound: &Stereo, path: &Path) -> Result<()> {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let scratch = tempfile::tempdir().context("making a folder for the sound")?;
    let wave = scratch.path().join("music.wav");
    write_wave(&wave, sound)?;
    let made = scratch.path().join(format!("music.{ending}"));
    match &*ending {
        "wav" => {}
        "opus" => {
            // A fixed serial number without comments makes the file reproducible.
            let mut command = OPUSENC.command();
            command
                .args(["--quiet", "--bitrate", OPUS_RATE, "--vbr", "--music"])
                .args(["--comp", "10", "--serial", "1"])
                .args(["--discard-comments", "--discard-pictures"])
                .arg(&wave)
                .arg(&made);
            OPUSENC.run(command)?;
        }
        "mp3" => {
            let mut command = FFMPEG.command();
            command
                .args(["-v", "error", "-nostdin", "-y", "-i"])
                .arg(&wave)
                .args(["-codec:a", "libmp3lame", "-b:a", MP3_RATE])
                .args(["-write_xing", "1", "-map_metadata", "-1"])
                .args(["-id3v2_version", "0", "-fflags", "+bitexact"])
                .arg(&made);
            FFMPEG.run(command)?;
        }
        _ => bail!("{}: write a .wav, .opus or .mp3", path.display()),
    }
    disk::replace(path, &fs::read(&made).context("reading what was made")?)
}

fn write_wave(path: &Path, sound: &Stereo) -> Result<()> {
    let spec = hound::WavSpec {
        channels: 2,
        sample_rate: RATE_HZ as u32,
        bits_per_sample: 16,
        sample_format: hound::SampleFormat::Int,
    };
    let mut writer = hound::WavWriter::create(path, spec).context("writing the sound")?;
    // Dither of one bit prevents distortion in quiet endings.
    let mut dither = Noise::new(0, 0, 0);
    for (left, right) in sound[0].iter().zip(&sound[1]) {
        for sample in [left, right] {
            let level = sample * 32767.0 + 0.5 * (dither.signed() + dither.signed());
            writer.write_sample(level.round().clamp(-32768.0, 32767.0) as i16)?;
        }
    }
    writer.finalize().context("writing the sound")
}
