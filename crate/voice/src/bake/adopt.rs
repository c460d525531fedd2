//! Adoption of audio from bundles without file digests, as written by earlier bakes: the files must
//! match the levels of their utterance.

use std::path::Path;

use crate::assemble::intensity_codes;
use raconteur_speech::bundle::{Utterance, db_of_code};

use super::sounds;

/// Maximum difference between the length of an audio file and its utterance, seconds: an encoder's
/// frame of 20 ms.
const LENGTH_SECS: f64 = 0.02;
/// Softer frames are not compared, decibels: encoders fill pauses.
const SOFTEST_DB: f64 = -50.0;
/// Maximum intensity difference at which two frames count as alike, decibels.
const ALIKE_DB: f64 = 3.0;
/// Minimum share of frames that must be alike.
const MIN_ALIKE: f64 = 0.9;

/// Returns true if a sound has the length and intensity contour of its utterance. A file that
/// cannot be decoded, because a bake was stopped while writing it, does not.
pub(super) fn is_sound_of(utterance: &Utterance, path: &Path) -> bool {
    sounds::decode(path).is_ok_and(|(samples, rate_hz)| fits(utterance, &samples, rate_hz))
}

fn fits(utterance: &Utterance, samples: &[f64], rate_hz: f64) -> bool {
    let secs = samples.len() as f64 / rate_hz;
    (secs - utterance.duration_secs).abs() <= LENGTH_SECS
        && alike(utterance, samples, rate_hz) >= MIN_ALIKE
}

/// Returns the share of audible frames whose intensity is alike in the samples and in the
/// utterance.
fn alike(utterance: &Utterance, samples: &[f64], rate_hz: f64) -> f64 {
    let heard = intensity_codes(samples, rate_hz, utterance.duration_secs);
    let pairs = utterance.intensity.iter().zip(&heard);
    let loud: Vec<f64> = pairs
        .map(|(told, heard)| (db_of_code(*told), db_of_code(*heard)))
        .filter(|(told, heard)| told.max(*heard) > SOFTEST_DB)
        .map(|(told, heard)| (told - heard).abs())
        .collect();
    let same = loud.iter().filter(|d| **d <= ALIKE_DB).count();
    same as f64 / loud.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Syllables of random lengths and strengths.
    fn speech(seed: u64) -> Vec<f64> {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        let mut next = move || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut samples = Vec::new();
        while samples.len() < 32_000 {
            let level = if next() < 0.3 {
                0.0
            } else {
                0.02 + 0.3 * next()
            };
            let count = 1_500 + (4_000.0 * next()) as usize;
            samples.extend((0..count).map(|i| level * libm::sin(0.3 * i as f64)));
        }
        samples.truncate(32_000);
        samples
    }

    #[test]
    fn a_sound_is_its_own_utterance_s_and_no_other_s() {
        for own in 0..20 {
            let told = Utterance {
                duration_secs: 2.0,
                intensity: intensity_codes(&speech(own), 16_000.0, 2.0),
                ..Utterance::default()
            };
            for other in 0..20 {
                let samples = speech(other);
                assert_eq!(fits(&told, &samples, 16_000.0), own == other);
                assert!(!fits(&told, &samples[..31_000], 16_000.0), "too short");
            }
        }
    }
}
