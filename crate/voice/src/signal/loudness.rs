//! Integrated loudness of audio: ITU-R BS.1770-4 (2015), annex 1, for front channels.

use std::f64::consts::PI;

use raconteur_base::ops;

use super::filter::Biquad;
use super::intensity::decibels;
use super::is_rate;

/// Length of a gating block and the time between blocks, in seconds.
const BLOCK_SECS: f64 = 0.4;
const STEP_SECS: f64 = 0.1;

/// Returns the integrated loudness of channels of equal length in LUFS: K-weighted, gated at −70
/// LUFS and at 10 LU below the result of that gate. `None` if nothing passes: silence, or an
/// unusable rate. Sound shorter than a block counts as one block.
#[must_use]
pub fn integrated_lufs(channels: &[&[f64]], rate_hz: f64) -> Option<f64> {
    let length = channels.iter().map(|c| c.len()).max().unwrap_or(0);
    if length == 0 || !is_rate(rate_hz) {
        return None;
    }
    // Near half a low rate the transform bends the shelf: the gain at 997 Hz, where the
    // standard's constant puts a full tone at −3.01, is made that of 48 kHz.
    let gain =
        |rate: f64| shelf(rate).power_gain(997.0, rate) * high_pass(rate).power_gain(997.0, rate);
    let correction = gain(48_000.0) / gain(rate_hz);
    let mut squares = vec![0.0; length];
    for channel in channels {
        let weighted = high_pass(rate_hz).run(&shelf(rate_hz).run(channel));
        for (square, y) in squares.iter_mut().zip(weighted) {
            *square += correction * y * y;
        }
    }
    let mut sums = vec![0.0; length + 1];
    for (i, square) in squares.iter().enumerate() {
        sums[i + 1] = sums[i] + square;
    }
    let block = ((BLOCK_SECS * rate_hz) as usize).min(length);
    let last = (length - block) as f64 / (STEP_SECS * rate_hz);
    let powers: Vec<f64> = (0..=last as usize)
        .map(|k| {
            let from = (k as f64 * STEP_SECS * rate_hz) as usize;
            (sums[from + block] - sums[from]) / block as f64
        })
        .collect();
    let over = |gate: f64| {
        let kept: Vec<f64> = powers.iter().copied().filter(|p| lufs(*p) > gate).collect();
        (!kept.is_empty()).then(|| lufs(kept.iter().sum::<f64>() / kept.len() as f64))
    };
    over(over(-70.0)? - 10.0)
}

/// Converts weighted power to loudness, LUFS: equation (2).
fn lufs(power: f64) -> f64 {
    decibels(power) - 0.691
}

/// Returns the first filter stage. The standard gives coefficients for 48 kHz only (table 1); these
/// are the analogue filter that they derive from by bilinear transform, so any rate is supported:
/// corner, gain and quality were solved from the table, which a test compares.
fn shelf(rate_hz: f64) -> Biquad {
    const CORNER_HZ: f64 = 1_681.974_450_955_533;
    const GAIN_DB: f64 = 3.999_843_853_973_347;
    const QUALITY: f64 = 0.707_175_236_955_419_6;
    let k = ops::tan(PI * (CORNER_HZ / rate_hz).min(0.49));
    let high = ops::pow(10.0, GAIN_DB / 20.0);
    let middle = ops::pow(high, 0.499_666_774_154_541_6) * k / QUALITY;
    let norm = 1.0 + k / QUALITY + k * k;
    Biquad {
        b: [
            (high + middle + k * k) / norm,
            2.0 * (k * k - high) / norm,
            (high - middle + k * k) / norm,
        ],
        a: [
            2.0 * (k * k - 1.0) / norm,
            (1.0 - k / QUALITY + k * k) / norm,
        ],
    }
}

/// Creates the second stage of the weighting filter (table 2), a high-pass, for a sample rate.
fn high_pass(rate_hz: f64) -> Biquad {
    const CORNER_HZ: f64 = 38.135_470_876_024_44;
    const QUALITY: f64 = 0.500_327_037_323_877_3;
    let k = ops::tan(PI * CORNER_HZ / rate_hz);
    let norm = 1.0 + k / QUALITY + k * k;
    Biquad {
        b: [1.0, -2.0, 1.0],
        a: [
            2.0 * (k * k - 1.0) / norm,
            (1.0 - k / QUALITY + k * k) / norm,
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tone(rate_hz: f64, hz: f64, amplitude: f64, secs: f64) -> Vec<f64> {
        (0..(rate_hz * secs) as usize)
            .map(|i| amplitude * ops::sin(2.0 * PI * hz * i as f64 / rate_hz))
            .collect()
    }

    #[test]
    fn at_48_khz_the_filters_are_those_of_the_tables() {
        let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9);
        let one = shelf(48_000.0);
        assert!(
            near(
                &one.b,
                &[
                    1.535_124_859_586_97,
                    -2.691_696_189_406_38,
                    1.198_392_810_852_85
                ]
            ),
            "the numerator of the shelving filter"
        );
        assert!(
            near(&one.a, &[-1.690_659_293_182_41, 0.732_480_774_215_85]),
            "the denominator of the shelving filter"
        );
        let two = high_pass(48_000.0);
        assert!(
            near(&two.b, &[1.0, -2.0, 1.0]),
            "the numerator of the high-pass filter"
        );
        assert!(
            near(&two.a, &[-1.990_047_454_833_98, 0.990_072_250_366_21]),
            "the denominator of the high-pass filter"
        );
    }

    #[test]
    fn a_full_tone_of_997_hz_is_at_minus_3_01_at_any_rate() {
        for rate in [8000.0, 16_000.0, 22_050.0, 44_100.0, 48_000.0] {
            let loud = integrated_lufs(&[&tone(rate, 997.0, 1.0, 3.0)], rate);
            assert!(
                loud.is_some_and(|l| (l + 3.01).abs() < 0.1),
                "{rate}: {loud:?}"
            );
        }
    }

    #[test]
    fn pauses_do_not_count() {
        let rate = 16_000.0;
        let mut sound = tone(rate, 997.0, 0.1, 4.0);
        let alone = integrated_lufs(&[&sound], rate).unwrap_or(0.0);
        sound.extend(vec![0.0; 64_000]);
        sound.extend(tone(rate, 997.0, 0.003, 4.0));
        let with_pauses = integrated_lufs(&[&sound], rate).unwrap_or(0.0);
        // The blocks that straddle the end are quieter and still over the gate.
        assert!(
            (alone + 23.01).abs() < 0.1 && (with_pauses - alone).abs() < 0.25,
            "pauses do not change the loudness"
        );
        // One channel of two in front reads the same, both read 3 dB more.
        let (full, still) = (tone(rate, 997.0, 1.0, 5.0), vec![0.0; 5 * rate as usize]);
        let of = |channels: &[&[f64]]| integrated_lufs(channels, rate).unwrap_or(0.0);
        assert!(
            (of(&[&full, &still]) + 3.01).abs() < 0.02,
            "a silent channel does not add loudness"
        );
        assert!(
            (of(&[&full, &full]) - of(&[&full]) - 3.01).abs() < 0.01,
            "two equal channels add 3.01 LU"
        );
        assert_eq!(integrated_lufs(&[&[0.0; 9999]], rate), None);
        assert_eq!(integrated_lufs(&[&[0.5; 9]], f64::NAN), None);
        assert!(
            integrated_lufs(&[&tone(rate, 997.0, 1.0, 0.1)], rate).is_some(),
            "100 ms of a tone have a loudness"
        );
    }
}
