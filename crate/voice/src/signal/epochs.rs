//! Glottal epochs: one mark per period, at the same phase of each.
//!
//! The marks are peaks of the audio below about 1 kHz, of the polarity that dominates the whole
//! audio. Among the peaks of a voiced interval, dynamic programming selects the cheapest path, as
//! Talkin chooses epochs ("Voicing epoch determination with dynamic programming", JASA 85 (1989)
//! S149, doi:10.1121/1.2026823), with different costs: low peaks, steps that differ from the period
//! of the pitch track, and periods that differ from the previous one.

use std::f64::consts::PI;

use raconteur_base::ops;

use super::{PitchTrack, is_rate, scatter};

/// Epoch (pitch mark) at which audio is cut into grains for changing pitch and duration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Epoch {
    /// Time of the epoch from the start of the signal, seconds.
    pub secs: f64,
    /// True if it marks a glottal period; otherwise it only divides unvoiced audio.
    pub voiced: bool,
}

/// Mean distance of marks in unvoiced sound, in seconds.
pub const UNVOICED_STEP_SECS: f64 = 0.005;

/// Returns epochs over the whole sound in order: one per period in voiced stretches of the track,
/// elsewhere one about every 5 ms, irregular so that noise cut there gets no pitch.
#[must_use]
pub fn find(samples: &[f64], rate_hz: f64, track: &PitchTrack) -> Vec<Epoch> {
    let mut marks = Vec::new();
    if samples.is_empty() || !is_rate(rate_hz) {
        return marks;
    }
    let mut last = 0.0;
    let stretches = voiced(samples, rate_hz, track);
    let unvoiced = |from: f64, to: f64, marks: &mut Vec<Epoch>| {
        let step = UNVOICED_STEP_SECS * rate_hz;
        marks.extend(between(from, to, step).into_iter().map(|at| Epoch {
            secs: at / rate_hz,
            voiced: false,
        }));
    };
    for stretch in &stretches {
        let Some(&first) = stretch.first() else {
            continue;
        };
        unvoiced(last, first, &mut marks);
        marks.extend(stretch.iter().map(|at| Epoch {
            secs: at / rate_hz,
            voiced: true,
        }));
        last = stretch.last().copied().unwrap_or(last);
    }
    unvoiced(last, samples.len() as f64, &mut marks);
    marks
}

/// Returns irregular positions strictly between two, about `step` apart.
pub(super) fn between(from: f64, to: f64, step: f64) -> Vec<f64> {
    let count = ((to - from) / step).round().max(1.0);
    let each = (to - from) / count;
    (1..count as u64)
        .map(|k| from + each * (k as f64 + 0.25 * scatter(k ^ (from.to_bits() >> 20))))
        .collect()
}

/// Returns the epochs of each voiced stretch as sample positions, at least three each.
pub(super) fn voiced(samples: &[f64], rate_hz: f64, track: &PitchTrack) -> Vec<Vec<f64>> {
    let step = track.step_secs * rate_hz;
    if samples.is_empty() || !is_rate(rate_hz) || step.is_nan() || step <= 0.0 {
        return Vec::new();
    }
    let mut smooth = smoothed(samples, rate_hz);
    let runs: Vec<(usize, usize)> = track
        .voiced_runs()
        .into_iter()
        .map(|(first, past)| {
            let at = |frame: f64| ((frame * step).max(0.0) as usize).min(samples.len());
            (at(first as f64 - 0.5), at(past as f64 - 0.5))
        })
        .collect();
    // The polarity of the more prominent peaks: the third moment has its sign.
    let skew: f64 = runs
        .iter()
        .flat_map(|&(from, to)| &smooth[from..to])
        .map(|x| x * x * x)
        .sum();
    if skew < 0.0 {
        for x in &mut smooth {
            *x = -*x;
        }
    }
    let mut found: Vec<Vec<f64>> = Vec::new();
    for &(from, to) in &runs {
        let mut marks = interval(&smooth, from, to, rate_hz, track);
        // Two intervals may have extended into the same gap: the first owns it.
        if let Some(end) = found.last().and_then(|before| before.last()) {
            marks.retain(|at| at - end > 0.001 * rate_hz);
        }
        if marks.len() >= 3 {
            found.push(marks);
        }
    }
    found
}

