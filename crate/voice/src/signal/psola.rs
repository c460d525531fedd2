//! Changes of duration, pitch and gain by pitch-synchronous overlap and add in the time domain
//! (TD-PSOLA: Moulines and Charpentier, Speech Communication 9 (1990) 453–467,
//! doi:10.1016/0167-6393(90)90021-Z).
//!
//! Voiced audio is split into grains of two periods around its epochs, which are placed at the
//! wanted distance. Differences from the paper: grains are placed between samples (a period of
//! whole samples is rough at high voices); a grain's gain is the root of its new distance over its
//! old, which preserves the power; and unvoiced audio is not repeated grain by grain, which would
//! give it a pitch, but continues unchanged until it is some milliseconds off, then skips to the
//! nearby position that fits best (the idea of WSOLA: Verhelst and Roelands, ICASSP 1993,
//! doi:10.1109/ICASSP.1993.319366).

use std::f64::consts::PI;

use raconteur_base::ops;

use super::rigid::time_map;
use super::{PitchTrack, TimeMap, bursts, epochs, is_rate};

mod level;
mod taps;
#[cfg(test)]
mod tests;

use taps::Taps;

/// Changes of duration, pitch and gain to apply to an audio. Times are those of the input audio,
/// seconds.
pub struct Change<'a> {
    /// Local duration factor at a time; clamped to 0.2..5.
    pub duration: &'a dyn Fn(f64) -> f64,
    /// Target frequency in hertz, from a time and the current frequency; clamped to a quarter and
    /// four times that. Called only in voiced sound.
    pub pitch: &'a dyn Fn(f64, f64) -> f64,
    /// Amplitude factor at a time; clamped to 0..100 (40 dB). Jumps become ramps of
    /// [`GAIN_RAMP_SECS`].
    pub gain: &'a dyn Fn(f64) -> f64,
    /// Spans (start, end) in seconds that keep their duration, such as bursts; their share of a
    /// stretch goes to their surroundings.
    pub rigid: &'a [(f64, f64)],
}

/// Ramp duration of a gain jump, in seconds: a shorter one is audible as a click.
pub const GAIN_RAMP_SECS: f64 = 0.01;

/// Audio after a change, with the map of its times.
#[derive(Clone, Debug, PartialEq)]
pub struct Changed {
    /// Samples, at the input rate. They may exceed −1..1 if the input did, or if gain or lowered
    /// pitch raised the peaks: the caller must scale them.
    pub samples: Vec<f64>,
    /// Map from the times of the input sound to those of the output.
    pub times: TimeMap,
}

/// Returns the changed sound. A sound of an unusable rate is returned unchanged; without changes
/// the output is bit-identical.
///
/// `track` must be the pitch track of this audio ([`super::f0::track`]).
#[must_use]
pub fn change(samples: &[f64], rate_hz: f64, track: &PitchTrack, change: &Change<'_>) -> Changed {
    let unchanged = || Changed {
        samples: samples.to_vec(),
        times: TimeMap::identity(),
    };
    if samples.is_empty() || !is_rate(rate_hz) {
        return unchanged();
    }
    let length_secs = samples.len() as f64 / rate_hz;
    let times = time_map(length_secs, change.duration, change.rigid);
    let runs: Vec<Run> = epochs::voiced(samples, rate_hz, track)
        .into_iter()
        .map(|marks| Run::new(marks, rate_hz, track, change.pitch))
        .collect();
    let same_times = times
        .knees()
        .windows(2)
        .all(|k| ((k[1].1 - k[0].1) / (k[1].0 - k[0].0) - 1.0).abs() < 1e-9);
    let same_pitch = runs.iter().all(|run| run.ratios.iter().all(|r| *r == 1.0));
    let mut changed = if same_times && same_pitch {
        unchanged()
    } else {
        // Bursts must not be doubled even where they may be stretched. Shortening doubles nothing,
        // and protecting them there would move splices to worse positions.
        let free = |span: &(f64, f64)| !change.rigid.iter().any(|r| r.0 < span.1 && r.1 > span.0);
        let stretched =
            |span: &(f64, f64)| times.after(span.1) - times.after(span.0) > span.1 - span.0;
        let bursts = bursts::rigid_spans(&bursts::all(samples, rate_hz));
        let mut guarded = change.rigid.to_vec();
        guarded.extend(bursts.iter().filter(|b| free(b) && stretched(b)));
        let mut maker = Maker::new(samples, rate_hz, &times, &guarded);
        maker.overlap_add(&runs);
        let out = maker.out;
        // Harmonics that moved over a formant made the sound louder or softer.
        let moved: Vec<(f64, f64)> = runs
            .iter()
            .filter(|run| run.ratios.iter().any(|r| *r != 1.0))
            .filter_map(|run| Some((*run.marks.first()?, *run.marks.last()?)))
            .map(|(from, to)| (times.after(from / rate_hz), times.after(to / rate_hz)))
            .collect();
        let mut made = Changed {
            samples: out,
            times,
        };
        level::keep_level(&mut made, samples, rate_hz, &moved);
        made
    };
    level::apply_gain(&mut changed, rate_hz, length_secs, change.gain);
    changed
}

