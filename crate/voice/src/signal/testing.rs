//! Audio with known properties, for the tests of this module.

use std::f64::consts::{PI, TAU};

use raconteur_base::ops;

use super::{PitchTrack, scatter};

/// Segment of a synthetic test utterance.
pub(crate) struct Segment {
    secs: f64,
    kind: Kind,
}

enum Kind {
    Silence,
    Noise,
    Vowel(f64, f64),
    Burst,
}

impl Segment {
    pub(crate) fn silence(secs: f64) -> Self {
        Self {
            secs,
            kind: Kind::Silence,
        }
    }

    /// Creates a fricative: noise without its lower frequencies.
    pub(crate) fn noise(secs: f64) -> Self {
        Self {
            secs,
            kind: Kind::Noise,
        }
    }

    /// Returns a vowel whose frequency changes linearly from one value to another, in hertz.
    pub(crate) fn vowel(secs: f64, from_hz: f64, to_hz: f64) -> Self {
        Self {
            secs,
            kind: Kind::Vowel(from_hz, to_hz),
        }
    }

    /// Returns a plosive's release: noise that starts abruptly and decays within its 20 ms.
    pub(crate) fn burst() -> Self {
        Self {
            secs: 0.02,
            kind: Kind::Burst,
        }
    }
}

/// Returns a vowel of peak 0.5 with the given frequency at each time: harmonics below 0.45 of the
/// rate through four formants (500, 1500, 2500, 3500 Hz, bandwidths 60 to 200 Hz) and a source that
/// falls by 6 dB per octave. As a sum of cosines it has exactly the requested frequency, unlike a
/// pulse train of whole samples.
pub(super) fn vowel(rate_hz: f64, secs: f64, hz: impl Fn(f64) -> f64) -> Vec<f64> {
    let count = (rate_hz * secs).round() as usize;
    let mut phase = 0.0;
    let mut sound = Vec::with_capacity(count);
    for i in 0..count {
        let t = i as f64 / rate_hz;
        let f0 = hz(t);
        let mut sum = 0.0;
        let harmonics = ((0.45 * rate_hz).min(5000.0) / f0) as usize;
        for k in 1..=harmonics {
            let f = k as f64 * f0;
            let (mut amplitude, mut turn) = (100.0 / f, -0.5 * PI);
            for (formant, width) in [
                (500.0, 60.0),
                (1500.0, 90.0),
                (2500.0, 150.0),
                (3500.0, 200.0),
            ] {
                let (re, im) = (
                    1.0 - (f / formant) * (f / formant),
                    f * width / (formant * formant),
                );
                amplitude /= ops::hypot(re, im);
                turn -= ops::atan2(im, re);
            }
            sum += amplitude * ops::cos(k as f64 * phase + turn);
        }
        sound.push(sum);
        phase = (phase + TAU * f0 / rate_hz) % TAU;
    }
    let peak = sound.iter().fold(1e-9, |p: f64, x| p.max(x.abs()));
    sound.iter().map(|x| 0.5 * x / peak).collect()
}

/// Concatenates segments with ramps of 5 ms at both ends of each (a burst starts abruptly), and
/// returns the true frequency every millisecond.
pub(crate) fn utterance(rate_hz: f64, parts: &[Segment]) -> (Vec<f64>, PitchTrack) {
    let mut sound = Vec::new();
    let mut hz = Vec::new();
    let mut end_secs = 0.0;
    for part in parts {
        let count = (rate_hz * part.secs).round() as usize;
        let offset = sound.len() as u64;
        let random = |i: usize| scatter(offset + i as u64);
        let made: Vec<f64> = match part.kind {
            Kind::Silence => vec![0.0; count],
            Kind::Noise => (0..count)
                .map(|i| 0.1 * (random(i + 1) - random(i)))
                .collect(),
            Kind::Vowel(from, to) => {
                vowel(rate_hz, part.secs, |t| from + (to - from) * t / part.secs)
            }
            Kind::Burst => (0..count)
                .map(|i| {
                    let fall = ops::exp(-(i as f64) / (0.004 * rate_hz));
                    0.2 * (random(i + 1) - random(i)) * fall
                })
                .collect(),
        };
        let ramp = 0.005 * rate_hz;
        for (i, x) in made.iter().enumerate() {
            let start = if matches!(part.kind, Kind::Burst) {
                ramp
            } else {
                i as f64
            };
            let edge = start.min((count - 1 - i) as f64) / ramp;
            sound.push(x * edge.min(1.0));
        }
        let start_secs = end_secs;
        end_secs += part.secs;
        while (hz.len() as f64) * 0.001 < end_secs - 1e-9 {
            let t = hz.len() as f64 * 0.001 - start_secs;
            hz.push(match part.kind {
                Kind::Vowel(from, to) => from + (to - from) * t / part.secs,
                _ => 0.0,
            });
        }
    }
    let strength = vec![1.0; hz.len()];
    (
        sound,
        PitchTrack {
            step_secs: 0.001,
            hz,
            strength,
        },
    )
}
