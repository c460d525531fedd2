//! The fundamental frequency, after Boersma, "Accurate short-term analysis of the
//! fundamental frequency and the harmonics-to-noise ratio of a sampled sound", Proc. of
//! the Institute of Phonetic Sciences 17 (1993), 97–110.
//!
//! A frame's autocorrelation is divided by that of its window, which makes the height of
//! a peak the share of the sound that repeats; the best path through the frames' peaks
//! pays for jumps. Constants are the paper's (section 5) or, where it has none, those of
//! the programme that its author maintains; they say so.

use std::f64::consts::PI;
use std::sync::Arc;

use raconteur_base::ops;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex, num_complex::Complex};

use super::is_rate;

/// What the analysis is to assume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PitchOptions {
    /// Lowest frequency sought, in hertz; three periods of it make a window. Default 60.
    pub min_hz: f64,
    /// Highest frequency sought, in hertz. Default 500.
    pub max_hz: f64,
    /// Time between frames, in seconds, at least 0.001. Default 0.01.
    pub step_secs: f64,
    /// A frame whose peak is below this share of the whole sound's peak counts as
    /// silence. Default 0.03.
    pub silence_threshold: f64,
    /// Strength that the aperiodic candidate has, 0..1. Default 0.45.
    pub voicing_threshold: f64,
    /// Preference for the higher of two candidates, per octave. Default 0.01.
    pub octave_cost: f64,
    /// Price of a jump of one octave within 10 ms. Default 0.35.
    pub octave_jump_cost: f64,
    /// Price of going from voiced to unvoiced or back within 10 ms. Default 0.14.
    pub voicing_cost: f64,
}

impl Default for PitchOptions {
    fn default() -> Self {
        Self {
            min_hz: 60.0,
            max_hz: 500.0,
            step_secs: 0.01,
            silence_threshold: 0.03,
            voicing_threshold: 0.45,
            octave_cost: 0.01,
            octave_jump_cost: 0.35,
            voicing_cost: 0.14,
        }
    }
}

/// The fundamental frequency along a sound. Frame `i` is centred at `i * step_secs`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PitchTrack {
    /// Time between frames, in seconds.
    pub step_secs: f64,
    /// Per frame the frequency in hertz, 0 where the sound is unvoiced.
    pub hz: Vec<f64>,
    /// Per frame the share of the sound that repeats, 0..1: that of the frequency given,
    /// or for an unvoiced frame that of its best candidate.
    pub strength: Vec<f64>,
}

impl PitchTrack {
    /// Frequency at a time, in hertz: between voiced frames along a straight line in
    /// log frequency, beside an unvoiced frame that of the nearer frame, 0 where that
    /// is unvoiced or beyond the track.
    #[must_use]
    pub fn hz_at(&self, secs: f64) -> f64 {
        let place = secs / self.step_secs;
        if !place.is_finite() || place < -0.5 {
            return 0.0;
        }
        let place = place.max(0.0);
        let before = place as usize;
        let Some(&low) = self.hz.get(before) else {
            return 0.0;
        };
        let high = self.hz.get(before + 1).copied().unwrap_or(0.0);
        let part = place - before as f64;
        if low > 0.0 && high > 0.0 {
            low * ops::pow(high / low, part)
        } else if part < 0.5 {
            low
        } else {
            high
        }
    }

    /// Frequency at a time or, where that is unvoiced, at the nearest voiced frame
    /// within `reach_secs`; 0 without one.
    #[must_use]
    pub fn hz_near(&self, secs: f64, reach_secs: f64) -> f64 {
        let here = self.hz_at(secs);
        if here > 0.0 || self.hz.is_empty() || !secs.is_finite() {
            return here;
        }
        let last = self.hz.len() - 1;
        let frame = ((secs / self.step_secs).round().max(0.0) as usize).min(last);
        let reach = ((reach_secs / self.step_secs).max(0.0) as usize).min(last);
        (1..=reach)
            .flat_map(|k| [frame.checked_sub(k), Some(frame + k)])
            .flatten()
            .filter_map(|i| self.hz.get(i).copied())
            .find(|&hz| hz > 0.0)
            .unwrap_or(0.0)
    }