/// Voiced stretch: its epochs in samples and the result of each period.
struct Run {
    marks: Vec<f64>,
    /// Ratio of target to current frequency, at each epoch.
    ratios: Vec<f64>,
}

impl Run {
    fn new(
        marks: Vec<f64>,
        rate_hz: f64,
        track: &PitchTrack,
        pitch: &dyn Fn(f64, f64) -> f64,
    ) -> Self {
        let ratios = marks
            .iter()
            .map(|at| {
                let secs = at / rate_hz;
                let now = track.hz_near(secs, 0.03);
                let ratio = pitch(secs, now) / now;
                if ratio.is_finite() {
                    ratio.clamp(0.25, 4.0)
                } else {
                    1.0
                }
            })
            .collect();
        Self { marks, ratios }
    }

    /// Returns the period after a mark (for the last mark, the period before it), samples.
    fn period(&self, k: usize) -> f64 {
        let low = k.min(self.marks.len() - 2);
        self.marks[low + 1] - self.marks[low]
    }

    /// Returns the epoch nearest to a position.
    fn nearest(&self, at: f64) -> usize {
        let above = self.marks.partition_point(|m| *m < at);
        match above.checked_sub(1) {
            Some(below) if above == self.marks.len() => below,
            Some(below) if at - self.marks[below] < self.marks[above] - at => below,
            _ => above,
        }
    }
}

/// Grain of the sound and its target position, in samples.
#[derive(Clone, Copy)]
struct Grain {
    /// Centre in the input sound.
    source: f64,
    /// Centre of the grain in the new audio, samples.
    place: f64,
    /// Half widths of the grain's window if its neighbour belongs to the same voiced run, samples.
    left: f64,
    right: f64,
    gain: f64,
    /// The voiced run that it is of.
    run: Option<usize>,
}

impl Grain {
    fn shift(&self) -> f64 {
        self.place - self.source
    }
}

/// Maximum lead and lag of unvoiced sound before it is spliced, in seconds, while it is stretched:
/// hardly any lead, because the splice would go back and repeat sound that had started too early,
/// especially a burst.
const STRETCHED_SECS: (f64, f64) = (0.003, 0.0205);
/// Maximum lead and lag of unvoiced audio before it is spliced, seconds, while it is shortened:
/// splices only omit audio.
const SHORTENED_SECS: (f64, f64) = (0.011, 0.0125);

/// Maximum level (as power) of sound repeated by a splice, relative to the current level: the end
/// of a vowel or a burst, repeated in the following silence, is a click.
const LOUDER: f64 = 3.0;

/// Power relative to the sound's mean below which nothing counts as loud.
const QUIET: f64 = 0.0003;

/// Maximum shift if a splice would double or lose a guarded span or repeat loud sound.
const FORCED_SECS: f64 = 0.04;

/// Minimum jump of a splice, in seconds: noise overlapped with itself shortly later sounds, and
/// measures, like a tone of that period. Jumps of 2 to 15 ms gave stretched fricatives pitches of
/// 62 to 490 Hz; the period of this one is longer than that of any voice in the analysis range.
const LEAP_SECS: f64 = 0.0175;

struct Maker<'a> {
    samples: &'a [f64],
    rate_hz: f64,
    times: &'a TimeMap,
    /// Spans that no splice may double or lose, in samples.
    guarded: Vec<(f64, f64)>,
    /// Sum of squares over two unvoiced steps below which repetition is inaudible.
    quiet: f64,
    out: Vec<f64>,
}

