//! Candidates of a frame: peaks of its autocorrelation.

use std::f64::consts::PI;
use std::sync::Arc;

use raconteur_base::ops;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex, num_complex::Complex};

use super::PitchOptions;

/// Candidate pitch of a frame: a frequency, or aperiodicity.
#[derive(Clone, Copy)]
pub(super) struct Candidate {
    /// 0 for the aperiodic one.
    pub(super) hz: f64,
    /// Base-2 logarithm of `hz`: transitions need it often.
    pub(super) octaves: f64,
    /// Height of the autocorrelation's peak, 0..1; 0 for the aperiodic one.
    pub(super) periodic: f64,
    /// Score added by the path: height less octave cost, or the aperiodic strength.
    pub(super) strength: f64,
}

/// Maximum number of candidates per frame, including the aperiodic one (15 in the original
/// program).
const MAX_CANDIDATES: usize = 15;

/// Number of samples on either side used by the interpolation between lags.
const SINC_DEPTH: usize = 20;

pub(super) struct Analyser {
    options: PitchOptions,
    rate_hz: f64,
    window: Vec<f64>,
    /// Inverse of the window's normalised autocorrelation, per lag.
    unwindow: Vec<f64>,
    /// Samples of half the longest period: the reach of the local mean and peak.
    half_period: usize,
    min_lag: usize,
    max_lag: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    time: Vec<f64>,
    spectrum: Vec<Complex<f64>>,
    work: Vec<Complex<f64>>,
    lags: Vec<f64>,
}

impl Analyser {
    pub(super) fn new(rate_hz: f64, options: &PitchOptions) -> Self {
        let length = (3.0 * rate_hz / options.min_hz).round() as usize;
        let max_lag = (rate_hz / options.min_hz).ceil() as usize;
        let min_lag = ((rate_hz / options.max_hz).floor() as usize).max(2);
        // As long as no lag in use wraps round into the other end.
        let size = (length + max_lag + SINC_DEPTH + 2).next_power_of_two();
        let mut planner = RealFftPlanner::<f64>::new();
        let forward = planner.plan_fft_forward(size);
        let inverse = planner.plan_fft_inverse(size);
        let work_len = forward.get_scratch_len().max(inverse.get_scratch_len());
        let window = (0..length)
            .map(|i| 0.5 - 0.5 * ops::cos(2.0 * PI * (i as f64 + 0.5) / length as f64))
            .collect::<Vec<_>>();
        let mut made = Self {
            options: *options,
            rate_hz,
            unwindow: Vec::new(),
            half_period: (0.5 * rate_hz / options.min_hz).ceil() as usize,
            min_lag,
            max_lag,
            time: vec![0.0; size],
            spectrum: forward.make_output_vec(),
            work: vec![Complex::default(); work_len],
            lags: vec![0.0; max_lag + SINC_DEPTH + 2],
            window,
            forward,
            inverse,
        };
        made.time[..length].copy_from_slice(&made.window);
        made.autocorrelate();
        made.unwindow = made.lags.iter().map(|r| 1.0 / r.max(1e-6)).collect();
        made
    }

    /// Replaces `lags` by the autocorrelation of `time`, which is overwritten; 1 at lag 0. Returns
    /// true if there was a signal.
    fn autocorrelate(&mut self) -> bool {
        let (forward, inverse) = (&self.forward, &self.inverse);
        let done = forward
            .process_with_scratch(&mut self.time, &mut self.spectrum, &mut self.work)
            .is_ok();
        for bin in &mut self.spectrum {
            *bin = Complex::new(bin.norm_sqr(), 0.0);
        }
        let done = done
            && inverse
                .process_with_scratch(&mut self.spectrum, &mut self.time, &mut self.work)
                .is_ok();
        let power = self.time[0];
        if !done || !power.is_finite() || power <= 0.0 {
            return false;
        }
        for (lag, value) in self.lags.iter_mut().zip(&self.time) {
            *lag = value / power;
        }
        true
    }