    /// The voiced stretches as frames: first and one past the last.
    #[must_use]
    pub fn voiced_runs(&self) -> Vec<(usize, usize)> {
        let mut runs = Vec::new();
        let mut start = None;
        for (i, &hz) in self.hz.iter().chain([&0.0]).enumerate() {
            match (hz > 0.0, start) {
                (true, None) => start = Some(i),
                (false, Some(first)) => {
                    runs.push((first, i));
                    start = None;
                }
                _ => {}
            }
        }
        runs
    }

    /// Share of the frames within a span that are voiced, 0..1; a span that holds no
    /// frame is judged by the frame nearest its middle.
    #[must_use]
    pub fn voiced_share(&self, start_secs: f64, end_secs: f64) -> f64 {
        let first = (start_secs / self.step_secs).ceil().max(0.0) as usize;
        let past = ((end_secs / self.step_secs).floor() + 1.0).max(0.0) as usize;
        let past = past.min(self.hz.len());
        if first >= past {
            return if self.hz_at(0.5 * (start_secs + end_secs)) > 0.0 {
                1.0
            } else {
                0.0
            };
        }
        let voiced = self.hz[first..past].iter().filter(|&&hz| hz > 0.0).count();
        voiced as f64 / (past - first) as f64
    }
}

/// Frequency along a sound. Times before the first and after the last sample count as
/// silence. Sound without a sample, of an unusable rate, or options without a range give
/// a track without frames.
#[must_use]
pub fn track(samples: &[f64], rate_hz: f64, options: &PitchOptions) -> PitchTrack {
    let step_secs = options.step_secs.clamp(0.001, 1.0);
    let none = PitchTrack {
        step_secs,
        ..PitchTrack::default()
    };
    let in_range =
        options.min_hz >= 20.0 && options.max_hz > options.min_hz && options.max_hz.is_finite();
    if samples.is_empty() || !is_rate(rate_hz) || !in_range || !step_secs.is_finite() {
        return none;
    }
    let mean = samples.iter().sum::<f64>() / samples.len() as f64;
    let peak = samples.iter().map(|x| (x - mean).abs()).fold(0.0, f64::max);
    let frames = (samples.len() as f64 / (step_secs * rate_hz)) as usize + 1;
    let mut analyser = Analyser::new(rate_hz, options);
    let candidates: Vec<Vec<Candidate>> = (0..frames)
        .map(|i| {
            let centre = (i as f64 * step_secs * rate_hz).round() as usize;
            analyser.frame(samples, centre, peak)
        })
        .collect();
    let chosen = best_path(&candidates, options, step_secs);
    let mut found = none;
    for (frame, &k) in candidates.iter().zip(&chosen) {
        let best = frame[k];
        found.hz.push(best.hz);
        found.strength.push(if best.hz > 0.0 {
            best.periodic
        } else {
            frame.iter().map(|c| c.periodic).fold(0.0, f64::max)
        });
    }
    found
}

/// One explanation of a frame.
#[derive(Clone, Copy)]
struct Candidate {
    /// 0 for the aperiodic one.
    hz: f64,
    /// Base-2 logarithm of `hz`: transitions need it often.
    octaves: f64,
    /// Height of the autocorrelation's peak, 0..1; 0 for the aperiodic one.
    periodic: f64,
    /// What the path adds up: height less octave cost, or the aperiodic strength.
    strength: f64,
}

/// Most candidates kept per frame, the aperiodic one included (the programme's 15).
const MAX_CANDIDATES: usize = 15;

/// Samples on either side that the interpolation between lags looks at.
const SINC_DEPTH: usize = 20;

