//! Reader of audio from engines and people.

mod plain;

use std::io::Cursor;
use std::path::Path;

use anyhow::{Context as _, Result, ensure};

use crate::files::input;

/// Maximum size of an audio file, bytes: half an hour of stereo at 48 kHz and 24 bits.
pub(super) const MAX_BYTES: u64 = 512 << 20;

/// Fewest and most samples a second.
const RATES_HZ: std::ops::RangeInclusive<u32> = 4_000..=384_000;

/// Decoded mono audio of a WAV file.
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
/// Returns the same errors as [`decode`], and an error if the file does not exist.
pub(super) fn read(path: &Path) -> Result<Wave> {
    decode(&bytes(path)?).with_context(|| format!("reading the sound {}", path.display()))
}

/// Reads the bytes of an audio file.
///
/// # Errors
/// Returns an error if the file does not exist or is too long.
pub(super) fn bytes(path: &Path) -> Result<Vec<u8>> {
    input::bytes(path, MAX_BYTES).context("the sound")
}

/// Decodes a WAV with 8 to 32 bits, or 32- or 64-bit floating-point samples, of any rate, with
/// chunks in any order and with or without a length; channels are averaged. NaN is silence, and
/// samples are clamped to 1.
///
/// # Errors
/// Returns an error if the bytes are not a WAV file, are compressed, are truncated, or have no
/// channels or an impossible sample rate.
pub(super) fn decode(bytes: &[u8]) -> Result<Wave> {
    let plain = plain::plain(bytes)?;
    let mut reader = hound::WavReader::new(Cursor::new(plain)).context("no WAV")?;
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

    /// Returns a WAV of these chunks, each with its declared length and contents.
    fn chunks(of: &[(&[u8; 4], u32, &[u8])]) -> Vec<u8> {
        let mut out = b"RIFF\xff\xff\xff\xffWAVE".to_vec();
        for (name, length, bytes) in of {
            out.extend(*name);
            out.extend(length.to_le_bytes());
            out.extend(*bytes);
        }
        out
    }

    /// Returns the format chunk for one channel at 22,050 Hz.
    fn form(tag: u16, bits: u16) -> Vec<u8> {
        let frame = bits / 8;
        let mut out = [tag.to_le_bytes(), 1_u16.to_le_bytes()].concat();
        out.extend(22_050_u32.to_le_bytes());
        out.extend((22_050 * u32::from(frame)).to_le_bytes());
        out.extend(frame.to_le_bytes());
        out.extend(bits.to_le_bytes());
        out
    }

    #[test]
    fn wavs_are_read_as_programs_write_them() {
        let (pcm, data) = (&form(1, 16)[..], &[0, 0x20].repeat(4)[..]);
        let fmt = (b"fmt ", 16, pcm);
        let doubles = 0.25_f64.to_le_bytes().repeat(4);
        let told = doubles.len() as u32;
        // The form of MPEG's WAVs has a description of 18 bytes for plain samples, too.
        let longer = [pcm, &[0, 0]].concat();
        for (what, bytes) in [
            ("a pipe", chunks(&[fmt, (b"data", u32::MAX, data)])),
            (
                "a pipe, signed",
                chunks(&[fmt, (b"data", 0x7fff_ffff, data)]),
            ),
            (
                "a pipe, less its header",
                chunks(&[fmt, (b"data", u32::MAX - 36, data)]),
            ),
            ("no length", chunks(&[fmt, (b"data", 0, data)])),
            (
                "a stopped stream",
                chunks(&[fmt, (b"data", u32::MAX, &[data, &[1]].concat())]),
            ),
            (
                "a list of odd length",
                chunks(&[fmt, (b"LIST", 3, b"abc\0"), (b"data", 8, data)]),
            ),
            (
                "one that is not filled",
                chunks(&[fmt, (b"LIST", 3, b"abc"), (b"data", 8, data)]),
            ),
            ("data first", chunks(&[(b"data", 8, data), fmt])),
            (
                "something behind",
                chunks(&[fmt, (b"data", 8, data), (b"junk", 3, b"abc")]),
            ),
            (
                "a longer form",
                chunks(&[(b"fmt ", 18, &longer), (b"data", 8, data)]),
            ),
            (
                "doubles",
                chunks(&[(b"fmt ", 16, &form(3, 64)), (b"data", told, &doubles)]),
            ),
            (
                "24 bits",
                chunks(&[
                    (b"fmt ", 16, &form(1, 24)),
                    (b"data", 12, &[0, 0, 0x20].repeat(4)),
                ]),
            ),
        ] {
            let wave = decode(&bytes).unwrap_or_else(|e| panic!("{what}: {e:#}"));
            assert_eq!(wave.rate_hz, 22_050.0, "{what}");
            assert_eq!(wave.samples, [0.25; 4], "{what}");
        }
        let empty = chunks(&[fmt, (b"data", 0, b""), (b"junk", 4, b"abcd")]);
        assert!(
            decode(&empty).unwrap().samples.is_empty(),
            "a WAV without samples is read"
        );
        let mut long = chunks(&[
            (
                b"ds64",
                28,
                &[&[0; 8][..], &8_u64.to_le_bytes(), &[0; 12]].concat(),
            ),
            fmt,
            (b"data", u32::MAX, data),
            (b"junk", 4, b"abcd"),
        ]);
        long[..4].copy_from_slice(b"RF64");
        assert_eq!(decode(&long).unwrap().samples, [0.25; 4], "RF64");
    }

    #[test]
    fn what_of_a_wav_is_not_read_is_named() {
        let data = (b"data", 8, &[0_u8; 8][..]);
        for (bytes, told) in [
            (chunks(&[(b"fmt ", 16, &form(6, 8)), data]), "0x0006"),
            (chunks(&[data]), "fmt"),
            (chunks(&[(b"fmt ", 16, &form(1, 16))]), "data"),
            (chunks(&[(b"fmt ", 2, &[1, 0]), data]), "too short"),
            (
                chunks(&[(b"fmt ", 16, &form(1, 16)), (b"data", 9, &[0; 8])]),
                "cut off",
            ),
        ] {
            let error = format!("{:#}", decode(&bytes).unwrap_err());
            assert!(error.contains(told), "{error}");
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
        assert!(
            decode(&whole[..whole.len() - 1]).is_err(),
            "a truncated WAV is rejected"
        );
        assert!(
            decode(&whole[..30]).is_err(),
            "a WAV without data is rejected"
        );
        assert!(decode(b"OggS").is_err(), "another format is rejected");
        let mut still = whole.clone();
        still[24..28].fill(0);
        assert!(decode(&still).is_err(), "0 Hz");
    }
}