impl<'a> Maker<'a> {
    fn new(samples: &'a [f64], rate_hz: f64, times: &'a TimeMap, guarded: &[(f64, f64)]) -> Self {
        let end = times.after(samples.len() as f64 / rate_hz);
        let mean = samples.iter().map(|x| x * x).sum::<f64>() / samples.len().max(1) as f64;
        Self {
            quiet: QUIET * mean * 2.0 * epochs::UNVOICED_STEP_SECS * rate_hz,
            samples,
            rate_hz,
            times,
            guarded: guarded
                .iter()
                .map(|r| (r.0 * rate_hz, r.1 * rate_hz))
                .collect(),
            out: vec![0.0; (end * rate_hz).round() as usize],
        }
    }

    fn after(&self, at: f64) -> f64 {
        self.times.after(at / self.rate_hz) * self.rate_hz
    }

    fn before(&self, at: f64) -> f64 {
        self.times.before(at / self.rate_hz) * self.rate_hz
    }

    /// Lays all grains and adds them up.
    fn overlap_add(&mut self, runs: &[Run]) {
        let edge = |source: f64, place: f64| Grain {
            source,
            place,
            left: 0.0,
            right: 0.0,
            gain: 1.0,
            run: None,
        };
        let mut grains = vec![edge(0.0, 0.0)];
        for (index, run) in runs.iter().enumerate() {
            let (Some(&first), Some(&last)) = (run.marks.first(), run.marks.last()) else {
                continue;
            };
            let (mut place, end) = (self.after(first), self.after(last));
            self.lay_unvoiced(&mut grains, place);
            while place <= end + 1e-3 {
                let k = run.nearest(self.before(place));
                let ratio = run.ratios[k];
                let (right, left) = (run.period(k), run.period(k.saturating_sub(1)));
                grains.push(Grain {
                    source: run.marks[k],
                    place,
                    left,
                    right,
                    gain: (1.0 / ratio).sqrt(),
                    run: Some(index),
                });
                place += (right / ratio).max(1.0);
            }
        }
        let length = self.out.len() as f64;
        self.lay_unvoiced(&mut grains, length);
        grains.push(edge(self.samples.len() as f64, length));
        for pair in grains.windows(2) {
            self.add(&pair[0], &pair[1]);
        }
    }

    /// Adds grains of unvoiced sound from the last one up to a position.
    fn lay_unvoiced(&self, grains: &mut Vec<Grain>, to: f64) {
        let Some(mut last) = grains.last().copied() else {
            return;
        };
        let step = epochs::UNVOICED_STEP_SECS * self.rate_hz;
        for place in epochs::between(last.place, to, step) {
            let shift = match self.guarded_ahead(place) {
                Some(shift) => shift,
                None => self.unvoiced_shift(&last, place, place - self.before(place)),
            };
            last = Grain {
                source: place - shift,
                place,
                left: step,
                right: step,
                gain: 1.0,
                run: None,
            };
            grains.push(last);
        }
    }

    /// Returns the shift of the guarded span that begins one to four steps after a position: sound
    /// spliced with it there enters the span at its right time and unbroken.
    fn guarded_ahead(&self, place: f64) -> Option<f64> {
        let step = epochs::UNVOICED_STEP_SECS * self.rate_hz;
        self.guarded.iter().find_map(|r| {
            let start = self.after(r.0);
            let ahead = start - place;
            (ahead > step && ahead < 4.0 * step).then_some((start - r.0).round())
        })
    }