struct Analyser {
    options: PitchOptions,
    rate_hz: f64,
    window: Vec<f64>,
    /// One over the window's normalised autocorrelation, per lag.
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
    fn new(rate_hz: f64, options: &PitchOptions) -> Self {
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

    /// Replaces `lags` by the autocorrelation of `time`, which is used up; 1 at lag 0.
    /// Gives whether there was anything to correlate.
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

    fn frame(&mut self, samples: &[f64], centre: usize, global_peak: f64) -> Vec<Candidate> {
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
            // A peak below half the threshold cannot become the best even where the
            // samples beside it flatter it least.
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

    /// The peak near a lag, found between the samples.
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
        // Above 1 only by noise in very short lags: mirrored, as the programme does.
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

    /// The autocorrelation at a lag between samples, equation (22): a sinc within a
    /// raised cosine.
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

/// Where a parabola through three equally spaced values has its top, in spacings from
/// the middle; none where it has none.
fn vertex(left: f64, middle: f64, right: f64) -> Option<f64> {
    let bend = left - 2.0 * middle + right;
    (bend < 0.0).then(|| 0.5 * (left - right) / bend)
}

/// The candidates of the cheapest path, one index per frame (the paper's section 3.5,
/// by dynamic programming).
fn best_path(frames: &[Vec<Candidate>], options: &PitchOptions, step_secs: f64) -> Vec<usize> {
    // The paper's costs are for frames 10 ms apart.
    let scale = 0.01 / step_secs;
    let jump = options.octave_jump_cost * scale;
    let voicing = options.voicing_cost * scale;
    let mut from: Vec<Vec<usize>> = Vec::with_capacity(frames.len());
    let mut score: Vec<f64> = Vec::new();
    for (i, frame) in frames.iter().enumerate() {
        let (mut next, mut back) = (Vec::new(), Vec::new());
        for here in frame {
            let mut best = (0, if i == 0 { 0.0 } else { f64::NEG_INFINITY });
            let before = if i == 0 { &[][..] } else { &frames[i - 1][..] };
            for (k, there) in before.iter().enumerate() {
                let cost = match (here.hz > 0.0, there.hz > 0.0) {
                    (true, true) => jump * (here.octaves - there.octaves).abs(),
                    (false, false) => 0.0,
                    _ => voicing,
                };
                if score[k] - cost > best.1 {
                    best = (k, score[k] - cost);
                }
            }
            next.push(best.1 + here.strength);
            back.push(best.0);
        }
        score = next;
        from.push(back);
    }
    let mut path = vec![0; frames.len()];
    let mut at = (0..score.len())
        .max_by(|&a, &b| score[a].total_cmp(&score[b]))
        .unwrap_or(0);
    for i in (0..frames.len()).rev() {
        path[i] = at;
        at = from[i][at];
    }
    path
}

/// The frequency with limits that suit the voice: a first pass finds its middle, a second one
/// seeks around that (De Looze and Hirst, Speech Prosody 2008: from three quarters of the lower
/// quartile to one and a half of the upper one; wider here, for melodies are changed).
#[must_use]
pub fn track_voice(samples: &[f64], rate_hz: f64, step_secs: f64) -> PitchTrack {
    let options = PitchOptions {
        step_secs,
        ..PitchOptions::default()
    };
    let first = track(samples, rate_hz, &options);
    let mut hz: Vec<f64> = first.hz.iter().copied().filter(|hz| *hz > 0.0).collect();
    if hz.len() < 20 {
        return first;
    }
    hz.sort_by(f64::total_cmp);
    let quartile = |share: usize| hz[hz.len() * share / 4];
    let narrowed = PitchOptions {
        min_hz: (0.6 * quartile(1)).max(options.min_hz),
        max_hz: (2.0 * quartile(3)).min(options.max_hz),
        ..options
    };
    track(samples, rate_hz, &narrowed)
}

#[cfg(test)]
mod tests {
    use super::super::testing::{self, Segment};
    use super::*;

    #[test]
    fn a_steady_tone_is_measured_to_a_fifth_of_a_percent() {
        for rate in [8000.0, 16_000.0, 22_050.0, 44_100.0, 48_000.0] {
            for hz in [70.0, 123.4, 217.0, 333.3, 440.0, 491.0] {
                let sound = testing::vowel(rate, 0.5, |_| hz);
                let found = track(&sound, rate, &PitchOptions::default());
                for (i, &f) in found.hz.iter().enumerate().skip(5).take(40) {
                    assert!((f / hz - 1.0).abs() < 0.002, "{rate} {hz}: frame {i} {f}");
                }
            }
        }
    }

    #[test]
    fn glides_in_noise_are_followed_and_voicing_is_told() {
        for (rate, noise) in [(16_000.0, 0.0), (16_000.0, 0.01), (22_050.0, 0.03)] {
            let parts = [
                Segment::silence(0.2),
                Segment::vowel(0.6, 90.0, 160.0),
                Segment::noise(0.2),
                Segment::vowel(0.5, 240.0, 130.0),
                Segment::silence(0.15),
                Segment::vowel(0.8, 200.0, 400.0),
                Segment::noise(0.25),
            ];
            let (mut sound, hz) = testing::utterance(rate, &parts);
            for (i, x) in sound.iter_mut().enumerate() {
                *x += noise * super::super::scatter(i as u64 + 77);
            }
            let found = track(&sound, rate, &PitchOptions::default());
            let (mut wrong, mut judged, mut worst) = (0, 0, 0.0_f64);
            for (i, &f) in found.hz.iter().enumerate() {
                let truth = |d: f64| hz.hz_at(i as f64 * 0.01 + d);
                // Frames that straddle an edge are neither right nor wrong.
                if (truth(-0.012) > 0.0) != (truth(0.012) > 0.0) {
                    continue;
                }
                judged += 1;
                wrong += usize::from((f > 0.0) != (truth(0.0) > 0.0));
                // Over a glide a window sees the mean of its reach; edges see half.
                if f > 0.0 && truth(-0.03) > 0.0 && truth(0.03) > 0.0 {
                    worst = worst.max((f / truth(0.0) - 1.0).abs());
                }
            }
            assert!(judged > 200 && wrong * 50 < judged, "{wrong} of {judged}");
            assert!(worst < 0.01, "noise {noise}: {worst}");
        }
    }

    #[test]
    fn what_is_no_sound_has_no_pitch_and_no_panic() {
        let o = PitchOptions::default();
        assert!(track(&[], 16_000.0, &o).hz.is_empty());
        assert!(track(&[0.0; 10], f64::NAN, &o).hz.is_empty());
        assert_eq!(track(&[0.0; 1600], 16_000.0, &o).hz, vec![0.0; 11]);
        let broken = track(&[f64::NAN; 1600], 16_000.0, &o);
        assert!(broken.hz.iter().all(|&hz| hz == 0.0));
        let noise: Vec<f64> = (0..16_000).map(super::super::scatter).collect();
        let found = track(&noise, 16_000.0, &o);
        let voiced = found.hz.iter().filter(|&&hz| hz > 0.0).count();
        assert!(
            voiced * 50 < found.hz.len(),
            "{voiced} voiced frames of noise"
        );
    }

    #[test]
    fn a_track_is_asked_between_its_frames() {
        let track = PitchTrack {
            step_secs: 0.01,
            hz: vec![0.0, 100.0, 400.0, 0.0, 0.0],
            strength: vec![0.0; 5],
        };
        assert!((track.hz_at(0.015) - 200.0).abs() < 1e-9);
        assert_eq!(track.hz_at(0.006), 100.0);
        assert_eq!(track.hz_at(0.026), 0.0);
        assert_eq!(track.hz_near(0.04, 0.03), 400.0);
        assert_eq!(track.hz_near(0.04, 0.01), 0.0);
        assert_eq!(track.voiced_runs(), vec![(1, 3)]);
        assert_eq!(track.voiced_share(0.0, 0.04), 0.4);
        assert_eq!(track.voiced_share(0.014, 0.016), 1.0);
        assert_eq!(track.hz_at(f64::NAN), 0.0);
        assert_eq!(track.hz_at(9.0), 0.0);
    }
}