/// Returns the sound without changes faster than about a millisecond and without its mean over 20
/// ms: weighted by a raised cosine 1.2 ms wide.
fn smoothed(samples: &[f64], rate_hz: f64) -> Vec<f64> {
    let half = (0.0006 * rate_hz).round().max(1.0) as usize;
    let kernel: Vec<f64> = (0..=2 * half)
        .map(|i| {
            let place = (i as f64 - half as f64) / (half as f64 + 1.0);
            (0.5 + 0.5 * ops::cos(PI * place)) / (half as f64 + 1.0)
        })
        .collect();
    let reach = (0.01 * rate_hz) as usize;
    let mut sums = vec![0.0; samples.len() + 1];
    for (i, x) in samples.iter().enumerate() {
        sums[i + 1] = sums[i] + if x.is_finite() { *x } else { 0.0 };
    }
    (0..samples.len())
        .map(|i| {
            let near: f64 = kernel
                .iter()
                .enumerate()
                .filter_map(|(k, w)| Some(samples.get((i + k).checked_sub(half)?)? * w))
                .sum();
            let (from, to) = (i.saturating_sub(reach), (i + reach + 1).min(samples.len()));
            near - (sums[to] - sums[from]) / (to - from) as f64
        })
        .collect()
}

/// A peak that may be a mark.
struct Peak {
    /// Sub-sample position.
    at: f64,
    /// The track's period there, in samples.
    period: f64,
    /// Height relative to the highest peak within a period, 0..1.
    height: f64,
    cost: f64,
    before: Option<usize>,
}

/// Cost of a peak of no height, of a step an octave wrong (as the square), and of a
/// period that is unlike the one before (chosen on engine voices and made vowels).
const HEIGHT_COST: f64 = 0.6;
const STEP_COST: f64 = 8.0;
const SHAPE_COST: f64 = 1.0;
/// Cost of restarting after a gap that no step spans.
const GAP_COST: f64 = 4.0;

/// Returns the pitch marks between two samples: the cheapest path through the peaks there.
fn interval(smooth: &[f64], from: usize, to: usize, rate_hz: f64, track: &PitchTrack) -> Vec<f64> {
    let mut peaks = peaks(smooth, from, to, rate_hz, track);
    weigh(&mut peaks, smooth, from);
    // The path ends within the last period, at the cheapest peak there.
    let end = peaks
        .iter()
        .enumerate()
        .rev()
        .take_while(|(_, p)| to as f64 - p.at < 1.2 * p.period)
        .min_by(|(_, a), (_, b)| a.cost.total_cmp(&b.cost))
        .map(|(k, _)| k)
        .or(peaks.len().checked_sub(1));
    let mut marks = Vec::new();
    let mut at = end;
    while let Some(k) = at {
        marks.push(peaks[k].at);
        at = peaks[k].before;
    }
    marks.reverse();
    grow(smooth, &mut marks, 1.0);
    marks.reverse();
    grow(smooth, &mut marks, -1.0);
    marks.reverse();
    marks
}

/// Returns the peaks between two samples where the track has a pitch.
fn peaks(smooth: &[f64], from: usize, to: usize, rate_hz: f64, track: &PitchTrack) -> Vec<Peak> {
    let mut peaks: Vec<Peak> = Vec::new();
    for i in from.max(1)..to.min(smooth.len().saturating_sub(1)) {
        let [a, b, c] = [smooth[i - 1], smooth[i], smooth[i + 1]];
        let hz = track.hz_near(i as f64 / rate_hz, 0.02);
        if !(b > 0.0 && b > a && b >= c && hz > 0.0) {
            continue;
        }
        let period = rate_hz / hz;
        let (low, high) = ((i as f64 - period) as usize, (i as f64 + period) as usize);
        let tallest = smooth[low..high.min(smooth.len())]
            .iter()
            .fold(b, |m, &x| m.max(x));
        // Peaks this low are ripples; considering them only takes time.
        if b < 0.2 * tallest {
            continue;
        }
        peaks.push(Peak {
            at: i as f64 + 0.5 * (a - c) / (a - 2.0 * b + c),
            period,
            height: b / tallest,
            cost: 0.0,
            before: None,
        });
    }
    peaks
}