    pub(super) fn frame(
        &mut self,
        samples: &[f64],
        centre: usize,
        global_peak: f64,
    ) -> Vec<Candidate> {
        let local_mean = {
            let from = centre.saturating_sub(2 * self.half_period);
            let to = (centre + 2 * self.half_period).min(samples.len());
            let span = &samples[from.min(to)..to];
            span.iter().sum::<f64>() / span.len().max(1) as f64
        };
        let start = centre as isize - (self.window.len() / 2) as isize;
        self.time.fill(0.0);
        let (mut local_peak, mid) = (0.0_f64, self.window.len() / 2);
        for (i, w) in self.window.iter().enumerate() {
            let at = start + i as isize;
            if at < 0 || at as usize >= samples.len() {
                continue;
            }
            let value = samples[at as usize] - local_mean;
            self.time[i] = value * w;
            if i.abs_diff(mid) <= self.half_period {
                local_peak = local_peak.max(value.abs());
            }
        }
        let loud = if global_peak > 0.0 {
            (local_peak / global_peak).min(1.0)
        } else {
            0.0
        };
        let o = &self.options;
        // Equation (23) of the paper.
        let quiet = 2.0 - loud / (o.silence_threshold.max(1e-6) / (1.0 + o.voicing_threshold));
        let mut found = vec![Candidate {
            hz: 0.0,
            octaves: 0.0,
            periodic: 0.0,
            strength: o.voicing_threshold + quiet.max(0.0),
        }];
        if loud <= 0.0 || !self.autocorrelate() {
            return found;
        }
        for (lag, scale) in self.lags.iter_mut().zip(&self.unwindow) {
            *lag *= scale;
        }
        for lag in self.min_lag..=self.max_lag {
            let [left, here, right] = [self.lags[lag - 1], self.lags[lag], self.lags[lag + 1]];
            // A peak below half the threshold cannot become the best even where the adjacent
            // samples reduce it most.
            if here <= 0.5 * self.options.voicing_threshold || here < left || here <= right {
                continue;
            }
            found.extend(self.candidate(lag));
        }
        if found.len() > MAX_CANDIDATES {
            found[1..].sort_by(|a, b| b.strength.total_cmp(&a.strength));
            found.truncate(MAX_CANDIDATES);
        }
        found
    }

    /// Returns the autocorrelation peak near a lag, located between the samples; `None` if there is
    /// none.
    fn candidate(&self, lag: usize) -> Option<Candidate> {
        let [a, b, c] = [self.lags[lag - 1], self.lags[lag], self.lags[lag + 1]];
        let (mut place, mut height) = (lag as f64 + vertex(a, b, c)?, b);
        // The parabola through neighbours is wrong by its fourth derivative; closer
        // points of the interpolated curve make that error small.
        for reach in [0.25, 0.05] {
            let [a, b, c] = [-reach, 0.0, reach].map(|d| self.between(place + d));
            height = b;
            match vertex(a, b, c) {
                Some(v) if v.abs() <= 4.0 => place += v * reach,
                _ => break,
            }
        }
        let hz = self.rate_hz / place;
        if !(self.options.min_hz..=self.options.max_hz).contains(&hz) {
            return None;
        }
        // Values above 1 result only from noise at very short lags; they are mirrored, as in the
        // original program.
        let periodic = if height > 1.0 { 1.0 / height } else { height };
        let octaves = ops::ln(hz) / std::f64::consts::LN_2;
        let above = ops::ln(hz / self.options.min_hz) / std::f64::consts::LN_2;
        // Equation (24): the cost is of the octaves above the lowest frequency, with
        // the sign that favours the higher.
        let strength = periodic + self.options.octave_cost * above;
        Some(Candidate {
            hz,
            octaves,
            periodic,
            strength,
        })
    }

    /// Returns the autocorrelation at a lag between samples, equation (22): a sinc within a raised
    /// cosine.
    fn between(&self, place: f64) -> f64 {
        let low = place.floor();
        let part = place - low;
        let low = low as usize;
        if part < 1e-9 {
            return self.lags[low.min(self.lags.len() - 1)];
        }
        let width = SINC_DEPTH as f64 + 1.0;
        let sine = ops::sin(PI * part) / PI;
        // The window's cosine for all taps by turning one angle.
        let (turn_sin, turn_cos) = ops::sincos(PI / width);
        let (mut s, mut c) = ops::sincos(PI * (part + SINC_DEPTH as f64) / width);
        let (mut sum, mut weights) = (0.0, 0.0);
        for tap in 0..=2 * SINC_DEPTH {
            let distance = part + SINC_DEPTH as f64 - tap as f64;
            let sign = if (tap + SINC_DEPTH).is_multiple_of(2) {
                1.0
            } else {
                -1.0
            };
            if distance.abs() < width {
                let weight = sign * sine / distance * (0.5 + 0.5 * c);
                let lag = (low + tap).abs_diff(SINC_DEPTH);
                sum += weight * self.lags.get(lag).copied().unwrap_or(0.0);
                weights += weight;
            }
            (s, c) = (s * turn_cos - c * turn_sin, c * turn_cos + s * turn_sin);
        }
        sum / weights
    }
}

/// Returns the vertex of a parabola through three equally spaced values, in spacings from the
/// middle; `None` if there is none.
fn vertex(left: f64, middle: f64, right: f64) -> Option<f64> {
    let bend = left - 2.0 * middle + right;
    (bend < 0.0).then(|| 0.5 * (left - right) / bend)
}
