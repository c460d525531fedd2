//! Small synthesiser: converts JSON scores to music.
//!
//! Scope: reading a score, playing its notes on synthetic instruments, mixing them with
//! reverberation to a given loudness, and writing the file. The same score gives the same samples
//! everywhere.
//! Out of scope: recorded audio.

mod drum;
mod encode;
mod harmony;
mod instrument;
mod mix;
mod note;
pub mod score;
mod signal;

use std::path::Path;

use anyhow::Result;
use raconteur_voice::signal::loudness::integrated_lufs;

pub(crate) use score::Score;

/// Finished piece of music: its stereo samples, ready to be measured and written.
pub(crate) struct Music {
    sound: signal::Stereo,
}

/// Plays a score.
///
/// # Errors
/// Returns an error if the score is invalid.
pub(crate) fn play(score: &Score) -> Result<Music> {
    Ok(Music {
        sound: mix::mix(score, &score.parts()?),
    })
}

/// Returns the integrated loudness, LUFS (BS.1770-4); -120 for silence.
fn lufs(sound: &signal::Stereo) -> f64 {
    let channels = sound.each_ref().map(Vec::as_slice);
    integrated_lufs(&channels, signal::RATE_HZ).unwrap_or(-120.0)
}

impl Music {
    /// Returns the length of the piece, seconds.
    pub(crate) fn length_secs(&self) -> f64 {
        self.sound[0].len() as f64 / signal::RATE_HZ
    }

    /// Returns the integrated loudness of the piece, LUFS (BS.1770-4).
    pub(crate) fn loudness_lufs(&self) -> f64 {
        lufs(&self.sound)
    }

    /// Returns the peak sample level, dB relative to full scale.
    pub(crate) fn peak_db(&self) -> f64 {
        let peak = self
            .sound
            .iter()
            .flatten()
            .fold(0.0, |m: f64, x| m.max(x.abs()));
        20.0 * libm::log10(peak.max(1e-6))
    }

    /// Writes an audio file in the format of its extension: `wav`, `opus` or `mp3`.
    ///
    /// # Errors
    /// Returns an error if the extension is unknown, or an encoder is missing or fails.
    pub(crate) fn write(&self, path: &Path) -> Result<()> {
        encode::encode(&self.sound, path)
    }
}