/// Finds the cheapest path to each peak from the preceding ones (dynamic programming).
fn weigh(peaks: &mut [Peak], smooth: &[f64], from: usize) {
    let mut oldest = 0;
    for k in 0..peaks.len() {
        let (done, rest) = peaks.split_at_mut(k);
        let here = &mut rest[0];
        let low = HEIGHT_COST * (1.0 - here.height);
        while done
            .get(oldest)
            .is_some_and(|p| here.at - p.at > 2.0 * here.period)
        {
            oldest += 1;
        }
        // The first epoch must be within the first period, or pay for the skipped ones.
        let skipped = (here.at - from as f64) / here.period;
        here.cost = low
            + if skipped > 1.2 {
                GAP_COST + skipped
            } else {
                0.0
            };
        for (j, there) in done.iter().enumerate().skip(oldest) {
            let periods = (here.at - there.at) / here.period;
            if !(0.6..=1.7).contains(&periods) {
                continue;
            }
            let octaves = ops::ln(periods) / std::f64::consts::LN_2;
            let unlike = 1.0 - likeness(smooth, there.at, here.at, here.period);
            let step = STEP_COST * octaves * octaves + SHAPE_COST * unlike + low;
            // By time, not by step: a path of more steps must not be cheaper or dearer.
            let cost = there.cost + step * periods;
            if cost < here.cost {
                here.cost = cost;
                here.before = Some(j);
            }
        }
        // A position without a usable peak must not lose the preceding path.
        if let (None, Some(there)) = (here.before, done.last()) {
            let cost = there.cost + GAP_COST + (here.at - there.at) / here.period;
            if cost < here.cost {
                here.cost = cost;
                here.before = Some(k - 1);
            }
        }
    }
}

/// Maximum number of periods added at either end of a stretch; the next constant is the required
/// similarity of each to the preceding one.
const MAX_GROWN: usize = 4;
const GROWN_LIKENESS: f64 = 0.7;

/// Appends periods that the track's windows were too wide to detect: an end without epochs would
/// keep its pitch when all else changes. `side` is 1 for ascending epochs, −1 for descending ones.
fn grow(smooth: &[f64], marks: &mut Vec<f64>, side: f64) {
    for _ in 0..MAX_GROWN {
        let &[.., before, last] = &marks[..] else {
            return;
        };
        let period = (last - before).abs();
        let reach = (0.2 * period) as isize;
        let ahead = (last + side * period).round() as isize;
        let value = |at: isize| {
            let at = usize::try_from(at).unwrap_or(usize::MAX);
            smooth.get(at).copied().unwrap_or(0.0)
        };
        let Some(top) =
            (ahead - reach..=ahead + reach).max_by(|a, b| value(*a).total_cmp(&value(*b)))
        else {
            return;
        };
        let [a, b, c] = [-1, 0, 1].map(|d| value(top + d));
        let is_peak = b > 0.0 && b > a && b >= c && b > 0.2 * value(last.round() as isize);
        if !is_peak || likeness(smooth, last, top as f64, period) < GROWN_LIKENESS {
            return;
        }
        marks.push(top as f64 + 0.5 * (a - c) / (a - 2.0 * b + c));
    }
}

