//! Reads the sounds that engines and people make.

use std::io::Cursor;
use std::path::Path;

use anyhow::{Context as _, Result, ensure};

use crate::files::input;

/// Most bytes of sound that are read: half an hour of stereo at 48 kHz and 24 bits.
pub(super) const MOST_BYTES: u64 = 512 << 20;

/// Fewest and most samples a second.
const RATES_HZ: std::ops::RangeInclusive<u32> = 4_000..=384_000;

/// A sound.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Wave {
    /// Mono, −1 to 1.
    pub(super) samples: Vec<f64>,
    /// Samples a second.
    pub(super) rate_hz: f64,
}

/// Reads a WAV file.
///
/// # Errors
/// As [`decode`], and when there is no such file.
pub(super) fn read(path: &Path) -> Result<Wave> {
    decode(&bytes(path)?).with_context(|| format!("reading the sound {}", path.display()))
}

/// The bytes of a file.
///
/// # Errors
/// When there is no such file, or it is too long.
pub(super) fn bytes(path: &Path) -> Result<Vec<u8>> {
    input::bytes(path, MOST_BYTES).context("the sound")
}

/// Reads a WAV of 8 to 32 bits or float, of any rate; channels become their mean. NaN
/// is silence, and samples are clamped to 1.
///
/// # Errors
/// When it is no WAV, is cut off, or has no channels or an impossible rate.
pub(super) fn decode(bytes: &[u8]) -> Result<Wave> {
    let mut reader = hound::WavReader::new(Cursor::new(bytes)).context("no WAV")?;
    let spec = reader.spec();
    ensure!(
        spec.channels > 0 && RATES_HZ.contains(&spec.sample_rate),
        "{} channels at {} Hz",
        spec.channels,
        spec.sample_rate
    );
    let values: Vec<f64> = match spec.sample_format {
        hound::SampleFormat::Float => reader
            .samples::<f32>()
            .map(|s| s.map(f64::from))
            .collect::<Result<_, _>>(),
        hound::SampleFormat::Int => {
            let full = libm::exp2(f64::from(spec.bits_per_sample.clamp(8, 32)) - 1.0);
            reader
                .samples::<i32>()
                .map(|s| s.map(|s| f64::from(s) / full))
                .collect()
        }
    }
    .context("it is cut off")?;
    let channels = usize::from(spec.channels);
    let samples = values
        .chunks_exact(channels)
        .map(|frame| {
            let mean = frame.iter().sum::<f64>() / channels as f64;
            if mean.is_finite() {
                mean.clamp(-1.0, 1.0)
            } else {
                0.0
            }
        })
        .collect();
    Ok(Wave {
        samples,
        rate_hz: f64::from(spec.sample_rate),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written<S: hound::Sample + Copy>(
        bits_per_sample: u16,
        sample_format: hound::SampleFormat,
        frame: &[S],
    ) -> Vec<u8> {
        let spec = hound::WavSpec {
            channels: frame.len() as u16,
            sample_rate: 22_050,
            bits_per_sample,
            sample_format,
        };
        let mut out = Cursor::new(Vec::new());
        let mut writer = hound::WavWriter::new(&mut out, spec).unwrap();
        for _ in 0..4 {
            for s in frame {
                writer.write_sample(*s).unwrap();
            }
        }
        writer.finalize().unwrap();
        out.into_inner()
    }

    #[test]
    fn every_width_and_number_of_channels_becomes_the_same_mono() {
        use hound::SampleFormat::{Float, Int};
        for (what, bytes) in [
            ("8 bits", written(8, Int, &[32_i8])),
            ("16 bits", written(16, Int, &[8_192_i16])),
            ("24 bits", written(24, Int, &[2_097_152_i32])),
            ("32 bits", written(32, Int, &[536_870_912_i32])),
            ("float", written(32, Float, &[0.25_f32])),
            ("stereo", written(16, Int, &[4_096_i16, 12_288])),
            ("three", written(32, Float, &[0.0_f32, 0.0, 0.75])),
        ] {
            let wave = decode(&bytes).unwrap();
            assert_eq!(wave.rate_hz, 22_050.0, "{what}");
            assert_eq!(wave.samples, [0.25; 4], "{what}");
        }
    }

    #[test]
    fn what_is_no_number_or_too_loud_does_no_harm_and_no_wav_is_an_error() {
        let odd = written(
            32,
            hound::SampleFormat::Float,
            &[f32::NAN, f32::INFINITY, 1.0, 1.0],
        );
        assert_eq!(decode(&odd).unwrap().samples, [0.0; 4]);
        let loud = written(32, hound::SampleFormat::Float, &[9.0_f32]);
        assert_eq!(decode(&loud).unwrap().samples, [1.0; 4]);
        let whole = written(16, hound::SampleFormat::Int, &[1_i16]);
        assert!(decode(&whole[..whole.len() - 1]).is_err());
        assert!(decode(&whole[..30]).is_err());
        assert!(decode(b"OggS").is_err());
        let mut still = whole.clone();
        still[24..28].fill(0);
        assert!(decode(&still).is_err(), "0 Hz");
    }
}