    /// Returns the shift of an unvoiced grain, samples: that of the previous grain while it stays
    /// within the limits.
    fn unvoiced_shift(&self, last: &Grain, place: f64, wanted: f64) -> f64 {
        let step = epochs::UNVOICED_STEP_SECS * self.rate_hz;
        let stretched = self.before(place + step) - self.before(place) < step;
        let (ahead, behind) = if stretched {
            STRETCHED_SECS
        } else {
            SHORTENED_SECS
        };
        let (ahead, behind) = (ahead * self.rate_hz, behind * self.rate_hz);
        // The delay of the audio if it continued unchanged.
        let late = last.shift() - wanted;
        if (-ahead..=behind).contains(&late) {
            return last.shift();
        }
        // The interval that would be repeated or omitted.
        let leap = LEAP_SECS * self.rate_hz;
        let (low, high) = if late > 0.0 {
            (-ahead, behind - leap)
        } else {
            (leap - ahead, behind)
        };
        let one = place - last.shift();
        let others = (place - wanted - high, place - wanted - low);
        let touched = (one.min(others.0) - step, one.max(others.1) + step);
        let hits = |r: &(f64, f64)| r.0 < touched.1 && r.1 > touched.0;
        let (from, half) = (one.round() as isize, step as isize);
        let louder = || {
            let first = others.0.min(one).round() as isize;
            let here = self.loudest(from, from, half).max(self.quiet);
            self.loudest(first, from, half) > LOUDER * here
        };
        // The last opportunity to step back before a burst would come too early. (The same before
        // voiced audio would repeat ends of fricatives, which is worse.)
        let last_chance = || {
            let soon = one + step..one + 3.0 * step;
            self.guarded.iter().any(|r| soon.contains(&r.0))
        };
        let bad = self.guarded.iter().any(hits) || (late < 0.0 && louder() && !last_chance());
        if bad && late.abs() < FORCED_SECS * self.rate_hz {
            return last.shift();
        }
        (others.0.round() as isize..=others.1.round() as isize)
            .map(|other| (other, self.likeness(from, other, half)))
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .map_or(wanted, |best| place - best.0 as f64)
    }

    /// Returns the maximum power within half a step of a range of positions.
    fn loudest(&self, from: isize, to: isize, half: isize) -> f64 {
        (from..=to)
            .step_by(half.max(1) as usize)
            .map(|at| {
                (at - half..=at + half)
                    .map(|i| self.sample(i).powi(2))
                    .sum()
            })
            .fold(0.0, f64::max)
    }

    /// Returns the correlation of the sound around two positions, −1..1.
    fn likeness(&self, one: isize, other: isize, half: isize) -> f64 {
        let (mut ab, mut aa, mut bb) = (0.0, 0.0, 0.0);
        for d in -half..=half {
            let (a, b) = (self.sample(one + d), self.sample(other + d));
            ab += a * b;
            aa += a * a;
            bb += b * b;
        }
        if aa * bb > 0.0 {
            ab / (aa * bb).sqrt()
        } else {
            0.0
        }
    }

    fn sample(&self, at: isize) -> f64 {
        usize::try_from(at)
            .ok()
            .and_then(|i| self.samples.get(i).copied())
            .unwrap_or(0.0)
    }

    /// Adds the falling half of one grain and the rising half of the next.
    fn add(&mut self, one: &Grain, next: &Grain) {
        let gap = next.place - one.place;
        let same_run = one.run.is_some() && one.run == next.run;
        let plain = one.gain == 1.0 && next.gain == 1.0;
        if same_run && !plain {
            self.add_half(one, one.right, 1.0, |_| 1.0);
            self.add_half(next, next.left, -1.0, |_| 1.0);
            return;
        }
        // Adjacent windows: their sum depends on their similarity.
        let alike = if (one.shift() - next.shift()).abs() < 1.0 || same_run {
            1.0
        } else {
            let half = (0.5 * gap) as isize;
            let middle = one.place + 0.5 * gap;
            let at = |g: &Grain| (middle - g.shift()).round() as isize;
            self.likeness(at(one), at(next), half).clamp(0.0, 1.0)
        };
        let level = |falling: f64| {
            let rising = 1.0 - falling;
            1.0 / (falling * falling + rising * rising + 2.0 * alike * falling * rising).sqrt()
        };
        self.add_half(one, gap, 1.0, level);
        self.add_half(next, gap, -1.0, level);
    }

    /// Adds one half of a grain: from its middle onward (`side` 1) or up to it (−1).
    /// The middle sample belongs to the half onward.
    fn add_half(&mut self, grain: &Grain, width: f64, side: f64, level: impl Fn(f64) -> f64) {
        if width.is_nan() || width <= 0.0 {
            return;
        }
        let (from, to) = if side > 0.0 {
            (grain.place, grain.place + width)
        } else {
            (grain.place - width, grain.place)
        };
        let from = from.ceil().max(0.0) as usize;
        let to = (to.ceil().max(0.0) as usize).min(self.out.len());
        let whole = grain.shift().round();
        let taps = Taps::new(grain.shift() - whole);
        for i in from..to {
            let window = 0.5 + 0.5 * ops::cos(PI * (i as f64 - grain.place) / width);
            let value = taps.apply(i as isize - whole as isize, |at| self.sample(at));
            self.out[i] += grain.gain * window * level(window) * value;
        }
    }
}