/// Returns the similarity of the periods around two positions, −1..1: the correlation of about
/// fifty points of each.
fn likeness(smooth: &[f64], one: f64, other: f64, period: f64) -> f64 {
    let stride = ((period / 48.0) as usize).max(1);
    let half = (0.5 * period) as isize;
    let (one, other) = (one.round() as isize, other.round() as isize);
    let (mut ab, mut aa, mut bb) = (0.0, 0.0, 0.0);
    for d in (-half..=half).step_by(stride) {
        let value = |at: isize| {
            let at = usize::try_from(at + d).unwrap_or(usize::MAX);
            smooth.get(at).copied().unwrap_or(0.0)
        };
        let (a, b) = (value(one), value(other));
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

#[cfg(test)]
mod tests {
    use super::super::f0::{PitchOptions, track};
    use super::super::testing::{self, Segment};
    use super::*;

    #[test]
    fn there_is_one_mark_per_period_in_phase_with_it() {
        for (rate, from, to) in [
            (16_000.0, 80.0, 140.0),
            (16_000.0, 120.0, 120.0),
            (22_050.0, 300.0, 180.0),
            (44_100.0, 400.0, 420.0),
            (8000.0, 200.0, 100.0),
        ] {
            let parts = [
                Segment::silence(0.1),
                Segment::vowel(0.8, from, to),
                Segment::noise(0.1),
            ];
            let (mut sound, truth) = testing::utterance(rate, &parts);
            for (i, x) in sound.iter_mut().enumerate() {
                *x += 0.01 * scatter(i as u64);
            }
            let found = track(&sound, rate, &PitchOptions::default());
            let marks: Vec<f64> = find(&sound, rate, &found)
                .iter()
                .filter(|e| e.voiced && e.secs > 0.12 && e.secs < 0.88)
                .map(|e| e.secs)
                .collect();
            assert!(
                marks.len() as f64 > 0.75 * 0.5 * (from + to) * 0.95,
                "the marks cover at least 95 % of the voiced periods"
            );
            for pair in marks.windows(2) {
                let periods = (pair[1] - pair[0]) * truth.hz_at(0.5 * (pair[0] + pair[1]));
                assert!((periods - 1.0).abs() < 0.06, "{rate} {from}: {periods}");
            }
            // In phase over the whole: no slow drift either.
            let phase = |t: f64| {
                let u = t - 0.1;
                from * u + 0.5 * (to - from) * u * u / 0.8
            };
            let (first, last) = (phase(marks[0]), phase(marks[marks.len() - 1]));
            let turned = last - first - (marks.len() - 1) as f64;
            assert!(turned.abs() < 0.15, "{rate} {from}: {turned}");
        }
    }

    #[test]
    fn unvoiced_marks_are_near_but_not_even() {
        let sound: Vec<f64> = (0..8000).map(scatter).collect();
        let empty = PitchTrack {
            step_secs: 0.01,
            ..PitchTrack::default()
        };
        let marks = find(&sound, 16_000.0, &empty);
        assert!(
            (90..110).contains(&marks.len()),
            "the unvoiced audio has about 100 marks"
        );
        let steps: Vec<f64> = marks.windows(2).map(|p| p[1].secs - p[0].secs).collect();
        assert!(
            steps.iter().all(|s| (0.002..0.008).contains(s)),
            "the unvoiced marks are 2 to 8 ms apart"
        );
        let spread = steps.iter().map(|s| (s - 0.005).abs()).sum::<f64>() / steps.len() as f64;
        assert!(spread > 0.0004, "{spread}");
    }

    #[test]
    fn a_track_that_does_not_fit_is_survived() {
        let wild = PitchTrack {
            step_secs: 0.01,
            hz: vec![1e-300, 1e300, 100.0, f64::INFINITY, 70.0],
            strength: Vec::new(),
        };
        let sound: Vec<f64> = (0..900).map(scatter).collect();
        assert!(
            find(&sound, 16_000.0, &wild)
                .iter()
                .all(|e| e.secs.is_finite()),
            "the marks of a wild track are finite"
        );
        assert!(
            find(&[f64::NAN; 900], 16_000.0, &wild)
                .iter()
                .all(|e| e.secs.is_finite()),
            "the marks of audio of NaN are finite"
        );
    }
}
