//! Spectrogram as data, the source of a speech image.

use raconteur_base::ops;
use realfft::RealFftPlanner;

use super::is_rate;

/// Spectrogram options: window, time step, frequency range and level range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectrogramOptions {
    /// Length of the window in seconds, within 0.001..0.1. Default 0.006, which shows
    /// single glottal pulses and formants (wide band); 0.03 shows harmonics.
    pub window_secs: f64,
    /// Time between columns in seconds, at least 0.0005. Default 0.002.
    pub step_secs: f64,
    /// Frequency at the upper edge in hertz. Default 8000; above half the rate all is 0.
    pub max_hz: f64,
    /// Rows, within 1..2048. Default 256.
    pub height: usize,
    /// Decibels from the strongest point to level 0. Default 60.
    pub range_db: f64,
}

impl Default for SpectrogramOptions {
    fn default() -> Self {
        Self {
            window_secs: 0.006,
            step_secs: 0.002,
            max_hz: 8000.0,
            height: 256,
            range_db: 60.0,
        }
    }
}

/// Spectrogram: levels over time and frequency, laid out as an image.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spectrogram {
    /// Columns; column `x` is centred at `x * step_secs`.
    pub width: usize,
    /// Rows; row 0 is the highest frequency, as in an image.
    pub height: usize,
    /// Time between columns in seconds.
    pub step_secs: f64,
    /// Row by row `width * height` levels, 0 weakest, 255 strongest, linear in decibels.
    pub levels: Vec<u8>,
}

/// Maximum number of columns: longer audio gets longer time steps.
const MAX_COLUMNS: usize = 1 << 16;

/// Frequency from which high frequencies are raised, by 6 dB per octave: the slope of a voice's
/// source, so that upper formants are visible.
const EMPHASIS_HZ: f64 = 50.0;

/// Computes the spectrogram of an audio with a Gaussian window; returns no columns for empty audio,
/// an unusable rate or options out of range.
#[must_use]
pub fn spectrogram(samples: &[f64], rate_hz: f64, options: &SpectrogramOptions) -> Spectrogram {
    let sane = (0.001..=0.1).contains(&options.window_secs)
        && (0.0005..=10.0).contains(&options.step_secs)
        && options.max_hz > 0.0
        && options.max_hz.is_finite()
        && (1..=2048).contains(&options.height)
        && options.range_db > 0.0;
    if samples.is_empty() || !is_rate(rate_hz) || !sane {
        return Spectrogram::default();
    }
    let length_secs = samples.len() as f64 / rate_hz;
    let step_secs = options
        .step_secs
        .max(length_secs / (MAX_COLUMNS - 1) as f64);
    let width = (length_secs / step_secs) as usize + 1;
    let height = options.height;
    let window = gaussian(options.window_secs, rate_hz);
    // A bin per row at least, or rows would show the same bin twice.
    let bins_wanted = (rate_hz / options.max_hz * height as f64).min(16_384.0) as usize;
    let size = window.len().max(bins_wanted).next_power_of_two();
    let transform = RealFftPlanner::<f64>::new().plan_fft_forward(size);
    let (mut time, mut bins) = (transform.make_input_vec(), transform.make_output_vec());
    let mut work = transform.make_scratch_vec();
    let emphasis = ops::exp(-2.0 * std::f64::consts::PI * EMPHASIS_HZ / rate_hz);
    let sample = |at: usize| samples.get(at).copied().unwrap_or(0.0);
    let mut powers = vec![0.0; width * height];
    for x in 0..width {
        let centre = (x as f64 * step_secs * rate_hz).round() as usize;
        time.fill(0.0);
        for (i, w) in window.iter().enumerate() {
            if let Some(at) = (centre + i).checked_sub(window.len() / 2) {
                let before = at.checked_sub(1).map_or(0.0, sample);
                time[i] = w * (sample(at) - emphasis * before);
            }
        }
        if transform
            .process_with_scratch(&mut time, &mut bins, &mut work)
            .is_err()
        {
            return Spectrogram::default();
        }
        for row in 0..height {
            let hz = options.max_hz * (row as f64 + 0.5) / height as f64;
            let place = hz / rate_hz * size as f64;
            let low = place as usize;
            if let (Some(a), Some(b)) = (bins.get(low), bins.get(low + 1)) {
                let part = place - low as f64;
                let power = a.norm_sqr() * (1.0 - part) + b.norm_sqr() * part;
                powers[(height - 1 - row) * width + x] = power;
            }
        }
    }
    let most = powers.iter().copied().fold(0.0, f64::max);
    let level = |power: &f64| {
        let below_db = 10.0 * ops::ln(power / most) / std::f64::consts::LN_10;
        // Saturates: below the range, silence and NaN are 0.
        (255.0 * (1.0 + below_db / options.range_db)).round() as u8
    };
    Spectrogram {
        width,
        height,
        step_secs,
        levels: powers.iter().map(level).collect(),
    }
}

/// Returns a Gaussian of the given effective length, twice that long and 0 at its ends; its
/// bandwidth at −3 dB is 1.3 over the length.
fn gaussian(length_secs: f64, rate_hz: f64) -> Vec<f64> {
    let half = (length_secs * rate_hz).round().max(1.0) as usize;
    let edge = ops::exp(-12.0);
    (0..=2 * half)
        .map(|i| {
            let place = (i as f64 - half as f64) / half as f64;
            (ops::exp(-12.0 * place * place) - edge) / (1.0 - edge)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tone_is_a_line_at_its_frequency() {
        let rate = 16_000.0;
        let tone: Vec<f64> = (0..16_000)
            .map(|i| ops::sin(2.0 * std::f64::consts::PI * 3000.0 * f64::from(i) / rate))
            .collect();
        let made = spectrogram(&tone, rate, &SpectrogramOptions::default());
        assert_eq!((made.width, made.height), (501, 256));
        assert_eq!(made.levels.len(), 501 * 256);
        let column: Vec<u8> = (0..256).map(|y| made.levels[y * 501 + 250]).collect();
        let brightest = (0..256).max_by_key(|y| column[*y]).unwrap_or(0);
        let hz = 8000.0 * (255.5 - brightest as f64) / 256.0;
        assert!((hz - 3000.0).abs() < 40.0, "{hz}");
        // The line is 216 Hz wide at −3 dB, so 1 kHz away there is nothing.
        assert!(
            column[brightest] > 250 && column[brightest + 32] == 0,
            "the tone is bright at its frequency only"
        );
    }

    #[test]
    fn bounds_are_kept() {
        let o = SpectrogramOptions::default();
        assert_eq!(spectrogram(&[], 16_000.0, &o).width, 0);
        assert_eq!(spectrogram(&[1.0], 0.0, &o).width, 0);
        let tall = SpectrogramOptions {
            height: 1 << 40,
            ..o
        };
        assert_eq!(spectrogram(&[1.0], 16_000.0, &tall).width, 0);
        let silent = spectrogram(&[0.0; 1600], 16_000.0, &o);
        assert!(
            silent.levels.iter().all(|l| *l == 0) && silent.width == 51,
            "silence has 51 empty columns"
        );
        // 8 kHz audio has nothing above 4 kHz.
        let noise: Vec<f64> = (0..800).map(super::super::scatter).collect();
        let low = spectrogram(&noise, 8000.0, &o);
        assert!(
            low.levels[..low.width * 127].iter().all(|l| *l == 0),
            "the upper rows are empty"
        );
        assert!(
            low.levels[low.width * 130..].iter().any(|l| *l > 200),
            "the lower rows contain the noise"
        );
    }
}
