//! Soundtrack of a film: baked utterances, and music at its level.

use std::path::Path;

use anyhow::{Context as _, Result};
use raconteur_player::{MusicCue, Player};
use tempfile::TempDir;

use crate::assets;
use crate::terminal;
use raconteur_voice::bake::program::FFMPEG;
use raconteur_voice::files::{inside, media};

/// Samples a second of music.
const RATE_HZ: u32 = 48_000;
/// Distance of the breakpoints of the music level, samples: 5 ms.
const LEVEL_STEP: usize = 240;

/// Sound file of a film with its start in the film, seconds; negative if it starts before the film.
pub(crate) struct Sound {
    /// A sound of the film.
    pub(crate) file: media::Sound,
    /// Seconds from the start of the film.
    pub(crate) start_secs: f64,
}

/// Opens a sound file in the folder of the story.
fn sound(folder: &Path, path: &str) -> Result<media::Sound> {
    let found = inside::find(folder, path)?;
    media::Sound::open(&found.with_context(|| format!("there is no {path}"))?)
}

/// Sounds of a film: speech and music.
pub(crate) struct Soundtrack {
    /// Speech audio, one channel each.
    pub(crate) voices: Vec<Sound>,
    /// Music, two channels each.
    pub(crate) music: Vec<Sound>,
    /// Temporary folder of the music, removed on drop.
    _scratch: Option<TempDir>,
}

impl Soundtrack {
    /// Collects the audible sounds for a film of the story at `script` that begins at `from_secs`
    /// and is `length_secs` long. Unavailable music is omitted with a message: the film continues
    /// without it.
    pub(crate) fn collect(
        player: &Player,
        script: &Path,
        from_secs: f64,
        length_secs: f64,
    ) -> Self {
        let folder = script.parent().unwrap_or(Path::new(""));
        let mut voices = Vec::new();
        for u in player.utterances() {
            let heard = u.timed.end_secs() > from_secs;
            let Some(audio) = u.timed.utterance.audio.first().filter(|_| heard) else {
                continue;
            };
            match sound(folder, &format!("voice/{}", audio.file)) {
                Ok(file) => voices.push(Sound {
                    file,
                    start_secs: u.timed.start_secs - from_secs,
                }),
                Err(error) => terminal::report(format_args!("speech is missing: {error:#}")),
            }
        }
        let mut track = Self {
            voices,
            music: Vec::new(),
            _scratch: None,
        };
        let end_secs = from_secs + length_secs;
        for cue in player.music() {
            if cue.start_secs >= end_secs || cue.end_secs <= from_secs {
                continue;
            }
            if let Err(error) = track.add_music(&cue, script, from_secs, end_secs) {
                terminal::report(format_args!("the music {} is missing: {error:#}", cue.file));
            }
        }
        track
    }

    /// Decodes a piece of music, applies its level and stores it for the film.
    fn add_music(&mut self, cue: &MusicCue, script: &Path, from: f64, end: f64) -> Result<()> {
        let file = if cue.library {
            media::Sound::open(&assets::find(&format!("music/{}", cue.file))?)?
        } else {
            sound(script.parent().unwrap_or(Path::new("")), &cue.file)?
        };
        let scratch = match self._scratch.take() {
            Some(scratch) => scratch,
            None => tempfile::tempdir().context("making a folder for the music")?,
        };
        let [raw, wave] = ["raw", "wav"].map(|ending| {
            let name = format!("{}.{ending}", self.music.len());
            scratch.path().join(name)
        });
        self._scratch = Some(scratch);
        let mut command = FFMPEG.command();
        command.args(["-v", "error", "-nostdin", "-y"]);
        if cue.loops {
            command.args(["-stream_loop", "-1"]);
        }
        let heard_secs = cue.end_secs.min(end) - cue.start_secs;
        file.input(&mut command);
        command
            .args(["-vn", "-sn", "-dn", "-t", &format!("{heard_secs:.6}")])
            .args(["-f", "s16le", "-ac", "2", "-ar", &RATE_HZ.to_string()])
            .arg(&raw);
        FFMPEG.run(command)?;
        let bytes = std::fs::read(&raw)?;
        let spec = hound::WavSpec {
            channels: 2,
            sample_rate: RATE_HZ,
            bits_per_sample: 16,
            sample_format: hound::SampleFormat::Int,
        };
        let mut writer = hound::WavWriter::create(&wave, spec)?;
        for (block, samples) in bytes.chunks(4 * LEVEL_STEP).enumerate() {
            let at = |step: usize| {
                let offset_secs = (step * LEVEL_STEP) as f64 / f64::from(RATE_HZ);
                cue.level_at(cue.start_secs + offset_secs)
            };
            let (level, next) = (at(block), at(block + 1));
            for (i, pair) in samples.chunks_exact(4).enumerate() {
                let gain = level + (next - level) * i as f64 / LEVEL_STEP as f64;
                for sample in pair.chunks_exact(2) {
                    let value = f64::from(i16::from_le_bytes([sample[0], sample[1]]));
                    let louder = (value * gain).round().clamp(-32768.0, 32767.0);
                    writer.write_sample(louder as i16)?;
                }
            }
        }
        writer.finalize()?;
        self.music.push(Sound {
            file: media::Sound::open(&wave)?,
            start_secs: cue.start_secs - from,
        });
        Ok(())
    }

    /// Returns all sounds, speech first.
    pub(crate) fn sounds(&self) -> impl Iterator<Item = &Sound> {
        self.voices.iter().chain(&self.music)
    }

    /// Returns the ffmpeg filter that delays each sound to its time and mixes them at full level;
    /// `None` if there are no sounds.
    pub(crate) fn filter(&self) -> Option<String> {
        let count = self.sounds().count();
        if count == 0 {
            return None;
        }
        let mut filter = String::new();
        for (i, sound) in self.sounds().enumerate() {
            let delay_ms = (sound.start_secs.max(0.0) * 1000.0).round();
            // A voice is in the middle, as loud on both sides as it was baked.
            let middle = if i < self.voices.len() {
                "pan=stereo|c0=c0|c1=c0,"
            } else {
                ""
            };
            filter += &format!("[{}:a]{middle}adelay={delay_ms}:all=1[s{i}];", i + 1);
        }
        for i in 0..count {
            filter += &format!("[s{i}]");
        }
        filter += &format!("amix=inputs={count}:normalize=0:dropout_transition=0[mix]");
        Some(filter)
    }
}
