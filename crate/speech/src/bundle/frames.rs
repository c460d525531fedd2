//! Audio features every 10 ms, one byte each: fundamental frequency and intensity.

use core::f64::consts::LN_2;

use base64::Engine as _;
use base64::alphabet::STANDARD;
use base64::engine::general_purpose::{GeneralPurpose, NO_PAD};
use raconteur_base::ops;

/// Time from one frame to the next, seconds. Frame `i` is measured around `i` times this.
pub const FRAME_SECS: f64 = 0.01;

/// The frequency of code 1, hertz: below every voice.
const MIN_HZ: f64 = 40.0;
/// Codes in an octave: a step is a fifth of a semitone, 1.2 %.
const CODES_AN_OCTAVE: f64 = 60.0;
/// The intensity of code 0 against full scale, decibels; each code is half a decibel.
const MIN_DB: f64 = -100.0;

/// Returns the frequency of a code, hertz; `None` for unvoiced frames.
#[must_use]
pub fn hz_of_code(code: u8) -> Option<f64> {
    (code > 0).then(|| MIN_HZ * ops::exp((f64::from(code) - 1.0) / CODES_AN_OCTAVE * LN_2))
}

/// Returns the pitch of a code, semitones above the lowest code; `None` for unvoiced frames. Its
/// differences are musical intervals, independent of the voice.
#[must_use]
pub fn semitones_of_code(code: u8) -> Option<f64> {
    (code > 0).then(|| (f64::from(code) - 1.0) * (12.0 / CODES_AN_OCTAVE))
}

/// Returns the code of a frequency in hertz: 0 for unvoiced, else from 40 to 752 Hz.
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to a byte"
)]
pub fn code_of_hz(hz: f64) -> u8 {
    if hz > 0.0 {
        let code = (CODES_AN_OCTAVE * ops::ln(hz / MIN_HZ) / LN_2).round() + 1.0;
        code.clamp(1.0, 255.0) as u8
    } else {
        0
    }
}

/// Converts an intensity code to decibels relative to full scale.
#[must_use]
pub fn db_of_code(code: u8) -> f64 {
    MIN_DB + f64::from(code) / 2.0
}

/// The code of an intensity in decibels against full scale, from −100 to 27.5.
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to a byte; not a number becomes 0"
)]
pub fn code_of_db(db: f64) -> u8 {
    ((db - MIN_DB) * 2.0).round().clamp(0.0, 255.0) as u8
}

/// Base64 without padding (RFC 4648, sections 3.2 and 4). Bits of the last letter that belong to no byte are passed over.
const BASE64: GeneralPurpose =
    GeneralPurpose::new(&STANDARD, NO_PAD.with_decode_allow_trailing_bits(true));

/// Encodes bytes as base64 without padding (RFC 4648, sections 3.2 and 4).
#[must_use]
pub fn to_base64(bytes: &[u8]) -> String {
    BASE64.encode(bytes)
}

/// Decodes base64 without padding; `None` for invalid base64.
#[must_use]
pub fn from_base64(text: &str) -> Option<Vec<u8>> {
    BASE64.decode(text).ok()
}

/// Milliseconds as seconds.
pub(super) fn secs(msec: f64) -> f64 {
    msec / 1000.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_what_the_standard_says() {
        // Section 10 of RFC 4648, without its padding.
        for (plain, coded) in [
            ("", ""),
            ("f", "Zg"),
            ("fo", "Zm8"),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg"),
            ("fooba", "Zm9vYmE"),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(to_base64(plain.as_bytes()), coded);
            assert_eq!(from_base64(coded).unwrap(), plain.as_bytes());
        }
        let all: Vec<u8> = (0..=255).collect();
        assert_eq!(from_base64(&to_base64(&all)).unwrap(), all);
        for bad in ["A", "Zg==", "Z g", "Z\u{e9}"] {
            assert_eq!(from_base64(bad), None, "{bad}");
        }
    }

    #[test]
    fn frequencies_and_intensities_come_back_within_half_a_step() {
        assert_eq!((code_of_hz(0.0), hz_of_code(0)), (0, None));
        for tenth in 410..7_500 {
            let hz = f64::from(tenth) / 10.0;
            let back = hz_of_code(code_of_hz(hz)).unwrap();
            assert!((back / hz - 1.0).abs() < 0.006, "{hz} {back}");
            let octaves = semitones_of_code(code_of_hz(hz)).unwrap() / 12.0;
            assert!(
                (MIN_HZ * ops::exp(octaves * LN_2) - back).abs() < 1e-9,
                "the pitch in semitones equals the frequency"
            );
        }
        for tenth in -1_000..200 {
            let db = f64::from(tenth) / 10.0;
            assert!(
                (db_of_code(code_of_db(db)) - db).abs() < 0.26,
                "the intensity round trips within half a step"
            );
        }
        assert_eq!(code_of_db(f64::NEG_INFINITY), 0);
        assert_eq!(code_of_db(f64::NAN), 0);
    }
}
